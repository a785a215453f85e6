// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Compares what Playpen measures with what stage_scans has written about Stage:
//   compare_stage WORLD SCANS NAME=PLAYPENS_NAME:PORT...
// It prints a line for each ranger of each robot, and one for the drives of each robot.
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Point {
  double x, y;
};

/// Distance of a point from a line segment.
double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  double t = length2 > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0.0;
  t = std::max(0.0, std::min(1.0, t));
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Figures of one ranger.
struct Ranger {
  std::size_t beams = 0, alike = 0, one_cell = 0, two_cells = 0, missed = 0, extra = 0, farther = 0,
              nearer = 0;
  std::vector<double> errors;
  std::string problem;
};

/// Ranges of a ranger of Stage at a pose.
struct Scan {
  double field_of_view = 0.0, range_max = 0.0;
  std::size_t sensors = 0;
  std::vector<double> ranges;
};

/// One robot of the world.
struct Robot {
  explicit Robot(const std::string& world, const std::string& called, int port)
      : name(called),
        client("sim:" + world, static_cast<uint32_t>(port)),
        simulation(&client, 0),
        position(&client, 0) {}

  void place(double x, double y, double yaw) {
    simulation.SetPose2d(&name[0], x, y, yaw);
    // Readings that were made before are still to come.
    for (int i = 0; i < 3; ++i) client.Read();
  }

  std::string name;
  PlayerCc::PlayerClient client;
  PlayerCc::SimulationProxy simulation;
  PlayerCc::Position2dProxy position;
  std::map<std::size_t, std::unique_ptr<PlayerCc::RangerProxy>> rangers;
  std::map<std::size_t, Ranger> figures;
  std::vector<double> drive_errors_m, drive_errors_rad;
};

void compare(Robot& robot, std::size_t index, const Scan& stage, double cell) {
  Ranger& figures = robot.figures[index];
  std::unique_ptr<PlayerCc::RangerProxy>& proxy = robot.rangers[index];
  if (!figures.problem.empty()) return;
  if (proxy->GetRangeCount() != stage.ranges.size()) {
    figures.problem = std::to_string(stage.ranges.size()) + " ranges in Stage, " +
                      std::to_string(proxy->GetRangeCount()) + " in Playpen";
    return;
  }
  const std::size_t count = stage.ranges.size();
  const bool is_scan = stage.sensors == 1 && count > 1;
  // A line crosses cells of Stage's raster; a beam ends where it enters one of them. That point is
  // at most a diagonal of a cell from the line, and farther away along a beam that meets it at an
  // angle. Stage rounds the ends of lines to cells, too, which moves them by another diagonal at
  // most.
  const double diagonal = std::sqrt(2.0) * cell;
  // Stage gives ranges that meet nothing the maximum.
  const double max = stage.range_max;
  const auto place = [&](std::size_t beam, double range) {
    const double angle = is_scan ? stage.field_of_view * (beam / (count - 1.0) - 0.5) : 0.0;
    return Point{range * std::cos(angle), range * std::sin(angle)};
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double theirs = stage.ranges[i];
    const double ours = proxy->GetRange(static_cast<uint32_t>(i));
    const double error = ours - theirs;
    ++figures.beams;
    figures.errors.push_back(std::abs(error));
    if (std::abs(error) <= cell) ++figures.alike;
    double off = std::abs(error);
    if (is_scan && theirs < max) {
      const Point hit = place(i, theirs);
      for (std::size_t j = i == 0 ? 0 : i - 1; j <= i && j + 1 < count; ++j) {
        const double a = proxy->GetRange(static_cast<uint32_t>(j));
        const double b = proxy->GetRange(static_cast<uint32_t>(j + 1));
        if (a < max && b < max) off = std::min(off, distance(hit, place(j, a), place(j + 1, b)));
      }
    }
    if (off <= diagonal) ++figures.one_cell;
    if (off <= 2.0 * diagonal) {
      ++figures.two_cells;
    } else if (theirs >= max) {
      ++figures.extra;
    } else if (ours >= max) {
      ++figures.missed;
    } else if (error > 0.0) {
      ++figures.farther;
    } else {
      ++figures.nearer;
    }
  }
}

double part(std::size_t some, std::size_t all) { return all == 0 ? 0.0 : 100.0 * some / all; }

