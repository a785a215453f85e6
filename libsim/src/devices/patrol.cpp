// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/patrol.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/io/reader.h"

namespace sim {
namespace {

constexpr double kMostPatrolPlace_m = 1e6;

/// Index of the junction at a place; makes a new one if there is none.
std::size_t junction_at(const Vec2& place_m, std::vector<PatrolMap::Junction>& junctions) {
  const auto known = std::find_if(
      junctions.begin(), junctions.end(),
      [&place_m](const PatrolMap::Junction& junction) { return junction.place_m == place_m; });
  if (known != junctions.end()) return static_cast<std::size_t>(known - junctions.begin());
  junctions.push_back({place_m, {}});
  return junctions.size() - 1;
}

bool read_way(const io::Reader& value, void* into) {
  const std::vector<io::Reader> elements = value.elements();
  std::array<double, 4> numbers{};
  if (elements.size() != numbers.size()) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string text = elements[i].scalar_text().value_or("");
    std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
    if (!elements[i].is_number() || !(std::abs(numbers[i]) <= kMostPatrolPlace_m)) return false;
  }
  PatrolWay& way = *static_cast<PatrolWay*>(into);
  way.from_m = {numbers[0], numbers[1]};
  way.to_m = {numbers[2], numbers[3]};
  return way.from_m != way.to_m;
}

std::string way_text(const void* of) {
  const PatrolWay& way = *static_cast<const PatrolWay*>(of);
  std::string text;
  for (const double number : {way.from_m.x(), way.from_m.y(), way.to_m.x(), way.to_m.y()}) {
    text += (text.empty() ? "[" : ", ") + shortest_text(number);
  }
  return text + ']';
}

}  // namespace

PatrolMap::PatrolMap(const std::vector<PatrolWay>& ways) {
  for (const PatrolWay& way : ways) {
    const std::size_t from = junction_at(way.from_m, junctions);
    const std::size_t to = junction_at(way.to_m, junctions);
    junctions[from].next.push_back(to);
    junctions[to].next.push_back(from);
  }
}

std::size_t PatrolMap::nearest(const Vec2& p_W) const {
  const auto is_nearer = [&p_W](const Junction& a, const Junction& b) {
    return (a.place_m - p_W).squaredNorm() < (b.place_m - p_W).squaredNorm();
  };
  return static_cast<std::size_t>(std::min_element(junctions.begin(), junctions.end(), is_nearer) -
                                  junctions.begin());
}

Patrol::Patrol(std::string name, const PatrolParams& params, RandomStream random)
    : Actuator(std::move(name), "patrol"),
      params_(params),
      map_(params.ways),
      random_(std::move(random)) {}

void Patrol::choose_way() {
  std::vector<std::uint64_t> choices;
  for (const std::size_t next : map_.junctions[goal_].next) {
    if (next != last_) choices.push_back(next);
  }
  if (choices.empty()) choices.push_back(last_);
  const auto choice =
      static_cast<std::size_t>(static_cast<double>(choices.size()) * random_.uniform());
  last_ = std::exchange(goal_, choices[std::min(choice, choices.size() - 1)]);
}

void Patrol::act(RobotControl& robot) {
  if (map_.junctions.empty()) return;
  const Pose& X_WB = robot.body().X_WB;
  if (!started_) {
    started_ = true;
    drives_ = robot.acquire_motors(*this);
    last_ = goal_ = map_.nearest(X_WB.position());
  }
  if (!drives_) return;
  if ((map_.junctions[goal_].place_m - X_WB.position()).norm() < params_.tolerance_m) choose_way();
  const Vec2 way = map_.junctions[goal_].place_m - X_WB.position();
  const double angle = normalize_angle(math::atan2(way.y(), way.x()) - X_WB.yaw_rad);
  robot.drive({std::abs(angle) < params_.turn_first_rad ? params_.speed_mps : 0.0,
               params_.turn_gain_radps * angle});
}

void Patrol::deactivated(RobotControl& robot) {
  if (drives_) robot.drive({});
  drives_ = false;
}

void Patrol::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive(random_, started_, drives_, last_, goal_);
  const std::size_t junctions = std::max<std::size_t>(map_.junctions.size(), 1);
  archive.expect(last_ < junctions && goal_ < junctions, "junctions of the patrol");
}

constexpr ElementType kPatrolWay{
    read_way, way_text,
    R"({"type": "array", "items": {"type": "number"}, "minItems": 4, "maxItems": 4})"};

constexpr Field kPatrolSettings[] = {
    field<&PatrolParams::ways>("ways", "m",
                               "straight ways `[x, y, x, y]` between two junctions in the world; "
                               "equal ends are one junction; none: it stands still")
        .of(kPatrolWay)
        .counting(0, PatrolParams::kMaxWays)
        .with_issue("world/out-of-range", "[x, y, x, y], two different points in m")
        .not_property(),
    field<&PatrolParams::speed_mps>("speed", "m/s", "on its way").above(0.0, 20.0),
    field<&PatrolParams::turn_gain_radps>("turn_gain", "1/s",
                                          "turn rate divided by the angle to its way")
        .above(0.0, 100.0),
    field<&PatrolParams::turn_first_rad>("turn_first_deg", "degrees",
                                         "it turns on the spot while that angle is not smaller; "
                                         "default 0.3 rad")
        .above(0.0, 180.0),
    field<&PatrolParams::tolerance_m>("tolerance", "m",
                                      "distance at which it has reached a junction")
        .above(0.0, 1000.0),
};
SIM_FIELDS(PatrolParams, kPatrolSettings)

DeviceKind patrol_kind() { return device_kind<Patrol, PatrolParams, void>("patrol", {}); }

}  // namespace sim
