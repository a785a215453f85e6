// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program that roams and avoids obstacles, with planted faults for `playpen fuzz`.
//   planted_roamer FAULT  - its argument is a name of kFaults
//   planted_roamer --list - prints the names
//
// Without a fault it does not collide in a world that stands still: it predicts where it drives,
// checks the whole scan against a circle that is larger than the robot, and turns on the spot, in
// which the distances to obstacles stay the same. If it is boxed in, it ends.
#include <libplayerc++/playerc++.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace PlayerCc;

struct Fault {
  const char* name;
  const char* text;
};

constexpr Fault kFaults[] = {
    {"none", "has no fault"},
    {"sign", "steers to the wrong side while it drives"},
    {"degrees", "predicts its turns in degrees instead of radians"},
    {"shifted", "takes the beams for those 75 indices away"},
    {"narrow", "looks at the beams within 0.3 rad of its heading only"},
    {"integer", "rounds the index of a beam down to a sector in an integer division"},
    {"overflow", "compares headings without the jump at 180 degrees"},
    {"latency", "drives on at once after a turn, on a scan from before"},
    {"race", "has a thread that repeats a command which may be old by then"},
    {"sectors", "counts obstacles in sectors, of which there is one too few"},
    {"zero", "divides by the number of beams that are longer than 0.4 m, which can be 0"},
    {"hang", "waits for a free way without reading the next scan"},
    {"oscillates", "chooses the side of its turn anew each time"},
    {"tries", "drives back without looking after a second turn with little way before it"},
    {"gap", "takes a smaller radius between two obstacles, to get through"},
};

std::string fault;  // the one that is planted

bool has(const char* name) { return fault == name; }

struct Beam {
  double range_m = 0.0;
  double bearing_rad = 0.0;
};
using Scan = std::vector<Beam>;

struct Point {  // in the robot's frame: x forward, y left
  double x_m = 0.0;
  double y_m = 0.0;
};

constexpr double kPi = 3.14159265358979323846;
constexpr double kLaserX_m = 0.035;  // of the laser before the middle of the robot
constexpr double kReach_m = 0.8;     // obstacles farther away are ignored
constexpr double kTurn_radps = 1.2;
constexpr double kFreeWay_m = 0.32;  // after a turn it drives on with such a way ahead

constexpr double kRadius_m = 0.12;  // of the circle that must stay free; it is in one of 0.098 m
constexpr double kGapRadius_m = 0.085;

double speed_mps() { return has("latency") ? 0.3 : 0.22; }
// It stops with a shorter way ahead.
double stop_way_m() { return has("latency") ? 0.07 : 0.12; }

double bearing_of(const LaserProxy& laser, unsigned beam) {
  return laser.GetBearing(has("integer") ? beam / 170 * 170 : beam);
}

double range_of(const LaserProxy& laser, unsigned beam) {
  const unsigned count = laser.GetCount();
  return laser[has("shifted") ? std::min(beam + 75, count - 1) : beam];
}

Scan scan_of(const LaserProxy& laser) {
  Scan scan;
  const bool is_narrow = has("narrow");
  scan.reserve(laser.GetCount());
  for (unsigned i = 0; i < laser.GetCount(); ++i) {
    Beam beam;
    beam.range_m = range_of(laser, i);
    beam.bearing_rad = bearing_of(laser, i);
    if (is_narrow && std::fabs(beam.bearing_rad) > 0.3) continue;
    scan.push_back(beam);
  }
  return scan;
}

std::vector<Point> points_of(const Scan& scan) {
  std::vector<Point> points;
  for (const Beam& beam : scan) {
    if (beam.range_m > kReach_m) continue;
    points.push_back({kLaserX_m + beam.range_m * std::cos(beam.bearing_rad),
                      beam.range_m * std::sin(beam.bearing_rad)});
  }
  return points;
}

// Whether there are obstacles on both sides.
bool is_gap(const std::vector<Point>& points) {
  const auto beside = [&points](double side) {
    return std::any_of(points.begin(), points.end(), [side](const Point& p) {
      return p.x_m > 0.0 && p.x_m < 0.3 && side * p.y_m > 0.06 && side * p.y_m < 0.13;
    });
  };
  return beside(1.0) && beside(-1.0);
}

