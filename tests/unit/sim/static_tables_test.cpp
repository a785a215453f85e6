// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A run that its program does not end is ended, and drawn, by an exit handler that may have been
// registered before libsim made its tables, and so runs after static objects made since are gone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "sim/devices/builtin.h"
#include "sim/world/robot_model.h"

namespace sim {
namespace {

const RobotModel* model = nullptr;
const std::vector<DeviceKind>* kinds = nullptr;

void leave_with_verdict() {
  const bool model_there = model->name == "s1r" && model->footprint == s1r_model().footprint;
  const auto laser = std::find_if(kinds->begin(), kinds->end(),
                                  [](const DeviceKind& kind) { return kind.name == "laser"; });
  const bool kinds_there = laser != kinds->end() && laser->properties({}).at("range_max") == 5.0;
  std::_Exit((model_there ? 0 : 1) + (kinds_there ? 0 : 2));
}

void end_with_tables_made_after_the_handler() {
  if (std::atexit(leave_with_verdict) != 0) std::_Exit(4);
  model = &default_robot_model();
  kinds = &device_kinds();
  std::exit(8);
}

TEST(StaticTables, OutliveExitHandlersRegisteredBeforeThem) {
  // In a process of its own, which has made no table yet.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(end_with_tables_made_after_the_handler(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace sim
