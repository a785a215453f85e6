// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "playerlike/host/kept_run.h"

/// The layout of a KeptRun's memory. Readers must validate everything: the program may have
/// overwritten any part of it. apps/playpen/playpen_gdb.py reads it, too.
namespace playerlike {

inline constexpr std::uint64_t kKeptMagic = 0x706c617970656e31;  // "playpen1"
/// Why a run with KeptHeader::conflict may not be repeatable.
inline constexpr const char* kConflictWhy = "another program requested the world and was refused";
inline constexpr std::size_t kKeptHeaderSize = 4096;
/// Maximum length of a trail; at this length every second point is removed.
inline constexpr std::size_t kMostTrailPoints = 8192;
inline constexpr std::size_t kMostKeptBeams = 4096;
inline constexpr std::size_t kMostKeptPorts = 8;

/// What a program prints into the pipe to its supervisor, see PrintedBytes. The supervisor writes
/// it.
struct PrintedCount {
  std::atomic<std::uint64_t> pipe{0};   ///< inode of the pipe; 0: there is none
  std::atomic<std::uint64_t> limit{0};  ///< the rest is not in the file of the output [bytes]
  std::atomic<std::uint64_t> taken{0};  ///< read from the pipe so far [bytes]
  std::atomic<std::uint32_t> reads{0};  ///< sequence lock: odd while the supervisor reads
};

/// The header of the memory.
struct KeptHeader {
  std::uint64_t magic = 0;                 ///< kKeptMagic
  std::atomic<std::uint32_t> phase{0};     ///< a KeptRun::Phase
  std::atomic<std::uint32_t> noted{0};     ///< the first signal that requested the end; 0: none
  std::atomic<std::int32_t> process{0};    ///< process id of the host
  std::atomic<std::uint32_t> conflict{0};  ///< nonzero after KeptRun::note_conflict()
  // For KeptRun::progress().
  std::atomic<std::uint64_t> made_steps{0};
  std::atomic<std::int64_t> now_ns{0};
  // The following is valid if robots > 0. Places are offsets from the beginning of the memory
  // [bytes].
  std::atomic<std::uint32_t> robots{0};
  std::array<std::uint64_t, 2> steps{};  ///< two KeptStep, each with its KeptRobots
  std::atomic<std::uint32_t> step{0};    ///< index of the newest one
  std::uint64_t trails = 0;              ///< kMostTrailPoints pairs of x, y for each robot
  std::uint64_t scans = 0;               ///< two KeptScan for each robot
  std::atomic<std::uint64_t> report{0};  ///< JSON, see kept_text(); its numbers may be outdated
  std::atomic<std::uint64_t> scene{0};   ///< JSON: the other contents of a picture
  std::atomic<std::uint64_t> motors{0};  ///< JSON: a list of RealMotors, also if robots is 0
  PrintedCount printed;
};
static_assert(sizeof(KeptHeader) <= kKeptHeaderSize);
// As in playpen_gdb.py.
static_assert(offsetof(KeptHeader, made_steps) == 24 && offsetof(KeptHeader, robots) == 40 &&
              offsetof(KeptHeader, step) == 64 && offsetof(KeptHeader, report) == 88);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// Packs place and size of a text into one number; the place is a multiple of 8.
[[nodiscard]] constexpr std::uint64_t kept_text(std::uint64_t place, std::uint64_t size) noexcept {
  return place / 8 << 32U | size;
}
[[nodiscard]] constexpr std::uint64_t place_of_text(std::uint64_t text) noexcept {
  return (text >> 32U) * 8;
}
[[nodiscard]] constexpr std::uint64_t size_of_text(std::uint64_t text) noexcept {
  return text & 0xffffffffU;
}

struct KeptStep {
  std::uint64_t steps = 0;
  std::int64_t now_ns = 0;
  double wall_time_s = 0.0;
  double real_time_factor = 0.0;
};

struct KeptRobot {
  double path_length_m = 0.0;
  double least_clearance_m = 0.0;
  double stalled_time_s = 0.0;
  double driven_time_s = 0.0;
  double distance_m = 0.0;       ///< TravelMeter::distance_m()
  double visited_area_m2 = 0.0;  ///< TravelMeter::visited_area_m2()
  std::uint64_t commands = 0;    ///< CommandBook::Entry, as the next two
  std::int64_t first_command_ns = 0;
  std::array<std::int32_t, kMostKeptPorts> ports{};  ///< 0: no further one
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  std::int32_t collisions = 0;
  std::uint32_t stalled = 0;
  std::uint32_t trail_points = 0;
  std::uint32_t scan = 0;  ///< 0: none yet; otherwise its index plus one
  double forward_mps = 0.0, left_mps = 0.0, turn_radps = 0.0;  ///< sim::BodyState::twist
};
// As in playpen_gdb.py.
static_assert(sizeof(KeptStep) == 32 && sizeof(KeptRobot) == 160 &&
              offsetof(KeptRobot, x_m) == 96 && offsetof(KeptRobot, stalled) == 124 &&
              offsetof(KeptRobot, forward_mps) == 136);

/// The newest scan of a robot's first laser.
struct KeptScan {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;  ///< pose of the laser in W
  double angle_min_rad = 0.0;
  double resolution_rad = 0.0;
  std::uint64_t count = 0;
  std::array<double, kMostKeptBeams> ranges_m;
};

}  // namespace playerlike
