// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/testing/run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <utility>

#include "playerlike/connect/named_hosts.h"
#include "playerlike/process/log.h"
#include "sim/core/error.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "testing/clearance.h"
#include "testing/run_content.h"
#include "testing/world_content.h"

namespace playpen::testing {
namespace {

using playerlike::DeviceId;
using playerlike::RobotInfo;

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all.empty() ? "none" : all;
}

std::vector<std::string> names_of(const sim::WorldDescription& world) {
  std::vector<std::string> names;
  for (const auto& robot : world.robots) names.push_back(robot.name);
  return names;
}

[[noreturn]] void throw_unknown(const std::string& what, const std::string& name,
                                const std::vector<std::string>& known) {
  const std::string near = sim::nearest_word(name, known);
  throw Error("there is no " + what + " \"" + name + "\", only " + listed(known) +
              (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
}

Pose pose_of(const sim::Pose& pose) { return {pose.x_m, pose.y_m, pose.yaw_rad}; }

std::shared_ptr<playerlike::Host> make_host(const Moment::Content& start) {
  playerlike::RunSettings settings;
  settings.start = start.state;
  settings.time_mode = sim::TimeMode::kLockstep;
  settings.clients = 1;  // one thread could not open a gate of several clients
  try {
    return playerlike::Host::create(start.world, std::move(settings),
                                    playerlike::log_to_stderr(sim::LogLevel::kWarning));
  } catch (const std::runtime_error& e) {
    throw Error(e.what());
  }
}

Moment::Content beginning(sim::WorldDescription world, const std::vector<GoalRequest>& requests) {
  Moment::Content start;
  start.world = std::move(world);
  const std::vector<std::string> names = names_of(start.world);
  for (const GoalRequest& request : requests) {
    const auto found = std::find(names.begin(), names.end(), request.robot);
    if (found == names.end()) throw_unknown("robot", request.robot, names);
    start.goals.push_back(
        {static_cast<int>(found - names.begin()), request.point, request.tolerance_m, false});
  }
  return start;
}

std::optional<std::vector<double>> ranges_of(const sim::Reading& reading) {
  if (const auto* laser = dynamic_cast<const sim::LaserReading*>(&reading)) return laser->ranges_m;
  if (const auto* ranger = dynamic_cast<const sim::RangerReading*>(&reading)) {
    return ranger->ranges_m;
  }
  return std::nullopt;
}

}  // namespace

// --- The content

TestRun::Content::Content(const Moment::Content& start)
    : world(start.world), host(make_host(start)), name(playerlike::name_host(host)) {
  host->change_simulation([&](const sim::Simulation& simulation) {
    record = std::make_shared<Record>(simulation, start.goals);
  });
  host->watch_steps(
      [kept = record](const sim::Simulation& simulation) { kept->observe(simulation); });
}

TestRun::Content::~Content() {
  host->watch_steps({});
  playerlike::forget_host(name);
  if (is_localhost) static_cast<void>(playerlike::name_host_localhost(nullptr));
  host->finish();
}

int TestRun::Content::robot(const std::string& wanted) const {
  const std::vector<std::string> names = names_of(world);
  if (wanted.empty()) {
    if (names.size() == 1) return 0;
    throw Error("the world has " + std::to_string(names.size()) +
                " robots, so name the robot: " + listed(names));
  }
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end()) throw_unknown("robot", wanted, names);
  return static_cast<int>(found - names.begin());
}

std::vector<int> TestRun::Content::robots(const std::string& wanted) const {
  if (!wanted.empty()) return {robot(wanted)};
  std::vector<int> all;
  for (std::size_t i = 0; i < world.robots.size(); ++i) all.push_back(static_cast<int>(i));
  return all;
}

DeviceId TestRun::Content::device(const std::string& path) const {
  const std::size_t dot = path.find('.');
  const int index = robot(dot == std::string::npos ? "" : path.substr(0, dot));
  const std::string wanted = dot == std::string::npos ? path : path.substr(dot + 1);
  const RobotInfo& info = host->robots()[static_cast<std::size_t>(index)];
  std::vector<std::string> known;
  for (const playerlike::DeviceInfo& one : info.devices) {
    if (one.name == wanted) return one.id;
    known.push_back(one.name);
  }
  throw_unknown("device of " + info.name, wanted, known);
}

void TestRun::Content::change(
    const std::string& what,
    const std::function<std::optional<std::string>(sim::Simulation&)>& act) {
  std::optional<std::string> refusal;
  host->change_simulation([&](sim::Simulation& simulation) { refusal = act(simulation); });
  if (refusal) throw Error(what + ": " + *refusal);
}

// --- Construction

double Moment::time_s() const { return content_->time_s; }

TestRun::TestRun(const World& world)
    : content_(std::make_unique<Content>(
          beginning(world.content_->description(), world.content_->goals))) {}
TestRun::TestRun(const Moment& moment) : content_(std::make_unique<Content>(*moment.content_)) {}
TestRun::TestRun(TestRun&& other) noexcept = default;
TestRun& TestRun::operator=(TestRun&& other) noexcept = default;
TestRun::~TestRun() = default;

const std::string& TestRun::host() const noexcept { return content_->name; }

TestRun& TestRun::AsLocalhost() {
  bool done = false;
  try {
    done = playerlike::name_host_localhost(content_->host);
  } catch (const playerlike::SessionError& e) {
    throw Error(std::string("TestRun::AsLocalhost: ") + e.what());
  }
  if (!done) throw Error("TestRun::AsLocalhost: another run is localhost; it must end first");
  content_->is_localhost = true;
  return *this;
}

void TestRun::Advance(double seconds) {
  if (!(seconds >= 0.0 && seconds <= 1e9)) {
    throw Error("TestRun::Advance: expected seconds from 0 to 1e9, found " +
                sim::shortest_text(seconds));
  }
  if (finished()) {
    throw Error("TestRun::Advance: the run is over since " + sim::shortest_text(time_s()) +
                " s; World::Duration sets its end");
  }
  const auto session = content_->host->connect(playerlike::kMorsePort);
  session->request(playerlike::SleepRequest{seconds});
}

// --- The present

double TestRun::time_s() const { return sim::to_seconds(content_->host->now_ns()); }
bool TestRun::finished() const { return content_->host->finished(); }
std::vector<std::string> TestRun::robots() const { return names_of(content_->world); }
const std::string& TestRun::world_name() const { return content_->world.name; }

Pose TestRun::pose(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation& simulation, const Record&) {
    return pose_of(simulation.body(index).X_WB);
  });
}

