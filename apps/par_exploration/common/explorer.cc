// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "explorer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>

#include "guard.h"
#include "imr-h/imr_exceptions.h"
#include "imr-h/logging.h"
#include "par_common/distance.h"

namespace {

// The robot's circle has a radius of 0.098 m. Half the diagonal of a cell (0.014 m) covers
// obstacles that fill a cell beyond its centre. The rest allows for inexact driving.
const double RADIUS = 0.125;
// Where there is room, paths keep this distance from walls, because the robot is faster there [m].
const double COMFORT = 0.19;
// This close to the start and the goal, a path may have less clearance [m].
const double DETOUR = 0.20;

const std::size_t LEAST_CELLS = 4;  // smaller frontiers are ignored
const double PART = 40.0;  // longer frontiers are split into parts of about this extent [cells]
// A frontier must have at least this many unknown cells that are visible from its centre within
// PROMISE_RANGE. Otherwise it is a hole in the map of a wall.
const std::size_t PROMISE = 30;
const double PROMISE_RANGE = 0.3;  // [m]
const double VIEW = 0.6;           // the robot can observe a frontier from this far away [m]
// a frontier is in view if it is within this angle of the heading [rad]
const double IN_VIEW = 0.8;
const double LOOK = 0.5;   // and observed after it has been in view for this long [s]
const int MOST_TRIES = 5;  // how often a cell may be part of a target

const double PLAN_PERIOD = 0.5;  // [s]
// replan the path after this time, because more of the map is known [s]
const double WAY_PERIOD = 2.0;
const double SETTLE = 0.3;  // collect data for this long before the first plan [s]
const int SURE = 3;         // end after this many plans in a row without a target
const int SHUT_IN = 20;     // or after this many plans without a free cell near the robot

const double STUCK = 5.0;      // give the target up after this long without progress [s]
const double GOT_ON = 0.03;    // [m]
const double GOT_ROUND = 0.3;  // [rad]
const double SLOWEST = 0.05;   // expected minimum speed [m/s]
const double PATIENCE = 15.0;  // additional time allowed for each target [s]

const double TURN_GAIN = 3.0;  // [1/s]

const double LASER_X = 0.035;  // distance of the laser ahead of the robot's centre [m]
const double BEHIND = 0.30;    // behind the robot, use the map up to this distance [m]

par::FollowerParams followerParams() {
  par::FollowerParams params;
  params.max_speed_mps = 0.40;
  params.max_turn_radps = 2.5;
  params.lookahead_m = 0.12;
  params.goal_tolerance_m = 0.03;
  return params;
}

}  // namespace

imr::CConfig& CExplorer::getConfig(imr::CConfig& config) {
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  CCollector::getConfig(config);
  config.add<double>("time-limit", "the exploration ends after this many seconds; 0: no limit",
                     0.0);
  return config;
}

CExplorer::CExplorer(imr::CConfig& cfg)
    : dataClient(
          new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      layers(new CLayers(dataClient.get())),
      map(new CSharedMap(par::OccupancyGrid(layers->getFrame()))),
      collector(new CCollector(cfg, *dataClient, *map, *layers)),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), 0)),
      timeLimit(cfg.get<double>("time-limit")),
      follower(followerParams()),
      blocked(layers->getFrame()),
      tries(layers->getFrame()) {
  imr::assert_argument(timeLimit >= 0.0, "--time-limit must not be negative");
  // A client takes part in the lockstep from its first Read() on. Both clients read here, so the
  // result does not depend on which thread starts first.
  collector->waitForData();
  while (!position->IsFresh()) client->Read();
}

CExplorer::~CExplorer() {
  stop();
  join();
}

void CExplorer::stop() {
  const ScopedLock lk(mtx);
  quit = true;
}

bool CExplorer::isOver() {
  {
    const ScopedLock lk(mtx);
    if (quit) return true;
  }
  if (timeLimit <= 0.0 || now.time - startTime < timeLimit) return false;
  end(TIME_IS_OVER);
  return true;
}

void CExplorer::end(Outcome how) {
  const ScopedLock lk(mtx);
  if (outcome == RUNNING) outcome = how;
}

void CExplorer::threadBody() {
  collector->execute();
  try {
    explore();
  } catch (const CCMorse::MorseError& e) {
    // Read() also throws when the simulated run ends.
    INFO("The run is over: " << e.GetErrorStr());
    end(RUN_IS_OVER);
  } catch (const std::exception& e) {
    ERROR("Exploring: " << e.what());
    end(FAILED);
  }
  // The collector's thread may be waiting in Read(), which returns only when simulated time
  // advances. Time advances after this thread has left the lockstep, that is, after its client is
  // destroyed.
  map->close();
  collector->stop();
  position.reset();
  client.reset();
  collector->join();
  if (collector->hasFailed()) end(FAILED);
}

