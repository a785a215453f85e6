// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Levels of realism, and the errors of sensors and motors against their formulas. Bounds of
// statistics are 4 standard errors; the seeds are fixed.
#include "sim/world/realism.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/devices/builtin.h"
#include "sim/devices/gps.h"
#include "sim/devices/imu.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/motion.h"
#include "sim/devices/rangers.h"
#include "sim/devices/realism.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegrees = std::numbers::pi / 180.0;
constexpr double kWheelSeparation_m = 0.14;  // of the S1R

/// A world with one S1R at (20, 20), heading along x, in a room of 40 x 40 m.
WorldDescription open_world(const std::string& devices, const std::string& simulation = "") {
  return load_world_text(
      R"({"arena": {"size": [40, 40]}, "simulation": {)" + simulation +
      R"(}, "robots": [{"name": "r1", "pose": {"x": 20, "y": 20}, "devices": {)" + devices +
      "}}]}");
}

/// An S1R whose laser, at the middle of the robot, looks along x at a wall `distance_m` ahead.
WorldDescription wall_world(double distance_m, const std::string& laser) {
  return load_world_text(
      R"({"arena": {"size": [20, 20], "border": false, "obstacles": [{"center": [)" +
      shortest_text(distance_m + 2.5) +
      R"(, 10], "size": [1, 10]}]}, "robots": [{"pose": {"x": 2, "y": 10}, "devices": {"laser": )" +
      R"({"pose": {"x": 0}, "beams": 1, "range_max": 10, "frequency": 100)" + laser + "}}}]}");
}

template <typename DeviceType>
const DeviceType& device(const Simulation& simulation, const std::string& name, int robot = 0) {
  return dynamic_cast<const DeviceType&>(
      simulation.device(robot, simulation.find_device(robot, name).value()));
}

void send(Simulation& simulation, const std::string& name, const Command& command) {
  const auto refusal = simulation.apply({0, simulation.find_device(0, name).value()}, command);
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

/// Mean and standard deviation of samples.
struct Moments {
  double mean = 0.0;
  double deviation = 0.0;
};

Moments moments_of(const std::vector<double>& samples) {
  const auto count = static_cast<double>(samples.size());
  double sum = 0.0;
  for (const double sample : samples) sum += sample;
  double squares = 0.0;
  for (const double sample : samples) squares += (sample - sum / count) * (sample - sum / count);
  return {sum / count, std::sqrt(squares / count)};
}

/// Expects independent Gaussian samples. Four standard errors: of a mean sigma / sqrt(n), of a
/// deviation sigma / sqrt(2 n).
void expect_gaussian(const std::vector<double>& samples, double mean, double sigma) {
  const auto count = static_cast<double>(samples.size());
  const Moments found = moments_of(samples);
  EXPECT_NEAR(found.mean, mean, 4.0 * sigma / std::sqrt(count));
  EXPECT_NEAR(found.deviation, sigma, 4.0 * sigma / std::sqrt(2.0 * count));
}

/// Expects that an event of this probability occurred that often in independent trials. The
/// deviation of the share is sqrt(p (1 - p) / n).
void expect_share(int events, int trials, double probability) {
  const double deviation = std::sqrt(probability * (1.0 - probability) / trials);
  EXPECT_NEAR(static_cast<double>(events) / trials, probability, 4.0 * deviation);
}

// --- ranges

std::vector<double> ranges_at(double distance_m, const std::string& laser, int count) {
  Simulation simulation(wall_world(distance_m, laser));
  std::vector<double> ranges;
  for (int i = 0; i < count; ++i) {
    simulation.step();
    ranges.push_back(device<Laser>(simulation, "laser").reading().ranges_m.at(0));
  }
  return ranges;
}

TEST(LaserNoise, ConstantNearbyAndProportionalBeyond) {
  const std::string noise = R"(, "noise": 0.01, "noise_share": 0.01)";
  expect_gaussian(ranges_at(0.5, noise, 4000), 0.5, 0.01);
  expect_gaussian(ranges_at(1.0, noise, 4000), 1.0, 0.01);
  expect_gaussian(ranges_at(4.0, noise, 4000), 4.0, 0.04);
  expect_gaussian(ranges_at(8.0, R"(, "noise_share": 0.002)", 4000), 8.0, 0.016);
}

TEST(LaserDropouts, ReadMaximumRangeWithTheirProbability) {
  const std::vector<double> ranges = ranges_at(3.0, R"(, "dropouts": 0.05)", 10000);
  int lost = 0;
  for (const double range : ranges) {
    lost += range == 10.0 ? 1 : 0;
    EXPECT_TRUE(range == 10.0 || std::abs(range - 3.0) < 1e-6) << range;
  }
  expect_share(lost, 10000, 0.05);
}

// A post of 0.4 m, 2 m ahead of the laser, in front of a wall 4 m ahead: two depth edges.
WorldDescription post_world(const std::string& laser) {
  return load_world_text(
      R"({"arena": {"size": [20, 20], "border": false, "obstacles": [
            {"center": [6.5, 10], "size": [1, 10]}, {"center": [4.2, 10], "size": [0.4, 0.4]}]},
          "robots": [{"pose": {"x": 2, "y": 10}, "devices": {"laser": {"pose": {"x": 0},
            "beams": 41, "resolution_deg": 0.5, "range_max": 10, "frequency": 100)" +
      laser + "}}}]}");
}

TEST(LaserMixedPixels, LieBetweenSurfacesOfDepthEdge) {
  constexpr int kScans = 5000;
  Simulation plain(post_world(""));
  plain.step();
  const std::vector<double> exact = device<Laser>(plain, "laser").reading().ranges_m;
  std::vector<std::size_t> edges;  // the first of two beams
  for (std::size_t i = 0; i + 1 < exact.size(); ++i) {
    if (std::abs(exact[i] - exact[i + 1]) > 1.0) edges.push_back(i);
  }
  ASSERT_EQ(edges.size(), 2U);

  Simulation simulation(post_world(R"(, "mixed_pixels": 0.3)"));
  int mixed = 0;
  int first_beams = 0;
  std::vector<double> parts;  // place between the two surfaces, 0..1
  for (int scan = 0; scan < kScans; ++scan) {
    simulation.step();
    const std::vector<double>& ranges = device<Laser>(simulation, "laser").reading().ranges_m;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (ranges[i] == exact[i]) continue;
      const auto edge = std::find_if(edges.begin(), edges.end(),
                                     [i](std::size_t e) { return i == e || i == e + 1; });
      ASSERT_NE(edge, edges.end()) << "beam " << i << " is at no edge";
      ++mixed;
      first_beams += i == *edge ? 1 : 0;
      parts.push_back((ranges[i] - exact[*edge]) / (exact[*edge + 1] - exact[*edge]));
    }
  }
  expect_share(mixed, 2 * kScans, 0.3);
  expect_share(first_beams, mixed, 0.5);
  // Uniform in [0, 1): the mean is 1/2, the variance 1/12. The fourth central moment is 1/80, so
  // the variance of a sample variance is (1/80 - 1/144) / n = 1 / (180 n).
  const auto count = static_cast<double>(parts.size());
  const Moments found = moments_of(parts);
  EXPECT_NEAR(found.mean, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / count));
  EXPECT_NEAR(found.deviation * found.deviation, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / count));
  EXPECT_GE(*std::min_element(parts.begin(), parts.end()), 0.0);
  EXPECT_LT(*std::max_element(parts.begin(), parts.end()), 1.0);
}

