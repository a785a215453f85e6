// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Robots that mirror real ones. The real robot is a FakeSession, so a test says what it measures.
#include "host/mirror/mirror.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stop_token>
#include <string>
#include <thread>

#include "fake_session.h"
#include "host/mirror/ghost.h"
#include "host/mirror/scan_difference.h"
#include "patience.h"
#include "playerlike/host/host.h"
#include "playerlike/server/server.h"
#include "raw_client.h"
#include "sim/core/error.h"
#include "sim/devices/amcl.h"
#include "sim/devices/camera.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

using test::FakeWorld;
using testing::AllOf;
using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::ThrowsMessage;

/// Waits until a condition holds, at most test_support::patience().
[[nodiscard]] bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + test_support::patience();
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// A floor of 4 m x 4 m with an S1R "r1" at (1, 2) that mirrors a real robot.
/// @param real  further keys of its "real", with a comma in front.
std::string world_text(const std::string& real = "", const std::string& more = "") {
  return R"({"name": "mirrored", "arena": {"size": [4, 4]}, "robots": [
    {"name": "r1", "pose": {"x": 1, "y": 2}, "real": {"server": "tcp://robot:4000")" +
         real + "}}]" + more + "}";
}

std::shared_ptr<FakeWorld> make_real_robot() {
  auto real = test::make_fake_world();
  real->over_when_empty = false;
  return real;
}

OpenRealRobot opens(const std::shared_ptr<FakeWorld>& real) {
  return [real](const RealRobotPlace&) { return test::fake_session(real); };
}

class MirrorTest : public testing::Test {
 protected:
  void open(const std::string& text) {
    simulation_.emplace(sim::load_world_text(text));
    robots_ = describe_robots(*simulation_);
    mirror_ = Mirror::open(*simulation_, robots_, opens(real_),
                           [this](const std::string& warning) { warnings_.push_back(warning); });
    ASSERT_NE(mirror_, nullptr);
  }
  /// The real robot measures something, and the mirror gets it before the next step.
  void measures(FakeWorld::Round round) {
    real_->add_round(std::move(round));
    ASSERT_TRUE(eventually([this] {
      mirror_->before_step();
      return !mirror_->readings().empty();
    }));
  }
  void step(int count = 1) {
    for (int i = 0; i < count; ++i) {
      simulation_->step();
      for (const Mirror::Loss& loss : mirror_->after_step()) losses_.push_back(loss.text);
    }
  }
  [[nodiscard]] DeviceId device(const std::string& name) const {
    return {0, *simulation_->find_device(0, name)};
  }
  [[nodiscard]] sim::Pose pose() const { return simulation_->body(0).X_WB; }
  [[nodiscard]] std::vector<FakeWorld::Sent> sent() const {
    const std::lock_guard lock(real_->mutex);
    return real_->sent;
  }
  [[nodiscard]] MirrorReport report() const { return mirror_->report().at(0); }

  std::shared_ptr<FakeWorld> real_ = make_real_robot();
  std::optional<sim::Simulation> simulation_;
  std::vector<RobotInfo> robots_;
  std::vector<std::string> warnings_;
  std::vector<std::string> losses_;
  std::unique_ptr<Mirror> mirror_;
};

TEST_F(MirrorTest, WorldWithoutRealRobots_NoMirror) {
  sim::Simulation plain(sim::load_world_text("{}"));
  EXPECT_EQ(Mirror::open(plain, describe_robots(plain), opens(real_), {}), nullptr);
}

TEST_F(MirrorTest, Robot_FollowsPoseOfRealRobot) {
  // The real robot's frame has its origin at (1, 2) and is turned by 90 degrees: its point
  // (0.5, 0.2) is (1 - 0.2, 2 + 0.5) in the world.
  open(world_text(R"(, "offset": {"x": 1, "y": 2, "yaw_deg": 90})"));
  measures({{test::kPose, test::pose_reading(7.0, {0.5, 0.2, 0.3}, {0.4, 0.1, 0.0})}});
  EXPECT_NEAR(pose().x_m, 0.8, 1e-12);
  EXPECT_NEAR(pose().y_m, 2.5, 1e-12);
  EXPECT_NEAR(pose().yaw_rad, 0.3 + std::numbers::pi / 2, 1e-12);
  ASSERT_TRUE(mirror_->twist_of(0).has_value());
  EXPECT_EQ(mirror_->twist_of(0)->v_mps, 0.4);
  // It stays there: commands to the simulated motors do not move it.
  ASSERT_EQ(simulation_->apply(device("motion"), sim::TwistCommand{{.v_mps = 0.5}}), std::nullopt);
  step(50);
  EXPECT_NEAR(pose().x_m, 0.8, 1e-12);
  EXPECT_EQ(simulation_->statistics(0).path_length_m, 0.0) << "the first jump is no path";
  measures({{test::kPose, test::pose_reading(7.1, {0.6, 0.2, 0.3})}});
  step();
  EXPECT_NEAR(simulation_->statistics(0).path_length_m, 0.1, 1e-12);
}

TEST_F(MirrorTest, OtherDevice_MayProvidePose) {
  open(world_text(R"(, "pose": "position2d:1")"));
  measures({{test::kOdometry, test::pose_reading(1.0, {3.0, 3.0, 0.0})}});
  EXPECT_NEAR(pose().x_m, 3.0, 1e-12);
}

// A real robot that localises itself gives several hypotheses; the most likely one counts.
TEST_F(MirrorTest, Localisation_MayProvidePose) {
  for (DeviceInfo& device : real_->robots[0].devices) {
    if (device.name == "pose") device.type = "amcl";
  }
  open(world_text(R"(, "pose": "localize:0", "offset": {"x": 1, "y": 2, "yaw_deg": 90})"));
  const auto localised = std::make_shared<sim::AmclReading>();
  localised->time_ns = sim::from_seconds(3.0);
  localised->sequence = 1;
  localised->hypotheses = {{{0.5, 0.2, 0.3}, {{0.01, 0.01, 0.01}, {}}, 0.7},
                           {{-2.0, 1.0, 0.0}, {{0.01, 0.01, 0.01}, {}}, 0.3}};
  real_->add_round({{test::kPose, localised}});
  EXPECT_TRUE(eventually([this] {
    mirror_->before_step();
    return std::abs(pose().x_m - 0.8) < 1e-12;
  }));
  EXPECT_NEAR(pose().y_m, 2.5, 1e-12);
  EXPECT_NEAR(pose().yaw_rad, 0.3 + std::numbers::pi / 2, 1e-12);
  // A localisation without hypotheses moves nothing.
  const auto lost = std::make_shared<sim::AmclReading>();
  lost->sequence = 2;
  real_->add_round({{test::kPose, lost}});
  measures({{test::kOdometry, test::pose_reading(3.2, {})}});
  EXPECT_NEAR(pose().x_m, 0.8, 1e-12);
}

TEST_F(MirrorTest, RealPose_OverridesWalls) {
  open(world_text());
  // An S1R reaches 0.087 m ahead of its axle, so it overlaps the border at x = 4.
  measures({{test::kPose, test::pose_reading(1.0, {3.97, 2.0, 0.0})}});
  step(20);
  EXPECT_NEAR(pose().x_m, 3.97, 1e-12);
  EXPECT_EQ(simulation_->statistics(0).collisions, 0);
  EXPECT_THAT(simulation_->collisions(), IsEmpty());
}

TEST_F(MirrorTest, InvalidPoses_Ignored) {
  open(world_text());
  measures({{test::kPose, test::pose_reading(1.0, {std::nan(""), 2.0, 0.0})}});
  EXPECT_EQ(pose().x_m, 1.0);
  EXPECT_THAT(warnings_, Contains(HasSubstr("the pose of the real robot of r1 is invalid")));
}

TEST_F(MirrorTest, RealReadings_ReplaceSimulatedOnes) {
  open(world_text());
  for (const char* name : {"laser", "odometry", "pose"}) {
    EXPECT_TRUE(mirror_->replaces(device(name))) << name;
    const std::lock_guard lock(real_->mutex);
    EXPECT_EQ(real_->subscriptions[real_->robots[0].devices.at(0).id.device], 1);
  }
  EXPECT_FALSE(mirror_->replaces(device("motion")));
  const auto scan = test::scan(1.0, {1, 2, 3, 4, 5});
  measures({{test::kLaser, scan}});
  ASSERT_THAT(mirror_->readings(), SizeIs(1));
  EXPECT_EQ(mirror_->readings()[0].first, device("laser"));
  EXPECT_EQ(mirror_->readings()[0].second, scan) << "shared, not copied";
  mirror_->before_step();
  EXPECT_THAT(mirror_->readings(), IsEmpty());
}

TEST_F(MirrorTest, DevicesMissingOnRealRobot_StaySimulated) {
  std::erase_if(real_->robots[0].devices, [](const DeviceInfo& d) { return d.type == "laser"; });
  open(world_text());
  EXPECT_FALSE(mirror_->replaces(device("laser")));
  EXPECT_TRUE(mirror_->replaces(device("pose")));
  EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("no counterpart of: laser;"),
                                           HasSubstr("stay simulated"))));
  EXPECT_TRUE(mirror_->take_command(device("motion"), sim::TwistCommand{}));
  EXPECT_FALSE(mirror_->take_command(device("laser"), sim::TwistCommand{}));
}