void CExplorer::explore() {
  position->SetMotorEnable(true);
  bool first = true;
  do {
    if (!first) client->Read();
    const double time = position->GetDataTime();
    if (!map->waitFor(time, now)) {
      end(collector->hasFailed() ? FAILED : RUN_IS_OVER);
      break;
    }
    if (first) {
      startTime = planTime = wayTime = stuckSince = now.time;
      last = stuckPose = now.robot;
      first = false;
    }
    driven += std::hypot(now.robot.x - last.x, now.robot.y - last.y);
    last = now.robot;

    const Outcome planned = mustPlan() ? plan() : RUNNING;
    if (planned != RUNNING) {
      end(planned);
      break;
    }
    const par::Velocity wanted = decideSpeeds();
    noteProgress(wanted);
    const par::Velocity safe = guard.check(wanted, lookAround());
    position->SetSpeed(safe.forward_mps, safe.turn_radps);
  } while (!isOver());
  position->SetSpeed(0.0, 0.0);
}

// --- Planning ------------------------------------------------------------------------------------

bool CExplorer::mustPlan() const {
  if (now.time - startTime < SETTLE) return false;
  return now.time - planTime > PLAN_PERIOD - 0.01 || target.cells.empty() ||
         target.lookedFor >= LOOK;
}

// Ensures that there is a target and a path to it. Returns RUNNING, or the reason why there is
// nothing left to do.
CExplorer::Outcome CExplorer::plan() {
  planTime = now.time;
  const bool mayEnd = lookAhead();
  known = map->copy().states();

  // The robot's centre must not enter inflated obstacles or unknown cells.
  const par::Mask occupied = par::cells_in_state(known, par::CellState::kOccupied);
  const par::Grid<double> distance = par::distance_to_blocked_m(occupied);
  par::Mask hidden(known.frame());  // cells that are not known to be free block the view
  par::Mask inflated(known.frame());
  for (std::size_t i = 0; i < inflated.values().size(); i++) {
    hidden.values()[i] = known.values()[i] != par::CellState::kFree;
    inflated.values()[i] = distance.values()[i] <= RADIUS && !hidden.values()[i];
    blocked.values()[i] = inflated.values()[i] || hidden.values()[i];
  }
  layers->drawInflated(inflated);

  // The frontier cells, without those that have been tried often enough.
  par::Mask frontier = par::frontier_cells(known);
  for (std::size_t i = 0; i < frontier.values().size(); i++) {
    if (tries.values()[i] > MOST_TRIES) frontier.values()[i] = 0;
  }
  keepOrDropTarget(frontier);

  std::vector<par::Frontier> frontiers;
  for (const par::Frontier& whole : par::cluster(frontier, LEAST_CELLS)) {
    for (par::Frontier& part : par::split(whole, PART)) {
      if (par::information_gain(known, part.centre, PROMISE_RANGE) < PROMISE) continue;
      frontiers.push_back(std::move(part));
    }
  }
  layers->drawFrontiers(frontiers);

  if (target.cells.empty()) {
    // Without a free start cell, the program cannot know whether there is anything left to explore.
    const auto start = par::nearest_free(blocked, robotCell(), DETOUR);
    if (!start) {
      layers->drawPath({});
      noStart++;
      return noStart < SHUT_IN ? RUNNING : NO_WAY_BEGINS;
    }
    noStart = 0;
    if (!chooseTarget(frontiers, hidden, *start)) {
      layers->drawPath({});
      nothingFound = mayEnd ? nothingFound + 1 : 0;
      return nothingFound < SURE ? RUNNING : EXPLORED;
    }
  }
  nothingFound = 0;

  if (!target.reached &&
      (way.empty() || now.time - wayTime > WAY_PERIOD - 0.01 || !par::is_free(blocked, way))) {
    if (!findWay(distance)) dropTarget();
  }
  layers->drawPath(way);
  return RUNNING;
}

// Drops the target when most of its frontier is gone, because the robot has seen what lay behind
// it. Gives it up if it is still there after a full observation, or when its deadline has passed.
void CExplorer::keepOrDropTarget(const par::Mask& frontier) {
  if (target.cells.empty()) return;
  std::size_t left = 0;
  for (const par::Cell& cell : target.cells) left += frontier[cell];
  if (2 * left < target.cells.size() || left < LEAST_CELLS) {
    dropTarget();
  } else if (target.lookedFor >= LOOK || now.time > target.deadline) {
    giveUp();
  }
}

