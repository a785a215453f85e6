// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// MORSE's components of space: their names, messages and commands, without a socket.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "server/morse_components.h"
#include "server/python_json.h"
#include "sim/core/base64.h"
#include "sim/simulation/simulation.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using testing::Contains;

TEST(PythonJson, MatchesPython) {
  // Each text is what json.dumps() of Python 3.11 gives.
  EXPECT_EQ(python_json(json{{"a", {1, 2.0, true, nullptr}}, {"b", "x"}}),
            R"({"a": [1, 2.0, true, null], "b": "x"})");
  EXPECT_EQ(python_json(json::array()), "[]");
  EXPECT_EQ(python_json(json::object()), "{}");
  EXPECT_EQ(python_json("\xc3\xa9\n\""), R"("\u00e9\n\"")");
  EXPECT_EQ(python_json(0.1), "0.1");
  EXPECT_EQ(python_json(-0.0), "-0.0");
  EXPECT_EQ(python_json(1e-5), "1e-05");
  EXPECT_EQ(python_json(0.0001), "0.0001");
  EXPECT_EQ(python_json(1e16), "1e+16");
  EXPECT_EQ(python_json(123456789012345.0), "123456789012345.0");
  EXPECT_EQ(python_json(std::numeric_limits<double>::infinity()), "Infinity");
  EXPECT_EQ(python_json(-std::numeric_limits<double>::infinity()), "-Infinity");
  EXPECT_EQ(python_json(std::nan("")), "NaN");
}

class MorseSpace : public testing::Test {
 protected:
  explicit MorseSpace()
      : simulation_(sim::load_world_text(R"({
          "arena": {"size": [20, 20], "origin": [-10, -10]},
          "robots": [{"name": "r1", "model": "omni", "pose": {"x": 0, "y": 0}, "devices": {
            "laser": null,
            "ptu": {"type": "ptz"}, "gyro": {"type": "gyroscope", "on": "ptu"},
            "posture": {"of": "ptu"}, "orientation": {}, "altimeter": {"range": 1},
            "teleport": {"modifiers": [{"name": "NED"}]},
            "gps": {"level": "simple", "modifiers": [{"name": "UTM", "x_offset": 100}]},
            "far": {"type": "gps", "longitude_deg": 43.6, "latitude_deg": 1.4333},
            "camera": {"image": [4, 3], "field_of_view_deg": 90},
            "depth": {"type": "depth_camera", "image": [4, 3], "field_of_view_deg": 90,
                      "height": 1},
            "go": {"type": "destination", "speed": 2}, "arm": {"type": "actarray"},
            "hand": {"on": "arm"}
          }}]})")) {}

  std::vector<MorseComponent> components() {
    return morse_components(describe_robots(simulation_), simulation_);
  }
  MorseComponent component(const std::string& name) {
    for (const MorseComponent& one : components()) {
      if (one.name == name) return one;
    }
    ADD_FAILURE() << "there is no " << name;
    return {};
  }
  sim::Command command(const std::string& name, const json& object) {
    return morse_command(component(name), object, simulation_);
  }
  json record(const std::string& name, int steps) {
    const DeviceId id = component(name).device.value();
    for (int i = 0; i < steps; ++i) simulation_.step();
    return morse_record(simulation_.device(id.robot, id.device).sensor()->reading(),
                        stream_format(simulation_, id));
  }

  sim::Simulation simulation_;
};

TEST_F(MorseSpace, MountedSensors_NamedWithCarrier) {
  std::vector<std::string> names;
  for (const MorseComponent& one : components()) names.push_back(one.name);
  EXPECT_THAT(names, Contains("r1.ptu.gyro"));
  EXPECT_THAT(names, Contains("r1.ptu.posture"));
  EXPECT_EQ(component("r1.motion").class_name, "MotionXYW");
  EXPECT_EQ(component("r1.ptu").class_name, "PTU");
  EXPECT_EQ(component("r1.ptu").stream, StreamDirection::kIn);
}

