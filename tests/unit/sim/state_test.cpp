// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Snapshots of simulations: a restored simulation continues with bit-identical results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <any>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "nightly.h"
#include "run_process.h"
#include "sim/core/hash.h"
#include "sim/devices/camera.h"
#include "sim/devices/dio.h"
#include "sim/devices/laser.h"
#include "sim/devices/opaque.h"
#include "sim/devices/posture.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace sim {
namespace {

namespace fs = std::filesystem;
using test_support::cases;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::HasSubstr;

constexpr const char* kFolderVariable = "PLAYPEN_STATE_TEST_FOLDER";
constexpr int kGoOn = 30;  // steps after a restore

int steps_of_trace() { return cases(150, 600); }
std::size_t snapshots_of_trace() { return cases<std::size_t>(6, 50); }

const fs::path kWorlds = fs::path(PLAYPEN_SOURCE_DIR) / "worlds";

/// One device of each kind, as in the worlds of worlds/devices.
std::vector<DeviceDescription> devices_of_all_kinds() {
  std::vector<DeviceDescription> devices;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kWorlds / "devices"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const WorldDescription world = load_world(file.string());
    const std::string type = file.stem().string();
    for (const RobotDescription& robot : world.robots) {
      const auto found =
          std::find_if(robot.devices.begin(), robot.devices.end(),
                       [&](const DeviceDescription& device) { return device.type == type; });
      if (found == robot.devices.end()) continue;
      devices.push_back(*found);
      break;
    }
  }
  std::sort(devices.begin(), devices.end(),
            [](const DeviceDescription& a, const DeviceDescription& b) { return a.name < b.name; });
  return devices;
}

/// Blocks that rise slowly or wait, and an arena controller that changes them.
void add_controller(WorldDescription& world) {
  std::vector<std::string> blocks;
  for (ObstacleDescription& block : world.arena.obstacles) {
    if (block.type != ObstacleType::kDynamic) continue;
    block.rise_speed_mps = blocks.size() % 3 == 0 ? 0.0 : 0.2;
    block.when_blocked = blocks.size() % 2 == 0 ? WhenBlocked::kRefuse : WhenBlocked::kWait;
    blocks.push_back(block.name);
  }
  TimerDescription timer;
  timer.name = "timer";
  timer.every_s = 0.7;
  timer.jitter_s = 0.3;
  timer.actions = {BlocksAction{BlocksAction::Change::kToggle, blocks},
                   TextAction{.text = "toggled", .place = Vec2{1.0, 1.0}, .duration_s = 0.5}};
  world.controller.timers.push_back(timer);
  TrapDescription trap;
  trap.name = "trap";
  trap.region = NearRegion{world.robots[1].name, 0.6};
  trap.on = TrapDescription::On::kStay;
  trap.stay_s = 0.3;
  trap.actions = {ScoreAction{}, RestartAction{{}, WhenBlocked::kWait}};
  world.controller.traps.push_back(trap);
}

/// Thirteen robots with a device of each kind in the arena, with objects that can be taken, pushed
/// and retracted.
WorldDescription full_world() {
  WorldDescription world = load_world((kWorlds / "examples/thirteen_robots.json").string());
  const std::vector<DeviceDescription> devices = devices_of_all_kinds();
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    RobotDescription& robot = world.robots[i];
    const std::string next = world.robots[(i + 1) % world.robots.size()].name;
    robot.fiducial = static_cast<int>(i) + 1;
    robot.devices = devices;
    for (DeviceDescription& device : robot.devices) {
      if (device.type == "opaque") std::any_cast<OpaqueParams&>(device.params).from = {next};
      if (device.type == "posture") std::any_cast<PostureParams&>(device.params).of = "ptz";
      if (device.type == "laser") {
        auto& laser = std::any_cast<LaserParams&>(device.params);
        laser.noise_m = 0.01;
        laser.latency_s = 0.0;  // a test counts the steps until its readings
      }
      if (device.type == "camera") {
        std::any_cast<CameraParams&>(device.params).width = 32;
        std::any_cast<CameraParams&>(device.params).height = 24;
      }
      if (device.type == "dio") {
        for (DigitalSource& source : std::any_cast<DioParams&>(device.params).inputs) {
          if (auto* wire = std::get_if<Wire>(&source)) wire->robot = next;
        }
      }
    }
  }
  world.arena.obstacles.push_back({.name = "can",
                                   .center = {1.35, 0.26},
                                   .size = {0.04, 0.04},
                                   .height_m = 0.12,
                                   .tags = {},
                                   .fiducial = 99,
                                   .colour = Colour{0xff, 0, 0, 0xff},
                                   .portable = true});
  add_controller(world);
  return world;
}