void CExplorer::lookAgain(const Area& area) {
  map->forget(area);
  std::fill(tries.values().begin(), tries.values().end(), static_cast<std::uint8_t>(0));
}

// Excludes the target's cells and their neighbours from all later frontiers.
void CExplorer::giveUp() {
  for (const par::Cell& cell : target.cells) {
    for (int row = cell.row - 1; row <= cell.row + 1; row++) {
      for (int column = cell.column - 1; column <= cell.column + 1; column++) {
        const par::Cell close = {column, row};
        if (tries.contains(close)) tries[close] = MOST_TRIES + 1;
      }
    }
  }
  given++;
  dropTarget();
}

void CExplorer::dropTarget() {
  target = Target();
  way.clear();
}

bool CExplorer::chooseTarget(const std::vector<par::Frontier>& frontiers, const par::Mask& hidden,
                             const par::Cell& start) {
  const par::DistanceField ways(blocked, start);
  const std::vector<Candidate> candidates = findCandidates(frontiers, ways, hidden);
  if (candidates.empty()) return false;

  const Candidate& chosen = candidates.at(choose(candidates, known));
  target.cells = chosen.frontier->cells;
  target.centre = chosen.frontier->centre;
  target.place = chosen.place;
  target.deadline = now.time + PATIENCE + chosen.way / SLOWEST;
  for (const par::Cell& cell : target.cells) tries[cell]++;
  targets++;
  stuckSince = now.time;
  way.clear();
  return true;
}

// Finds for each frontier the place to observe it from: the nearest of its own cells that the robot
// can reach. If all of them are too close to a wall, it is the nearest place in sight of the
// frontier's centre. If there is no such place either, the frontier is a sliver that cannot be
// observed; it is ignored until the map changes.
std::vector<CExplorer::Candidate> CExplorer::findCandidates(
    const std::vector<par::Frontier>& frontiers, const par::DistanceField& ways,
    const par::Mask& hidden) const {
  std::vector<Candidate> result;
  for (const par::Frontier& frontier : frontiers) {
    Candidate best = {&frontier, frontier.centre, std::numeric_limits<double>::infinity()};
    const auto consider = [&](const par::Cell& cell) {
      const double length = ways.distance_m(cell);
      if (length >= best.way) return;
      best.place = cell;
      best.way = length;
    };
    for (const par::Cell& cell : frontier.cells) consider(cell);
    if (!std::isfinite(best.way)) {
      const int reach = static_cast<int>(VIEW / hidden.frame().cell_size_m);
      // Testing every other cell is enough.
      for (int row = -reach; row <= reach; row += 2) {
        for (int column = -reach; column <= reach; column += 2) {
          if (column * column + row * row > reach * reach) continue;
          const par::Cell cell = {frontier.centre.column + column, frontier.centre.row + row};
          if (hidden.contains(cell) && ways.distance_m(cell) < best.way &&
              par::line_of_sight(hidden, cell, frontier.centre)) {
            consider(cell);
          }
        }
      }
    }
    if (std::isfinite(best.way)) result.push_back(best);
  }
  return result;
}

// Finds a path to the target and straightens it. Prefers a path with comfortable clearance.
bool CExplorer::findWay(const par::Grid<double>& distance) {
  wayTime = now.time;
  way.clear();
  const auto start = par::nearest_free(blocked, robotCell(), DETOUR);
  if (!start) return false;
  par::Mask uncomfortable = blocked;
  const double detour = DETOUR / blocked.frame().cell_size_m;
  for (std::size_t i = 0; i < uncomfortable.values().size(); i++) {
    if (distance.values()[i] > COMFORT || uncomfortable.values()[i]) continue;
    const par::Cell cell = blocked.frame().cell_at(i);
    uncomfortable.values()[i] = par::distance_cells(cell, *start) > detour &&
                                par::distance_cells(cell, target.place) > detour;
  }
  par::Path path = par::a_star(uncomfortable, *start, target.place);
  if (path.found()) {
    path = par::smooth(uncomfortable, path);
  } else {
    path = par::smooth(blocked, par::a_star(blocked, *start, target.place));
  }
  if (!path.found()) return false;

  way = path.cells;
  std::vector<par::Point> points = par::to_points(blocked.frame(), way);
  points.insert(points.begin(), {now.robot.x, now.robot.y});
  follower.set_path(points);
  return true;
}

