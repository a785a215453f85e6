// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/world_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "canvas/image_file.h"
#include "io/check_world.h"
#include "io/controller_io.h"
#include "io/document.h"
#include "io/map_io.h"
#include "io/obstacle_io.h"
#include "io/robot_io.h"
#include "io/stage/stage_world.h"
#include "io/world_document.h"
#include "sim/io/field_reader.h"
#include "sim/io/player_options.h"
#include "sim/world/limits.h"
#include "world/find_named.h"
#include "world/world_fields.h"

namespace sim::io {
namespace {

constexpr int kFirstPort = 6665;  ///< Player's default

/// Colours of robots without one in the file: easy to distinguish, and different from the red of
/// dynamic blocks.
constexpr std::array<Colour, 13> kPalette{{{0xff, 0x88, 0x00, 0xff},
                                           {0x2a, 0x7f, 0xde, 0xff},
                                           {0x2f, 0xae, 0x4e, 0xff},
                                           {0xc2, 0x38, 0xb8, 0xff},
                                           {0xe8, 0xc3, 0x17, 0xff},
                                           {0x12, 0xa8, 0xa8, 0xff},
                                           {0x6a, 0x4c, 0xe0, 0xff},
                                           {0xf0, 0x6a, 0xa0, 0xff},
                                           {0x8c, 0x5a, 0x32, 0xff},
                                           {0x5f, 0x8d, 0x1f, 0xff},
                                           {0x1d, 0x3f, 0x8f, 0xff},
                                           {0x5c, 0x66, 0x70, 0xff},
                                           {0x5c, 0xc8, 0xff, 0xff}}};

class WorldReader {
 public:
  WorldReader(Reader::Document& document, const std::vector<DeviceType>& device_types)
      : document_(document), types_(device_types) {
    world_.file = document.file;
  }

  WorldDescription read() {
    Reader root(document_, document_.root, "");
    if (!root.expect_object()) return world_;
    static_cast<void>(root.string("$schema", ""));
    read_some(root, world_, {"name", "description"});
    read_arena(root);
    read_simulation(root);
    read_canvas(root);
    read_robots(root);
    world_.controller = read_controller(root);
    read_some(root, world_, {"fuzz"});
    root.finish();
    for (ConfigIssue& issue : check_world_parts(world_, [this](const std::string& pointer) {
           return !document_.has_issue_at(pointer);
         })) {
      issue.line = document_.line_of(issue.pointer);
      document_.add(std::move(issue));
    }
    return std::move(world_);
  }

 private:
  void read_arena(Reader& root) {
    ArenaDescription& arena = world_.arena;
    if (!root.has("arena")) {
      arena = syrotek_arena();
      return;
    }
    std::optional<Reader> reader = root.object("arena");
    if (!reader) return;
    arena.preset = reader->choice("preset", "", {"syrotek"});
    if (!arena.preset.empty()) {
      arena = syrotek_arena();
      for (const char* key : {"size", "origin", "map"}) {
        if (!reader->has(key)) continue;
        reader->issue("world/conflicting-keys", "either \"preset\" or \"" + std::string(key) + "\"",
                      "both", "the preset has its own floor; leave one of the two out", key);
      }
    } else {
      const bool has_size = reader->has("size");
      const bool has_origin = reader->has("origin");
      read_some(*reader, arena, {"size", "origin"});
      read_maps(*reader, has_size, has_origin);
    }
    read_some(*reader, arena, {"border", "border_height"});
    read_blocks(*reader, "obstacles", "o", false, arena.obstacles);
    read_docks(*reader);
    read_blocks(*reader, "dock_separators", "separator", true, arena.dock_separators);
    set_states(*reader);
    reader->finish();
  }

  /// Reads docks that are added to those of the preset.
  void read_docks(Reader& arena) {
    ArenaDescription given;
    read_some(arena, given, {"docks"});
    std::vector<DockDescription>& docks = world_.arena.docks;
    docks.insert(docks.end(), given.docks.begin(), given.docks.end());
    std::set<std::string> taken;
    for (const DockDescription& dock : docks) taken.insert(dock.name);
    std::size_t number = 0;
    for (DockDescription& dock : docks) {
      if (dock.name.empty()) dock.name = free_name("dock", ++number, taken);
    }
  }

