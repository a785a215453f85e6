// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "frames.h"
#include "imr-h/imr_exceptions.h"
#include "imr-h/logging.h"
#include "par_common/distance.h"

namespace {

// The pose is known if its errors are below these limits, and most of the scan fits the map there,
// in this number of rounds in a row.
const double KNOWN_POSITION = 0.08;  // [m]
const double KNOWN_HEADING = 0.1;    // [rad]
const double KNOWN_AGREEMENT = 0.85;
const int KNOWN_ROUNDS = 10;

// The robot is lost if less of the scan fits the map in this number of rounds in a row.
const double LOST_AGREEMENT = 0.75;
const int LOST_ROUNDS = 10;
// The robot gives up if there was no way from so many places where it seemed to be.
const int MOST_WITHOUT_WAY = 3;

// A point of the scan fits the map if a wall is as near as this [m].
const double FITS = 0.08;

// Lanes ahead of the robot, whose radius is 0.098 m: half of their width, and the length that must
// be free, from the robot's centre [m].
const double WIDE = 0.13;  // to wander
const double ROOM = 0.3;
const double NARROW = 0.09;  // to drive ahead at all
const double SAFE = 0.12;

// A start or a goal within the inflated obstacles is moved to the nearest free cell, not farther
// than this [m].
const double REACH = 0.15;

const int DRAWING_PERIOD = 5;  // rounds

const char* const MAP = "map";
const char* const INFLATED = "inflated";
const char* const PARTICLES = "particles";
const char* const PATH = "path";
const char* const GOAL = "goal";

par::FollowerParams followerParams(imr::CConfig& cfg) {
  par::FollowerParams params;
  params.max_speed_mps = cfg.get<double>("speed");
  params.goal_tolerance_m = 0.03;
  return params;
}

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("position2d-index", "number of the odometry", 0);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<double>("goal-x", "where to go [m]", 3.1);
  config.add<double>("goal-y", "where to go [m]", 3.3);
  config.add<double>("inflation", "radius by which obstacles are grown [m]", 0.14);
  config.add<double>("speed", "greatest speed [m/s]", 0.3);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : goalX(cfg.get<double>("goal-x")),
      goalY(cfg.get<double>("goal-y")),
      inflation(cfg.get<double>("inflation")),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      laser(new CCMorse::LaserProxy(client.get(), cfg.get<unsigned>("laser-index"))),
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)),
      follower(followerParams(cfg)) {
  imr::assert_argument(inflation >= 0.0, "--inflation must be at least 0 m");
  // Layers with a higher priority lie above those with a lower one.
  window.CreateLayer(INFLATED, CCMorse::GridMapLayer::BINARY, 1).SetColour("#a9d4f5");
  window.CreateLayer(MAP, CCMorse::GridMapLayer::BINARY, 2).SetColour("#202020");
  window.CreateLayer(PARTICLES, CCMorse::GridMapLayer::BINARY, 3).SetColour("#d62020");
  window.CreateLayer(PATH, CCMorse::GridMapLayer::BINARY, 4).SetColour("#ff8800");
  window.CreateLayer(GOAL, CCMorse::GridMapLayer::BINARY, 5).SetColour("#d6006c");
  while (!position->IsFresh() || !laser->IsFresh()) {
    client->Read();
  }
}

CRobot::~CRobot() {
  stop();
  join();
  delete &window;
}

void CRobot::stop() {
  ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  try {
    success = navigation();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    ERROR("The run is over before the goal was reached: " << e.GetErrorStr());
  }
}