int number_in(std::mt19937& random, int end) {
  return static_cast<int>(random() % static_cast<unsigned>(end));
}
double signed_unit(std::mt19937& random) {
  return static_cast<double>(random()) / 4294967296.0 * 2.0 - 1.0;
}

Command random_command(std::mt19937& random) {
  const double a = signed_unit(random);
  const double b = signed_unit(random);
  switch (number_in(random, 21)) {
    case 0:
    case 1:
    case 2:
      return TwistCommand{{.v_mps = 0.5 * a, .omega_radps = 3.0 * b}};
    case 3:
      return MotorEnableCommand{a > -0.8};
    case 4:
      return SetPoseCommand{{a, b, a}};
    case 5:
      return GotoCommand{{1.7 + 1.5 * a, 1.8 + 1.5 * b}, 0.05, 0.4};
    case 6:
      return StopCommand{};
    case 7:
      return ResumeCommand{};
    case 8:
      return TranslateCommand{{0.3 * a, 0.3 * b}};
    case 9:
      return HeadingCommand{0.4 * a, 0.0, 3.0 * b, -1};
    case 10:
      return PositionCommand{{1.7 + 1.5 * a, 1.8 + 1.5 * b, a}, 0.3, 0.0, -1};
    case 11:
      return CarCommand{0.4 * a, b};
    case 12:
      return SayCommand{"hello " + std::to_string(random() % 100)};
    case 13:
      return DigitalOutputCommand{4, static_cast<std::uint32_t>(random() % 16)};
    case 14:
      return AnalogOutputCommand{0, a};
    case 15:
      return LightCommand{a > 0, Colour{1, 2, 3, 255}, 0.3, 0.4};
    case 16:
      return GripCommand{static_cast<GripCommand::Action>(random() % 5)};
    case 17:
      return OpaqueCommand{{1, 2, static_cast<std::uint8_t>(random() % 256)}};
    case 18:
      return JointCommand{
          static_cast<JointCommand::Mode>(random() % 3), number_in(random, 4) - 1, {a}};
    case 19:
      return JointSettingCommand{static_cast<JointSettingCommand::Setting>(random() % 4),
                                 number_in(random, 4) - 1, a > -0.3 ? a : 0.0};
    default:
      return a > 0.0 ? Command(PointCommand{a, 0.3 * b, 0.5, 0.2, 0.1})
                     : Command(PanCommand{a, b, a});
  }
}