TEST_F(MirrorTest, ReadingsOfOtherType_IgnoredWithWarning) {
  open(world_text());
  real_->add_round({{test::kLaser, test::pose_reading(1.0, {})}});
  measures({{test::kOdometry, test::pose_reading(1.1, {})}});
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("gives other readings than its device laser")));
}

TEST_F(MirrorTest, Commands_SentToRealRobot) {
  open(world_text());
  EXPECT_TRUE(mirror_->take_command(device("motion"),
                                    sim::TwistCommand{{.v_mps = 0.25, .omega_radps = 0.5}}));
  EXPECT_TRUE(eventually([this] { return !sent().empty(); }));
  EXPECT_EQ(sent()[0].first, test::kMotion);
  EXPECT_EQ(std::get<sim::TwistCommand>(sent()[0].second).twist.v_mps, 0.25);
}

// A goal in the world's frame W is sent in the frame F of the real robot's poses.
TEST_F(MirrorTest, WorldGoals_SentInFrameOfRealRobot) {
  open(world_text(R"(, "offset": {"x": 1, "y": 2, "yaw_deg": 90})"));
  EXPECT_TRUE(mirror_->take_command(device("motion"), sim::PositionCommand{{0.8, 2.5, 0.0}}));
  EXPECT_TRUE(eventually([this] { return !sent().empty(); }));
  const auto goal = std::get<sim::PositionCommand>(sent()[0].second);
  EXPECT_NEAR(goal.goal.x_m, 0.5, 1e-12);
  EXPECT_NEAR(goal.goal.y_m, 0.2, 1e-12);
  EXPECT_EQ(goal.frame, test::kPose.device);
}

