// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// AmclDriver, over a host in this process, by function calls and by messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "patient_host.h"
#include "reachable_host.h"

namespace {

using CCMorse::AmclDriver;
using CCMorse::PlayerClient;
using CCMorse::PlayerError;
using CCMorse::Position2dProxy;
using test::error_code_of;
using test::ReachableHost;
using test::Transport;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// position2d:0 is the true pose, position2d:1 noisy odometry, whose frame starts at the robot.
std::string arena(const std::string& simulation = "{}") {
  return R"({"simulation": )" + simulation + R"(, "arena": {"preset": "syrotek"},
    "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90},
                "devices": {"laser": {"noise": 0.01},
                            "odometry": {"noise": 0.005, "wheel_ratio": 1.01}}}]})";
}

struct AmclDriverTest : testing::TestWithParam<Transport> {
  void start(const std::string& text) {
    host =
        std::make_unique<ReachableHost>(test::patient_host(sim::load_world_text(text)), GetParam());
  }
  std::unique_ptr<ReachableHost> host;
};

INSTANTIATE_TEST_SUITE_P(Transports, AmclDriverTest,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

double error_m(const AmclDriver& driver, const Position2dProxy& truth) {
  const player_pose2d_t mean = driver.GetHypoth(0).mean;
  return std::hypot(mean.px - truth.GetXPos(), mean.py - truth.GetYPos());
}

TEST_P(AmclDriverTest, KnownPose_Tracked) {
  start(arena());
  PlayerClient client(host->connect(6665));
  Position2dProxy truth(&client, 0);
  AmclDriver driver(&client);
  EXPECT_EQ(driver.GetHypothCount(), 0U);
  EXPECT_EQ(driver.GetNumParticles(), 0U);
  driver.Set("pf_max_samples", 1000);
  driver.SetPose(0.5, 0.4, 1.5708, 0.1, 0.1);
  truth.SetSpeed(0.2, 0.0);
  for (int i = 0; i < 60; ++i) client.Read();
  ASSERT_GE(driver.GetHypothCount(), 1U);
  // The median of the device's error in this arena is 1 cm, its maximum 4 cm.
  EXPECT_LT(error_m(driver, truth), 0.06);
  EXPECT_NEAR(driver.GetHypoth(0).mean.pa, truth.GetYaw(), 0.06);
  EXPECT_GT(driver.GetHypoth(0).alpha, 0.9);
  EXPECT_GT(driver.GetHypoth(0).cov[0], 0.0);
  EXPECT_GE(driver.GetUpdates(), 5U);  // a scan every 0.2 m
  const uint32_t count = driver.GetNumParticles();
  EXPECT_GE(count, 100U);
  EXPECT_LE(count, 1000U);
  double weights = 0.0;
  double mean_y = 0.0;
  for (uint32_t i = 0; i < count; ++i) {
    weights += driver.GetParticleWeight(i);
    mean_y += driver.GetParticleWeight(i) * driver.GetParticlePose(i).py;
  }
  EXPECT_NEAR(weights, 1.0, 1e-9);
  EXPECT_NEAR(mean_y, truth.GetYPos(), 0.1);
  // Beyond the end.
  EXPECT_EQ(driver.GetHypoth(99).alpha, 0.0);
  EXPECT_EQ(driver.GetParticlePose(count).px, 0.0);
  EXPECT_EQ(driver.GetParticleWeight(count), 0.0);
}

TEST_P(AmclDriverTest, UnknownPose_Found) {
  start(arena());
  PlayerClient client(host->connect(6665));
  Position2dProxy truth(&client, 0);
  AmclDriver driver(&client);
  truth.SetSpeed(0.2, 0.0);
  for (int i = 0; i < 60; ++i) client.Read();
  truth.SetSpeed(0.0, 1.0);
  for (int i = 0; i < 60; ++i) client.Read();
  EXPECT_LT(error_m(driver, truth), 0.1);
}

TEST_P(AmclDriverTest, Spread_ForgetsPose) {
  start(arena());
  PlayerClient client(host->connect(6665));
  AmclDriver driver(&client);
  driver.SetPose(0.5, 0.4, 1.5708, 0.01, 0.01);
  for (int i = 0; i < 3; ++i) client.Read();
  EXPECT_LT(driver.GetHypoth(0).cov[0], 0.01);
  EXPECT_NEAR(driver.GetHypoth(0).mean.px, 0.5, 0.05);
  const uint64_t updates = driver.GetUpdates();
  driver.Spread();
  for (int i = 0; i < 3; ++i) client.Read();
  EXPECT_EQ(driver.GetUpdates(), updates + 1);  // the next scan is used although the robot stands
}

TEST_P(AmclDriverTest, Setting_RestartsFilterFromLastPose) {
  start(arena());
  PlayerClient client(host->connect(6665));
  AmclDriver driver(&client);
  driver.SetPose(0.5, 0.4, 1.5708, 0.05, 0.05);
  for (int i = 0; i < 3; ++i) client.Read();
  EXPECT_EQ(driver.GetUpdates(), 1U);
  driver.Set("pf_min_samples", 500);
  driver.Set("pf_max_samples", 500);
  for (int i = 0; i < 3; ++i) client.Read();
  EXPECT_EQ(driver.GetUpdates(), 1U);
  EXPECT_EQ(driver.GetNumParticles(), 500U);
  EXPECT_NEAR(driver.GetHypoth(0).mean.px, 0.5, 0.1);
}

TEST_P(AmclDriverTest, ExtremeNumbers_RefusedOrUsed) {
  start(arena());
  PlayerClient client(host->connect(6665));
  Position2dProxy odometry(&client, 1);
  AmclDriver driver(&client);
  driver.Set("pf_max_samples", 200);
  constexpr double kHuge = 1e308;
  const auto expect_refused = [](const auto& action) {
    EXPECT_EQ(error_code_of(action), PlayerError::kBadArgument);
  };
  expect_refused([&] { driver.SetPose(0.5, 0.4, 1.5, 0.1, kHuge); });
  expect_refused([&] { driver.SetPose(0.5, 0.4, 1.5, kHuge, 0.1); });
  expect_refused([&] { driver.SetPose(kHuge, 0.4, 1.5, 0.1, 0.1); });
  expect_refused([&] { driver.SetPose(0.5, -kHuge, 1.5); });
  expect_refused([&] { odometry.SetOdometry(kHuge, 0.0, 0.0); });
  expect_refused([&] { driver.Set("init_pose_var", kHuge); });
  expect_refused([&] { driver.Set("init_pose_var_yaw_deg", kHuge); });
  for (const double resolution_m : {kHuge, 1e-308, -1.0, 0.0}) {
    expect_refused([&] { const AmclDriver other(&client, 1, 0, resolution_m); });
  }
  driver.SetPose(1e9, -1e9, kHuge, 1e9, 1e9);
  for (int i = 0; i < 3; ++i) client.Read();
  ASSERT_GE(driver.GetHypothCount(), 1U);
  for (uint32_t i = 0; i < driver.GetHypothCount(); ++i) {
    const player_localize_hypoth_t hypothesis = driver.GetHypoth(i);
    for (const double number : {hypothesis.mean.px, hypothesis.mean.py, hypothesis.mean.pa,
                                hypothesis.cov[0], hypothesis.cov[1], hypothesis.cov[2]}) {
      EXPECT_TRUE(std::isfinite(number)) << i;
    }
  }
}

TEST_P(AmclDriverTest, Settings_HaveNamesAndRanges) {
  start(arena());
  PlayerClient client(host->connect(6665));
  AmclDriver driver(&client);
  EXPECT_EQ(driver.Get("pf_max_samples"), 10000.0);
  EXPECT_EQ(driver.Get("init_pose_var"), 1.0);
  EXPECT_NEAR(driver.Get("update_thresh_yaw_deg"), 30.0, 1e-9);
  driver.Set("update_thresh_yaw_deg", 15.0);
  driver.Set("init_pose_var", 0.2);
  EXPECT_NEAR(driver.Get("update_thresh_yaw_deg"), 15.0, 1e-9);
  EXPECT_EQ(driver.Get("init_pose_var"), 0.2);
  try {
    driver.Set("pf_erro", 0.1);
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorFun(), "AmclDriver::Set");
    EXPECT_THAT(e.GetErrorStr(),
                AllOf(HasSubstr("pf_erro"), HasSubstr("pf_err,"), Not(HasSubstr("frequency"))));
  }
  const auto refused = [&](const char* name, double value) {
    return error_code_of([&] { driver.Set(name, value); }) == PlayerError::kBadArgument;
  };
  EXPECT_TRUE(refused("pf_err", 0.0));
  EXPECT_TRUE(refused("pf_err", std::nan("")));
  EXPECT_TRUE(refused("pf_min_samples", 2.5));
  EXPECT_TRUE(refused("pf_min_samples", 20000.0));  // above pf_max_samples
  EXPECT_TRUE(refused("init_pose_var", -1.0));
  EXPECT_TRUE(refused("laser", 1.0));
  EXPECT_EQ(driver.Get("pf_err"), 0.01);
}

