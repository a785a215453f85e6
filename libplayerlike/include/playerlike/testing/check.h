// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "playerlike/testing/run.h"

/// What matchers judge, for other test libraries than GoogleTest.
namespace playpen::testing {

/// A run or one of its robots.
class Subject {
 public:
  Subject(const TestRun& run) : run_(&run) {}
  Subject(const RobotOf& robot) : run_(robot.run), robot_(robot.robot) {}
  [[nodiscard]] const TestRun& run() const noexcept { return *run_; }
  /// "": each robot is judged.
  [[nodiscard]] const std::string& robot() const noexcept { return robot_; }

 private:
  const TestRun* run_;
  std::string robot_;
};

/// Result of a check.
struct Verdict {
  bool met = true;
  std::string text;                   ///< robot, what was measured, time and place
  std::optional<TestRun::Mark> mark;  ///< the moment that decides, for a picture
};

/// The robot's body has kept at least this distance to everything solid [m].
[[nodiscard]] Verdict check_clearance(const Subject& subject, double least_m);
/// The robot has been within the tolerance of the point at some time [m].
[[nodiscard]] Verdict check_reaches(const Subject& subject, const Point& point, double tolerance_m);
/// The robot has reached each of its goals, World::Goal().
/// @throws Error if no robot has a goal.
[[nodiscard]] Verdict check_goals(const Subject& subject);
/// The robot has never been faster [m/s].
[[nodiscard]] Verdict check_speed(const Subject& subject, double most_mps);
/// The newest scan of the robot's first laser has a range of at most this [m].
/// @throws Error if the robot has no laser.
[[nodiscard]] Verdict check_sees(const Subject& subject, double most_m);
/// The robot has not collided.
[[nodiscard]] Verdict check_collisions(const Subject& subject);

/// Draws the moment of a verdict into a new file of the folder PLAYPEN_TEST_OUT, or of playpen_test
/// in the working folder.
/// @param test  name of the test, which becomes the file's name; further pictures get a number.
/// @return the text for a message: "picture: FILE", or why there is none.
[[nodiscard]] std::string picture_of(const Subject& subject, const Verdict& verdict,
                                     const std::string& test);

}  // namespace playpen::testing
