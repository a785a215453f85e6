// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/sight.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"

namespace playpen::grade {
namespace {

using sim::Pose;
using State = Sight::State;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSpeed_mps = 0.2;

/// A floor of 4 m x 3 m with a robot at (0.5, 1) that looks along x. Its laser is 0.035 m before
/// its centre and 0.125 m high, has 682 beams with 0.39589 degrees between them (269.6 degrees) and
/// a range of 5 m.
sim::WorldDescription world_with(const std::string& obstacles, const std::string& members = "",
                                 const std::string& other_robots = "") {
  return sim::load_world_text(R"({"arena": {"size": [4, 3], "obstacles": [)" + obstacles + R"(]},
    "robots": [{"name": "a", "pose": {"x": 0.5, "y": 1})" +
                              members + "}" + other_robots + "]}");
}

/// How far the robot reaches forward of its centre.
double front_m() {
  double front_m = 0.0;
  for (const sim::Vec2& p : sim::s1r_model().footprint) front_m = std::max(front_m, p.x());
  return front_m;
}

Trajectory path_of(const std::string& robot, const std::function<Pose(double)>& X_WB,
                   double end_s) {
  Trajectory path;
  path.robot = robot;
  for (int i = 0; 0.1 * i < end_s; ++i) {
    path.time_s.push_back(0.1 * i);
    path.X_WB.push_back(X_WB(0.1 * i));
    path.v_mps.push_back(0.0);
    path.omega_radps.push_back(0.0);
  }
  return path;
}

Pose forward(double time_s) { return {0.5 + kSpeed_mps * time_s, 1.0, 0.0}; }

/// The sight of a contact of a robot that drives along x.
std::optional<Sight> sight_on_line(const sim::WorldDescription& world, const Contact& contact) {
  return sight_of(world, "a", {path_of("a", forward, contact.time_s + 0.5)}, contact);
}

TEST(Sight, WallAhead_ShownSinceFirstScan) {
  // The front is at the border, x = 4, when 3.5 m less the front's distance are driven.
  const Contact contact{(3.5 - front_m()) / kSpeed_mps, "border", {4.0, 1.0}};
  const auto sight = sight_on_line(world_with(""), contact);
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->state, State::kShown);
  EXPECT_EQ(sight->sensor, "laser");
  // The first scan is after 0.1 s, in which the robot drives 0.02 m.
  EXPECT_NEAR(sight->shown_for_s, contact.time_s - 0.1, 1e-9);
  EXPECT_NEAR(sight->distance_m, 3.5 - front_m() - 0.02, 1e-9);
  EXPECT_NEAR(sight->bearing_rad, 0.0, 1e-9);
  EXPECT_NEAR(sight->field_of_view_rad, 681 * 0.39589 * kDegree, 1e-9);
}

TEST(Sight, BeyondRange_NotShownYet) {
  // A range of 1 m: the laser is 1 m from the border when the centre is at 4 - 1 - 0.035 = 2.965,
  // after 12.325 s. The scan after 12.4 s is the first one that shows it.
  const Contact contact{(3.5 - front_m()) / kSpeed_mps, "border", {4.0, 1.0}};
  const auto sight = sight_on_line(
      world_with("", R"(, "devices": {"laser": {"type": "laser", "range_max": 1}})"), contact);
  ASSERT_TRUE(sight);
  EXPECT_NEAR(sight->shown_for_s, contact.time_s - 12.4, 1e-9);
  EXPECT_NEAR(sight->distance_m, 4.0 - (0.5 + 0.2 * 12.4) - front_m(), 1e-9);
}

TEST(Sight, PlaceBehindCorner_ShownSinceLineIsFree) {
  // The robot drives along y = 1 to (2, 1), turns left, and drives to the border at (2, 3). The
  // line from the laser at (x, 1) to that place passes the block's corner (1.84, 1.2) if
  // x + 0.1 (2 - x) = 1.84, so at x = 1.8222. The robot's centre is then at 1.7872, after 6.436 s.
  const double corner_s = 1.5 / kSpeed_mps;
  const Contact contact{corner_s + (2.0 - front_m()) / kSpeed_mps, "border", {2.0, 3.0}};
  const auto X_WB = [corner_s](double time_s) {
    if (time_s < corner_s + 0.05) return Pose{0.5 + kSpeed_mps * time_s, 1.0, 0.0};
    return Pose{2.0, 1.0 + kSpeed_mps * (time_s - corner_s), 90.0 * kDegree};
  };
  const auto world = world_with(R"({"name": "w", "center": [1.42, 2.0], "size": [0.84, 1.6]})");
  const auto sight = sight_of(world, "a", {path_of("a", X_WB, 20.0)}, contact);
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->state, State::kShown);
  EXPECT_NEAR(sight->shown_for_s, contact.time_s - 6.5, 1e-9);
  // The place is 2 m to the left of a laser at (1.835, 1), and 0.165 m ahead of it.
  EXPECT_NEAR(sight->bearing_rad, std::atan2(2.0, 0.165), 1e-9);
}

TEST(Sight, PlaceOutsideOfView_NeverShown) {
  // The laser has a view of 180 degrees. A block touches the robot's left side, 0.035 m behind it.
  const auto world =
      world_with(R"({"name": "w", "center": [0.5, 1.181], "size": [0.2, 0.2]})",
                 R"(, "devices": {"laser": {"type": "laser", "beams": 181, "resolution_deg": 1}})");
  const Contact contact{5.0, "w", {0.5, 1.081}};
  const auto stand = [](double) { return Pose{0.5, 1.0, 0.0}; };
  const auto sight = sight_of(world, "a", {path_of("a", stand, 6.0)}, contact);
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->state, State::kOutside);
  EXPECT_EQ(sight->shown_for_s, 0.0);
  EXPECT_FALSE(sight->last_shown_s);
  EXPECT_NEAR(sight->bearing_rad, std::atan2(0.081, -0.035), 1e-9);
  EXPECT_EQ(sight_text(*sight),
            "the laser could not see that place: it was 113 degrees to the left, outside of its "
            "180 degrees");
}

