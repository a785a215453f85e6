// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "robot.h"

#include <string>

#include "imr-h/logging.h"

// The functions that are yours to fill are at the end of this file, in the order in which you need
// them. As it is, the robot knows nothing of the arena, learns nothing, and stands still.

namespace {

const double RADIUS = 0.125;    // of the robot, with some room for driving inexactly [m]
const double SAME_TIME = 1e-3;  // times that differ by less are the same moment [s]

// The window, with the layers of the task. They lie over one another as sheets of glass do, the
// ones with higher priorities on top. A grey layer shows numbers: 0 white, 1 black. In a binary
// layer a cell is set, and then drawn in the layer's colour, or not.
CCMorse::WindowProxy& makeWindow(CCMorse::PlayerClient* client) {
  using CCMorse::GridMapLayer;
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(client, 172, 186);
  window.CreateLayer("occupancy", GridMapLayer::GREY, 1);
  window.CreateLayer("inflated", GridMapLayer::BINARY, 2).SetColour("#2F6FDE");
  window.GetLayer("inflated").SetTransparency(0.55);
  window.CreateLayer("frontiers", GridMapLayer::BINARY, 3).SetColour("#9B30C8");
  window.CreateLayer("scan", GridMapLayer::BINARY, 4).SetColour("#18B818");
  window.CreateLayer("trail", GridMapLayer::BINARY, 5).SetColour("#E02020");
  window.CreateLayer("path", GridMapLayer::BINARY, 6).SetColour("#FF8C00");
  return window;
}

Map unknownMap(const CCMorse::WindowProxy& window) {
  Map map;
  map.width = window.GetWidth();
  map.height = window.GetHeight();
  map.cellSize = window.GetCellSize();
  map.occupied.assign(static_cast<std::size_t>(map.width * map.height), 0.5);
  return map;
}

}  // namespace

// --- What the threads share ----------------------------------------------------------------------

void CSharedMap::publish(const Map& newMap, const imr::robot::SPosition& newPose, double newTime) {
  {
    const imr::concurrent::ScopedLock lk(mtx);
    map = newMap;
    pose = newPose;
    time = newTime;
  }
  changed.notify_all();
}

bool CSharedMap::waitFor(double wantedTime, Map& theMap, imr::robot::SPosition& thePose) {
  imr::concurrent::ScopedLock lk(mtx);
  changed.wait(lk, [&] { return closed || time > wantedTime - SAME_TIME; });
  theMap = map;
  thePose = pose;
  return !closed;
}

void CSharedMap::close() {
  {
    const imr::concurrent::ScopedLock lk(mtx);
    closed = true;
  }
  changed.notify_all();
}

// --- The thread that collects data ---------------------------------------------------------------

CCollector::CCollector(imr::CConfig& cfg, CCMorse::PlayerClient& aClient, CSharedMap& aMap)
    : client(aClient),
      shared(aMap),
      window(CCMorse::WindowProxy::GetInstance()),
      laser(&client, cfg.get<unsigned>("laser-index")),
      position(&client, cfg.get<unsigned>("position2d-index")),
      map(unknownMap(window)) {}

CCollector::~CCollector() {
  stop();
  join();
}

void CCollector::waitForData() {
  while (!laser.IsFresh() || !position.IsFresh()) client.Read();
}

void CCollector::stop() {
  const ScopedLock lk(mtx);
  quit = true;
}

void CCollector::threadBody() {
  try {
    collect();
  } catch (const CCMorse::MorseError& e) {
    // Also the way in which a simulated run ends: when its time is over, Read() throws.
    INFO("The run is over: " << e.GetErrorStr());
  }
  shared.close();
}

void CCollector::collect() {
  while (true) {
    if (position.IsFresh()) {
      position.NotFresh();
      pose = imr::robot::SPosition(position.GetXPos(), position.GetYPos(), position.GetYaw());
      drawTrail();
    }
    if (laser.IsFresh()) {
      laser.NotFresh();
      addScan();
      drawScan();
      drawMap();
    }
    shared.publish(map, pose, position.GetDataTime());

    // Simulated time goes on when ALL threads that read wait in Read(). The other thread waits for
    // the map that was just published before it reads again: neither can run ahead, and equal runs
    // give equal results.
    client.Read();
    const ScopedLock lk(mtx);
    if (quit) break;
  }
}

// --- The thread that plans and drives ------------------------------------------------------------

imr::CConfig& CRobot::getConfig(imr::CConfig& config) {
  // Ports 6665, 6666, ... are one robot each. Index 0 of position2d is the arena's localisation,
  // which is exact; index 1 the odometry, which drifts.
  config.add<std::string>("host", "where the robot is", "localhost");
  config.add<unsigned>("port", "its port", 6665);
  config.add<unsigned>("laser-index", "number of the laser", 0);
  config.add<unsigned>("position2d-index", "number of the drive", 0);
  return config;
}

