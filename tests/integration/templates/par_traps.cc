// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_traps/template, implemented as the comments there describe.

// insert into robot.h before:   bool quit = false;
std::vector<imr::robot::SPosition> traps;  // where the robot has been put back

// function: bool CRobot::lookAtEvents(
bool CRobot::lookAtEvents() {
  bool mustPlan = false;
  for (const CCMorse::ArenaEvent& event : arena->GetEvents()) {
    INFO(event);
    if (event.kind == "restart") traps.push_back(lastPose);
    mustPlan |= event.kind == "restart" || event.kind == "rising" || event.kind == "retracted";
  }
  return mustPlan;
}

// function: void CRobot::addTraps(
void CRobot::addTraps(Map& map) const {
  for (const imr::robot::SPosition& trap : traps) {
    for (int row = 0; row < map.height; row++) {
      for (int column = 0; column < map.width; column++) {
        const Cell cell = {column, row};
        if (std::hypot(xOf(cell) - trap.x, yOf(cell) - trap.y) > 0.2) continue;
        map.occupied[static_cast<std::size_t>(row * map.width + column)] = true;
      }
    }
  }
}
