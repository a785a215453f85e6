// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The state of a simulation without its world: saving, restoring, hashing.
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/solid_limits.h"
#include "sim/core/hash.h"
#include "sim/core/number_text.h"
#include "sim/simulation/world_hash.h"
#include "sim/world/limits.h"
#include "sim/world/view_mode.h"
#include "simulation/controller.h"
#include "simulation/obstacle_motions.h"
#include "simulation/simulation_impl.h"

namespace sim {
namespace {

// The beginning of a snapshot.
struct SnapshotHeader {
  std::array<char, 8> magic;
  std::uint64_t version;
  std::uint64_t world;  // world_hash()
  std::uint64_t seed;
  std::uint64_t state;     // size of the state [bytes]
  std::uint64_t pictures;  // size of the clients' layers, which follow [bytes]
  std::uint64_t hash;      // of both
};
constexpr std::array<char, 8> kMagic = {'P', 'l', 'a', 'y', 'p', 'e', 'n', '\n'};
constexpr std::uint64_t kSnapshotVersion = 3;

std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
  StateHash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  return hash.value();
}

// The header of a snapshot; throws if the snapshot is damaged or belongs to another world.
// @param own  the hash of the world in its initial state.
SnapshotHeader checked_header(std::span<const std::uint8_t> snapshot, const WorldDescription& world,
                              std::uint64_t own) {
  SnapshotHeader header{};
  const auto bytes = [](std::uint64_t count) { return std::to_string(count) + " bytes"; };
  const auto expect = [](bool holds, const std::string& expected, const std::string& found) {
    if (!holds) throw SnapshotError(expected, found);
  };
  expect(snapshot.size() >= sizeof header, "at least " + bytes(sizeof header),
         bytes(snapshot.size()));
  std::memcpy(&header, snapshot.data(), sizeof header);
  expect(header.magic == kMagic, "a snapshot of Playpen", "other bytes");
  expect(header.version == kSnapshotVersion, "version " + std::to_string(kSnapshotVersion),
         "version " + std::to_string(header.version));
  expect(header.world == own, "world " + world.name + " (" + hexadecimal_text(own, 16) + ")",
         "another world (" + hexadecimal_text(header.world, 16) + ")");
  expect(header.seed == world.simulation.seed, "seed " + std::to_string(world.simulation.seed),
         "seed " + std::to_string(header.seed));
  const std::uint64_t left = snapshot.size() - sizeof header;
  expect(header.state <= left && header.pictures == left - header.state,
         bytes(header.state) + " of state and " + bytes(header.pictures) + " of pictures",
         bytes(left));
  const std::uint64_t hash = hash_of(snapshot.subspan(sizeof header));
  expect(header.hash == hash, "bytes with the hash " + hexadecimal_text(header.hash, 16),
         "the hash " + hexadecimal_text(hash, 16) + ": they were altered");
  return header;
}

}  // namespace

WorldDescription Simulation::Impl::start_world() const {
  WorldDescription start = world;
  start.arena.obstacles = start_obstacles;
  for (std::size_t i = 0; i < start_appearances.size(); ++i) {
    start.robots[i].colour = start_appearances[i].colour;
    start.robots[i].fiducial = start_appearances[i].fiducial;
  }
  return start;
}

std::uint64_t Simulation::Impl::start_hash() const {
  if (!known_start_hash) known_start_hash = world_hash(start_world());
  return *known_start_hash;
}

void Simulation::Impl::archive_obstacle(StateArchive& archive, ObstacleDescription& thing) {
  archive(thing.center, thing.size, thing.yaw_rad, thing.height_m, thing.fiducial, thing.colour);
  for (Vec2& vertex : thing.outline) archive(vertex);
  archive.choice(thing.state, ObstacleState::kRetracted);
  archive.index(thing.carried_by, robots.size(), -1);
  archive.expect(!archive.reading() || !io::check_obstacle(thing), "obstacles that can be");
}

void Simulation::Impl::archive_robot(StateArchive& archive, std::size_t i) {
  RobotParts& robot = robots[i];
  RobotStatistics& s = robot.statistics;
  archive(world.robots[i].colour, world.robots[i].fiducial, robot.last_position,
          robot.clearance_slack_m, s.path_length_m, s.collisions, s.least_clearance_m,
          s.stalled_time_s);
  for (const auto& device : robot.devices) device->archive(archive);
  if (archive.reading()) note_due_times(i);
}

