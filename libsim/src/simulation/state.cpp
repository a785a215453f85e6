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
#include "simulation/blocks.h"
#include "simulation/controller.h"
#include "simulation/loads.h"
#include "simulation/obstacle_motions.h"

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
constexpr std::uint64_t kSnapshotVersion = 4;

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

// Counts the bytes that are written during its life. Does nothing while a state is read.
class ByteCount {
 public:
  ByteCount(const StateArchive& archive, std::size_t& count)
      : archive_(archive), count_(count), begin_(archive.written().size()) {}
  ~ByteCount() {
    if (!archive_.reading()) count_ = archive_.written().size() - begin_;
  }
  ByteCount(const ByteCount&) = delete;
  ByteCount& operator=(const ByteCount&) = delete;

 private:
  const StateArchive& archive_;
  std::size_t& count_;
  std::size_t begin_;
};

// Room for what took so many bytes last time. A little more, since lists grow.
std::size_t room_for(std::size_t bytes) { return bytes + bytes / 16; }

// Writes a snapshot: its header, and what write_state() and write_pictures() append.
// @param room  about the number of bytes of both.
template <typename WriteState, typename WritePictures>
Snapshot written_snapshot(std::uint64_t world, std::uint64_t seed, std::size_t room,
                          WriteState write_state, WritePictures write_pictures) {
  SnapshotHeader header{kMagic, kSnapshotVersion, world, seed, 0, 0, 0};
  StateArchive archive;
  archive.reserve(sizeof header + room);
  archive.raw(&header, sizeof header);
  write_state(archive);
  header.state = archive.written().size() - sizeof header;
  write_pictures(archive);
  header.pictures = archive.written().size() - sizeof header - header.state;
  header.hash = hash_of(archive.written().subspan(sizeof header));
  Snapshot snapshot = archive.take();
  std::memcpy(snapshot.data(), &header, sizeof header);
  return snapshot;
}

}  // namespace

std::uint64_t seed_of(std::span<const std::uint8_t> snapshot) {
  SnapshotHeader header{};
  if (snapshot.size() < sizeof header) {
    throw SnapshotError("at least " + std::to_string(sizeof header) + " bytes",
                        std::to_string(snapshot.size()) + " bytes");
  }
  std::memcpy(&header, snapshot.data(), sizeof header);
  if (header.magic != kMagic) throw SnapshotError("a snapshot of Playpen", "other bytes");
  return header.seed;
}

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
  archive_bodies(archive);
  layers.archive_base(archive);
  archive_rules(archive);
}

void Simulation::Impl::archive_bodies(StateArchive& archive) {
  const ByteCount count(archive, bodies_bytes);
  archive.time(now_ns);
  archive(steps, box2d_since_ns);
  physics->archive(archive);
  for (ObstacleDescription& thing : world.arena.obstacles) archive_obstacle(archive, thing);
  for (std::size_t i = 0; i < robots.size(); ++i) archive_robot(archive, i);
  loads->archive(archive);
  archive.list(updated, [&](DeviceId& id) {
    archive.index(id.robot, robots.size());
    archive.index(id.device, robots[static_cast<std::size_t>(id.robot)].devices.size());
  });
  chronicle.archive(archive, robots.size());
}

void Simulation::Impl::archive_rules(StateArchive& archive) {
  const ByteCount count(archive, rules_bytes);
  if (chronicle.records_events()) {
    blocks->archive(archive);
    chronicle.archive_events(archive);
  }
  if (controller) controller->archive(archive);
  if (obstacle_motions) obstacle_motions->archive(archive);
  if (!archive.reading()) return;
  for (std::size_t i = 0; i < robots.size(); ++i) loads->update_outlines(i);
}

void Simulation::Impl::archive_pictures(StateArchive& archive) {
  const ByteCount count(archive, pictures_bytes);
  archive.choice(view_mode, ViewMode::kFullScreen);
  // The hash of the state excludes them, because only pictures and reports use them.
  chronicle.archive_places(archive);
}

StateParts Simulation::state_parts() const {
  const auto bytes_of = [this](void (Impl::*part)(StateArchive&), std::size_t before) {
    StateArchive archive;
    archive.reserve(room_for(before));
    ((*impl_).*part)(archive);
    return archive.take();
  };
  StateParts parts;
  parts.world_ = impl_->start_hash();
  parts.seed_ = impl_->world.simulation.seed;
  parts.bodies_ = bytes_of(&Impl::archive_bodies, impl_->bodies_bytes);
  parts.rules_ = bytes_of(&Impl::archive_rules, impl_->rules_bytes);
  parts.pictures_ = bytes_of(&Impl::archive_pictures, impl_->pictures_bytes);
  return parts;
}

