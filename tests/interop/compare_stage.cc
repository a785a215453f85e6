// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Compares what Playpen measures with what stage_scans has written about Stage:
//   compare_stage WORLD SCANS [--list N]
// It prints a line for each ranger of each robot, one for the drives and one for the hits of each
// robot, and one for all beams; with --list also the first N beams and hits that differ.
//
// A beam agrees if Playpen measures Stage's range, give or take two cells of Stage's raster. At the
// edges of things that is not enough: Stage draws outlines into its raster, their corners are
// rounded to cells, and a beam walks from cell to cell until one is drawn. So a beam agrees, too,
// if the outlines that Playpen's ranger sees explain Stage's range: if Playpen measures it along a
// parallel line at most two cells aside, or if a walk over a raster with these outlines ends at
// most one cell beside it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <unordered_set>
#include <vector>

#include "playpen_beams.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace {

using interop::Beams;
using interop::beams_of;
using sim::Pose;
using sim::Vec2;

/// A side of an outline, with the solid on its left.
struct Side {
  Vec2 a, b;
  std::string solid;
};

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

void add(std::vector<Side>& sides, const sim::Polygon& outline, const Pose& X,
         const std::string& solid) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sides.push_back({X * outline[i], X * outline[(i + 1) % outline.size()], solid});
  }
}

/// Everything that a sensor at a height sees, without its own robot.
std::vector<Side> sides_above(const sim::Simulation& simulation, int own, double height_m) {
  std::vector<Side> sides;
  const sim::ArenaDescription& arena = simulation.world().arena;
  for (const sim::WallLoop& loop : arena.walls) {
    if (loop.height_m >= height_m - 1e-6) add(sides, loop.vertices, {}, "map");
  }
  for (const sim::ObstacleDescription& obstacle : arena.obstacles) {
    if (height_m < 0.0 || sim::spans_height(obstacle.bottom_m, obstacle.height_m, height_m))
      add(sides, sim::corners_of(obstacle), {}, obstacle.name);
  }
  for (int i = 0; i < simulation.robot_count(); ++i) {
    if (i == own) continue;
    const sim::RobotModel& model = simulation.model(i);
    const Pose& X_WB = simulation.body(i).X_WB;
    const std::string& name = simulation.world().robots[static_cast<std::size_t>(i)].name;
    if (model.height_m >= height_m - 1e-6) {
      for (const sim::Polygon& part : sim::body_parts(model)) add(sides, part, X_WB, name);
    }
    for (const sim::Superstructure& part : model.superstructures) {
      if (height_m < 0.0 || sim::spans_height(part.bottom_m, part.height_m, height_m)) {
        add(sides, part.outline, X_WB, name);
      }
    }
  }
  return sides;
}

/// Where a beam ends.
struct Hit {
  double range_m;
  int side = -1;  ///< that it meets
};

/// Range of a beam by the simplest method: against each side that faces it.
Hit cast(const std::vector<Side>& sides, const Vec2& from, const Vec2& along, double range_max_m) {
  Hit hit{range_max_m};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec2 side = sides[i].b - sides[i].a;
    const double turn = cross(side, along);
    if (turn <= 0.0) continue;
    const Vec2 to = sides[i].a - from;
    const double range_m = cross(side, to) / turn;
    const double share = cross(along, to) / turn;
    if (range_m >= 0.0 && range_m < hit.range_m && share >= 0.0 && share <= 1.0) {
      hit = {range_m, static_cast<int>(i)};
    }
  }
  return hit;
}

