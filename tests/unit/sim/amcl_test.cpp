// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The amcl device in worlds.
#include "sim/devices/amcl.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "sim/world/description.h"

namespace sim {
namespace {

WorldDescription arena_with(const std::string& devices) {
  return load_world_text(R"({"arena": {"preset": "syrotek"}, "robots": [{"name": "r1",
      "pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90}, "devices": {)" +
                         devices + "}}]}");
}

const Amcl& amcl_of(const Simulation& simulation) {
  return dynamic_cast<const Amcl&>(simulation.device(0, *simulation.find_device(0, "amcl")));
}

void command(Simulation& simulation, const char* device, const Command& what) {
  ASSERT_EQ(simulation.apply({0, *simulation.find_device(0, device)}, what), std::nullopt);
}

TEST(Amcl, NoisyOdometry_Tracked) {
  Simulation simulation(arena_with(
      R"("odometry": {"noise": 0.005, "wheel_ratio": 1.02},
         "amcl": {"init_pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90}, "init_pose_var": [0.1, 0.1],
                  "init_pose_var_yaw_deg": 5, "pf_max_samples": 2000})"));
  command(simulation, "motion", TwistCommand{{.v_mps = 0.25}});
  for (int i = 0; i < 800; ++i) simulation.step();  // 2 m
  const AmclReading& reading = amcl_of(simulation).reading();
  EXPECT_EQ(reading.sequence, 80U);
  EXPECT_GT(reading.updates, 5U);
  ASSERT_FALSE(reading.hypotheses.empty());
  const Pose truth = simulation.body(0).X_WB;
  EXPECT_LT((reading.hypotheses[0].mean.position() - truth.position()).norm(), 0.05);
  EXPECT_EQ(amcl_of(simulation).pose_estimate(), reading.hypotheses[0].mean);
  // The floor of 3.42 x 3.72 m and a cell on each side, in cells of 0.05 m.
  EXPECT_EQ(reading.map_width, 71U);
  EXPECT_EQ(reading.map_height, 77U);
  EXPECT_EQ(reading.map_resolution_m, 0.05);
  EXPECT_EQ(reading.pending, 0U);
}

TEST(Amcl, BetweenUpdates_FollowsOdometry) {
  Simulation simulation(arena_with(
      R"("amcl": {"init_pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90}, "init_pose_var": [0, 0],
                  "init_pose_var_yaw_deg": 0, "update_thresh": 100})"));
  for (int i = 0; i < 50; ++i) simulation.step();
  EXPECT_EQ(amcl_of(simulation).reading().updates, 1U);              // the first scan
  command(simulation, "odometry", SetPoseCommand{{7.0, 7.0, 1.0}});  // does not disturb it
  command(simulation, "motion", TwistCommand{{.v_mps = 0.2}});
  for (int i = 0; i < 100; ++i) simulation.step();
  const AmclReading& reading = amcl_of(simulation).reading();
  EXPECT_EQ(reading.updates, 1U);
  const Pose truth = simulation.body(0).X_WB;
  EXPECT_NEAR(reading.hypotheses[0].mean.y_m, truth.y_m, 1e-9);
  EXPECT_NEAR(reading.hypotheses[0].mean.yaw_rad, truth.yaw_rad, 1e-9);
}

TEST(Amcl, Pose_AcceptedWithAndWithoutCovariance) {
  Simulation simulation(arena_with(
      R"("amcl": {"init_pose_var": [0.2, 0.3], "init_pose_var_yaw_deg": 0, "pf_max_samples": 5000})"));
  command(simulation, "amcl", SetPoseCommand{{1.0, 2.0, 0.5}});
  PoseHypothesis best = amcl_of(simulation).localizer().hypotheses().front();
  // Four standard errors of a variance: sqrt(2 / n) of it.
  EXPECT_NEAR(best.covariance.variance[0], 0.04, 4.0 * 0.04 * std::sqrt(2.0 / 5000.0));
  EXPECT_NEAR(best.covariance.variance[1], 0.09, 4.0 * 0.09 * std::sqrt(2.0 / 5000.0));
  command(simulation, "amcl",
          SetPoseCommand{{1.0, 2.0, 0.5}, {{1e-4, 1e-4, 0.0}}, {{1e-4, 0.0, 0.0}}});
  best = amcl_of(simulation).localizer().hypotheses().front();
  EXPECT_NEAR(best.covariance.covariance[0], 1e-4, 1e-5);
  const auto refused = [&](const Command& what, const char* why) {
    const auto text = simulation.apply({0, *simulation.find_device(0, "amcl")}, what);
    ASSERT_TRUE(text.has_value());
    EXPECT_NE(text->find(why), std::string::npos) << *text;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  refused(SetPoseCommand{{kNan, 0.0, 0.0}}, "finite");
  refused(SetPoseCommand{{}, {{-1.0, 1.0, 1.0}}}, "positive semidefinite");
  refused(TwistCommand{}, "takes no such command");
}

TEST(Amcl, Map_LeavesOutMovableObjects) {
  const WorldDescription world = load_world_text(R"({"arena": {"size": [2, 1], "border": false,
      "obstacles": [{"center": [0.5, 0.5], "size": [0.2, 0.2]},
                    {"center": [1.5, 0.5], "size": [0.2, 0.2], "mass": 1}]}, "robots": []})");
  const auto map = localization_map(world.arena, 0.1);
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->width, 20);
  EXPECT_EQ(map->at(4, 5), 1.0F);
  EXPECT_EQ(map->at(14, 5), 0.0F);
  EXPECT_FALSE(localization_map(world.arena, 1e-5).has_value());
}

void expect_issue(const std::string& devices, const char* id, const char* pointer,
                  const char* expected) {
  try {
    const Simulation simulation(arena_with(devices));
    FAIL() << "accepted: " << devices;
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U) << error.what();
    EXPECT_EQ(error.issues()[0].id, id);
    EXPECT_EQ(error.issues()[0].pointer, pointer);
    EXPECT_NE(error.issues()[0].expected.find(expected), std::string::npos) << error.what();
  }
}

TEST(Amcl, MissingOrInvalidSettings_Refused) {
  expect_issue(R"("amcl": {"laser": "eyes"})", "device/wiring", "/robots/0/devices/amcl",
               "a laser device \"eyes\"");
  expect_issue(R"("amcl": {"odometry": "laser"})", "device/wiring", "/robots/0/devices/amcl",
               "an odometry or pose device \"laser\"");
  expect_issue(R"("amcl": {"pf_min_samples": 200, "pf_max_samples": 100})", "device/amcl-samples",
               "/robots/0/devices/amcl/pf_max_samples", "pf_min_samples (200)");
  expect_issue(R"("amcl": {"pf_err": 0})", "world/out-of-range", "/robots/0/devices/amcl/pf_err",
               "");
}

}  // namespace
}  // namespace sim