bool CRobot::navigation() {
  fetchMap();
  drawCells(MAP, walls);
  drawCells(INFLATED, inflated);
  drawGoal();
  localizer = makeLocalizer(*client, walls, *position, *laser);
  position->SetMotorEnable(true);

  bool known = false;   // whether the robot knows its pose
  int fits = 0;         // rounds in a row in which the scan fits the map at the estimate
  int contradicts = 0;  // rounds in a row that contradict the estimate
  int withoutWay = 0;   // how often there was no way from where it seemed to be
  for (int round = 0;; round++) {
    client->Read();
    if (!laser->IsFresh()) continue;
    laser->NotFresh();
    position->NotFresh();
    lookAtScan();
    localizer->update();
    const Estimate estimate = localizer->estimate();
    const double fitting = agreement(estimate.pose);
    if (round % DRAWING_PERIOD == 0) drawParticles();

    const bool settled =
        estimate.positionError < KNOWN_POSITION && estimate.headingError < KNOWN_HEADING;
    // Where it thinks that the way is free there may be a wall.
    const bool blocked = roomAhead(NARROW) < SAFE;
    fits = settled && fitting > KNOWN_AGREEMENT ? fits + 1 : 0;
    contradicts = (settled && fitting < LOST_AGREEMENT) || (known && blocked) ? contradicts + 1 : 0;
    if (!known && fits >= KNOWN_ROUNDS) {
      INFO(LOCALIZER_NAME << ": the robot is at (" << estimate.pose.x << ", " << estimate.pose.y
                          << ") m, heading " << estimate.pose.yaw << " rad; " << 100.0 * fitting
                          << " % of the scan fit the map");
      known = planFrom(estimate.pose);
      if (!known) {
        // Places look alike: it may be elsewhere.
        if (++withoutWay == MOST_WITHOUT_WAY) {
          halt();
          return false;
        }
        localizer->forget();
        fits = 0;
      }
    } else if (contradicts >= LOST_ROUNDS) {
      INFO("The robot is lost: " << 100.0 * fitting << " % of the scan fit the map"
                                 << (blocked ? ", and it cannot go ahead" : ""));
      localizer->forget();
      known = false;
      contradicts = 0;
    }

    par::Velocity velocity = known ? follower.update(estimate.pose) : wander();
    if (blocked) velocity.forward_mps = 0.0;
    position->SetSpeed(velocity.forward_mps, velocity.turn_radps);
    if (known && follower.done()) break;
    ScopedLock lk(mtx);
    if (quit) break;
  }
  halt();
  if (known && follower.done()) {
    const par::Pose pose = localizer->estimate().pose;
    INFO("Reached the goal: the robot thinks that it is at (" << pose.x << ", " << pose.y << ") m");
    return true;
  }
  return false;
}

void CRobot::fetchMap() {
  CCMorse::MapProxy map(client.get(), 0);
  map.RequestMap();
  par::GridFrame frame;
  frame.width = static_cast<int>(map.GetWidth());
  frame.height = static_cast<int>(map.GetHeight());
  frame.cell_size_m = map.GetResolution();
  frame.origin = {map.GetOriginX(), map.GetOriginY()};
  walls = par::Mask(frame);
  for (int row = 0; row < frame.height; row++) {
    for (int column = 0; column < frame.width; column++) {
      // Player counts rows from the bottom. A cell that is not certainly free (-1) counts as a
      // wall.
      walls[{column, row}] = map.GetCell(column, frame.height - 1 - row) < 0 ? 0 : 1;
    }
  }
  wallsAt = par::distance_to_blocked_m(walls);
  inflated = par::inflate(walls, inflation);
}

bool CRobot::planFrom(const par::Pose& pose) {
  const par::GridFrame& frame = walls.frame();
  const auto start = par::nearest_free(inflated, frame.cell_of({pose.x, pose.y}), REACH);
  const auto goal = par::nearest_free(inflated, frame.cell_of({goalX, goalY}), REACH);
  par::Path path;
  if (start && goal) path = par::theta_star(inflated, *start, *goal);
  if (!path.found()) {
    ERROR("There is no way from (" << pose.x << ", " << pose.y << ") m to (" << goalX << ", "
                                   << goalY << ") m that leaves the robot " << inflation
                                   << " m of room");
    return false;
  }
  drawPath(path);
  follower.set_path(par::to_points(frame, path.cells));
  return true;
}

// --- The scan ------------------------------------------------------------------------------------

