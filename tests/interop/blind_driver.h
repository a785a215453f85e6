// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Two controllers that need no map, and the question whether a stalled robot sees what it stalls
// at. Both sides of blind_worlds.py, stage_drive.cc and playpen_drive.cc, use them.
#pragma once

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace interop {

/// A beam in the frame of the robot's body.
struct Beam {
  double x_m, y_m, angle_rad;  ///< where it starts and its direction
  double range_m, range_max_m;
};

/// The extents of a robot's body in its own frame [m].
struct Body {
  double front_m = 0.0, rear_m = 0.0, side_m = 0.0;
};

struct Twist {
  double forward_mps, turn_radps;
};

/// Drives straight on; after a stall it turns by 20 degrees, to the same side six times in a row.
class BlindDriver {
 public:
  [[nodiscard]] Twist step(bool stalled, const std::vector<Beam>&) {
    if (stalled && turning_ == 0) {
      turning_ = 7;
      side_ = (stalls_++ / 6) % 2 == 0 ? 1.0 : -1.0;
    }
    if (turning_ == 0) return {kSpeed_mps, 0.0};
    --turning_;
    return {0.0, 0.5 * side_};
  }

  static constexpr double kSpeed_mps = 0.3;

 private:
  int turning_ = 0, stalls_ = 0;  // steps that a turn still takes
  double side_ = 1.0;
};

/// Follows the wall on its right at 0.5 m, as a first exercise does.
class WallFollower {
 public:
  [[nodiscard]] Twist step(bool stalled, const std::vector<Beam>& beams) {
    double ahead_m = 1e9, right_m = 1e9;
    for (const Beam& beam : beams) {
      const double x_m = beam.x_m + beam.range_m * std::cos(beam.angle_rad);
      const double y_m = beam.y_m + beam.range_m * std::sin(beam.angle_rad);
      if (std::abs(beam.angle_rad) < 0.6 && std::abs(y_m) < 0.4) ahead_m = std::min(ahead_m, x_m);
      if (beam.angle_rad < -0.8 && beam.angle_rad > -1.9) right_m = std::min(right_m, -y_m);
    }
    if (ahead_m < 0.7 || stalled) return {0.0, 0.6};
    if (right_m > 2.0) return {0.3, found_ ? -0.4 : 0.0};
    found_ = true;
    return {0.3, std::max(-0.5, std::min(0.5, 0.8 * (0.5 - right_m)))};
  }

 private:
  bool found_ = false;
};

/// What the beams tell about the space in front of a robot that has driven forwards and stalled.
enum class Sight { kNoBeamAhead, kSeen, kBlind };

/// The space ahead reaches from the middle of the body to 0.35 m before its front, and 0.1 m beyond
/// its sides: a robot that drives forwards meets things there only.
[[nodiscard]] inline Sight sight_ahead(const Body& body, const std::vector<Beam>& beams) {
  const auto ahead = [&](double x_m, double y_m) {
    return x_m > 0.5 * (body.front_m + body.rear_m) - 0.05 && x_m < body.front_m + 0.35 &&
           std::abs(y_m) < body.side_m + 0.1;
  };
  bool looks = false;
  for (const Beam& beam : beams) {
    const double c = std::cos(beam.angle_rad), s = std::sin(beam.angle_rad);
    if (ahead(beam.x_m + beam.range_m * c, beam.y_m + beam.range_m * s)) return Sight::kSeen;
    // A beam looks ahead if it leaves that space by its front.
    const double to_front_m = c > 0.1 ? (body.front_m + 0.3 - beam.x_m) / c : -1.0;
    looks = looks || (to_front_m > 0.0 && to_front_m < beam.range_max_m &&
                      ahead(beam.x_m + to_front_m * c, beam.y_m + to_front_m * s));
  }
  return looks ? Sight::kBlind : Sight::kNoBeamAhead;
}

[[nodiscard]] inline const char* name_of(Sight sight) {
  return sight == Sight::kSeen ? "seen" : sight == Sight::kBlind ? "blind" : "no_beam";
}

[[nodiscard]] inline double least_ahead_m(const std::vector<Beam>& beams) {
  double least_m = 1e9;
  for (const Beam& beam : beams) {
    if (std::abs(beam.angle_rad) < 0.3) least_m = std::min(least_m, beam.range_m);
  }
  return least_m;
}

/// Drives a robot for some time and writes what happens:
///   at TIME X Y YAW                               every 2 s
///   stall TIME X Y YAW seen|blind|no_beam AHEAD   where it stalled while it drove forwards
///   end X Y YAW PATH STALLS
/// @tparam Robot  has pose() (with x, y, a), stalled(), beams(), body(), set_speed(Twist),
/// advance() by 100 ms
///     and look(): stops, and measures from where it stands.
template <typename Driver, typename Robot>
void drive(Driver driver, Robot& robot, double seconds) {
  double path_m = 0.0;
  int stalls = 0;
  auto last = robot.pose();
  bool forward = false, was_stalled = false;
  const int steps = static_cast<int>(std::lround(10.0 * seconds));
  for (int step = 0; step < steps; ++step) {
    const auto now = robot.pose();
    path_m += std::hypot(now.x - last.x, now.y - last.y);
    last = now;
    if (step % 20 == 0)
      std::cout << "at " << 0.1 * step << ' ' << now.x << ' ' << now.y << ' ' << now.a << '\n';
    const bool stalled = robot.stalled();
    if (stalled && !was_stalled && forward) {
      ++stalls;
      if (stalls <= 50) {
        robot.look();
        const auto beams = robot.beams();
        std::cout << "stall " << 0.1 * step << ' ' << now.x << ' ' << now.y << ' ' << now.a << ' '
                  << name_of(sight_ahead(robot.body(), beams)) << ' ' << least_ahead_m(beams) << ' '
                  << robot.partner() << '\n';
      }
    }
    was_stalled = stalled;
    const Twist twist = driver.step(stalled, robot.beams());
    forward = twist.forward_mps > 0.0;
    robot.set_speed(twist);
    robot.advance();
  }
  std::cout << "end " << last.x << ' ' << last.y << ' ' << last.a << ' ' << path_m << ' ' << stalls
            << '\n';
}

/// Drives blindly, then along walls from where that has ended; writes `controller blind|wall`
/// before each.
template <typename Robot>
void drive(Robot& robot, double seconds) {
  std::cout << "controller blind\n";
  drive(BlindDriver(), robot, seconds);
  std::cout << "controller wall\n";
  drive(WallFollower(), robot, seconds);
}

}  // namespace interop
