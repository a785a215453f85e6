// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/server/server.h"

#include <utility>

#include "server/server_hub.h"

namespace playerlike {

struct Server::Impl {
  std::shared_ptr<Host> host;
  std::string bind;
  server::ServerHub hub;
};

std::string address_text(const std::string& address, int port) {
  const bool ipv6 = address.find(':') != std::string::npos;
  return (ipv6 ? '[' + address + ']' : address) + ':' + std::to_string(port);
}

Server::Server(std::shared_ptr<Host> host, ServerSettings settings, sim::LogHook log)
    : impl_(new Impl{host,
                     settings.bind,
                     {host, std::move(settings), std::move(log), server::make_morse_handler}}) {}
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
void Server::check(const ServerSettings& settings, const sim::WorldDescription& world) {
  std::vector<std::string> robots;
  std::vector<int> ports;
  for (const sim::RobotDescription& robot : world.robots) {
    robots.push_back(robot.name);
    ports.push_back(robot.port);
  }
  check(settings, robots, ports);
}

std::vector<std::string> Server::player_port_lines() const {
  std::vector<std::string> lines;
  for (const auto& [robot_port, port] : player_ports()) {
    std::string names;
    for (const RobotInfo& robot : impl_->host->robots()) {
      if (robot.port == robot_port) names += (names.empty() ? "" : ", ") + robot.name;
    }
    lines.push_back("Player's protocol on " + address_text(impl_->bind, port) + ": " + names);
  }
  return lines;
}
std::size_t Server::connections() const noexcept { return impl_->hub.connections(); }
bool Server::done() const noexcept { return impl_->hub.done(); }
void Server::adopt(int descriptor) { impl_->hub.adopt(descriptor); }
void Server::stop() noexcept { impl_->hub.stop(); }

}  // namespace playerlike
