// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "sim/core/error.h"
#include "utf8_stream.h"

int main(int argc, char** argv) {
  const playpen::Utf8Stream messages(std::cerr);
  try {
    playpen::CommandLine line(argc > 0 ? argv[0] : "playpen");
    return line.run(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
  } catch (const sim::ConfigError& error) {
    std::cerr << error.what() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "playpen: " << error.what() << '\n';
  }
  return playpen::kBadInput;
}