/// Distance of a range from those that Playpen measures along parallel beams up to `aside_m` away.
double off_m(const std::vector<Side>& sides, const Vec2& from, double angle_rad, double theirs_m,
             double range_max_m, double aside_m) {
  constexpr int kSteps = 4;  // to either side
  const Vec2 along(std::cos(angle_rad), std::sin(angle_rad));
  const Vec2 left(-along.y(), along.x());
  double least_m = range_max_m;
  std::optional<Hit> before;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const Vec2 start = from + (aside_m * k / kSteps) * left;
    const Hit hit = cast(sides, start, along, range_max_m);
    least_m = std::min(least_m, std::abs(hit.range_m - theirs_m));
    // Between two beams that meet the same side, all ranges between theirs occur.
    if (before && before->side == hit.side && theirs_m >= std::min(before->range_m, hit.range_m) &&
        theirs_m <= std::max(before->range_m, hit.range_m)) {
      return 0.0;
    }
    before = hit;
  }
  return least_m;
}

/// A raster as Stage has it (libstage/world.cc, region.hh).
class Raster {
 public:
  explicit Raster(double cell_m) : cells_per_m_(1.0 / cell_m) {}

  /// Draws a side as the cells that a walk of steps along x or y from its start to its end passes,
  /// without the last one.
  /// @param visible  whether beams end there; regions with invisible sides only are walked, too.
  void draw(const Side& side, bool visible) {
    const auto cell = [&](double m) { return static_cast<int>(std::floor(m * cells_per_m_)); };
    double x = cell(side.a.x()), y = cell(side.a.y());
    walk(x, y, cell(side.b.x()) - cell(side.a.x()), cell(side.b.y()) - cell(side.a.y()),
         [&](int at_x, int at_y) {
           regions_.insert(key(at_x >> kRegionBits, at_y >> kRegionBits));
           if (visible) cells_.insert(key(at_x, at_y));
           return true;
         });
  }

  /// Range of a beam.
  [[nodiscard]] double cast_m(const Vec2& from, double angle_rad, double range_max_m) const {
    const double angle = angle_rad == 0.0 ? 1e-12 : angle_rad;
    const double slope_x = std::cos(angle), slope_y = std::sin(angle);
    const Vec2 start = from * cells_per_m_;
    const int dx = static_cast<int>(cells_per_m_ * range_max_m * slope_x);
    const int dy = static_cast<int>(cells_per_m_ * range_max_m * slope_y);
    double x = start.x(), y = start.y();
    int error = std::abs(dy) - std::abs(dx);
    int left = std::abs(dx) + std::abs(dy);  // steps
    while (left > 0) {
      if (regions_.count(region_of(x, y)) == 0) {
        jump(x, y, left, dx, dy, slope_y / slope_x);
        continue;
      }
      // Within a region Stage counts cells from where the beam enters it.
      const int begin_x = static_cast<int>(x), begin_y = static_cast<int>(y);
      const double offset_x = x - begin_x, offset_y = y - begin_y;
      int at_x = begin_x, at_y = begin_y;
      while (at_x >> kRegionBits == begin_x >> kRegionBits &&
             at_y >> kRegionBits == begin_y >> kRegionBits && left > 0) {
        if (cells_.count(key(at_x, at_y)) != 0) {
          x = at_x + offset_x;
          y = at_y + offset_y;
          return (std::abs(dx) > std::abs(dy) ? std::abs((x - start.x()) / slope_x)
                                              : std::abs((y - start.y()) / slope_y)) /
                 cells_per_m_;
        }
        step(at_x, at_y, error, dx, dy);
        --left;
      }
      x = at_x + offset_x;
      y = at_y + offset_y;
    }
    return range_max_m;
  }

 private:
  static constexpr int kRegionBits = 5;

  static std::int64_t key(int x, int y) {
    return (static_cast<std::int64_t>(x) << 32) ^ (y & 0xffffffffLL);
  }
  static std::int64_t region_of(double x, double y) {
    return key(static_cast<int>(x) >> kRegionBits, static_cast<int>(y) >> kRegionBits);
  }
  static int sign(int n) { return n < 0 ? -1 : 1; }

