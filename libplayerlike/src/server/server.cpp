// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/server/server.h"

#include <utility>

#include "server/server_hub.h"

namespace playerlike {

struct Server::Impl {
  server::ServerHub hub;
};

Server::Server(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log)
    : impl_(new Impl{
          {std::move(host), std::move(settings), std::move(log), server::make_morse_handler}}) {}
Server::~Server() = default;

void Server::check(const ServerSettings& settings, const std::vector<std::string>& robots,
                   const std::vector<int>& robot_ports) {
  server::ServerHub::check(settings, robots, robot_ports);
}

int Server::port() const noexcept { return impl_->hub.port(); }
int Server::sync_port() const noexcept { return impl_->hub.sync_port(); }
const std::map<int, int>& Server::player_ports() const noexcept {
  return impl_->hub.player_ports();
}
std::size_t Server::connections() const noexcept { return impl_->hub.connections(); }
bool Server::done() const noexcept { return impl_->hub.done(); }
void Server::stop() noexcept { impl_->hub.stop(); }

}  // namespace playerlike
