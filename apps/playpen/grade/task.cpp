// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/task.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <system_error>
#include <utility>

#include "grade/rubric_reader.h"
#include "sim/io/field_reader.h"
#include "sim/io/reader.h"
#include "sim/io/settings_file.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;
using sim::io::NumberRange;
using sim::io::Reader;

constexpr std::size_t kMaxItems = 10'000;  ///< seeds, worlds, arguments
constexpr NumberRange kPosition{-1e6, 1e6, false, "m"};
constexpr NumberRange kLength{0.0, 1e6, false, "m"};
constexpr NumberRange kArea{0.0, 1e9, false, "m^2"};
constexpr NumberRange kTime{0.0, 1e9, true, "s"};
constexpr NumberRange kShare{0.0, 1.0, false, ""};
constexpr NumberRange kPoints{-1e9, 1e9, false, ""};

/// An optional number.
std::optional<double> optional_number(Reader& reader, const char* key, const NumberRange& range) {
  if (!reader.has(key)) return std::nullopt;
  return reader.number(key, 0.0, range);
}

/// Reads what `playpen fuzz` may change.
void read_fuzz_section(Reader& root, sim::FuzzDescription& fuzz) {
  std::optional<Reader> section = root.object("fuzz");
  if (!section) return;
  sim::io::read_fields(*section, sim::fields_of<sim::FuzzDescription>(), &fuzz);
  section->finish();
}

class TaskReader {
 public:
  explicit TaskReader(const std::string& file) {
    task_.file = file;
    task_.name = fs::path(file).filename().string();
    for (const std::string_view ending : {kTaskSuffix, std::string_view(".json")}) {
      if (task_.name.ends_with(ending) && task_.name.size() > ending.size()) {
        task_.name.resize(task_.name.size() - ending.size());
      }
    }
  }

  void read(Reader& root) {
    if (!root.expect_object()) return;
    static_cast<void>(root.string("$schema", ""));
    task_.description = root.string("description", "");
    read_worlds(root);
    read_seeds(root);
    if (root.has("duration")) task_.duration_s = root.number("duration", 0.0, kTime);
    task_.timeout_s = root.number("timeout", task_.timeout_s, kTime);
    task_.arguments = read_arguments(root);
    task_.goal = read_goal(root);
    task_.robot = root.name("robot", "");
    task_.map_layer = root.string("map", "");
    read_may_use(root);
    read_thresholds(root);
    task_.rubric = read_rubric(root, [&](Reader& item, FigureNeed need) {
      if (need == FigureNeed::kMap) require_map(root, item, "figure");
      if (need == FigureNeed::kGoal) require_goal(root, item, "figure");
    });
    sim::FuzzDescription fuzz;
    read_fuzz_section(root, fuzz);
    root.finish();
  }

  [[nodiscard]] Task take() { return std::move(task_); }

 private:
  void read_worlds(Reader& root) {
    if (!root.require("worlds", "a list of world files, relative to this file")) return;
    std::vector<Reader> elements = root.array("worlds", kMaxItems);
    if (elements.empty()) {
      const std::optional<Reader> list = root.child("worlds");
      if (list->is_array()) {
        root.issue("world/out-of-range", "at least one world", list->description_for_message(), "",
                   "worlds");
      }
    }
    std::map<std::string, std::string> places;  // JSON pointers of the names
    for (Reader& element : elements) {
      TaskWorld world;
      std::string name;
      if (element.is_string()) {
        name = element.scalar_text().value_or("");
      } else if (element.is_object()) {
        if (element.require("world", "the world's file, relative to this file")) {
          name = element.string("world", "");
        }
        world.arguments = read_arguments(element);
        world.goal = read_goal(element);
        element.finish();
      } else {
        element.issue("world/wrong-type",
                      "the name of a world file in double quotes, or an object {...}",
                      element.description_for_message());
      }
      if (name.empty() && !element.is_string()) continue;  // already reported
      world.file = (fs::path(task_.file).parent_path() / name).string();
      std::error_code error;
      if (name.empty() || !fs::is_regular_file(world.file, error)) {
        element.issue("task/unknown-world", "a world file", '"' + name + "\", which is not there",
                      "the name is relative to the folder of the task file");
        continue;
      }
      const auto [other, is_new] = places.emplace(world_name(world.file), element.pointer());
      if (!is_new) {
        element.issue("task/duplicate-world", "worlds with names of their own",
                      '"' + other->first + "\" a second time", "the first is " + other->second);
        continue;
      }
      task_.worlds.push_back(std::move(world));
    }
  }

