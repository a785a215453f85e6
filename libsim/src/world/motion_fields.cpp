// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The fields of obstacles' motions.
#include "world/motion_fields.h"

#include <numbers>

#include "sim/world/controller.h"
#include "sim/world/limits.h"
#include "sim/world/obstacle_motion.h"

namespace sim {
namespace {

using Motion = ObstacleMotion;

constexpr const char* kMotionLaws[] = {"stand", "path", "random_walk", "pedestrian"};
constexpr const char* kFacings[] = {"fixed", "forward"};
constexpr const char* kRepeats[] = {"once", "back_and_forth", "round", "random"};
constexpr std::span kPathRepeats = std::span(kRepeats).first(3);

constexpr Field kAreaFields[] = {
    field<&Motion::Area::center>("center", "m", "middle of the area")
        .within(-kFarthest_m, kFarthest_m)
        .needed("[x, y] of the middle of the area, in m"),
    field<&Motion::Area::size>("size", "m", "its sides along x and y")
        .within(kLeastLength_m, kGreatestLength_m)
        .needed("[x, y]: the sides of the area, in m"),
};

constexpr Field kForceFields[] = {
    field<&SocialForce::relaxation_s>("relaxation_time", "s",
                                      "in which it reaches its desired velocity")
        .within(0.01, 100.0),
    field<&SocialForce::repulsion_m2ps2>("repulsion", "m^2/s^2",
                                         "strength of its repulsion by pedestrians and robots")
        .within(0.0, 1000.0),
    field<&SocialForce::repulsion_range_m>("repulsion_range", "m", "range of that repulsion")
        .within(kLeastLength_m, 100.0),
    field<&SocialForce::wall_repulsion_m2ps2>("wall_repulsion", "m^2/s^2",
                                              "strength of its repulsion by solids")
        .within(0.0, 1000.0),
    field<&SocialForce::wall_range_m>("wall_range", "m", "range of that repulsion")
        .within(kLeastLength_m, 100.0),
};

constexpr Field kDriveFields[] = {
    field<&Motion::speed_mps>("speed", "m/s", "how fast it moves; a pedestrian by default 1.34")
        .above(0.0, kMaxObstacleSpeed_mps),
    field<&Motion::turn_rate_radps>("turn_rate_deg", "degrees/s", "how fast it turns")
        .above(0.0, kMaxObstacleTurnRate_radps * 180.0 / std::numbers::pi),
    field<&Motion::faces_way>("facing", "",
                              "forward: its x axis points where it goes; fixed: it does not turn")
        .one_of(kFacings, false),
};

constexpr Field kWait =
    field<&Motion::wait_s>("wait", "s", "how long it stops at each point or after each leg")
        .within(0.0, kLongestArenaTime_s);
constexpr Field kWaypoints =
    field<&Motion::points>("points", "m", "points [x, y] that its center goes to, from where it is")
        .within(-kFarthest_m, kFarthest_m)
        .counting(1, 1000)
        .with_issue("world/out-of-range", "at least one point [x, y]");
constexpr Field kNeededWaypoints = kWaypoints.needed("a list of points [x, y] to go to, in m");
constexpr Field kRepeat =
    field<&Motion::repeat>(
        "repeat", "",
        "what follows the last point: it stays there; or it goes back along the points to its "
        "start, and again; or it goes to its start and round again; or, for pedestrians, any "
        "other point follows")
        .one_of(kPathRepeats);
constexpr Field kFinalYaw =
    field<&Motion::final_yaw_rad>("yaw_deg", "degrees", "it turns to this angle at the end")
        .within(-3600.0, 3600.0);
constexpr Field kLeg =
    field<&Motion::leg_m>("leg", "m", "mean length of a leg, from half to one and a half of it")
        .within(kLeastLength_m, kGreatestLength_m);
constexpr Field kWalkArea =
    field<&Motion::area>(
        "area", "",
        "it stays in this area, `{\"center\": [x, y], \"size\": [x, y]}` along the "
        "world's axes")
        .defaults_to("the whole floor");
constexpr Field kForce = field<&Motion::force>("force", "", "constants of the social-force model");

constexpr Field kMovePath[] = {kRepeat, kWait};
constexpr Field kMove[] = {
    part<kDriveFields>(),
    key_of_files<bool>("stop", "", "it stops; not with `to`, `path` or `yaw_deg`"),
    key_of_files<Vec2>("to", "m", "point [x, y] that it moves to")
        .within(-kFarthest_m, kFarthest_m),
    kWaypoints.with<&Field::name>("path").with<&Field::meaning>(
        "points [x, y] that it moves along, from where it is; not with `to`"),
    part<kMovePath>(),
    kFinalYaw,
};
constexpr Field kPath[] = {part<kDriveFields>(), kWait, kNeededWaypoints, kRepeat};
constexpr Field kRandomWalk[] = {part<kDriveFields>(), kWait, kLeg, kWalkArea};
constexpr Field kPedestrian[] = {part<kDriveFields>(), kWait, kNeededWaypoints,
                                 kRepeat.one_of(kRepeats), kForce};

constexpr Kind kPedestrianKind = [] {
  Kind made = kind<Motion, &Motion::law, MotionLaw::kPedestrian, kPedestrian>(
      "pedestrian", "to points, by the social-force model");
  made.make = [](void* motion) -> void* {
    auto& pedestrian = *static_cast<Motion*>(motion);
    pedestrian.law = MotionLaw::kPedestrian;
    pedestrian.speed_mps = 1.34;  // the mean desired speed of the paper
    return motion;
  };
  return made;
}();
constexpr Kind kMotionKinds[] = {
    kind<Motion, &Motion::law, MotionLaw::kPath, kPath>("path", "along points"),
    kind<Motion, &Motion::law, MotionLaw::kRandomWalk, kRandomWalk>(
        "random_walk", "straight legs of random direction and length, from the run's seed"),
    kPedestrianKind,
};

// All that a motion may have.
constexpr Field kMotionFields[] = {
    field<&Motion::law>("type").one_of(kMotionLaws),
    part<kDriveFields>(),
    kWait,
    kWaypoints,
    kRepeat.one_of(kRepeats),
    kFinalYaw,
    kLeg,
    kWalkArea,
    kForce,
};

}  // namespace

SIM_FIELDS(ObstacleMotion::Area, kAreaFields)
SIM_FIELDS(SocialForce, kForceFields)
SIM_FIELDS(ObstacleMotion, kMotionFields)

std::span<const Kind> motion_kinds() { return kMotionKinds; }

const FieldTable& drive_fields() {
  static constexpr FieldTable kTable = {kDriveFields};
  return kTable;
}

const FieldTable& path_fields() {
  static constexpr FieldTable kTable = {kMovePath};
  return kTable;
}

const FieldTable& move_fields() {
  static constexpr FieldTable kTable = {kMove};
  return kTable;
}

}  // namespace sim
