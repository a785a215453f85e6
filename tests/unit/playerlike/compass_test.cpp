// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/compass.h"

#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <cmath>
#include <numbers>
#include <string>

#include "playerlike/host/host.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

constexpr double kPi = std::numbers::pi;

WorldDescription room_with(const std::string& settings) {
  const std::string robot = R"({"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"compass": )";
  return load_world_text(R"({"arena": {"size": [2, 2]}, "robots": [)" + robot + settings + "}}]}");
}

TEST(CompassHeading, AngleFromMagneticNorth) {
  constexpr double kNorth = 0.5 * kPi;                                         // W's y axis
  EXPECT_DOUBLE_EQ(compass_heading_rad({1.0, 2.0, kNorth}, kNorth), 0.0);      // along y: north
  EXPECT_DOUBLE_EQ(compass_heading_rad({1.0, 2.0, 0.0}, kNorth), -0.5 * kPi);  // along x: east
  EXPECT_DOUBLE_EQ(compass_heading_rad({1.0, 2.0, 0.0}, kNorth + 0.1), -0.5 * kPi - 0.1);
  // -3/4 turn is the same as +1/4.
  EXPECT_DOUBLE_EQ(compass_heading_rad({1.0, 2.0, -kPi}, kNorth), 0.5 * kPi);
}

TEST(Compass, MeasuresAtFrequency) {
  Simulation simulation(room_with(R"({"frequency": 20, "north_deg": 180})"));
  for (int i = 0; i < 100; ++i) simulation.step();  // 1 s
  const auto& compass =
      dynamic_cast<const Compass&>(simulation.device(0, *simulation.find_device(0, "compass")));
  EXPECT_EQ(compass.reading().sequence, 20U);
  // The robot looks along x; magnetic north is half a turn from it.
  EXPECT_NEAR(std::abs(compass.reading().heading_rad), kPi, 1e-12);
}

TEST(Compass, Noise_HasDeviation) {
  Simulation simulation(room_with(R"({"frequency": 100, "noise_deg": 2})"));
  const auto& compass =
      dynamic_cast<const Compass&>(simulation.device(0, *simulation.find_device(0, "compass")));
  constexpr int kReadings = 10000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kReadings; ++i) {
    simulation.step();
    const double error = compass.reading().heading_rad + 0.5 * kPi;
    sum += error;
    squares += error * error;
  }
  const double sigma = 2.0 * kPi / 180.0;
  // Four standard errors: of a mean sigma / sqrt(n), of a deviation sigma / sqrt(2 n).
  EXPECT_NEAR(sum / kReadings, 0.0, 4.0 * sigma / std::sqrt(kReadings));
  EXPECT_NEAR(std::sqrt(squares / kReadings), sigma, 4.0 * sigma / std::sqrt(2.0 * kReadings));
}

TEST(Compass, InvalidSettings_Refused) {
  try {
    static_cast<void>(room_with(R"({"noise_deg": -1})"));
    FAIL() << "a negative noise was read";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U);
    EXPECT_EQ(error.issues()[0].id, "world/out-of-range");
    EXPECT_EQ(error.issues()[0].pointer, "/robots/0/devices/compass/noise_deg");
  }
}

TEST(Compass, Proxy_ShowsReading) {
  const auto host = playerlike::Host::create(room_with("{}"));
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::ImuProxy compass(&client, 0);
  client.Read();
  EXPECT_TRUE(compass.IsFresh());
  EXPECT_NEAR(compass.GetPose().pyaw, -0.5 * kPi, 1e-12);
  char key[] = "north";
  double north_rad = 0.0;
  EXPECT_EQ(compass.GetDblProp(key, &north_rad), 0);
  EXPECT_NEAR(north_rad, 0.5 * kPi, 1e-12);
}

}  // namespace
}  // namespace sim