  /// Reads the lists "extended" and "retracted" with names of dynamic obstacles.
  void set_states(Reader& arena) {
    std::set<std::string> extended;
    for (const auto& [key, state] : {std::pair("extended", ObstacleState::kExtended),
                                     std::pair("retracted", ObstacleState::kRetracted)}) {
      for (Reader& element : arena.array(key)) {
        ObstacleDescription* obstacle = named_dynamic(element);
        if (obstacle == nullptr) continue;
        if (state == ObstacleState::kExtended) {
          extended.insert(obstacle->name);
        } else if (extended.contains(obstacle->name)) {
          element.issue("world/conflicting-state", "an obstacle in one of the two lists only",
                        in_quotes(obstacle->name) + " in \"extended\" too",
                        "take it out of one of them");
        }
        obstacle->state = state;
      }
    }
  }

  /// The dynamic obstacle that a list element names; nullptr and an issue if there is none.
  ObstacleDescription* named_dynamic(Reader& element) {
    if (!element.is_string()) {
      element.issue("world/wrong-type", "the name of a dynamic obstacle in double quotes",
                    element.description_for_message());
      return nullptr;
    }
    const std::string name = element.scalar_text().value_or("");
    std::vector<ObstacleDescription>& obstacles = world_.arena.obstacles;
    if (const std::optional<int> index = find_named(obstacles, name)) {
      ObstacleDescription& obstacle = obstacles[static_cast<std::size_t>(*index)];
      if (obstacle.type == ObstacleType::kDynamic) return &obstacle;
      element.issue("world/static-obstacle", "a dynamic obstacle",
                    in_quotes(name) + ", which is static", "static obstacles are always there");
      return nullptr;
    }
    std::vector<std::string> known;
    for (const ObstacleDescription& o : obstacles) {
      if (o.type == ObstacleType::kDynamic && known.size() < 20) known.push_back(o.name);
    }
    element.issue(
        "world/unknown-obstacle",
        known.empty() ? "no name: this arena has no dynamic obstacles"
                      : "the name of a dynamic obstacle: " + list_text(known),
        in_quotes(name),
        known.empty() ? "is \"preset\": \"syrotek\" missing?" : did_you_mean(name, known));
    return nullptr;
  }

  /// Reads "map": a picture of walls, or a list of them.
  void read_maps(Reader& arena_reader, bool has_size, bool has_origin) {
    constexpr std::size_t kMaxMaps = 1000;
    const std::optional<Reader> given = arena_reader.child("map");
    if (!given) return;
    if (given->is_array()) {
      for (Reader& reader : arena_reader.array("map", kMaxMaps)) {
        if (reader.expect_object()) read_map(reader);
      }
    } else if (std::optional<Reader> reader = arena_reader.object("map")) {
      read_map(*reader);
    }
    if (document_.has_issue_at(given->pointer())) return;
    cover_maps(*given, has_size, has_origin);
  }

  /// By default the floor is where the maps are.
  void cover_maps(const Reader& maps, bool has_size, bool has_origin) {
    ArenaDescription& arena = world_.arena;
    if (arena.maps.empty()) return;
    const double infinite = std::numeric_limits<double>::infinity();
    Vec2 least = Vec2::Constant(infinite);
    Vec2 most = -least;
    for (const std::vector<Vec2>& corners : map_corners_) {
      for (const Vec2& corner : corners) {
        least = least.cwiseMin(corner);
        most = most.cwiseMax(corner);
      }
    }
    if (!has_origin) arena.origin = least;
    if (has_size) return;
    arena.size = arena.maps.size() == 1 && !arena.maps.front().size ? only_map_size_ : most - least;
    if (arena.size.maxCoeff() <= kArenaLength.max) return;
    ConfigIssue issue{"world/map-too-large",
                      document_.file,
                      maps.pointer() + (maps.is_array() ? "" : "/resolution"),
                      "a floor of at most 10000 m a side",
                      number_text(arena.size.maxCoeff()) + " m",
                      "use a smaller resolution"};
    issue.line = document_.line_of(issue.pointer);
    document_.add(std::move(issue));
  }