TEST_P(AmclDriverTest, WrongArguments_Refused) {
  start(arena());
  PlayerClient client(host->connect(6665));
  EXPECT_EQ(error_code_of([&] { AmclDriver other(nullptr); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { AmclDriver other(&client, 5); }), PlayerError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([&] { AmclDriver other(&client, 1, 3); }), PlayerError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([&] { AmclDriver other(&client, 1, 0, -0.05); }),
            PlayerError::kBadArgument);
  AmclDriver driver(&client);
  EXPECT_EQ(error_code_of([&] { driver.SetPose(std::nan(""), 0.0, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetPose(0.0, 0.0, 0.0, -0.1, 0.1); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetPose(0.0, 0.0, 0.0, 0.1, HUGE_VAL); }),
            PlayerError::kBadArgument);
}

TEST_P(AmclDriverTest, OwnSensorsOnly_Refused) {
  start(arena(R"({"privacy": "own"})"));
  PlayerClient client(host->connect(6665));
  EXPECT_NE(error_code_of([&] { AmclDriver driver(&client); }), 0);
}

std::string localised_run(Transport transport) {
  ReachableHost host(test::patient_host(sim::load_world_text(arena())), transport);
  PlayerClient client(host.connect(6665));
  Position2dProxy motors(&client, 0);
  AmclDriver driver(&client);
  driver.SetPose(0.5, 0.4, 1.5708, 0.1, 0.1);
  motors.SetSpeed(0.2, 0.2);
  std::ostringstream trace;
  trace.precision(17);
  for (int i = 0; i < 40; ++i) {
    client.Read();
    const player_localize_hypoth_t best = driver.GetHypoth(0);
    trace << best.mean.px << ' ' << best.mean.pa << ' ' << best.alpha << ' '
          << driver.GetNumParticles() << '\n';
  }
  return trace.str();
}

TEST_P(AmclDriverTest, Repeatable) {
  const std::string first = localised_run(Transport::kInProcess);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(localised_run(GetParam()), first) << "run " << i + 2;
}

}  // namespace