void drive(Robot& robot, std::istream& in) {
  double x, y, yaw, v, omega, seconds, to_x, to_y, to_yaw;
  if (!(in >> x >> y >> yaw >> v >> omega >> seconds >> to_x >> to_y >> to_yaw)) return;
  robot.place(x, y, yaw);
  robot.position.SetSpeed(v, omega);
  const double begin = robot.position.GetDataTime();
  while (robot.position.GetDataTime() < begin + seconds - 1e-6) robot.client.Read();
  double end_x = 0.0, end_y = 0.0, end_yaw = 0.0;
  robot.simulation.GetPose2d(&robot.name[0], end_x, end_y, end_yaw);
  robot.position.SetSpeed(0.0, 0.0);
  robot.client.Read();
  robot.drive_errors_m.push_back(std::hypot(end_x - to_x, end_y - to_y));
  robot.drive_errors_rad.push_back(std::abs(PlayerCc::normalize(end_yaw - to_yaw)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: compare_stage WORLD SCANS NAME=PLAYPENS_NAME:PORT...\n";
    return 2;
  }
  std::map<std::string, std::unique_ptr<Robot>> robots;
  try {
    for (int i = 3; i < argc; ++i) {
      const std::string text = argv[i];
      // Names of Stage contain colons.
      const std::size_t equals = text.find('='), colon = text.rfind(':');
      robots[text.substr(0, equals)].reset(new Robot(argv[1],
                                                     text.substr(equals + 1, colon - equals - 1),
                                                     std::atoi(text.c_str() + colon + 1)));
    }
    std::ifstream in(argv[2]);
    std::string line;
    double cell = 0.02;
    Robot* robot = nullptr;
    std::size_t ranger = 0;
    Scan scan;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string what, name;
      words >> what;
      if (what == "resolution") {
        words >> cell;
      } else if (what == "pose" || what == "drive") {
        words >> name;
        const auto found = robots.find(name);
        robot = found == robots.end() ? nullptr : found->second.get();
        if (robot == nullptr) continue;
        if (what == "drive") {
          drive(*robot, words);
          continue;
        }
        double x, y, yaw;
        words >> x >> y >> yaw;
        if (!robot->rangers.empty()) robot->place(x, y, yaw);
        // At the first pose the rangers are not known yet.
        if (robot->rangers.empty()) robot->simulation.SetPose2d(&robot->name[0], x, y, yaw);
      } else if (what == "ranger" && robot != nullptr) {
        scan = Scan();
        words >> ranger >> scan.sensors;
        if (robot->rangers.find(ranger) == robot->rangers.end()) {
          try {
            robot->rangers[ranger].reset(
                new PlayerCc::RangerProxy(&robot->client, static_cast<uint32_t>(ranger)));
            for (int i = 0; i < 3; ++i) robot->client.Read();
          } catch (const PlayerCc::PlayerError& error) {
            robot->figures[ranger].problem = error.GetErrorStr();
          }
        }
      } else if (what == "sensor" && robot != nullptr) {
        std::size_t count = 0;
        words >> scan.field_of_view >> scan.range_max >> count;
        double range = 0.0;
        for (std::size_t i = 0; i < count && words >> range; ++i) scan.ranges.push_back(range);
        if (--scan.sensors == 0) {
          scan.sensors = scan.ranges.size() == count ? 1 : scan.ranges.size();
          compare(*robot, ranger, scan, cell);
        }
      }
    }
  } catch (const PlayerCc::PlayerError& error) {
    std::cerr << "compare_stage: " << error << '\n';
    return 1;
  }
  std::cout.setf(std::ios::fixed);
  std::cout.precision(2);
  for (auto& entry : robots) {
    Robot& robot = *entry.second;
    for (auto& one : robot.figures) {
      Ranger& r = one.second;
      std::cout << entry.first << " ranger:" << one.first << ": ";
      if (!r.problem.empty()) {
        std::cout << r.problem << '\n';
        continue;
      }
      std::sort(r.errors.begin(), r.errors.end());
      std::cout << r.beams << " beams, " << part(r.alike, r.beams)
                << " % differ by at most a cell, " << part(r.one_cell, r.beams)
                << " % end within a cell of the same surface, " << part(r.two_cells, r.beams)
                << " % within two; median " << 1000.0 * r.errors[r.errors.size() / 2]
                << " mm; others: " << r.missed << " only in Stage, " << r.extra
                << " only in Playpen, " << r.farther << " farther, " << r.nearer << " nearer\n";
    }
    if (robot.drive_errors_m.empty()) continue;
    std::cout << entry.first << " drives: " << robot.drive_errors_m.size() << ", ends at most "
              << 1000.0 *
                     *std::max_element(robot.drive_errors_m.begin(), robot.drive_errors_m.end())
              << " mm and "
              << PlayerCc::rtod(*std::max_element(robot.drive_errors_rad.begin(),
                                                  robot.drive_errors_rad.end()))
              << " degrees from Stage's\n";
  }
}