  /// The picture of a map; nullopt and an issue if it cannot be used.
  std::optional<GreyImage> read_map_image(Reader& reader, const std::string& name) {
    GreyImage image;
    try {
      const auto* const files = document_.files;
      const auto given = files == nullptr ? std::map<std::string, std::string>::const_iterator()
                                          : files->find(name);
      if (files != nullptr && given != files->end()) {
        image = decode_grey_image({given->second.begin(), given->second.end()}, name);
      } else {
        image = load_grey_image((folder_of(document_.file) / name).string());
      }
    } catch (const std::runtime_error& error) {
      reader.issue("world/map-unreadable", "a picture (PNG or PGM)", error.what(),
                   "the name is relative to the folder of the world file", "image");
      return std::nullopt;
    }
    if (image.width >= 1 && image.height >= 1 && image.width <= kMaxMapSide &&
        image.height <= kMaxMapSide) {
      return image;
    }
    reader.issue("world/map-too-large",
                 "a picture of at most " + std::to_string(kMaxMapSide) + " pixels a side",
                 std::to_string(image.width) + " x " + std::to_string(image.height),
                 "shrink the picture and enlarge the resolution", "image");
    return std::nullopt;
  }

  void read_map(Reader& reader) {
    ArenaDescription& arena = world_.arena;
    MapDescription map;
    map.origin = arena.origin;
    read_fields(reader, fields_of<MapDescription>(), &map);
    reader.finish();
    arena.maps.push_back(map);
    if (!reader.has("image") || document_.has_issue_at(reader.pointer())) return;
    std::optional<GreyImage> image = read_map_image(reader, map.image);
    if (!image) return;
    OccupancyGrid grid{image->width, image->height, std::move(image->pixels)};
    for (std::uint8_t& cell : grid.solid) cell = cell < map.occupied_threshold * 255.0 ? 1 : 0;
    std::optional<std::vector<WallLoop>> walls =
        map.size ? trace_walls(grid, Vec2::Zero(), 1.0)
                 : trace_walls(grid, map.origin, map.resolution_m);
    if (!walls) {
      reader.issue("world/map-too-complex",
                   "walls of at most " + std::to_string(kMaxWallEdges) + " edges", "more",
                   "is it a floor plan? Remove noise, or change occupied_threshold", "image");
      return;
    }
    const Vec2 pixels(grid.width, grid.height);
    if (map.size) {
      const Vec2 scale = map.size->cwiseQuotient(pixels);
      for (WallLoop& loop : *walls) {
        for (Vec2& vertex : loop.vertices) {
          vertex = map.pose * (vertex - 0.5 * pixels).cwiseProduct(scale);
        }
      }
      map_corners_.push_back(box_corners(map.pose, *map.size));
    } else {
      only_map_size_ = pixels * map.resolution_m;
      map_corners_.push_back({map.origin, map.origin + only_map_size_});
    }
    if (map.simplify_m > 0.0) simplify_walls(*walls, map.simplify_m);
    for (WallLoop& loop : *walls) {
      if (map.height_m) loop.height_m = *map.height_m;
      loop.solid = map.solid;
      arena.walls.push_back(std::move(loop));
    }
  }

  void read_simulation(Reader& root) {
    std::optional<Reader> reader = root.object("simulation");
    if (!reader) return;
    read_fields(*reader, fields_of<SimulationDescription>(), &world_.simulation);
    reader->finish();
  }

