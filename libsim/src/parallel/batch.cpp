// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/parallel/batch.h"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "parallel/rows.h"
#include "parallel/worker_pool.h"
#include "sim/core/assert.h"
#include "sim/core/error.h"
#include "sim/devices/pen.h"

namespace sim {
namespace {

using parallel::ObservationRows;
using parallel::Rows;

constexpr int kMostSimulations = 1'000'000;
constexpr int kMostThreads = 1024;
constexpr int kMostSteps = 1'000'000;
constexpr int kMostBeams = 8192;

// A robot of the arrays.
struct BatchRobot {
  int index;                            // in the world
  int motion;                           // index of its motion device
  std::optional<int> laser = {};        // index of its first laser
  scan::ScanGeometry geometry = {};     // of its scans
  std::vector<int> quiet_devices = {};  // that are switched off
};

[[noreturn]] void fail(const std::string& what) { throw BatchError(what); }

void check_range(const char* name, int value, int least, int greatest) {
  if (value >= least && value <= greatest) return;
  fail(std::string(name) + ": expected a number from " + std::to_string(least) + " to " +
       std::to_string(greatest) + ", found " + std::to_string(value));
}

void check_count(const char* name, std::size_t found, int expected) {
  if (found == 0 || found == static_cast<std::size_t>(expected)) return;
  fail(std::string(name) + ": expected one for each of " + std::to_string(expected) +
       " simulations, found " + std::to_string(found));
}

// The first motion device moves the robot.
std::optional<int> find_motion(const Simulation& simulation, int robot) {
  for (int k = 0; k < simulation.device_count(robot); ++k) {
    if (simulation.device(robot, k).type() == "motion") return k;
  }
  return std::nullopt;
}

// Sensors that also do something.
bool acts_on_world(const Device& device) {
  constexpr std::array kTypes = {"actarray", "destination", "gripper", "hand",    "orientation",
                                 "patrol",   "ptz",         "speech",  "waypoint"};
  return std::ranges::find(kTypes, device.type()) != kTypes.end();
}

// The devices of a robot that can be switched off and the robot moves as before.
std::vector<int> quiet_devices_of(const Simulation& simulation, int robot) {
  std::vector<int> quiet;
  for (int k = 0; k < simulation.device_count(robot); ++k) {
    const Device& device = simulation.device(robot, k);
    // It drives by the readings of the robot's laser.
    if (device.type() == "wander") return {};
    const bool is_sensor = device.sensor() != nullptr && !acts_on_world(device);
    if (is_sensor || dynamic_cast<const Pen*>(&device) != nullptr) quiet.push_back(k);
  }
  return quiet;
}

// The beams of a laser, or so many over its field of view.
scan::ScanGeometry geometry_of(const Laser& laser, int beams) {
  scan::ScanGeometry geometry = laser.geometry();
  if (beams == 0 || beams == geometry.beam_count) return geometry;
  const double field_of_view_rad = geometry.resolution_rad * (geometry.beam_count - 1);
  geometry.beam_count = beams;
  if (beams > 1) geometry.resolution_rad = field_of_view_rad / (beams - 1);
  return geometry;
}

std::string names_of_robots(const WorldDescription& world) {
  std::string names;
  for (const RobotDescription& robot : world.robots) {
    names += (names.empty() ? "" : ", ") + robot.name;
  }
  return names.empty() ? "none" : names;
}

BatchRobot described(const Simulation& simulation, int index, int motion,
                     const BatchOptions& options) {
  BatchRobot robot{index, motion};
  for (int k = 0; k < simulation.device_count(index) && !robot.laser; ++k) {
    const auto* const laser = dynamic_cast<const Laser*>(&simulation.device(index, k));
    if (laser == nullptr) continue;
    robot.laser = k;
    robot.geometry = geometry_of(*laser, options.beams);
    if (options.beams > 1 && laser->geometry().beam_count == 1) {
      fail("beams: expected 0 or 1 because the laser of robot " +
           simulation.world().robots[static_cast<std::size_t>(index)].name +
           " has one beam, found " + std::to_string(options.beams));
    }
  }
  if (!options.readings) robot.quiet_devices = quiet_devices_of(simulation, index);
  return robot;
}

// The robots of the arrays.
std::vector<BatchRobot> chosen_robots(const Simulation& simulation, const BatchOptions& options) {
  std::vector<BatchRobot> robots;
  const WorldDescription& world = simulation.world();
  for (const std::string& name : options.robots) {
    const std::optional<int> index = simulation.find_robot(name);
    if (!index) {
      fail("robots: expected names of robots of the world (" + names_of_robots(world) +
           "), found \"" + name + "\"");
    }
    if (std::ranges::find(robots, *index, &BatchRobot::index) != robots.end()) {
      fail("robots: expected each name once, found \"" + name + "\" twice");
    }
    const std::optional<int> motion = find_motion(simulation, *index);
    if (!motion) fail("robots: expected robots with a motion device, found \"" + name + "\"");
    robots.push_back(described(simulation, *index, *motion, options));
  }
  if (!options.robots.empty()) return robots;
  for (int index = 0; index < simulation.robot_count(); ++index) {
    if (const auto motion = find_motion(simulation, index)) {
      robots.push_back(described(simulation, index, *motion, options));
    }
  }
  if (robots.empty()) fail("robots: expected a world with a robot that has a motion device");
  return robots;
}

int thread_count(int wanted) {
  check_range("threads", wanted, 0, kMostThreads);
  if (wanted > 0) return wanted;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

}  // namespace

struct Batch::Impl {
  Impl(const WorldDescription& its_world, const BatchOptions& options);