double TestRun::speed_mps(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation& simulation, const Record&) {
    const sim::Twist& twist = simulation.body(index).twist;
    return sim::math::hypot(twist.v_mps, twist.lateral_mps);
  });
}

double TestRun::turn_rate_radps(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation& simulation, const Record&) {
    return simulation.body(index).twist.omega_radps;
  });
}

double TestRun::clearance_m(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation& simulation, const Record&) {
    return nearest_solid(simulation, index).distance_m;
  });
}

bool TestRun::stalled(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation& simulation, const Record&) {
    return simulation.body(index).stalled;
  });
}

Pose TestRun::object(const std::string& name) const {
  std::string unknown;
  const Pose pose = content_->look([&](const sim::Simulation& simulation, const Record&) {
    const auto found = simulation.find_object(name);
    if (!found) unknown = simulation.no_such_object(name);
    return found ? pose_of(found->pose) : Pose();
  });
  if (!unknown.empty()) throw Error("TestRun::object: " + unknown);
  return pose;
}

std::vector<double> TestRun::ranges_m(const std::string& device) const {
  const DeviceId id = content_->device(device);
  auto ranges = content_->look([&](const sim::Simulation& simulation, const Record&) {
    const sim::Sensor* const sensor = simulation.device(id.robot, id.device).sensor();
    if (sensor == nullptr) return std::optional<std::vector<double>>();
    auto newest = ranges_of(sensor->reading());
    if (newest && sensor->reading().sequence == 0) newest->clear();
    return newest;
  });
  if (!ranges) throw Error("TestRun::ranges_m: " + device + " measures no ranges");
  return *std::move(ranges);
}

Cell TestRun::cell(const std::string& layer, const Point& place) const {
  std::string problem;
  Cell cell;
  content_->host->change_simulation([&](sim::Simulation& simulation) {
    const sim::LayerStack& layers = simulation.layers();
    std::optional<sim::LayerInfo> found;
    std::vector<std::string> known;
    for (const sim::LayerInfo& info : layers.layers()) {
      if (info.style.name == layer) found = info;
      known.push_back(info.style.name);
    }
    const sim::Canvas& canvas = layers.base();
    const int column = canvas.column(place.x_m);
    const int row = canvas.row(place.y_m);
    if (!found) {
      problem = "there is no layer \"" + layer + "\", only " + listed(known);
    } else if (!canvas.contains(column, row)) {
      problem = "x " + sim::shortest_text(place.x_m) + ", y " + sim::shortest_text(place.y_m) +
                " is outside the grid-map";
    } else {
      const sim::CellValue value = layers.cell(found->id, column, row).value_or(sim::CellValue());
      sim::Colour colour = value.colour();
      if (found->kind == sim::LayerKind::kBinary) {
        colour = value.set() ? found->style.colour : sim::Colour{0, 0, 0, 0};
      } else if (found->kind == sim::LayerKind::kGrey) {
        cell.occupancy = static_cast<double>(value.occupancy());
        const auto grey = static_cast<std::uint8_t>(
            std::lround(255.0 * (1.0 - std::clamp(cell.occupancy, 0.0, 1.0))));
        colour = {grey, grey, grey, 255};
      }
      cell.red = colour.r;
      cell.green = colour.g;
      cell.blue = colour.b;
      cell.alpha = colour.a;
    }
  });
  if (!problem.empty()) throw Error("TestRun::cell: " + problem);
  return cell;
}

