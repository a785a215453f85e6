// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "imr-h/imr_exceptions.h"
#include "imr-h/logging.h"
#include "par_common/distance.h"
#include "par_common/text_map.h"
#include "planner.h"

namespace {

// Start and goal may lie this far inside the inflated obstacles; the nearest free cell then
// replaces them [m].
const double REACH = 0.15;

const char* const MAP = "map";
const char* const INFLATED = "inflated";
const char* const PATH = "path";
const char* const SMOOTHED = "smoothed";
const char* const GOAL = "goal";

par::FollowerParams followerParams(imr::CConfig& cfg) {
  par::FollowerParams params;
  params.max_speed_mps = cfg.get<double>("speed");
  return params;
}

// a / b, rounded up.
int ceilDivide(int a, int b) { return (a + b - 1) / b; }

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 4000);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<std::string>("map", "text file with the map [the map of the world]", "");
  config.add<double>("goal-x", "where to go [m]", 3.1);
  config.add<double>("goal-y", "where to go [m]", 3.3);
  config.add<double>("start-x", "where to start on a map of another place [m]", -1.0);
  config.add<double>("start-y", "where to start on a map of another place [m]", -1.0);
  config.add<double>("inflation", "radius by which obstacles are grown [m]", 0.13);
  config.add<double>("speed", "greatest speed [m/s]", 0.35);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : goalX(cfg.get<double>("goal-x")),
      goalY(cfg.get<double>("goal-y")),
      startX(cfg.get<double>("start-x")),
      startY(cfg.get<double>("start-y")),
      inflation(cfg.get<double>("inflation")),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      // The window takes the canvas's size; the requested size has no effect.
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)),
      fromFile(!cfg.get<std::string>("map").empty()),
      follower(followerParams(cfg)) {
  imr::assert_argument(inflation >= 0.0, "--inflation must be at least 0 m");
  if (fromFile) walls = par::load_text_map(cfg.get<std::string>("map"), window.GetCellSize());
  // Layers with a higher priority lie above those with a lower one.
  window.CreateLayer(INFLATED, CCMorse::GridMapLayer::BINARY, 1).SetColour("#a9d4f5");
  window.CreateLayer(MAP, CCMorse::GridMapLayer::BINARY, 2).SetColour("#202020");
  window.CreateLayer(PATH, CCMorse::GridMapLayer::BINARY, 3).SetColour("#1030a0");
  window.CreateLayer(SMOOTHED, CCMorse::GridMapLayer::BINARY, 4).SetColour("#ff8800");
  window.CreateLayer(GOAL, CCMorse::GridMapLayer::BINARY, 5).SetColour("#d6006c");
  while (!position->IsFresh()) {
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
  drawGoal();

  // With obstacles inflated by the robot's radius, the planner can treat the robot as a point. The
  // map's edges count as walls.
  inflated = par::inflate(walls, inflation);
  drawCells(INFLATED, inflated);
  if (!findEnds()) return false;

  const par::Path path = plan(inflated, start, goal);
  if (!path.found()) {
    const par::Point to = walls.frame().centre_of(goal);
    ERROR("There is no way to (" << to.x << ", " << to.y << ") m that leaves the robot "
                                 << inflation << " m of room");
    return false;
  }
  drawWay(PATH, path, 1);

  const par::Path smoothed = par::smooth(inflated, path);
  drawWay(SMOOTHED, smoothed, 0);
  INFO(PLANNER_NAME << ": a way of " << path.length_m << " m, smoothed " << smoothed.length_m
                    << " m with " << smoothed.cells.size() << " turning points");
  if (!isOfWorld) {
    INFO("The map is not one of this world, so the robot stays where it is");
    client->Read();  // the host draws the layers during this step
    return true;
  }
  return drive(smoothed);
}

void CRobot::fetchMap() {
  if (fromFile) {
    // A map of the canvas's size is assumed to show this world.
    const int width = window.GetWidth();
    const int height = window.GetHeight();
    isOfWorld = walls.width() == width && walls.height() == height;
    if (!isOfWorld) {
      pixelsPerCell = std::max(1, std::min(width / walls.width(), height / walls.height()));
      cellsPerPixel =
          std::max(ceilDivide(walls.width(), width), ceilDivide(walls.height(), height));
      INFO("The map has " << walls.width() << " x " << walls.height() << " cells and the canvas "
                          << width << " x " << height << ": plans only, and draws " << pixelsPerCell
                          << " pixels a cell" << (cellsPerPixel > 1 ? " and " : "")
                          << (cellsPerPixel > 1 ? std::to_string(cellsPerPixel) + " cells a pixel"
                                                : std::string()));
    }
    return;
  }
  CCMorse::MapProxy map(client.get(), 0);
  map.RequestMap();
  par::GridFrame frame;
  frame.width = static_cast<int>(map.GetWidth());
  frame.height = static_cast<int>(map.GetHeight());
  frame.cell_size_m = map.GetResolution();
  frame.origin = {map.GetOriginX(), map.GetOriginY()};
  walls = par::Mask(frame);
  std::vector<std::int8_t> cells(frame.size());
  map.GetMap(cells.data());
  for (int row = 0; row < frame.height; row++) {
    for (int column = 0; column < frame.width; column++) {
      // Player counts rows from the bottom. A cell that is not certainly free (-1) counts as a
      // wall.
      const int index = map.GetCellIndex(column, frame.height - 1 - row);
      walls[{column, row}] = cells[static_cast<std::size_t>(index)] < 0 ? 0 : 1;
    }
  }
}

bool CRobot::findEnds() {
  const par::Point robot = {position->GetXPos(), position->GetYPos()};
  if (isOfWorld) {
    return findEnd("robot", robot, REACH, start) && findEnd("goal", {goalX, goalY}, REACH, goal);
  }
  // On a map of another place: start at the given position, or at the bottom left corner. The
  // nearest free cell replaces start and goal, however far away it is.
  const double anywhere = std::numeric_limits<double>::infinity();
  const bool given = startX >= 0.0 && startY >= 0.0;
  return findEnd("start", given ? par::Point{startX, startY} : par::Point(), anywhere, start) &&
         findEnd("goal", {goalX, goalY}, anywhere, goal);
}

bool CRobot::findEnd(const char* what, const par::Point& wanted, double reach,
                     par::Cell& cell) const {
  const par::GridFrame& frame = walls.frame();
  const auto free = par::nearest_free(inflated, frame.cell_of(wanted), reach);
  if (!free) {
    ERROR("There is no way: the " << what << ", (" << wanted.x << ", " << wanted.y
                                  << ") m, is off the map or deep within " << inflation
                                  << " m of an obstacle");
    return false;
  }
  cell = *free;
  if (cell != frame.cell_of(wanted)) {
    const par::Point instead = frame.centre_of(cell);
    INFO("The " << what << ", (" << wanted.x << ", " << wanted.y
                << ") m, is too near to an obstacle; instead (" << instead.x << ", " << instead.y
                << ") m");
  }
  return true;
}

bool CRobot::drive(const par::Path& way) {
  follower.set_path(par::to_points(walls.frame(), way.cells));
  position->SetMotorEnable(true);
  bool q = false;
  while (!q && !follower.done()) {
    client->Read();
    if (position->IsFresh()) {
      position->NotFresh();
      const par::Velocity velocity =
          follower.update({position->GetXPos(), position->GetYPos(), position->GetYaw()});
      position->SetSpeed(velocity.forward_mps, velocity.turn_radps);
    }
    ScopedLock lk(mtx);
    q = quit;
  }
  // A command stays in effect until the next one, and the robot needs a moment to stop.
  position->SetSpeed(0.0, 0.0);
  do {
    client->Read();
  } while (std::fabs(position->GetXSpeed()) > 1e-3 || std::fabs(position->GetYawSpeed()) > 1e-3);
  position->SetMotorEnable(false);
  if (follower.done()) {
    INFO("Reached the goal: the robot stands at (" << position->GetXPos() << ", "
                                                   << position->GetYPos() << ") m");
  }
  return follower.done();
}

CCMorse::ImagePoint_t CRobot::pixelOf(const par::Cell& cell) const {
  if (!isOfWorld) {
    return CCMorse::ImagePoint_t(cell.column * pixelsPerCell / cellsPerPixel,
                                 cell.row * pixelsPerCell / cellsPerPixel);
  }
  const par::Point centre = walls.frame().centre_of(cell);
  return window.GetPoint(centre.x, centre.y);
}

void CRobot::drawCells(const std::string& layer, const par::Mask& cells) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(layer);
  drawing.Clear();
  for (int row = 0; row < cells.height(); row++) {
    for (int column = 0; column < cells.width(); column++) {
      if (cells[{column, row}] == 0) continue;
      const CCMorse::ImagePoint_t corner = pixelOf({column, row});
      for (int y = 0; y < pixelsPerCell; y++) {
        for (int x = 0; x < pixelsPerCell; x++) drawing.SetCell(corner.x + x, corner.y + y, 1);
      }
    }
  }
}

