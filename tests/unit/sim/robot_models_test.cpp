// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Robot models: those shipped with Playpen, and files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/devices/bumper.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

WorldDescription world_with(const std::string& model) {
  return load_world_text(
      R"({"arena": {"size": [6, 6], "border_height": 1}, "robots": [{"model": ")" + model +
      R"(", "pose": {"x": 3, "y": 3, "yaw_deg": 0}}]})");
}

const RobotModel& model_of(const WorldDescription& world) {
  return *find_robot_model(world, world.robots.at(0).model);
}

template <typename Params>
Params settings_of(const WorldDescription& world, const std::string& device) {
  for (const DeviceDescription& d : world.robots.at(0).devices) {
    if (d.name == device) return std::any_cast<Params>(d.params);
  }
  ADD_FAILURE() << "no " << device;
  return {};
}

bool lies_within(const Polygon& footprint, const Vec2& p) {
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vec2 edge = footprint[(i + 1) % footprint.size()] - footprint[i];
    const Vec2 to = p - footprint[i];
    if (edge.x() * to.y() - edge.y() * to.x() < -1e-9) return false;
  }
  return true;
}

TEST(ShippedModels, MatchFilesAndValid) {
  std::vector<std::string> names;
  for (const ShippedModel& shipped : shipped_models()) {
    names.emplace_back(shipped.name);
    SCOPED_TRACE(shipped.name);
    std::ifstream file(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/models/" + shipped.name +
                       ".json");
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(shipped.text, text.str());

    const WorldDescription world = world_with(shipped.name);
    const RobotModel& model = model_of(world);
    EXPECT_EQ(model.name, shipped.name);
    EXPECT_FALSE(model.description.empty());
    EXPECT_TRUE(lies_within(model.footprint, Vec2::Zero()));
    // Programs for Player expect odometry at index 0; the S1R has the arena's localisation there.
    if (!model.name.starts_with("s1r")) {
      EXPECT_THAT(world.robots[0].interfaces.at("position2d"), ElementsAre("odometry", "pose"));
    }
    Simulation simulation(world);
    for (int i = 0; i < 100; ++i) simulation.step();
    EXPECT_EQ(simulation.body(0).X_WB, (Pose{3.0, 3.0, 0.0}));
  }
  EXPECT_THAT(names, ElementsAre("bigbob", "car", "epuck", "omni", "pioneer2dx", "pioneer3dx",
                                 "roomba", "s1r_full", "s1r_sonar", "scorpion"));
}

// Robots turn about their axles, which may differ from the centres of their bodies.
TEST(ShippedModels, TurnAndArcAboutAxles) {
  for (const char* name : {"pioneer2dx", "pioneer3dx", "epuck", "omni", "roomba", "scorpion"}) {
    SCOPED_TRACE(name);
    Simulation simulation(world_with(name));
    const int motion = simulation.find_device(0, "motion").value();
    ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.omega_radps = 2.0}}));
    for (int i = 0; i < 300; ++i) simulation.step();
    EXPECT_NEAR(simulation.body(0).X_WB.x_m, 3.0, 1e-9);
    EXPECT_NEAR(simulation.body(0).X_WB.y_m, 3.0, 1e-9);
    ASSERT_FALSE(simulation.set_robot_dynamics(0, false));
    ASSERT_FALSE(simulation.set_robot_dynamics(0, true));
    ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.1, .omega_radps = 0.5}}));
    for (int i = 0; i < 300; ++i) simulation.step();
    const int odometry = simulation.find_device(0, "odometry").value();
    const auto believed = simulation.device(0, odometry).pose_estimate().value();
    EXPECT_NEAR(believed.x_m, simulation.body(0).X_WB.x_m - 3.0, 1e-9);
    EXPECT_NEAR(believed.y_m, simulation.body(0).X_WB.y_m - 3.0, 1e-9);
  }
}