TEST(LaserMixedPixels, NoDepthEdge_None) {
  // Neighbouring beams on one wall under 80 degrees differ by r * step * tan 80 = 5.67 r step.
  EXPECT_FALSE(is_depth_edge(4.0, 4.1, 0.007, 5.0));  // 0.02 + 5.67 * 4 * 0.007 = 0.179
  EXPECT_TRUE(is_depth_edge(4.0, 4.2, 0.007, 5.0));
  EXPECT_TRUE(is_depth_edge(4.2, 4.0, 0.007, 5.0));
  EXPECT_FALSE(is_depth_edge(4.0, 5.0, 0.007, 5.0));  // nothing behind the edge
  EXPECT_FALSE(is_depth_edge(0.5, 0.52, 0.007, 5.0));
}

TEST(RangerNoise, MatchesFormulaOfLaser) {
  for (const char* kind : {"infrared", "sonar"}) {
    Simulation simulation(load_world_text(
        R"({"arena": {"size": [20, 20], "border": false, "obstacles": [{"center": [4.5, 10], "size":
            [1, 10]}]}, "robots": [{"pose": {"x": 2, "y": 10}, "devices": {"ranger": {"type": ")" +
        std::string(kind) +
        R"(", "frequency": 100, "mounts": [{"x": 0}], "range_max": 3, "noise": 0.005,
            "noise_share": 0.01, "dropouts": 0.1}}}]})"));
    std::vector<double> ranges;
    int lost = 0;
    for (int i = 0; i < 5000; ++i) {
      simulation.step();
      const double range = device<Ranger>(simulation, "ranger").reading().ranges_m.at(0);
      if (range == 3.0) {
        ++lost;
      } else {
        ranges.push_back(range);
      }
    }
    expect_gaussian(ranges, 2.0, 0.02);
    expect_share(lost, 5000, 0.1);
  }
}

// --- odometry

// Drives and returns the odometry's pose, in the frame of the start.
Pose odometry_of(const Simulation& simulation) {
  return device<Odometry>(simulation, "odometry").pose_estimate().value();
}

TEST(OdometryErrors, WheelErrors_MatchUmbmark) {
  constexpr double kRatio = 1.02;      // E_d
  constexpr double kWheelbase = 1.05;  // E_b
  const std::string devices = R"("odometry": {"wheel_ratio": )" + shortest_text(kRatio) +
                              R"(, "wheelbase_ratio": )" + shortest_text(kWheelbase) + "}";
  // Straight on for 2 m. Odometry assumes wheels of the mean diameter, so it measures the left path
  // times (E_d + 1) / 2 and the right path times (1 / E_d + 1) / 2.
  Simulation straight(open_world(devices));
  send(straight, "motion", TwistCommand{{.v_mps = 0.5}});
  run(straight, 400);
  const double left = 2.0 * 0.5 * (kRatio + 1.0);
  const double right = 2.0 * 0.5 * (1.0 / kRatio + 1.0);
  EXPECT_NEAR(odometry_of(straight).yaw_rad, kWheelbase * (right - left) / kWheelSeparation_m,
              1e-9);
  // On the spot by one radian, with equal wheels: odometry measures E_b as much.
  Simulation turn(open_world(R"("odometry": {"wheelbase_ratio": 1.05})"));
  send(turn, "motion", TwistCommand{{.omega_radps = 0.5}});
  run(turn, 200);
  EXPECT_NEAR(odometry_of(turn).yaw_rad, 1.05, 1e-9);
}