/// The commands of programs before step `i`: equal in each run, whatever their result.
void interfere(Simulation& simulation, int i) {
  std::mt19937 random(static_cast<unsigned>(i) + 77U);
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    if (number_in(random, 8) != 0) continue;
    const Command command = random_command(random);
    // A command to each device: devices that do not accept it return an error.
    for (int device = 0; device < simulation.device_count(robot); ++device) {
      static_cast<void>(simulation.apply({robot, device}, command));
    }
  }
  const int robot = number_in(random, simulation.robot_count());
  const Simulation::DeviceId id{robot, number_in(random, simulation.device_count(robot))};
  const Colour colour{static_cast<std::uint8_t>(random() % 256), 20, 30, 255};
  const std::string name = simulation.world().robots[static_cast<std::size_t>(robot)].name;
  const auto& obstacles = simulation.world().arena.obstacles;
  const std::string& block =
      obstacles[static_cast<std::size_t>(number_in(random, static_cast<int>(obstacles.size())))]
          .name;
  switch (number_in(random, 40)) {
    case 0:
      return simulation.set_active(id, !simulation.active(id));
    case 1:
      static_cast<void>(simulation.set_robot_dynamics(robot, !simulation.robot_dynamics(robot)));
      return;
    case 2:
      static_cast<void>(
          simulation.set_object_colour(number_in(random, 2) == 0 ? block : name, colour));
      return;
    case 3:
      static_cast<void>(simulation.set_object_fiducial(block, number_in(random, 9)));
      return;
    case 4:
    case 5:
      static_cast<void>(simulation.set_obstacle_state(
          block, number_in(random, 2) == 0 ? ObstacleState::kExtended : ObstacleState::kRetracted));
      return;
    case 6:
      static_cast<void>(simulation.place_object(
          block, {1.7 + 1.5 * signed_unit(random), 1.8 + 1.6 * signed_unit(random), 0.3}));
      return;
    case 7:
      static_cast<void>(simulation.set_block_size(block, {0.1, 0.07}, 0.2));
      return;
    case 8:
      simulation.canvas().draw_line(number_in(random, 150), 5, number_in(random, 150), 90, colour);
      return;
    default:
      return;
  }
}

/// A hash of the parts of robots that pictures show.
std::uint64_t shown_hash(const Simulation& simulation) {
  StateHash hash;
  const auto add = [&hash](const Vec2& p) {
    hash.add(p.x());
    hash.add(p.y());
  };
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    const RobotSnapshot shot = simulation.robot_snapshot(robot);
    hash.add(shot.says);
    hash.add(static_cast<int>(shot.colour.r));
    for (const Vec2& p : shot.scan_points) add(p);
    for (const ConeSnapshot& cone : shot.cones) {
      add(cone.X_WS.position());
      hash.add(cone.range_m);
    }
    for (const BumperSnapshot& bumper : shot.bumpers) hash.add(bumper.pressed);
    for (const auto& [from, to] : shot.sights) {
      add(from);
      add(to);
    }
    for (const LightSnapshot& light : shot.lights) hash.add(light.lit);
    for (const std::vector<Vec2>& arm : shot.arms) {
      for (const Vec2& p : arm) add(p);
    }
    for (const Polygon& paddle : shot.paddles) {
      for (const Vec2& p : paddle) add(p);
    }
  }
  return hash.value();
}

/// Hashes of the complete visible state of a simulation after each step.
using Trace = std::vector<std::array<std::uint64_t, 2>>;

std::array<std::uint64_t, 2> seen(const Simulation& simulation) {
  return {simulation.state_hash(), shown_hash(simulation)};
}

std::set<int> moments() {
  std::mt19937 random(4711);
  std::set<int> moments = {0};
  while (moments.size() < snapshots_of_trace()) {
    moments.insert(number_in(random, steps_of_trace() - kGoOn));
  }
  return moments;
}

void write_file(const std::string& file, const void* data, std::size_t size) {
  std::ofstream out(file, std::ios::binary);
  out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  ASSERT_TRUE(out.flush());
}

Snapshot read_snapshot(const std::string& file) {
  const std::string bytes = read_bytes(file);
  return {bytes.begin(), bytes.end()};
}