void CRobot::lookAtScan() {
  // From the laser's frame to the robot's. The laser has no geometry in MORSE; here it is known.
  const player_pose3d_t mount = laser->GetPose();
  const double nothing = laser->GetMaxRange() - 1e-6;
  scan.clear();
  for (unsigned i = 0; i < laser->GetCount(); i++) {
    const double range = laser->GetRange(i);
    if (range >= nothing) continue;
    const double bearing = mount.pyaw + laser->GetBearing(i);
    scan.push_back({mount.px + range * std::cos(bearing), mount.py + range * std::sin(bearing)});
  }
}

double CRobot::agreement(const par::Pose& pose) const {
  // The share of the scan that ends near a wall of the map.
  if (scan.empty()) return 0.0;
  int fitting = 0;
  for (const par::Point& point : scan) {
    const par::Pose end = then(pose, {point.x, point.y, 0.0});
    if (wallsAt.value_or(walls.frame().cell_of({end.x, end.y}), FITS) < FITS) fitting++;
  }
  return static_cast<double>(fitting) / static_cast<double>(scan.size());
}

double CRobot::roomAhead(double halfWidth) const {
  double ahead = laser->GetMaxRange();
  for (const par::Point& point : scan) {
    if (point.x > 0.0 && std::fabs(point.y) < halfWidth) ahead = std::min(ahead, point.x);
  }
  return ahead;
}

par::Velocity CRobot::wander() {
  // Goes ahead while the lane ahead is free; otherwise turns to the side with more room, until it
  // is free again.
  const double ahead = roomAhead(WIDE);
  double left = 0.0;
  double right = 0.0;
  for (const par::Point& point : scan) {
    (point.y > 0.0 ? left : right) += std::hypot(point.x, point.y);
  }
  if (ahead > ROOM) {
    turning = 0.0;
    return {std::min(0.25, ahead - ROOM + 0.05), 0.0};
  }
  if (turning == 0.0) turning = left > right ? 1.2 : -1.2;
  return {0.0, turning};
}

void CRobot::halt() {
  // A command stays in effect until the next one, and the robot needs a moment to stop.
  position->SetSpeed(0.0, 0.0);
  do {
    client->Read();
  } while (std::fabs(position->GetXSpeed()) > 1e-3 || std::fabs(position->GetYawSpeed()) > 1e-3);
  position->SetMotorEnable(false);
}

// --- Drawing -------------------------------------------------------------------------------------

void CRobot::drawCells(const std::string& layer, const par::Mask& cells) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(layer);
  drawing.Clear();
  for (int row = 0; row < cells.height(); row++) {
    for (int column = 0; column < cells.width(); column++) {
      if (cells[{column, row}] != 0) drawing.SetCell(column, row, 1);
    }
  }
}

void CRobot::drawParticles() const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(PARTICLES);
  drawing.Clear();
  for (const par::Pose& pose : localizer->particles()) {
    drawing.SetCell(window.GetX(pose.x), window.GetY(pose.y), 1);
  }
}

void CRobot::drawPath(const par::Path& way) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(PATH);
  drawing.Clear();
  for (std::size_t i = 1; i < way.cells.size(); i++) {
    const par::Cell& from = way.cells[i - 1];
    const par::Cell& to = way.cells[i];
    drawing.SetLine(from.column, from.row, to.column, to.row);
  }
}

void CRobot::drawGoal() const {
  // A dot and a ring. The robot fits inside the ring.
  CCMorse::GridMapLayer& drawing = window.GetLayer(GOAL);
  const CCMorse::ImagePoint_t middle = window.GetPoint(goalX, goalY);
  for (int dy = -6; dy <= 6; dy++) {
    for (int dx = -6; dx <= 6; dx++) {
      const double distance = std::hypot(dx, dy);
      if (distance < 1.5 || (distance > 5.0 && distance < 6.4)) {
        drawing.SetCell(middle.x + dx, middle.y + dy, 1);
      }
    }
  }
}
