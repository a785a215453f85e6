// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/translation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "io/document.h"
#include "io/stage/left_out.h"
#include "io/stage/version.h"
#include "sim/core/number_text.h"
#include "sim/world/limits.h"
#include "sim/world/outline.h"

namespace sim::io::stage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_model(const std::string& type) {
  return type == "model" || type == "position" || type == "map" || type == "box" ||
         type == "puck" || type == "charger";
}

/// A name that a world's file may have.
std::string world_name(const std::string& stage_name) {
  std::string name;
  for (const char c : stage_name) {
    const bool ok = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                    c == '_' || c == '-';
    name += ok ? c : '_';
  }
  if (name.empty()) name = "model";
  name.resize(std::min<std::size_t>(name.size(), 56));
  return name;
}

/// Names of the things of one kind.
class Names {
 public:
  /// A name that no other thing has.
  std::string unique(const std::string& stage_name) {
    const std::string name = world_name(stage_name);
    std::string made = name;
    for (int& number = next_.try_emplace(name, 2).first->second; !taken_.insert(made).second;) {
      made = name + "_" + std::to_string(number++);
    }
    return made;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> next_;  ///< number to try next, by name
};

/// A solid or a map that is not part of a robot.
struct Piece {
  Json json;
  double z_min_m;
  double z_max_m;
  Place place;
  Polygon outline;  ///< in W, of a block that may be hollow [m]; otherwise empty
};

class Translator {
 public:
  Translator(const Entity& root, Report& report) : root_(root), report_(report) {}

  Translation run(const std::string& name) {
    read_world(name);
    for (const Entity& child : root_.children) top_level(child);
    add_pieces();
    add_floor();
    for (const Entity& child : root_.children) tell_unused(child);
    tell_unused_of(root_, "");
    out_.world["arena"] = std::move(arena_);
    return std::move(out_);
  }

 private:
  /// A model's place in the world or on its robot.
  struct Frame {
    Pose X;             ///< of the model's frame, without its origin
    double foot_m = 0;  ///< height of its foot
  };

  void read_world(const std::string& name) {
    read_version(root_, units_, report_);
    const Properties world(root_, units_, report_);
    constexpr double kLengths[] = {1.0, 0.01, 0.001};
    units_.length_m = kLengths[world.choice("unit_length", 0, {"m", "cm", "mm"})];
    if (world.choice("unit_angle", 0, {"degrees", "radians"}) == 1) units_.angle_rad = 1.0;
    const double interval_ms = std::clamp(world.number("interval_sim", 100.0), 0.1, 1e6);
    interval_s_ = interval_ms / 1000.0;
    tell_speed(world, interval_ms);
    out_.world["name"] = world.text("name", name);
    Json simulation;
    simulation["step"] = neat(std::clamp(std::min(interval_s_, 0.01), 1e-4, 0.1));
    if (const double quit_s = world.number("quit_time", 0.0); quit_s > 0.0) {
      simulation["duration"] = neat(std::min(quit_s, 1e9));
    }
    out_.world["arena"] = nullptr;  // keeps the order of keys
    out_.world["simulation"] = std::move(simulation);
  }

  /// Notes the speed of Stage's window; how fast a run goes is an option of its command here.
  /// Source: `speedup` in libstage/worldgui.cc of Stage 4, `interval_real` in src/world.c of
  /// Stage 2.
  void tell_speed(const Properties& world, double interval_ms) {
    const char* const key = world.has("interval_real") ? "interval_real" : "speedup";
    double factor = world.number(key, 1.0);
    if (world.has("interval_real") && factor > 0.0) factor = interval_ms / factor;
    if (factor == 1.0) return;
    std::string text = std::string(key) +
                       " has no effect: \"playpen run\" is as fast as the computer allows, and "
                       "\"playpen serve\" goes in real time";
    if (factor > 0.0) {
      text += ", unless --time " + rounded_text(factor, 3) + " gives the factor of this file";
    }
    report_.note(key, world.place_of(key), text);
  }