// The next test runs this one in another process.
TEST(StateOfOtherProcess, Continues) {
  const char* folder = std::getenv(kFolderVariable);
  if (folder == nullptr) GTEST_SKIP() << "without " << kFolderVariable << " there is nothing to do";
  const std::string bytes = read_bytes(fs::path(folder) / "trace");
  Trace trace(bytes.size() / sizeof(Trace::value_type));
  std::memcpy(trace.data(), bytes.data(), bytes.size());
  Simulation simulation(full_world());
  for (const int moment : moments()) {
    simulation.restore(read_snapshot((fs::path(folder) / std::to_string(moment)).string()));
    for (int i = moment; i < moment + kGoOn; ++i) {
      ASSERT_EQ(seen(simulation), trace[static_cast<std::size_t>(i)])
          << "saved at " << moment << ", at step " << i;
      interfere(simulation, i);
      simulation.step();
    }
  }
}

TEST(State, OtherProcess_ContinuesExactly) {
  const TemporaryFolder folder;
  Simulation simulation(full_world());
  const std::set<int> saved = moments();
  Trace trace;
  for (int i = 0; i < steps_of_trace(); ++i) {
    trace.push_back(seen(simulation));
    if (saved.contains(i)) {
      const Snapshot snapshot = simulation.save();
      write_file(folder / std::to_string(i), snapshot.data(), snapshot.size());
    }
    interfere(simulation, i);
    simulation.step();
  }
  // Many events must have happened, otherwise the test shows nothing.
  int collisions = 0;
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    collisions += simulation.statistics(robot).collisions;
  }
  EXPECT_GT(collisions, cases(5, 15));
  write_file(folder / "trace", trace.data(), trace.size() * sizeof(Trace::value_type));
  test_support::ProcessOptions options;
  options.environment[kFolderVariable] = folder.path().string();
  const test_support::ProcessResult result = test_support::run_process(
      {"/proc/self/exe", "--gtest_filter=StateOfOtherProcess.Continues"}, options);
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("[  PASSED  ] 1 test"));
}

Simulation busy_simulation(int steps) {
  Simulation simulation(full_world());
  for (int i = 0; i < steps; ++i) {
    interfere(simulation, i);
    simulation.step();
  }
  return simulation;
}

TEST(State, SaveAndRestore_Same) {
  Simulation simulation = busy_simulation(cases(100, 300));
  const Snapshot snapshot = simulation.save();
  EXPECT_EQ(simulation.save(), snapshot);
  simulation.restore(snapshot);
  EXPECT_EQ(simulation.save(), snapshot);
  for (int i = 0; i < 20; ++i) simulation.step();
  EXPECT_NE(simulation.save(), snapshot);
  simulation.restore(snapshot);
  EXPECT_EQ(simulation.save(), snapshot);
}

TEST(State, Fork_Independent) {
  Simulation simulation = busy_simulation(80);
  Simulation fork = simulation.fork();
  const std::uint64_t before = simulation.state_hash();
  EXPECT_EQ(fork.state_hash(), before);
  for (int i = 80; i < 140; ++i) {
    interfere(fork, i);
    fork.step();
  }
  EXPECT_EQ(simulation.state_hash(), before);
  for (int i = 80; i < 140; ++i) {
    interfere(simulation, i);
    simulation.step();
  }
  EXPECT_EQ(simulation.state_hash(), fork.state_hash());
}

/// Drives robots about a world at random, and saves meanwhile.
void expect_same_after_restore(WorldDescription world, int steps) {
  Simulation whole(world);
  Simulation restored(world);
  std::mt19937 random(3);
  for (int i = 0; i < steps; ++i) {
    for (int robot = 0; robot < whole.robot_count(); ++robot) {
      const TwistCommand command{{0.5 * signed_unit(random), 2.0 * signed_unit(random)}};
      if (number_in(random, 30) != 0) continue;
      for (int device = 0; device < whole.device_count(robot); ++device) {
        static_cast<void>(whole.apply({robot, device}, command));
        static_cast<void>(restored.apply({robot, device}, command));
      }
    }
    whole.step();
    restored.step();
    if (number_in(random, 40) == 0) {
      Simulation other(world);
      other.restore(restored.save());
      restored = std::move(other);
    }
    ASSERT_EQ(restored.state_hash(), whole.state_hash()) << "step " << i;
  }
}

