// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <cstddef>
#include <cstdint>

#include "imr-h/logging.h"
#include "par_common/distance.h"

namespace {

const double RADIUS = 0.13;  // radius by which obstacles are inflated [m]
// The robot may stand this far inside an inflated obstacle; its path then starts at the nearest
// free cell [m].
const double REACH = 0.3;
// A robot that has moved farther since the last reading did not drive there [m].
const double JUMP = 0.2;

const char* const MAP = "map";
const char* const INFLATED = "inflated";
const char* const TRAPS = "traps";
const char* const PATH = "path";
const char* const GOAL = "goal";

}  // namespace

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  config.add<double>("goal-x", "where to go [m]", 3.15);
  config.add<double>("goal-y", "where to go [m]", 3.1);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : goal({cfg.get<double>("goal-x"), cfg.get<double>("goal-y")}),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))),
      arena(new CCMorse::ArenaProxy(client.get())),
      window(CCMorse::WindowProxy::GetInstance(client.get(), 172, 186)) {
  using CCMorse::GridMapLayer;
  // Layers with a higher priority lie above those with a lower one.
  window.CreateLayer(INFLATED, GridMapLayer::BINARY, 1).SetColour("#a9d4f5");
  window.CreateLayer(TRAPS, GridMapLayer::BINARY, 2).SetColour("#e06060");
  window.GetLayer(TRAPS).SetTransparency(0.4);
  window.CreateLayer(MAP, GridMapLayer::BINARY, 3).SetColour("#202020");
  window.CreateLayer(PATH, GridMapLayer::BINARY, 4).SetColour("#ff8800");
  window.CreateLayer(GOAL, GridMapLayer::BINARY, 5).SetColour("#d6006c");
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
    navigation();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
  }
  try {
    // The arena can still be read after the end.
    if (!arena->HasVerdict()) return;
    const CCMorse::ArenaVerdict verdict = arena->GetVerdict();
    success = verdict.passed;
    INFO((success ? "Passed: " : "Failed: ") << verdict.reason << " after " << verdict.time
                                             << " s; places of traps: " << traps.places().size());
  } catch (const CCMorse::MorseError& e) {
    ERROR("No verdict: " << e.GetErrorStr());
  }
}

void CRobot::navigation() {
  position->SetMotorEnable(true);
  drawGoal();
  fetchMap();
  last = place();
  bool mustPlan = true;
  bool q = false;
  while (!q) {
    if (mustPlan && !plan()) INFO("There is no way to the goal at present");
    const par::Velocity velocity =
        follower.update({position->GetXPos(), position->GetYPos(), position->GetYaw()});
    position->SetSpeed(velocity.forward_mps, velocity.turn_radps);

    last = place();
    client->Read();
    position->NotFresh();
    mustPlan = lookAtEvents();
    // With latency, the pose of a robot that was put back comes later than the event.
    if (par::distance_m(place(), last) > JUMP) mustPlan = true;

    ScopedLock lk(mtx);
    q = quit;
  }
  position->SetSpeed(0.0, 0.0);
}

// Learns from the events since the last call. Returns whether they require a new plan.
bool CRobot::lookAtEvents() {
  bool isNew = false;
  bool mapChanged = false;
  for (const CCMorse::ArenaEvent& event : arena->GetEvents()) {
    if (event.kind == "trap") {
      // The robot may already be somewhere else, so the last place before the event counts.
      traps.add(event.what, last);
      isNew = true;
    } else if (event.kind == "score") {
      traps.setLoss(event.what, -event.value);
    } else if (event.kind == "restart") {
      traps.setPutBack();
    } else if (event.kind == "rising" || event.kind == "extended" || event.kind == "retracted") {
      mapChanged = true;
    }
  }
  if (mapChanged) fetchMap();
  return isNew || mapChanged;
}

void CRobot::fetchMap() {
  CCMorse::MapProxy map(client.get(), 0);
  map.RequestMap();
  par::GridFrame frame;
  frame.width = static_cast<int>(map.GetWidth());
  frame.height = static_cast<int>(map.GetHeight());
  frame.cell_size_m = map.GetResolution();
  frame.origin = {map.GetOriginX(), map.GetOriginY()};
  par::Mask walls(frame);
  for (int row = 0; row < frame.height; row++) {
    for (int column = 0; column < frame.width; column++) {
      // Player counts rows from the bottom.
      walls[{column, row}] = map.GetCell(column, frame.height - 1 - row) < 0 ? 0 : 1;
    }
  }
  inflated = par::inflate(walls, RADIUS);
  drawCells(MAP, walls);
  drawCells(INFLATED, inflated);
}

// Finds the cheapest path to the goal and gives it to the follower. Returns false if there is none.
bool CRobot::plan() {
  const par::GridFrame& frame = inflated.frame();
  const par::Grid<double> costs = traps.costs(frame);
  par::Mask known(frame);
  for (std::size_t i = 0; i < known.values().size(); i++) {
    known.values()[i] = costs.values()[i] > 0.0;
  }
  drawCells(TRAPS, known);

  std::vector<par::Cell> path;
  const auto from = par::nearest_free(inflated, frame.cell_of(place()), REACH);
  const auto to = par::nearest_free(inflated, frame.cell_of(goal), REACH);
  if (from && to) path = straighten(inflated, costs, cheapestPath(inflated, costs, *from, *to));
  drawPath(path);
  follower.set_path(par::to_points(frame, path));
  return !path.empty();
}

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

void CRobot::drawGoal() const {
  // A dot and a ring of 0.12 m round it. The robot fits inside the ring.
  CCMorse::GridMapLayer& drawing = window.GetLayer(GOAL);
  const CCMorse::ImagePoint_t middle = window.GetPoint(goal.x, goal.y);
  for (int dy = -6; dy <= 6; dy++) {
    for (int dx = -6; dx <= 6; dx++) {
      const int square = dx * dx + dy * dy;
      if (square < 3 || (square > 25 && square < 41)) {
        drawing.SetCell(middle.x + dx, middle.y + dy, 1);
      }
    }
  }
}