  [[nodiscard]] Context context() { return {units_, report_, interval_s_}; }

  void top_level(const Entity& entity) {
    if (is_window(entity.type)) {
      report_.look("window", entity.place);
      window_.insert(&entity);
      return;
    }
    model(entity, {}, "", false);
  }

  /// The name of a model without one: as in Stage, its type and how many of them came before.
  std::string token_of(const Properties& model, const std::string& parent) {
    const std::string& type = model.entity().type;
    const int number = counts_[parent + "." + type]++;
    const std::string name = model.text("name", "");
    if (name.empty()) {
      return (parent.empty() ? "" : parent + ".") + type + ":" + std::to_string(number);
    }
    if (name.front() == '/') return name.substr(1);
    return parent.empty() ? name : parent + "." + name;
  }

  void refuse_type(const Entity& entity) {
    if (is_of_stage_1(entity.type)) {
      report_.error(entity.place, "stage/unknown-model",
                    "a model of Stage 2 to 4, or one that is defined before",
                    in_quotes(entity.type),
                    "this was a model of Stage 1; Playpen does not read "
                    "worlds of Stage 1");
      return;
    }
    std::vector<std::string> known{"model", "position", "block", "sensor"};
    for (const char* device : {"ranger", "laser", "fiducial", "blobfinder", "bumper", "gripper",
                               "camera", "blinkenlight", "actuator", "ptz", "wifi"}) {
      known.emplace_back(device);
    }
    const std::string near = nearest_word(entity.type, known);
    report_.error(
        entity.place, "stage/unknown-model",
        "a model that is defined before, or one of Stage's: " + list_text(known),
        in_quotes(entity.type),
        near.empty() ? "is an include missing?" : "did you mean " + in_quotes(near) + "?");
  }

  /// Height of what stands on a model above the model's foot.
  [[nodiscard]] double stacked_height_m(const Properties& model, const Body& body) const {
    return model.flag("stack_children", true) && !units_.flat ? body.size_m[2] : 0.0;
  }

  /// A model that is not on a robot.
  void model(const Entity& entity, const Frame& parent, const std::string& parent_name,
             bool on_model) {
    if (entity.type == "block" || entity.type == "sensor") {
      if (entity.type == "block" && on_model) return;  // of its parent's body
      report_.error(entity.place, "stage/misplaced",
                    entity.type == "block" ? "a block inside a model" : "a sensor inside a ranger",
                    "it elsewhere");
      return;
    }
    const Properties properties(entity, units_, report_);
    if (is_device(entity.type) || is_old_device(entity.type)) {
      report_.note("device " + entity.type, entity.place,
                   "a " + entity.type + " that is not on a position model is left out");
      return;
    }
    if (!is_model(entity.type)) return refuse_type(entity);
    const std::string name = token_of(properties, parent_name);
    const Frame frame = frame_of(properties, parent);
    std::array<double, 3> size{0.1, 0.1, 0.1};
    if (entity.type == "puck") size = {0.08, 0.08, 0.1};
    const Body body = read_body(properties, units_, report_, size, true);
    if (entity.type == "position") return robot(properties, body, frame, name);
    add_body(properties, body, frame, name);
    const Frame base{frame.X, frame.foot_m + stacked_height_m(properties, body)};
    for (const Entity& child : entity.children) model(child, base, name, true);
  }

  [[nodiscard]] Frame frame_of(const Properties& properties, const Frame& parent) const {
    const Pose3 pose = properties.pose("pose");
    return {parent.X * pose.pose, parent.foot_m + pose.z_m};
  }

  void extend(const Vec2& p) {
    least_ = least_.cwiseMin(p);
    most_ = most_.cwiseMax(p);
  }

  /// How a model meets robots and their sensors.
  struct Returns {
    bool obstacle = true;
    bool ranger = true;
    bool blob = true;
    bool gripper = false;
    int fiducial = 0;
  };

