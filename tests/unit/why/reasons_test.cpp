// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "why/reasons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "host/results/recording_writer.h"
#include "playerlike/host/rerun.h"
#include "sim/core/time.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"
#include "why/reasons_json.h"
#include "why/story.h"

namespace playpen::why {
namespace {

using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

// A robot at the left, a block ahead of it, and one beside its way.
constexpr const char* kWorld = R"({
  "name": "why", "arena": {"size": [4, 2], "obstacles": [
    {"name": "ahead", "center": [2.2, 1.06], "size": [0.3, 0.3], "height": 0.16}]},
  "robots": [{"name": "r1", "pose": {"x": 0.4, "y": 1.0, "yaw_deg": 0}}]})";

/// What a program knows in each round. A robot has a laser or transducers.
struct Round {
  const sim::LaserReading& scan;
  sim::Pose X_WB;
  int number;
  std::vector<double> ranges_m = {};  ///< of its transducers

  /// The least range between two bearings from the laser's axis.
  [[nodiscard]] double least_m(double from_rad, double to_rad, bool mirrored = false) const {
    double least_m = scan.range_max_m;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.resolution_rad;
      if (angle < from_rad || angle > to_rad) continue;
      const std::size_t beam = mirrored ? scan.ranges_m.size() - 1 - i : i;
      least_m = std::min(least_m, scan.ranges_m[beam]);
    }
    return least_m;
  }
};

/// A program: what it commands in each round of 0.1 s; nullopt: nothing.
using Program = std::function<std::optional<sim::Twist>(const Round&)>;

class Reasons : public testing::Test {
 protected:
  Reasons() : world_(folder_.write("world.json", kWorld)) {
    settings_.output_folder = folder_.path().string();
  }

  /// Runs a program and explains the run.
  /// @param rounds_per_read  it reads so seldom.
  std::vector<Reason> explain(const Program& program, double duration_s, int rounds_per_read = 1,
                              sim::SimTime age_ns = 0) {
    const sim::LaserReading none;
    sim::Simulation run(sim::load_world(world_));
    playerlike::RecordingWriter writer(settings_, run);
    const std::optional<int> laser = run.find_device(0, "laser");
    std::optional<int> ranger = run.find_device(0, "sonar");
    if (!ranger) ranger = run.find_device(0, "infrared");
    const int motors = run.find_device(0, "motion").value();
    if (switch_off_) static_cast<void>(run.apply({0, motors}, sim::MotorEnableCommand{false}));
    for (int step = 0; step < static_cast<int>(duration_s * 100.0); ++step) {
      const int round = step / 10;
      if (step % 10 == 0 && step > 0 && round % rounds_per_read == 0) {
        writer.note_read(1, run.now_ns() - age_ns);
        Round known{laser ? static_cast<const sim::Laser&>(run.device(0, *laser)).reading() : none,
                    run.body(0).X_WB, round};
        if (ranger) {
          known.ranges_m =
              static_cast<const sim::Ranger&>(run.device(0, *ranger)).reading().ranges_m;
        }
        if (const auto twist = program(known)) {
          static_cast<void>(run.apply({0, motors}, sim::TwistCommand{*twist}));
        }
      }
      run.step();
      EXPECT_EQ(writer.observe(), std::nullopt);
    }
    EXPECT_EQ(writer.close(), std::nullopt);
    playerlike::Rerun rerun(folder_.path().string());
    story_ = story_of(rerun, 0);
    return reasons_of(story_, facts_);
  }
  [[nodiscard]] std::string first_kind(const Program& program, double duration_s,
                                       int rounds_per_read = 1, sim::SimTime age_ns = 0) {
    reasons_ = explain(program, duration_s, rounds_per_read, age_ns);
    return reasons_.empty() ? "" : reasons_.front().kind;
  }
  [[nodiscard]] std::string first_text() const {
    std::string text;
    if (reasons_.empty()) return text;
    for (const std::string& sentence : reasons_.front().text) text += sentence + ' ';
    return text;
  }