// UMBmark: the robot drives a square of 4 m by its odometry. Returns how far it ends from its
// start, along the first leg.
double end_of_square_m(double direction, const std::string& devices) {
  Simulation simulation(open_world(devices));
  const int frame = simulation.find_device(0, "odometry").value();
  for (int leg = 0; leg < 4; ++leg) {
    const double yaw = normalize_angle(0.5 * std::numbers::pi * leg * direction);
    const double next = normalize_angle(0.5 * std::numbers::pi * (leg + 1) * direction);
    send(simulation, "motion", HeadingCommand{0.4, 0.0, yaw, frame});
    run(simulation, 1000);
    send(simulation, "motion", HeadingCommand{0.0, 0.0, next, frame});
    run(simulation, 1500);  // the error falls to 1 / e in 0.5 s
  }
  return simulation.body(0).X_WB.x_m - 20.0;
}

TEST(OdometryErrors, UmbmarkExperiment_RecoversThem) {
  constexpr double kSide_m = 4.0;
  constexpr double kRatio = 1.0002;     // E_d
  constexpr double kWheelbase = 1.005;  // E_b
  const std::string devices = R"("odometry": {"wheel_ratio": )" + shortest_text(kRatio) +
                              R"(, "wheelbase_ratio": )" + shortest_text(kWheelbase) + "}";
  const double x_ccw = end_of_square_m(1.0, devices);
  const double x_cw = end_of_square_m(-1.0, devices);
  // Borenstein and Feng 1996: alpha is what each turn lacks of 90 degrees, beta the turn of each
  // leg; x_cw = -2 L (alpha + beta), x_ccw = -2 L (alpha - beta).
  const double alpha = (x_cw + x_ccw) / (-4.0 * kSide_m);
  const double beta = (x_cw - x_ccw) / (-4.0 * kSide_m);
  const double radius_m = 0.5 * kSide_m / std::sin(0.5 * beta);
  const double half_m = 0.5 * kWheelSeparation_m;
  // The formulas are of first order. alpha is 0.0078, so they are good to about 2 %.
  EXPECT_NEAR((radius_m + half_m) / (radius_m - half_m) - 1.0, kRatio - 1.0, 0.03 * (kRatio - 1.0));
  const double quarter = 0.5 * std::numbers::pi;
  EXPECT_NEAR(quarter / (quarter - alpha) - 1.0, kWheelbase - 1.0, 0.03 * (kWheelbase - 1.0));
}

TEST(OdometryErrors, ScaleAndDrift_MatchFormulas) {
  Simulation scaled(open_world(R"("odometry": {"scale": 1.05})"));
  send(scaled, "motion", TwistCommand{{.v_mps = 0.5}});
  run(scaled, 200);
  EXPECT_NEAR(odometry_of(scaled).x_m, 1.05, 1e-9);
  EXPECT_EQ(odometry_of(scaled).yaw_rad, 0.0);
  // A gyroscope drifts at rest, too: 0.5 degrees per second for 10 s.
  Simulation drifting(open_world(R"("odometry": {"heading_drift_deg": 0.5})"));
  run(drifting, 1000);
  EXPECT_NEAR(odometry_of(drifting).yaw_rad, 5.0 * kDegrees, 1e-12);
}

TEST(OdometryErrors, RandomDrift_GrowsWithRootOfTime) {
  // Increments of 0.1 s are independent, with deviation 2 degrees * sqrt(0.1).
  Simulation simulation(open_world(R"("odometry": {"heading_noise_deg": 2})"));
  std::vector<double> increments;
  double before = 0.0;
  for (int i = 0; i < 4000; ++i) {
    run(simulation, 10);
    const double now = odometry_of(simulation).yaw_rad;
    increments.push_back(normalize_angle(now - before));
    before = now;
  }
  expect_gaussian(increments, 0.0, 2.0 * kDegrees * std::sqrt(0.1));
}