TEST_F(MorseSpace, Commands_HaveSignsOfMorse) {
  const auto point = std::get<sim::PointCommand>(command("r1.ptu", {{"pan", 0.5}, {"tilt", 0.2}}));
  EXPECT_EQ(point.pan_rad, 0.5);
  EXPECT_EQ(point.tilt_rad, -0.2);  // MORSE's tilt is positive downwards
  const auto twist =
      std::get<sim::TwistCommand>(command("r1.motion", {{"x", 1.0}, {"y", 2.0}, {"w", 3.0}}));
  EXPECT_EQ(twist.twist.lateral_mps, 2.0);
  EXPECT_EQ(twist.twist.omega_radps, 3.0);
  const auto old = std::get<sim::TwistCommand>(command("r1.motion", {{"v", 1.0}, {"w", 3.0}}));
  EXPECT_EQ(old.twist.v_mps, 1.0);
  // NED: x and y change places, z points down; roll is pi/2 - yaw.
  const auto place = std::get<sim::PlaceCommand>(
      command("r1.teleport", {{"x", 2.0}, {"y", 1.0}, {"z", -3.0}, {"roll", 0.0}, {"yaw", 0.1}}));
  EXPECT_EQ(place.pose.x_m, 1.0);
  EXPECT_EQ(place.pose.y_m, 2.0);
  EXPECT_EQ(place.z_m, 3.0);
  EXPECT_NEAR(place.pose.yaw_rad, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_EQ(place.roll_rad, 0.1);
  EXPECT_ANY_THROW(static_cast<void>(command("r1.orientation", {{"pitch", 1.0}})));
}

TEST_F(MorseSpace, Records_HaveKeysOfMorse) {
  const json simple = record("r1.gps", 20);
  EXPECT_NEAR(simple["x"], 100.0, 1e-9);
  EXPECT_FALSE(simple.contains("latitude"));
  const json extended = record("r1.far", 1);
  EXPECT_NEAR(extended["longitude"], 43.6, 1e-9);
  EXPECT_EQ(extended["velocity"], json::parse("[0.0, 0.0, 0.0]"));
  EXPECT_EQ(extended["date"], "010170");
  EXPECT_EQ(extended["time"], "000000");
  EXPECT_EQ(record("r1.ptu.posture", 1)["tilt"], 0.0);
  const json gyro = record("r1.ptu.gyro", 1);
  for (const char* angle : {"yaw", "pitch", "roll"}) EXPECT_EQ(gyro[angle], 0.0);
  // The robot stands on the floor: the altimeter is in range.
  EXPECT_EQ(record("r1.altimeter", 1)["z"], 0.0);
}

TEST_F(MorseSpace, Pictures_MatchMorse) {
  EXPECT_EQ(component("r1.camera").class_name, "VideoCamera");
  EXPECT_EQ(component("r1.depth").class_name, "DepthCamera");
  const json picture = record("r1.camera", 20);
  EXPECT_EQ(picture["width"], 4);
  EXPECT_EQ(picture["height"], 3);
  // The focal length is half the width over tan 45 degrees.
  const json matrix = json::parse("[[2, 0, 2], [0, 2, 1.5], [0, 0, 1]]");
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      EXPECT_NEAR(picture["intrinsic_matrix"][row][column], matrix[row][column], 1e-9);
    }
  }
  const auto pixels = sim::from_base64(picture["image"].get<std::string>());
  ASSERT_TRUE(pixels.has_value());
  ASSERT_EQ(pixels->size(), 48U);  // red, green, blue and alpha
  for (std::size_t i = 3; i < 48; i += 4) EXPECT_EQ((*pixels)[i], 255);
  // The lowest row of depths shows the floor: z = 2 / (2.5 - 1.5).
  const json points = record("r1.depth", 1);
  const auto bytes = sim::from_base64(points["points"].get<std::string>());
  ASSERT_TRUE(bytes.has_value());
  ASSERT_GE(bytes->size(), 48U);
  std::vector<float> floats(12);
  std::memcpy(floats.data(), bytes->data(), 48);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(floats[3 * i], (static_cast<double>(i) - 1.5) * 1.0, 1e-6);  // to the right
    EXPECT_NEAR(floats[3 * i + 1], 1.0, 1e-6);                               // down
    EXPECT_NEAR(floats[3 * i + 2], 2.0, 1e-6);                               // ahead
  }
}

TEST_F(MorseSpace, DestinationsAndHands_MatchMorse) {
  EXPECT_EQ(component("r1.go").stream, StreamDirection::kIn);
  const auto goal =
      std::get<sim::GotoCommand>(command("r1.go", {{"x", 1.0}, {"y", 2.0}, {"z", 3.0}}));
  EXPECT_EQ(goal.speed_mps, 2.0);
  EXPECT_EQ(goal.tolerance_m, 0.5);
  EXPECT_EQ(goal.z_m, 3.0);
  EXPECT_EQ(std::get<sim::GotoCommand>(command("r1.go", {{"x", 1.0}, {"y", 2.0}})).z_m,
            std::nullopt);
  EXPECT_EQ(component("r1.arm.hand").class_name, "Gripper");
  EXPECT_EQ(record("r1.arm.hand", 20)["held"], "");
}

}  // namespace
}  // namespace playerlike::server