CRobot::CRobot(imr::CConfig& cfg)
    : dataClient(
          new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      window(makeWindow(dataClient.get())),
      shared(unknownMap(window)),
      collector(cfg, *dataClient, shared),
      client(new CCMorse::PlayerClient(cfg.get<std::string>("host"), cfg.get<unsigned>("port"))),
      position(new CCMorse::Position2dProxy(client.get(), cfg.get<unsigned>("position2d-index"))) {
  // A client takes part in the run from its first Read() on. When both have read, neither thread
  // can miss what the other one sees, whichever of them starts first.
  collector.waitForData();
  while (!position->IsFresh()) client->Read();
}

CRobot::~CRobot() {
  stop();
  join();
  delete &window;
}

void CRobot::stop() {
  const ScopedLock lk(mtx);
  quit = true;
}

void CRobot::threadBody() {
  collector.execute();
  try {
    explore();
  } catch (const CCMorse::MorseError& e) {
    INFO("The run is over: " << e.GetErrorStr());
  }
  // The other thread may be in Read(), where it waits for time to go on. It goes on when this
  // thread no longer takes part: when its client is gone.
  shared.close();
  collector.stop();
  position.reset();
  client.reset();
  collector.join();
}

void CRobot::explore() {
  position->SetMotorEnable(true);
  Map map;
  bool q = false;
  while (!q && shared.waitFor(position->GetDataTime(), map, pose)) {
    const Map inflated = inflate(map, RADIUS);
    const std::vector<Cell> frontiers = findFrontiers(map);
    if (isFinished(frontiers)) break;

    Cell goal = cellOf(pose.x, pose.y);
    std::vector<Cell> path;
    if (chooseGoal(inflated, frontiers, goal)) {
      path = plan(inflated, cellOf(pose.x, pose.y), goal);
    }
    draw(inflated, frontiers, path);

    decideSpeeds(path);
    position->SetSpeed(forwardSpeed, turnRate);
    client->Read();
    const ScopedLock lk(mtx);
    q = quit;
  }
  // A command holds until the next one: a robot that nobody stops goes on for ever.
  position->SetSpeed(0.0, 0.0);
}

Cell CRobot::cellOf(double x, double y) const { return {window.GetX(x), window.GetY(y)}; }

// --- Yours: the map ------------------------------------------------------------------------------

void CCollector::addScan() {
  // Beam i was measured in the direction pose.yaw + laser.GetBearing(i), from the LASER, which is
  // 0.035 m ahead of the robot's centre. It ended after laser[i] metres at something, unless that
  // is GetMaxRange(): then it met nothing.
  //
  // Try first: make the cell where each beam ends 1, and see whether drawMap() shows walls. Next:
  // every cell the beam passed is free: Bresenham's line. Then: a scan may err (5 mm of noise
  // here), so do not set cells, but let each scan make them a little more likely free or occupied.
  // Look up "occupancy grid" and "log odds".
}

void CCollector::drawMap() {
  // The whole map at once: window.GetLayer("occupancy").SetCells(map.occupied). Is it needed ten
  // times a second?
}

void CCollector::drawScan() {
  // window.GetLayer("scan"): Clear() it, then SetPixelMetres(x, y) for the end of each beam.
}

void CCollector::drawTrail() {
  // window.GetLayer("trail").SetLineMetres(x0, y0, x1, y1), from the pose before to this one.
}

// --- Yours: where to go --------------------------------------------------------------------------

Map CRobot::inflate(const Map& map, double radius) const {
  // Where may the robot's CENTRE be? Nowhere nearer than its radius to what is occupied. If
  // obstacles are grown by that radius, the robot may be planned for as if it were a point. What is
  // unknown is not grown: nobody knows that anything is there.
  static_cast<void>(radius);
  return map;
}

std::vector<Cell> CRobot::findFrontiers(const Map& map) const {
  // A frontier is where the known ends: a free cell that has an unknown neighbour.
  //
  // Try first: all such cells, as a list; draw() shows whether they lie where you expect them.
  // Next: group those that touch one another. What do you do with groups of two or three cells?
  static_cast<void>(map);
  return std::vector<Cell>();
}

bool CRobot::chooseGoal(const Map& map, const std::vector<Cell>& frontiers, Cell& goal) const {
  // Where to go next; false if there is nowhere to go.
  //
  // Try first: the frontier that is nearest as the crow flies. Next: the one that is nearest to
  // drive to; one run of Dijkstra's algorithm tells the way to all of them. What if a frontier
  // cannot be reached, or is still there when the robot has been there?
  static_cast<void>(map);
  static_cast<void>(frontiers);
  static_cast<void>(goal);
  return false;
}

std::vector<Cell> CRobot::plan(const Map& map, const Cell& from, const Cell& to) const {
  // The cells from `from` to `to`, each a neighbour of the one before; empty if there is no way.
  // You have done this in the planning task. May the way lead through unknown cells?
  static_cast<void>(map);
  static_cast<void>(from);
  static_cast<void>(to);
  return std::vector<Cell>();
}

void CRobot::decideSpeeds(const std::vector<Cell>& path) {
  // Sets forwardSpeed [m/s] and turnRate [rad/s], so that the robot follows the path. The S1R
  // drives at most 0.5 m/s and turns at most 3 rad/s.
  //
  // Try first: turn towards a point a little ahead on the path; drive when it is straight ahead.
  // Then: what if the map was wrong, or is not as new as the last scan? Look at the scan before
  // each command: a robot that touches something has failed.
  static_cast<void>(path);
}

bool CRobot::isFinished(const std::vector<Cell>& frontiers) const {
  // When is the arena explored? The frame ends the program if this is true.
  static_cast<void>(frontiers);
  return false;
}

void CRobot::draw(const Map& inflated, const std::vector<Cell>& frontiers,
                  const std::vector<Cell>& path) {
  // Into window.GetLayer("inflated"), ("frontiers") and ("path"): Clear(), then SetPixel(column,
  // row) for each cell, or SetCells() for all of them at once.
  static_cast<void>(inflated);
  static_cast<void>(frontiers);
  static_cast<void>(path);
}