  Returns read_returns(const Properties& model) {
    Returns returns;
    returns.obstacle = model.flag("obstacle_return", true);
    const double echo = model.number("ranger_return", 1.0);
    returns.ranger = echo >= 0.0;
    if (returns.ranger && echo != 1.0 && !units_.flat) {
      report_.note("intensity", model.place_of("ranger_return"),
                   "rangers state the intensity 1 for all models (ranger_return is left out)");
    }
    // In Stage 2 and 3: 0 or "invisible" are transparent to lasers; "ranger_return" is for sonars.
    if (units_.flat) {
      const bool sonars_see = echo > 0.0;
      returns.ranger = lasers_see(model) || sonars_see;
      if (lasers_see(model) && !sonars_see) {
        report_.note("seen by lasers", model.place_of("ranger_return"),
                     "sonars see all that lasers see (ranger_return 0 is left out)");
      }
    } else if (model.has("laser_return") && !model.has("ranger_return")) {
      returns.ranger = lasers_see(model);
    }
    returns.blob = model.flag("blob_return", true);
    returns.gripper = model.flag("gripper_return", false);
    returns.fiducial = std::max(0, model.integer("fiducial_return", 0));
    if (model.integer("fiducial_key", 0) != 0) {
      report_.note("fiducial_key", model.place_of("fiducial_key"),
                   "fiducialfinders see the marks of all keys (fiducial_key is left out)");
    }
    return returns;
  }

  void tell_charging(const Properties& model) {
    for (const char* key : {"give_watts", "take_watts"}) {
      if (!model.has(key)) continue;
      report_.note("charging", model.place_of(key),
                   "charging between models is left out; docks charge robots");
    }
  }

  /// Adds a static model's body to the arena.
  void add_body(const Properties& model, const Body& body, const Frame& frame,
                const std::string& stage_name) {
    const Returns returns = read_returns(model);
    const Place& place = model.entity().place;
    if (model.has("ctrl")) {
      report_.note("ctrl of a model", model.place_of("ctrl"),
                   "controllers of models that do not drive are left out");
    }
    tell_charging(model);
    if (body.empty()) return;
    const std::string name = obstacle_names_.unique(stage_name);
    if (!returns.obstacle && returns.ranger && (body.bitmap || body.boundary)) {
      report_.note("open plan", model.place_of("obstacle_return"),
                   "robots drive through this floor plan, as in Stage (obstacle_return 0)");
    }
    if (returns.obstacle && !returns.ranger) {
      report_.note("ranger_return",
                   model.has("ranger_return") ? model.place_of("ranger_return")
                                              : model.place_of("laser_return"),
                   "a solid model that rangers do not see becomes one of 1 mm height");
    }
    const Colour colour = read_colour(model, {255, 0, 0, 255}, report_);
    const Pose3 origin = model.pose("origin");
    const Pose X_WM = frame.X * origin.pose;
    const double foot_m = frame.foot_m + origin.z_m;
    const auto finish = [&](Json& json, double z_max_m) {
      json["height"] = returns.ranger ? neat(std::clamp(z_max_m, 0.001, 10.0)) : 0.001;
      if (!returns.obstacle) json["solid"] = false;
    };
    std::vector<Block> blocks = body.blocks;
    if (body.bitmap && !returns.gripper) {
      const auto outlines = outlines_of(*body.bitmap, {body.size_m[0], body.size_m[1]});
      if (!outlines) add_map(*body.bitmap, body, X_WM, foot_m, name, place, finish);
      for (const Polygon& outline : outlines.value_or(std::vector<Polygon>())) {
        blocks.push_back({outline, 0.0, body.size_m[2]});
      }
    }
    if (body.boundary) add_boundary(body, X_WM, foot_m, name, colour, place, finish);
    if (returns.gripper && (body.bitmap || blocks.size() > 1)) {
      blocks = {convex_block(body)};
      report_.note("gripped outline", place,
                   "an object for grippers is one solid: the convex outline of its body");
    }
    std::size_t largest = 0;
    for (std::size_t i = 1; i < blocks.size(); ++i) {
      if (area_m2(blocks[i].points) > area_m2(blocks[largest].points)) largest = i;
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      Json json;
      json["name"] = i == largest ? name : obstacle_names_.unique(stage_name);
      if (!shape(blocks[i], body, frame.X, origin.pose, json, place)) continue;
      finish(json, foot_m + blocks[i].z_max_m);
      if (returns.blob) json["colour"] = to_string(colour);
      if (returns.fiducial > 0 && i == largest) json["fiducial"] = returns.fiducial;
      if (returns.gripper) json["portable"] = true;
      Polygon outline;
      for (const Vec2& point : blocks[i].points) {
        outline.push_back(X_WM * point);
        extend(outline.back());
      }
      if (returns.gripper) outline.clear();
      obstacles_.push_back({std::move(json), foot_m + blocks[i].z_min_m, foot_m + blocks[i].z_max_m,
                            place, std::move(outline)});
    }
    if (returns.fiducial > 0 && blocks.empty()) {
      report_.note("fiducial of a bitmap", place,
                   "a floor plan is no mark for fiducialfinders (fiducial_return is left out)");
    }
  }