TEST_F(MirrorTest, EndOfRun_StopsRealRobot) {
  open(world_text());
  mirror_->stop();
  ASSERT_FALSE(sent().empty());
  EXPECT_EQ(sent().back().first, test::kMotion);
  EXPECT_EQ(std::get<sim::TwistCommand>(sent().back().second).twist, sim::Twist{});
  EXPECT_TRUE(report().connected) << "the end of the run is no loss";
}

TEST_F(MirrorTest, Pause_StopsRealRobot) {
  open(world_text());
  EXPECT_TRUE(mirror_->take_command(device("motion"), sim::TwistCommand{{.v_mps = 0.25}}));
  EXPECT_TRUE(eventually([this] { return !sent().empty(); }));
  mirror_->halt();
  EXPECT_TRUE(eventually([this] { return sent().size() == 2; }));
  EXPECT_EQ(std::get<sim::TwistCommand>(sent()[1].second).twist, sim::Twist{});
}

TEST_F(MirrorTest, LostConnection_ReportedOnceAndEndsCommands) {
  open(world_text());
  measures({{test::kPose, test::pose_reading(1.0, {2.0, 2.0, 0.0})}});
  step();
  EXPECT_THAT(losses_, IsEmpty());
  {
    const std::lock_guard lock(real_->mutex);
    real_->closed = true;
    real_->changed.notify_all();
  }
  EXPECT_TRUE(eventually([this] {
    step();
    return !losses_.empty();
  }));
  step(3);
  EXPECT_THAT(losses_, ElementsAre(AllOf(HasSubstr("the real robot of r1 at tcp://robot:4000"),
                                         HasSubstr("the connection is closed"))));
  EXPECT_EQ(mirror_->loss_of(device("pose")), losses_[0]);
  EXPECT_EQ(mirror_->loss_of(device("pen")), "");
  EXPECT_TRUE(mirror_->take_command(device("motion"), sim::TwistCommand{{.v_mps = 0.2}}));
  mirror_->stop();
  EXPECT_THAT(sent(), IsEmpty());
  EXPECT_NEAR(pose().x_m, 2.0, 1e-12);
  EXPECT_FALSE(report().connected);
  EXPECT_THAT(report().lost.value().reason, HasSubstr("is lost"));
}

// --- Who is in charge of the real robot

TEST_F(MirrorTest, Heartbeat_SentToServer) {
  open(world_text(R"(, "watchdog": 0.05)"));
  EXPECT_TRUE(eventually([this] {
    const std::lock_guard lock(real_->mutex);
    return real_->charges >= 5;
  }));
  EXPECT_THAT(real_->in_charge, HasSubstr("the mirror on "));
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(MirrorTest, RobotOfOtherMirror_RefusedUnlessTakenOver) {
  real_->in_charge = "the mirror on lab7, process 12";
  EXPECT_THAT([&] { open(world_text()); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("/robots/0/real"), HasSubstr("lab7, process 12 is in charge"))));
  open(world_text(R"(, "take_over": true)"));
  const std::lock_guard lock(real_->mutex);
  EXPECT_THAT(real_->in_charge, Not(HasSubstr("lab7")));
}

TEST_F(MirrorTest, TakenOverRobot_ReportedLost) {
  open(world_text(R"(, "watchdog": 0.05)"));
  {
    const std::lock_guard lock(real_->mutex);
    real_->in_charge = "another mirror";
  }
  EXPECT_TRUE(eventually([this] {
    step();
    return !losses_.empty();
  }));
  EXPECT_THAT(losses_, ElementsAre(HasSubstr("another mirror is in charge")));
}

TEST_F(MirrorTest, WatchdogStop_Reported) {
  open(world_text(R"(, "watchdog": 0.05)"));
  {
    const std::lock_guard lock(real_->mutex);
    real_->stopped = true;
  }
  EXPECT_TRUE(eventually([this] {
    step();
    return !warnings_.empty();
  }));
  EXPECT_THAT(warnings_[0], HasSubstr("has stopped it, since it had heard nothing for 0.05 s"));
}

TEST_F(MirrorTest, ServerWithoutWatchdog_NamedAtStart) {
  real_->watches = false;
  open(world_text(R"(, "watchdog": 0.05)"));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("if the network fails, the robot drives on")));
}

TEST_F(MirrorTest, LostConnection_ReconnectsIfWorldAllows) {
  open(world_text(R"(, "on_lost": "reconnect")"));
  const auto set_closed = [this](bool closed) {
    const std::lock_guard lock(real_->mutex);
    real_->closed = closed;
    real_->changed.notify_all();
  };
  set_closed(true);
  EXPECT_TRUE(eventually([this] {
    step();
    return !losses_.empty();
  }));
  EXPECT_TRUE(mirror_->has_lost(0));
  EXPECT_EQ(mirror_->loss_of(device("pose")), "") << "nobody waits in vain";
  EXPECT_THAT(mirror_->take_command(device("motion"), sim::TwistCommand{{.v_mps = 0.2}}),
              testing::Optional(testing::Optional(HasSubstr("is lost"))));
  EXPECT_FALSE(report().connected);
  set_closed(false);
  measures({{test::kPose, test::pose_reading(1.0, {2.0, 2.0, 0.0})}});
  EXPECT_FALSE(mirror_->has_lost(0));
  EXPECT_THAT(warnings_, Contains(HasSubstr("is there again")));
  EXPECT_TRUE(report().connected);
  EXPECT_EQ(report().reconnections, 1U);
  EXPECT_THAT(sent(), IsEmpty()) << "a new command must set it in motion";
}

// --- What cannot reach the real robot is refused