  // Calls work(simulation, workspace) for all simulations, or for those of the mask, on all
  // threads. Then throws what the first of them has thrown.
  template <typename Work>
  void run_all(std::span<const std::uint8_t> mask, Work work);

  // A simulation at its start.
  [[nodiscard]] Simulation made(std::uint64_t seed) const;
  // Makes a simulation that was made or restored one of this batch.
  void take_in(Simulation& simulation) const;
  void place(std::size_t i, const Rows<const double>& poses);
  void command(std::size_t i, const Rows<const double>& actions);
  void observe(std::size_t i, const ObservationRows& out, scan::ScanWorkspace& workspace) const;
  [[nodiscard]] ObservationRows rows_of(const BatchObservations& out) const {
    return {out, count, robot_count(), beams};
  }
  [[nodiscard]] int robot_count() const { return static_cast<int>(robots.size()); }

  WorldDescription world;
  int count;
  parallel::WorkerPool pool;
  std::vector<scan::ScanWorkspace> workspaces;  // of the workers
  std::vector<std::uint64_t> seeds;
  std::optional<const Simulation> prototype;  // never stepped
  std::vector<BatchRobot> robots;
  int beams = 0;
  std::vector<std::optional<Simulation>> simulations;
};

template <typename Work>
void Batch::Impl::run_all(std::span<const std::uint8_t> mask, Work work) {
  std::mutex mutex;
  int failed = count;
  std::exception_ptr failure;
  pool.run(count, [&](int item, int worker) {
    const auto i = static_cast<std::size_t>(item);
    if (!mask.empty() && mask[i] == 0) return;
    try {
      work(i, workspaces[static_cast<std::size_t>(worker)]);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (item >= failed) return;
      failed = item;
      failure = std::current_exception();
    }
  });
  if (failure) std::rethrow_exception(failure);
}

Batch::Impl::Impl(const WorldDescription& its_world, const BatchOptions& options)
    : world(its_world),
      count((check_range("simulations", options.simulations, 1, kMostSimulations),
             options.simulations)),
      pool(thread_count(options.threads)),
      workspaces(static_cast<std::size_t>(pool.threads())),
      seeds(options.seeds) {
  check_range("beams", options.beams, 0, kMostBeams);
  check_count("seeds", seeds.size(), count);
  for (std::size_t i = seeds.size(); i < static_cast<std::size_t>(count); ++i) {
    seeds.push_back(world.simulation.seed + i);
  }
  prototype.emplace(world);
  robots = chosen_robots(*prototype, options);
  for (const BatchRobot& robot : robots) {
    if (robot.laser) beams = std::max(beams, robot.geometry.beam_count);
  }
  simulations.resize(static_cast<std::size_t>(count));
  run_all({}, [this](std::size_t i, scan::ScanWorkspace&) { simulations[i] = made(seeds[i]); });
}

Simulation Batch::Impl::made(std::uint64_t seed) const {
  WorldDescription own = world;
  own.simulation.seed = seed;
  Simulation simulation(std::move(own));
  take_in(simulation);
  return simulation;
}

void Batch::Impl::take_in(Simulation& simulation) const {
  simulation.share_memory_with(*prototype);
  for (const BatchRobot& robot : robots) {
    for (const int device : robot.quiet_devices) {
      simulation.set_active({robot.index, device}, false);
    }
  }
}

void Batch::Impl::place(std::size_t i, const Rows<const double>& poses) {
  Simulation& simulation = *simulations[i];
  std::vector<Simulation::RobotPlace> places;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const auto pose = poses.row(i, r);
    places.push_back({robots[r].index, {pose[0], pose[1], normalize_angle(pose[2])}});
  }
  if (const auto refusal = simulation.place_robots(places)) {
    fail("poses: simulation " + std::to_string(i) + ": " + *refusal);
  }
  simulation.restart_statistics();
}

void Batch::Impl::command(std::size_t i, const Rows<const double>& actions) {
  std::optional<std::string> reason;
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const auto action = actions.row(i, r);
    const auto refusal = simulations[i]->apply({robots[r].index, robots[r].motion},
                                               TwistCommand{{action[0], action[1], 0.0}});
    if (refusal && !reason) reason = refusal;
  }
  if (reason) fail("actions: simulation " + std::to_string(i) + ": " + *reason);
}

