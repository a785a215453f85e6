// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Keys of the live window, and steering by hand.
#include "host/window/view_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/devices/motion.h"

namespace playerlike {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kUp = 0xff52;
constexpr std::uint32_t kDown = 0xff54;

TEST(ViewAction, Ctrl_SelectsViewModeNotDriving) {
  EXPECT_EQ(view_action(kUp, false), ViewAction::kForward);
  EXPECT_EQ(view_action(kUp, true), ViewAction::kPreviousMode);
  EXPECT_EQ(view_action(kDown, false), ViewAction::kBackward);
  EXPECT_EQ(view_action(kDown, true), ViewAction::kNextMode);
  EXPECT_EQ(view_action('q', true), std::nullopt);
}

TEST(ViewAction, CapsLock_SameLetters) {
  for (const char letter : std::string("wxadshq")) {
    const auto lower = static_cast<std::uint32_t>(letter);
    EXPECT_TRUE(view_action(lower, false)) << letter;
    EXPECT_EQ(view_action(lower, false), view_action(lower - 32, false)) << letter;
  }
  // S saves; reverse driving is on X.
  EXPECT_EQ(view_action('s', false), ViewAction::kSave);
  EXPECT_EQ(view_action('x', false), ViewAction::kBackward);
}

TEST(ViewAction, OtherKeys_NoAction) {
  for (const std::uint32_t keysym : {0U, 0xffe3U, 0x7aU, 0xffffffffU}) {
    EXPECT_EQ(view_action(keysym, false), std::nullopt) << keysym;
  }
}

TEST(ViewHelp, NamesEveryKindOfKey) {
  std::string all;
  for (const std::string& line : view_help()) all += line + '\n';
  for (const char* key : {"W A D X", "arrows", "Tab", "Ctrl+Up", "Ctrl+Down", "Space", "+, -",
                          "S  save", "H ", "Q, Esc"}) {
    EXPECT_THAT(all, HasSubstr(key));
  }
}

TEST(TimeFactor, DoublesAndHalvesWithinRange) {
  EXPECT_EQ(next_time_factor(1.0, true), 2.0);
  EXPECT_EQ(next_time_factor(1.0, false), 0.5);
  EXPECT_EQ(next_time_factor(64.0, true), 64.0);
  EXPECT_EQ(next_time_factor(1.0 / 16.0, false), 1.0 / 16.0);
  // A world's own factor may be outside the range; the keys lead back into it.
  EXPECT_EQ(next_time_factor(100.0, true), 100.0);
  EXPECT_EQ(next_time_factor(100.0, false), 50.0);
  EXPECT_EQ(factor_text(2.0), "x 2");
  EXPECT_EQ(factor_text(0.0625), "x 0.0625");
}

// Two S1R in an empty room.
class HandDriveTest : public testing::Test {
 protected:
  const sim::Motion& motion(int robot) const {
    return dynamic_cast<const sim::Motion&>(simulation.device(robot, device(robot)));
  }
  int device(int robot) const {
    for (const DeviceInfo& info : robots[static_cast<std::size_t>(robot)].devices) {
      if (info.type == "motion") return info.id.device;
    }
    throw std::logic_error("no motors");
  }
  // A program's command between two steps.
  void command(int robot, double v_mps) {
    const sim::Command twist = sim::TwistCommand{{.v_mps = v_mps}};
    drive.note_command({robot, device(robot)}, twist);
    ASSERT_FALSE(simulation.apply({robot, device(robot)}, twist));
  }
  void step(int count = 1) {
    for (int i = 0; i < count; ++i) {
      drive.before_step(simulation);
      simulation.step();
    }
  }
  double x_m(int robot) const { return simulation.body(robot).X_WB.x_m; }