TEST(Pioneers, MatchDataSheets) {
  const std::vector<double> angles_deg = {90,  50,   30,   10,   -10, -30, -50, -90,
                                          -90, -130, -150, -170, 170, 150, 130, 90};
  for (const char* name : {"pioneer2dx", "pioneer3dx"}) {
    SCOPED_TRACE(name);
    const WorldDescription world = world_with(name);
    const RobotModel& model = model_of(world);
    const auto sonar = settings_of<SonarParams>(world, "sonar");
    ASSERT_EQ(sonar.X_BS.size(), angles_deg.size());
    for (std::size_t i = 0; i < angles_deg.size(); ++i) {
      EXPECT_NEAR(sonar.X_BS[i].yaw_rad, angles_deg[i] * M_PI / 180.0, 1e-9) << i;
      EXPECT_TRUE(lies_within(model.footprint, sonar.X_BS[i].position())) << i;
    }
    EXPECT_DOUBLE_EQ(sonar.range_max_m, 5.0);
    const auto laser = settings_of<LaserParams>(world, "laser");
    EXPECT_EQ(laser.beam_count, 181);
    EXPECT_NEAR(laser.resolution_rad * (laser.beam_count - 1), M_PI, 1e-9);
    EXPECT_DOUBLE_EQ(laser.range_max_m, 8.0);
    EXPECT_LT(laser.height_m, model.height_m);  // so that Pioneers see one another
    EXPECT_EQ(laser.size_m, Vec2(0.156, 0.155));
    EXPECT_DOUBLE_EQ(laser.size_height_m, 0.21);
  }
  for (const char* name : {"pioneer2dx", "pioneer3dx"}) {
    const auto bumper = settings_of<BumperParams>(world_with(name), "bumper");
    ASSERT_EQ(bumper.segments.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {  // the first five are ahead of the centre
      EXPECT_EQ(bumper.segments[i].X_BS.x_m > 0.0, i < 5) << i;
    }
  }
  const RobotModel model = model_of(world_with("pioneer3dx"));
  Vec2 low = model.footprint[0];
  Vec2 high = low;
  for (const Vec2& v : model.footprint) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  EXPECT_NEAR(high.x() - low.x(), 0.455, 1e-9);
  EXPECT_NEAR(high.y() - low.y(), 0.381, 1e-9);
}

TEST(Pioneers, LaserFineMode_Has361Beams) {
  const WorldDescription world = load_world_text(
      R"({"arena": {"size": [6, 6]}, "robots": [{"model": "pioneer2dx",
          "devices": {"laser": {"beams": 361, "resolution_deg": 0.5}}}]})");
  const auto laser = settings_of<LaserParams>(world, "laser");
  EXPECT_EQ(laser.beam_count, 361);
  EXPECT_NEAR(laser.resolution_rad * 360.0, M_PI, 1e-9);
  EXPECT_DOUBLE_EQ(laser.range_max_m, 8.0);  // the model's value, not the type's
}

