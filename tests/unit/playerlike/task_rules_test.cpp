// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What a task lets a program use, and what a host measures for its grader.
#include "playerlike/host/task_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "host/requests/permissions.h"
#include "host/results/refusal_book.h"
#include "host/results/seen_floor.h"
#include "host/results/travel_meter.h"
#include "host/stepping/command_book.h"
#include "patient_host.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using nlohmann::json;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(TaskRulesText, RoundTrips) {
  EXPECT_EQ(to_text({}), "");
  EXPECT_EQ(parse_task_rules(""), TaskRules{});
  TaskRules rules;
  rules.seen_by = "r1";
  EXPECT_EQ(parse_task_rules(to_text(rules)), rules);
  rules.may_use = MayUse{{"r1"}, {}, {}};
  EXPECT_EQ(parse_task_rules(to_text(rules)), rules);
  rules.may_use = MayUse{{"r1", "r2"}, {{"laser", "motion"}}, {"map", "arena"}};
  EXPECT_EQ(parse_task_rules(to_text(rules)), rules);
  for (const char* text : {"{", "7", "{\"may_use\": 3}", "{\"may_use\": {\"robots\": [1]}}"}) {
    EXPECT_FALSE(parse_task_rules(text)) << text;
  }
}

/// Two robots in a room of 4 m x 4 m with a block in the middle.
sim::WorldDescription two_robots() {
  return sim::load_world_text(R"({
    "arena": {"size": [4, 4], "obstacles": [{"name": "block", "center": [2, 2], "size": [1, 1]}]},
    "simulation": {"time": "lockstep"},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2, "yaw_deg": 90}},
               {"name": "r2", "pose": {"x": 3, "y": 2}}]})");
}

class PermissionsTest : public testing::Test {
 protected:
  void may_use(const MayUse& what) { settings_.grading.rules.may_use = what; }
  enum class Results { kNone, kReport };
  void begin(Results results = Results::kNone) {
    if (results == Results::kReport) settings_.output_folder = folder_.path().string();
    host_ = test::patient_host(two_robots(), settings_);
  }
  [[nodiscard]] static std::string error_of(const auto& action) {
    try {
      action();
    } catch (const SessionError& e) {
      EXPECT_EQ(e.code(), SessionError::Code::kNotAvailable) << e.what();
      return e.what();
    }
    return "";
  }
  [[nodiscard]] DeviceId device(int robot, const std::string& name) const {
    for (const DeviceInfo& info : host_->robots()[static_cast<std::size_t>(robot)].devices) {
      if (info.name == name) return info.id;
    }
    ADD_FAILURE() << name;
    return {-1, -1};
  }
  [[nodiscard]] json report() {
    host_->finish();
    return test_support::read_report(folder_.path());
  }

  TemporaryFolder folder_;
  RunSettings settings_;
  std::shared_ptr<Host> host_;
};

TEST_F(PermissionsTest, NoRules_EverythingAllowed) {
  begin(Results::kReport);
  const auto session = host_->connect(kMorsePort);
  session->request(SubscribeRequest{device(1, "laser")});
  session->send(device(1, "motion"), sim::TwistCommand{{.v_mps = 0.1}});
  static_cast<void>(session->request(WorldMapRequest{0.1}));
  static_cast<void>(session->request(ObjectPoseRequest{"r2"}));
  static_cast<void>(session->request(ArenaRequest{}));
  session->wait();
  const json report = this->report();
  EXPECT_FALSE(report.contains("refused"));
  EXPECT_TRUE(report.at("robots").at(0).at("commanded").is_null());
  EXPECT_EQ(report.at("robots").at(1).at("commanded"),
            json({{"first", 0.0}, {"commands", 1}, {"ports", {kMorsePort}}}));
}