  template <typename Number>
  static void step(Number& x, Number& y, int& error, int dx, int dy) {
    if (error < 0) {
      x += sign(dx);
      error += 2 * std::abs(dy);
    } else {
      y += sign(dy);
      error -= 2 * std::abs(dx);
    }
  }

  template <typename Visitor>
  static void walk(double x, double y, int dx, int dy, Visitor visit) {
    int error = std::abs(dy) - std::abs(dx);
    for (int left = std::abs(dx) + std::abs(dy); left > 0; --left) {
      visit(static_cast<int>(x), static_cast<int>(y));
      step(x, y, error, dx, dy);
    }
  }

  /// Moves a beam to the border of its region, which is empty.
  static void jump(double& x, double& y, int& left, int dx, int dy, double slope) {
    constexpr int kWidth = 1 << kRegionBits;
    const auto to_border = [](double at, int direction) {
      const double begin = (static_cast<int>(at) >> kRegionBits) * kWidth;
      return direction < 0 ? begin - at - 1.0 : begin + kWidth - at;
    };
    const double x_dx = to_border(x, sign(dx)), x_dy = x_dx * slope;
    const double y_dy = to_border(y, sign(dy)), y_dx = y_dy / slope;
    const bool along_x = std::abs(x_dx) + std::abs(x_dy) < std::abs(y_dx) + std::abs(y_dy);
    const double by_x = along_x ? x_dx : y_dx, by_y = along_x ? x_dy : y_dy;
    x += by_x;
    y += by_y;
    left = static_cast<int>(left - (std::abs(by_x) + std::abs(by_y)));
  }

  double cells_per_m_;
  std::unordered_set<std::int64_t> cells_, regions_;
};

/// Figures of one ranger.
struct Figures {
  std::size_t beams = 0, agree = 0, two_cells = 0, missed = 0, extra = 0, farther = 0, nearer = 0;
  std::size_t other_device =
      0;  ///< of rangers that Playpen does not have, or with another number of beams
  std::vector<double> errors_m;
};

/// How far apart drives end.
struct Drives {
  int count = 0;
  double farthest_m = 0.0;
  double greatest_turn_rad = 0.0;
};

/// Where robots stop that drive into something.
struct Hits {
  int count = 0, agree = 0, farther = 0, nearer = 0;
};

/// A sensor of Stage, or several of one ranger: its ranges at a pose.
struct Scan {
  std::vector<double> ranges_m;
  std::vector<double> ranges_max_m;  ///< of each beam
};

class Comparison {
 public:
  Comparison(const std::string& world, std::size_t list)
      : simulation_(sim::load_world(world)), list_(list) {
    for (int i = 0; i < simulation_.robot_count(); ++i) X_WB_.push_back(simulation_.body(i).X_WB);
  }