  TemporaryFolder folder_;
  std::string world_;
  playerlike::RunSettings settings_;
  RunFacts facts_;
  Story story_;
  std::vector<Reason> reasons_;
  bool switch_off_ = false;
};

/// Avoids what is near: turns to the freer side. The parts that a fault replaces are parameters.
struct Avoider {
  double limit_m = 0.6;
  double speed_mps = 0.3;
  double turn_radps = 1.5;
  double view_rad = kPi / 3.0;
  bool mirrored = false;

  std::optional<sim::Twist> operator()(const Round& round) const {
    const double left_m = round.least_m(0.0, view_rad, mirrored);
    const double right_m = round.least_m(-view_rad, 0.0, mirrored);
    if (std::min(left_m, right_m) > limit_m) return sim::Twist{speed_mps, 0.0, 0.0};
    return sim::Twist{0.3 * speed_mps, left_m < right_m ? -turn_radps : turn_radps, 0.0};
  }
};

TEST_F(Reasons, GoodProgram_None) {
  EXPECT_EQ(first_kind(Avoider{}, 20.0), "");
  EXPECT_TRUE(story_.collisions.empty());
}

TEST_F(Reasons, LateTurn_Named) {
  EXPECT_EQ(first_kind(Avoider{.limit_m = 0.16, .speed_mps = 0.5, .turn_radps = 1.0}, 8.0),
            kind::kLate);
  EXPECT_THAT(first_text(), HasSubstr("first hit ahead at (2.05, "));
  EXPECT_THAT(first_text(), HasSubstr("of its laser (straight ahead) had shown it for "));
}

TEST_F(Reasons, WrongSign_TurnedTowards) {
  EXPECT_EQ(first_kind(Avoider{.limit_m = 0.9, .turn_radps = -1.5}, 30.0), kind::kTowards);
}

TEST_F(Reasons, BeamsReversed_TurnedTowards) {
  EXPECT_EQ(first_kind(Avoider{.limit_m = 0.9, .mirrored = true}, 30.0), kind::kTowards);
}

TEST_F(Reasons, DegreesForRadians_Units) {
  EXPECT_EQ(first_kind(Avoider{.turn_radps = 45.0}, 10.0), kind::kUnits);
  EXPECT_THAT(first_text(), HasSubstr("45 degrees are 0.79 rad"));
}

TEST_F(Reasons, MillimetresForMetres_Units) {
  EXPECT_EQ(first_kind(Avoider{.speed_mps = 300.0}, 10.0), kind::kUnits);
  EXPECT_THAT(first_text(), HasSubstr("millimetres"));
}

TEST_F(Reasons, RadiansForDegrees_SlowTurn) {
  EXPECT_EQ(first_kind(Avoider{.limit_m = 1.0, .turn_radps = 1.5 * kPi / 180.0}, 20.0),
            kind::kSlowTurn);
}

TEST_F(Reasons, OldReadings_Stale) {
  EXPECT_EQ(first_kind(Avoider{.limit_m = 0.08}, 10.0, 1, sim::from_seconds(0.8)), kind::kStale);
  EXPECT_THAT(first_text(), HasSubstr("0.8 s old"));
}

TEST_F(Reasons, OldScansKeptByProgram_Stale) {
  folder_.write("world.json", read_bytes(PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json"));
  const Program late = [old = std::vector<std::optional<sim::Twist>>()](
                           const Round& round) mutable -> std::optional<sim::Twist> {
    constexpr std::size_t kLate = 10;
    old.push_back(Avoider{.limit_m = 0.35}(round));
    return old[old.size() > kLate ? old.size() - 1 - kLate : 0];
  };
  EXPECT_EQ(first_kind(late, 60.0), kind::kStale);
  EXPECT_THAT(first_text(), HasSubstr("fit what the laser had shown about "));
}

TEST_F(Reasons, ReadsSeldom_NoRead) {
  EXPECT_EQ(first_kind(Avoider{.limit_m = 0.4, .speed_mps = 0.4}, 10.0, 20), kind::kNoRead);
}

TEST_F(Reasons, CommandsOnce_NoReaction) {
  const Program once = [](const Round& round) {
    return round.number == 1 ? std::optional(sim::Twist{0.3, 0.0, 0.0}) : std::nullopt;
  };
  EXPECT_EQ(first_kind(once, 10.0), kind::kNoReaction);
}

TEST_F(Reasons, LooksAheadOnly_StraightOn) {
  // The corner of the block is left of the narrow view.
  folder_.write("world.json", R"({"arena": {"size": [4, 2], "obstacles": [
      {"name": "corner", "center": [2.2, 1.2], "size": [0.3, 0.3], "height": 0.16}]},
      "robots": [{"name": "r1", "pose": {"x": 0.4, "y": 1.0, "yaw_deg": 0}}]})");
  EXPECT_EQ(first_kind(Avoider{.view_rad = 0.03}, 10.0), kind::kStraight);
}