// --- Driving -------------------------------------------------------------------------------------

par::Velocity CExplorer::decideSpeeds() {
  if (target.cells.empty()) return {};
  if (!target.reached) {
    const par::Velocity velocity = follower.update(now.robot);
    target.reached = follower.done();
    if (!target.reached) return velocity;
  }
  // At the target: turn towards the frontier until the laser has observed it.
  const par::Point centre = blocked.frame().centre_of(target.centre);
  const double dx = centre.x - now.robot.x;
  const double dy = centre.y - now.robot.y;
  // If the target is directly below the robot, there is no direction to turn to.
  const double off =
      std::hypot(dx, dy) < 0.05 ? 0.0 : par::normalize_angle(std::atan2(dy, dx) - now.robot.yaw);
  if (std::fabs(off) < IN_VIEW) target.lookedFor += 0.1;
  return {0.0, TURN_GAIN * off};
}

// A robot that wants to move and does not is stuck: it gives its target up.
void CExplorer::noteProgress(const par::Velocity& wanted) {
  const bool rests = wanted.forward_mps == 0.0 && wanted.turn_radps == 0.0;
  if (rests || std::hypot(now.robot.x - stuckPose.x, now.robot.y - stuckPose.y) > GOT_ON ||
      std::fabs(par::normalize_angle(now.robot.yaw - stuckPose.yaw)) > GOT_ROUND) {
    stuckPose = now.robot;
    stuckSince = now.time;
  }
  if (now.time - stuckSince > STUCK && !target.cells.empty()) giveUp();
}

// The surroundings of the robot: the laser's echoes, and the map where the laser does not look.
Surroundings CExplorer::lookAround() const {
  Surroundings around;
  around.solid = now.echoes;
  if (known.width() == 0) return around;  // no plan yet
  const par::GridFrame& frame = known.frame();
  const par::Cell centre = robotCell();
  const int reach = static_cast<int>(BEHIND / frame.cell_size_m);
  const double c = std::cos(now.robot.yaw);
  const double s = std::sin(now.robot.yaw);
  for (int row = centre.row - reach; row <= centre.row + reach; row++) {
    for (int column = centre.column - reach; column <= centre.column + reach; column++) {
      const par::CellState state = known.value_or({column, row}, par::CellState::kOccupied);
      if (state == par::CellState::kFree) continue;
      const par::Point point = frame.centre_of({column, row});
      const double dx = point.x - now.robot.x;
      const double dy = point.y - now.robot.y;
      const par::Point seen = {c * dx + s * dy, -s * dx + c * dy};
      // The laser covers 135 degrees on both sides.
      if (seen.x > LASER_X - std::fabs(seen.y)) continue;
      if (state == par::CellState::kOccupied) {
        around.solid.push_back(seen);
      } else if (clearance({seen}) > 0.0) {  // nothing else can be where the robot stands
        around.unseen.push_back(seen);
      }
    }
  }
  return around;
}

par::Cell CExplorer::robotCell() const {
  return blocked.frame().cell_of({now.robot.x, now.robot.y});
}

// --- The end -------------------------------------------------------------------------------------

CExplorer::Outcome CExplorer::summary() const {
  const ScopedLock lk(mtx);
  const char* how = "The exploration was stopped";
  switch (outcome) {
    case EXPLORED:
      how = "Explored: no frontier is left that the robot can reach";
      break;
    case NO_WAY_BEGINS:
      how = "Not finished: the map has no free cell near the robot, so no way can begin there";
      break;
    case TIME_IS_OVER:
      how = "Not finished: the time limit is over";
      break;
    case RUN_IS_OVER:
      how = "Not finished: the run is over";
      break;
    case FAILED:
      how = "Failed";
      break;
    case RUNNING:
      break;
  }
  std::size_t free = 0;
  std::size_t occupied = 0;
  const par::Grid<par::CellState> states = map->copy().states();
  for (const par::CellState state : states.values()) {
    free += state == par::CellState::kFree;
    occupied += state == par::CellState::kOccupied;
  }
  const double area = states.frame().cell_size_m * states.frame().cell_size_m;
  std::printf(
      "%s.\n  time      %.1f s simulated\n  way       %.2f m\n  targets   %d, %d of them given up\n"
      "  map       %.2f m2 free, %.2f m2 occupied\n",
      how, now.time - startTime, driven, targets, given, area * static_cast<double>(free),
      area * static_cast<double>(occupied));
  return outcome;
}