  /// The convex outline of a body as one block.
  static Block convex_block(const Body& body) {
    Block whole;
    std::vector<Vec2> points;
    whole.z_min_m = body.bitmap ? 0.0 : kInfinity;
    whole.z_max_m = body.bitmap ? body.size_m[2] : 0.0;
    if (body.bitmap) points = extreme_points(*body.bitmap, {body.size_m[0], body.size_m[1]});
    for (const Block& block : body.blocks) {
      points.insert(points.end(), block.points.begin(), block.points.end());
      whole.z_min_m = std::min(whole.z_min_m, block.z_min_m);
      whole.z_max_m = std::max(whole.z_max_m, block.z_max_m);
    }
    whole.points = convex_outline(std::move(points));
    return whole;
  }

  /// The outline of a block as keys of an obstacle. @return false if it has no area.
  bool shape(const Block& block, const Body& body, const Pose& X_WM, const Pose& X_MO, Json& json,
             const Place& place) {
    const Vec2 half(0.5 * body.size_m[0], 0.5 * body.size_m[1]);
    constexpr double kThin_m = 0.001;
    if (2.0 * half.x() < kThin_m || 2.0 * half.y() < kThin_m) {
      report_.note("thin", place, "models thinner than 1 mm are left out");
      return false;
    }
    const bool whole = block.points.size() == 4 &&
                       std::all_of(block.points.begin(), block.points.end(), [&](const Vec2& p) {
                         return (p.cwiseAbs() - half).cwiseAbs().maxCoeff() < 1e-9;
                       });
    if (whole && std::abs(area_m2(block.points)) > 0.99 * body.size_m[0] * body.size_m[1]) {
      const Pose X_WO = X_WM * X_MO;
      json["center"] = point_json(X_WO.position());
      json["yaw_deg"] = neat_deg(X_WO.yaw_rad);
      json["size"] = Json::array({neat(body.size_m[0]), neat(body.size_m[1])});
      return true;
    }
    Polygon outline;
    for (const Vec2& point : block.points) {
      const Vec2 moved = X_MO * point;
      if (outline.empty() || (moved - outline.back()).norm() > kThin_m) outline.push_back(moved);
    }
    while (outline.size() > 1 && (outline.front() - outline.back()).norm() <= kThin_m) {
      outline.pop_back();
    }
    if (outline.size() > kMostOutlineVertices || outline.size() < 3 || crossing_sides(outline)) {
      outline = convex_outline(std::move(outline));
      reduce_corners(outline, kMostOutlineVertices);
      report_.note("crossing", place,
                   "a block whose sides cross, or that has more than 64 corners, becomes the "
                   "convex outline around it");
    }
    if (outline.size() < 3 || area_m2(outline) < 1e-6) {
      report_.note("thin", place, "blocks of less than 1 mm^2 are left out");
      return false;
    }
    json["shape"] = "polygon";
    json["center"] = point_json(X_WM.position());
    json["yaw_deg"] = neat_deg(X_WM.yaw_rad);
    Json points = Json::array();
    for (const Vec2& point : outline) points.push_back(point_json(point));
    json["outline"] = std::move(points);
    return true;
  }