TEST_F(Reasons, Backwards_Unseen) {
  const Program back = [](const Round&) { return std::optional(sim::Twist{-0.2, 0.0, 0.0}); };
  EXPECT_EQ(first_kind(back, 5.0), kind::kUnseen);
  EXPECT_THAT(first_text(), HasSubstr("No beam of its laser looks there"));
}

/// A world with a robot that has transducers instead of a laser.
/// @param devices  of the robot.
std::string world_of_transducers(const std::string& devices, const std::string& obstacle) {
  return R"({"name": "why", "arena": {"size": [4, 2], "obstacles": [)" + obstacle +
         R"(]}, "robots": [{"name": "r1", "pose": {"x": 0.4, "y": 1.0, "yaw_deg": 0},
             "devices": {"laser": null, )" +
         devices + "}}]}";
}
constexpr const char* kSonars = R"("sonar": {"field_of_view_deg": 30, "noise": 0, "mounts": [
    {"x": 0.06, "y": 0.05, "yaw_deg": 30}, {"x": 0.08, "y": 0, "yaw_deg": 0},
    {"x": 0.06, "y": -0.05, "yaw_deg": -30}]})";
constexpr const char* kBlockAhead =
    R"({"name": "ahead", "center": [2.2, 1.06], "size": [0.3, 0.3], "height": 0.16})";

/// Avoids what one of three sonars shows: turns to the freer side.
struct SonarAvoider {
  double limit_m = 0.6;
  double speed_mps = 0.3;
  double turn_radps = 1.5;

  std::optional<sim::Twist> operator()(const Round& round) const {
    const double least_m = *std::min_element(round.ranges_m.begin(), round.ranges_m.end());
    if (least_m > limit_m) return sim::Twist{speed_mps, 0.0, 0.0};
    const bool left = round.ranges_m.front() < round.ranges_m.back();
    return sim::Twist{0.3 * speed_mps, left ? -turn_radps : turn_radps, 0.0};
  }
};

TEST_F(Reasons, SonarsLateTurn_ConeNamed) {
  folder_.write("world.json", world_of_transducers(kSonars, kBlockAhead));
  EXPECT_EQ(first_kind(SonarAvoider{.limit_m = 0.1, .speed_mps = 0.5, .turn_radps = 1.0}, 8.0),
            kind::kLate);
  EXPECT_THAT(first_text(), HasSubstr("Its sonar 1 (straight ahead) had shown it for 3."));
}

TEST_F(Reasons, SonarsGoodProgram_None) {
  folder_.write("world.json", world_of_transducers(kSonars, kBlockAhead));
  EXPECT_EQ(first_kind(SonarAvoider{}, 8.0), "");
}

TEST_F(Reasons, SonarsOfOtherSide_TurnedTowards) {
  folder_.write(
      "world.json",
      world_of_transducers(
          kSonars,
          R"({"name": "left", "center": [2.2, 1.25], "size": [0.6, 0.4], "height": 0.16})"));
  EXPECT_EQ(first_kind(SonarAvoider{.limit_m = 0.4, .turn_radps = -0.8}, 10.0), kind::kTowards);
  EXPECT_THAT(first_text(), HasSubstr("Its sonar "));
  EXPECT_THAT(first_text(), HasSubstr("left and right of its sonar exchanged?"));
}