TEST_F(PermissionsTest, OtherRobots_RefusedOnEveryPort) {
  may_use({{"r1"}, {}, {}});
  begin(Results::kReport);
  for (const int port : {kMorsePort, 6666}) {
    const auto session = host_->connect(port);
    EXPECT_THAT(error_of([&] { session->request(SubscribeRequest{device(1, "laser")}); }),
                AllOf(HasSubstr("the device laser of robot r2"), HasSubstr("robots: r1")));
    EXPECT_THAT(
        error_of([&] { session->send(device(1, "motion"), sim::TwistCommand{{.v_mps = 0.1}}); }),
        HasSubstr("the device motion of robot r2"));
    EXPECT_THAT(error_of([&] {
                  static_cast<void>(session->request(TakeChargeRequest{device(1, "motion")}));
                }),
                HasSubstr("r2"))
        << "it would stop the robot";
    EXPECT_THAT(
        error_of([&] { session->open_follower()->send(device(1, "motion"), sim::TwistCommand{}); }),
        HasSubstr("r2"));
  }
  const auto own = host_->connect(6665);
  own->request(SubscribeRequest{device(0, "laser")});
  own->send(device(0, "motion"), sim::TwistCommand{{.v_mps = 0.1}});
  own->wait();
  const json report = this->report();
  EXPECT_THAT(report.at("refused").dump(),
              AllOf(HasSubstr("the device laser of robot r2"), HasSubstr("motion of robot r2")));
  EXPECT_EQ(report.at("refused").size(), 2U) << "each thing once";
  EXPECT_TRUE(report.at("robots").at(1).at("commanded").is_null());
}

// A log holds the readings of all sensors of its port.
TEST_F(PermissionsTest, LogsOfForbiddenSensors_Refused) {
  may_use({{"r1"}, {}, {}});
  begin(Results::kReport);
  LogRequest start;
  start.running = true;
  EXPECT_THAT(error_of([&] { static_cast<void>(host_->connect(6666)->request(start)); }),
              HasSubstr("of robot r2"));
  EXPECT_THAT(error_of([&] { static_cast<void>(host_->connect(kMorsePort)->request(start)); }),
              HasSubstr("of robot r2"));
  static_cast<void>(host_->connect(6665)->request(start));
}

TEST_F(PermissionsTest, WorldData_RefusedUnlessNamed) {
  struct Case {
    const char* word;
    const char* what;
    std::function<void(Session&)> ask;
  };
  const std::vector<Case> cases = {
      {"map", "the map of the world",
       [](Session& s) { static_cast<void>(s.request(WorldMapRequest{0.1})); }},
      {"objects", "poses and properties of objects",
       [](Session& s) { static_cast<void>(s.request(ObjectPoseRequest{"r1"})); }},
      {"objects", "poses and properties of objects",
       [](Session& s) {
         static_cast<void>(s.request(ObjectPropertyRequest{"block", "size"}));
       }},
      {"objects", "poses and properties of objects",
       [](Session& s) {
         s.request(PlaceObjectRequest{"r1", sim::Pose{1.0, 1.0, 0.0}});
       }},
      {"objects", "poses and properties of objects",
       [](Session& s) {
         s.request(SaveStateRequest{"a"});
         s.request(RestoreStateRequest{"a"});
       }},
      {"arena", "the state of the arena",
       [](Session& s) { static_cast<void>(s.request(ArenaRequest{})); }},
      {"arena", "the state of the arena",
       [](Session& s) { static_cast<void>(s.request(ArenaEventsRequest{0})); }},
  };
  for (const Case& c : cases) {
    for (const std::string_view allowed : kWorldData) {
      may_use({{"r1"}, {}, {std::string(allowed)}});
      begin();
      const std::string error = error_of([&] { c.ask(*host_->connect(6665)); });
      if (allowed == c.word) {
        EXPECT_EQ(error, "") << c.what;
      } else {
        EXPECT_THAT(error, HasSubstr(c.what));
      }
    }
  }
}