TEST_F(MirrorTest, DevicesMissingOnRealRobot_DoNotMoveIt) {
  open(world_text(R"(}, "devices": {"go": {"type": "waypoint"}, "jump": {"type": "teleport"})"));
  const auto refusal = [this](const char* name, const sim::Command& command) {
    const auto executed = mirror_->take_command(device(name), command);
    return executed ? executed->value_or("done") : "simulated";
  };
  EXPECT_THAT(refusal("go", sim::GotoCommand{{3.0, 3.0}, 0.1, 0.2}),
              HasSubstr("no counterpart of its waypoint go"));
  EXPECT_THAT(refusal("jump", sim::PlaceCommand{}), HasSubstr("teleport jump"));
  EXPECT_EQ(refusal("motion", sim::TwistCommand{}), "done");
  EXPECT_THAT(refusal("motion", sim::HeadingCommand{0.1, 0.0, 0.0, device("pen").device}),
              HasSubstr("names a frame"));
}

TEST_F(MirrorTest, DisabledDevices_TakeNoCommandsAndGiveNoReadings) {
  open(world_text());
  simulation_->set_active(device("motion"), false);
  EXPECT_THAT(mirror_->take_command(device("motion"), sim::TwistCommand{{.v_mps = 0.2}}),
              testing::Optional(testing::Optional(HasSubstr("switched off"))));
  simulation_->set_active(device("laser"), false);
  real_->add_round({{test::kLaser, test::scan(1.0, {1, 2, 3, 4, 5})}});
  measures({{test::kOdometry, test::pose_reading(1.1, {})}});
  EXPECT_THAT(mirror_->readings(), SizeIs(1));
  EXPECT_THAT(sent(), IsEmpty());
}

TEST_F(MirrorTest, PlacementAndSuspension_Refused) {
  open(world_text());
  const auto mirrors = testing::Optional(HasSubstr("robot r1 mirrors a real robot"));
  EXPECT_THAT(simulation_->place_object("r1", {2.0, 2.0, 0.0}), mirrors);
  EXPECT_THAT(simulation_->set_dynamics(false), mirrors);
  EXPECT_THAT(simulation_->set_object_dynamics("r1", false), mirrors);
  EXPECT_THAT(simulation_->reset(), mirrors);
}

TEST_F(MirrorTest, UnreachableServers_ErrorNamesThem) {
  sim::Simulation simulation(sim::load_world_text(world_text(), "lab.json"));
  const OpenRealRobot refuses = [](const RealRobotPlace&) -> std::unique_ptr<Session> {
    throw SessionError(SessionError::Code::kDisconnected, "connection refused");
  };
  const auto robots = describe_robots(simulation);
  EXPECT_THAT([&] { static_cast<void>(Mirror::open(simulation, robots, refuses, {})); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("lab.json: /robots/0/real"), HasSubstr("tcp://robot:4000"),
                        HasSubstr("connection refused"), HasSubstr("[run/real-robot]"))));
  EXPECT_THAT([&] { static_cast<void>(Mirror::open(simulation, robots, {}, {})); },
              ThrowsMessage<sim::ConfigError>(HasSubstr("no way to connect to real robots")));
}

TEST_F(MirrorTest, MissingPoseDevice_Error) {
  EXPECT_THAT([&] { open(world_text(R"(, "pose": "position2d:5")")); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("position2d:5"), HasSubstr("position2d:0 (r1.pose)"))));
}

// --- The ghost

TEST_F(MirrorTest, Ghost_FollowsSameCommands) {
  open(world_text(R"(, "drive": "both")"));
  measures({{test::kPose, test::pose_reading(1.0, {2.0, 2.0, 0.0})}});
  EXPECT_EQ(report().ghost.value().final_distance_m, 0.0) << "it starts at the real robot";
  EXPECT_TRUE(mirror_->take_command(device("motion"), sim::TwistCommand{{.v_mps = 0.2}}));
  step(100);
  measures({{test::kPose, test::pose_reading(2.0, {2.05, 2.0, 0.5})}});
  // Without ramps the ghost drives 0.2 m in a second; the real one says 0.05 m.
  EXPECT_NEAR(report().ghost.value().final_distance_m, 0.15, 1e-3);
  EXPECT_NEAR(report().ghost.value().distance_m.max, 0.15, 1e-3);
  EXPECT_NEAR(report().ghost.value().heading_rad.max, 0.5, 1e-9);
  EXPECT_TRUE(eventually([this] { return !sent().empty(); })) << "the real robot drives as well";
  EXPECT_EQ(simulation_->robot_count(), 1) << "nobody else sees the ghost";

  sim::SceneSnapshot scene = simulation_->snapshot();
  mirror_->show(scene);
  ASSERT_THAT(scene.ghosts, SizeIs(1));
  EXPECT_EQ(scene.ghosts[0].name, "r1_ghost");
  EXPECT_NEAR(scene.ghosts[0].X_WB.x_m, 2.2, 1e-3);

  // x, y and heading of the ghost, and its distance; there was no scan.
  std::istringstream columns(mirror_->columns(0).substr(1));
  std::vector<std::string> fields;
  for (std::string field; std::getline(columns, field, ',');) fields.push_back(field);
  ASSERT_THAT(fields, SizeIs(testing::Ge(4U)));
  EXPECT_NEAR(nlohmann::json::parse(fields[0]).get<double>(), 2.2, 1e-3);
  EXPECT_NEAR(nlohmann::json::parse(fields[3]).get<double>(), 0.15, 1e-3);
}