  void read_seeds(Reader& root) {
    if (!root.has("seeds")) return;
    if (const std::optional<Reader> seeds = root.child("seeds"); !seeds->is_array()) {
      if (!seeds->is_number()) {
        root.issue("world/wrong-type", "a list of seeds, or how many there are",
                   seeds->description_for_message(), "", "seeds");
        return;
      }
      const std::int64_t count = root.integer("seeds", 1, 1, kMaxItems);
      task_.seeds.clear();
      for (std::int64_t i = 1; i <= count; ++i) {
        task_.seeds.push_back(static_cast<std::uint64_t>(i));
      }
      return;
    }
    std::vector<Reader> elements = root.array("seeds", kMaxItems);
    if (elements.empty()) {
      root.issue("world/out-of-range", "at least one seed", "none", "", "seeds");
      return;
    }
    task_.seeds.clear();
    std::set<std::uint64_t> taken;
    for (Reader& element : elements) {
      constexpr const char* kExpected = "a whole number from 0 to 18446744073709551615";
      const std::string text = element.scalar_text().value_or("");
      std::uint64_t seed = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
      if (!element.is_number()) {
        element.issue("world/wrong-type", kExpected, element.description_for_message());
      } else if (error != std::errc() || end != text.data() + text.size()) {
        element.issue("world/out-of-range", kExpected, element.description_for_message());
      } else if (!taken.insert(seed).second) {
        element.issue("task/duplicate-seed", "each seed once", text + " a second time",
                      "equal seeds give equal runs");
      } else {
        task_.seeds.push_back(seed);
      }
    }
  }

  static std::vector<std::string> read_arguments(Reader& reader) {
    std::vector<std::string> arguments;
    for (Reader& element : reader.array("arguments", kMaxItems)) {
      if (element.is_string()) {
        arguments.push_back(element.scalar_text().value_or(""));
      } else {
        element.issue("world/wrong-type", "an argument of the program in double quotes",
                      element.description_for_message());
      }
    }
    return arguments;
  }

  /// A list of names.
  static std::vector<std::string> read_names(Reader& parent, const char* key) {
    std::vector<std::string> names;
    for (Reader& element : parent.array(key, kMaxItems)) {
      if (element.is_string()) {
        names.push_back(element.scalar_text().value_or(""));
      } else {
        element.issue("world/wrong-type", "a name in double quotes",
                      element.description_for_message());
      }
    }
    return names;
  }

  void read_may_use(Reader& root) {
    std::optional<Reader> reader = root.object("may_use");
    if (!reader) return;
    playerlike::MayUse& may_use = task_.may_use.emplace();
    may_use.robots = read_names(*reader, "robots");
    if (reader->has("devices")) may_use.devices = read_names(*reader, "devices");
    for (Reader& element : reader->array("world", kMaxItems)) {
      const std::string word = element.is_string() ? element.scalar_text().value_or("") : "";
      if (std::find(playerlike::kWorldData.begin(), playerlike::kWorldData.end(), word) ==
          playerlike::kWorldData.end()) {
        element.issue("world/unknown-value", "\"map\", \"objects\" or \"arena\"",
                      element.description_for_message());
      } else {
        may_use.world.push_back(word);
      }
    }
    reader->finish();
  }