TEST(OdometryErrors, ScaleNoise_DrawnPerReading) {
  Simulation simulation(open_world(R"("odometry": {"scale": 1.1, "scale_noise": 0.05})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 0.0005}});
  std::vector<double> factors;
  for (int i = 0; i < 4000; ++i) {
    run(simulation, 10);  // 0.1 s: 50 um, one reading
    factors.push_back(device<Odometry>(simulation, "odometry").reading().path_length_m / 0.00005);
  }
  expect_gaussian(factors, 1.1, 0.05);
}

TEST(OdometryErrors, ReadingNoise_NotIntegrated) {
  Simulation simulation(open_world(R"("odometry": {"noise_pose": 0.02, "noise_pose_yaw_deg": 3})"));
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> yaw;
  for (int i = 0; i < 3000; ++i) {
    run(simulation, 10);
    const PoseReading& reading = device<Odometry>(simulation, "odometry").reading();
    x.push_back(reading.pose.x_m);
    y.push_back(reading.pose.y_m);
    yaw.push_back(reading.pose.yaw_rad);
    EXPECT_EQ(reading.increment, Pose{});
  }
  expect_gaussian(x, 0.0, 0.02);
  expect_gaussian(y, 0.0, 0.02);
  expect_gaussian(yaw, 0.0, 3.0 * kDegrees);
  EXPECT_EQ(odometry_of(simulation), Pose{});
}

// --- slip

TEST(Slip, GaussMarkovProcessPerWheel) {
  MotionParams params;
  params.slip = 0.05;
  params.slip_time_s = 0.5;
  DriveDescription drive;
  Motion motion("motion", params, drive, RandomStream(7, "r1/motion"));
  ASSERT_TRUE(motion.slips());
  ASSERT_FALSE(motion.apply(TwistCommand{{.v_mps = 0.4, .omega_radps = 0.5}}).has_value());
  constexpr double kStep_s = 0.01;
  constexpr int kSteps = 100000;
  std::vector<double> left;
  std::vector<double> right;
  double worst_mps = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const Twist target = motion.next_target(kStep_s);
    const WheelSlip slip = motion.slip();
    // The wheels' speeds over the floor are those commanded, times 1 - slip.
    const double half_m = 0.5 * drive.wheel_separation_m;
    worst_mps = std::max({worst_mps,
                          std::abs(target.v_mps - half_m * target.omega_radps -
                                   (0.4 - half_m * 0.5) * (1.0 - slip.left)),
                          std::abs(target.v_mps + half_m * target.omega_radps -
                                   (0.4 + half_m * 0.5) * (1.0 - slip.right))});
    left.push_back(slip.left);
    right.push_back(slip.right);
  }
  EXPECT_LT(worst_mps, 1e-12);
  // With the autocorrelation exp(-|t| / T), n samples over a time n dt count as about n dt / (2 T)
  // independent ones for the mean, and as n dt / T for the variance.
  const double time_s = kSteps * kStep_s;
  const double independent = time_s / (2.0 * params.slip_time_s);
  for (const std::vector<double>* samples : {&left, &right}) {
    const Moments found = moments_of(*samples);
    EXPECT_NEAR(found.mean, 0.0, 4.0 * params.slip / std::sqrt(independent));
    EXPECT_NEAR(found.deviation, params.slip,
                4.0 * params.slip / std::sqrt(2.0 * 2.0 * independent));
    // Autocorrelation after T: 1 / e. By Bartlett's formula its standard error is below
    // sqrt(2 / independent).
    double covariance = 0.0;
    const auto lag = static_cast<std::size_t>(params.slip_time_s / kStep_s);
    for (std::size_t i = lag; i < samples->size(); ++i) {
      covariance += (*samples)[i] * (*samples)[i - lag];
    }
    covariance /= static_cast<double>(samples->size() - lag);
    EXPECT_NEAR(covariance / (params.slip * params.slip), std::exp(-1.0),
                4.0 * std::sqrt(2.0 / independent));
  }
  // The wheels slip independently.
  double product = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) product += left[i] * right[i];
  EXPECT_NEAR(product / kSteps, 0.0, 4.0 * params.slip * params.slip / std::sqrt(independent));
}

