// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "run_process.h"

namespace test_support {

/// Four busy processes per core. They end with this object, and with the test.
class MachineLoad {
 public:
  MachineLoad() {
    const unsigned count = 4 * std::max(1U, std::thread::hardware_concurrency());
    for (unsigned i = 0; i < count; ++i) {
      processes_.push_back(std::make_unique<Process>(
          std::vector<std::string>{"sh", "-c", "echo on; while :; do :; done"}));
    }
    for (const auto& process : processes_) EXPECT_TRUE(process->read_until("on\n"));
  }

 private:
  std::vector<std::unique_ptr<Process>> processes_;
};

}  // namespace test_support