TEST(Sight, PlacePassed_SaysWhenLastShown) {
  // The place is 0.085 m to the left of the path. It leaves the view, 134.8 degrees to the left,
  // when it is 0.0844 m behind the laser: the centre is at 2.0494 then, after 7.747 s. In the last
  // scan, after 8 s, it is 0.135 m behind the laser.
  const auto world = world_with(R"({"name": "w", "center": [2, 1.185], "size": [0.2, 0.2]})");
  const auto sight = sight_on_line(world, {8.06, "w", {2.0, 1.085}});
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->state, State::kOutside);
  EXPECT_NEAR(sight->last_shown_s.value_or(0.0), 8.06 - 7.7, 1e-9);
  EXPECT_NEAR(sight->bearing_rad, std::atan2(0.085, -0.135), 1e-9);
  EXPECT_EQ(sight_text(*sight),
            "the laser had not shown that place for the last 0.4 s: it was 148 degrees to the "
            "left, outside of its 270 degrees");
}

TEST(Sight, HeightOfSolid_DecidesWhetherShown) {
  const auto state_at = [](const std::string& height) {
    const auto sight = sight_on_line(
        world_with(R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2], )" + height + "}"),
        {(1.4 - front_m()) / kSpeed_mps, "w", {1.9, 1.0}});
    return sight ? name_of(sight->state) : "none";
  };
  EXPECT_EQ(state_at(R"("height": 0.12)"), "too-low");
  EXPECT_EQ(state_at(R"("height": 0.125)"), "shown");
  EXPECT_EQ(state_at(R"("height": 0.3, "bottom": 0.13)"), "too-high");
}

TEST(Sight, FarSide_Hidden) {
  const auto world = world_with(R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2]})");
  const auto sight = sight_on_line(world, {5.0, "w", {2.1, 1.0}});
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->state, State::kHidden);
}

TEST(Sight, OtherRobot_MustStandStill) {
  const auto world = world_with("", "", R"(, {"name": "b", "pose": {"x": 2, "y": 1}})");
  const Contact contact{(1.5 - 2.0 * front_m()) / kSpeed_mps, "b", {2.0 - front_m(), 1.0}};
  const auto with_other = [&](double speed_mps) {
    const auto drive = [speed_mps](double time_s) {
      return Pose{2.0, 1.0 + speed_mps * time_s, 0};
    };
    return sight_of(world, "a", {path_of("a", forward, 9.0), path_of("b", drive, 9.0)}, contact);
  };
  const auto sight = with_other(0.0);
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->state, State::kShown);
  EXPECT_FALSE(with_other(0.01));
}