  template <typename Finish>
  void add_map(const DarkArea& area, const Body& body, const Pose& X_WM, double foot_m,
               const std::string& name, const Place& place, const Finish& finish) {
    const std::string file = name + ".png";
    out_.files[file] = png_of(map_area(area, {body.size_m[0], body.size_m[1]}));
    Json json;
    json["image"] = file;
    json["size"] = Json::array({neat(body.size_m[0]), neat(body.size_m[1])});
    json["pose"] = pose_json(X_WM);
    finish(json, foot_m + body.size_m[2]);
    maps_.push_back({std::move(json), foot_m, foot_m + body.size_m[2], place, {}});
    for (const Vec2& corner : box_corners(X_WM, {body.size_m[0], body.size_m[1]})) extend(corner);
  }

  template <typename Finish>
  void add_boundary(const Body& body, const Pose& X_WM, double foot_m, const std::string& name,
                    const Colour& colour, const Place& place, const Finish& finish) {
    const Vec2 size(body.size_m[0], body.size_m[1]);
    const double t = kBoundaryThickness_m;
    const Vec2 off = 0.5 * (size - Vec2::Constant(t));
    const std::array<std::pair<Vec2, Vec2>, 4> sides = {{{{0.0, -off.y()}, {size.x(), t}},
                                                         {{off.x(), 0.0}, {t, size.y()}},
                                                         {{0.0, off.y()}, {size.x(), t}},
                                                         {{-off.x(), 0.0}, {t, size.y()}}}};
    for (const auto& [center, extent] : sides) {
      Json json;
      json["name"] = obstacle_names_.unique(name + "_side");
      json["center"] = point_json(X_WM * center);
      json["yaw_deg"] = neat_deg(X_WM.yaw_rad);
      json["size"] = point_json(extent);
      finish(json, foot_m + body.size_m[2]);
      json["colour"] = to_string(colour);
      obstacles_.push_back({std::move(json), foot_m, foot_m + body.size_m[2], place, {}});
    }
    for (const Vec2& corner : box_corners(X_WM, size)) extend(corner);
    if (std::abs(std::remainder(X_WM.yaw_rad, 1.5707963267948966)) < 1e-9) {
      enclosed_ = true;
    }
  }

  /// A position model: a robot.
  void robot(const Properties& model, const Body& body, const Frame& frame,
             const std::string& stage_name) {
    // Said here, before all of them are translated.
    if (out_.robots.size() >= kMostRobots) {
      throw ConfigError(issue_at(model.entity().place, "world/too-many",
                                 "at most " + std::to_string(kMostRobots) + " robots", "more"));
    }
    RobotDraft draft;
    draft.stage_name = stage_name;
    draft.kind = model.entity().kinds.empty() ? "robot" : world_name(model.entity().kinds.front());
    draft.place = model.entity().place;
    draft.X_WB = frame.X;
    draft.foot_m = frame.foot_m;
    draft.flat = units_.flat;
    draft.colour = read_colour(model, {255, 0, 0, 255}, report_);
    const Returns returns = read_returns(model);
    tell_charging(model);
    if (returns.fiducial > 0) draft.robot["fiducial"] = returns.fiducial;
    if (returns.gripper) {
      report_.note("gripped robot", model.place_of("gripper_return"),
                   "grippers do not take robots (gripper_return is left out)");
    }
    const Pose3 origin = model.pose("origin");
    add_part(body, {origin.pose, frame.foot_m + origin.z_m}, returns.obstacle, returns.ranger,
             draft);
    const Mount base{{}, frame.foot_m + stacked_height_m(model, body)};
    for (const Entity& child : model.entity().children) part(child, base, stage_name, draft);
    add_position(model, body, context(), draft);
    order_rangers(draft);
    set_body(report_, draft);
    extend_by(draft);
    draft.robot["name"] = robot_names_.unique(stage_name);
    out_.robots.push_back(std::move(draft));
  }