// A program that may not measure its pose gets it in no other way either.
TEST_F(PermissionsTest, NoPoseDevice_PoseUnknown) {
  may_use({{"r1"}, {{"laser", "odometry", "motion"}}, {"map"}});
  begin();
  EXPECT_EQ(host_->robots()[0].initial_pose, sim::Pose{});
  EXPECT_EQ(host_->robots()[1].initial_pose, sim::Pose{});
  const auto session = host_->connect(6665);
  EXPECT_EQ(session->robots()[0].initial_pose, sim::Pose{});
  const DeviceId motion = device(0, "motion");
  EXPECT_THAT(error_of([&] { session->request(SubscribeRequest{device(0, "pose")}); }),
              HasSubstr("the device pose"));
  EXPECT_THAT(error_of([&] {
                session->send(motion, sim::PositionCommand{{1, 1, 0}});
              }),
              HasSubstr("goals in the frame of the world"));
  EXPECT_THAT(error_of([&] {
                session->send(motion, sim::HeadingCommand{0.1, 0.0, 1.0});
              }),
              HasSubstr("goals in the frame of the world"));
  sim::PositionCommand by_odometry{{1, 1, 0}};
  by_odometry.frame = device(0, "odometry").device;
  session->send(motion, by_odometry);
  by_odometry.frame = device(0, "pose").device;
  EXPECT_THAT(error_of([&] { session->send(motion, by_odometry); }), HasSubstr("the device pose"));
}

TEST_F(PermissionsTest, PoseDevice_WorldFrameKnown) {
  may_use({{"r1"}, {}, {}});
  begin();
  EXPECT_EQ(host_->robots()[0].initial_pose.x_m, 1.0);
  EXPECT_EQ(host_->robots()[1].initial_pose, sim::Pose{}) << "of a robot that is none of its own";
  host_->connect(6665)->send(device(0, "motion"), sim::PositionCommand{{1, 1, 0}});
}

// --- Distance and visited floor

class TravelMeterTest : public testing::Test {
 protected:
  void go_to(double x, double y) {
    const sim::Vec2 place(x, y);
    path_m_ += (place - place_).norm();
    place_ = place;
    meter_.observe(place_, path_m_);
  }

  TravelMeter meter_;
  sim::Vec2 place_ = sim::Vec2::Zero();
  double path_m_ = 0.0;
};

TEST_F(TravelMeterTest, StraightPath_CountsFully) {
  for (int i = 0; i <= 200; ++i) go_to(0.01 * i, 0.1);
  EXPECT_NEAR(meter_.distance_m(), 2.0, 0.02);  // the last move may be incomplete
  EXPECT_EQ(meter_.visited_area_m2(), 9 * 0.0625)
      << "x from 0 to 2 m, and the square that begins there";
}

TEST_F(TravelMeterTest, MovementsOnSpot_DoNotCount) {
  for (int i = 0; i < 1000; ++i) go_to(0.1 + (i % 2 == 0 ? 0.0 : 0.2), 0.1);  // wiggles
  for (int i = 0; i < 1000; ++i) {  // turns in a circle with a diameter of 0.24 m
    const double angle = 0.1 * i;
    go_to(0.1 + 0.12 * std::cos(angle), 0.1 + 0.12 * std::sin(angle));
  }
  EXPECT_EQ(meter_.distance_m(), 0.0);
  EXPECT_LE(meter_.visited_area_m2(), 4 * 0.0625);
}

TEST_F(TravelMeterTest, BackAndForth_CountsAsDistanceButNotFloor) {
  for (int i = 0; i <= 600; ++i) go_to(0.005 * std::abs(i % 200 - 100), 0.1);  // 6 times 0.5 m
  EXPECT_NEAR(meter_.distance_m(), 3.0, 0.3);
  EXPECT_LE(meter_.visited_area_m2(), 3 * 0.0625);
}

TEST_F(TravelMeterTest, Jump_DoesNotCount) {
  go_to(0.1, 0.1);
  meter_.observe({3.0, 3.0}, path_m_);  // the path does not grow
  EXPECT_EQ(meter_.distance_m(), 0.0);
  EXPECT_EQ(meter_.visited_area_m2(), 2 * 0.0625);
}

// --- Seen floor

bool seen_at(const SeenFloor& seen, double x, double y) {
  const auto column = static_cast<std::size_t>(x / seen.cell_size_m());
  const auto row = static_cast<std::size_t>(y / seen.cell_size_m());
  const std::size_t cell = row * static_cast<std::size_t>(seen.width()) + column;
  return (seen.bits()[cell / 8] & (0x80U >> (cell % 8))) != 0;
}