TEST(Sight, MovingRobot_HidesPlace) {
  // Robot b, 0.174 m x 0.162 m, crosses the line y = 1 at x = 2 with 0.2 m/s from y = 0.21. It
  // is between the laser and the border until its outline, from y - 0.081 to y + 0.081, is beyond
  // y = 1: after 4.355 s.
  const auto world = world_with("", "", R"(, {"name": "b", "pose": {"x": 2, "y": 0.21}})");
  const Contact contact{(3.5 - front_m()) / kSpeed_mps, "border", {4.0, 1.0}};
  const auto cross = [](double time_s) { return Pose{2.0, 0.21 + kSpeed_mps * time_s, 0.0}; };
  const auto sight =
      sight_of(world, "a", {path_of("a", forward, 18.0), path_of("b", cross, 18.0)}, contact);
  ASSERT_TRUE(sight);
  EXPECT_NEAR(sight->shown_for_s, contact.time_s - 4.4, 1e-9);
  EXPECT_FALSE(sight_of(world, "a", {path_of("a", forward, 18.0)}, contact)) << "where is b?";
}

TEST(Sight, UnknownCircumstances_None) {
  const auto world = world_with(R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2]})");
  const Contact contact{(1.4 - front_m()) / kSpeed_mps, "w", {1.9, 1.0}};
  EXPECT_TRUE(sight_on_line(world, contact));
  EXPECT_FALSE(sight_on_line(world, {contact.time_s, "w", {1.85, 1.0}})) << "it is not there";
  EXPECT_FALSE(sight_on_line(world, {contact.time_s, "v", {1.9, 1.0}})) << "no such obstacle";
  EXPECT_FALSE(sight_on_line(world, {0.05, "w", {1.9, 1.0}})) << "before the first scan";
  EXPECT_FALSE(sight_of(world, "a", {path_of("a", forward, 3.0)}, contact)) << "it ends before";
  EXPECT_FALSE(sight_of(world, "a", {path_of("a", forward, 9.0)}, contact, {{"odometry"}}))
      << "the program may not use the laser";
  EXPECT_TRUE(sight_of(world, "a", {path_of("a", forward, 9.0)}, contact, {{"laser"}}));
}

TEST(Sight, JumpOfRobot_EndsWhatWasShown) {
  // The robot is put 1 m back after 2 s, and drives on.
  const auto world = world_with(R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2]})");
  const auto X_WB = [](double time_s) { return forward(time_s < 2.05 ? time_s : time_s - 5.0); };
  const Contact contact{(1.4 - front_m()) / kSpeed_mps + 5.0, "w", {1.9, 1.0}};
  const auto sight = sight_of(world, "a", {path_of("a", X_WB, 13.0)}, contact);
  ASSERT_TRUE(sight);
  EXPECT_NEAR(sight->shown_for_s, contact.time_s - 2.1, 1e-9);
}

TEST(Sight, SonarWithoutLaser_NearestEchoInCone) {
  // One cone of 30 degrees with a range of 1 m, 0.081 m before the centre: the block's face at
  // x = 1.9 is in range when the centre is at 0.819, after 1.595 s. Another block beside the path
  // is nearer, and in the cone until its farther corner (1.7, 1.15) is not: then the sonar is at x
  // = 1.7 - 0.15 / tan 15 degrees = 1.1402, and the centre at 1.0592, after 2.796 s.
  auto world = world_with(
      R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2]},
         {"name": "v", "center": [1.6, 1.25], "size": [0.2, 0.2]})",
      R"(, "devices": {"ears": {"type": "sonar", "range_max": 1, "mounts": [{"x": 0.081}]}})");
  std::erase_if(world.robots[0].devices, [](const auto& device) { return device.type == "laser"; });
  auto alone = world;
  alone.arena.obstacles.pop_back();
  const Contact contact{(1.4 - front_m()) / kSpeed_mps, "w", {1.9, 1.0}};
  const auto first_shown = [&](const sim::WorldDescription& which) {
    const auto sight = sight_on_line(which, contact);
    return sight && sight->sensor == "ears" ? contact.time_s - sight->shown_for_s : 0.0;
  };
  EXPECT_NEAR(first_shown(alone), 1.6, 1e-9);
  EXPECT_NEAR(first_shown(world), 2.8, 1e-9);
}