TEST(State, RobotsAmongMapWalls_Restored) {
  expect_same_after_restore(load_world((kWorlds / "cave.json").string()), 600);
  expect_same_after_restore(load_world((kWorlds / "examples/car.json").string()), 400);
  expect_same_after_restore(load_world((kWorlds / "examples/omni.json").string()), 400);
}

TEST(State, ShovingCrowd_Continues) {
  WorldDescription world = load_world((kWorlds / "examples/empty_room.json").string());
  const RobotDescription first = world.robots[0];
  world.robots.clear();
  for (int i = 0; i < 16; ++i) {
    RobotDescription robot = first;
    robot.name = "r" + std::to_string(i + 1);
    robot.port = 7000 + i;
    robot.pose = {0.6 + 0.2 * (i % 4), 0.6 + 0.2 * (i / 4), 0.7 * i};
    world.robots.push_back(robot);
  }
  expect_same_after_restore(std::move(world), 800);
}

TEST(State, WorldOnly_KeepsClientLayers) {
  Simulation simulation = busy_simulation(10);
  const LayerId before = simulation.layers().add(LayerKind::kGrey, {.name = "map"}, 1);
  const DrawOperation dot{.layer = before, .value = CellValue::of(1.0F)};
  simulation.layers().draw({&dot, 1});
  simulation.canvas().set_pixel(3, 3, {9, 9, 9, 255});
  const Snapshot snapshot = simulation.save();
  const SceneSnapshot shown = simulation.snapshot();

  simulation.canvas().clear();
  const LayerId later = simulation.layers().add(LayerKind::kBinary, {.name = "way"}, 1);
  simulation.layers().remove(before);
  static_cast<void>(simulation.snapshot());
  const std::uint64_t version = simulation.layers().version();
  simulation.restore(snapshot, RestoreScope::kWorld);
  EXPECT_TRUE(simulation.layers().contains(later));
  EXPECT_FALSE(simulation.layers().contains(before));
  EXPECT_EQ(simulation.canvas().pixel(3, 3), (Colour{9, 9, 9, 255}));
  EXPECT_GT(simulation.layers().version(), version);

  simulation.restore(snapshot);
  EXPECT_TRUE(simulation.layers().contains(before));
  EXPECT_FALSE(simulation.layers().contains(later));
  EXPECT_EQ(simulation.snapshot().canvas, shown.canvas);
  EXPECT_EQ(simulation.layers().cell(before, 0, 0), CellValue::of(1.0F));
  EXPECT_GT(simulation.layers().add(LayerKind::kGrey, {}, 1), later);  // numbers are not reused
}

TEST(State, WorldOnly_RestoredWhileClocksContinue) {
  Simulation simulation = busy_simulation(103);
  const Snapshot snapshot = simulation.save();
  const Pose there = simulation.body(0).X_WB;
  const int laser = simulation.find_device(0, "laser").value();
  const auto newest = [&] {
    return dynamic_cast<const Sensor&>(simulation.device(0, laser)).reading();
  };
  for (int i = 0; i < 50; ++i) {
    interfere(simulation, i);
    simulation.step();
  }
  const SimTime now_ns = simulation.now_ns();
  const std::uint64_t sequence = newest().sequence;
  const int collisions = simulation.statistics(0).collisions;
  simulation.restore(snapshot, RestoreScope::kWorld);
  EXPECT_EQ(simulation.body(0).X_WB, there);
  EXPECT_EQ(simulation.now_ns(), now_ns);
  EXPECT_EQ(simulation.steps(), 153U);
  EXPECT_EQ(simulation.statistics(0).collisions, collisions);
  // The snapshot was taken 7 steps before a scan.
  for (int i = 0; i < 6; ++i) simulation.step();
  EXPECT_LE(newest().sequence, sequence);
  simulation.step();
  EXPECT_EQ(newest().sequence, sequence + 1);
  EXPECT_EQ(newest().time_ns, now_ns + 70'000'000);
}