/// Which of a Roomba's two bumpers are pressed when it drives against a wall with this heading.
std::vector<std::uint8_t> pressed_by_wall_ahead(const std::string& yaw_deg) {
  Simulation simulation(load_world_text(
      R"({"arena": {"size": [2, 6], "border_height": 1}, "robots": [
          {"model": "roomba", "pose": {"x": 1.5, "y": 3, "yaw_deg": )" +
      yaw_deg + "}}]}"));
  static_cast<void>(simulation.apply({0, simulation.find_device(0, "motion").value()},
                                     TwistCommand{{.v_mps = 0.5}}));
  const int bumper = simulation.find_device(0, "bumper").value();
  for (int i = 0; i < 300; ++i) {
    simulation.step();
    const auto& reading = dynamic_cast<const Bumper&>(simulation.device(0, bumper)).reading();
    if (reading.pressed != std::vector<std::uint8_t>{0, 0}) return reading.pressed;
  }
  return {};
}

TEST(Roomba, Wall_PressesBumpersOnItsSide) {
  EXPECT_THAT(pressed_by_wall_ahead("0"), ElementsAre(1, 1));
  EXPECT_THAT(pressed_by_wall_ahead("15"), ElementsAre(0, 1));  // the wall is on its right
  EXPECT_THAT(pressed_by_wall_ahead("-15"), ElementsAre(1, 0));
  EXPECT_THAT(pressed_by_wall_ahead("60"), ElementsAre(0, 1));
  EXPECT_THAT(pressed_by_wall_ahead("-60"), ElementsAre(1, 0));
}

TEST(Roomba, Laser_Has361BeamsAcrossHalfCircle) {
  const auto laser = settings_of<LaserParams>(world_with("roomba"), "laser");
  EXPECT_EQ(laser.beam_count, 361);
  EXPECT_NEAR(laser.resolution_rad * 360.0, M_PI, 1e-9);
}

// A file cannot refer to s1r and change parts of it, so the repeated parts must stay equal.
// The poses that the Scorpion's driver for Player ("ersp") reports, in the order of its header
// scorpion.h; its angles in radians are -1.134, 1.134, 0, -0.611, 0.611, 0.175, -0.262, ...
TEST(Scorpion, Has13RangersOfPlayerDriver) {
  const WorldDescription world = world_with("scorpion");
  const auto rangers = settings_of<InfraredParams>(world, "infrared");
  const std::vector<Pose> expected = {
      {0.126, 0.092, -1.134},   {0.126, -0.092, 1.134},   {0.049, 0.0, 0.0},
      {0.092, 0.064, -0.611},   {0.092, -0.064, 0.611},   {0.016, -0.173, 0.175},
      {-0.065, -0.169, -0.262}, {-0.065, 0.169, 0.262},   {0.016, 0.173, -0.175},
      {-0.172, 0.019, 1.571},   {-0.172, -0.019, -1.571}, {-0.077, 0.069, 3.054},
      {-0.077, -0.069, -3.054}};
  ASSERT_EQ(rangers.X_BS.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_DOUBLE_EQ(rangers.X_BS[i].x_m, expected[i].x_m) << i;
    EXPECT_DOUBLE_EQ(rangers.X_BS[i].y_m, expected[i].y_m) << i;
    EXPECT_NEAR(rangers.X_BS[i].yaw_rad, expected[i].yaw_rad, 0.001) << i;  // its rounding
    EXPECT_TRUE(lies_within(model_of(world).footprint, rangers.X_BS[i].position())) << i;
  }
  EXPECT_DOUBLE_EQ(rangers.range_max_m, 0.8);
}

TEST(S1rModels, DifferFromS1rInDevicesOnly) {
  const RobotModel s1r = s1r_model();
  for (const char* name : {"s1r_full", "s1r_sonar"}) {
    SCOPED_TRACE(name);
    const WorldDescription world = world_with(name);
    const RobotModel& model = model_of(world);
    EXPECT_EQ(model.footprint, s1r.footprint);
    EXPECT_EQ(model.height_m, s1r.height_m);
    EXPECT_EQ(model.mass_kg, s1r.mass_kg);
    EXPECT_EQ(model.drive.kind, s1r.drive.kind);
    EXPECT_EQ(model.drive.wheel_radius_m, s1r.drive.wheel_radius_m);
    EXPECT_EQ(model.drive.wheel_separation_m, s1r.drive.wheel_separation_m);
    EXPECT_EQ(model.max_speed_mps, s1r.max_speed_mps);
    EXPECT_NEAR(model.max_turn_rate_radps, s1r.max_turn_rate_radps, 1e-4);
    EXPECT_TRUE(world.robots[0].interfaces.empty());
  }
}

constexpr const char* kModel = R"({
  "name": "box",
  "footprint": [[-0.1, 0.2], [0.3, 0.2], [0.3, -0.2], [-0.1, -0.2]],
  "drive": {"kind": "car", "wheelbase": 0.25, "max_steering_deg": 45, "commands": "steering"},
  "max_speed": 1.5,
  "devices": {"motion": {"max_speed": 1.5}, "eye": {"type": "laser", "beams": 9}}
})";

TEST(ModelFiles, FoundBesideWorldFile) {
  test_support::TemporaryFolder folder;
  folder.write("robots/box.json", kModel);
  const std::string file = folder.write(
      "room.json", R"({"arena": {"size": [4, 4]}, "robots": [{"model": "robots/box.json"},
                       {"model": "robots/box.json", "devices": {"eye": {"beams": 5}}}]})");
  const WorldDescription world = load_world(file);
  ASSERT_EQ(world.models.size(), 1U);
  const RobotModel& model = model_of(world);
  EXPECT_EQ(model.name, "box");
  EXPECT_EQ(model.drive.kind, DriveKind::kCar);
  EXPECT_DOUBLE_EQ(model.drive.wheelbase_m, 0.25);
  EXPECT_NEAR(model.drive.max_steering_rad, M_PI / 4.0, 1e-12);
  EXPECT_TRUE(model.drive.steering_commands);
  EXPECT_DOUBLE_EQ(model.max_speed_mps, 1.5);
  EXPECT_EQ(model.footprint.size(), 4U);  // given clockwise, kept counter-clockwise
  EXPECT_LT(model.footprint[0].y(), 0.0);
  EXPECT_EQ(settings_of<LaserParams>(world, "eye").beam_count, 9);
  EXPECT_EQ(std::any_cast<LaserParams>(world.robots[1].devices.at(0).params).beam_count, 5);
  Simulation simulation(world);
  simulation.step();
}