  /// Gives the rangers of a robot their indexes in Stage's order.
  static void order_rangers(RobotDraft& draft) {
    Json names = Json::array();
    for (const DraftDevice& device : draft.list) {
      if (device.type == "laser" || device.type == "sonar") names.push_back(device.name);
    }
    if (!names.empty()) draft.robot["interfaces"]["ranger"] = std::move(names);
  }

  /// A model on a robot: a device, or a part of its body.
  void part(const Entity& entity, const Mount& parent, const std::string& parent_name,
            RobotDraft& draft) {
    if (entity.type == "block") return;
    if (entity.type == "sensor") {
      report_.error(entity.place, "stage/misplaced", "a sensor inside a ranger", "it elsewhere");
      return;
    }
    if (is_old_device(entity.type)) {
      report_.note("device " + entity.type, entity.place,
                   "a " + entity.type + " of Stage 2 is left out");
      return;
    }
    if (!is_device(entity.type) && !is_model(entity.type)) return refuse_type(entity);
    const Properties properties(entity, units_, report_);
    const Context shared = context();
    const std::string name = token_of(properties, parent_name);
    const Pose3 pose = properties.pose("pose");
    const Pose3 origin = properties.pose("origin");
    const bool device = is_device(entity.type);
    const Body body =
        read_body(properties, units_, report_,
                  device ? device_size_m(entity.type) : std::array<double, 3>{0.1, 0.1, 0.1},
                  device ? device_has_block(entity.type) : true);
    const Mount frame{parent.X_BM * pose.pose, parent.z_m + pose.z_m};
    const Mount mount{frame.X_BM * origin.pose, frame.z_m + origin.z_m};
    if (entity.type == "position") {
      report_.note("position on a position", entity.place,
                   "a position model on another one does not drive; it is a part of its body");
    }
    const Returns returns = read_returns(properties);
    tell_charging(properties);
    if (entity.type != "bumper") {
      const bool gripper = entity.type == "gripper";
      add_part(gripper ? gripper_base(properties, body) : body, mount, returns.obstacle,
               returns.ranger, draft);
    }
    if (returns.fiducial > 0 && !draft.robot.contains("fiducial")) {
      draft.robot["fiducial"] = returns.fiducial;
    }
    static_cast<void>(add_device(entity, mount, body, shared, draft));
    const Mount base{frame.X_BM, frame.z_m + stacked_height_m(properties, body)};
    for (const Entity& child : entity.children) {
      if (child.type != "sensor") part(child, base, name, draft);
    }
  }

  void extend_by(const RobotDraft& draft) {
    for (const Vec2& point : draft.footprint) extend(draft.X_WB * point);
  }

  /// Replaces solids that contain a robot by their walls: Stage's solids are hollow.
  void hollow_pieces() {
    std::vector<Piece> all;
    for (Piece& piece : obstacles_) {
      const bool hollow =
          std::any_of(out_.robots.begin(), out_.robots.end(), [&](const RobotDraft& robot) {
            return piece.z_min_m < robot.top_m && stands_inside(robot, piece.outline);
          });
      if (!hollow) {
        all.push_back(std::move(piece));
        continue;
      }
      report_.note("hollow", piece.place,
                   "a solid around a robot becomes its walls: solids are hollow in Stage");
      const std::string name = piece.json["name"].get<std::string>() + "_side";
      for (Json& wall : walls_of(piece.outline, piece.json)) {
        wall["name"] = obstacle_names_.unique(name);
        all.push_back({std::move(wall), piece.z_min_m, piece.z_max_m, piece.place, {}});
      }
    }
    obstacles_ = std::move(all);
  }