void Simulation::Impl::archive(StateArchive& archive) {
  archive.time(now_ns);
  archive(steps);
  physics->archive(archive);
  for (ObstacleDescription& thing : world.arena.obstacles) archive_obstacle(archive, thing);
  for (std::size_t i = 0; i < robots.size(); ++i) archive_robot(archive, i);
  archive.list(loads, [&](Load& load) {
    archive.index(load.robot, robots.size());
    archive.index(load.obstacle, world.arena.obstacles.size());
    archive(load.X_BT, load.inside);
    archive.expect(obstacle(load.obstacle).carried_by == static_cast<int>(load.robot),
                   "loads of those who carry them");
  });
  archive.list(updated, [&](DeviceId& id) {
    archive.index(id.robot, robots.size());
    archive.index(id.device, robots[static_cast<std::size_t>(id.robot)].devices.size());
  });
  forget_old_collisions();
  archive.list(collisions, [&](Collision& collision) {
    archive.time(collision.time_ns);
    archive.index(collision.robot, robots.size());
    archive(collision.partner);
  });
  archive.list(spoken_texts, [&](SpokenText& spoken) {
    archive.time(spoken.time_ns);
    archive.index(spoken.robot, robots.size());
    archive(spoken.text);
  });
  layers.archive_base(archive);
  archive_arena(archive);
  if (obstacle_motions) obstacle_motions->archive(archive);
  if (!archive.reading()) return;
  for (std::size_t i = 0; i < robots.size(); ++i) update_load_outlines(i);
}

void Simulation::Impl::archive_pictures(StateArchive& archive) {
  archive.choice(view_mode, ViewMode::kFullScreen);
  // The hash of the state excludes them, because only pictures and reports use them.
  for (Collision& collision : collisions) archive(collision.place);
  layers.archive_others(archive);
}

std::uint64_t Simulation::state_hash() const {
  StateArchive archive;
  impl_->archive(archive);
  return hash_of(archive.written());
}

Snapshot Simulation::save() const {
  SnapshotHeader header{
      kMagic, kSnapshotVersion, impl_->start_hash(), impl_->world.simulation.seed, 0, 0, 0};
  StateArchive archive;
  archive.raw(&header, sizeof header);
  impl_->archive(archive);
  header.state = archive.written().size() - sizeof header;
  impl_->archive_pictures(archive);
  header.pictures = archive.written().size() - sizeof header - header.state;
  header.hash = hash_of(archive.written().subspan(sizeof header));
  Snapshot snapshot = archive.take();
  std::memcpy(snapshot.data(), &header, sizeof header);
  return snapshot;
}

std::unique_ptr<Simulation::Impl> Simulation::Impl::restored(std::span<const std::uint8_t> snapshot,
                                                             LogHook hook) const {
  const SnapshotHeader header = checked_header(snapshot, world, start_hash());
  auto made = std::make_unique<Impl>(start_world(), std::move(hook), true);
  made->known_start_hash = known_start_hash;
  StateArchive state(snapshot.subspan(sizeof header, header.state));
  made->archive(state);
  state.expect(state.left() == 0, "no more bytes of state");
  StateArchive pictures(snapshot.subspan(sizeof header + header.state));
  made->archive_pictures(pictures);
  pictures.expect(pictures.left() == 0, "no more bytes of pictures");
  return made;
}

void Simulation::Impl::take_over_from(Impl& before) {
  const SimTime later_ns = before.now_ns - now_ns;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i].statistics = before.robots[i].statistics;
    for (std::size_t k = 0; k < robots[i].devices.size(); ++k) {
      robots[i].devices[k]->take_over_from(*before.robots[i].devices[k], later_ns);
    }
    note_due_times(i);
  }
  now_ns = before.now_ns;
  steps = before.steps;
  collisions = std::move(before.collisions);
  spoken_texts = std::move(before.spoken_texts);
  events = std::move(before.events);
  scores = std::move(before.scores);
  verdict = std::move(before.verdict);
  if (controller) controller->shift_times(later_ns);
  if (obstacle_motions) obstacle_motions->shift_times(later_ns);
  record(ArenaEventKind::kReset, "world");
  updated.clear();
  invalidate_clearances();
  layers.resize(before.layers.width(), before.layers.height());  // keep the size that clients chose
  before.layers.take_base(layers);
  layers = std::move(before.layers);
  view_mode = before.view_mode;
}

void Simulation::restore(std::span<const std::uint8_t> snapshot, RestoreScope scope) {
  std::unique_ptr<Impl> restored = impl_->restored(snapshot, impl_->log);
  if (scope == RestoreScope::kAll) {
    restored->layers.take_over_from(impl_->layers);
  } else {
    restored->take_over_from(*impl_);
  }
  impl_ = std::move(restored);
}

Simulation Simulation::fork() const { return Simulation(impl_->restored(save(), {})); }

}  // namespace sim