  void run(std::istream& in) {
    std::string line;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string what, name;
      words >> what;
      if (what == "resolution") {
        words >> cell_m_;
      } else if (what == "robot") {
        words >> name;
        starts_[name] = read_pose(words);
        find_robot(name);
        place(name, starts_[name]);  // Playpen moves robots that overlap something
      } else if (what == "pose") {
        compare_scans();
        words >> name;
        return_others(name);
        place(name, read_pose(words));
      } else if (what == "ranger") {
        std::size_t index = 0, sensors = 0;
        words >> index >> sensors;
        scans_.emplace_back();
      } else if (what == "sensor" && !scans_.empty()) {
        double view_rad = 0.0;
        std::size_t count = 0;
        Scan scan;
        double range_max_m = 0.0;
        words >> view_rad >> range_max_m >> count;
        double range_m = 0.0;
        while (words >> range_m) scan.ranges_m.push_back(range_m);
        scan.ranges_max_m.assign(scan.ranges_m.size(), range_max_m);
        scans_.back().push_back(std::move(scan));
      } else if (what == "hit") {
        compare_scans();
        words >> name;
        hit(name, words);
      } else if (what == "drive") {
        compare_scans();
        words >> name;
        drive(name, words);
      }
    }
    compare_scans();
  }

  void print() {
    std::cout.setf(std::ios::fixed);
    std::cout.precision(2);
    Figures all;
    for (auto& [name, figures] : figures_) {
      print_line(name, figures);
      all.beams += figures.beams;
      all.agree += figures.agree;
      all.two_cells += figures.two_cells;
      all.missed += figures.missed;
      all.extra += figures.extra;
      all.farther += figures.farther;
      all.nearer += figures.nearer;
      all.other_device += figures.other_device;
      all.errors_m.insert(all.errors_m.end(), figures.errors_m.begin(), figures.errors_m.end());
    }
    for (const auto& [name, drives] : drives_) {
      std::cout << name << " drives: " << drives.count << ", ends at most "
                << 1000.0 * drives.farthest_m << " mm and "
                << drives.greatest_turn_rad * 57.29577951308232 << " degrees from Stage's\n";
    }
    for (const auto& [name, hits] : hits_) {
      std::cout << name << " hits: " << hits.count << ", " << hits.agree << " agree, "
                << hits.farther << " farther, " << hits.nearer << " nearer\n";
    }
    if (!device_differs_.empty()) std::cout << "other device: " << device_differs_ << '\n';
    if (refused_ > 0) {
      std::cout << refused_ << " poses at which Playpen's robot would overlap something\n";
    }
    if (!figures_.empty()) print_line("all", all);
  }

 private:
  static Pose read_pose(std::istream& in) {
    Pose pose;
    in >> pose.x_m >> pose.y_m >> pose.yaw_rad;
    return pose;
  }

  /// Playpen's robot of Stage's name is that which starts at the same place, or the nearest one of
  /// the others.
  void find_robot(const std::string& name) {
    const Pose& start = starts_[name];
    int nearest = -1;
    double least_m = 1e9;
    for (std::size_t i = 0; i < X_WB_.size(); ++i) {
      const int robot = static_cast<int>(i);
      const bool taken = std::any_of(robots_.begin(), robots_.end(),
                                     [&](const auto& known) { return known.second == robot; });
      const double off_m = std::hypot(X_WB_[i].x_m - start.x_m, X_WB_[i].y_m - start.y_m);
      if (taken || off_m >= least_m) continue;
      nearest = robot;
      least_m = off_m;
    }
    if (nearest >= 0) robots_[name] = nearest;
  }

  void place(const std::string& name, const Pose& pose) {
    stage_name_ = name;
    robot_ = robots_.count(name) == 0 ? -1 : robots_.at(name);
    if (robot_ < 0) return;
    const std::string& own = simulation_.world().robots[static_cast<std::size_t>(robot_)].name;
    if (simulation_.place_object(own, pose)) {
      ++refused_;
      robot_ = -1;
    }
  }

  /// Puts all robots but one where they were at the start, as in Stage. They may have moved: a
  /// robot that is put beside another one, whose body is a little larger in Playpen, shoves it.
  void return_others(const std::string& name) {
    std::map<int, Pose> to;
    for (std::size_t i = 0; i < X_WB_.size(); ++i) to[static_cast<int>(i)] = X_WB_[i];
    for (const auto& [stage, X_WB] : starts_) {
      if (robots_.count(stage) != 0) to[robots_.at(stage)] = X_WB;
    }
    if (robots_.count(name) != 0) to.erase(robots_.at(name));
    for (const auto& [robot, X_WB] : to) {
      const std::string& own = simulation_.world().robots[static_cast<std::size_t>(robot)].name;
      // Where its way is not free, it stays; the scans show that.
      static_cast<void>(simulation_.place_object(own, X_WB));
    }
  }

  void compare_scans() {
    if (robot_ >= 0 && !scans_.empty()) {
      for (int i = 0; i < 21; ++i) simulation_.step();  // each sensor measures
      const std::vector<std::string> names = interop::rangers_of(simulation_, robot_);
      std::size_t next = 0;
      for (std::size_t ranger = 0; ranger < scans_.size(); ++ranger) {
        // As Stage's plugin publishes them: all samples of a single sensor, the first one of each
        // of several.
        const std::vector<Scan>& sensors = scans_[ranger];
        Scan scan = sensors.empty() ? Scan() : sensors.front();
        if (sensors.size() > 1) {
          scan = {};
          for (const Scan& s : sensors) {
            if (s.ranges_m.empty()) continue;
            scan.ranges_m.push_back(s.ranges_m.front());
            scan.ranges_max_m.push_back(s.ranges_max_m.front());
          }
        }
        compare(ranger, next < names.size() ? names[next] : "", scan);
        ++next;
      }
    }
    scans_.clear();
  }

  void compare(std::size_t ranger, const std::string& device, const Scan& stage) {
    Figures& figures = figures_[stage_name_ + " ranger:" + std::to_string(ranger)];
    const Beams ours = device.empty() ? Beams() : beams_of(simulation_, robot_, device);
    if (ours.ranges_m.size() != stage.ranges_m.size()) {
      if (device_differs_.empty()) {
        device_differs_ = stage_name_ + ' ' + device + ": " +
                          std::to_string(stage.ranges_m.size()) + " ranges in Stage, " +
                          std::to_string(ours.ranges_m.size()) + " in Playpen";
      }
      figures.beams += stage.ranges_m.size();
      figures.other_device += stage.ranges_m.size();
      figures.errors_m.resize(figures.beams, stage.ranges_max_m.front());
      return;
    }
    const Pose X_WB = simulation_.body(robot_).X_WB;
    std::vector<Side> sides;  // drawn when a beam needs them
    Raster rasters[2] = {Raster(cell_m_), Raster(cell_m_)};
    for (std::size_t i = 0; i < ours.ranges_m.size(); ++i) {
      const double theirs_m = std::min(stage.ranges_m[i], stage.ranges_max_m[i]);
      const double error_m = ours.ranges_m[i] - theirs_m;
      const Pose X_WS = X_WB * ours.X_BS[i];
      ++figures.beams;
      figures.errors_m.push_back(std::abs(error_m));
      // One cell along x or y.
      const double cell_along_m =
          1.0001 * cell_m_ /
          std::max(std::abs(std::cos(X_WS.yaw_rad)), std::abs(std::sin(X_WS.yaw_rad)));
      if (std::abs(error_m) <= 2.0 * cell_along_m) {
        ++figures.agree;
        ++figures.two_cells;
        continue;
      }
      const std::vector<double>& heights_m = ours.heights_m;
      if (sides.empty() || (i > 0 && heights_m[i] != heights_m[i - 1])) {
        draw(heights_m[i], sides, rasters);
      }
      // Only the outlines that Playpen's ranger really sees explain a difference.
      const Vec2 along(std::cos(X_WS.yaw_rad), std::sin(X_WS.yaw_rad));
      const double drawn_m = cast(sides, X_WS.position(), along, ours.ranges_max_m[i]).range_m;
      const bool as_drawn = std::abs(drawn_m - ours.ranges_m[i]) <= 0.002 + 5.0 * ours.noise_m;
      bool agrees = as_drawn && off_m(sides, X_WS.position(), X_WS.yaw_rad, theirs_m,
                                      ours.ranges_max_m[i], 2.0 * cell_m_) <= 2.0 * cell_m_;
      if (agrees) ++figures.two_cells;
      double walked_m = 0.0;
      for (const Raster& raster : rasters) {
        walked_m = raster.cast_m(X_WS.position(), X_WS.yaw_rad, ours.ranges_max_m[i]);
        agrees = agrees || (as_drawn && std::abs(walked_m - theirs_m) <= cell_along_m);
      }
      if (agrees) {
        ++figures.agree;
        continue;
      }
      list_beam(device, i, X_WS, sides, theirs_m, walked_m, ours);
      if (theirs_m >= stage.ranges_max_m[i]) {
        ++figures.extra;
      } else if (ours.ranges_m[i] >= ours.ranges_max_m[i]) {
        ++figures.missed;
      } else {
        ++(error_m > 0.0 ? figures.farther : figures.nearer);
      }
    }
  }

  /// The outlines that a ranger at a height sees, and two rasters of them.
  void draw(double height_m, std::vector<Side>& sides, Raster (&rasters)[2]) {
    sides = sides_above(simulation_, robot_, height_m);
    // Stage draws lines in the order of a block's points, which Playpen does not keep.
    for (const Side& side : sides_above(simulation_, -1, -1.0)) rasters[0].draw(side, false);
    // Paddles of grippers, which Playpen's rangers do not see.
    for (int i = 0; i < simulation_.robot_count(); ++i) {
      std::vector<Side> paddles;
      for (const sim::Polygon& paddle : simulation_.robot_snapshot(i).paddles) {
        add(paddles, paddle, simulation_.body(i).X_WB, "paddle");
      }
      for (const Side& side : paddles) rasters[0].draw(side, false);
    }
    rasters[1] = rasters[0];
    for (const Side& side : sides) {
      rasters[0].draw(side, true);
      rasters[1].draw({side.b, side.a, side.solid}, true);
    }
  }

  void list_beam(const std::string& device, std::size_t beam, const Pose& X_WS,
                 const std::vector<Side>& sides, double theirs_m, double walked_m,
                 const Beams& ours) {
    if (list_ == 0) return;
    --list_;
    const Vec2 along(std::cos(X_WS.yaw_rad), std::sin(X_WS.yaw_rad));
    const Hit hit = cast(sides, X_WS.position(), along, ours.ranges_max_m[beam]);
    const Vec2 end = X_WS.position() + theirs_m * along;
    std::cout << "  " << stage_name_ << ' ' << device << " beam " << beam << " from (" << X_WS.x_m
              << ", " << X_WS.y_m << ") at height " << ours.heights_m[beam] << ": Stage "
              << theirs_m << " at (" << end.x() << ", " << end.y() << "), raster " << walked_m
              << ", Playpen " << ours.ranges_m[beam] << " at "
              << (hit.side < 0 ? "nothing" : sides[static_cast<std::size_t>(hit.side)].solid)
              << '\n';
  }

  void drive(const std::string& name, std::istream& in) {
    double x, y, yaw, v, omega, seconds, to_x, to_y, to_yaw;
    if (!(in >> x >> y >> yaw >> v >> omega >> seconds >> to_x >> to_y >> to_yaw)) return;
    place(name, {x, y, yaw});
    if (robot_ < 0) return;
    const auto motion = simulation_.find_device(robot_, "motion");
    if (!motion) return;
    static_cast<void>(simulation_.apply({robot_, *motion}, sim::TwistCommand{{v, omega}}));
    const sim::SimTime until_ns = simulation_.now_ns() + sim::from_seconds(seconds);
    while (simulation_.now_ns() < until_ns) simulation_.step();
    const Pose& end = simulation_.body(robot_).X_WB;
    Drives& drives = drives_[name];
    ++drives.count;
    drives.farthest_m = std::max(drives.farthest_m, std::hypot(end.x_m - to_x, end.y_m - to_y));
    drives.greatest_turn_rad =
        std::max(drives.greatest_turn_rad, std::abs(sim::normalize_angle(end.yaw_rad - to_yaw)));
    static_cast<void>(simulation_.apply({robot_, *motion}, sim::TwistCommand{{0.0, 0.0}}));
    simulation_.step();
  }

  /// Drives until the robot touches something, as Stage's has done.
  void hit(const std::string& name, std::istream& in) {
    double x, y, yaw, v, seconds, to_x, to_y;
    std::string end;
    if (!(in >> x >> y >> yaw >> v >> seconds >> to_x >> to_y >> end)) return;
    return_others(name);
    place(name, {x, y, yaw});
    if (robot_ < 0) return;
    const auto motion = simulation_.find_device(robot_, "motion");
    if (!motion) return;
    simulation_.step();
    const int before = simulation_.statistics(robot_).collisions;
    static_cast<void>(simulation_.apply({robot_, *motion}, sim::TwistCommand{{v, 0.0}}));
    const sim::SimTime until_ns = simulation_.now_ns() + sim::from_seconds(seconds);
    const auto touches = [&] {
      return simulation_.statistics(robot_).collisions > before || simulation_.body(robot_).stalled;
    };
    while (simulation_.now_ns() < until_ns && !touches()) simulation_.step();
    const Pose& at = simulation_.body(robot_).X_WB;
    const double ours_m = std::hypot(at.x_m - x, at.y_m - y),
                 theirs_m = std::hypot(to_x - x, to_y - y);
    Hits& hits = hits_[name];
    ++hits.count;
    // Stage moves in steps of 0.1 s, and does not take the one that would overlap something.
    const double tolerance_m = std::abs(v) * 0.1 + 3.0 * cell_m_;
    if (std::abs(ours_m - theirs_m) <= tolerance_m) {
      ++hits.agree;
    } else {
      ++(ours_m > theirs_m ? hits.farther : hits.nearer);
      if (list_ > 0) {
        --list_;
        std::cout << "  " << name << " from (" << x << ", " << y << ", " << yaw << "): stops after "
                  << theirs_m << " m in Stage (" << end << "), " << ours_m << " m in Playpen at "
                  << (touches() && !simulation_.collisions().empty()
                          ? simulation_.collisions().back().partner
                          : "nothing")
                  << '\n';
      }
    }
    static_cast<void>(simulation_.apply({robot_, *motion}, sim::TwistCommand{{0.0, 0.0}}));
    simulation_.step();
  }

  static void print_line(const std::string& name, Figures& f) {
    if (f.beams == 0) return;
    const auto share = [&](std::size_t some) {
      return 100.0 * static_cast<double>(some) / static_cast<double>(f.beams);
    };
    const auto middle = f.errors_m.begin() + static_cast<std::ptrdiff_t>(f.errors_m.size() / 2);
    std::nth_element(f.errors_m.begin(), middle, f.errors_m.end());
    std::cout << name << ": " << f.beams << " beams, " << share(f.agree) << " % agree, "
              << share(f.two_cells) << " % without a raster, median difference " << 1000.0 * *middle
              << " mm; others: " << f.missed << " only in Stage, " << f.extra
              << " only in Playpen, " << f.farther << " farther, " << f.nearer << " nearer, "
              << f.other_device << " of other devices\n";
  }

  sim::Simulation simulation_;
  std::size_t list_;
  double cell_m_ = 0.02;
  std::map<std::string, int> robots_;
  std::map<std::string, Pose> starts_;
  std::vector<Pose> X_WB_;  ///< of all robots at the start
  std::string stage_name_;
  int robot_ = -1;
  std::vector<std::vector<Scan>> scans_;  // of the present pose, ranger by ranger
  std::map<std::string, Figures> figures_;
  std::map<std::string, Drives> drives_;
  std::map<std::string, Hits> hits_;
  std::string device_differs_;  // the first ranger with another number of beams
  int refused_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() != 2 && (words.size() != 4 || words[2] != "--list")) {
    std::cerr << "usage: compare_stage WORLD SCANS [--list N]\n";
    return 2;
  }
  try {
    Comparison comparison(words[0],
                          words.size() == 4 ? static_cast<std::size_t>(std::stoul(words[3])) : 0);
    std::ifstream in(words[1]);
    comparison.run(in);
    comparison.print();
  } catch (const std::exception& error) {
    std::cerr << "compare_stage: " << error.what() << '\n';
    return 1;
  }
}