void Batch::Impl::observe(std::size_t i, const ObservationRows& out,
                          scan::ScanWorkspace& workspace) const {
  const Simulation& simulation = *simulations[i];
  if (out.done) out.done.row(i)[0] = simulation.finished() ? 1 : 0;
  if (out.times) out.times.row(i)[0] = to_seconds(simulation.now_ns());
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const BatchRobot& robot = robots[r];
    const BodyState& body = simulation.body(robot.index);
    if (out.poses) {
      const auto row = out.poses.row(i, r);
      row[0] = body.X_WB.x_m;
      row[1] = body.X_WB.y_m;
      row[2] = body.X_WB.yaw_rad;
    }
    if (out.twists) {
      const auto row = out.twists.row(i, r);
      row[0] = body.twist.v_mps;
      row[1] = body.twist.omega_radps;
      row[2] = body.twist.lateral_mps;
    }
    if (out.clearances || out.collisions) {
      const RobotStatistics& statistics = simulation.statistics(robot.index);
      if (out.clearances) out.clearances.row(i, r)[0] = statistics.least_clearance_m;
      if (out.collisions) out.collisions.row(i, r)[0] = statistics.collisions;
    }
    if (!out.scans) continue;
    const auto row = out.scans.row(i, r);
    const auto own =
        row.first(robot.laser ? static_cast<std::size_t>(robot.geometry.beam_count) : 0);
    if (robot.laser) {
      const bool scanned =
          simulation.ideal_scan({robot.index, *robot.laser}, robot.geometry, workspace, own);
      SIM_ASSERT(scanned);
    }
    std::ranges::fill(row.subspan(own.size()), std::numeric_limits<float>::quiet_NaN());
  }
}

Batch::Batch(const WorldDescription& world, const BatchOptions& options) try
    : impl_(std::make_unique<Impl>(world, options)) {
} catch (const std::system_error& error) {
  throw BatchError(std::string("threads: the system starts no more: ") + error.what());
}

Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

int Batch::simulations() const noexcept { return impl_->count; }
int Batch::robots() const noexcept { return impl_->robot_count(); }
int Batch::beams() const noexcept { return impl_->beams; }
int Batch::threads() const noexcept { return impl_->pool.threads(); }

