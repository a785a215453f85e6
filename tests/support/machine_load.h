// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "nightly.h"
#include "run_process.h"

/// Tests of runs on a busy machine.
namespace test_support {

/// Busy processes. They end with this object, and with the test.
class MachineLoad {
 public:
  /// A process per core, four in nightly runs.
  MachineLoad() : MachineLoad(cases(1U, 4U) * std::max(1U, std::thread::hardware_concurrency())) {}
  explicit MachineLoad(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      processes_.push_back(std::make_unique<Process>(
          std::vector<std::string>{"sh", "-c", "echo on; while :; do :; done"}));
    }
    for (const auto& process : processes_) EXPECT_TRUE(process->read_until("on\n"));
  }

 private:
  std::vector<std::unique_ptr<Process>> processes_;
};

/// How often a test repeats its runs under load. PLAYPEN_REPEATS in the environment replaces the
/// usual number of a merge or a nightly run; less than `least` counts as `least`.
[[nodiscard]] inline int repeats(int usual, int least) {
  const char* text = std::getenv("PLAYPEN_REPEATS");
  return text == nullptr ? usual : std::max(least, std::atoi(text));
}

/// Options of processes under load: on a very busy machine, a thread or a client may be silent for
/// longer than the usual limit, which is in wall-clock time.
[[nodiscard]] inline ProcessOptions patient() {
  ProcessOptions options;
  options.environment = {{"PLAYPEN_SILENCE_LIMIT", "900"}};
  return options;
}

}  // namespace test_support
