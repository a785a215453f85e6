// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "command_line.h"
#include "page_options.h"
#include "parsed_option.h"
#include "run_options.h"

namespace playpen {
namespace {

bool parse_log_level(const std::string& text, sim::LogLevel& level) {
  if (text == "debug") {
    level = sim::LogLevel::kDebug;
  } else if (text == "info") {
    level = sim::LogLevel::kInfo;
  } else if (text == "warning") {
    level = sim::LogLevel::kWarning;
  } else if (text == "error") {
    level = sim::LogLevel::kError;
  } else {
    return false;
  }
  return true;
}

void add_count(CLI::App& command, const std::string& name, const std::string& description,
               const std::string& value_name, std::size_t least, std::size_t most,
               std::size_t& count) {
  add_parsed(command, name, description, value_name,
             "a whole number from " + std::to_string(least) + " to " + std::to_string(most),
             [least, most, &count](const std::string& text) {
               return parse_number(text, count) && count >= least && count <= most;
             });
}

void add_seconds(CLI::App& command, const std::string& name, const std::string& description,
                 double& seconds) {
  add_parsed(command, name, description, "S", "a number of seconds from 0 to 1e6",
             [&seconds](const std::string& text) {
               return parse_number(text, seconds) && seconds >= 0.0 && seconds <= 1e6;
             });
}

void add_limits(CLI::App& command, playerlike::ServerLimits& limits) {
  constexpr std::size_t kGiB = std::size_t{1} << 30U;
  add_count(command, "--max-connections", "Connections at once, of all ports together [256]", "N",
            1, 100'000, limits.connections);
  add_count(command, "--max-message", "Bytes of a request [1048576]", "BYTES", 256, kGiB,
            limits.message_bytes);
  add_count(command, "--max-requests", "Requests of a client that wait for their answers [256]",
            "N", 1, 100'000, limits.requests_in_flight);
  add_count(command, "--max-queued", "Bytes that may wait for a client that reads slowly [8388608]",
            "BYTES", 4096, kGiB, limits.queued_bytes);
  add_seconds(command, "--first-request-timeout",
              "Seconds until a new client's first request; 0: no limit [10]",
              limits.first_request_s);
  add_seconds(command, "--request-timeout",
              "Seconds from the first byte of a request to its last; 0: no limit [10]",
              limits.partial_request_s);
  add_seconds(command, "--idle-timeout",
              "Seconds without a request after which a client is closed; 0: no limit [0]",
              limits.idle_s);
}

}  // namespace

void add_serve(CommandLine& line) {
  const auto request = std::make_shared<ServeRequest>();
  playerlike::ServerSettings& server = request->server;
  CLI::App& command = line.add_command("serve", "Offer a world to client programs over TCP");
  command.footer(
      "Clients connect with PLAYPEN_WORLD=tcp://HOST:PORT or unix:PATH, or as MORSE's\n"
      "do: see 'playpen doc remote'. With --port 6665, Player's clients find each robot\n"
      "on its own port.\n"
      "Ends on Ctrl-C (SIGINT) or SIGTERM, with reports and pictures written.");
  add_world(line, command, request->world);
  add_robot_port(command, request->settings,
                 std::string(playerlike::kRobotPortExpected) +
                     "; --tcp-port sets the port of Playpen's and MORSE's clients",
                 &server.port);  // 0 was its value for any free TCP port
  add_port(command, "--tcp-port",
           "TCP port of Playpen's and MORSE's clients; 0: any free one [4000; none with --unix]",
           server.port);
  CLI::Option* const unix_path = command.add_option(
      "--unix", server.unix_path,
      "Unix socket for clients on this machine, PLAYPEN_WORLD=unix:PATH; TCP only if --tcp-port "
      "is given");
  line.takes(unix_path->type_name("PATH"), ValueKind::Kind::kFile);
  command
      .add_option("--bind", server.bind,
                  "Address to listen on, or a name of this machine [127.0.0.1]")
      ->type_name("ADDRESS");
  CLI::Option* const token_file = command.add_option(
      "--token-file", request->token_file, "File with the tokens that clients must present");
  line.takes(token_file->type_name("FILE"), ValueKind::Kind::kFile);
  command.add_flag("--open", server.open, "Let other machines connect without a token");
  add_parsed(command, "--clients",
             "Hold time until N clients have joined; 0: do not wait [the world's]", "N",
             "a whole number from 0 to 1000", [request](const std::string& text) {
               int clients = 0;
               const bool good = parse_number(text, clients) && clients >= 0 && clients <= 1000;
               if (good) request->clients = clients;
               return good;
             });
  CLI::Option* const privacy = add_parsed(
      command, "--privacy", "own: clients read their own robots' sensors only [the world's]",
      "WHAT", "own", [request](const std::string& text) {
        request->own_sensors_only = text == "own";
        return text == "own";
      });
  line.takes(privacy, {"own"});
  add_run_settings(line, command, request->settings, "the world's, else real");
  add_port(command, "--stream-port", "First port of MORSE's data streams; 0: any [60000]",
           server.stream_port);
  command.add_flag("--open-streams", server.open_streams,
                   "Open the ports of all streams at the start, for clients that do not ask");
  add_port(command, "--sync-port", "Port of MORSE's clock synchronisation; 0: any [none]",
           server.sync_port);
  add_port(
      command, "--player-port",
      "First port of Player's protocol, one for each robot; 0: any [with --port 6665, else none]",
      server.player_port);
  add_limits(command, server.limits);
  CLI::Option* const log_level = add_parsed(
      command, "--log-level", "debug, info, warning or error [info]", "LEVEL",
      "debug, info, warning or error",
      [request](const std::string& text) { return parse_log_level(text, request->log_level); });
  line.takes(log_level, {"debug", "info", "warning", "error"});
  command.add_flag("--view", request->view,
                   "Watch and steer in a window, in real time unless --time says otherwise");
  add_page(line, command, request->page);
  command.add_flag("--quiet", request->quiet, "No summary");
  command.callback([request, &line, &command] {
    playerlike::ServerSettings& listening = request->server;
    if (!listening.unix_path.empty() && command.count("--tcp-port") == 0) listening.port.reset();
    require_something_to_show(request->settings, request->view);
    line.status = serve(*request);
  });
}

}  // namespace playpen
