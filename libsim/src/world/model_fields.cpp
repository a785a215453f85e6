// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The fields of robot models.
#include "sim/world/limits.h"
#include "sim/world/robot_model.h"
#include "world/world_fields.h"

namespace sim {
namespace {

constexpr double kMaxVertex_m = 100.0;
constexpr std::size_t kMostPartVertices = 8;  // Box2D's limit for polygons

template <auto kMember>
[[nodiscard]] constexpr Field wheel_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning).within(kLeastLength_m, 100.0);
}
template <auto kMember>
[[nodiscard]] constexpr Field vertices_field(const char* name, const char* meaning) {
  return field<kMember>(name, "m", meaning)
      .within(-kMaxVertex_m, kMaxVertex_m)
      .counting(3, kMostPartVertices)
      .needed("the outline: a list of points [x, y] round it, in m");
}

using Drive = DriveDescription;
constexpr const char* kDriveWords[] = {"differential", "omnidirectional", "car"};
constexpr const char* kSteeringWords[] = {"turn_rate", "steering"};
constexpr Field kWheels[] = {
    wheel_field<&Drive::wheel_radius_m>("wheel_radius", "radius of its wheels"),
    wheel_field<&Drive::wheel_separation_m>("wheel_separation",
                                            "distance between the planes of its wheels"),
};
constexpr Field kCar[] = {
    part<kWheels>(),
    wheel_field<&Drive::wheelbase_m>("wheelbase",
                                     "of a car: distance from the rear axle to the front axle"),
    field<&Drive::max_steering_rad>("max_steering_deg", "degrees",
                                    "of a car: maximum steering angle in both directions")
        .above(0.0, 80.0),
    field<&Drive::max_steering_rate_radps>("max_steering_rate_deg", "degrees/s",
                                           "of a car: how fast the front wheels turn; 0: at once")
        .within(0.0, 3600.0),
    field<&Drive::steering_commands>(
        "commands", "",
        "of a car; turn_rate: the second number of `SetSpeed` is a turn rate, and the speed is "
        "that of the rear axle; steering: it is the angle of the front wheels, and the speed is "
        "theirs, as in Stage")
        .one_of(kSteeringWords, false),
};
constexpr Field kDriveDescription[] = {
    field<&Drive::kind>("kind", "", "motions that the wheels permit").one_of(kDriveWords),
    part<kCar>(),
};
constexpr Kind kDriveKinds[] = {
    kind<Drive, &Drive::kind, DriveKind::kDifferential, kWheels>("differential", ""),
    kind<Drive, &Drive::kind, DriveKind::kOmnidirectional, kWheels>("omnidirectional", ""),
    kind<Drive, &Drive::kind, DriveKind::kCar, kCar>("car", ""),
};

constexpr Field kSuperstructureFields[] = {
    field<&Superstructure::bottom_m>(
        "bottom", "m",
        "height of its lower side; lasers, sonars and other sensors of distances look under it")
        .within(0.0, kGreatestRobotHeight_m),
    vertices_field<&Superstructure::outline>("outline",
                                             "convex outline: its corners [x, y] in order, in the "
                                             "frame of the footprint"),
    field<&Superstructure::height_m>(
        "height", "m", "height of its top above the floor, greater than that of the body")
        .within(kLeastLength_m, kGreatestRobotHeight_m)
        .needed("the height of its top above the floor, in m"),
};

constexpr Field kPolygonItself[] = {
    field_itself<Polygon>().within(-kMaxVertex_m, kMaxVertex_m).counting(3, kMostPartVertices)};

// The devices have tables of their own (sim/devices/builtin.h).
constexpr Field kModelFields[] = {
    field<&RobotModel::name>("name", "", "name of the model, as programs get it")
        .as_name()
        .needed("what to call the model"),
    field<&RobotModel::description>("description", "", "a sentence for people").not_identity(),
    vertices_field<&RobotModel::footprint>(
        "footprint",
        "convex outline of the robot: its corners [x, y] in order, x ahead and y to the left from "
        "the centre of the axle (of a car: the rear axle); of a robot that is not convex: 2 to 16 "
        "such outlines, which together are its body")
        .in_format(io::kFootprintFormat),
    field<&RobotModel::parts>("parts").counting(2, kMostBodyParts).as_read_only(),
    field<&RobotModel::solid>("solid", "",
                              "`false`: nothing collides with the robot; sensors see it"),
    field<&RobotModel::height_m>("height", "m", "sensors that are mounted lower see the robot")
        .within(kLeastLength_m, kGreatestRobotHeight_m),
    field<&RobotModel::superstructures>(
        "superstructures", "",
        "what is higher than the body; sensors above the body see it, and nothing collides with it")
        .counting(0, kMostSuperstructures)
        .in_format(io::kSuperstructureFormat),
    field<&RobotModel::mass_kg>("mass", "kg", "it determines how hard the robot is to push")
        .within(kLeastMass_kg, kGreatestMass_kg),
    field<&RobotModel::drive>("drive", "", "its wheels")
        .defaults_to("differential")
        .in_format(io::kDriveFormat),
    field<&RobotModel::max_speed_mps>(
        "max_speed", "m/s", "maximum speed of the robot; its motion device has a separate limit")
        .above(0.0, 20.0),
    field<&RobotModel::max_turn_rate_radps>("max_turn_rate_deg", "degrees/s",
                                            "maximum turn rate of the robot")
        .above(0.0, 3600.0),
    key_of_files<std::map<std::string, std::string>>(
        "devices", "",
        "its devices by name, with settings as in worlds, and a `type` unless the name is a type")
        .in_format(io::kModelDevicesFormat),
    field<&RobotModel::interfaces>(
        "interfaces", "",
        "names of devices of an [interface](world_format.md#interfaces) in the order of their "
        "index on the robot's port")
        .in_format(io::kInterfacesFormat)
        .read_apart()
        .not_identity(),
};

}  // namespace

SIM_FIELDS(DriveDescription, kDriveDescription)
SIM_FIELDS(Superstructure, kSuperstructureFields)
SIM_FIELDS(Polygon, kPolygonItself)
SIM_FIELDS(RobotModel, kModelFields)

std::span<const Kind> drive_kinds() { return kDriveKinds; }

}  // namespace sim
