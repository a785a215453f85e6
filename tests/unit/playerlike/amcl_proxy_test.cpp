// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// LocalizeProxy with the amcl device, and amcl as a driver of a world.
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <limits>
#include <string>

#include "playerlike/host/host.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace playerlike {
namespace {

sim::WorldDescription world_with(const std::string& robot) {
  return sim::load_world_text(R"({"arena": {"preset": "syrotek"}, "robots": [{"name": "r1",
      "pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90}, )" +
                              robot + "}]}");
}

constexpr const char* kDriver =
    R"("drivers": [{"type": "amcl", "init_pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90},
                    "init_pose_var": [0.1, 0.1], "init_pose_var_yaw_deg": 5,
                    "pf_min_samples": 150, "pf_max_samples": 1000}])";

/// Drives 1 m and compares the poses.
void expect_tracking(PlayerCc::PlayerClient& client) {
  PlayerCc::Position2dProxy position(&client, 0);
  PlayerCc::LocalizeProxy localize(&client, 0);
  EXPECT_EQ(localize.GetHypothCount(), 0U);
  EXPECT_EQ(localize.GetParticles(), -1);
  position.SetSpeed(0.2, 0.0);
  for (int i = 0; i < 50; ++i) client.Read();
  ASSERT_GE(localize.GetHypothCount(), 1U);
  const player_localize_hypoth_t best = localize.GetHypoth(0);
  // position2d:0 is the arena's localisation, which is exact here.
  EXPECT_NEAR(best.mean.px, position.GetXPos(), 0.1);
  EXPECT_NEAR(best.mean.py, position.GetYPos(), 0.1);
  EXPECT_NEAR(best.mean.pa, position.GetYaw(), 0.1);
  EXPECT_GT(best.cov[0], 0.0);
  EXPECT_GT(best.alpha, 0.5);
  EXPECT_EQ(localize.GetMapSizeX(), 71U);
  EXPECT_EQ(localize.GetMapSizeY(), 77U);
  EXPECT_EQ(localize.GetMapScale(), 0.05);
  EXPECT_EQ(localize.GetPendingCount(), 0U);

  ASSERT_EQ(localize.GetParticles(), 0);
  const auto count = static_cast<int>(localize.GetNumParticles());
  EXPECT_GE(count, 150);
  double weights = 0.0;
  double mean_x = 0.0;
  for (int i = 0; i < count; ++i) {
    weights += localize.GetParticleWeight(i);
    mean_x += localize.GetParticleWeight(i) * localize.GetParticlePose(i).px;
  }
  EXPECT_NEAR(weights, 1.0, 1e-9);
  EXPECT_NEAR(mean_x, best.mean.px, 0.2);

  // The next used scan would correct this, but the robot has not moved since.
  position.SetSpeed(0.0, 0.0);
  client.Read();
  double pose[3] = {1.5, 2.0, 0.3};
  double cov[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  localize.SetPose(pose, cov);
  client.Read();
  client.Read();
  EXPECT_NEAR(localize.GetHypoth(0).mean.px, 1.5, 0.05);
  EXPECT_NEAR(localize.GetHypoth(0).mean.py, 2.0, 0.05);
  localize.SetPose(pose, nullptr);  // with the covariance of the settings
  cov[0] = -1.0;
  EXPECT_THROW(localize.SetPose(pose, cov), PlayerCc::PlayerError);
  cov[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(localize.SetPose(pose, cov), PlayerCc::PlayerError);
}

TEST(AmclProxy, ShowsHypothesesAndParticlesInTheProcess) {
  const auto host = Host::create(world_with(kDriver));
  PlayerCc::PlayerClient client(host->connect(6665));
  expect_tracking(client);
}

TEST(AmclProxy, FollowsTheArenasLocalisation) {
  const auto host = Host::create(world_with(kDriver));
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::LocalizeProxy measured(&client, 1);
  client.Read();
  ASSERT_EQ(measured.GetHypothCount(), 1U);
  EXPECT_EQ(measured.GetHypoth(0).mean.px, 0.5);
  ASSERT_EQ(measured.GetParticles(), 0);
  EXPECT_EQ(measured.GetNumParticles(), 1U);
  EXPECT_EQ(measured.GetParticleWeight(0), 1.0);
}

TEST(AmclProxy, DriverAndDeviceAreTheSame) {
  const auto driver = world_with(R"("drivers": [{"type": "amcl", "pf_min_samples": 50}])");
  const auto device = world_with(R"("devices": {"amcl": {"pf_min_samples": 50}})");
  sim::Simulation first(driver);
  sim::Simulation second(device);
  for (int i = 0; i < 30; ++i) {
    first.step();
    second.step();
  }
  EXPECT_EQ(first.state_hash(), second.state_hash());
}

void expect_issue(const std::string& robot, const std::string& id, const std::string& pointer) {
  try {
    static_cast<void>(world_with(robot));
    FAIL() << "accepted: " << robot;
  } catch (const sim::ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U) << error.what();
    EXPECT_EQ(error.issues()[0].id, id);
    EXPECT_EQ(error.issues()[0].pointer, pointer);
  }
}

TEST(AmclProxy, RefusesBadDrivers) {
  expect_issue(R"("drivers": [{"type": "amcl", "pf_erro": 1}])", "world/unknown-key",
               "/robots/0/drivers/0/pf_erro");
  expect_issue(R"("drivers": [{"type": "amcl"}, {"type": "amcl"}])", "world/duplicate-name",
               "/robots/0/drivers/1/type");
  expect_issue(R"("drivers": [{"type": "amcl", "laser_range_bad": 2}])", "world/out-of-range",
               "/robots/0/drivers/0/laser_range_bad");
}

}  // namespace
}  // namespace playerlike