  /// By default the canvas covers the floor with cells of 2 cm, or larger cells if more than 4096
  /// per side would be needed.
  void read_canvas(Reader& root) {
    constexpr double kMaxDefaultSide = 4096.0;
    CanvasDescription& canvas = world_.canvas;
    const ArenaDescription& arena = world_.arena;
    std::optional<Reader> reader = root.object("canvas");

    for (const double coarser_m : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
      if (arena.size.maxCoeff() / canvas.cell_size_m <= kMaxDefaultSide) break;
      canvas.cell_size_m = coarser_m;
    }
    canvas.origin = arena.origin;
    if (reader) read_some(*reader, canvas, {"cell_size", "origin"});
    // Rounded up to an even number, as films require; 1e-9 compensates 3.42 / 0.02 > 171.
    const auto cells = [&canvas](double length_m) {
      const double count = 2.0 * std::ceil(0.5 * (length_m / canvas.cell_size_m - 1e-9));
      return static_cast<int>(std::clamp(count, 1.0, 1e9));
    };
    canvas.width = cells(arena.size.x());
    canvas.height = cells(arena.size.y());
    if (reader) {
      if (!reader->has("size") && !document_.has_issue_at("/arena") &&
          (canvas.width > kMaxCanvasSide || canvas.height > kMaxCanvasSide)) {
        reader->issue("world/canvas-too-large", "at most 8192 cells a side to cover the floor",
                      std::to_string(canvas.width) + " x " + std::to_string(canvas.height),
                      "enlarge cell_size, or give the size", "cell_size");
      }
      read_some(*reader, canvas, {"size", "view_mode", "lock_view_mode"});
      reader->finish();
    }
    canvas.width = std::min(canvas.width, kMaxCanvasSide);
    canvas.height = std::min(canvas.height, kMaxCanvasSide);
  }

  void read_robots(Reader& root) {
    read_some(root, world_, {"robots_on_port"});
    std::vector<std::size_t> unplaced;
    if (!root.has("robots")) {
      RobotDescription robot;
      robot.devices = default_devices(root, default_robot_model(), types_);
      world_.robots.push_back(std::move(robot));
      unplaced.push_back(0);
    } else {
      for (Reader& reader : root.array("robots", kMostRobots)) {
        RobotDescription robot;
        robot.colour = kPalette[world_.robots.size() % kPalette.size()];
        if (reader.expect_object()) {
          read_robot(reader, robot);
          if (!reader.has("pose")) unplaced.push_back(world_.robots.size());
        }
        world_.robots.push_back(std::move(robot));
      }
    }
    std::set<std::string> names;
    std::set<int> ports;
    for (const RobotDescription& robot : world_.robots) {
      names.insert(robot.name);
      ports.insert(robot.port);
    }
    for (std::size_t i = 0; i < world_.robots.size(); ++i) {
      RobotDescription& robot = world_.robots[i];
      if (robot.name.empty()) robot.name = free_name("r", i + 1, names);
      if (robot.port == 0) robot.port = world_.robots_on_port;
      if (robot.port == 0) {
        int port = kFirstPort + static_cast<int>(i);
        while (!ports.insert(port).second) ++port;
        robot.port = port;
      }
    }
    place_robots(unplaced);
  }

  /// Gives each robot without a pose a free place.
  void place_robots(const std::vector<std::size_t>& unplaced) {
    if (document_.has_issue_at("/arena")) return;
    WorldDescription others;
    others.arena = world_.arena;
    others.models = world_.models;
    for (std::size_t i = 0; i < world_.robots.size(); ++i) {
      if (std::find(unplaced.begin(), unplaced.end(), i) == unplaced.end() &&
          !document_.has_issue_at("/robots/" + std::to_string(i) + "/pose")) {
        others.robots.push_back(world_.robots[i]);
      }
    }
    // If a model had no room before, it has none now.
    std::map<const RobotModel*, std::size_t> places_tried;
    for (const std::size_t i : unplaced) {
      RobotDescription& robot = world_.robots[i];
      const std::string pointer = "/robots/" + std::to_string(i);
      const RobotModel* model = find_robot_model(world_, robot.model);
      if (model == nullptr || document_.has_issue_at(pointer + "/pose")) continue;
      const std::optional<Pose> pose =
          find_free_pose(others, model->footprint, places_tried[model]);
      if (!pose) {
        ConfigIssue issue{"world/no-free-place",
                          document_.file,
                          pointer,
                          "a free place on the floor for robot " + robot.name,
                          "none",
                          "give it a \"pose\", or make the arena larger"};
        issue.line = document_.line_of(issue.pointer);
        document_.add(std::move(issue));
        continue;
      }
      robot.pose = *pose;
      others.robots.push_back(robot);
    }
  }

