// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/stage_world.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "io/check_world.h"
#include "io/stage/file_search.h"
#include "io/stage/translation.h"
#include "io/world_document.h"
#include "sim/core/file.h"
#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/io/stage_import.h"
#include "sim/world/robot_model.h"

namespace sim::io {
namespace stage {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostConfigBytes = std::size_t{1} << 20;

/// The names that a configuration file gives as `worldfile`; the first one counts.
const Value* world_file_of(const Entity& config) {
  for (const Entity& driver : config.children) {
    const Property* world = driver.find("worldfile");
    if (world != nullptr && !world->values.empty() && world->values.front().is_text) {
      return &world->values.front();
    }
  }
  return nullptr;
}

constexpr const char* kEmptyFile = "an empty file, or one of comments only";

bool is_empty(const Entity& file, std::string_view text) {
  return file.properties.empty() && file.children.empty() && tokens_of(text, nullptr).size() == 1;
}

/// Path of the world file that a configuration file names.
std::string world_file_path(const Value& name, const std::string& config, Report& report) {
  std::vector<fs::path> folders{folder_of(config)};
  for (fs::path& folder : stage_folders()) folders.push_back(std::move(folder));
  const auto found = find_file(name.text, folders);
  if (!found) return (folder_of(config) / name.text).string();
  if (found->by_base_name) note_other_path(name.text, found->path, name.place, report);
  return found->path;
}

/// Whether a name in a file, in UTF-8, is that of a file on disk.
bool is_name_of(const std::string& name, const fs::path& file) {
  return fs::path(name).filename() == utf8_text(file.string());
}

/// The configuration file in a world's folder that names the world: one of the same name, or the
/// only one. nullopt if there is none; several are noted.
std::optional<Entity> find_config(const fs::path& world, Report& report, const Place& place) {
  constexpr std::size_t kMostFiles = 200;
  std::vector<fs::path> files;
  std::error_code error;
  const fs::path folder = world.has_parent_path() ? folder_of(world.string()) : ".";
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    if (file->path().extension() == ".cfg" && files.size() < kMostFiles) {
      files.push_back(file->path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::pair<std::string, std::string>> found;  // name and text
  for (const fs::path& file : files) {
    std::string text;
    if (read_whole_file(file.string(), {.most_bytes = kMostConfigBytes}, text)) continue;
    const std::string named_as = (world.has_parent_path() ? file : file.filename()).string();
    const bool same_name = file.stem() == world.stem();
    try {
      Report own(report.world_file());  // of a file that may not be used
      const Entity config = read_player_file(text, named_as, own);
      const Value* name = world_file_of(config);
      if (name == nullptr || !is_name_of(name->text, world.filename())) continue;
    } catch (const ConfigError& mistake) {
      // Nobody has named this file, so it may be about another world.
      if (!same_name && text.find(world.filename().string()) == std::string::npos) continue;
      const ConfigIssue& issue = mistake.issues().front();
      report.note("config " + named_as,
                  {std::make_shared<const std::string>(issue.file), issue.line, issue.column},
                  "the configuration file " + in_quotes(utf8_text(named_as)) +
                      " is left out: expected " + issue.expected + ", found " + issue.found);
      continue;
    }
    found.emplace_back(named_as, std::move(text));
    if (!same_name) continue;
    found = {std::move(found.back())};
    break;
  }
  if (found.size() == 1) {
    return read_player_file(found.front().second, found.front().first, report);
  }
  if (found.size() > 1) {
    std::vector<std::string> names;
    for (const auto& [name, text] : found) {
      names.push_back(utf8_text(fs::path(name).filename().string()));
    }
    report.note("configs", place,
                "several configuration files name this world: " + list_text(names, " and ") +
                    "; name one instead of the world to use its ports");
  }
  return std::nullopt;
}

/// Whether a text is XML, as worlds of Gazebo are.
bool is_xml(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

void refuse_gazebo(const std::string& path, std::string_view text) {
  if (!is_xml(text)) return;
  throw ConfigError({"stage/gazebo", path, "", "a world file of Stage",
                     "XML, as in worlds of Gazebo (SDF)",
                     "Playpen reads worlds of Stage and its own; describe the walls of this world "
                     "in one of these"});
}

std::string content_of(const std::string& path, const Place* named_at, const char* what) {
  Reader::Document document;
  document.file = path;
  std::string text;
  if (read_file(path, text, document, what,
                named_at == nullptr ? NamedBy::kUser : NamedBy::kFile)) {
    return text;
  }
  if (named_at == nullptr) throw_issues(document);
  const ConfigIssue& issue = document.issues.front();
  throw ConfigError(issue_at(*named_at, "stage/no-world", what, path + ": " + issue.found));
}

void throw_errors(const Report& report) {
  if (report.has_errors()) throw ConfigError(report.errors());
}

/// A translated world, and the world that it gives.
struct Result {
  ImportedWorld files;
  WorldDescription world;
};

/// Whether an issue is about the place of a robot, which Stage does not check.
bool is_about_place(const ConfigIssue& issue) {
  constexpr std::string_view kIds[] = {"world/robot-overlaps-obstacle", "world/robot-overlaps-wall",
                                       "world/robots-overlap", "world/robot-outside"};
  return std::find(std::begin(kIds), std::end(kIds), issue.id) != std::end(kIds);
}

/// The free pose that is nearest to a robot's own, with the same heading, at most 3 m away.
std::optional<Pose> nearest_free_pose(const WorldDescription& world, const std::vector<Pose>& poses,
                                      std::size_t robot) {
  constexpr double kStep_m = 0.02;
  constexpr double kFarthest_m = 3.0;
  constexpr int kDirections = 16;
  const Pose& own = poses[robot];
  for (double distance_m = kStep_m; distance_m <= kFarthest_m; distance_m *= 1.2) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / kDirections;
      const Pose moved{own.x_m + distance_m * math::cos(angle_rad),
                       own.y_m + distance_m * math::sin(angle_rad), own.yaw_rad};
      if (!blocked_by(world, poses, robot, moved)) return moved;
    }
  }
  return std::nullopt;
}

/// Moves robots that overlap something to the nearest free place.
/// @return whether all of them have one.
bool make_room(const WorldDescription& world, const std::vector<ConfigIssue>& issues,
               Translation& translation, Report& report) {
  std::vector<Pose> poses;
  for (const RobotDescription& robot : world.robots) poses.push_back(robot.pose);
  std::vector<std::size_t> robots;
  for (const ConfigIssue& issue : issues) {
    constexpr std::string_view kBegin = "/robots/";
    const std::string number = issue.pointer.substr(kBegin.size());
    const auto index = static_cast<std::size_t>(std::stoul(number));
    if (robots.empty() || robots.back() != index) robots.push_back(index);
  }
  for (const std::size_t robot : robots) {
    const std::optional<Pose> pose = nearest_free_pose(world, poses, robot);
    if (!pose) return false;
    const double distance_m =
        math::hypot(pose->x_m - poses[robot].x_m, pose->y_m - poses[robot].y_m);
    poses[robot] = *pose;
    translation.world["robots"][robot]["pose"] = pose_json(*pose);
    report.note("place of " + world.robots[robot].name, translation.robots[robot].place,
                "robot " + world.robots[robot].name +
                    " overlaps something at its start, so it starts " + fixed_text(distance_m, 2) +
                    " m beside it");
  }
  return true;
}

/// Replaces places in the translated file by those in the user's files.
void restore_places(std::vector<ConfigIssue>& issues, const Translation& translation,
                    const std::string& path) {
  for (ConfigIssue& issue : issues) {
    std::string key = issue.file == path ? issue.pointer : issue.file;
    auto place = translation.places.find(key);
    while (place == translation.places.end() && !key.empty()) {
      key.resize(key.find_last_of('/') == std::string::npos ? 0 : key.find_last_of('/'));
      place = translation.places.find(key);
    }
    issue.file = path;
    issue.line = 0;
    if (place == translation.places.end()) continue;
    issue.file = *place->second.file;
    issue.line = place->second.line;
    issue.column = place->second.column;
    issue.pointer = issue.pointer.substr(std::min(issue.pointer.size(), key.size()));
  }
  // What has no place, such as the size of the floor, follows from what has one.
  const auto has_no_place = [](const ConfigIssue& issue) { return issue.line == 0; };
  if (!std::all_of(issues.begin(), issues.end(), has_no_place)) std::erase_if(issues, has_no_place);
}

Result import(const std::string& path, const std::string& text, const std::string& config_path,
              const std::vector<DeviceType>& types) {
  std::string world_path = path;
  std::string world_text = text;
  std::optional<Entity> config;
  Report report(path);
  const bool from_config = fs::path(path).extension() == ".cfg";
  if (from_config) {
    config = read_player_file(text, path, report);
    const Value* name = world_file_of(*config);
    if (name == nullptr) {
      throw ConfigError({"stage/no-world", path, "", "a driver \"stage\" with a \"worldfile\"",
                         is_empty(*config, text) ? kEmptyFile : "none",
                         "name the world file itself"});
    }
    world_path = world_file_path(*name, path, report);
    world_text = content_of(world_path, &name->place, "a world file of Stage");
  } else if (!config_path.empty()) {
    config = read_player_file(content_of(config_path, nullptr, "a configuration file of Player"),
                              config_path, report);
  }
  refuse_gazebo(world_path, world_text);
  report.set_world_file(world_path);
  const Entity root = read_world_file(world_text, world_path, report);
  if (is_empty(root, world_text)) {
    throw ConfigError({"stage/empty", world_path, "", "models of Stage", kEmptyFile,
                       "a world has at least a model, such as position ( name \"r0\" )"});
  }
  const bool must_match = config.has_value();
  const Place first_line{std::make_shared<const std::string>(world_path), 1, 1};
  if (!config) config = find_config(world_path, report, first_line);
  Translation translation = translate(root, fs::path(world_path).stem().string(), report);
  throw_errors(report);
  if (config) apply_player_file(*config, must_match, translation, report);
  throw_errors(report);
  finish_robots(translation);

  Result result;
  for (bool moved = false;; moved = true) {
    Reader::Document document;
    document.file = path;
    document.files = &translation.files;
    result.files.world = file_text(translation.world);
    result.world = read_world_document(result.files.world, types, document);
    if (document.issues.empty()) break;
    const bool only_places =
        !moved && std::all_of(document.issues.begin(), document.issues.end(), is_about_place);
    if (only_places && make_room(result.world, document.issues, translation, report)) continue;
    restore_places(document.issues, translation, path);
    throw ConfigError(std::move(document.issues));
  }
  result.files.files = std::move(translation.files);
  result.files.notes = report.notes();
  result.world.notes = result.files.notes;
  return result;
}

}  // namespace

WorldDescription read_world(const std::string& path, const std::string& text,
                            const std::vector<DeviceType>& types) {
  return import(path, text, "", types).world;
}

}  // namespace stage

bool is_stage_file(const std::string& path, std::string_view text) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".world" && ending != ".inc" && ending != ".cfg") return false;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t\r\n", at)) != std::string_view::npos) {
    if (text[at] != '#') break;  // skip a comment to the end of the line
    at = std::min(text.find_first_of("\r\n", at), text.size());
  }
  // JSON begins with a bracket, a quote, a number or the '/' of a comment.
  return at == std::string_view::npos ||
         std::string_view("{[/\"").find(text[at]) == std::string_view::npos;
}

ImportedWorld import_stage_world(const std::string& path, const std::string& config,
                                 const std::vector<DeviceType>& device_types) {
  const std::string text = stage::content_of(path, nullptr, "a world file of Stage");
  return stage::import(path, text, config, device_types).files;
}

}  // namespace sim::io
