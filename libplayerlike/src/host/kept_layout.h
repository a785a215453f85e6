// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "playerlike/host/kept_run.h"

/// What lies where in a KeptRun's memory. Whatever is found there was written by a program that may
/// have written anywhere.
namespace playerlike {

inline constexpr std::uint64_t kKeptMagic = 0x706c617970656e31;  // "playpen1"
inline constexpr std::size_t kKeptHeaderSize = 4096;
/// Of all the memory; the system gives what is used of it.
inline constexpr std::size_t kKeptSize = std::size_t{128} << 20U;
/// A trail that reaches this many points is thinned to every other one.
inline constexpr std::size_t kMostTrailPoints = 8192;
inline constexpr std::size_t kMostKeptBeams = 4096;

/// The beginning of the memory.
struct KeptHeader {
  std::uint64_t magic = 0;               ///< kKeptMagic
  std::atomic<std::uint32_t> phase{0};   ///< a KeptRun::Phase
  std::atomic<std::uint32_t> noted{0};   ///< the first signal that asks for the end; 0: none
  std::atomic<std::int32_t> process{0};  ///< the host's
  // What follows is there if robots > 0. Places are in bytes from the memory's beginning.
  std::atomic<std::uint32_t> robots{0};
  std::array<std::uint64_t, 2> steps{};  ///< places of two KeptStep, each with its KeptRobots
  std::atomic<std::uint32_t> step{0};    ///< which of them is the newest
  std::uint64_t trails = 0;              ///< kMostTrailPoints pairs of x, y a robot
  std::uint64_t scans = 0;               ///< two KeptScan a robot
  std::atomic<std::uint64_t> report{0};  ///< JSON, see kept_text(); its numbers may be old
  std::atomic<std::uint64_t> scene{0};   ///< JSON likewise: what else a picture shows
};
static_assert(sizeof(KeptHeader) <= kKeptHeaderSize);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// Place and size of a text in one number; the place is a multiple of 8.
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
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
  std::int32_t collisions = 0;
  std::uint32_t stalled = 0;
  std::uint32_t trail_points = 0;
  std::uint32_t scan = 0;  ///< 0: none yet; else one more than its index
};

/// The newest scan of a robot's first laser.
struct KeptScan {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;  ///< where the laser was, in W
  double angle_min_rad = 0.0;
  double resolution_rad = 0.0;
  std::uint64_t count = 0;
  std::array<double, kMostKeptBeams> ranges_m;
};

}  // namespace playerlike
