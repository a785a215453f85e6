// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/class_likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>

#include "sim/core/number_text.h"
#include "temporary_folder.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

/// A trajectory along a circle, as a run writes it.
std::string circle(double radius) {
  std::string text = "time,robot,x,y,yaw,v,omega,stalled\n";
  constexpr int kSamples = 1200;
  constexpr double kSpeed = 0.3;
  for (int k = 0; k < kSamples; ++k) {
    const double angle = kSpeed * 0.1 * k / radius;
    const double yaw = std::remainder(angle + M_PI_2, 2 * M_PI);
    text += sim::fixed_text(0.1 * k, 3) + ",r1," +
            sim::fixed_text(1.7 + radius * std::cos(angle), 6) + ',' +
            sim::fixed_text(1.7 + radius * std::sin(angle), 6) + ',' + sim::fixed_text(yaw, 6) +
            ",0.3," + sim::fixed_text(kSpeed / radius, 6) + ",0\n";
  }
  return text;
}

class CompareSubmissions : public testing::Test {
 protected:
  CompareSubmissions() {
    grade::Task task;
    task.name = "maze";
    task.worlds = {{"", {}, std::nullopt}};
    task.seeds = {1};
    result_.tasks = {task};
  }

  SubmissionResult program(const std::string& id, double radius, const std::string& parent) {
    SubmissionResult one;
    one.id = id;
    one.folder = parent + id;
    one.build.built = true;
    grade::GradedRun run;
    run.world = "default";
    run.seed = 1;
    run.folder = "default_seed1";
    run.robot = "r1";
    one.grades = {{result_.tasks.front(), {}, {run}, true}};
    folder_.write(one.folder + "/maze/default_seed1/trajectory.csv", circle(radius));
    folder_.write(one.folder + "/build/source/main.cc", "int main() {}\n");
    return one;
  }
  void hand_in(const std::string& id, double radius) {
    result_.submissions.push_back(program(id, radius, "submissions/"));
  }

  test_support::TemporaryFolder folder_;
  ClassResult result_;
};

TEST_F(CompareSubmissions, EqualDrives_ListedDrawnAndExported) {
  hand_in("ada", 1.0);
  hand_in("bob", 0.6);
  hand_in("eve", 1.001);
  SubmissionResult nobody;
  nobody.id = "nobody";
  nobody.handed_in = false;
  result_.submissions.push_back(nobody);
  compare_submissions(result_, folder_.path());
  ASSERT_EQ(result_.pairs.size(), 1U);
  const LikePair& pair = result_.pairs.front();
  EXPECT_EQ(pair.first, 0U);
  EXPECT_EQ(pair.second, 2U);
  EXPECT_GT(pair.likeness, pair.threshold);
  EXPECT_EQ(pair.picture, "pairs/ada-eve.svg");
  EXPECT_TRUE(fs::exists(folder_ / pair.picture));
  EXPECT_TRUE(fs::exists(folder_ / "sources/bob/main.cc"));
}

TEST_F(CompareSubmissions, ManyPairs_OnlySomeDrawn) {
  constexpr std::size_t kPrograms = 16;  // 120 pairs
  for (std::size_t i = 0; i < kPrograms; ++i) hand_in("s" + std::to_string(i), 1.0);
  compare_submissions(result_, folder_.path());
  ASSERT_EQ(result_.pairs.size(), kPrograms * (kPrograms - 1) / 2);
  EXPECT_EQ(result_.pairs[kMostDrawnPairs].picture, "");
  const auto drawn = std::distance(fs::directory_iterator(folder_ / "pairs"), {});
  EXPECT_EQ(static_cast<std::size_t>(drawn), kMostDrawnPairs);
}

TEST_F(CompareSubmissions, Baseline_ExplainsLikeness) {
  hand_in("ada", 1.0);
  hand_in("eve", 1.0);
  folder_.write("pairs/ada-eve.svg", "of an earlier class");
  result_.baselines.push_back(program("template", 1.0, "baselines/"));
  compare_submissions(result_, folder_.path());
  EXPECT_TRUE(result_.pairs.empty());
  EXPECT_FALSE(fs::exists(folder_ / "pairs/ada-eve.svg"));
}

}  // namespace
}  // namespace playpen::course
