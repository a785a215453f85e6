// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "imr-h/logging.h"
#include "libCCMorse/ArenaProxy.h"
#include "par_common/distance.h"

namespace {

const double RADIUS = 0.13;  // radius by which obstacles are inflated [m]
// Start and goal of a path may lie this far inside an inflated obstacle; the nearest free cell then
// replaces them [m].
const double REACH = 0.3;

const double VIEW = 1.5;         // range of the fiducial finder [m]
const double HALF_VIEW = 1.5;    // half its angle of view, a little less than 90 degrees [rad]
const int VIEW_STEP = 2;         // every second cell in each direction is enough for the view
const double MEMORY = 6.0;       // how long the robot follows a fox out of sight [s]
const double AHEAD = 0.5;        // how far ahead the place of the fox is estimated [s]
const double PLAN_PERIOD = 0.5;  // [s]
const double PATROL_SPEED = 0.3;  // expected speed on a patrol [m/s]

const char* const MAP = "map";
const char* const VIEWED = "viewed";
const char* const PATH = "path";
const char* const FOX = "fox";

par::FollowerParams followerParams() {
  par::FollowerParams params;
  params.max_speed_mps = 0.4;
  params.goal_tolerance_m = 0.05;
  return params;
}

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<unsigned>("fiducial-index", "number of the fiducial finder", 0);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      fiducial(new PlayerCc::FiducialProxy(client.get(), cfg.get<unsigned>("fiducial-index"))),
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)),
      follower(followerParams()) {
  using CCMorse::GridMapLayer;
  // Layers with a higher priority lie above those with a lower one.
  window.CreateLayer(VIEWED, GridMapLayer::BINARY, 1).SetColour("#cfe8cf");
  window.CreateLayer(MAP, GridMapLayer::BINARY, 2).SetColour("#202020");
  window.CreateLayer(PATH, GridMapLayer::BINARY, 3).SetColour("#ff8800");
  window.CreateLayer(FOX, GridMapLayer::BINARY, 4).SetColour("#d6006c");
  while (!position->IsFresh() || !fiducial->IsFresh()) {
    client->Read();
  }
}

CRobot::~CRobot() {
  stop();
  join();
}

void CRobot::stop() {
  ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  try {
    navigation();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
  }
  try {
    // The arena can still be read after the end.
    const CCMorse::ArenaProxy arena(client.get());
    success = arena.HasVerdict() && arena.GetVerdict().passed;
    INFO((success ? "The fox is caught after " : "The fox is not caught after ") << now << " s");
  } catch (const CCMorse::MorseError& e) {
    ERROR("No verdict: " << e.GetErrorStr());
  }
  delete &window;
  fiducial.reset();
  position.reset();
  client.reset();
}

void CRobot::navigation() {
  position->SetMotorEnable(true);
  fetchMap();
  double planTime = -PLAN_PERIOD;
  bool q = false;
  while (!q) {
    position->NotFresh();
    pose = {position->GetXPos(), position->GetYPos(), position->GetYaw()};
    now = position->GetDataTime();
    lookAround();
    if (now - planTime > PLAN_PERIOD - 0.01 || follower.done()) {
      planTime = now;
      plan();
    }
    const par::Velocity velocity = follower.update(pose);
    position->SetSpeed(velocity.forward_mps, velocity.turn_radps);
    client->Read();

    ScopedLock lk(mtx);
    q = quit;
  }
  position->SetSpeed(0.0, 0.0);
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
      // Player counts rows from the bottom.
      walls[{column, row}] = map.GetCell(column, frame.height - 1 - row) < 0 ? 0 : 1;
    }
  }
  inflated = par::inflate(walls, RADIUS);
  seen = par::Grid<double>(frame, 0.0);
  drawCells(MAP, walls);
}

// --- Seeing --------------------------------------------------------------------------------------

void CRobot::lookAround() {
  if (!fiducial->IsFresh()) return;
  fiducial->NotFresh();
  noteView();
  if (fiducial->GetCount() == 0) return;
  const player_fiducial_item_t item = fiducial->GetFiducialItem(0);
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  noteFox({pose.x + c * item.pose.px - s * item.pose.py,
           pose.y + s * item.pose.px + c * item.pose.py});
}

// Estimates the fox's velocity from its places in successive readings, with a low-pass filter.
void CRobot::noteFox(const par::Point& at) {
  const double period = now - fox.time;
  if (fox.time >= 0.0 && period > 0.0 && period < 0.5) {
    const double gain = 0.3;
    fox.speedX += gain * ((at.x - fox.at.x) / period - fox.speedX);
    fox.speedY += gain * ((at.y - fox.at.y) / period - fox.speedY);
  } else {
    fox.speedX = fox.speedY = 0.0;
  }
  fox.at = at;
  fox.time = now;
  drawFox();
}