  /// Describes a piece that begins above the floor.
  /// @param top_m  height of the highest robot.
  void lift(Piece& piece, double top_m) {
    if (piece.z_min_m >= top_m) piece.json["solid"] = false;  // robots drive under it
    const bool is_map = piece.json.contains("image");
    if (is_map || piece.json.contains("portable")) {
      report_.note("floating", piece.place,
                   "bitmaps and objects for grippers that begin above the floor reach down to it");
    } else if (piece.z_min_m < piece.json["height"].get<double>() - kLeastLength_m) {
      piece.json["bottom"] = neat(piece.z_min_m);
    }
  }

  /// Adds obstacles and maps that robots or their sensors can meet.
  void add_pieces() {
    hollow_pieces();
    double reach_m = 0.0;
    double top_m = 0.0;
    for (const RobotDraft& robot : out_.robots) {
      top_m = std::max(top_m, robot.top_m);
      reach_m = std::max(reach_m, robot.top_m);
      for (const double height_m : robot.sensor_heights_m) reach_m = std::max(reach_m, height_m);
    }
    if (out_.robots.empty()) reach_m = kInfinity;
    const auto take = [&](std::vector<Piece>& pieces, const char* pointer) {
      Json list = Json::array();
      for (Piece& piece : pieces) {
        if (piece.z_min_m > reach_m + kSameHeight_m) {
          report_.note("overhead", piece.place,
                       "parts above all robots and their sensors are left out");
          continue;
        }
        if (piece.z_min_m > 0.0) lift(piece, top_m);
        out_.places[pointer + std::to_string(list.size())] = piece.place;
        list.push_back(std::move(piece.json));
      }
      return list;
    };
    Json maps = take(maps_, "/arena/map/");
    if (!maps.empty()) arena_["map"] = std::move(maps);
    Json obstacles = take(obstacles_, "/arena/obstacles/");
    if (!obstacles.empty()) arena_["obstacles"] = std::move(obstacles);
  }

  /// The floor: what contains everything. Stage's worlds have no end.
  void add_floor() {
    if (!(least_.x() < most_.x())) {
      least_ = {-5.0, -5.0};
      most_ = {5.0, 5.0};
    }
    if (!enclosed_) {
      const double margin_m = std::max(1.0, 0.1 * (most_ - least_).maxCoeff());
      least_ -= Vec2::Constant(margin_m);
      most_ += Vec2::Constant(margin_m);
    }
    Json floor;
    floor["size"] = point_json(most_ - least_);
    floor["origin"] = point_json(least_);
    floor["border"] = false;
    for (auto& [key, value] : arena_.items()) floor[key] = value;
    arena_ = std::move(floor);
  }

  /// Reports properties that nothing has asked for.
  void tell_unused(const Entity& entity) {
    if (window_.contains(&entity)) return;
    tell_unused_of(entity, entity.type);
    for (const Entity& child : entity.children) tell_unused(child);
  }

  void tell_unused_of(const Entity& entity, const std::string& type) {
    for (const Property& property : entity.properties) {
      if (property.used || is_without_effect(property.name)) continue;
      if (is_look(property.name)) {
        report_.look(property.name, property.place);
        continue;
      }
      const std::string plain = property.name.substr(0, property.name.find('['));
      report_.note("property " + type + "." + plain, property.place,
                   "the property " + in_quotes(plain) + (type.empty() ? "" : " of a " + type) +
                       " is left out");
    }
  }

  const Entity& root_;
  Report& report_;
  Units units_;
  double interval_s_ = 0.1;
  Translation out_;
  Json arena_ = Json::object();
  std::vector<Piece> obstacles_;
  std::vector<Piece> maps_;
  std::map<std::string, int> counts_;
  Names obstacle_names_;
  Names robot_names_;
  std::set<const Entity*> window_;
  Vec2 least_ = Vec2::Constant(kInfinity);
  Vec2 most_ = Vec2::Constant(-kInfinity);
  bool enclosed_ = false;  ///< a boundary surrounds the floor
};

}  // namespace

Translation translate(const Entity& root, const std::string& name, Report& report) {
  return Translator(root, report).run(name);
}

}  // namespace sim::io::stage
