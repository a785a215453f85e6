// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The functions of apps/par_exploration_changing/template, implemented as the comments there
// describe. The others are those of par_exploration.cc, which come before these.

// function: void CCollector::forget(
void CCollector::forget(const Area& area) {
  if (logOdds.empty()) return;
  for (int row = 0; row < map.height; row++) {
    for (int column = 0; column < map.width; column++) {
      const double x = (column + 0.5) * map.cellSize;
      const double y = (map.height - 1 - row + 0.5) * map.cellSize;
      if (std::fabs(x - area.x) > 0.5 * area.width) continue;
      if (std::fabs(y - area.y) > 0.5 * area.height) continue;
      map.at({column, row}) = 0.5;
      logOdds[indexOf(map, {column, row})] = 0.0;
    }
  }
}

// function: void CRobot::lookAtEvents(
void CRobot::lookAtEvents() {
  for (const CCMorse::ArenaEvent& event : arena->GetEvents()) {
    INFO(event);
    if (event.kind != "extended" && event.kind != "retracted") continue;
    double x = 0.0;
    double y = 0.0;
    double yaw = 0.0;
    double size[2] = {0.0, 0.0};
    simulation->GetPose2d(event.what.c_str(), x, y, yaw);
    simulation->GetProperty(event.what.c_str(), "size", size, sizeof size);
    shared.forget(x, y, size[0] + 0.08, size[1] + 0.08);
    counts.clear();
  }
}

// function: bool CRobot::isFinished(
bool CRobot::isFinished(bool hasGoal) {
  turnsWithoutGoal = hasGoal ? 0 : turnsWithoutGoal + 1;
  for (const std::string& timer : arena->GetTimerNames()) {
    if (arena->IsTimerEnabled(timer)) turnsWithoutGoal = 0;
  }
  return turnsWithoutGoal >= 20;
}