TEST_F(Reasons, BetweenCones_BlindSpotNamed) {
  folder_.write(
      "world.json",
      world_of_transducers(
          R"("sonar": {"field_of_view_deg": 20, "noise": 0, "mounts": [
          {"x": 0, "y": 0, "yaw_deg": 45}, {"x": 0, "y": 0, "yaw_deg": -45}]})",
          R"({"name": "pole", "center": [2.2, 1.0], "size": [0.1, 0.1], "height": 0.16})"));
  EXPECT_EQ(first_kind(SonarAvoider{}, 8.0), kind::kUnseen);
  EXPECT_THAT(first_text(),
              HasSubstr("No cone of its sonar looked there: it was between sonar 0 (45 degrees to "
                        "the left) and sonar 1 (45 degrees to the right)."));
}

TEST_F(Reasons, LowBlockBelowCones_Unseen) {
  folder_.write(
      "world.json",
      world_of_transducers(
          kSonars, R"({"name": "low", "center": [2.2, 1.0], "size": [0.3, 0.3], "height": 0.02})"));
  EXPECT_EQ(first_kind(SonarAvoider{}, 8.0), kind::kUnseen);
}

TEST_F(Reasons, InfraredRingStraightOn_RayNamed) {
  folder_.write("world.json", world_of_transducers(R"("infrared": {"noise": 0})", kBlockAhead));
  const Program push = [](const Round&) { return std::optional(sim::Twist{0.4, 0.0, 0.0}); };
  EXPECT_EQ(first_kind(push, 6.0), kind::kStraight);
  EXPECT_THAT(first_text(), HasSubstr("Its infrared 0 (straight ahead) had shown it for "));
}

TEST_F(Reasons, NoSensorOfDistances_Said) {
  folder_.write("world.json", world_of_transducers(R"("pen": {})", kBlockAhead));
  const Program push = [](const Round&) { return std::optional(sim::Twist{0.4, 0.0, 0.0}); };
  EXPECT_EQ(first_kind(push, 6.0), kind::kUnseen);
  EXPECT_THAT(first_text(), HasSubstr("It has no laser, sonars or infrared rangers"));
}

TEST_F(Reasons, Json_KindPlaceTextNumbers) {
  ExplainedRun run{"out/\xff", "r1", 0.0, true, false, {"a fault"}, {}};
  run.reasons = explain(Avoider{.limit_m = 0.16, .speed_mps = 0.5, .turn_radps = 1.0}, 8.0);
  ASSERT_FALSE(run.reasons.empty());
  const auto content = nlohmann::json::parse(reasons_json({run}));
  EXPECT_EQ(content.at("format"), 1);
  const auto& one = content.at("runs").at(0);
  EXPECT_EQ(one.at("folder"), "out/\xef\xbf\xbd");
  EXPECT_EQ(one.at("passed"), false);
  EXPECT_EQ(one.at("reasons").size(), run.reasons.size());
  const auto& reason = one.at("reasons").at(0);
  EXPECT_EQ(reason.at("kind"), kind::kLate);
  EXPECT_EQ(reason.at("robot"), "r1");
  EXPECT_EQ(reason.at("time_s"), run.reasons.front().time_s);
  EXPECT_NEAR(reason.at("place_m").at(0).get<double>(), 2.05, 0.01);
  EXPECT_EQ(reason.at("text").size(), run.reasons.front().text.size());
  const auto& numbers = reason.at("numbers");
  EXPECT_LT(numbers.at("reacted_before_s").get<double>(), 0.5);
  EXPECT_GT(numbers.at("shown_for_s").get<double>(), 2.0);
  EXPECT_NEAR(numbers.at("first_range_m").get<double>(), 1.6, 0.2);
}

TEST_F(Reasons, JsonOfUngradedGoodRun_Empty) {
  const auto content =
      nlohmann::json::parse(reasons_json({{"out", "r1", 8.0, true, std::nullopt, {}, {}}}));
  EXPECT_EQ(content.at("runs").at(0).at("passed"), nullptr);
  EXPECT_EQ(content.at("runs").at(0).at("reasons"), nlohmann::json::array());
}

