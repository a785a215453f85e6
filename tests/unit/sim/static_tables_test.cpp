// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// If a program does not end its run, an exit handler ends it and draws its pictures. The handler
// may be registered before libsim has created its tables. Then it runs after the destruction of
// static objects that were created later.
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

TEST(StaticTables, OutliveEarlierExitHandlers) {
  // In a separate process, which has not created any table yet.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(end_with_tables_made_after_the_handler(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace sim
