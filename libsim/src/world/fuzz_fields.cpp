// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The fields of the section "fuzz" of worlds and tasks.
#include <string>

#include "sim/core/number_text.h"
#include "sim/world/controller.h"
#include "sim/world/fuzz.h"
#include "sim/world/limits.h"
#include "world/motion_fields.h"

namespace sim {
namespace {

using Fuzz = FuzzDescription;

constexpr const char* kFuzzChanges[] = {"starts", "obstacles", "moving", "maps", "blocks", "noise"};
constexpr const char* kFuzzShapes[] = {"box", "circle", "triangle", "door", "corridor"};
constexpr const char* kFuzzMaps[] = {"maze", "rooms"};
constexpr const char* kFuzzExtras[] = {"faults"};
constexpr const char* kFuzzFaults[] = {"dead", "gap", "blind", "jump", "drift"};
constexpr double kLeastPassage_m = 0.02;
constexpr double kGreatestThing_m = 100.0;

constexpr Field kThingFields[] = {
    field<&Fuzz::Obstacles::most>(
        "most", "", "number of things in a scenario, besides the walls of a generated map")
        .within(0, 1000),
    field<&Fuzz::Obstacles::size_m>("size", "m", "sides and diameters")
        .within(0.01, kGreatestThing_m),
    field<&Fuzz::Obstacles::shapes>(
        "shapes", "", "shapes of things that stand: a wall with a door, two parallel walls, ...")
        .one_of(kFuzzShapes)
        .counting(1, std::size(kFuzzShapes)),
};
constexpr Field kPassageFields[] = {
    field<&Fuzz::Passages::width_m>("width", "m", "of the free space between the walls")
        .within(kLeastPassage_m, kGreatestThing_m)
        .defaults_to("from 1.6 to 5 radii of the robot"),
};
constexpr Field kMovingFields[] = {
    field<&Fuzz::Moving::speed_mps>("speed", "m/s", "how fast things move")
        .within(0.01, kMaxObstacleSpeed_mps),
};
constexpr Field kMapsFields[] = {
    field<&Fuzz::Maps::kinds>("kinds", "", "of generated maps")
        .one_of(kFuzzMaps)
        .counting(1, std::size(kFuzzMaps)),
};
constexpr Field kNoiseFields[] = {
    field<&Fuzz::Noise::real>("real", "", "whether runs may have the level `real`"),
    field<&Fuzz::Noise::latency_s>("latency", "s", "of the laser").within(0.0, 10.0),
    field<&Fuzz::Noise::dropouts>("dropouts", "", "share of the laser's beams that are lost")
        .within(0.0, 1.0),
};

constexpr Field kFaultsFields[] = {
    field<&Fuzz::Faults::most>("most", "", "number of faults in a scenario").within(1, 100),
    field<&Fuzz::Faults::kinds>(
        "kinds", "",
        "dead: a device makes no more readings; gap: it makes none for a while; blind: a laser, "
        "sonar or infrared ranger reads its maximum; jump: the odometry's pose jumps; drift: the "
        "odometry measures too much or too little")
        .one_of(kFuzzFaults)
        .counting(1, std::size(kFuzzFaults)),
    field<&Fuzz::Faults::at_s>("at", "s", "when faults begin").within(0.0, kLongestArenaTime_s),
};

constexpr Field kFuzzFields[] = {
    field<&Fuzz::without>("without", "", "what is left as it is")
        .one_of(kFuzzChanges)
        .counting(0, std::size(kFuzzChanges)),
    field<&Fuzz::with>("with", "", "what is changed, too")
        .one_of(kFuzzExtras)
        .counting(0, std::size(kFuzzExtras)),
    field<&Fuzz::area>("area", "",
                       "starts and added things lie in this area, `{\"center\": [x, y], \"size\": "
                       "[x, y]}` along the world's axes")
        .defaults_to("the whole floor"),
    field<&Fuzz::obstacles>("obstacles", "", "things that are added"),
    field<&Fuzz::moving>("moving", "", "things that move"),
    field<&Fuzz::doors>("doors", "", "in walls, also between the rooms of a map"),
    field<&Fuzz::corridors>("corridors", "", "between two walls, also those of a maze"),
    field<&Fuzz::maps>("maps", "", "generated maps"),
    field<&Fuzz::noise>("noise", "", "errors of devices"),
    field<&Fuzz::faults>("faults", "", "faults of devices, with `\"with\": [\"faults\"]`"),
};

std::optional<FieldError> order_error(const char* key, const Vec2& pair) {
  if (pair.x() <= pair.y()) return std::nullopt;
  return FieldError{"world/out-of-range", "[least, greatest]",
                    '[' + shortest_text(pair.x()) + ", " + shortest_text(pair.y()) + ']',
                    "the first number must not be above the second", key};
}

std::optional<FieldError> check_things(const void* object) {
  return order_error("size", static_cast<const Fuzz::Obstacles*>(object)->size_m);
}
std::optional<FieldError> check_passages(const void* object) {
  const auto& width_m = static_cast<const Fuzz::Passages*>(object)->width_m;
  return width_m ? order_error("width", *width_m) : std::nullopt;
}
std::optional<FieldError> check_moving(const void* object) {
  return order_error("speed", static_cast<const Fuzz::Moving*>(object)->speed_mps);
}
std::optional<FieldError> check_noise(const void* object) {
  const auto& noise = *static_cast<const Fuzz::Noise*>(object);
  const auto error = order_error("latency", noise.latency_s);
  return error ? error : order_error("dropouts", noise.dropouts);
}

std::optional<FieldError> check_faults(const void* object) {
  return order_error("at", static_cast<const Fuzz::Faults*>(object)->at_s);
}

}  // namespace

SIM_FIELDS(FuzzDescription::Obstacles, kThingFields, check_things)
SIM_FIELDS(FuzzDescription::Passages, kPassageFields, check_passages)
SIM_FIELDS(FuzzDescription::Moving, kMovingFields, check_moving)
SIM_FIELDS(FuzzDescription::Maps, kMapsFields)
SIM_FIELDS(FuzzDescription::Noise, kNoiseFields, check_noise)
SIM_FIELDS(FuzzDescription::Faults, kFaultsFields, check_faults)
SIM_FIELDS(FuzzDescription, kFuzzFields)

}  // namespace sim
