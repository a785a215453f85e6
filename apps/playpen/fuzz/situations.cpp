// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/situations.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>

#include "sim/core/pose.h"

namespace playpen::fuzz {
namespace {

constexpr int kSides = 4;  // ahead, left, behind, right
constexpr double kFar_m = kFarthestRoom_m;
constexpr double kBeside_rad = 0.5;  // between the rays of a side
constexpr double kNear_m = 0.12;     // room at the robot's body
constexpr double kMiddle_m = 0.3;
constexpr double kLook_s = 0.5;  // between situations
constexpr double kDriving_mps = 0.03;

// The distance from a place to something solid in a direction, at most kFar_m, by steps of the
// distance to the nearest solid.
double free_m(const sim::DistanceField& field, const sim::Vec2& from, double angle_rad) {
  const sim::Vec2 way = sim::unit_vector(angle_rad);
  double driven_m = 0.0;
  while (driven_m < kFar_m) {
    const double room_m = room_at(field, from + driven_m * way);
    if (room_m < field.cell_size_m) return driven_m;
    driven_m += room_m;
  }
  return kFar_m;
}

// The free distance on each side of the robot, from its middle.
std::array<double, kSides> rooms_m(const sim::DistanceField& field, const sim::Pose& X_WB) {
  std::array<double, kSides> rooms{};
  for (int k = 0; k < kSides; ++k) {
    double& room_m = rooms[static_cast<std::size_t>(k)] = kFar_m;
    for (const double beside_rad : {-kBeside_rad, 0.0, kBeside_rad}) {
      const double angle_rad = X_WB.yaw_rad + 2.0 * std::numbers::pi * k / kSides + beside_rad;
      room_m = std::min(room_m, free_m(field, X_WB.position(), angle_rad));
    }
  }
  return rooms;
}

std::uint32_t level(double value, double low, double high) {
  return value < low ? 0U : value < high ? 1U : 2U;
}

const grade::Trajectory* way_of(const RunResult& result, const Base& base) {
  const auto way = std::ranges::find(result.trajectories, base.robot_description().name,
                                     &grade::Trajectory::robot);
  return way == result.trajectories.end() ? nullptr : &*way;
}

// Those around the robot have a clear highest bit, those that are printed a set one.
constexpr Situations::Id kPrinted = Situations::Id{1} << 63U;

// The hash FNV-1a of a line without its numbers (http://www.isthe.com/chongo/tech/comp/fnv).
Situations::Id hash_of(std::string_view line) {
  Situations::Id hash = 0xcbf29ce484222325U;
  for (const char c : line) {
    if ((c >= '0' && c <= '9') || c == '.' || c == '-') continue;
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

void add_printed(std::string_view text, std::set<Situations::Id>& all) {
  std::map<Situations::Id, std::size_t> counts;
  Situations::Id before = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const Situations::Id line = hash_of(text.substr(0, end));
    ++counts[(before * 31 + line) & ~(kPrinted | 0xffU)];
    before = line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  for (const auto& [pair, count] : counts) {
    for (int power = 0; power < static_cast<int>(std::bit_width(count)); ++power) {
      all.insert(kPrinted | pair | static_cast<Situations::Id>(power));
    }
  }
}

}  // namespace

std::vector<Situations::Id> Situations::of(const RunResult& result, const Base& base,
                                           const Base::World& world) {
  std::set<Id> all;
  add_printed(result.printed, all);
  const grade::Trajectory* const way = way_of(result, base);
  double next_s = 0.0;
  for (std::size_t i = 0; way != nullptr && i < way->time_s.size(); ++i) {
    if (way->time_s[i] < next_s) continue;
    next_s = way->time_s[i] + kLook_s;
    std::uint32_t situation = 0;
    for (const double room_m : rooms_m(world.room, way->X_WB[i])) {
      situation = 3 * situation + level(room_m - base.robot_radius_m(), kNear_m, kMiddle_m);
    }
    situation = 3 * situation + level(way->v_mps[i], -0.02, 0.05);
    situation = 3 * situation + level(way->omega_radps[i], -0.3, 0.3);
    all.insert(situation);
  }
  return {all.begin(), all.end()};
}

std::size_t Situations::add(const std::vector<Id>& situations) {
  const std::size_t before = runs_.size();
  for (const Id one : situations) ++runs_[one];
  return runs_.size() - before;
}

std::size_t Situations::runs_of_rarest(const std::vector<Id>& situations) const {
  std::size_t least = 0;
  for (const Id one : situations) {
    const auto found = runs_.find(one);
    if (found != runs_.end() && (least == 0 || found->second < least)) least = found->second;
  }
  return least;
}

double least_room_m(const RunResult& result, const Base& base, const Base::World& world) {
  double least_m = std::numeric_limits<double>::infinity();
  const grade::Trajectory* const way = way_of(result, base);
  double next_s = 0.0;
  for (std::size_t i = 0; way != nullptr && i < way->time_s.size(); ++i) {
    if (way->time_s[i] < next_s) continue;
    next_s = way->time_s[i] + kLook_s;
    const auto rooms = rooms_m(world.room, way->X_WB[i]);
    least_m = std::min(least_m, std::accumulate(rooms.begin(), rooms.end(), 0.0) / kSides);
  }
  return least_m;
}

double least_time_to_contact_s(const RunResult& result, const Base& base,
                               const Base::World& world) {
  double least_s = std::numeric_limits<double>::infinity();
  const grade::Trajectory* const way = way_of(result, base);
  for (std::size_t i = 0; way != nullptr && i < way->time_s.size(); ++i) {
    const double speed_mps = way->v_mps[i];
    if (std::abs(speed_mps) < kDriving_mps) continue;
    const double ahead_rad = way->X_WB[i].yaw_rad + (speed_mps < 0.0 ? std::numbers::pi : 0.0);
    const double free = free_m(world.room, way->X_WB[i].position(), ahead_rad);
    if (free >= kFar_m) continue;
    least_s = std::min(least_s, std::max(free - base.robot_radius_m(), 0.0) / std::abs(speed_mps));
  }
  return least_s;
}

}  // namespace playpen::fuzz
