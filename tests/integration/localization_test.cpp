// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The figures of docs/localisation.md, with fewer seeds per merge: robots with noisy odometry
// wander through the arena, the office and the cave, and amcl's most likely pose is compared with
// the true one. Results depend on the seeds only.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "nightly.h"
#include "sim/devices/amcl.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/world/description.h"

namespace sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Place {
  const char* name;
  std::string arena;  ///< JSON
  const char* model;
  std::vector<Pose> starts;
  double speed_mps;
  double turn_radps;
  double stop_m;  ///< distance of an obstacle ahead at which the robot turns
};

std::string map_of(const char* image, const char* origin) {
  return R"({"map": {"image": ")" PLAYPEN_SOURCE_DIR "/worlds/maps/" + std::string(image) +
         R"(", "resolution": 0.05, "simplify": 0.05, "origin": )" + origin + "}}";
}

const Place& arena() {
  static const Place kPlace{
      "arena", R"({"preset": "syrotek"})", "s1r", {{0.5, 0.4, 90 * kDegree}}, 0.3, 1.5, 0.25};
  return kPlace;
}
const Place& office() {
  static const Place kPlace{"office",
                            map_of("office.png", "[-15, -9]"),
                            "pioneer3dx",
                            {{-1.0, -0.4, 0.0},
                             {-12.6, 3.4, -90 * kDegree},
                             {10.6, -3.4, 90 * kDegree},
                             {5.0, -0.4, 180 * kDegree}},
                            0.6,
                            1.0,
                            0.6};
  return kPlace;
}
const Place& cave() {
  static const Place kPlace{"cave",
                            map_of("cave.png", "[-8, -8]"),
                            "pioneer2dx",
                            {{-6.0, -6.0, 45 * kDegree},
                             {-4.2, 4.4, 0.0},
                             {4.4, 4.2, 180 * kDegree},
                             {4.6, -4.6, 135 * kDegree}},
                            0.6,
                            1.0,
                            0.6};
  return kPlace;
}

std::string text_of(const Pose& pose) {
  std::array<char, 120> text{};
  const double yaw_deg = pose.yaw_rad / kDegree;
  // Whole tenths: no decimal point that a locale could change.
  std::snprintf(text.data(), text.size(), R"({"x": %de-1, "y": %de-1, "yaw_deg": %d})",
                static_cast<int>(std::lround(10 * pose.x_m)),
                static_cast<int>(std::lround(10 * pose.y_m)),
                static_cast<int>(std::lround(yaw_deg)));
  return text.data();
}

/// Drives ahead, and turns on the spot towards the more open side in front of an obstacle.
class Wanderer {
 public:
  explicit Wanderer(const Place& place) : place_(place) {}

  TwistCommand next(const LaserReading& scan) {
    double ahead_m = scan.range_max_m;
    double left_m = 0.0;
    double right_m = 0.0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.resolution_rad;
      const double range_m = scan.ranges_m[i];
      const bool in_the_way = std::abs(range_m * std::sin(angle)) < 0.75 * place_.stop_m;
      if (std::abs(angle) < 1.0 && in_the_way) ahead_m = std::min(ahead_m, range_m);
      (angle > 0.0 ? left_m : right_m) += range_m;
    }
    if (turn_ == 0.0 && ahead_m < place_.stop_m) turn_ = left_m > right_m ? 1.0 : -1.0;
    if (ahead_m > 1.6 * place_.stop_m) turn_ = 0.0;
    if (turn_ != 0.0) return {{0.0, turn_ * place_.turn_radps, 0.0}};
    phase_ += 0.05;
    return {{place_.speed_mps, 0.15 * place_.turn_radps * std::sin(phase_), 0.0}};
  }

 private:
  const Place& place_;
  double turn_ = 0.0;
  double phase_ = 0.0;
};

struct Sample {
  double error_m;
  double error_rad;
  double weight;
};

class Trial {
 public:
  /// @param knows_start  whether amcl gets the start as its initial pose.
  Trial(const Place& place, int seed, bool knows_start)
      : place_(place),
        seed_(static_cast<std::size_t>(seed)),
        simulation_(load_world_text(world(knows_start))),
        amcl_(find<Amcl>("amcl")),
        laser_(find<Laser>("laser")),
        wanderer_(place) {}

  /// Drives, and compares the poses each second.
  void drive(int seconds, std::vector<Sample>* samples) {
    const int motion = *simulation_.find_device(0, "motion");
    for (int step = 1; step <= 100 * seconds; ++step) {
      simulation_.step();
      if (step % 10 == 0) {
        ASSERT_EQ(simulation_.apply({0, motion}, wanderer_.next(laser_.reading())), std::nullopt);
      }
      if (step % 100 == 0 && samples != nullptr) samples->push_back(compared());
    }
  }

  /// Moves the robot to the next start, or across the arena.
  void kidnap() {
    const Pose to = place_.starts.size() == 1 ? Pose{2.9, 3.2, -120 * kDegree}
                                              : place_.starts[(seed_ + 1) % place_.starts.size()];
    ASSERT_EQ(simulation_.place_object("r1", to), std::nullopt);
  }