void StateParts::append_state(StateArchive& archive, LayerStack& layers) {
  archive.raw(bodies_.data(), bodies_.size());
  layers.archive_base(archive);
  archive.raw(rules_.data(), rules_.size());
}

std::uint64_t StateParts::hash(LayerStack& layers) {
  StateArchive archive;
  archive.reserve(bodies_.size() + rules_.size() + layers.archived_bytes(/*others=*/false));
  append_state(archive, layers);
  return hash_of(archive.written());
}

std::uint64_t StateParts::hash_without_canvas() {
  StateArchive archive;
  archive.reserve(bodies_.size() + rules_.size());
  archive.raw(bodies_.data(), bodies_.size());
  archive.raw(rules_.data(), rules_.size());
  return hash_of(archive.written());
}

Snapshot StateParts::snapshot(LayerStack& layers) {
  return written_snapshot(
      world_, seed_,
      bodies_.size() + rules_.size() + pictures_.size() + layers.archived_bytes(/*others=*/true),
      [&](StateArchive& archive) { append_state(archive, layers); },
      [&](StateArchive& archive) {
        archive.raw(pictures_.data(), pictures_.size());
        layers.archive_others(archive);
      });
}

std::uint64_t Simulation::state_hash() const {
  StateArchive archive;
  archive.reserve(room_for(impl_->bodies_bytes + impl_->rules_bytes) +
                  impl_->layers.archived_bytes(/*others=*/false));
  impl_->archive(archive);
  return hash_of(archive.written());
}

Snapshot Simulation::save() const {
  return written_snapshot(
      impl_->start_hash(), impl_->world.simulation.seed,
      room_for(impl_->bodies_bytes + impl_->rules_bytes + impl_->pictures_bytes) +
          impl_->layers.archived_bytes(/*others=*/true),
      [this](StateArchive& archive) { impl_->archive(archive); },
      [this](StateArchive& archive) {
        impl_->archive_pictures(archive);
        impl_->layers.archive_others(archive);
      });
}

SnapshotReader::SnapshotReader(WorldDescription start, std::uint64_t hash, LogHook log)
    : start_(std::move(start)), hash_(hash), log_(std::move(log)) {}

Simulation SnapshotReader::read(std::span<const std::uint8_t> snapshot) const {
  const SnapshotHeader header = checked_header(snapshot, start_, hash_);
  auto made = std::make_unique<Simulation::Impl>(start_, log_, true);
  made->known_start_hash = hash_;
  StateArchive state(snapshot.subspan(sizeof header, header.state));
  made->archive(state);
  state.expect(state.left() == 0, "no more bytes of state");
  made->bodies_bytes =
      header.state - std::min<std::uint64_t>(header.state, made->layers.archived_bytes(false));
  StateArchive pictures(snapshot.subspan(sizeof header + header.state));
  made->archive_pictures(pictures);
  made->layers.archive_others(pictures);
  pictures.expect(pictures.left() == 0, "no more bytes of pictures");
  return Simulation(std::move(made));
}

SnapshotReader Simulation::snapshot_reader() const {
  return {impl_->start_world(), impl_->start_hash(), impl_->chronicle.log()};
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
  if (before.box2d_since_ns) box2d_since_ns = before.box2d_since_ns;
  chronicle.take_over_from(before.chronicle);
  if (controller) controller->take_over_from(*before.controller, later_ns);
  if (obstacle_motions) obstacle_motions->shift_times(later_ns);
  record(ArenaEventKind::kReset, "world");
  updated.clear();
  invalidate_clearances();
  layers.resize(before.layers.width(), before.layers.height());  // keep the size that clients chose
  before.layers.take_base(layers);
  std::swap(layers, before.layers);  // the caller frees the memory
  view_mode = before.view_mode;
}

void Simulation::restore(std::span<const std::uint8_t> snapshot, RestoreScope scope) {
  static_cast<void>(replace_by(snapshot_reader().read(snapshot), scope));
}

Simulation Simulation::replace_by(Simulation restored, RestoreScope scope) {
  ++interventions_;
  if (scope == RestoreScope::kAll) {
    restored.impl_->layers.take_over_from(impl_->layers);
  } else {
    restored.impl_->take_over_from(*impl_);
  }
  std::swap(impl_, restored.impl_);
  return restored;
}

void Simulation::share_memory_with(const Simulation& other) {
  impl_->physics->share_memory_with(*other.impl_->physics);
}

Simulation Simulation::fork() const {
  return SnapshotReader(impl_->start_world(), impl_->start_hash(), {}).read(save());
}

}  // namespace sim