TEST(Ghost, CollidesWithArena) {
  Ghost ghost(sim::load_world_text(world_text()), 0);
  EXPECT_FALSE(ghost.place({3.99, 2.0, 0.0}));
  ASSERT_TRUE(ghost.place({3.8, 2.0, 0.0}));
  sim::WorldDescription world = sim::load_world_text(world_text());
  for (int device = 0; device < 5; ++device) ghost.apply(device, sim::TwistCommand{{.v_mps = 0.5}});
  for (int i = 0; i < 200; ++i) ghost.step(world);
  // Its front, 0.087 m ahead, is at the border.
  EXPECT_NEAR(ghost.pose().x_m, 4.0 - 0.087, 2e-3);
  ghost.stop();
}

TEST(Ghost, BlocksRiseAsInWorld) {
  const char* const text = R"({"arena": {"size": [4, 4], "obstacles": [
    {"name": "gate", "type": "dynamic", "center": [3, 2], "size": [0.2, 1]}], "retracted": ["gate"]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}}]})";
  sim::WorldDescription world = sim::load_world_text(text);
  Ghost ghost(world, 0);
  world.arena.obstacles[0].state = sim::ObstacleState::kExtended;
  ASSERT_TRUE(ghost.place({2.7, 2.0, 0.0}));
  for (int device = 0; device < 5; ++device) ghost.apply(device, sim::TwistCommand{{.v_mps = 0.5}});
  for (int i = 0; i < 200; ++i) ghost.step(world);
  EXPECT_LT(ghost.pose().x_m, 2.9);
}

TEST_F(MirrorTest, LostConnection_StopsGhost) {
  open(world_text(R"(, "drive": "both")"));
  measures({{test::kPose, test::pose_reading(1.0, {2.0, 2.0, 0.0})}});
  EXPECT_TRUE(mirror_->take_command(device("motion"), sim::TwistCommand{{.v_mps = 0.2}}));
  {
    const std::lock_guard lock(real_->mutex);
    real_->closed = true;
    real_->changed.notify_all();
  }
  EXPECT_TRUE(eventually([this] {
    step();
    return !losses_.empty();
  }));
  step(100);
  const std::string before = mirror_->columns(0);
  step(100);
  EXPECT_EQ(mirror_->columns(0), before);
}

// --- Scans

TEST(ScanDifference, ComparesBeamsOfSameAngle) {
  // Three real beams at -0.5, 0 and 0.5 rad; the predicted scan has beams at -0.5, -0.25, ... 0.5.
  sim::LaserReading real;
  real.angle_min_rad = -0.5;
  real.resolution_rad = 0.5;
  real.range_max_m = 5.0;
  real.ranges_m = {1.0, 2.0, 4.0};
  sim::LaserReading predicted;
  predicted.angle_min_rad = -0.5;
  predicted.resolution_rad = 0.25;
  predicted.range_max_m = 3.0;
  predicted.ranges_m = {1.05, 9.0, 3.0, 9.0, 2.5};
  const ScanDifference difference = compare_scans(real, predicted);
  EXPECT_EQ(difference.beams, 3);
  // Beyond 3 m the two count as equal: the differences are 0.05, 1.0 and 0.5.
  EXPECT_NEAR(difference.mean_m, 1.55 / 3.0, 1e-12);
  EXPECT_NEAR(difference.share, 2.0 / 3.0, 1e-12);
  ASSERT_THAT(difference.places, SizeIs(2));
  EXPECT_TRUE(difference.places[0].unexpected) << "something is nearer than expected";
  EXPECT_NEAR(difference.places[0].p_L.x(), 2.0, 1e-12);
  EXPECT_FALSE(difference.places[1].unexpected);
  EXPECT_NEAR(difference.places[1].p_L.norm(), 2.5, 1e-12) << "where the world has something";
}

TEST(ScanDifference, BeamsOutsidePredictedScan_Ignored) {
  sim::LaserReading real;
  real.angle_min_rad = -3.0;
  real.resolution_rad = 1.0;
  real.range_max_m = 5.0;
  real.ranges_m = {1, 1, std::nan(""), 1, 1, 1, 1};
  sim::LaserReading predicted;
  predicted.angle_min_rad = -1.0;
  predicted.resolution_rad = 1.0;
  predicted.range_max_m = 5.0;
  predicted.ranges_m = {1, 1, 1};
  EXPECT_EQ(compare_scans(real, predicted).beams, 2) << "at 0 and 1 rad; that at -1 has no range";
  EXPECT_EQ(compare_scans(real, {}).beams, 0);
  EXPECT_EQ(compare_scans({}, predicted).beams, 0);
}

TEST_F(MirrorTest, RealScan_DrawnAndCompared) {
  open(world_text());
  // From (2, 2), the laser is at (2.035, 2) and looks along x. Ahead, the border is at 1.965 m;
  // something that the world lacks stands at 1 m.
  measures({{test::kPose, test::pose_reading(1.0, {2.0, 2.0, 0.0})},
            {test::kLaser, test::scan(1.0, {1.0})}});
  sim::SceneSnapshot scene = simulation_->snapshot();
  mirror_->show(scene);
  ASSERT_THAT(scene.robots[0].scan_points, SizeIs(1));
  EXPECT_NEAR(scene.robots[0].scan_points[0].x(), 3.035, 1e-9);
  EXPECT_NEAR(scene.robots[0].scan_points[0].y(), 2.0, 1e-9);
  // The predicted beam nearest to 0 is at most half a beam (0.2 degrees) away.
  EXPECT_NEAR(report().scan_difference.value().range_m.max, 0.965, 1e-3);
  EXPECT_EQ(report().scan_difference.value().share.max, 1.0);

  const std::vector<sim::LayerInfo> layers = simulation_->layers().layers();
  ASSERT_THAT(layers, SizeIs(2)) << "the canvas, and the layer of the difference";
  EXPECT_EQ(layers[1].style.name, "r1 scan difference");
  // Cells of 0.02 m: (3.035, 2) is in column 151, and in row 199 - 100 of 200.
  const auto cell = simulation_->layers().cell(layers[1].id, 151, 99);
  ASSERT_TRUE(cell.has_value());
  EXPECT_EQ(sim::to_string(cell->colour()), "#e6194b");
}