// --- Invalid snapshots

std::string refusal(Simulation& simulation, const Snapshot& snapshot) {
  const Snapshot before = simulation.save();
  std::string why = "nothing";
  try {
    simulation.restore(snapshot);
  } catch (const SnapshotError& error) {
    why = error.what();
  }
  EXPECT_EQ(simulation.save(), before) << why;
  return why;
}

TEST(Snapshots, RefusedWithReason) {
  Simulation simulation = busy_simulation(30);
  const Snapshot good = simulation.save();
  simulation.step();
  Snapshot cut = good;
  cut.pop_back();
  EXPECT_THAT(refusal(simulation, cut), HasSubstr("snapshot: expected "));
  EXPECT_THAT(refusal(simulation, cut), HasSubstr("bytes of pictures, found "));
  EXPECT_THAT(refusal(simulation, {}), HasSubstr("expected at least 56 bytes, found 0 bytes"));
  Snapshot other = good;
  other[0] = 'X';
  EXPECT_THAT(refusal(simulation, other), HasSubstr("a snapshot of Playpen, found other bytes"));
  other = good;
  other[8] = 200;
  EXPECT_THAT(refusal(simulation, other), HasSubstr("expected version 4, found version 200"));
  other = good;
  other[good.size() / 2] ^= 1;
  EXPECT_THAT(refusal(simulation, other), HasSubstr("they were altered"));

  Simulation elsewhere(load_world((kWorlds / "office.json").string()));
  EXPECT_THAT(refusal(elsewhere, good), HasSubstr("found another world ("));
  WorldDescription seeded = full_world();
  seeded.simulation.seed = 5;
  Simulation with_other_seed(std::move(seeded));
  EXPECT_THAT(refusal(with_other_seed, good), HasSubstr("expected seed 5, found seed 1"));
}

// Valid bytes with changed parts, so that the test reaches all of the reader's checks.
TEST(Snapshots, RandomBytes_RefusedOrContinue) {
  constexpr std::size_t kHeader = 56;
  WorldDescription world = full_world();
  world.robots.resize(3);
  for (DeviceDescription& device : world.robots[2].devices) {
    if (device.type == "opaque") std::any_cast<OpaqueParams&>(device.params).from = {"r1"};
    if (device.type == "dio") std::any_cast<DioParams&>(device.params).inputs.clear();
  }
  Simulation simulation(world);
  for (int i = 0; i < 200; ++i) {
    interfere(simulation, i);
    simulation.step();
  }
  const Snapshot good = simulation.save();
  std::mt19937 random(99);
  int refused = 0;
  const int rounds = cases(50, 200);
  for (int round = 0; round < rounds; ++round) {
    Snapshot bad = good;
    for (int k = 1 + number_in(random, 3); k > 0; --k) {
      const std::size_t at = kHeader + random() % (good.size() - kHeader);
      constexpr std::array<std::uint8_t, 5> kValues = {0x00, 0x01, 0x7f, 0x80, 0xff};
      // Sometimes it changes a whole word: counts, infinite numbers.
      const std::size_t count =
          number_in(random, 2) == 0 ? 1 : std::min<std::size_t>(8, good.size() - at);
      const std::uint8_t value = kValues[random() % kValues.size()];
      for (std::size_t i = 0; i < count; ++i) bad[at + i] = value;
    }
    StateHash hash;
    hash.add_bytes(bad.data() + kHeader, bad.size() - kHeader);
    const std::uint64_t value = hash.value();
    std::memcpy(bad.data() + kHeader - sizeof value, &value, sizeof value);
    Simulation other(world);
    try {
      other.restore(bad);
    } catch (const SnapshotError&) {
      ++refused;
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      interfere(other, i);
      other.step();
    }
    static_cast<void>(other.snapshot());
  }
  EXPECT_GT(refused, rounds / 10);
}

}  // namespace
}  // namespace sim