TEST(Slip, RobotLeavesLineUnnoticedByOdometry) {
  Simulation simulation(
      open_world(R"("motion": {"slip": 0.05, "slip_time": 0.5}, "odometry": {})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 0.5}});
  run(simulation, 2000);  // 10 m
  const Pose odometry = odometry_of(simulation);
  // The wheels turn as commanded, so odometry sees a straight line of 10 m.
  EXPECT_NEAR(odometry.x_m, 10.0, 1e-6);
  EXPECT_NEAR(odometry.y_m, 0.0, 1e-6);
  const Pose& truth = simulation.body(0).X_WB;
  EXPECT_GT((truth.position() - Vec2(20, 20) - odometry.position()).norm(), 0.01);
  const PoseReading& reading = device<Odometry>(simulation, "odometry").reading();
  EXPECT_NEAR(reading.twist.v_mps, 0.5, 1e-9);
  EXPECT_NEAR(reading.twist.omega_radps, 0.0, 1e-9);
}

TEST(Slip, HeadingError_MatchesFormula) {
  // The heading error after a time t >> T at speed v is the integral of v (s_left - s_right) / b.
  // Its variance is 2 (v sigma / b)^2 2 T (t - T (1 - exp(-t / T))).
  constexpr int kRuns = 1000;
  constexpr double kTime_s = 10.0;
  constexpr double kT_s = 0.2;
  constexpr double kStep_s = 0.01;
  MotionParams params;
  params.slip = 0.02;
  params.slip_time_s = kT_s;
  std::vector<double> headings;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    Motion motion("motion", params, {}, RandomStream(seed, "r1/motion"));
    ASSERT_FALSE(motion.apply(TwistCommand{{.v_mps = 0.4}}).has_value());
    double heading = 0.0;
    for (int i = 0; i < 1000; ++i) heading += motion.next_target(kStep_s).omega_radps * kStep_s;
    headings.push_back(heading);
  }
  const double sigma = 0.4 * 0.02 / kWheelSeparation_m *
                       std::sqrt(4.0 * kT_s * (kTime_s - kT_s * (1.0 - std::exp(-kTime_s / kT_s))));
  expect_gaussian(headings, 0.0, sigma);
}

TEST(Slip, RobotAtRestAndCarOnArc_Unaffected) {
  Simulation rest(open_world(R"("motion": {"slip": 0.2})"));
  run(rest, 200);
  EXPECT_EQ(rest.body(0).X_WB, (Pose{20, 20, 0}));

  MotionParams params;
  params.slip = 0.1;
  DriveDescription drive;
  drive.kind = DriveKind::kCar;
  Motion car("motion", params, drive, RandomStream(7, "r1/motion"));
  ASSERT_FALSE(car.apply(CarCommand{0.4, 0.3}).has_value());
  for (int i = 0; i < 100; ++i) {
    const Twist target = car.next_target(0.01);
    EXPECT_NEAR(target.omega_radps, target.v_mps * std::tan(0.3) / drive.wheelbase_m, 1e-12);
  }
}

// --- latency

TEST(SensorLatency, Reading_DeliveredLaterWithMeasurementTime) {
  Simulation late(open_world(R"("pose": {"latency": 0.25, "frequency": 20})"));
  Simulation exact(open_world(R"("pose": {"frequency": 20})"));
  for (Simulation* simulation : {&late, &exact}) {
    send(*simulation, "motion", TwistCommand{{.v_mps = 0.5}});
  }
  std::vector<PoseReading> expected;
  for (int i = 1; i <= 200; ++i) {
    late.step();
    exact.step();
    const PoseReading& now = device<PoseSensor>(exact, "pose").reading();
    if (!exact.updated().empty() &&
        (expected.empty() || expected.back().sequence != now.sequence)) {
      expected.push_back(now);
    }
    const PoseReading& reading = device<PoseSensor>(late, "pose").reading();
    // 25 steps after the measurement; measurements at each fifth step.
    const auto sequence = static_cast<std::uint64_t>(std::max(0, (i - 25) / 5));
    ASSERT_EQ(reading.sequence, sequence) << i;
    if (sequence == 0) continue;
    EXPECT_EQ(reading.time_ns, expected[sequence - 1].time_ns);
    EXPECT_EQ(reading.pose, expected[sequence - 1].pose);
  }
}

TEST(SensorLatency, Reading_AnnouncedOnDelivery) {
  Simulation simulation(
      open_world(R"("laser": {"latency": 0.04, "beams": 3}, "pose": null, "odometry": null)"));
  std::vector<int> steps;
  for (int i = 1; i <= 40; ++i) {
    simulation.step();
    if (!simulation.updated().empty()) steps.push_back(i);
  }
  EXPECT_THAT(steps, ElementsAre(14, 24, 34));
}

TEST(SensorLatency, Reset_ContinuesSequence) {
  Simulation simulation(open_world(R"("pose": {"latency": 0.25, "frequency": 20})"));
  run(simulation, 100);
  const std::uint64_t before = device<PoseSensor>(simulation, "pose").reading().sequence;
  simulation.reset();
  std::uint64_t last = before;
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    const PoseReading& reading = device<PoseSensor>(simulation, "pose").reading();
    if (reading.sequence == 0) continue;
    EXPECT_TRUE(reading.sequence == last || reading.sequence == last + 1) << i;
    last = reading.sequence;
  }
  EXPECT_EQ(last, before + 15);  // 1 s minus the latency
}

TEST(CommandLatency, Commands_DelayedInOrder) {
  Simulation simulation(open_world(R"("motion": {"latency": 0.05})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 0.5}});
  run(simulation, 2);
  send(simulation, "motion", TwistCommand{{.v_mps = 0.1}});
  run(simulation, 3);
  EXPECT_EQ(simulation.body(0).X_WB.x_m, 20.0);  // five steps of 0.01 s
  simulation.step();
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 20.005, 1e-12);
  simulation.step();  // the second command takes effect two steps after the first
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 20.010, 1e-12);
  simulation.step();
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 20.011, 1e-12);
}

TEST(CommandLatency, Placement_EndsDelay) {
  Simulation simulation(
      open_world(R"("motion": {"latency": 0.05}, "teleport": {"type": "teleport"})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 0.5}});
  send(simulation, "teleport", PlaceCommand{{5, 5, 0}});
  run(simulation, 20);
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{5, 5, 0}));
}

TEST(CommandLatency, FullQueue_RefusesCommands) {
  Simulation simulation(open_world(R"("motion": {"latency": 10})"));
  const Simulation::DeviceId motion{0, simulation.find_device(0, "motion").value()};
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(simulation.apply(motion, TwistCommand{{.v_mps = 0.1}}).has_value());
  }
  EXPECT_THAT(simulation.apply(motion, TwistCommand{{.v_mps = 0.1}}).value(), HasSubstr("1000"));
  EXPECT_TRUE(simulation.apply(motion, StopCommand{}).has_value());  // not a command of motors
}