// The way until a point is within the robot's circle, on an arc with this turn rate [m].
double way_m(const std::vector<Point>& points, double turn_radps) {
  constexpr double kStep_m = 0.02;
  const double step_s = kStep_m / speed_mps();
  const double radius = has("gap") && is_gap(points) ? kGapRadius_m : kRadius_m;
  if (has("degrees")) turn_radps = rtod(turn_radps);
  std::vector<double> before(points.size(), 1e9);  // squares of distances
  Point place;
  double yaw_rad = 0.0;
  for (double driven_m = 0.0; driven_m < kFreeWay_m + 0.01; driven_m += kStep_m) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x_m = points[i].x_m - place.x_m;
      const double y_m = points[i].y_m - place.y_m;
      const double away = x_m * x_m + y_m * y_m;
      // The robot may drive away from something that is already near.
      const bool is_ahead = driven_m > 0.0 ? away < before[i] : x_m > 0.0;
      if (away < radius * radius && is_ahead) return driven_m;
      before[i] = away;
    }
    yaw_rad += turn_radps * step_s;
    place = {place.x_m + kStep_m * std::cos(yaw_rad), place.y_m + kStep_m * std::sin(yaw_rad)};
  }
  return kFreeWay_m + 0.01;
}

// Least range within an angle of a bearing [m].
double least_m(const Scan& scan, double bearing_rad, double within_rad) {
  double least = 1e9;
  for (const Beam& beam : scan) {
    if (std::fabs(beam.bearing_rad - bearing_rad) < within_rad) {
      least = std::min(least, beam.range_m);
    }
  }
  return least;
}

// Away from what is near at the sides.
double steering_radps(const Scan& scan) {
  const double left = std::max(0.0, 0.35 - least_m(scan, 1.0, 0.8));
  const double right = std::max(0.0, 0.35 - least_m(scan, -1.0, 0.8));
  return limit(6.0 * (right - left), -0.8, 0.8);
}

// The faults that depend on what surrounds the robot. They do nothing else.
void look_around(const Scan& scan) {
  const auto nearest = std::min_element(
      scan.begin(), scan.end(), [](const Beam& a, const Beam& b) { return a.range_m < b.range_m; });
  if (has("sectors") && nearest->range_m < 0.15) {
    static std::vector<int> sectors(9, 0);
    ++sectors.at(static_cast<std::size_t>((nearest->bearing_rad + 2.3) / 0.5));
  }
  if (has("zero")) {
    const auto is_long = [](const Beam& b) { return b.range_m > 0.4; };
    // Some processors do not signal a division by zero.
    if (std::none_of(scan.begin(), scan.end(), is_long)) std::raise(SIGFPE);
  }
  if (has("hang")) {
    static volatile int rounds = 0;
    const auto is_free = [](const Beam& b) {
      return std::fabs(b.bearing_rad) < 1.6 && b.range_m > 0.45;
    };
    while (std::none_of(scan.begin(), scan.end(), is_free)) rounds = (rounds + 1) % 1000;
  }
}

class Robot {
 public:
  Robot() : client_("localhost", 6665), position_(&client_, 0), laser_(&client_, 0) {
    if (has("race")) repeater_ = std::thread([this] { repeat(); });
  }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  ~Robot() {
    is_over_ = true;
    if (repeater_.joinable()) repeater_.join();
  }

  // Until it is boxed in.
  void roam() {
    for (;;) {
      client_.Read();
      if (!laser_.IsFresh()) continue;
      laser_.NotFresh();
      const Scan scan = scan_of(laser_);
      if (scan.empty()) continue;
      look_around(scan);
      if (!decide(scan)) return;
    }
  }

 private:
  // @return whether there is anything left to do.
  bool decide(const Scan& scan) {
    const std::vector<Point> points = points_of(scan);
    if (back_ > 0) {
      --back_;
      command(-0.25, 0.0);
      return true;
    }
    ++scans_;
    if (side_ != 0.0) return turn(scan, points);
    double turn_radps = steering_radps(scan);
    if (way_m(points, turn_radps) < stop_way_m()) turn_radps = 0.0;
    if (way_m(points, turn_radps) >= stop_way_m()) {
      command(speed_mps(), has("sign") ? -turn_radps : turn_radps);
      return true;
    }
    begin_turn(scan);
    return true;
  }