// --- Runs

RunSettings settings_for(const std::shared_ptr<FakeWorld>& real) {
  RunSettings settings;
  settings.open_real_robot = opens(real);
  settings.start_at_once = true;
  return settings;
}

class Readings : public ReadingSink {
 public:
  void on_reading(DeviceId, const sim::SharedReading& reading) override {
    readings.push_back(reading);
  }
  std::vector<sim::SharedReading> readings;
};

TEST(MirroredRun, Program_DrivesAndReadsRealRobot) {
  const auto real = make_real_robot();
  const auto host = Host::create(sim::load_world_text(world_text()), settings_for(real));
  EXPECT_EQ(host->time().mode, sim::TimeMode::kPaced) << "a real robot lives in real time";
  const auto session = host->connect(6665);
  const InterfaceBinding position = find_interface(session->robots(), 6665, "position2d", 0);
  session->request(SubscribeRequest{position.reading});
  session->send(*position.motion, sim::TwistCommand{{.v_mps = 0.125}});
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard lock(real->mutex);
    return !real->sent.empty();
  }));
  const auto reading = test::pose_reading(42.0, {2.5, 2.0, 0.0});
  real->add_round({{test::kPose, reading}});
  session->wait();
  Readings sink;
  session->take(sink);
  EXPECT_THAT(sink.readings, ElementsAre(reading)) << "and no simulated one";
  EXPECT_NEAR(host->with_simulation([](const auto& all) { return all.body(0).X_WB.x_m; }), 2.5,
              1e-12);
  EXPECT_THAT(host->set_time_factor(2.0), testing::Optional(HasSubstr("mirrors a real one")));
  host->finish();
  EXPECT_EQ(std::get<sim::TwistCommand>(real->sent.back().second).twist, sim::Twist{});
}

void lose(FakeWorld& real) {
  const std::lock_guard lock(real.mutex);
  real.closed = true;
  real.changed.notify_all();
}

TEST(MirroredRun, LostRobot_ReportedToProgram) {
  const auto real = make_real_robot();
  std::vector<std::string> log;
  std::mutex log_mutex;
  const auto host = Host::create(sim::load_world_text(world_text()), settings_for(real),
                                 [&](sim::LogLevel, std::string_view text) {
                                   const std::lock_guard lock(log_mutex);
                                   log.emplace_back(text);
                                 });
  const auto session = host->connect(6665);
  const DeviceId pose = find_interface(session->robots(), 6665, "position2d", 0).reading;
  session->request(SubscribeRequest{pose});
  lose(*real);
  const auto is_told = [&] {
    EXPECT_THAT([&] { session->wait(); },
                ThrowsMessage<SessionError>(HasSubstr("the real robot of r1")));
  };
  is_told();
  is_told();  // there will be no further readings
  EXPECT_FALSE(host->finished()) << "the run continues without it";
  {
    const std::lock_guard lock(log_mutex);
    EXPECT_THAT(log, Contains(HasSubstr("the run continues without it")));
  }
  // A program without subscriptions reads empty rounds.
  session->request(UnsubscribeRequest{pose});
  session->wait();
  host->finish();
}

TEST(MirroredRun, LostRobot_EndsRunForServerClients) {
  const auto real = make_real_robot();
  const auto host = Host::create(sim::load_world_text(world_text()), settings_for(real));
  const auto client = host->connect_events(6665, [] {});
  const DeviceId pose = find_interface(host->robots(), 6665, "position2d", 0).reading;
  client->session().request(SubscribeRequest{pose});
  EXPECT_EQ(client->begin_wait(this_thread_id()), EventClient::Outcome::kWaiting);
  lose(*real);
  EXPECT_TRUE(eventually([&] { return client->outcome() == EventClient::Outcome::kFinished; }));
  EXPECT_EQ(client->begin_wait(this_thread_id()), EventClient::Outcome::kFinished);
  EXPECT_FALSE(host->finished());
  host->finish();
}

TEST(MirroredRun, LostRobot_EndsRunIfWorldSaysSo) {
  const test_support::TemporaryFolder folder;
  const auto real = make_real_robot();
  RunSettings settings = settings_for(real);
  settings.output_folder = folder / "out";
  const auto host =
      Host::create(sim::load_world_text(world_text(R"(, "on_lost": "end")")), settings);
  lose(*real);
  EXPECT_TRUE(eventually([&] { return host->finished(); }));
  host->finish();
  std::ifstream file(folder / "out/report.json");
  const auto report = nlohmann::json::parse(file);
  EXPECT_EQ(report["ended"]["by"], "real robot");
  ASSERT_THAT(report["mirror"], SizeIs(1));
  EXPECT_EQ(report["mirror"][0]["robot"], "r1");
  EXPECT_EQ(report["mirror"][0]["server"], "tcp://robot:4000");
  EXPECT_FALSE(report["mirror"][0]["connected"]);
}

