// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command_line.h"
#include "parsed_option.h"
#include "playerlike/server/server_settings.h"
#include "run_options.h"
#include "shipped.h"

namespace playpen {
namespace {

struct TokenRequest {
  std::string world;
  int count = 1;
};

/// Prints a token file for a world: one token for the server and one for each robot.
void print_token_file(const std::string& name) {
  const sim::WorldDescription world = load_found_world(find_world(name));
  nlohmann::ordered_json file = {{"server", playerlike::make_token()},
                                 {"robots", nlohmann::ordered_json::object()}};
  for (const sim::RobotDescription& robot : world.robots) {
    file["robots"][robot.name] = playerlike::make_token();
  }
  std::cout << file.dump(2) << '\n';
}

}  // namespace

void add_token(CommandLine& line) {
  const auto request = std::make_shared<TokenRequest>();
  CLI::App& command =
      line.add_command("token", "Make tokens, or a token file, for servers that others can reach");
  command.footer(
      "Prints a token that nobody can guess. With a world: a token file with tokens for\n"
      "the server and each robot, as in\n"
      "  (umask 077; playpen token cave > tokens.json)\n"
      "  playpen serve cave --bind 0.0.0.0 --token-file tokens.json");
  CLI::Option* const world = add_world(line, command, request->world)->required(false);
  add_parsed(command, "--count", "Number of tokens, one per line [1]", "N",
             "a whole number from 1 to 1000",
             [request](const std::string& text) {
               return parse_number(text, request->count) && request->count >= 1 &&
                      request->count <= 1000;
             })
      ->excludes(world);
  command.callback([request] {
    if (!request->world.empty()) return print_token_file(request->world);
    for (int i = 0; i < request->count; ++i) std::cout << playerlike::make_token() << '\n';
  });
}

}  // namespace playpen