TEST(ArenaChange, EventsAndMovables_MayHaveChanged) {
  const std::string still = R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2]})";
  const std::string dynamic =
      R"({"name": "w", "type": "dynamic", "center": [2, 1], "size": [0.2, 0.2]})";
  const std::string pushable = R"({"name": "w", "center": [2, 1], "size": [0.2, 0.2], "mass": 1})";
  playerlike::Report report;
  EXPECT_FALSE(may_have_changed(world_with(still), report, 5.0));
  EXPECT_TRUE(may_have_changed(world_with(pushable), report, 5.0));
  EXPECT_TRUE(may_have_changed(world_with(dynamic), report, 5.0)) << "by the program";
  auto locked = world_with(dynamic);
  locked.simulation.objects_locked = true;
  EXPECT_FALSE(may_have_changed(locked, report, 5.0));
  report.events.emplace();
  EXPECT_FALSE(may_have_changed(world_with(dynamic), report, 5.0));
  report.events->push_back({1, 4.0, "timer", "t", {}, {}, {}});
  EXPECT_FALSE(may_have_changed(locked, report, 5.0));
  report.events->push_back({2, 5.0, "retracted", "w", {}, {}, {}});
  EXPECT_TRUE(may_have_changed(locked, report, 5.0));
  EXPECT_FALSE(may_have_changed(locked, report, 4.9));
  report.events->erase(report.events->begin());
  EXPECT_TRUE(may_have_changed(locked, report, 4.9)) << "earlier events are lost";
}

TEST(SightText, Directions_InWords) {
  Contact contact{31.42, "block_3", {1.2, 2.049}};
  EXPECT_EQ(contact_text(contact), "first hit block_3 at (1.20, 2.05) after 31.4 s");
  contact.sight = Sight{State::kShown, "laser", 1.2, {}, 0.31, 0.0, 4.7};
  EXPECT_EQ(contact_text(contact),
            "first hit block_3 at (1.20, 2.05) after 31.4 s; the laser had shown it for 1.2 s, at "
            "first 0.31 m ahead");
  const auto end_at = [&contact](double degrees) {
    contact.sight->bearing_rad = degrees * kDegree;
    return sight_text(*contact.sight)
        .substr(std::string("the laser had shown it for 1.2 s, at first 0.31 m ").size());
  };
  EXPECT_EQ(end_at(-22.0), "ahead");
  EXPECT_EQ(end_at(-23.0), "ahead to the right");
  EXPECT_EQ(end_at(90.0), "to the left");
  EXPECT_EQ(end_at(157.0), "behind to the left");
  EXPECT_EQ(end_at(180.0), "behind");
  contact.sight->state = State::kOutside;
  EXPECT_EQ(sight_text(*contact.sight),
            "the laser could not see that place: it was behind, outside of its 269 degrees");
  contact.sight->field_of_view_rad = 0.0;
  contact.sight->bearing_rad = -90.0 * kDegree;
  EXPECT_EQ(sight_text(*contact.sight),
            "the laser could not see that place: it was 90 degrees to the right, where no "
            "transducer looks");
  contact.sight->state = State::kShown;
  contact.sight->shown_for_s = kLongestSight_s;
  EXPECT_EQ(sight_text(*contact.sight), "the laser had shown it for a minute or longer");
}

TEST(Sight, ImpossibleTrajectory_IsNoError) {
  const auto world = world_with("");
  const Contact contact{2.0, "border", {4.0, 1.0}};
  for (const double far_m : {1e6, 1e30, 1e300, -1e308}) {
    const Pose X_WB{far_m, far_m, far_m};
    const auto there = [&X_WB](double /*time_s*/) { return X_WB; };
    const auto sight = sight_of(world, "a", {path_of("a", there, 3.0)}, contact);
    EXPECT_TRUE(!sight || sight->state != State::kShown) << far_m;
  }
}

}  // namespace
}  // namespace playpen::grade