// --- modifiers of MORSE

/// The settings of the first robot's device.
template <typename Params>
Params params_of(const WorldDescription& world, const std::string& name) {
  for (const DeviceDescription& device : world.robots.at(0).devices) {
    if (device.name == name) return std::any_cast<Params>(device.params);
  }
  ADD_FAILURE() << name;
  return {};
}

TEST(Modifiers, SetCorrespondingSettings) {
  const auto pose = params_of<PoseParams>(
      open_world(R"("pose": {"modifiers": [{"name": "PoseNoise", "pos_std": 0.1, "_2D": true}]})"),
      "pose");
  EXPECT_EQ(pose.noise_m, 0.1);
  EXPECT_DOUBLE_EQ(pose.noise_yaw_rad, 5.0 * kDegrees);  // MORSE's default
  const auto gps = params_of<GpsParams>(
      open_world(R"("gps": {"type": "gps", "modifiers": [{"name": "Noise"}]})"), "gps");
  EXPECT_EQ(gps.noise_m, 0.05);
  EXPECT_EQ(gps.noise_vertical_m, 0.05);
  const auto imu = params_of<ImuParams>(
      open_world(R"("imu": {"type": "imu", "modifiers": [{"name": "IMUNoise", "gyro_std": 0.2}]})"),
      "imu");
  EXPECT_EQ(imu.noise_radps, 0.2);
  EXPECT_EQ(imu.noise_mps2, 0.5);
  const auto odometry =
      params_of<OdometryParams>(open_world(R"("odometry": {"frequency": 4, "modifiers": [
          {"name": "OdometryNoise", "factor_sigma": 0.01, "gyro_drift": 0.001,
           "gyro_drift_sigma": 0.002},
          {"name": "Noise", "pos_std": 0.3, "rot_std": 0.4}]})"),
                                "odometry");
  EXPECT_EQ(odometry.scale, 1.05);
  EXPECT_EQ(odometry.scale_noise, 0.01);
  EXPECT_DOUBLE_EQ(odometry.heading_drift_radps, 0.004);  // 4 readings per second
  EXPECT_DOUBLE_EQ(odometry.heading_noise_rad, 0.004);    // of 4 readings: twice that of one
  EXPECT_EQ(odometry.noise_pose_m, 0.3);
  EXPECT_EQ(odometry.noise_pose_yaw_rad, 0.4);
}

TEST(Modifiers, ScatterAsInMorse) {
  Simulation simulation(open_world(
      R"("pose": {"modifiers": [{"name": "PoseNoise", "pos_std": 0.1, "rot_std": 0.05}]})"));
  std::vector<double> x;
  std::vector<double> yaw;
  for (int i = 0; i < 3000; ++i) {
    run(simulation, 10);
    x.push_back(device<PoseSensor>(simulation, "pose").reading().pose.x_m);
    yaw.push_back(device<PoseSensor>(simulation, "pose").reading().pose.yaw_rad);
  }
  expect_gaussian(x, 20.0, 0.1);
  expect_gaussian(yaw, 0.0, 0.05);
}

ConfigIssue issue_of(const std::string& devices) {
  try {
    static_cast<void>(open_world(devices));
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().size(), 1U);
    return error.issues().at(0);
  }
  ADD_FAILURE() << "no error: " << devices;
  return {};
}

TEST(Modifiers, Errors_HavePlaces) {
  const std::string device = "/robots/0/devices/pose/modifiers";
  struct Case {
    const char* settings;
    const char* id;
    std::string pointer;
    const char* expected;
  };
  const Case cases[] = {
      {R"("modifiers": {"name": "PoseNoise"})", "world/wrong-type", device, "list"},
      {R"("modifiers": ["PoseNoise"])", "world/wrong-type", device + "/0", "object"},
      {R"("modifiers": [{"pos_std": 0.1}])", "world/missing-key", device + "/0", "\"name\""},
      {R"("modifiers": [{"name": "PosNoise"}])", "world/unknown-value", device + "/0/name",
       "\"PoseNoise\""},
      {R"("modifiers": [{"name": "OdometryNoise"}])", "world/unknown-value", device + "/0/name",
       "\"PoseNoise\""},
      {R"("modifiers": [{"name": "PoseNoise", "pos_sd": 1}])", "world/unknown-key",
       device + "/0/pos_sd", "pos_std"},
      {R"("modifiers": [{"name": "PoseNoise", "pos_std": -1}])", "world/out-of-range",
       device + "/0/pos_std", "from 0"},
      {R"("modifiers": [{"name": "PoseNoise", "pos_std": {"x": 1}}])", "world/wrong-type",
       device + "/0/pos_std", "number"},
      {R"("modifiers": [{"name": "PoseNoise"}, {"name": "Noise"}])", "world/duplicate-name",
       device + "/1/name", "each modifier once"},
      {R"("noise": 0.1, "modifiers": [{"name": "PoseNoise"}])", "world/conflicting-keys",
       device + "/0", "\"noise\""},
  };
  for (const Case& one : cases) {
    const ConfigIssue issue = issue_of("\"pose\": {" + std::string(one.settings) + "}");
    EXPECT_EQ(issue.id, one.id) << one.settings;
    EXPECT_EQ(issue.pointer, one.pointer) << one.settings;
    EXPECT_THAT(issue.expected, HasSubstr(one.expected)) << one.settings;
  }
}

