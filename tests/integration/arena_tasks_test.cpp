// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The tasks in arenas that change: each solution passes with the seeds of the task (per merge with
// some of them), each template fails with a reason. (The templates, filled in as their comments
// describe, are graded by the tests ..._template_filled.)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::cases;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

class ArenaTasks : public testing::Test {
 protected:
  /// `playpen grade TASK OPTIONS -- PROGRAM`, without a limit of wall-clock time.
  [[nodiscard]] ProcessResult grade(const std::string& task,
                                    const std::vector<std::string>& options,
                                    const std::string& program) const {
    std::vector<std::string> call = {"grade", task, "--timeout", "3000", "--out", out_};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", program});
    ProcessOptions patient;
    patient.timeout = std::chrono::seconds(3000);
    return playpen(call, patient);
  }
  /// How many seeds of the task are used.
  [[nodiscard]] static int seeds() { return cases(2, 5); }
  [[nodiscard]] static std::vector<std::string> with_seeds() {
    return {"--seeds", std::to_string(seeds())};
  }
  /// "TASK: all of the runs passed" of so many runs for each seed.
  [[nodiscard]] static std::string passed(const std::string& task, int per_seed = 1) {
    const std::string runs = std::to_string(per_seed * seeds());
    return task + ": " + runs + " of " + runs + " runs passed";
  }
  [[nodiscard]] json runs() const {
    return json::parse(read_bytes(fs::path(out_) / "grade.json")).at("runs");
  }
  [[nodiscard]] json report(const std::string& run) const {
    return read_report(fs::path(out_) / run);
  }
  /// The events of a run, from its report.
  [[nodiscard]] json events(const std::string& run) const { return report(run).at("events"); }
  /// The names of what a run's events of a kind are about.
  [[nodiscard]] std::set<std::string> named(const std::string& run, const std::string& kind) const {
    std::set<std::string> names;
    for (const json& event : events(run)) {
      if (event.at("kind") == kind) names.insert(event.at("what").get<std::string>());
    }
    return names;
  }

  TemporaryFolder folder_;
  std::string out_ = folder_ / "out";
};

TEST_F(ArenaTasks, Solution_LearnsPlacesOfTraps) {
  const ProcessResult graded = grade("par_traps", {}, TRAPS_PROGRAM);
  EXPECT_EQ(graded.status, 0) << graded.out << graded.err;
  EXPECT_THAT(graded.out, HasSubstr("par_traps: 5 of 5 runs passed"));
  std::set<double> times;
  std::set<std::string> sprung;
  for (const json& run : runs()) {
    EXPECT_EQ(run.at("verdict"), "passed");
    EXPECT_EQ(run.at("verdict_reason"), "the robot is at the goal");
    EXPECT_EQ(run.at("end").at("kind"), "verdict");
    times.insert(run.at("sim_time").get<double>());
    sprung.merge(named(run.at("folder").get<std::string>(), "trap"));
  }
  EXPECT_GT(times.size(), 1U) << "the seeds make no difference";
  for (const char* trap : {"pit", "plate", "mud", "snare_north", "goal"}) {
    EXPECT_EQ(sprung.count(trap), 1U) << trap;
  }
}

TEST_F(ArenaTasks, Template_LosesPointsInTrap) {
  const ProcessResult graded = grade("par_traps", {"--seeds", "2"}, TRAPS_TEMPLATE);
  EXPECT_EQ(graded.status, 1) << graded.out << graded.err;
  EXPECT_THAT(graded.out,
              HasSubstr("par_traps seeds 1 and 2: verdict: failed: the robot has no points left"));
  EXPECT_THAT(graded.out, HasSubstr("par_traps: 0 of 2 runs passed"));
  EXPECT_EQ(named("par_traps_seed1", "trap"), std::set<std::string>{"pit"});
}

TEST_F(ArenaTasks, Solution_ExploresChangedAreaAgain) {
  const ProcessResult graded = grade("par_exploration_changing", with_seeds(), CHANGING_PROGRAM);
  EXPECT_EQ(graded.status, 0) << graded.out << graded.err;
  EXPECT_THAT(graded.out, HasSubstr(passed("par_exploration_changing")));
  std::set<json> ends;
  for (const json& run : runs()) {
    EXPECT_EQ(run.at("end").at("kind"), "by-itself");
    ends.insert(report(run.at("folder").get<std::string>()).at("blocks"));
  }
  EXPECT_GT(ends.size(), 1U) << "the arena is the same in the end, whatever the seed";
}

