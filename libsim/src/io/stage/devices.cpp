// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>
#include <utility>

#include "io/document.h"
#include "io/stage/colours.h"
#include "io/stage/draft.h"
#include "sim/world/limits.h"

namespace sim::io::stage {
namespace {

/// A transducer of a ranger.
struct Transducer {
  Pose3 mount;
  double size_z_m = 0.02;  // defaults: ModelRanger::Sensor of libstage/stage.hh
  double range_min_m = 0.0;
  double range_max_m = 5.0;
  double view_rad = 0.1;
  int samples = 1;
  double noise_variance = 0.0;
  double noise_share = 0.0;
  Place place;
};

/// Adds a device with a name of its own: "laser", "laser2", ...
std::string add(RobotDraft& robot, const std::string& stage_type, const std::string& type,
                Json settings) {
  std::string name = type;
  for (int number = 2; robot.devices.contains(name); ++number) {
    name = type + std::to_string(number);
  }
  if (name != type) settings["type"] = type;
  if (robot.flat && settings.contains("height")) {
    settings["height"] = type == "sonar" ? kFlatSonar_m : kFlatSensor_m;
  }
  robot.devices[name] = std::move(settings);
  robot.list.push_back({stage_type, name, type});
  return name;
}

double clamped(double value, double least, double most) {
  return std::isfinite(value) ? std::clamp(value, least, most) : most;
}

double height_of(double z_m) { return neat(clamped(z_m, 0.0, 100.0)); }
double range_of(double range_m) { return neat(clamped(range_m, 0.001, 1000.0)); }
double view_deg(double view_rad, double most_deg) {
  return neat(clamped(neat_deg(std::abs(view_rad)), 0.01, most_deg));
}

Transducer read_sensor(const Properties& sensor, const Context& context) {
  Transducer read;
  read.place = sensor.entity().place;
  read.mount = sensor.pose("pose");
  read.size_z_m = sensor.tuple<3>("size", "lll", {0.02, 0.02, 0.02})[2];
  const auto range = sensor.tuple<2>("range", "ll", {0.0, 5.0});
  read.range_min_m = range[0];
  read.range_max_m = range[1];
  read.view_rad = sensor.angle_rad("fov", 0.1);
  read.samples = sensor.integer("samples", 1);
  const auto noise = sensor.tuple<3>("noise", "lfa", {0.0, 0.0, 0.0});
  read.noise_variance = std::max(0.0, noise[0]);
  read.noise_share = std::max(0.0, noise[1]);
  if (noise[2] != 0.0) {
    context.report.note("noise of directions", sensor.place_of("noise"),
                        "noise of a ranger's directions is left out");
  }
  return read;
}

/// The transducers of Stage 2: `scount`, `spose[0]`, `sview [min max fov]`.
std::vector<Transducer> read_old_sensors(const Properties& ranger, const Context& context) {
  std::vector<Transducer> all;
  const int count = ranger.integer("scount", 0);
  if (count < 1 || count > 1000) {
    context.report.error(ranger.place_of("scount"), "stage/bad-ranger", "1 to 1000 transducers",
                         std::to_string(count));
    return all;
  }
  const auto common = ranger.tuple<3>("sview", "lla", {0.0, 5.0, 0.1});
  static_cast<void>(ranger.has("ssize"));
  for (int i = 0; i < count; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    Transducer read;
    read.place = ranger.place_of("spose" + index);
    const std::vector<double> pose = ranger.numbers("spose" + index, 4);
    const double length_m = context.units.length_m;
    if (!pose.empty()) read.mount.pose.x_m = pose[0] * length_m;
    if (pose.size() > 1) read.mount.pose.y_m = pose[1] * length_m;
    if (pose.size() > 2) read.mount.pose.yaw_rad = pose.back() * context.units.angle_rad;
    if (pose.size() > 3) read.mount.z_m = pose[2] * length_m;
    const auto view = ranger.tuple<3>("sview" + index, "lla", common);
    read.range_min_m = view[0];
    read.range_max_m = view[1];
    read.view_rad = view[2];
    all.push_back(read);
  }
  return all;
}

/// What a device tells programs, besides its ranges, as InterfaceRanger of
/// libstageplugin/p_ranger.cc.
void add_reports(const Transducer& transducer, Json& settings) {
  if (transducer.range_min_m > 0.0) {
    settings["range_min"] = neat(clamped(transducer.range_min_m, 0.0, 1000.0));
  }
  settings["intensity"] = 1.0;  // Stage's default of ranger_return
}

void add_scanner(const std::string& stage_type, const Transducer& transducer, const Mount& mount,
                 double frequency_hz, const Body& body, const Context& context, RobotDraft& robot) {
  constexpr int kMostBeams = 8192;
  int beams = transducer.samples;
  if (beams < 1 || beams > kMostBeams) {
    context.report.error(transducer.place, "stage/bad-ranger",
                         "1 to " + std::to_string(kMostBeams) + " samples", std::to_string(beams));
    return;
  }
  const double full_rad = 2.0 * std::numbers::pi;
  const double view_rad = std::min(std::abs(transducer.view_rad), full_rad);
  const double height_m = mount.z_m + transducer.mount.z_m + 0.5 * transducer.size_z_m;
  Json laser;
  laser["frequency"] = neat(frequency_hz);
  laser["beams"] = beams;
  laser["resolution_deg"] =
      clamped(view_rad * 180.0 / std::numbers::pi / std::max(1, beams - 1), 0.0001, 360.0);
  laser["range_max"] = range_of(transducer.range_max_m);
  add_reports(transducer, laser);
  laser["pose"] = pose_json(mount.X_BM * transducer.mount.pose);
  laser["height"] = height_of(height_m);
  laser["size"] = Json::array({neat(body.size_m[0]), neat(body.size_m[1])});
  laser["size_height"] = neat(body.size_m[2]);
  if (transducer.noise_variance > 0.0) laser["noise"] = neat(std::sqrt(transducer.noise_variance));
  if (transducer.noise_share > 0.0) {
    // Stage's share is uniformly distributed between -share and share.
    laser["noise_share"] = neat(std::min(1.0, transducer.noise_share / std::sqrt(3.0)));
  }
  robot.sensor_heights_m.push_back(height_m);
  add(robot, stage_type, "laser", std::move(laser));
}

/// Direction of a transducer's first sample, which is its only one in a ring.
Pose first_ray(const Transducer& transducer) {
  Pose X_MS = transducer.mount.pose;
  if (transducer.samples > 1) {
    X_MS.yaw_rad = normalize_angle(X_MS.yaw_rad - 0.5 * transducer.view_rad);
  }
  return X_MS;
}

/// Transducers with one ray each, or none: a sonar. Programs see the settings of the first one.
void add_ring(const std::vector<Transducer>& transducers, const Mount& mount, double frequency_hz,
              const Context& context, RobotDraft& robot) {
  const Transducer first = transducers.empty() ? Transducer{} : transducers.front();
  Json sonar;
  double range_max_m = transducers.empty() ? first.range_max_m : 0.0;
  double variance = 0.0;
  double share = 0.0;
  Json mounts = Json::array();
  std::vector<double> ranges_m;
  std::vector<double> heights_m;
  for (const Transducer& transducer : transducers) {
    if (mounts.size() == kMostTransducers) {
      context.report.note("transducers", transducer.place,
                          "a ring of at most " + std::to_string(kMostTransducers) +
                              " transducers; further ones are left out");
      break;
    }
    ranges_m.push_back(range_of(transducer.range_max_m));
    heights_m.push_back(height_of(mount.z_m + transducer.mount.z_m + 0.5 * transducer.size_z_m));
    robot.sensor_heights_m.push_back(heights_m.back());
    range_max_m = std::max(range_max_m, transducer.range_max_m);
    variance = std::max(variance, transducer.noise_variance);
    share = std::max(share, transducer.noise_share);
    mounts.push_back(pose_json(mount.X_BM * first_ray(transducer)));
  }
  const auto differ = [](const std::vector<double>& list) {
    return std::adjacent_find(list.begin(), list.end(), std::not_equal_to<>()) != list.end();
  };
  sonar["frequency"] = neat(frequency_hz);
  sonar["range_max"] = range_of(range_max_m);
  sonar["field_of_view_deg"] = view_deg(first.view_rad, 180.0);
  sonar["single_ray"] = true;
  add_reports(first, sonar);
  sonar["height"] = heights_m.empty() ? height_of(mount.z_m) : heights_m.front();
  if (differ(ranges_m)) {
    sonar["ranges_max"] = ranges_m;
    sonar.erase("intensity");  // programs know one range, so they cannot tell what has an echo
    context.report.note("intensities", transducers.front().place,
                        "a ranger whose sensors have different ranges states no intensities");
  }
  if (differ(heights_m) && !robot.flat) sonar["heights"] = heights_m;
  if (variance > 0.0) sonar["noise"] = neat(std::sqrt(variance));
  if (share > 0.0) sonar["noise_share"] = neat(std::min(1.0, share / std::sqrt(3.0)));
  sonar["mounts"] = std::move(mounts);
  add(robot, "ranger", "sonar", std::move(sonar));
}

void add_ranger(const Properties& ranger, const Mount& mount, const Body& body,
                const Context& context, RobotDraft& robot) {
  const double frequency_hz = read_frequency_hz(ranger, context);
  std::vector<Transducer> transducers;
  for (const Entity& child : ranger.entity().children) {
    if (child.type == "sensor") {
      transducers.push_back(read_sensor({child, context.units, context.report}, context));
    }
  }
  if (transducers.empty() && ranger.has("scount")) transducers = read_old_sensors(ranger, context);
  // As InterfaceRanger::Publish() of libstageplugin/p_ranger.cc: all samples of a single sensor,
  // the first sample of each of several.
  if (transducers.size() == 1 && transducers.front().samples != 1) {
    return add_scanner("ranger", transducers.front(), mount, frequency_hz, body, context, robot);
  }
  add_ring(transducers, mount, frequency_hz, context, robot);
}

/// The laser of Stage 2 and 3.
void add_laser(const Properties& laser, const Mount& mount, const Body& body,
               const Context& context, RobotDraft& robot) {
  Transducer transducer;
  transducer.place = laser.entity().place;
  transducer.range_min_m = laser.length_m("range_min", 0.0);
  transducer.range_max_m = laser.length_m("range_max", 8.0);
  transducer.view_rad = laser.angle_rad("fov", std::numbers::pi);
  transducer.samples = laser.integer("samples", 180);
  transducer.size_z_m = body.size_m[2];
  static_cast<void>(laser.has("resolution"));
  for (const Entity& child : laser.entity().children) {
    if (child.type != "sensor") continue;
    transducer = read_sensor({child, context.units, context.report}, context);
    break;
  }
  add_scanner("laser", transducer, mount, read_frequency_hz(laser, context), body, context, robot);
}

void add_fiducial(const Properties& finder, const Mount& mount, const Context& context,
                  RobotDraft& robot) {
  Json fiducial;
  const double range_max_m = finder.length_m("range_max", 8.0);
  fiducial["frequency"] = neat(read_frequency_hz(finder, context));
  fiducial["range_max"] = range_of(range_max_m);
  fiducial["range_max_id"] = neat(clamped(finder.length_m("range_max_id", 5.0), 0.0, 1000.0));
  fiducial["field_of_view_deg"] = view_deg(finder.angle_rad("fov", std::numbers::pi), 360.0);
  fiducial["pose"] = pose_json(mount.X_BM);
  fiducial["height"] = finder.flag("ignore_zloc", false) ? 0.0 : height_of(mount.z_m);
  if (finder.length_m("range_min", 0.0) > 0.0) {
    context.report.note("fiducial range_min", finder.place_of("range_min"),
                        "a fiducialfinder also sees objects nearer than its range_min");
  }
  robot.sensor_heights_m.push_back(mount.z_m);
  add(robot, "fiducial", "fiducial", std::move(fiducial));
}

/// Picture of a camera or blobfinder.
Json image_json(const std::array<double, 2>& size, const Place& place, const Context& context) {
  const auto side = [](double given, int most) {
    return std::clamp(static_cast<int>(clamped(given, 1.0, 1e6)), 1, most);
  };
  const int width = side(size[0], 640);
  const int height = side(size[1], 480);
  if (size[0] > width || size[1] > height) {
    context.report.note("image", place, "a picture has at most 640 x 480 pixels");
  }
  return Json::array({width, height});
}

void add_blobfinder(const Properties& finder, const Mount& mount, const Context& context,
                    RobotDraft& robot) {
  Json blobfinder;
  blobfinder["frequency"] = neat(read_frequency_hz(finder, context));
  blobfinder["image"] =
      image_json(finder.tuple<2>("image", "ff", {80.0, 60.0}), finder.place_of("image"), context);
  const double old_range_m = finder.length_m("range_max", 12.0);
  blobfinder["range_max"] = range_of(finder.length_m("range", old_range_m));
  blobfinder["field_of_view_deg"] =
      view_deg(finder.angle_rad("fov", std::numbers::pi / 3.0), 170.0);
  Pose X_BS = mount.X_BM;
  X_BS.yaw_rad = normalize_angle(X_BS.yaw_rad + finder.angle_rad("pan", 0.0));
  blobfinder["pose"] = pose_json(X_BS);
  blobfinder["height"] = height_of(mount.z_m);
  std::vector<std::string> names = finder.texts("colors");
  const int count = finder.integer("colors_count",
                                   finder.integer("channel_count", static_cast<int>(names.size())));
  if (names.empty()) names = finder.texts("channels");
  if (count >= 0 && names.size() > static_cast<std::size_t>(count)) {
    names.resize(static_cast<std::size_t>(count));
  }
  Json colours = Json::array();
  for (const std::string& name : names) {
    const std::string colour =
        to_string(named_colour(name, finder.place_of("colors"), context.report));
    if (std::find(colours.begin(), colours.end(), colour) == colours.end()) {
      colours.push_back(colour);
    }
  }
  if (!colours.empty()) blobfinder["colours"] = std::move(colours);
  robot.sensor_heights_m.push_back(mount.z_m);
  add(robot, "blobfinder", "blobfinder", std::move(blobfinder));
}

void add_bumper(const Properties& bumper, const Mount& mount, const Context& context,
                RobotDraft& robot) {
  constexpr int kMostSegments = 64;
  Json settings;
  settings["frequency"] = neat(read_frequency_hz(bumper, context));
  const int count = bumper.integer("bcount", 0);
  if (count < 0 || count > kMostSegments) {
    context.report.error(bumper.place_of("bcount"), "stage/bad-bumper", "at most 64 bumpers",
                         std::to_string(count));
    return;
  }
  const double common_m = bumper.length_m("blength", 0.0);
  Json segments = Json::array();
  for (int i = 0; i < count; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    const Pose3 place = bumper.pose("bpose" + index);
    const double length_m = bumper.length_m("blength" + index, common_m);
    Json segment = pose_json(mount.X_BM * place.pose);
    segment["length"] = neat(clamped(length_m, 0.001, 100.0));
    segments.push_back(std::move(segment));
  }
  if (!segments.empty()) settings["segments"] = std::move(segments);
  add(robot, "bumper", "bumper", std::move(settings));
}

// Sizes of the paddles are shares of the model's size (libstage/model_gripper.cc).
std::array<double, 3> paddle_shares(const Properties& gripper) {
  return gripper.tuple<3>("paddle_size", "fff", {0.66, 0.1, 0.4});
}

void add_gripper(const Properties& gripper, const Mount& mount, const Body& body,
                 const Context& context, RobotDraft& robot) {
  const std::array<double, 3> paddle = paddle_shares(gripper);
  const double length_m = paddle[0] * body.size_m[0];
  const double thickness_m = paddle[1] * body.size_m[1];
  Json settings;
  settings["frequency"] = neat(read_frequency_hz(gripper, context));
  settings["pose"] = pose_json(mount.X_BM * Pose{0.5 * body.size_m[0] - length_m, 0.0, 0.0});
  settings["length"] = neat(clamped(length_m, 0.001, 10.0));
  settings["thickness"] = neat(clamped(thickness_m, 0.0, 10.0));
  settings["opening"] = neat(clamped(body.size_m[1] - 2.0 * thickness_m, 0.001, 10.0));
  // Stage's break beams start at the foot of the gripper (ModelGripper::UpdateBreakBeams).
  settings["height"] = height_of(mount.z_m);
  if (gripper.flag("autosnatch", false)) {
    context.report.note("autosnatch", gripper.place_of("autosnatch"),
                        "a gripper does not close by itself (autosnatch)");
  }
  const std::vector<std::string> state = gripper.texts("paddle_state");
  if (!state.empty() && (state.front() != "open" || (state.size() > 1 && state[1] != "down"))) {
    context.report.note("paddle_state", gripper.place_of("paddle_state"),
                        "a gripper is open and down at the start");
  }
  add(robot, "gripper", "gripper", std::move(settings));
}

void add_camera(const Properties& camera, const Mount& mount, const Body& body,
                const Context& context, RobotDraft& robot) {
  Json settings;
  settings["frequency"] = neat(read_frequency_hz(camera, context));
  settings["image"] = image_json(camera.tuple<2>("resolution", "ff", {32.0, 32.0}),
                                 camera.place_of("resolution"), context);
  settings["range_max"] = range_of(camera.tuple<2>("range", "ll", {0.2, 8.0})[1]);
  const double view = camera.tuple<2>("fov", "ff", {camera.number("horizfov", 70.0), 40.0})[0];
  settings["field_of_view_deg"] = neat(clamped(view, 0.01, 170.0));
  const auto pantilt = camera.tuple<2>("pantilt", "ff", {0.0, 0.0});
  Pose X_BS = mount.X_BM;
  X_BS.yaw_rad = normalize_angle(X_BS.yaw_rad + pantilt[0] * std::numbers::pi / 180.0);
  if (pantilt[1] != 0.0) {
    context.report.note("tilt", camera.place_of("pantilt"), "a camera looks level, without a tilt");
  }
  settings["pose"] = pose_json(X_BS);
  settings["height"] = height_of(mount.z_m + 0.5 * body.size_m[2]);
  robot.sensor_heights_m.push_back(mount.z_m + 0.5 * body.size_m[2]);
  add(robot, "camera", "camera", std::move(settings));
}

void add_light(const Properties& light, const Mount& mount, const Context& context,
               RobotDraft& robot) {
  Json settings;
  Colour colour = read_colour(light, {0, 255, 0, 255}, context.report);
  colour.a = 255;
  settings["colour"] = to_string(colour);
  settings["enabled"] = light.flag("enabled", true);
  settings["period"] = neat(clamped(light.number("period", 1000.0) / 1000.0, 0.0, 1e6));
  settings["duty_cycle"] = neat(clamped(light.number("dutycycle", 1.0), 0.0, 1.0));
  settings["position"] = point_json(mount.X_BM.position());
  add(robot, light.entity().type, "blinkenlight", std::move(settings));
}

void add_actuator(const Properties& actuator, const Mount& mount, const Context& context,
                  RobotDraft& robot) {
  const bool turns = actuator.choice("type", 0, {"linear", "rotational"}) == 1;
  const double least = actuator.number("min_position", 0.0);
  const double most = std::max(actuator.number("max_position", 1.0), least + 0.001);
  const double speed = clamped(std::abs(actuator.number("max_speed", 1.0)), 0.001, 100.0);
  const double home = std::clamp(actuator.number("start_position", least), least, most);
  Json joint;
  joint["type"] = turns ? "rotary" : "linear";
  if (turns) {  // Stage takes these numbers for radians
    joint["min_deg"] = neat_deg(least);
    joint["max_deg"] = neat_deg(most);
    joint["home_deg"] = neat_deg(home);
    joint["speed_max_deg"] = neat_deg(speed);
  } else {
    const auto axis = actuator.tuple<3>("axis", "fff", {0.0, 0.0, 0.0});
    const std::size_t main = static_cast<std::size_t>(
        std::max_element(axis.begin(), axis.end(),
                         [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        axis.begin());
    joint["axis"] = std::string(axis[main] < 0.0 ? "-" : "") + "xyz"[main];
    joint["min"] = neat(least);
    joint["max"] = neat(most);
    joint["home"] = neat(home);
    joint["speed_max"] = neat(speed);
  }
  Json settings;
  settings["frequency"] = neat(read_frequency_hz(actuator, context));
  settings["pose"] = pose_json(mount.X_BM);
  settings["height"] = height_of(mount.z_m);
  settings["joints"] = Json::array({std::move(joint)});
  if (!actuator.entity().children.empty()) {
    context.report.note("parts of an actuator", actuator.entity().place,
                        "what an actuator carries does not move with it");
  }
  add(robot, "actuator", "actarray", std::move(settings));
}

void add_wifi(const Properties& wifi, const Context& context, RobotDraft& robot) {
  Json settings;
  settings["frequency"] = neat(read_frequency_hz(wifi, context));
  if (wifi.has("ple")) settings["exponent"] = neat(clamped(wifi.number("ple", 3.0), 0.01, 10.0));
  add(robot, "wifi", "wifi", std::move(settings));
}

constexpr std::string_view kDevices[] = {
    "ranger", "laser",        "fiducial",       "fiducialfinder", "blobfinder", "bumper", "gripper",
    "camera", "blinkenlight", "lightindicator", "actuator",       "ptz",        "wifi"};

}  // namespace

bool is_device(const std::string& type) {
  return std::find(std::begin(kDevices), std::end(kDevices), type) != std::end(kDevices);
}

std::array<double, 3> device_size_m(const std::string& type) {
  if (type == "ranger" || type == "laser") return {0.15, 0.15, 0.2};
  if (type == "gripper") return {0.2, 0.3, 0.2};
  if (type == "blinkenlight") return {0.02, 0.02, 0.02};
  if (type == "camera") return {0.1, 0.07, 0.05};
  if (type == "fiducial" || type == "fiducialfinder") return {0.0, 0.0, 0.0};
  return {0.1, 0.1, 0.1};
}

bool device_has_block(const std::string& type) {
  return type == "bumper" || type == "actuator" || type == "laser";
}

Body gripper_base(const Properties& gripper, const Body& body) {
  const double back_m = -0.5 * body.size_m[0];
  const double side_m = 0.5 * body.size_m[1];
  const double front_m = back_m + (1.0 - paddle_shares(gripper)[0]) * body.size_m[0];
  Body base;
  base.size_m = body.size_m;
  base.blocks = {{{{back_m, -side_m}, {front_m, -side_m}, {front_m, side_m}, {back_m, side_m}},
                  0.0,
                  body.size_m[2]}};
  return base;
}

bool add_device(const Entity& model, const Mount& mount, const Body& body, const Context& context,
                RobotDraft& robot) {
  const Properties properties(model, context.units, context.report);
  const std::string& type = model.type;
  if (!is_device(type)) return false;
  if (type == "ranger") add_ranger(properties, mount, body, context, robot);
  if (type == "laser") add_laser(properties, mount, body, context, robot);
  if (type == "fiducial" || type == "fiducialfinder") {
    add_fiducial(properties, mount, context, robot);
  }
  if (type == "blobfinder") add_blobfinder(properties, mount, context, robot);
  if (type == "bumper") add_bumper(properties, mount, context, robot);
  if (type == "gripper") add_gripper(properties, mount, body, context, robot);
  if (type == "camera") add_camera(properties, mount, body, context, robot);
  if (type == "blinkenlight" || type == "lightindicator") {
    add_light(properties, mount, context, robot);
  }
  if (type == "actuator") add_actuator(properties, mount, context, robot);
  if (type == "ptz") add(robot, "ptz", "ptz", Json::object());
  if (type == "wifi") add_wifi(properties, context, robot);
  return true;
}

double neat(double value) {
  const double rounded = std::round(value * 1e9) / 1e9;
  return rounded == 0.0 ? 0.0 : rounded;  // not -0
}

double neat_deg(double angle_rad) { return neat(angle_rad * 180.0 / std::numbers::pi); }

Json point_json(const Vec2& point) { return Json::array({neat(point.x()), neat(point.y())}); }

Json pose_json(const Pose& pose) {
  Json json;
  json["x"] = neat(pose.x_m);
  json["y"] = neat(pose.y_m);
  json["yaw_deg"] = neat_deg(pose.yaw_rad);
  return json;
}

Colour named_colour(const std::string& name, const Place& place, Report& report) {
  if (const std::optional<Colour> colour = x11_colour(name)) return *colour;
  if (name != "random") {
    const std::string near = nearest_x11_name(name);
    report.note("colour " + name, place,
                "unknown colour " + in_quotes(name) + ", shown as red" +
                    (near.empty() ? "" : " (did you mean " + in_quotes(near) + "?)"));
    return {255, 0, 0, 255};
  }
  // The same world gives the same colours: a hash of the place (FNV-1a).
  std::uint32_t hash = 2166136261U;
  for (const int part : {place.line, place.column}) {
    hash = (hash ^ static_cast<std::uint32_t>(part)) * 16777619U;
  }
  const auto channel = [hash](int shift) {
    return static_cast<std::uint8_t>(hash >> shift & 0xff);
  };
  return {channel(0), channel(8), channel(16), 255};
}

Colour read_colour(const Properties& model, Colour fallback, Report& report) {
  const std::string name = model.text("color", "");
  if (!name.empty()) return named_colour(name, model.place_of("color"), report);
  if (!model.has("color_rgba")) return fallback;
  const auto rgba = model.tuple<4>("color_rgba", "ffff", {1.0, 0.0, 0.0, 1.0});
  const auto channel = [](double share) {
    return static_cast<std::uint8_t>(std::lround(255.0 * clamped(share, 0.0, 1.0)));
  };
  return {channel(rgba[0]), channel(rgba[1]), channel(rgba[2]), 255};
}

double read_frequency_hz(const Properties& model, const Context& context) {
  const double wanted_s = model.number("update_interval", 100.0) / 1000.0;
  const double period_s = std::max(wanted_s, context.interval_s);
  return clamped(1.0 / period_s, 0.001, 1000.0);
}

}  // namespace sim::io::stage
