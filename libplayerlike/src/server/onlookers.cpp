// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/onlookers.h"

#include <string>
#include <utility>

#include "playerlike/server/server.h"
#include "virtual_time/program_threads.h"

namespace playerlike {
namespace {

class ServedOnlookers final : public Onlookers {
 public:
  ServedOnlookers(std::shared_ptr<Host> host, int player_port, const sim::LogHook& log)
      : server_(std::move(host), onlooker_settings(player_port),
                [log](sim::LogLevel level, std::string_view text) {
                  // The program's output is not the place for a line about each connection.
                  if (level >= sim::LogLevel::kWarning) log(level, text);
                }) {
    for (const std::string& line : server_.player_port_lines()) log(sim::LogLevel::kInfo, line);
  }

 private:
  Server server_;
};

}  // namespace

ServerSettings onlooker_settings(int player_port) {
  ServerSettings settings;
  settings.port.reset();
  settings.player_port = player_port;
  settings.onlookers = true;
  return settings;
}

std::unique_ptr<Onlookers> open_onlookers(std::shared_ptr<Host> host, int player_port,
                                          sim::LogHook log) {
  const StartsOwnThreads starts;
  return std::make_unique<ServedOnlookers>(std::move(host), player_port, log);
}

}  // namespace playerlike
