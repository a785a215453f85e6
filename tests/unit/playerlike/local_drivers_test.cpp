// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// VfhDriver, NdDriver and the world's drivers vfh, nd and goto, over a host in this process, by
// function calls and by messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "patient_host.h"
#include "reachable_host.h"
#include "sim/core/error.h"

namespace {

using CCMorse::LocalDriver;
using CCMorse::NdDriver;
using CCMorse::PlayerClient;
using CCMorse::PlayerError;
using CCMorse::Position2dProxy;
using CCMorse::VfhDriver;
using test::error_code_of;
using test::ReachableHost;
using test::Transport;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kDrivers = R"([
  {"type": "vfh", "cell_size": 0.05, "safety_dist_0ms": 0.05, "distance_epsilon": 0.05,
   "max_turnrate_0ms_deg": 90, "free_space_cutoff_0ms": 4e6},
  {"type": "nd", "avoid_dist": 0.15, "goal_tol": 0.05, "max_turnrate_deg": 90}, {"type": "goto"}])";

std::string room(const std::string& drivers, const std::string& obstacles) {
  return R"({"arena": {"size": [4, 3], "obstacles": [)" + obstacles + R"(]},
    "robots": [{"name": "r1", "pose": {"x": 0.8, "y": 1.5}, "drivers": )" +
         drivers + "}]}";
}
const std::string kBlock = R"({"center": [2, 1.4], "size": [0.3, 0.3]})";

struct LocalDriversTest : testing::TestWithParam<Transport> {
  void start(const std::string& text) {
    host =
        std::make_unique<ReachableHost>(test::patient_host(sim::load_world_text(text)), GetParam());
  }
  std::unique_ptr<ReachableHost> host;
};

INSTANTIATE_TEST_SUITE_P(Transports, LocalDriversTest,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(LocalDriversTest, DriversOfWorld_ReachGoalsWithoutCollision) {
  for (const int index : {2, 3}) {
    start(room(kDrivers, kBlock));
    PlayerClient client(host->connect(6665));
    Position2dProxy position(&client, static_cast<uint32_t>(index));
    EXPECT_EQ(position.GetDriverName(), index == 2 ? "vfh" : "nd");
    position.GoTo(3.2, 1.5, 0.0);
    for (int i = 0; i < 600; ++i) client.Read();
    EXPECT_LE(std::hypot(position.GetXPos() - 3.2, position.GetYPos() - 1.5), 0.075) << index;
    EXPECT_EQ(position.GetXSpeed(), 0.0) << index;
    EXPECT_EQ(host->statistics(0).collisions, 0) << index;
  }
}

TEST_P(LocalDriversTest, Goto_DrivesStraight) {
  start(room(kDrivers, ""));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 4);
  EXPECT_EQ(position.GetDriverName(), "goto");
  position.GoTo(3.2, 1.5, 1.5);
  double widest_m = 0.0;
  for (int i = 0; i < 250; ++i) {
    client.Read();
    widest_m = std::max(widest_m, std::abs(position.GetYPos() - 1.5));
  }
  EXPECT_LE(std::hypot(position.GetXPos() - 3.2, position.GetYPos() - 1.5), 0.06);
  EXPECT_NEAR(position.GetYaw(), 1.5, 3.0 * 3.1416 / 180.0);
  EXPECT_LT(widest_m, 0.01);
}

template <typename Driver>
std::string run(ReachableHost& host) {
  PlayerClient client(host.connect(6665));
  Position2dProxy position(&client, 0);
  Driver driver(&client);
  driver.Set("robot_radius", 0.1);
  driver.SetGoal(3.2, 1.5);
  std::ostringstream trace;
  trace.precision(17);
  for (int i = 0; i < 200; ++i) {
    client.Read();
    trace << position.GetXPos() << ' ' << position.GetYPos() << ' ' << driver.GetStatus() << '\n';
  }
  return trace.str();
}

TEST_P(LocalDriversTest, Repeatable) {
  start(room("[]", kBlock));
  const std::string vfh = run<VfhDriver>(*host);
  start(room("[]", kBlock));
  EXPECT_EQ(run<VfhDriver>(*host), vfh);
  start(room("[]", kBlock));
  const std::string nd = run<NdDriver>(*host);
  start(room("[]", kBlock));
  EXPECT_EQ(run<NdDriver>(*host), nd);
  EXPECT_NE(vfh, nd);
}

TEST_P(LocalDriversTest, Settings_HaveNamesAndRanges) {
  start(room("[]", ""));
  PlayerClient client(host->connect(6665));
  VfhDriver driver(&client);
  EXPECT_EQ(driver.Get("cell_size"), 0.1);
  EXPECT_EQ(driver.Get("window_diameter"), 61.0);
  EXPECT_NEAR(driver.Get("max_turnrate_0ms_deg"), 40.0, 1e-9);
  EXPECT_TRUE(std::isnan(driver.Get("safety_dist_1ms")));
  driver.Set("safety_dist_1ms", 0.3);
  driver.Set("sector_angle_deg", 10.0);
  driver.Set("window_diameter", 41);
  EXPECT_EQ(driver.Get("safety_dist_1ms"), 0.3);
  EXPECT_NEAR(driver.Get("sector_angle_deg"), 10.0, 1e-9);
  EXPECT_EQ(driver.Get("window_diameter"), 41.0);
  try {
    driver.Set("max_sped", 1.0);
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorFun(), "VfhDriver::Set");
    EXPECT_THAT(e.GetErrorStr(), AllOf(HasSubstr("max_sped"), HasSubstr("max_acceleration")));
  }
  EXPECT_EQ(error_code_of([&] { driver.Set("cell_size", -1.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.Set("cell_size", std::nan("")); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.Set("window_diameter", 2.5); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { static_cast<void>(driver.Get("nothing")); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { NdDriver other(&client, 9); }), PlayerError::kNoSuchDevice);
}

// The error for the world's author.
std::string fault(const std::string& drivers, const std::string& devices = "{}") {
  try {
    playerlike::check_drivers(sim::load_world_text(
        R"({"robots": [{"devices": )" + devices + R"(, "drivers": )" + drivers + "}]}", "w.json"));
  } catch (const sim::ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(DriversTable, SettingsOfAllDrivers_Checked) {
  EXPECT_EQ(fault(kDrivers), "");
  EXPECT_THAT(fault(R"([{"type": "vfh", "window_diameter": 61.5}])"),
              AllOf(HasSubstr("/robots/0/drivers/0/window_diameter"),
                    HasSubstr("a whole number from 3 to 401 cells"), HasSubstr("found \"61.5\"")));
  EXPECT_THAT(fault(R"([{"type": "nd", "safety_dist": -1}])"),
              AllOf(HasSubstr("a number from 0 to 10 m"), HasSubstr("world/out-of-range")));
  EXPECT_THAT(fault(R"([{"type": "teapot"}])"),
              HasSubstr(R"("snd", "vfh", "nd", "goto", "wavefront")"));
  EXPECT_EQ(fault(R"([{"type": "goto"}])", R"({"laser": null})"), "");  // it needs none
  EXPECT_THAT(fault(R"([{"type": "nd"}])", R"({"laser": null})"),
              HasSubstr("a robot with a laser"));
}

TEST(DriversTable, Planner_NeedsDriverAndPose) {
  EXPECT_EQ(fault(R"([{"type": "wavefront", "draw": false}, {"type": "vfh"}])"), "");
  EXPECT_THAT(fault(R"([{"type": "wavefront"}])"),
              AllOf(HasSubstr("a driver that drives to goals"), HasSubstr("world/driver-device")));
  EXPECT_THAT(fault(R"([{"type": "snd"}, {"type": "wavefront", "output": 0}])"),
              AllOf(HasSubstr("/robots/0/drivers/1/output"), HasSubstr("2 (snd)")));
  EXPECT_THAT(fault(R"([{"type": "snd"}, {"type": "wavefront", "position": 7}])"),
              HasSubstr("world/driver-device"));
  EXPECT_THAT(fault(R"([{"type": "snd"}, {"type": "wavefront", "localize": 3}])"),
              HasSubstr("world/driver-device"));
  EXPECT_THAT(fault(R"([{"type": "snd"}, {"type": "wavefront", "draw": "maybe"}])"),
              AllOf(HasSubstr("true or false"), HasSubstr("world/wrong-type")));
  EXPECT_THAT(fault(R"([{"type": "snd"}, {"type": "wavefront", "index": 0},
                        {"type": "wavefront", "index": 0}])"),
              HasSubstr("world/driver-index"));
}

}  // namespace
