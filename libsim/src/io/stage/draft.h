// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/stage/report.h"
#include "io/stage/shapes.h"
#include "sim/core/colour.h"

namespace sim::io::stage {

using Json = nlohmann::ordered_json;

/// The text of a JSON file. Bytes of a path that are not UTF-8 are replaced by U+FFFD.
[[nodiscard]] inline std::string file_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// A device of a robot, and what Player's configuration files may call it.
struct DraftDevice {
  std::string stage_type;  ///< "ranger", "fiducial", ...
  std::string name;        ///< in the world, e.g. "laser2"
  std::string type;        ///< in the world, e.g. "laser"
};

/// A robot on the way from a model of Stage to a robot of a world.
struct RobotDraft {
  std::string stage_name;  ///< that Player's configuration files use, e.g. "r0" or "position:0"
  std::string kind;        ///< name of its definition, e.g. "pioneer2dx"
  Place place;
  Pose X_WB;
  double foot_m = 0.0;  ///< height of its foot above the floor
  bool flat = false;    ///< in a world without heights, see Units
  Colour colour;
  Json model;  ///< of a robot model's file, without its name and its devices
  Json devices = Json::object();
  std::vector<DraftDevice> list;  ///< of devices, in Stage's order
  /// A part of its body: a block or a bitmap of the position model, or of a model on it.
  struct Part {
    std::vector<Vec2> points;  ///< its corners, in B [m]
    double bottom_m = 0.0;     ///< from which on rangers see it, above the floor [m]
    double top_m = 0.0;        ///< up to which rangers see it, above the floor [m]; 0: not at all
    bool solid = true;         ///< whether it meets obstacles
  };
  std::vector<Part> parts;
  Polygon footprint;   ///< after set_body(), in B [m]
  double top_m = 0.0;  ///< of what rangers see, after set_body(), above the floor [m]
  std::vector<double> sensor_heights_m;
  Json robot;  ///< of the world's file: port, interfaces, ...
};

/// Everything that parts of a translation share.
struct Context {
  const Units& units;
  Report& report;
  double interval_s = 0.1;  ///< of Stage's steps: models are updated no more often
};

/// A number for a file: without digits that are only rounding.
[[nodiscard]] double neat(double value);
/// An angle for a key that ends in _deg.
[[nodiscard]] double neat_deg(double angle_rad);
/// `{"x", "y", "yaw_deg"}`.
[[nodiscard]] Json pose_json(const Pose& pose);
/// `[x, y]`.
[[nodiscard]] Json point_json(const Vec2& point);

/// The colour of a model: `color`, `color_rgba`, or the default.
[[nodiscard]] Colour read_colour(const Properties& model, Colour fallback, Report& report);
/// The X11 colour of that name, or the one that Stage uses for unknown names: red.
[[nodiscard]] Colour named_colour(const std::string& name, const Place& place, Report& report);

/// Frequency of a model's updates [Hz]: `update_interval`, rounded up to Stage's steps.
[[nodiscard]] double read_frequency_hz(const Properties& model, const Context& context);

/// Where a child of a model is.
struct Mount {
  Pose X_BM;         ///< pose of the child's frame on the robot
  double z_m = 0.0;  ///< height of its foot above the floor [m]
};

/// Adds the device that a model of Stage is to a robot.
/// @return false if the model is no device.
[[nodiscard]] bool add_device(const Entity& model, const Mount& mount, const Body& body,
                              const Context& context, RobotDraft& robot);

/// Default size of a device's model [m].
[[nodiscard]] std::array<double, 3> device_size_m(const std::string& type);
/// Whether a device's model has a block as large as its size unless it has blocks of its own.
[[nodiscard]] bool device_has_block(const std::string& type);
/// The body of a gripper: what carries its paddles, which are those of the device.
[[nodiscard]] Body gripper_base(const Properties& gripper, const Body& body);
/// Whether an entity of that type is a device of a robot.
[[nodiscard]] bool is_device(const std::string& type);

/// Adds the body of a position model, or of a model on it, to the parts of a robot.
/// @param solid, seen  whether it meets obstacles, and whether rangers see it.
void add_part(const Body& body, const Mount& mount, bool solid, bool seen, RobotDraft& robot);

/// Sets footprint, height and superstructures of a robot's model from its parts. The footprint is
/// the convex outline of all solid parts, or a list of convex parts if these leave gaps in that
/// outline. The height is that up to which all of the outline reaches.
/// Each part that is higher becomes a superstructure with its own outline and height.
void set_body(Report& report, RobotDraft& robot);

/// Whether a robot stands wholly inside an outline in W, without touching it.
[[nodiscard]] bool stands_inside(const RobotDraft& robot, const Polygon& outline);

/// A wall along the inner side of each side of a counter-clockwise outline in W, as obstacles with
/// the other keys of a solid.
[[nodiscard]] std::vector<Json> walls_of(const Polygon& outline, const Json& solid);

/// Reads what a position model is besides a model: drive, limits, localization.
void add_position(const Properties& model, const Body& body, const Context& context,
                  RobotDraft& robot);

}  // namespace sim::io::stage