std::vector<ConfigIssue> issues_of(const std::string& model) {
  test_support::TemporaryFolder folder;
  folder.write("bad.json", model);
  try {
    static_cast<void>(load_world(folder.write(
        "room.json",
        "{\"robots\": [\n{\"model\": \"./bad.json\"},\n{\"model\": \"./bad.json\"}]}")));
  } catch (const ConfigError& error) {
    return error.issues();
  }
  return {};
}

TEST(ModelFiles, Errors_ReportedOnceWithTheirLines) {
  const std::vector<ConfigIssue> issues = issues_of(
      "{\"name\": \"bad\",\n\"footprint\": [[0, 0], [1, 0], [1, 1]],\n\"hight\": 2,\n"
      "\"devices\": {\"laser\": {\"beams\": 0}}}");
  ASSERT_EQ(issues.size(), 2U);
  EXPECT_EQ(issues[0].id, "world/unknown-key");
  EXPECT_THAT(issues[0].file, HasSubstr("bad.json"));
  EXPECT_EQ(issues[0].line, 3);
  EXPECT_EQ(issues[1].id, "world/out-of-range");
  EXPECT_EQ(issues[1].pointer, "/devices/laser/beams");
  EXPECT_EQ(issues[1].line, 4);
}

TEST(ModelFiles, ReadAlone) {
  for (const ShippedModel& model : shipped_models()) {
    const std::string file =
        std::string(PLAYPEN_SOURCE_DIR) + "/worlds/models/" + model.name + ".json";
    const RobotModel read = load_model(file);
    EXPECT_EQ(read.name, model.name);
    EXPECT_FALSE(read.description.empty()) << model.name;
  }
  const test_support::TemporaryFolder folder;
  const std::string bad = folder.write("bad.json", "{\n\"name\": \"bad\",\n\"mass\": -1}");
  try {
    static_cast<void>(load_model(bad));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 2U) << error.what();  // the mass, and no footprint
    EXPECT_EQ(error.issues()[0].file, bad);
    EXPECT_THAT(error.what(), testing::HasSubstr("/mass"));
    EXPECT_THAT(error.what(), testing::HasSubstr("footprint"));
  }
  EXPECT_THROW(static_cast<void>(load_model(folder / "none.json")), ConfigError);
}

TEST(ModelFiles, DeviceFile_NotRead) {
  try {
    static_cast<void>(load_world_text(R"({"robots": [{"model": "/dev/zero"}]})"));
    FAIL() << "a device was read";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U);
    EXPECT_EQ(error.issues()[0].id, "world/model-unreadable");
    EXPECT_EQ(error.issues()[0].pointer, "/robots/0/model");
  }
}

TEST(ModelFiles, InvalidOutline_Refused) {
  const auto id_of = [](const std::string& footprint) {
    const auto issues = issues_of(R"({"name": "bad", "footprint": )" + footprint + "}");
    return issues.size() == 1 ? issues[0].id : std::to_string(issues.size()) + " issues";
  };
  EXPECT_EQ(id_of("[[0, 0], [1, 0]]"), "world/bad-footprint");
  EXPECT_EQ(id_of("[[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2]]"), "world/bad-footprint");  // notch
  EXPECT_EQ(id_of("[[0, 0], [1, 1], [1, 0], [0, 1]]"), "world/bad-footprint");  // crossing
  EXPECT_EQ(id_of("[[0, 0], [1, 0], [2, 0], [1, 1]]"), "world/bad-footprint");  // straight
  EXPECT_EQ(id_of("[[0, 0], [0.01, 0], [0.01, 0.005]]"), "world/bad-footprint");
  EXPECT_EQ(id_of("[[0, 0], [1, 0], [1, \"1\"]]"), "world/wrong-type");
  EXPECT_EQ(id_of("3"), "world/wrong-type");
}

}  // namespace
}  // namespace sim