TEST(SeenFloorTest, VisibleToLaserAndUnderRobot) {
  sim::Simulation simulation(two_robots());
  SeenFloor seen(simulation, 0);
  EXPECT_EQ(seen.width(), 200);
  EXPECT_EQ(seen.height(), 200);
  EXPECT_EQ(seen.area_m2(), 0.0);
  simulation.step();
  seen.observe(simulation);
  // Before the first scan: the footprint, an octagon of 0.174 m x 0.162 m without corners.
  EXPECT_TRUE(seen_at(seen, 1.01, 2.01));
  EXPECT_FALSE(seen_at(seen, 1.2, 2.0));
  EXPECT_NEAR(seen.area_m2(), 0.174 * 0.162 - 2 * 0.037 * 0.036, 0.003);
  for (int i = 0; i < 10; ++i) {
    simulation.step();
    seen.observe(simulation);
  }
  // The robot looks north; its laser sees 270 degrees.
  EXPECT_TRUE(seen_at(seen, 1.0, 3.9));
  EXPECT_TRUE(seen_at(seen, 0.1, 2.1));
  EXPECT_TRUE(seen_at(seen, 1.4, 2.1)) << "in front of the block";
  EXPECT_FALSE(seen_at(seen, 2.0, 2.0)) << "inside the block";
  EXPECT_FALSE(seen_at(seen, 3.0, 2.1)) << "behind the block";
  EXPECT_FALSE(seen_at(seen, 1.0, 1.0)) << "behind the robot";
  EXPECT_FALSE(seen_at(seen, 3.3, 0.5)) << "what the other robot sees";
  const double before = seen.area_m2();
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    seen.observe(simulation);
  }
  EXPECT_EQ(seen.area_m2(), before) << "nothing more from the same place";
}

TEST(SeenFloorTest, SonarCones_SeeUpToTheirRange) {
  sim::Simulation simulation(sim::load_world_text(R"({
    "arena": {"size": [4, 4], "obstacles": [{"name": "wall", "center": [2.5, 2], "size": [0.2, 4]}]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2},
                "devices": {"laser": null, "sonar": {"mounts": [{}], "field_of_view_deg": 30}}}]})"));
  SeenFloor seen(simulation, 0);
  for (int i = 0; i < 11; ++i) {
    simulation.step();
    seen.observe(simulation);
  }
  EXPECT_TRUE(seen_at(seen, 2.0, 2.05));
  EXPECT_TRUE(seen_at(seen, 2.0, 2.25)) << "14 degrees off its axis";
  EXPECT_FALSE(seen_at(seen, 2.0, 2.31)) << "17 degrees off its axis";
  EXPECT_FALSE(seen_at(seen, 3.0, 2.0)) << "behind the wall";
}

TEST_F(PermissionsTest, Report_HasSeenFloorOnRequestOnly) {
  begin(Results::kReport);
  EXPECT_FALSE(report().at("robots").at(0).contains("seen"));
  settings_.grading.rules.seen_by = "r2";
  begin(Results::kReport);
  const auto session = host_->connect(6666);
  session->request(SubscribeRequest{device(1, "laser")});
  session->wait();
  const json report = this->report();
  EXPECT_FALSE(report.at("robots").at(0).contains("seen"));
  const json& seen = report.at("robots").at(1).at("seen");
  EXPECT_EQ(seen.at("width"), 200);
  EXPECT_GT(seen.at("area").get<double>(), 1.0);
  EXPECT_EQ(seen.at("cells").get<std::string>().size(), 6668U) << "200 x 200 bits";
}

// --- Commands

TEST(CommandBookTest, RecordsCommandersOfRobots) {
  CommandBook book(2);
  book.note(1, 6666, sim::MotorEnableCommand{true}, 1);
  book.note(1, 6666, sim::SetPoseCommand{}, 2);
  EXPECT_FALSE(book.of(1).first_ns) << "nothing moves";
  book.note(1, 4000, sim::TwistCommand{}, 3);
  book.note(1, 6666, sim::PositionCommand{}, 4);
  EXPECT_EQ(book.of(1).first_ns, 3);
  EXPECT_EQ(book.of(1).count, 2U);
  EXPECT_THAT(book.of(1).ports, ElementsAre(4000, 6666));
  EXPECT_EQ(book.of(0).count, 0U);
}

}  // namespace
}  // namespace playerlike