void CRobot::drawGoal() const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(GOAL);
  drawing.Clear();
  const par::Cell cell = walls.frame().cell_of({goalX, goalY});
  if (!walls.contains(cell)) return;
  const CCMorse::ImagePoint_t middle = pixelOf(cell);
  for (int dy = -6; dy <= 6; dy++) {
    for (int dx = -6; dx <= 6; dx++) {
      // Distances in pixels of the canvas. The robot fits inside the ring.
      const double distance = std::hypot(dx, dy);
      if (distance < 1.5 || (distance > 5.0 && distance < 6.4)) {
        drawing.SetCell(middle.x + dx, middle.y + dy, 1);
      }
    }
  }
}

void CRobot::drawWay(const std::string& layer, const par::Path& way, int margin) const {
  CCMorse::GridMapLayer& drawing = window.GetLayer(layer);
  drawing.Clear();
  // offset to the middle of a cell that is drawn as a square of pixels
  const int half = pixelsPerCell / 2;
  for (std::size_t i = 1; i < way.cells.size(); i++) {
    const CCMorse::ImagePoint_t from = pixelOf(way.cells[i - 1]);
    const CCMorse::ImagePoint_t to = pixelOf(way.cells[i]);
    for (int dy = half - margin; dy <= half + margin; dy++) {
      for (int dx = half - margin; dx <= half + margin; dx++) {
        drawing.SetLine(from.x + dx, from.y + dy, to.x + dx, to.y + dy);
      }
    }
  }
}
