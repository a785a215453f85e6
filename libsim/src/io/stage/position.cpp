// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/document.h"
#include "io/stage/draft.h"
#include "sim/core/math.h"
#include "sim/core/random_stream.h"
#include "sim/world/robot_model.h"

namespace sim::io::stage {
namespace {

/// The greater bound of a speed, either way.
double bound(double least, double most) { return std::max(std::abs(least), std::abs(most)); }

/// Limits of speeds: `velocity_bounds [xmin xmax ymin ymax zmin zmax amin amax]`.
void add_limits(const Properties& model, const Context& context, RobotDraft& robot) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;  // default of libstage/model_position.cc
  const auto bounds = model.tuple<8>("velocity_bounds", "llllllaa",
                                     {-1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -kQuarter, kQuarter});
  const double speed_mps = std::clamp(bound(bounds[0], bounds[1]), 0.001, 20.0);
  const double turn_deg = std::clamp(neat_deg(bound(bounds[6], bounds[7])), 0.1, 3600.0);
  robot.model["max_speed"] = neat(speed_mps);
  robot.model["max_turn_rate_deg"] = neat(turn_deg);
  Json motion;
  motion["max_speed"] = neat(speed_mps);
  motion["max_turn_rate_deg"] = neat(turn_deg);
  robot.devices["motion"] = std::move(motion);
  if (bounds[0] != -bounds[1] || bounds[6] != -bounds[7]) {
    context.report.note("velocity_bounds", model.place_of("velocity_bounds"),
                        "a robot drives as fast backwards as forwards, and turns as fast to "
                        "either side: the greater bound counts");
  }
  // Stage uses these bounds only for programs that command accelerations.
  static_cast<void>(model.has("acceleration_bounds"));
}

/// `localization "odom"`: odometry with systematic errors, from `localization_origin`.
Json odometry_of(const Properties& model, const Context& context, const RobotDraft& robot) {
  Json odometry = Json::object();
  // Without an odom_error Stage draws one for each robot; here it is the same in each run.
  RandomStream random(1, robot.stage_name);
  const auto draw = [&random](double range) { return (random.uniform() - 0.5) * range; };
  constexpr double kLengths = 0.03;  // defaults of libstage/model_position.cc
  constexpr double kTurns = 0.05;
  const double x_error = draw(kLengths);
  const double y_error = draw(kLengths);
  const double turn_error = draw(kTurns);
  // Shares of the speeds along x, along y and of turning, as in ModelPosition::Update(); Stage
  // reads the last one as an angle.
  const Pose3 error = model.pose("odom_error", {{x_error, y_error, turn_error}});
  const double scale = std::clamp(1.0 + error.pose.x_m, 0.01, 10.0);
  odometry["scale"] = neat(scale);
  odometry["wheelbase_ratio"] = neat(std::clamp(1.0 + error.pose.yaw_rad, 0.5, 2.0));
  if (robot.model["drive"]["kind"] == "omnidirectional") {
    odometry["side_scale"] = neat(std::clamp((1.0 + error.pose.y_m) / scale, 0.0, 1000.0));
  }
  Pose3 origin;
  origin.pose = robot.X_WB;
  origin = model.pose("localization_origin", origin);
  const Pose X_OB = origin.pose.inverse() * robot.X_WB;
  if (math::hypot(X_OB.x_m, X_OB.y_m) > 1e-9 || std::abs(X_OB.yaw_rad) > 1e-9) {
    odometry["start"] = pose_json(X_OB);
  }
  odometry["frequency"] = neat(read_frequency_hz(model, context));
  return odometry;
}

void add_drive(const Properties& model, const Body& body, RobotDraft& robot) {
  const std::size_t drive = model.choice("drive", 0, {"diff", "omni", "car"});
  Json json;
  constexpr const char* kKinds[] = {"differential", "omnidirectional", "car"};
  json["kind"] = kKinds[drive];
  const double width_m = std::clamp(0.85 * body.size_m[1], 0.01, 100.0);
  json["wheel_separation"] = neat(width_m);
  json["wheel_radius"] = neat(std::clamp(0.2 * body.size_m[0], 0.005, 0.2));
  const double wheelbase_m = std::clamp(model.length_m("wheelbase", 1.0), 0.001, 100.0);
  if (drive == 2) {
    json["wheelbase"] = neat(wheelbase_m);
    json["max_steering_deg"] = 79;
    json["commands"] = "steering";
  }
  robot.model["drive"] = std::move(json);
}

/// `joules` and `watts`: a battery.
void add_power(const Properties& model, RobotDraft& robot) {
  double energy_j = model.number("joules", 0.0);
  if (model.has("kjoules")) energy_j = 1000.0 * model.number("kjoules", 0.0);
  double capacity_j = model.number("joules_capacity", energy_j);
  if (model.has("kjoules_capacity")) capacity_j = 1000.0 * model.number("kjoules_capacity", 0.0);
  const double watts = model.number("watts", 0.0);
  if (capacity_j <= 0.0) return;
  constexpr double kJoulesPerWattHour = 3600.0;
  Json battery;
  battery["capacity"] = neat(std::clamp(capacity_j / kJoulesPerWattHour, 1e-6, 100000.0));
  battery["initial_charge"] = neat(std::clamp(100.0 * energy_j / capacity_j, 0.0, 100.0));
  battery["idle_power"] = neat(std::clamp(watts, 0.0, 10000.0));
  battery["drive_power"] = neat(std::clamp(10.0 * robot.model["mass"].get<double>(), 0.0, 10000.0));
  robot.devices["battery"] = std::move(battery);
  robot.list.push_back({"power", "battery", "battery"});
}

/// Controllers of Stage are libraries for Stage. "wander" is built in.
void add_controller(const Properties& model, const Context& context, RobotDraft& robot) {
  if (!model.has("ctrl")) return;
  const std::vector<std::string> names = model.texts("ctrl");
  for (const std::string& name : names) {
    const std::string library = name.substr(0, name.find(' '));
    if (library == "wander") {
      const auto laser =
          std::find_if(robot.list.begin(), robot.list.end(), [&](const auto& device) {
            return device.type == "laser" && robot.devices[device.name]["beams"] > 8;
          });
      if (laser == robot.list.end()) {
        context.report.note("wander", model.place_of("ctrl"),
                            "\"wander\" needs a ranger of more than 8 samples; this robot stands");
        continue;
      }
      robot.devices["wander"] = {{"laser", laser->name}};
    } else {
      context.report.note(
          "ctrl " + library, model.place_of("ctrl"),
          "the controller " + in_quotes(library) +
              " is a library for Stage; write it as a client program (playpen new)");
    }
  }
}

}  // namespace