  sim::Simulation simulation{sim::load_world_text(
      R"({"name": "two", "arena": {"size": [20, 4]},
          "robots": [{"name": "r1", "pose": {"x": 5, "y": 1}},
                     {"name": "r2", "pose": {"x": 5, "y": 3}}]})")};
  std::vector<RobotInfo> robots = describe_robots(simulation);
  HandDrive drive{robots};
  KeyDrive hand{drive};
};

TEST_F(HandDriveTest, NoKeys_RobotsUnaffected) {
  command(0, 0.2);
  step(100);
  EXPECT_FALSE(hand.active());
  EXPECT_NEAR(x_m(0), 5.2, 1e-9);  // 1 s at 0.2 m/s
}

TEST_F(HandDriveTest, Keys_OverrideProgramUntilReleased) {
  command(0, -0.2);
  hand.hold(ViewAction::kForward, true);
  step(50);
  EXPECT_TRUE(hand.active());
  EXPECT_GT(x_m(0), 5.0);
  EXPECT_EQ(motion(0).commanded().v_mps, 0.5);  // full speed after half a second
  command(0, -0.3);                             // no effect for now
  step();
  EXPECT_EQ(motion(0).commanded().v_mps, 0.5);

  hand.hold(ViewAction::kForward, false);
  step();
  EXPECT_EQ(motion(0).commanded().v_mps, 0.0);  // stops at once
  step(29);                                     // 0.3 s in all
  EXPECT_TRUE(hand.active());
  step();
  EXPECT_FALSE(hand.active());
  EXPECT_EQ(motion(0).commanded().v_mps, -0.3);
}

TEST_F(HandDriveTest, Speed_GrowsStepByStep) {
  hand.hold(ViewAction::kForward, true);
  step();
  // Full speed of 0.5 m/s after 50 steps of 10 ms.
  EXPECT_NEAR(motion(0).commanded().v_mps, 0.01, 1e-12);
  step(24);
  EXPECT_NEAR(motion(0).commanded().v_mps, 0.25, 1e-12);
}

TEST_F(HandDriveTest, LeftKey_TurnsLeftAlsoBackwards) {
  hand.hold(ViewAction::kLeft, true);
  hand.hold(ViewAction::kBackward, true);
  step(60);
  EXPECT_LT(motion(0).commanded().v_mps, 0.0);
  EXPECT_EQ(motion(0).commanded().omega_radps, 1.5);  // half of the motors' limit
  hand.hold(ViewAction::kRight, true);                // both: straight on
  step();
  EXPECT_EQ(motion(0).commanded().omega_radps, 0.0);
}

TEST_F(HandDriveTest, NextRobot_SelectedAndFirstReturnsToProgram) {
  command(0, 0.1);
  hand.hold(ViewAction::kForward, true);
  step(50);
  hand.choose_next(simulation);
  EXPECT_EQ(hand.chosen(), 1);
  EXPECT_EQ(motion(0).commanded().v_mps, 0.1);
  step(10);
  EXPECT_FALSE(hand.active());  // keys must be pressed again
  EXPECT_EQ(x_m(1), 5.0);
  hand.hold(ViewAction::kForward, true);
  step(50);
  EXPECT_GT(x_m(1), 5.0);
  hand.choose_next(simulation);
  EXPECT_EQ(hand.chosen(), 0);
}

TEST_F(HandDriveTest, TwoSticks_TwoRobotsAtTheirSpeeds) {
  drive.steer(0, {.ahead = 0.5});
  drive.steer(1, {.ahead = -1.0, .left = 0.2});
  step(60);
  EXPECT_NEAR(motion(0).commanded().v_mps, 0.25, 1e-12);
  EXPECT_NEAR(motion(1).commanded().v_mps, -0.5, 1e-12);
  EXPECT_NEAR(motion(1).commanded().omega_radps, 0.3, 1e-12);
  drive.steer(1, {.ahead = -0.1, .left = 0.2});  // slows down at once
  step();
  EXPECT_NEAR(motion(1).commanded().v_mps, -0.05, 1e-12);
}

TEST_F(HandDriveTest, LostFocus_StopsRobot) {
  hand.hold(ViewAction::kForward, true);
  step(50);
  hand.release_all();
  step();
  EXPECT_EQ(motion(0).commanded().v_mps, 0.0);
}

TEST(HandDrive, NoRobots_NoEffect) {
  sim::Simulation simulation(
      sim::load_world_text(R"({"name": "none", "arena": {"size": [2, 2]}, "robots": []})"));
  HandDrive drive(describe_robots(simulation));
  KeyDrive hand(drive);
  EXPECT_EQ(hand.chosen(), -1);
  hand.hold(ViewAction::kForward, true);
  drive.before_step(simulation);
  hand.choose_next(simulation);
  EXPECT_FALSE(hand.active());
}

}  // namespace
}  // namespace playerlike