std::uint64_t TestRun::state_hash() const { return content_->host->state_hash(); }

// --- The record

std::vector<Sample> TestRun::path(const std::string& robot) const {
  const auto index = static_cast<std::size_t>(content_->robot(robot));
  return content_->look(
      [&](const sim::Simulation&, const Record& record) { return record.paths[index]; });
}

double TestRun::path_length_m(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation& simulation, const Record& record) {
    return simulation.statistics(index).path_length_m -
           record.path_lengths_m[static_cast<std::size_t>(index)];
  });
}

double TestRun::least_clearance_m(const std::string& robot) const {
  const auto index = static_cast<std::size_t>(content_->robot(robot));
  return content_->look([&](const sim::Simulation&, const Record& record) {
    const auto& path = record.paths[index];
    return std::min_element(
               path.begin(), path.end(),
               [](const Sample& a, const Sample& b) { return a.clearance_m < b.clearance_m; })
        ->clearance_m;
  });
}

std::vector<Collision> TestRun::collisions(const std::string& robot) const {
  if (!robot.empty()) static_cast<void>(content_->robot(robot));  // must exist
  std::vector<Collision> all = content_->look(
      [](const sim::Simulation&, const Record& record) { return record.collisions; });
  if (!robot.empty()) {
    std::erase_if(all, [&](const Collision& one) { return one.robot != robot; });
  }
  return all;
}

std::string TestRun::solid_name(int solid) const {
  return content_->look([&](const sim::Simulation& simulation, const Record&) {
    return testing::solid_name(simulation, solid);
  });
}

std::vector<bool> TestRun::goals_reached(const std::string& robot) const {
  const int index = content_->robot(robot);
  return content_->look([&](const sim::Simulation&, const Record& record) {
    std::vector<bool> reached;
    for (const GoalState& goal : record.goals) {
      if (goal.robot == index) reached.push_back(goal.reached);
    }
    return reached;
  });
}

// --- Faults and changes

void TestRun::Kill(const std::string& device) {
  const DeviceId id = content_->device(device);
  content_->host->change_simulation([&](sim::Simulation& all) { all.set_active(id, false); });
}

void TestRun::Revive(const std::string& device) {
  const DeviceId id = content_->device(device);
  content_->host->change_simulation([&](sim::Simulation& all) { all.set_active(id, true); });
}

void TestRun::MoveTo(const std::string& object, const Pose& pose) {
  content_->change("TestRun::MoveTo " + object, [&](sim::Simulation& simulation) {
    return simulation.place_object(object, {pose.x_m, pose.y_m, pose.yaw_rad});
  });
}

void TestRun::Push(const std::string& object, const Point& by) {
  content_->change("TestRun::Push " + object, [&](sim::Simulation& simulation) {
    const auto found = simulation.find_object(object);
    if (!found) return std::optional<std::string>(simulation.no_such_object(object));
    sim::Pose pose = found->pose;
    pose.x_m += by.x_m;
    pose.y_m += by.y_m;
    return simulation.place_object(object, pose);
  });
}

void TestRun::Extend(const std::string& block) {
  content_->change("TestRun::Extend " + block, [&](sim::Simulation& simulation) {
    return simulation.set_obstacle_state(block, sim::ObstacleState::kExtended);
  });
}

void TestRun::Retract(const std::string& block) {
  content_->change("TestRun::Retract " + block, [&](sim::Simulation& simulation) {
    return simulation.set_obstacle_state(block, sim::ObstacleState::kRetracted);
  });
}

// --- Futures

Moment TestRun::Save() const {
  auto saved = std::make_shared<Moment::Content>();
  saved->world = content_->world;
  saved->state = std::make_shared<const playerlike::HostState>(content_->host->save());
  saved->goals =
      content_->look([](const sim::Simulation&, const Record& record) { return record.goals; });
  saved->time_s = time_s();
  return Moment(std::move(saved));
}

TestRun TestRun::Fork() const { return TestRun(Save()); }

void PrintTo(const TestRun& run, std::ostream* out) {
  *out << "run of " << run.world_name() << " at " << sim::shortest_text(run.time_s()) << " s";
}

void PrintTo(const RobotOf& robot, std::ostream* out) {
  *out << robot.robot << " in a ";
  PrintTo(*robot.run, out);
}

}  // namespace playpen::testing