// --- levels

TEST(Realism, HasNames) {
  for (const Realism level : kRealismLevels) EXPECT_EQ(parse_realism(to_string(level)), level);
  EXPECT_FALSE(parse_realism("Real").has_value());
  EXPECT_FALSE(parse_realism("").has_value());
}

// A robot with a device of each kind, and noise in the file.
WorldDescription rich_world(Realism level) {
  std::string devices =
      R"("laser": {"noise": 0.02}, "odometry": {"noise": 0.01, "wheel_ratio": 1.1},
         "motion": {"slip": 0.05, "latency": 0.1}, "pose": {"noise": 0.02, "latency": 0.1})";
  for (const DeviceKind& kind : device_kinds()) {
    if (kind.name == "laser" || kind.name == "odometry" || kind.name == "motion" ||
        kind.name == "pose" || kind.name == "pen") {
      continue;
    }
    devices += ", \"" + kind.name + R"(": {"type": ")" + kind.name + "\"}";
  }
  WorldDescription world = open_world(devices);
  world.simulation.realism = level;
  return world;
}

TEST(Realism, Ideal_SetsEachFigureToItsIdeal) {
  const Simulation simulation(rich_world(Realism::kIdeal));
  int figures = 0;
  for (const DeviceDescription& device : simulation.world().robots.at(0).devices) {
    const DeviceKind& kind = *find_device_kind(device.type);
    for_each_field(*kind.settings, kind.settings_in(device.params),
                   [&](const Field& field, const void* owner) {
                     if (!field.realism) return;
                     ++figures;
                     EXPECT_EQ(*static_cast<const double*>(field.get(owner)), field.realism->ideal)
                         << kind.name << ' ' << field.name;
                   });
  }
  EXPECT_GT(figures, 40);
}

TEST(Realism, NoiseSettings_HaveFiguresInRange) {
  for (const DeviceKind& kind : device_kinds()) {
    const std::any defaults = kind.defaults();
    for_each_field(
        *kind.settings, kind.settings_in(defaults), [&](const Field& field, const void* owner) {
          const std::string name = field.name;
          for (const char* word : {"noise", "bias", "latency", "slip", "drift", "dropouts"}) {
            if (name.starts_with(word) && name != "slip_time") {
              EXPECT_TRUE(field.realism.has_value()) << kind.name << ' ' << name;
            }
          }
          if (!field.realism) return;
          for (const double figure : {field.realism->ideal, field.realism->real}) {
            EXPECT_GE(figure, field.range.min) << kind.name << ' ' << name;
            EXPECT_LE(figure, field.range.max) << kind.name << ' ' << name;
          }
          // Otherwise the level "course" would not be the world as it is written.
          EXPECT_EQ(*static_cast<const double*>(field.get(owner)), field.realism->ideal)
              << kind.name << ' ' << name;
        });
  }
}

TEST(Realism, Ideal_ExactAfterLongDrive) {
  WorldDescription world = open_world(
      R"("odometry": {"noise": 0.01, "wheel_ratio": 1.1}, "pose": {"noise": 0.02, "latency": 0.1},
         "motion": {"slip": 0.05, "latency": 0.1})");
  world.simulation.realism = Realism::kIdeal;
  Simulation simulation(std::move(world));
  for (int i = 0; i < 200; ++i) {
    send(simulation, "motion",
         TwistCommand{{.v_mps = 0.1 + 0.002 * (i % 100), .omega_radps = 1.5 * std::sin(0.3 * i)}});
    run(simulation, 50);
  }
  EXPECT_GT(simulation.statistics(0).path_length_m, 15.0);
  const Pose truth = Pose{20, 20, 0}.inverse() * simulation.body(0).X_WB;
  const Pose odometry = odometry_of(simulation);
  EXPECT_NEAR(odometry.x_m, truth.x_m, 1e-9);
  EXPECT_NEAR(odometry.y_m, truth.y_m, 1e-9);
  EXPECT_NEAR(normalize_angle(odometry.yaw_rad - truth.yaw_rad), 0.0, 1e-9);
  EXPECT_EQ(device<PoseSensor>(simulation, "pose").reading().pose, simulation.body(0).X_WB);
}

TEST(Realism, Real_FillsOmittedSettings) {
  WorldDescription world = open_world(
      R"("laser": {"noise": 0.02, "dropouts": 0}, "odometry": {"noise": 0}, "pose": {})");
  world.simulation.realism = Realism::kReal;
  apply_realism(world);
  const auto laser = params_of<LaserParams>(world, "laser");
  EXPECT_EQ(laser.noise_m, 0.02);  // stated
  EXPECT_EQ(laser.dropouts, 0.0);  // stated, though it is the default
  EXPECT_EQ(laser.noise_share, 0.0033);
  EXPECT_EQ(laser.latency_s, 0.04);
  const auto odometry = params_of<OdometryParams>(world, "odometry");
  EXPECT_EQ(odometry.noise, 0.0);
  EXPECT_EQ(odometry.wheel_ratio, 1.001);
  EXPECT_DOUBLE_EQ(params_of<PoseParams>(world, "pose").noise_yaw_rad, 0.5 * kDegrees);
  EXPECT_EQ(params_of<MotionParams>(world, "motion").slip, 0.01);
  // A second time it changes nothing.
  const std::uint64_t hash = world_hash(world);
  apply_realism(world);
  EXPECT_EQ(world_hash(world), hash);
}