TEST(MirroredRun, Trajectory_HasGhostAndDifferences) {
  const test_support::TemporaryFolder folder;
  const auto real = make_real_robot();
  RunSettings settings = settings_for(real);
  settings.output_folder = folder / "out";
  const auto host =
      Host::create(sim::load_world_text(world_text(R"(, "drive": "both")")), settings);
  real->add_round({{test::kPose, test::pose_reading(1.0, {2.0, 3.0, 0.0})}});
  sim::SimTime followed_ns = 0;
  EXPECT_TRUE(eventually([&] {
    host->with_simulation([&](const sim::Simulation& simulation) {
      if (simulation.body(0).X_WB.x_m == 2.0) followed_ns = simulation.now_ns();
    });
    return followed_ns > 0;
  }));
  // There is a row every 0.1 s.
  EXPECT_TRUE(
      eventually([&] { return host->time().sim_time_ns > followed_ns + sim::from_seconds(0.2); }));
  host->finish();
  std::ifstream file(folder / "out/trajectory.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line,
            "time,robot,x,y,yaw,v,omega,stalled,ghost_x,ghost_y,ghost_yaw,ghost_distance,"
            "scan_difference,scan_difference_share");
  std::string last;
  while (std::getline(file, line)) last = line;
  EXPECT_THAT(last, HasSubstr(",r1,2.000000,3.000000,0.000000,0.000000,0.000000,0,2.000000,"
                              "3.000000,0.000000,0.000000,,"));
}

TEST(MirroredRun, RealTimeRequired) {
  RunSettings settings;
  settings.time_mode = sim::TimeMode::kLockstep;
  sim::WorldDescription world = sim::load_world_text(world_text());
  EXPECT_THAT([&] { settings.apply_to(world); },
              ThrowsMessage<sim::ConfigError>(AllOf(HasSubstr("since robot r1 mirrors a real one"),
                                                    HasSubstr("found lockstep"),
                                                    HasSubstr("[run/real-time]"))));
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 2.0;
  EXPECT_THAT([&] { settings.apply_to(world); },
              ThrowsMessage<sim::ConfigError>(HasSubstr("found 2 times real time")));
  settings.time_factor = 1.0;
  settings.apply_to(world);
  sim::WorldDescription timed =
      sim::load_world_text(world_text("", R"(, "simulation": {"time": "lockstep"})"));
  EXPECT_THAT([&] { RunSettings().apply_to(timed); },
              ThrowsMessage<sim::ConfigError>(HasSubstr("/simulation/time")));
}

TEST(MirroredRun, Settings_BindRobots) {
  RealRobotChoice choice;
  ASSERT_TRUE(parse_real_robot("r1=player://robot.example.org:6665", choice));
  EXPECT_EQ(choice.robot, "r1");
  EXPECT_EQ(choice.server, "player://robot.example.org:6665");
  EXPECT_EQ(choice.text(), "r1=player://robot.example.org:6665");
  for (const char* bad :
       {"", "r1", "r1=", "=tcp://a", "r1=robot:6665", "r1=tcp://", "r1=tcp://a,b"}) {
    EXPECT_FALSE(parse_real_robot(bad, choice)) << bad;
  }
  RunSettings settings;
  settings.real_robots = {{"r1", "player://a"}, {"r2", "tcp://b"}};
  sim::WorldDescription world =
      sim::load_world_text(R"({"robots": [{"name": "r1"}, {"name": "r2"}, {"name": "r3"}]})");
  settings.apply_to(world);
  EXPECT_EQ(world.robots[0].real->server, "player://a");
  EXPECT_EQ(world.robots[0].real->pose_interface, "position2d");
  EXPECT_EQ(world.robots[1].real->server, "tcp://b");
  EXPECT_FALSE(world.robots[2].real);
  EXPECT_EQ(world.simulation.time_mode, sim::TimeMode::kPaced);
  settings.real_robots = {{"r9", "player://a"}};
  EXPECT_THAT([&] { settings.apply_to(world); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("a robot of the world: r1, r2, r3"), HasSubstr("[run/real]"))));
}

// --- MORSE's protocol

/// A server of a world whose robot mirrors a real one, and a client of MORSE.
class MirroredMorse : public testing::Test {
 protected:
  MirroredMorse() {
    ServerSettings settings;
    settings.port = 0;
    settings.stream_port = 0;
    server_.emplace(host_, settings, [](sim::LogLevel, std::string_view) {});
  }
  ~MirroredMorse() override { server_->stop(); }

  [[nodiscard]] test_support::RawClient connect() const { return {"127.0.0.1", server_->port()}; }
  static std::string ask(test_support::RawClient& client, const std::string& request) {
    client.send("1 " + request + '\n');
    return client.line();
  }
  /// Waits until the real robot has got this speed as its last command.
  [[nodiscard]] bool real_gets(double v_mps) const {
    return eventually([&] {
      const std::lock_guard lock(real_->mutex);
      const auto* const twist = real_->sent.empty()
                                    ? nullptr
                                    : std::get_if<sim::TwistCommand>(&real_->sent.back().second);
      return twist != nullptr && twist->twist.v_mps == v_mps;
    });
  }

  static constexpr DeviceId kCamera{0, 5};
  static std::shared_ptr<FakeWorld> real_robot_with_camera() {
    auto real = make_real_robot();
    real->robots[0].devices.push_back({kCamera, "camera", "camera", {}});
    return real;
  }