TEST_F(ArenaTasks, ExplorersThatIgnoreChanges_Fail) {
  const ProcessResult still =
      grade("par_exploration_changing", {"--seeds", "1,"}, CHANGING_TEMPLATE);
  EXPECT_EQ(still.status, 1) << still.err;
  EXPECT_THAT(still.out, HasSubstr("coverage 0.000, at least 0.98 needed"));
  // The solution of the exploration task ends while the arena still changes.
  const ProcessResult early = grade("par_exploration_changing", with_seeds(), NEAREST_PROGRAM);
  EXPECT_EQ(early.status, 1) << early.err;
  EXPECT_THAT(early.out, HasSubstr("0 of " + std::to_string(seeds()) + " runs passed"));
  EXPECT_THAT(early.out, HasSubstr("score 0, at least 1 needed"));
}

TEST_F(ArenaTasks, Solution_CatchesFox) {
  const ProcessResult graded = grade("par_chase", {}, CHASE_PROGRAM);
  EXPECT_EQ(graded.status, 0) << graded.out << graded.err;
  EXPECT_THAT(graded.out, HasSubstr("par_chase: 5 of 5 runs passed"));
  std::set<double> times;
  for (const json& run : runs()) {
    EXPECT_EQ(run.at("verdict_reason"), "the fox is caught");
    times.insert(run.at("sim_time").get<double>());
  }
  EXPECT_GT(times.size(), 1U) << "the fox does the same with each seed";
}

TEST_F(ArenaTasks, Template_LosesFox) {
  const ProcessResult graded = grade("par_chase", with_seeds(), CHASE_TEMPLATE);
  EXPECT_EQ(graded.status, 1) << graded.out << graded.err;
  for (const json& run : runs()) EXPECT_EQ(run.at("verdict_reason"), "the fox got away");
  EXPECT_THAT(graded.out, HasSubstr(": verdict: failed: the fox got away"));
}

TEST_F(ArenaTasks, ParticleFilter_FindsRobotAndGoal) {
  const ProcessResult graded = grade("par_localization", with_seeds(), PARTICLES_PROGRAM);
  EXPECT_EQ(graded.status, 0) << graded.out << graded.err;
  EXPECT_THAT(graded.out, HasSubstr(passed("par_localization", 2)));
  std::set<double> times;
  for (const json& run : runs()) times.insert(run.at("sim_time").get<double>());
  EXPECT_GT(times.size(), 2U) << "the seeds make no difference";
}

TEST_F(ArenaTasks, Amcl_FindsRobotAndGoal) {
  const ProcessResult graded = grade("par_localization", with_seeds(), AMCL_PROGRAM);
  EXPECT_EQ(graded.status, 0) << graded.out << graded.err;
  EXPECT_THAT(graded.out, HasSubstr(passed("par_localization", 2)));
}

TEST_F(ArenaTasks, Template_WandersWithoutCollision) {
  // The task with a shorter duration per merge, because the template drives until the end.
  const std::string tasks = PLAYPEN_SOURCE_DIR "/worlds/tasks/";
  json task = json::parse(read_bytes(tasks + "par_localization.task.json"), nullptr, true, true);
  task.erase("$schema");
  task["duration"] = cases(100, 300);
  for (json& world : task["worlds"]) {
    world["world"] = tasks + world["world"].get<std::string>();
  }
  const ProcessResult graded = grade(folder_.write("par_localization.task.json", task.dump()),
                                     {"--seeds", "1,"}, LOCALIZATION_TEMPLATE);
  EXPECT_EQ(graded.status, 1) << graded.out << graded.err;
  EXPECT_THAT(graded.out, HasSubstr("par_localization seed 1: goal not reached"));
  EXPECT_THAT(graded.out, Not(HasSubstr("collision")));
  EXPECT_THAT(graded.out, HasSubstr("par_localization: 0 of 2 runs passed"));
}

}  // namespace