TEST(Realism, Real_KeepsSettingsOfModel) {
  // The model's file states where the sonars are; the world states their range.
  const WorldDescription world = load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"model": "pioneer2dx", "pose": {"x": 2, "y": 2},
          "devices": {"sonar": {"range_max": 2}}}]})");
  for (const DeviceDescription& device : world.robots.at(0).devices) {
    if (device.name != "sonar") continue;
    EXPECT_TRUE(std::is_sorted(device.given.begin(), device.given.end()));
    EXPECT_THAT(device.given, testing::Contains("range_max"));
    EXPECT_THAT(device.given, testing::Contains("mounts"));
  }
}

TEST(Realism, Level_PartOfWorldIdentity) {
  WorldDescription world = open_world("");
  const std::uint64_t course = world_hash(world);
  world.simulation.realism = Realism::kReal;
  const std::uint64_t real = world_hash(world);
  world.simulation.realism = Realism::kIdeal;
  EXPECT_NE(world_hash(world), course);
  EXPECT_NE(world_hash(world), real);
  EXPECT_NE(real, course);
  EXPECT_EQ(open_world("", R"("realism": "real")").simulation.realism, Realism::kReal);
  EXPECT_EQ(world_hash(open_world("", R"("realism": "course")")), course);
}

TEST(Realism, DisabledSettings_NotListed) {
  const auto defaults = find_device_kind("laser")->properties(LaserParams{});
  EXPECT_FALSE(defaults.contains("latency"));
  EXPECT_FALSE(defaults.contains("dropouts"));
  LaserParams params;
  params.latency_s = 0.1;
  EXPECT_EQ(find_device_kind("laser")->properties(params).at("latency"), 0.1);
}

std::uint64_t hash_after_a_drive(Realism level, std::uint64_t seed) {
  WorldDescription world = rich_world(level);
  world.simulation.seed = seed;
  Simulation simulation(std::move(world));
  send(simulation, "motion", TwistCommand{{.v_mps = 0.4, .omega_radps = 0.3}});
  run(simulation, 300);
  return simulation.state_hash();
}

TEST(Realism, Real_RepeatableAndDependsOnSeed) {
  EXPECT_EQ(hash_after_a_drive(Realism::kReal, 5), hash_after_a_drive(Realism::kReal, 5));
  EXPECT_NE(hash_after_a_drive(Realism::kReal, 5), hash_after_a_drive(Realism::kReal, 6));
  EXPECT_NE(hash_after_a_drive(Realism::kReal, 5), hash_after_a_drive(Realism::kCourse, 5));
}

TEST(Realism, Real_SnapshotContinuesExactly) {
  // Delayed readings, delayed commands, slip and random streams are in transit at each moment.
  Simulation simulation(rich_world(Realism::kReal));
  for (int i = 0; i < 12; ++i) {
    send(simulation, "motion",
         TwistCommand{{.v_mps = 0.1 + 0.03 * i, .omega_radps = 0.5 - 0.1 * i}});
    run(simulation, 7);
    Simulation fork = simulation.fork();
    ASSERT_EQ(fork.state_hash(), simulation.state_hash()) << i;
    Simulation ahead = simulation.fork();
    run(fork, 20);
    run(ahead, 20);
    ASSERT_EQ(fork.state_hash(), ahead.state_hash()) << i;
  }
  const Snapshot snapshot = simulation.save();
  run(simulation, 33);
  const std::uint64_t later = simulation.state_hash();
  simulation.restore(snapshot);
  run(simulation, 33);
  EXPECT_EQ(simulation.state_hash(), later);
}

TEST(Realism, RestoredWorld_ContinuesAtLaterTime) {
  Simulation simulation(rich_world(Realism::kReal));
  run(simulation, 57);
  send(simulation, "motion", TwistCommand{{.v_mps = 0.4}});
  const Snapshot snapshot = simulation.save();
  run(simulation, 100);
  const std::uint64_t sequence = device<Laser>(simulation, "laser").reading().sequence;
  const SimTime before_ns = device<Laser>(simulation, "laser").reading().time_ns;
  simulation.restore(snapshot, RestoreScope::kWorld);
  std::uint64_t last = 0;
  for (int i = 0; i < 30; ++i) {
    simulation.step();
    const LaserReading& reading = device<Laser>(simulation, "laser").reading();
    if (simulation.updated().empty() || reading.sequence <= sequence) continue;
    EXPECT_TRUE(last == 0 ? reading.sequence == sequence + 1
                          : reading.sequence == last || reading.sequence == last + 1);
    EXPECT_GT(reading.time_ns, before_ns);
    last = reading.sequence;
  }
  EXPECT_GT(last, sequence);
  EXPECT_GT(simulation.body(0).X_WB.x_m, 20.05);  // the delayed command took effect
}

}  // namespace
}  // namespace sim
