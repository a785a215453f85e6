// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/report_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "temporary_folder.h"

namespace playerlike {
namespace {

using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

TEST(ReportSummary, ShowsFiguresOfRunAndRobots) {
  const TemporaryFolder folder;
  const std::string file = folder.write("report.json", R"({
    "run": {"sim_time": 120.0, "wall_time": 0.0251, "real_time_factor": 4780.9, "seed": 7},
    "robots": [
      {"name": "r1", "path_length": 23.796, "collisions": 0, "least_clearance": 0.02301,
       "stalled_time": 0.0},
      {"name": "long_name", "path_length": 0.0, "collisions": 12, "least_clearance": 0.0,
       "stalled_time": 3.456}]})");
  EXPECT_EQ(summarize_report(file),
            "120.0 s simulated in 0.025 s: 4780.9 times real time (seed 7)\n"
            "  robot      path [m]  collisions  least clearance [m]  stalled [s]\n"
            "  r1            23.80           0                0.023         0.00\n"
            "  long_name      0.00          12                0.000         3.46\n");
}

TEST(ReportSummary, RobotsThatStalledMostly_Named) {
  const TemporaryFolder folder;
  // r1 stalled for 9 of 12 s and r2 for exactly half of its time. The driven time of r3 is too
  // short.
  const std::string file = folder.write("report.json", R"({
    "run": {"sim_time": 20.0, "wall_time": 0.1, "real_time_factor": 200.0, "seed": 7},
    "robots": [
      {"name": "r1", "path_length": 1.0, "collisions": 1, "least_clearance": 0.0,
       "stalled_time": 9.0, "driven_time": 12.0},
      {"name": "r2", "path_length": 1.0, "collisions": 1, "least_clearance": 0.0,
       "stalled_time": 6.0, "driven_time": 12.0},
      {"name": "r3", "path_length": 1.0, "collisions": 1, "least_clearance": 0.0,
       "stalled_time": 0.7, "driven_time": 0.9}]})");
  const std::string summary = summarize_report(file);
  EXPECT_THAT(summary,
              HasSubstr("\nr1 was stalled for 75 % of the time that it drove: "
                        "'playpen doc which_world' names the world that suits a program\n"));
  EXPECT_THAT(summary, Not(HasSubstr("r2 was stalled")));
  EXPECT_THAT(summary, Not(HasSubstr("r3 was stalled")));
}

TEST(ReportSummary, ShowsScoresAndVerdict) {
  const TemporaryFolder folder;
  const auto summary = [&](const std::string& verdict) {
    return summarize_report(folder.write("report.json", R"({
      "run": {"sim_time": 20.0, "wall_time": 0.1, "real_time_factor": 200.0, "seed": 7},
      "robots": [], "scores": {"r1": 3.0, "r2": -0.5}, "verdict": )" +
                                                            verdict + "}"));
  };
  EXPECT_THAT(summary(R"({"passed": true, "reason": "at the goal", "time": 9.5})"),
              HasSubstr("scores: r1 3, r2 -0.5\nverdict: passed after 9.50 s: at the goal\n"));
  EXPECT_THAT(summary(R"({"passed": false, "reason": "", "time": 9.5})"),
              HasSubstr("verdict: failed after 9.50 s\n"));
  EXPECT_THAT(summary("null"), HasSubstr("verdict: none\n"));
}

TEST(ReportSummary, UnusualRealism_Named) {
  const TemporaryFolder folder;
  const auto summary_with = [&](const std::string& level) {
    return summarize_report(folder.write(
        "report.json",
        R"({"run": {"sim_time": 1.0, "wall_time": 1.0, "real_time_factor": 1.0, "seed": 7,
            "realism": ")" +
            level + R"("}, "robots": []})"));
  };
  EXPECT_THAT(summary_with("real"), HasSubstr("(seed 7, realism real)\n"));
  EXPECT_THAT(summary_with("course"), HasSubstr("(seed 7)\n"));
}

TEST(ReportSummary, NotRepeatable_ReasonsShown) {
  const TemporaryFolder folder;
  const std::string file = folder.write("report.json", R"({
    "run": {"sim_time": 1.0, "wall_time": 1.0, "real_time_factor": 1.0, "seed": 7,
            "repeatable": false, "repeatable_why": ["because", "and so"]},
    "robots": []})");
  EXPECT_THAT(summarize_report(file), HasSubstr("another run may differ:\n  because\n  and so\n"));
}

TEST(ReportSummary, MissingOrInvalidFile_Named) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { static_cast<void>(summarize_report(folder / "none.json")); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("none.json"), HasSubstr("read"))));
  for (const char* text : {"", "{", "[]", "{}", R"({"run": {}, "robots": []})"}) {
    const std::string file = folder.write("report.json", text);
    EXPECT_THAT([&] { static_cast<void>(summarize_report(file)); },
                ThrowsMessage<std::runtime_error>(HasSubstr("report.json")))
        << text;
  }
}

}  // namespace
}  // namespace playerlike