  std::shared_ptr<FakeWorld> real_ = real_robot_with_camera();
  std::shared_ptr<Host> host_ =
      Host::create(sim::load_world_text(world_text(
                       R"(}, "devices": {"go": {"type": "waypoint"}, "pose": {"frequency": 100},
                            "camera": {"frequency": 100, "image": [4, 2]})")),
                   settings_for(real_));
  std::optional<Server> server_;
};

TEST_F(MirroredMorse, Commands_ReachRealRobotOrAreRefused) {
  auto client = connect();
  EXPECT_EQ(ask(client, "r1.motion set_speed [0.3, 0]"), "1 SUCCESS");
  EXPECT_TRUE(real_gets(0.3));
  EXPECT_EQ(ask(client, "r1.motion stop"), "1 SUCCESS");
  EXPECT_TRUE(real_gets(0.0));
  EXPECT_THAT(ask(client, "r1.go goto [1, 1, 0]"), HasSubstr("1 FAILED"));
  for (const char* request :
       {"simulation suspend_dynamics", "simulation restore_dynamics", "simulation reset_objects",
        "simulation set_object_dynamics [\"r1\", false]"}) {
    EXPECT_THAT(ask(client, request), AllOf(HasSubstr("1 FAILED"), HasSubstr("mirrors a real")))
        << request;
  }
}

TEST_F(MirroredMorse, MotorsOff_StopsRealRobot) {
  auto client = connect();
  EXPECT_EQ(ask(client, "r1.motion set_speed [0.3, 0]"), "1 SUCCESS");
  EXPECT_TRUE(real_gets(0.3));
  EXPECT_EQ(ask(client, R"(simulation deactivate ["r1.motion"])"), "1 SUCCESS");
  EXPECT_TRUE(real_gets(0.0));
  EXPECT_THAT(ask(client, "r1.motion set_speed [0.3, 0]"), HasSubstr("switched off"));
  EXPECT_EQ(ask(client, R"(simulation activate ["r1.motion"])"), "1 SUCCESS");
  EXPECT_EQ(ask(client, "r1.motion set_speed [0.2, 0]"), "1 SUCCESS");
  EXPECT_TRUE(real_gets(0.2));
}

TEST_F(MirroredMorse, CommanderLeaves_RealRobotStops) {
  auto looker = connect();
  EXPECT_THAT(ask(looker, "simulation list_robots"), HasSubstr("r1"));
  {
    auto client = connect();
    EXPECT_EQ(ask(client, "r1.motion set_speed [0.3, 0]"), "1 SUCCESS");
    EXPECT_TRUE(real_gets(0.3));
  }
  EXPECT_TRUE(real_gets(0.0));
}

TEST_F(MirroredMorse, StreamOfSensor_CarriesAllReadingsOfTheRealRobot) {
  auto client = connect();
  const std::string answer = ask(client, R"(simulation get_stream_port ["r1.pose"])");
  test_support::RawClient stream("127.0.0.1", std::stoi(answer.substr(answer.rfind(' '))));
  // The robot has run for long, so its readings have far greater numbers than the simulated ones.
  std::atomic<double> x_m{2.25};
  const std::jthread feeder([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto reading = test::pose_reading(42.0, {x_m, 2.0, 0.0});
      reading->sequence = 1'000'000;
      real_->add_round({{test::kPose, reading}});
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  EXPECT_THAT(stream.line(), HasSubstr("\"x\": 2.25"));
  x_m = 2.5;
  std::string line;
  do {
    line = stream.line();  // throws if the stream stands still
  } while (line.find("\"x\": 2.25") != std::string::npos);
  EXPECT_THAT(line, HasSubstr("\"x\": 2.5,"));
}

TEST_F(MirroredMorse, LocalData_NewestReadingOfTheRealRobot) {
  auto client = connect();
  ASSERT_TRUE(eventually([&] { return host_->time().sim_time_ns > sim::from_seconds(0.05); }));
  EXPECT_THAT(ask(client, "r1.pose get_local_data"), HasSubstr("r1.pose has no reading yet"));
  real_->add_round({{test::kPose, test::pose_reading(42.0, {2.25, 2.0, 0.0})}});
  ASSERT_TRUE(eventually(
      [&] { return ask(client, "r1.pose get_local_data").find("SUCCESS") != std::string::npos; }));
  EXPECT_THAT(ask(client, "r1.pose get_local_data"),
              AllOf(HasSubstr("\"x\": 2.25,"), HasSubstr("\"timestamp\": 42.0")));
}

TEST_F(MirroredMorse, Capture_WaitsForPicturesOfTheRealRobot) {
  auto client = connect();
  const auto add_picture = [this](double time_s) {
    const auto picture = std::make_shared<sim::CameraReading>();
    picture->time_ns = sim::from_seconds(time_s);
    real_->add_round({{kCamera, picture}});
  };
  client.send("1 r1.camera capture [2]\n2 simulation list_robots\n");
  EXPECT_THAT(client.line(), HasSubstr("2 SUCCESS"));
  add_picture(42.0);
  // Meanwhile the simulated camera takes ten.
  const sim::SimTime begin_ns = host_->time().sim_time_ns;
  ASSERT_TRUE(
      eventually([&] { return host_->time().sim_time_ns > begin_ns + sim::from_seconds(0.1); }));
  client.send("3 simulation list_robots\n");
  EXPECT_THAT(client.line(), HasSubstr("3 SUCCESS"));
  add_picture(42.1);
  EXPECT_EQ(client.line(), "1 SUCCESS");
}

TEST_F(MirroredMorse, CommandStreamEnds_RealRobotStops) {
  auto client = connect();
  const std::string answer = ask(client, R"(simulation get_stream_port ["r1.motion"])");
  {
    test_support::RawClient stream("127.0.0.1", std::stoi(answer.substr(answer.rfind(' '))));
    stream.send("{\"v\": 0.3, \"w\": 0}\n");
    EXPECT_TRUE(real_gets(0.3));
  }
  EXPECT_TRUE(real_gets(0.0));
}

}  // namespace
}  // namespace playerlike