// Notes the time for all cells that the fiducial finder can see now.
void CRobot::noteView() {
  const par::GridFrame& frame = walls.frame();
  const par::Cell centre = frame.cell_of({pose.x, pose.y});
  const int reach = static_cast<int>(VIEW / frame.cell_size_m);
  for (int row = centre.row - reach; row <= centre.row + reach; row += VIEW_STEP) {
    for (int column = centre.column - reach; column <= centre.column + reach;
         column += VIEW_STEP) {
      const par::Cell cell = {column, row};
      if (!walls.contains(cell) || walls[cell] != 0) continue;
      const par::Point point = frame.centre_of(cell);
      const double bearing = par::normalize_angle(
          std::atan2(point.y - pose.y, point.x - pose.x) - pose.yaw);
      if (par::distance_m(point, {pose.x, pose.y}) > VIEW || std::fabs(bearing) > HALF_VIEW ||
          !par::line_of_sight(walls, centre, cell)) {
        continue;
      }
      for (int dy = 0; dy < VIEW_STEP; dy++) {
        for (int dx = 0; dx < VIEW_STEP; dx++) {
          const par::Cell near = {column + dx, row + dy};
          if (seen.contains(near)) seen[near] = now;
        }
      }
    }
  }
}

// The estimated place of the fox some seconds from now.
par::Point CRobot::whereIsFox(double ahead) const {
  const double time = std::min(now - fox.time, 1.5) + ahead;
  return {fox.at.x + fox.speedX * time, fox.at.y + fox.speedY * time};
}

// --- Where to go ---------------------------------------------------------------------------------

// The cell for which the time since it was in view is longest, less the time to get there. Some
// cells are enough to choose from.
par::Cell CRobot::patrolGoal(const par::Cell& from) const {
  const int step = 8;
  const par::DistanceField ways(inflated, from);
  par::Cell best = from;
  double most = -std::numeric_limits<double>::infinity();
  for (int row = 0; row < seen.height(); row += step) {
    for (int column = 0; column < seen.width(); column += step) {
      const par::Cell cell = {column, row};
      const double way = ways.distance_m(cell);
      if (!std::isfinite(way)) continue;
      const double worth = now - seen[cell] - way / PATROL_SPEED;
      if (worth <= most) continue;
      most = worth;
      best = cell;
    }
  }
  return best;
}

void CRobot::plan() {
  const par::GridFrame& frame = inflated.frame();
  par::Mask recent(frame);
  for (std::size_t i = 0; i < recent.values().size(); i++) {
    recent.values()[i] = seen.values()[i] > now - MEMORY && walls.values()[i] == 0;
  }
  drawCells(VIEWED, recent);

  std::vector<par::Cell> path;
  const auto from = par::nearest_free(inflated, frame.cell_of({pose.x, pose.y}), REACH);
  if (from) {
    par::Cell goal = *from;
    const bool follows = fox.time >= 0.0 && now - fox.time < MEMORY;
    const auto to = par::nearest_free(inflated, frame.cell_of(whereIsFox(AHEAD)), REACH);
    goal = follows && to ? *to : patrolGoal(*from);
    path = par::theta_star(inflated, *from, goal).cells;
  }
  drawPath(path);
  follower.set_path(par::to_points(frame, path));
}

// --- Drawing -------------------------------------------------------------------------------------

void CRobot::drawCells(const std::string& layer, const par::Mask& cells) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(layer);
  drawing.Clear();
  for (std::size_t i = 0; i < cells.values().size(); i++) {
    if (cells.values()[i] == 0) continue;
    const par::Cell cell = cells.frame().cell_at(i);
    drawing.SetCell(cell.column, cell.row, 1);
  }
}

void CRobot::drawPath(const std::vector<par::Cell>& path) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(PATH);
  drawing.Clear();
  for (std::size_t i = 1; i < path.size(); i++) {
    drawing.SetLine(path[i - 1].column, path[i - 1].row, path[i].column, path[i].row);
  }
}

// A dot where the fox was seen last.
void CRobot::drawFox() const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(FOX);
  drawing.Clear();
  const CCMorse::ImagePoint_t middle = window.GetPoint(fox.at.x, fox.at.y);
  for (int dy = -2; dy <= 2; dy++) {
    for (int dx = -2; dx <= 2; dx++) drawing.SetCell(middle.x + dx, middle.y + dy, 1);
  }
}