  [[nodiscard]] Sample compared() const {
    const PoseHypothesis& best = amcl_.reading().hypotheses.at(0);
    const Pose& truth = simulation_.body(0).X_WB;
    return {(best.mean.position() - truth.position()).norm(),
            std::abs(normalize_angle(best.mean.yaw_rad - truth.yaw_rad)), best.weight};
  }
  /// Whether the filter has found the robot.
  [[nodiscard]] bool is_found() const {
    const Sample now = compared();
    return now.error_m < 0.5 && now.error_rad < 15 * kDegree && now.weight > 0.5;
  }
  [[nodiscard]] const AmclReading& reading() const { return amcl_.reading(); }

 private:
  [[nodiscard]] std::string world(bool knows_start) const {
    const Pose& start = place_.starts[seed_ % place_.starts.size()];
    std::string settings;
    if (knows_start) {
      settings = R"("init_pose": )" + text_of(start) +
                 R"(, "init_pose_var": [0.1, 0.1], "init_pose_var_yaw_deg": 5)";
    }
    return R"({"arena": )" + place_.arena + R"(, "simulation": {"seed": )" + std::to_string(seed_) +
           R"(}, "robots": [{"name": "r1", "model": ")" + place_.model + R"(", "pose": )" +
           text_of(start) +
           R"(, "devices": {"odometry": {"noise": 0.005, "wheel_ratio": 1.01,
                "wheelbase_ratio": 1.02}, "laser": {"noise": 0.01}, "amcl": {)" +
           settings + "}}}]}";
  }
  template <typename Type>
  [[nodiscard]] const Type& find(const char* name) const {
    return dynamic_cast<const Type&>(simulation_.device(0, *simulation_.find_device(0, name)));
  }

  const Place& place_;
  std::size_t seed_;
  Simulation simulation_;
  const Amcl& amcl_;
  const Laser& laser_;
  Wanderer wanderer_;
};

double median(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return numbers[numbers.size() / 2];
}

TEST(Localization, NoisyOdometry_TracksInArena) {
  std::vector<double> errors_m;
  std::vector<double> errors_rad;
  const int seeds = test_support::cases(5, 20);
  for (int seed = 1; seed <= seeds; ++seed) {
    Trial run(arena(), seed, true);
    std::vector<Sample> samples;
    run.drive(60, &samples);
    for (const Sample& sample : samples) {
      errors_m.push_back(sample.error_m);
      errors_rad.push_back(sample.error_rad);
    }
    EXPECT_TRUE(run.is_found()) << "seed " << seed;
  }
  std::printf("arena, tracking, %d seeds: median error %.1f cm, %.2f degrees; largest %.1f cm\n",
              seeds, 100 * median(errors_m), median(errors_rad) / kDegree,
              100 * *std::max_element(errors_m.begin(), errors_m.end()));
  EXPECT_LT(median(errors_m), 0.05);
  EXPECT_LT(median(errors_rad), 2 * kDegree);
}

void expect_found(const Place& place, int seconds) {
  const int seeds = test_support::cases(8, 20);
  int found = 0;
  std::vector<double> errors_m;
  for (int seed = 1; seed <= seeds; ++seed) {
    Trial run(place, seed, false);
    run.drive(seconds, nullptr);
    if (!run.is_found()) continue;
    ++found;
    errors_m.push_back(run.compared().error_m);
  }
  ASSERT_FALSE(errors_m.empty());
  std::printf("%s, from anywhere, after %d s: found %d of %d; median error %.1f cm\n", place.name,
              seconds, found, seeds, 100 * median(errors_m));
  // The filter finds 19 of 20 robots. Of 8 robots, 4 standard errors would allow
  // 8 * 0.05 + 4 * sqrt(8 * 0.95 * 0.05) = 2.9 misses; one is enough for these seeds.
  EXPECT_GE(found, test_support::cases(7, 18));
}

TEST(Localization, Office_FindsRobot) { expect_found(office(), 60); }
TEST(Localization, Cave_FindsRobot) { expect_found(cave(), 40); }

void expect_recovery(const Place& place, int seconds, int least) {
  constexpr int kRuns = 10;
  int found = 0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    Trial run(place, seed, true);
    run.drive(20, nullptr);
    EXPECT_TRUE(run.is_found()) << "seed " << seed;
    run.kidnap();
    run.drive(seconds, nullptr);
    found += run.is_found() ? 1 : 0;
  }
  std::printf("%s, kidnapped, after %d s: found %d of %d\n", place.name, seconds, found, kRuns);
  EXPECT_GE(found, least);
}

TEST(Localization, Arena_FindsKidnappedRobot) { expect_recovery(arena(), 40, 9); }
// Rooms of the office are alike: a robot that never leaves its room may be found in the wrong one.
TEST(Localization, Office_FindsKidnappedRobot) { expect_recovery(office(), 100, 7); }
TEST(Localization, Cave_FindsKidnappedRobot) { expect_recovery(cave(), 40, 9); }

TEST(Localization, Repeatable) {
  const auto result = [] {
    Trial run(arena(), 3, false);
    run.drive(15, nullptr);
    return run.reading();
  };
  const AmclReading first = result();
  const AmclReading again = result();
  ASSERT_EQ(first.hypotheses.size(), again.hypotheses.size());
  for (std::size_t i = 0; i < first.hypotheses.size(); ++i) {
    EXPECT_EQ(first.hypotheses[i].mean, again.hypotheses[i].mean);
    EXPECT_EQ(first.hypotheses[i].covariance.variance, again.hypotheses[i].covariance.variance);
    EXPECT_EQ(first.hypotheses[i].weight, again.hypotheses[i].weight);
  }
  EXPECT_EQ(first.particles, again.particles);
}

}  // namespace
}  // namespace sim