TEST_F(Reasons, NoCommand_Named) {
  const Program idle = [](const Round&) { return std::nullopt; };
  EXPECT_EQ(first_kind(idle, 3.0), kind::kNoCommand);
}

TEST_F(Reasons, MotorsOff_Named) {
  switch_off_ = true;
  EXPECT_EQ(first_kind(Avoider{}, 3.0), kind::kMotorsOff);
}

TEST_F(Reasons, LeftAndRight_Oscillation) {
  const Program undecided = [](const Round& round) {
    return std::optional(sim::Twist{0.0, round.number / 3 % 2 == 0 ? 1.0 : -1.0, 0.0});
  };
  EXPECT_EQ(first_kind(undecided, 20.0), kind::kOscillation);
}

TEST_F(Reasons, Circles_Named) {
  const Program round_and_round = [](const Round&) {
    return std::optional(sim::Twist{0.2, 2.5, 0.0});
  };
  EXPECT_EQ(first_kind(round_and_round, 20.0), kind::kCircles);
}

/// Drives to a place; beyond it, it goes on or stops.
Program to_goal(sim::Vec2 goal, bool stops, double sign = 1.0) {
  return [=](const Round& round) {
    const sim::Vec2 p_B = round.X_WB.inverse() * goal;
    if (stops && p_B.norm() < 0.1) return std::optional(sim::Twist{});
    const double bearing_rad = std::atan2(p_B.y(), p_B.x());
    return std::optional(sim::Twist{std::abs(bearing_rad) > 0.5 ? 0.0 : 0.3,
                                    sign * std::clamp(2.0 * bearing_rad, -1.0, 1.0), 0.0});
  };
}

TEST_F(Reasons, Goal_StopMissing) {
  facts_.goal = sim::Vec2(0.9, 1.5);
  EXPECT_EQ(first_kind(to_goal(*facts_.goal, true), 12.0), "");
  const Program beyond = [](const Round& round) {
    return to_goal(round.number < 40 ? sim::Vec2(0.9, 1.5) : sim::Vec2(3.5, 1.6), false)(round);
  };
  EXPECT_EQ(first_kind(beyond, 10.0), kind::kNoStop);
}

TEST_F(Reasons, Goal_WrongWayBeforeMissed) {
  facts_.goal = sim::Vec2(0.9, 1.5);
  const std::vector<Reason> reasons = explain(to_goal(*facts_.goal, true, -1.0), 10.0);
  ASSERT_GE(reasons.size(), 2U);
  EXPECT_EQ(reasons[0].kind, kind::kWrongWay);
  EXPECT_EQ(reasons[1].kind, kind::kMissed);
}

TEST_F(Reasons, Stalled_AfterItsContact) {
  const Program push = [](const Round&) { return std::optional(sim::Twist{0.4, 0.0, 0.0}); };
  const std::vector<Reason> reasons = explain(push, 15.0);
  ASSERT_GE(reasons.size(), 2U);
  EXPECT_EQ(reasons[0].kind, kind::kStraight);
  EXPECT_EQ(reasons[1].kind, kind::kStall);
  EXPECT_THAT(reasons[1].text.front(), HasSubstr("against ahead"));
}

TEST_F(Reasons, ContactsAllowed_GoalFirst) {
  facts_.goal = sim::Vec2(3.5, 1.0);
  facts_.faults = {"the goal was not reached"};
  const Program push = [](const Round&) { return std::optional(sim::Twist{0.4, 0.0, 0.0}); };
  EXPECT_EQ(first_kind(push, 15.0), kind::kMissed);
}

TEST_F(Reasons, Crash_First) {
  facts_.signal = "SIGSEGV";
  EXPECT_EQ(first_kind(Avoider{}, 4.0), kind::kCrash);
  EXPECT_THAT(first_text(), HasSubstr("SIGSEGV after 4.0 s"));
}

TEST_F(Reasons, Refused_Named) {
  facts_.refused = {{0.1, "the map of the world"}};
  EXPECT_EQ(first_kind(Avoider{}, 4.0), kind::kRefused);
}

}  // namespace
}  // namespace playpen::why
