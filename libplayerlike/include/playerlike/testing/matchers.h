// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <utility>

#include "playerlike/testing/check.h"

/// Matchers of GoogleTest's gmock for runs and for single robots:
///
///     EXPECT_THAT(run, KeepsClearOf(0.1));
///     EXPECT_THAT(of(run, "r2"), Reaches({3.1, 3.3}, 0.1));
///
/// They judge the run up to now; of a run, each robot must match. If an expectation fails, the
/// message names robot, time and place, and a picture of the moment (picture_of()).
namespace playpen::testing {

/// A matcher made of a check and its description.
template <typename Check>
class CheckMatcher {
 public:
  CheckMatcher(Check check, std::string wanted, std::string unwanted)
      : check_(std::move(check)), wanted_(std::move(wanted)), unwanted_(std::move(unwanted)) {}

  bool MatchAndExplain(const Subject& subject, ::testing::MatchResultListener* listener) const {
    const Verdict verdict = check_(subject);
    if (!listener->IsInterested()) return verdict.met;
    *listener << verdict.text;
    // GoogleTest listens after an expectation has failed, but AllOf() and the like always do.
    if (verdict.met) return true;
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const std::string name =
        test == nullptr ? "test" : std::string(test->test_suite_name()) + '.' + test->name();
    *listener << "; " << picture_of(subject, verdict, name);
    return false;
  }
  void DescribeTo(std::ostream* out) const { *out << wanted_; }
  void DescribeNegationTo(std::ostream* out) const { *out << unwanted_; }

 private:
  Check check_;
  std::string wanted_, unwanted_;
};

/// A matcher of a check and the words for what is wanted and what is not.
template <typename Check>
auto make_matcher(Check check, std::string wanted, std::string unwanted) {
  return ::testing::MakePolymorphicMatcher(
      CheckMatcher<Check>(std::move(check), std::move(wanted), std::move(unwanted)));
}

/// The robot's body keeps at least this distance to everything solid [m], all the time.
inline auto KeepsClearOf(double least_m) {
  const std::string distance = ::testing::PrintToString(least_m) + " m";
  return make_matcher([=](const Subject& s) { return check_clearance(s, least_m); },
                      "keeps at least " + distance + " clear of everything solid",
                      "comes closer than " + distance + " to something solid");
}

/// The robot is within the tolerance of the point at some time [m].
inline auto Reaches(const Point& point, double tolerance_m) {
  const std::string place = "x " + ::testing::PrintToString(point.x_m) + ", y " +
                            ::testing::PrintToString(point.y_m) + " to within " +
                            ::testing::PrintToString(tolerance_m) + " m";
  return make_matcher([=](const Subject& s) { return check_reaches(s, point, tolerance_m); },
                      "reaches " + place, "does not reach " + place);
}

/// The robot reaches each of its goals, World::Goal().
inline auto ReachesGoals() {
  return make_matcher([](const Subject& s) { return check_goals(s); }, "reaches all its goals",
                      "does not reach all its goals");
}

/// The robot is never faster than this [m/s].
inline auto NeverFasterThan(double most_mps) {
  const std::string speed = ::testing::PrintToString(most_mps) + " m/s";
  return make_matcher([=](const Subject& s) { return check_speed(s, most_mps); },
                      "is never faster than " + speed, "is faster than " + speed);
}

/// The newest scan of the robot's first laser has a range of at most this [m].
inline auto SeesWallWithin(double most_m) {
  const std::string distance = ::testing::PrintToString(most_m) + " m";
  return make_matcher([=](const Subject& s) { return check_sees(s, most_m); },
                      "sees something within " + distance, "sees nothing within " + distance);
}

/// The robot does not collide.
inline auto DoesNotCollide() {
  return make_matcher([](const Subject& s) { return check_collisions(s); }, "does not collide",
                      "collides");
}

}  // namespace playpen::testing