  void read_robot(Reader& reader, RobotDescription& robot) {
    read_some(reader, robot, {"name", "model"});
    const bool model_is_valid = load_model(reader, robot.model);
    if (!model_is_valid) robot.model = default_robot_model().name;
    read_some(reader, robot, {"pose", "elevation", "tags", "colour", "port"});
    if (!model_is_valid) return;  // the rest depends on the model
    const RobotModel& model = *find_robot_model(world_, robot.model);
    robot.devices = read_devices(reader, default_devices(reader, model, types_), types_);
    for (Reader& driver : reader.array("drivers", 100)) {
      if (!driver.expect_object()) continue;
      if (is_driver_device(driver)) {
        read_driver_device(driver, robot.devices, types_);
      } else {
        robot.drivers.push_back(read_driver(driver));
      }
    }
    if (std::optional<Reader> proxies = reader.object("proxies")) {
      for (const std::string& interface : proxies->keys()) {
        robot.proxies[interface] = static_cast<int>(proxies->integer(interface, 0, 0, 65535));
      }
    }
    read_some(reader, robot, {"fiducial", "real"});
    robot.interfaces = read_interfaces(reader, robot.devices, model.interfaces);
    reader.finish();
  }

  /// Adds the model that a robot names to the world, if it is not there yet. Issues of a model's
  /// file are reported once.
  /// @return false if the model is invalid.
  bool load_model(Reader& robot_reader, const std::string& name) {
    if (find_robot_model(world_, name) != nullptr) return true;
    if (bad_models_.contains(name)) return false;
    std::optional<RobotModel> model = read_model(robot_reader, name, document_, types_);
    if (!model) {
      bad_models_.insert(name);
      return false;
    }
    world_.models.emplace(name, std::make_shared<const RobotModel>(*std::move(model)));
    return true;
  }

  static DriverDescription read_driver(Reader& reader) {
    DriverDescription driver;
    read_some(reader, driver, {"type"});
    for (const std::string& key : reader.keys()) {
      if (key == "type") continue;
      Reader setting = *reader.child(key);
      if (const std::optional<std::string> text = setting.scalar_text()) {
        driver.settings[key] = *text;
      } else {
        setting.issue("world/wrong-type", "a number, a text, true or false",
                      setting.description_for_message(), hint_for_player_option(driver.type, key));
      }
    }
    return driver;
  }

  Reader::Document& document_;
  const std::vector<DeviceType>& types_;
  WorldDescription world_;
  std::set<std::string> bad_models_;
  std::vector<std::vector<Vec2>> map_corners_;  ///< in W, of each map
  Vec2 only_map_size_ = Vec2::Zero();  ///< of a map without a size; exact, unlike the corners
};

}  // namespace

WorldDescription read_world_document(std::string_view text, const std::vector<DeviceType>& types,
                                     Reader::Document& document) {
  if (text.size() > kMaxFileBytes) {
    document.add({"file/too-large", document.file, "", "at most 16 MiB", "more", ""});
  } else if (parse_document(text, document)) {
    return WorldReader(document, types).read();
  }
  return {};
}

WorldDescription read_world_text(std::string_view text, const std::string& file,
                                 const std::vector<DeviceType>& device_types) {
  Reader::Document document;
  document.file = file;
  WorldDescription world = read_world_document(text, device_types, document);
  throw_issues(document);
  return world;
}

WorldDescription read_world(const std::string& path, const std::vector<DeviceType>& device_types) {
  Reader::Document document;
  document.file = path;
  std::string text;
  if (!read_file(path, text, document)) throw_issues(document);
  if (is_stage_file(path, text)) return stage::read_world(path, text, device_types);
  return read_world_text(text, path, device_types);
}

}  // namespace sim::io