const std::string& Batch::robot_name(int robot) const {
  check_range("robot", robot, 0, robots() - 1);
  const int index = impl_->robots[static_cast<std::size_t>(robot)].index;
  return impl_->world.robots[static_cast<std::size_t>(index)].name;
}

const Simulation& Batch::simulation(int simulation) const {
  check_range("simulation", simulation, 0, simulations() - 1);
  return *impl_->simulations[static_cast<std::size_t>(simulation)];
}

std::optional<scan::ScanGeometry> Batch::scan_geometry(int robot) const {
  check_range("robot", robot, 0, robots() - 1);
  const BatchRobot& its = impl_->robots[static_cast<std::size_t>(robot)];
  if (!its.laser) return std::nullopt;
  return its.geometry;
}

void Batch::step(const BatchArray<const double>& actions, int steps, const BatchObservations& out) {
  check_range("steps", steps, 0, kMostSteps);
  const Rows<const double> commands("actions", actions, {simulations(), robots(), 2});
  const ObservationRows rows = impl_->rows_of(out);
  constexpr std::array kNames = {"the speed", "the turn rate"};
  for (int i = 0; commands && i < simulations(); ++i) {
    parallel::check_finite("actions", commands, i, robots(), kNames);
  }
  impl_->run_all({}, [&](std::size_t i, scan::ScanWorkspace& workspace) {
    Simulation& simulation = *impl_->simulations[i];
    std::exception_ptr refusal;
    if (!simulation.finished()) {
      try {
        if (commands) impl_->command(i, commands);
      } catch (const BatchError&) {
        refusal = std::current_exception();
      }
      for (int k = 0; k < steps && !simulation.finished(); ++k) simulation.step();
    }
    impl_->observe(i, rows, workspace);
    if (refusal) std::rethrow_exception(refusal);
  });
}

void Batch::observe(const BatchObservations& out) {
  const ObservationRows rows = impl_->rows_of(out);
  impl_->run_all({}, [&](std::size_t i, scan::ScanWorkspace& workspace) {
    impl_->observe(i, rows, workspace);
  });
}

void Batch::reset(const BatchReset& how) {
  check_count("mask", how.mask.size(), simulations());
  check_count("seeds", how.seeds.size(), simulations());
  const Rows<const double> poses("poses", how.poses, {simulations(), robots(), 3});
  constexpr std::array kPoseNames = {"x", "y", "the yaw"};
  // Poses of simulations that are not reset do not matter.
  for (int i = 0; poses && i < simulations(); ++i) {
    if (!how.mask.empty() && how.mask[static_cast<std::size_t>(i)] == 0) continue;
    parallel::check_finite("poses", poses, i, robots(), kPoseNames);
  }
  impl_->run_all(how.mask, [&](std::size_t i, scan::ScanWorkspace&) {
    if (!how.seeds.empty()) impl_->seeds[i] = how.seeds[i];
    impl_->simulations[i] = impl_->made(impl_->seeds[i]);
    if (poses) impl_->place(i, poses);
  });
}

Snapshot Batch::save(int simulation) const { return this->simulation(simulation).save(); }

void Batch::restore(std::span<const std::uint8_t> mask, std::span<const std::uint8_t> snapshot) {
  check_count("mask", mask.size(), simulations());
  WorldDescription world = impl_->world;
  world.simulation.seed = seed_of(snapshot);
  const std::uint64_t seed = world.simulation.seed;
  const SnapshotReader reader = Simulation(std::move(world)).snapshot_reader();
  // Nothing changes if the bytes are damaged.
  static_cast<void>(reader.read(snapshot));
  impl_->run_all(mask, [&](std::size_t i, scan::ScanWorkspace&) {
    Simulation restored = reader.read(snapshot);
    impl_->take_in(restored);
    impl_->simulations[i] = std::move(restored);
    impl_->seeds[i] = seed;
  });
}

}  // namespace sim
