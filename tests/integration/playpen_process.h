// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_process.h"

/// Helpers for the tests of the playpen command.
namespace test_support {

/// An empty room with one robot; laser and pose are exact unless `noise_m` says otherwise.
[[nodiscard]] inline std::string room_world(double noise_m = 0.0) {
  const nlohmann::json world = {
      {"name", "room"},
      {"arena", {{"size", {2.0, 2.0}}}},
      {"canvas", {{"size", {172, 186}}}},  // what the course's programs expect
      {"robots",
       {{{"name", "r1"},
         {"pose", {{"x", 0.5}, {"y", 1.0}, {"yaw_deg", 0.0}}},
         {"devices", {{"laser", {{"noise", noise_m}}}}}}}}};
  return world.dump();
}

/// `playpen run WORLD OPTIONS --out OUT -- PROGRAM ARGUMENTS`.
[[nodiscard]] inline std::vector<std::string> run_call(const std::string& world,
                                                       const std::vector<std::string>& options,
                                                       const std::string& out,
                                                       const std::string& program,
                                                       const std::vector<std::string>& arguments) {
  std::vector<std::string> call = {PLAYPEN_COMMAND, "run", world};
  call.insert(call.end(), options.begin(), options.end());
  call.insert(call.end(), {"--out", out, "--", program});
  call.insert(call.end(), arguments.begin(), arguments.end());
  return call;
}

/// Runs playpen with these arguments in a folder.
[[nodiscard]] inline ProcessResult playpen(std::vector<std::string> arguments,
                                           const ProcessOptions& options = {}) {
  arguments.insert(arguments.begin(), PLAYPEN_COMMAND);
  return test_support::run_process(arguments, options);
}

/// Where a `playpen serve --port 0` listens, in the form for PLAYPEN_WORLD. Waits for its first
/// line.
[[nodiscard]] inline std::string address_of(Process& server) {
  EXPECT_TRUE(server.read_until("\n")) << server.finish().err;
  const std::string& said = server.output();
  EXPECT_THAT(said, testing::HasSubstr("listening on 127.0.0.1:"));
  const std::string port = said.substr(said.rfind(':') + 1);
  return "tcp://127.0.0.1:" + port.substr(0, port.find('\n'));
}

}  // namespace test_support