void add_position(const Properties& model, const Body& body, const Context& context,
                  RobotDraft& robot) {
  constexpr double kDefaultMass_kg = 10.0;  // Stage has none, and does not use it for collisions
  const double mass_kg = model.number("mass", kDefaultMass_kg);
  robot.model["mass"] = neat(std::clamp(mass_kg > 0.0 ? mass_kg : kDefaultMass_kg, 0.001, 10000.0));
  add_drive(model, body, robot);
  add_limits(model, context, robot);
  // libstage/model_position.cc: "gps" reports the pose in the world, whatever the origin is.
  const bool odometric = model.choice("localization", 0, {"gps", "odom"}) == 1;
  robot.devices["pose"] = {{"frequency", neat(read_frequency_hz(model, context))}};
  robot.devices["odometry"] = odometric ? odometry_of(model, context, robot) : Json::object();
  static_cast<void>(model.has("localization_origin"));
  static_cast<void>(model.has("odom_error"));
  robot.devices["pen"] = Json::object();
  robot.devices["speech"] = Json::object();
  robot.robot["interfaces"]["position2d"] =
      odometric ? Json::array({"odometry", "pose"}) : Json::array({"pose", "odometry"});
  add_power(model, robot);
  add_controller(model, context, robot);
  const auto velocity = model.tuple<4>("velocity", "llla", {0.0, 0.0, 0.0, 0.0});
  if (std::any_of(velocity.begin(), velocity.end(), [](double v) { return v != 0.0; })) {
    context.report.note("velocity", model.place_of("velocity"),
                        "a robot stands until it is commanded (velocity is left out)");
  }
  if (model.has("odom")) {
    context.report.note("odom", model.place_of("odom"),
                        "odom is left out: Stage has replaced it by localization_origin");
  }
}

}  // namespace sim::io::stage
