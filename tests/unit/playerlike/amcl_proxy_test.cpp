// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// LocalizeProxy with the amcl device, by function calls, over Playpen's protocol and over Player's,
// and amcl as a driver of a world.
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <limits>
#include <string>

#include "patient_host.h"
#include "playerlike/host/host.h"
#include "playerlike/server/server.h"
#include "reachable_host.h"
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
/// @param has_map  whether the client knows the size of the map; Player's protocol has no message
///                 for it.
void expect_tracking(PlayerCc::PlayerClient& client, bool has_map = true) {
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
  EXPECT_EQ(localize.GetMapSizeX(), has_map ? 71U : 0U);
  EXPECT_EQ(localize.GetMapSizeY(), has_map ? 77U : 0U);
  EXPECT_EQ(localize.GetMapScale(), has_map ? 0.05 : 0.0);
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
  EXPECT_EQ(localize.GetParticles(), 0);
  EXPECT_NEAR(localize.GetParticlePose(0).px, 1.5, 0.05);
  localize.SetPose(pose, nullptr);  // with the covariance of the settings
  cov[0] = -1.0;
  EXPECT_THROW(localize.SetPose(pose, cov), PlayerCc::PlayerError);
  cov[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(localize.SetPose(pose, cov), PlayerCc::PlayerError);
}

class AmclTransports : public testing::TestWithParam<test::Transport> {};

INSTANTIATE_TEST_SUITE_P(Transports, AmclTransports,
                         testing::Values(test::Transport::kInProcess, test::Transport::kCbor,
                                         test::Transport::kJson),
                         [](const auto& instance) { return test::transport_name(instance.param); });

TEST_P(AmclTransports, HypothesesParticlesAndSetPose_Work) {
  const test::ReachableHost host(test::patient_host(world_with(kDriver)), GetParam());
  PlayerCc::PlayerClient client(host.connect(6665));
  expect_tracking(client);
}

TEST(AmclProxy, PlayerProtocol_HypothesesParticlesAndSetPoseWork) {
  ServerSettings settings;
  settings.port = 0;
  settings.player_port = 0;
  const Server server(test::patient_host(world_with(kDriver)), settings);
  PlayerCc::PlayerClient client("player://127.0.0.1:" +
                                std::to_string(server.player_ports().at(6665)));
  expect_tracking(client, false);
}

// What the particles say of the covariance of a pose, after SetPose() and before the next scan.
struct Spread {
  double xx = 0.0;
  double xy = 0.0;
};
template <typename Covariance>
Spread spread_after(const Covariance& cov) {
  // update_thresh is never reached, and the first scan is used before SetPose().
  const auto host = Host::create(world_with(
      R"("devices": {"laser": {"frequency": 1}},
         "drivers": [{"type": "amcl", "init_pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90},
                      "pf_min_samples": 4000, "pf_max_samples": 4000}])"));
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::LocalizeProxy localize(&client, 0);
  for (int i = 0; i < 12; ++i) client.Read();
  double pose[3] = {1.5, 2.0, 0.0};
  localize.SetPose(pose, cov);
  for (int i = 0; i < 2; ++i) client.Read();
  EXPECT_EQ(localize.GetParticles(), 0);
  const auto count = static_cast<int>(localize.GetNumParticles());
  EXPECT_EQ(count, 4000);
  Spread spread;
  for (int i = 0; i < count; ++i) {
    const player_pose2d_t particle = localize.GetParticlePose(i);
    const double weight = localize.GetParticleWeight(i);
    spread.xx += weight * (particle.px - 1.5) * (particle.px - 1.5);
    spread.xy += weight * (particle.px - 1.5) * (particle.py - 2.0);
  }
  return spread;
}

// Four standard errors of a variance of 4000 numbers: 4 sqrt(2 / 4000) of it.
constexpr double kVariance_m2 = 0.04;
constexpr double kBound_m2 = 4.0 * 0.0224 * kVariance_m2;

TEST(AmclProxy, Array_ReadsSixNumbersAsPlayer3) {
  const double whole[6] = {kVariance_m2, kVariance_m2, 0.01, 0.03, 0.0, 0.0};
  const Spread spread = spread_after(whole);
  EXPECT_NEAR(spread.xx, kVariance_m2, kBound_m2);
  EXPECT_NEAR(spread.xy, 0.03, kBound_m2);
}

TEST(AmclProxy, Array_ReadsThreeNumbersAsPlayer2) {
  const double variances[3] = {kVariance_m2, kVariance_m2, 0.01};
  const Spread spread = spread_after(variances);
  EXPECT_NEAR(spread.xx, kVariance_m2, kBound_m2);
  EXPECT_NEAR(spread.xy, 0.0, kBound_m2);
}

TEST(AmclProxy, Pointer_ReadsThreeVariances) {
  double whole[6] = {kVariance_m2, kVariance_m2, 0.01, 9.0, 9.0, 9.0};
  double* const pointer = whole;
  const Spread spread = spread_after(pointer);
  EXPECT_NEAR(spread.xx, kVariance_m2, kBound_m2);
  EXPECT_NEAR(spread.xy, 0.0, kBound_m2);
}

TEST(AmclProxy, InvalidCovariance_Refused) {
  const auto host = Host::create(world_with(kDriver));
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::LocalizeProxy localize(&client, 0);
  double pose[3] = {1.5, 2.0, 0.3};
  const double impossible[6] = {0.01, 0.01, 0.01, 0.02, 0.0, 0.0};  // correlation 2
  EXPECT_THROW(localize.SetPose(pose, impossible), PlayerCc::PlayerError);
  const double too_short[2] = {0.01, 0.01};
  EXPECT_THROW(localize.SetPose(pose, too_short), PlayerCc::PlayerError);
  EXPECT_THROW(localize.SetPose(nullptr, impossible), PlayerCc::PlayerError);
  localize.SetPose(pose, NULL);  // as C programs write it
}

TEST(AmclProxy, FollowsLocalisationInArena) {
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

TEST(AmclProxy, DriverAndDevice_Equal) {
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

TEST(AmclProxy, InvalidDrivers_Refused) {
  expect_issue(R"("drivers": [{"type": "amcl", "pf_erro": 1}])", "world/unknown-key",
               "/robots/0/drivers/0/pf_erro");
  expect_issue(R"("drivers": [{"type": "amcl"}, {"type": "amcl"}])", "world/duplicate-name",
               "/robots/0/drivers/1/type");
  expect_issue(R"("drivers": [{"type": "amcl", "laser_range_bad": 2}])", "world/out-of-range",
               "/robots/0/drivers/0/laser_range_bad");
}

}  // namespace
}  // namespace playerlike