  static std::optional<Goal> read_goal(Reader& parent) {
    std::optional<Reader> reader = parent.object("goal");
    if (!reader) return std::nullopt;
    Goal goal;
    for (const char* key : {"x", "y"}) {
      if (reader->require(key, "where the robot is to be, in m")) {
        (*key == 'x' ? goal.position.x() : goal.position.y()) = reader->number(key, 0.0, kPosition);
      }
    }
    if (reader->has("yaw_deg"))
      goal.yaw_rad = sim::normalize_angle(reader->angle_deg("yaw_deg", 0));
    goal.tolerance_m = reader->number("tolerance", goal.tolerance_m, {0.0, 1000.0, true, "m"});
    goal.yaw_tolerance_rad = reader->angle_deg("yaw_tolerance_deg", goal.yaw_tolerance_rad,
                                               {0.0, 180.0, true, "degrees"});
    reader->finish();
    return goal;
  }

  void read_thresholds(Reader& root) {
    std::optional<Reader> reader = root.object("thresholds");
    if (!reader) return;
    Thresholds& t = task_.thresholds;
    t.min_coverage = optional_number(*reader, "min_coverage", kShare);
    t.min_correctness = optional_number(*reader, "min_correctness", kShare);
    if (reader->has("max_collisions")) {
      t.max_collisions = static_cast<int>(reader->integer("max_collisions", 0, 0, 1'000'000));
    }
    t.min_clearance_m = optional_number(*reader, "min_clearance", kLength);
    t.min_path_length_m = optional_number(*reader, "min_path_length", kLength);
    t.max_path_length_m = optional_number(*reader, "max_path_length", kLength);
    t.min_distance_m = optional_number(*reader, "min_distance", kLength);
    t.min_visited_area_m2 = optional_number(*reader, "min_visited_area", kArea);
    t.max_path_ratio = optional_number(*reader, "max_path_ratio", {1.0, 1e6, false, ""});
    t.max_sim_time_s = optional_number(*reader, "max_sim_time", kTime);
    t.max_stalled_time_s = optional_number(*reader, "max_stalled_time", {0.0, 1e9, false, "s"});
    t.must_reach = reader->boolean("must_reach", t.must_reach);
    t.must_end = reader->boolean("must_end", t.must_end);
    t.min_score = optional_number(*reader, "min_score", kPoints);
    t.must_pass = reader->boolean("must_pass", t.must_pass);
    for (const char* key : {"min_coverage", "min_correctness"}) {
      if (reader->has(key)) require_map(root, *reader, key);
    }
    if (t.must_reach) require_goal(root, *reader, "must_reach");
    if (t.max_path_ratio) require_goal(root, *reader, "max_path_ratio");
    reader->finish();
  }

  /// Records an issue at a key of `user`, which needs a map, if the task names none.
  static void require_map(Reader& root, Reader& user, const char* key) {
    if (root.has("map")) return;
    user.issue("task/missing-map", "a task with the key \"map\"", "none",
               "it names the layer that the program draws its map in", key);
  }

  /// Records an issue at a key of `user`, which needs a goal, if a world has none.
  void require_goal(Reader& root, Reader& user, const char* key) const {
    if (root.has("goal")) return;
    const auto without = std::find_if(task_.worlds.begin(), task_.worlds.end(),
                                      [](const TaskWorld& world) { return !world.goal; });
    if (without == task_.worlds.end()) return;
    user.issue("task/missing-goal", "a \"goal\" in the task or in each of its worlds",
               "none for \"" + world_name(without->file) + '"', "", key);
  }

  Task task_;
};

}  // namespace

std::string world_name(const std::string& world_file) {
  if (world_file.empty()) return "default";
  if (world_file.starts_with("/dev/fd/")) return "pipe";
  return fs::path(world_file).stem().string();
}

Task read_task(const std::string& path) {
  TaskReader reader(path);
  sim::io::read_settings(path, "task", [&reader](Reader& root) { reader.read(root); });
  return reader.take();
}

void read_fuzz(const std::string& path, sim::FuzzDescription& fuzz) {
  sim::io::read_settings(path, "task", [&fuzz](Reader& root) { read_fuzz_section(root, fuzz); });
}

Task read_task_text(std::string_view text, const std::string& file) {
  TaskReader reader(file);
  sim::io::read_settings_text(text, file, "task", [&reader](Reader& root) { reader.read(root); });
  return reader.take();
}

}  // namespace playpen::grade
