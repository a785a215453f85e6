// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "collector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "imr-h/logging.h"

namespace {

const double LASER_X = 0.035;     // distance of the laser ahead of the robot's centre [m]
const double FOOTPRINT = 0.075;   // radius of a circle inside the robot's outline [m]
const int NEIGHBOURS = 7;         // echoes are averaged over this many beams on each side ...
const double CLOSE = 0.04;        // ... that are at most this far away [m]
const int SCANS_PER_PICTURE = 3;  // draw the map every third scan: 3.3 times a second

// Moves each point to the mean of the near points among its neighbouring beams. On a wall this
// removes most of the noise; corners lose a few millimetres.
std::vector<par::Point> smooth(const std::vector<par::Point>& points) {
  const int count = static_cast<int>(points.size());
  std::vector<par::Point> result;
  result.reserve(points.size());
  for (int i = 0; i < count; i++) {
    const par::Point& middle = points[static_cast<std::size_t>(i)];
    par::Point sum = {0.0, 0.0};
    int close = 0;
    for (int j = std::max(0, i - NEIGHBOURS); j <= std::min(count - 1, i + NEIGHBOURS); j++) {
      const par::Point& p = points[static_cast<std::size_t>(j)];
      if (std::fabs(p.x - middle.x) > CLOSE || std::fabs(p.y - middle.y) > CLOSE) continue;
      sum.x += p.x;
      sum.y += p.y;
      close++;
    }
    result.push_back({sum.x / close, sum.y / close});
  }
  return result;
}

}  // namespace

imr::CConfig& CCollector::getConfig(imr::CConfig& config) {
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<unsigned>("position2d-index",
                       "where poses come from: 0 the arena's localisation, 1 the odometry", 0);
  return config;
}

CCollector::CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& aClient, CSharedMap& aMap,
                       CLayers& someLayers)
    : client(aClient),
      map(aMap),
      layers(someLayers),
      laser(new CCMorse::LaserProxy(&client, cfg.get<unsigned>("laser-index"))),
      position(new CCMorse::Position2dProxy(&client, cfg.get<unsigned>("position2d-index"))),
      arena(new CCMorse::Position2dProxy(&client, 0)),
      grid(aMap.copy()) {}

CCollector::~CCollector() {
  stop();
  join();
}

void CCollector::waitForData() {
  while (!laser->IsFresh() || !position->IsFresh() || !arena->IsFresh()) client.Read();
  setOrigin();
}

void CCollector::stop() {
  const ScopedLock lk(mtx);
  quit = true;
}

bool CCollector::hasFailed() const {
  const ScopedLock lk(mtx);
  return failed;
}

void CCollector::threadBody() {
  try {
    collect();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
  } catch (const std::exception& e) {
    ERROR("Collecting data: " << e.what());
    const ScopedLock lk(mtx);
    failed = true;
  }
  map.close();  // otherwise the other thread would wait for ever
}

void CCollector::collect() {
  integrate();  // waitForData() has read the first data
  while (true) {
    client.Read();
    {
      // Check `quit` only here, not after integrate(). The caller of stop() has waited for the map
      // of the previous Read(), so this Read() is the last one in every run, regardless of thread
      // timing.
      const ScopedLock lk(mtx);
      if (quit) break;
    }
    integrate();
  }
  layers.drawMap(grid);
}

// Odometry starts at 0 where the robot starts. The arena's localisation gives that place at the
// first moment, so the map lies in the arena's frame with either source of poses.
void CCollector::setOrigin() {
  const double yaw = par::normalize_angle(arena->GetYaw() - position->GetYaw());
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  origin.x = arena->GetXPos() - (c * position->GetXPos() - s * position->GetYPos());
  origin.y = arena->GetYPos() - (s * position->GetXPos() + c * position->GetYPos());
  origin.yaw = yaw;
}

par::Pose CCollector::robotPose() const {
  const double c = std::cos(origin.yaw);
  const double s = std::sin(origin.yaw);
  return {origin.x + c * position->GetXPos() - s * position->GetYPos(),
          origin.y + s * position->GetXPos() + c * position->GetYPos(),
          par::normalize_angle(origin.yaw + position->GetYaw())};
}

void CCollector::integrate() {
  Observation seen;
  seen.time = position->GetDataTime();
  seen.robot = robotPose();

  // The laser data in two forms: a scan for the map, and points around the robot.
  par::Scan scan;
  scan.sensor = {seen.robot.x + LASER_X * std::cos(seen.robot.yaw),
                 seen.robot.y + LASER_X * std::sin(seen.robot.yaw), seen.robot.yaw};
  scan.first_bearing_rad = laser->GetMinAngle();
  scan.bearing_step_rad = laser->GetScanRes();
  scan.max_range_m = laser->GetMaxRange();
  const unsigned beams = laser->GetCount();
  scan.ranges_m.reserve(beams);
  seen.echoes.reserve(beams);
  for (unsigned i = 0; i < beams; i++) {
    const double range = laser->GetRange(i);
    scan.ranges_m.push_back(range);
    if (range >= scan.max_range_m) continue;  // this beam hit nothing
    const double bearing = scan.first_bearing_rad + i * scan.bearing_step_rad;
    seen.echoes.push_back({LASER_X + range * std::cos(bearing), range * std::sin(bearing)});
  }
  seen.echoes = smooth(seen.echoes);

  for (const Area& area : map.takeForgotten()) {
    grid.set_unknown(area.centre, area.length, area.width);
  }
  if (laser->IsFresh()) {
    laser->NotFresh();
    grid.update(scan);
    // The laser does not see the floor below the robot.
    grid.set_free({seen.robot.x, seen.robot.y}, FOOTPRINT);
    layers.drawScan(seen);
    if (scans++ % SCANS_PER_PICTURE == 0) layers.drawMap(grid);
  }
  layers.drawTrail(seen.robot);
  map.publish(grid, seen);
}