  void begin_turn(const Scan& scan) {
    side_ = side_of(scan);
    std::puts(side_ > 0.0 ? "turns left" : "turns right");
    turned_rad_ = 0.0;
    last_yaw_rad_ = position_.GetYaw();
    least_yaw_rad_ = last_yaw_rad_ + 0.5 * side_;
    // Turns with less than a second of driving between them are tries of one thing.
    constexpr int kSecond = 10;
    constexpr int kMostTries = 1;
    tries_ = scans_ < kSecond ? tries_ + 1 : 0;
    if (tries_ > 0) std::printf("tries again, %d\n", tries_);
    if (has("tries") && tries_ >= kMostTries) back_ = 10;
    command(0.0, side_ * kTurn_radps);
  }

  // Away from the nearest obstacle ahead.
  static double side_of(const Scan& scan) {
    return least_m(scan, 0.5, 0.5) > least_m(scan, -0.5, 0.5) ? 1.0 : -1.0;
  }

  // Turns by 0.5 rad or more, until there is a way ahead.
  bool turn(const Scan& scan, const std::vector<Point>& points) {
    const double yaw_rad = position_.GetYaw();
    turned_rad_ += side_ * std::remainder(yaw_rad - last_yaw_rad_, 2.0 * kPi);
    last_yaw_rad_ = yaw_rad;
    bool has_turned = turned_rad_ >= 0.5;
    if (has("overflow")) has_turned = side_ * (yaw_rad - least_yaw_rad_) >= 0.0;
    if (has_turned && way_m(points, 0.0) >= kFreeWay_m) {
      // It stands until the scan is from where it stands.
      constexpr int kStanding = 4;
      if (has("latency") || ++standing_ > kStanding) {
        standing_ = 0;
        side_ = 0.0;
        scans_ = 0;
        std::puts("drives");
      }
      command(0.0, 0.0);
      return true;
    }
    standing_ = 0;
    if (turned_rad_ > 2.1 * kPi && !has("overflow")) return false;
    if (has("oscillates")) {
      turned_rad_ *= side_ * side_of(scan);
      side_ = side_of(scan);
    }
    command(0.0, side_ * kTurn_radps);
    return true;
  }

  void command(double speed_mps, double turn_radps) {
    // With the other thread, what has not changed is sent by that one only.
    const bool is_new = speed_mps != speed_mps_ || turn_radps != turn_radps_;
    speed_mps_ = speed_mps;
    turn_radps_ = turn_radps;
    if (is_new || !has("race")) position_.SetSpeed(speed_mps, turn_radps);
  }

  // The other thread of "race".
  void repeat() {
    try {
      while (!is_over_) {
        usleep(2'500'000);
        const double speed_mps = speed_mps_;
        const double turn_radps = turn_radps_;
        usleep(20'000);  // it looks at the battery
        position_.SetSpeed(speed_mps, turn_radps);
      }
    } catch (const PlayerError&) {  // the run is over
    }
  }

  PlayerClient client_;
  Position2dProxy position_;
  LaserProxy laser_;
  double side_ = 0.0;  // of its turn: 1 left, -1 right, 0 it drives
  double turned_rad_ = 0.0;
  double last_yaw_rad_ = 0.0;
  double least_yaw_rad_ = 0.0;
  int standing_ = 0;  // scans
  int back_ = 0;      // scans that it still drives back
  std::atomic<double> speed_mps_{0.0};
  std::atomic<double> turn_radps_{0.0};
  std::atomic<bool> is_over_{false};
  int scans_ = 0;  // since it has begun to drive
  int tries_ = 0;
  std::thread repeater_;
};

}  // namespace

int main(int argc, char** argv) {
  fault = argc == 2 ? argv[1] : "";
  if (fault == "--list") {
    for (const Fault& one : kFaults) std::printf("%s: %s\n", one.name, one.text);
    return 0;
  }
  if (std::none_of(std::begin(kFaults), std::end(kFaults),
                   [](const Fault& one) { return fault == one.name; })) {
    std::fprintf(stderr, "planted_roamer: expected the name of a fault, 'none' or '--list'\n");
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Robot robot;
  robot.roam();
  return 0;
}
