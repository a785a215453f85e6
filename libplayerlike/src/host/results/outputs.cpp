// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/outputs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "host/mirror/mirror.h"
#include "host/requests/arena.h"
#include "host/results/picture_sizes.h"
#include "host/results/recorder.h"
#include "playerlike/host/results.h"
#include "sim/canvas/layers.h"
#include "sim/core/base64.h"
#include "sim/core/number_text.h"
#include "sim/core/replace_file.h"
#include "sim/io/map_file.h"
#include "sim/render/render.h"
#include "sim/world/realism.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLayerFolder = "layers";

// Pixels per cell: a whole number, so that cells have sharp edges.
int cell_scale(const sim::CanvasDescription& canvas) {
  return std::max(1, kCanvasMostSize_px / std::max(canvas.width, canvas.height));
}

// A file name for a layer. Other characters could form a path or cause problems.
std::string safe_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_';
    if (!plain) c = '_';
  }
  return safe.empty() ? "_" : safe;
}

// The file names of layers, without endings. Names that would be equal, ignoring case, get their
// owner's port as a suffix, and a number if they are still equal.
std::vector<std::string> file_names(const std::vector<sim::LayerInfo>& layers) {
  const auto folded = [](std::string name) {
    for (char& c : name) {
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return name;
  };
  std::map<std::string, int> count;
  for (const sim::LayerInfo& layer : layers) ++count[folded(safe_name(layer.style.name))];
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const sim::LayerInfo& layer : layers) {
    const std::string plain = safe_name(layer.style.name);
    std::string name = plain;
    if (count[folded(plain)] > 1 && layer.id != sim::kBaseLayer) {
      name += "_";
      name += std::to_string(layer.owner);
    }
    const std::string base = name;
    for (int number = 2; !taken.insert(folded(name)).second; ++number) {
      name = base;
      name += "_";
      name += std::to_string(number);
    }
    names.push_back(name);
  }
  return names;
}

// Removes the files of a folder for which `is_ours` is true.
template <typename Predicate>
void remove_files(const fs::path& folder, Predicate is_ours) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  std::vector<fs::path> ours;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() && is_ours(entry.path())) ours.push_back(entry.path());
  }
  for (const fs::path& file : ours) {
    fs::remove(file, error);
    if (error) {
      throw std::runtime_error("an earlier result, " + file.string() +
                               ", can't be removed: " + error.message());
    }
  }
}

void remove_if_empty(const fs::path& folder) {
  std::error_code ignored;
  fs::remove(folder, ignored);  // fails, as intended, unless the folder is empty
}

void remove_layers(const fs::path& folder) {
  remove_files(folder / kLayerFolder, [](const fs::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".png" || ending == ".pgm" || ending == ".yaml";
  });
  remove_if_empty(folder / kLayerFolder);
}

void write_layers(const fs::path& folder, const sim::LayerStack& stack) {
  remove_layers(folder);
  const std::vector<sim::LayerInfo> layers = stack.layers();
  const std::vector<std::string> names = file_names(layers);
  const sim::CanvasDescription canvas = stack.description();
  fs::create_directories(folder / kLayerFolder);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const sim::LayerId id = layers[i].id;
    const std::string stem = (folder / kLayerFolder / names[i]).string();
    sim::render::write_png(sim::render::draw_canvas(canvas, stack.picture(id), cell_scale(canvas)),
                           stem + ".png");
    if (layers[i].kind != sim::LayerKind::kGrey) continue;
    sim::io::write_map(occupancy_map(canvas, stack.cells(id)), stem);
  }
}

// How far a robot has got, what it has seen, and who has commanded it.
void add_achievements(const Recorder& recorder, std::size_t robot, nlohmann::ordered_json& entry) {
  if (const TravelMeter* const travel = recorder.travel(robot)) {
    entry["distance"] = travel->distance_m();
    entry["visited_area"] = travel->visited_area_m2();
  }
  const SeenFloor* const seen = recorder.seen_floor();
  if (seen != nullptr && static_cast<std::size_t>(seen->robot()) == robot) {
    entry["seen"] = {{"area", seen->area_m2()},
                     {"cell_size", seen->cell_size_m()},
                     {"x", seen->origin().x()},
                     {"y", seen->origin().y()},
                     {"width", seen->width()},
                     {"height", seen->height()},
                     {"cells", sim::to_base64(seen->bits())}};
  }
  if (recorder.commands() == nullptr) return;
  const CommandBook::Entry& commands = recorder.commands()->of(robot);
  entry["commanded"] = nullptr;
  if (!commands.first_ns) return;
  entry["commanded"] = {{"first", sim::to_seconds(*commands.first_ns)},
                        {"commands", commands.count},
                        {"ports", commands.ports}};
}

// What the task of a graded run has refused to the program.
void add_refusals(const RefusalBook& refusals, nlohmann::ordered_json& report) {
  if (refusals.refusals().empty()) return;
  nlohmann::ordered_json& refused = report["refused"] = nlohmann::ordered_json::array();
  for (const RefusalBook::Refusal& r : refusals.refusals()) {
    refused.push_back({{"time", sim::to_seconds(r.time_ns)}, {"what", r.what}});
  }
}

// Collisions and goals of the robots, with their times.
void add_events(const sim::Simulation& simulation, const std::vector<Goal>& goals,
                nlohmann::ordered_json& report) {
  const auto name_of = [&](int robot) {
    return simulation.world().robots[static_cast<std::size_t>(robot)].name;
  };
  report["collisions"] = nlohmann::ordered_json::array();
  for (const sim::Collision& c : simulation.collisions()) {
    report["collisions"].push_back({{"time", sim::to_seconds(c.time_ns)},
                                    {"robot", name_of(c.robot)},
                                    {"with", c.partner},
                                    {"x", c.place.x()},
                                    {"y", c.place.y()}});
  }
  report["goals"] = nlohmann::ordered_json::array();
  for (const Goal& g : goals) {
    nlohmann::ordered_json goal = {{"time", sim::to_seconds(g.set_ns)},
                                   {"robot", name_of(g.robot)},
                                   {"x", g.place.x()},
                                   {"y", g.place.y()}};
    goal["reached"] = nullptr;
    if (g.reached_ns) goal["reached"] = sim::to_seconds(*g.reached_ns);
    report["goals"].push_back(std::move(goal));
  }
}

// Events of the arena, its blocks, and the scores and the verdict of its controller.
void add_arena(const sim::Simulation& simulation, nlohmann::ordered_json& report) {
  using nlohmann::ordered_json;
  if (!simulation.records_arena_events()) return;
  ordered_json& events = report["events"] = ordered_json::array();
  for (const sim::ArenaEvent& e : simulation.arena_events().newest) {
    ordered_json event = {{"number", e.number},
                          {"time", sim::to_seconds(e.time_ns)},
                          {"kind", to_string(e.kind)},
                          {"what", e.what}};
    if (!e.who.empty()) event["who"] = e.who;
    if (!e.text.empty()) event["text"] = e.text;
    if (e.value != 0.0 || e.kind == sim::ArenaEventKind::kEnd) event["value"] = e.value;
    events.push_back(std::move(event));
  }
  ordered_json& blocks = report["blocks"] = ordered_json::object();
  for (const ArenaBlock& block : arena_blocks(simulation)) blocks[block.name] = block.state;
  if (simulation.world().controller.empty()) return;
  ordered_json& scores = report["scores"] = ordered_json::object();
  for (std::size_t i = 0; i < simulation.scores().size(); ++i) {
    scores[simulation.world().robots[i].name] = simulation.scores()[i];
  }
  report["verdict"] = nullptr;
  if (const auto& verdict = simulation.verdict()) {
    report["verdict"] = {{"passed", verdict->passed},
                         {"reason", verdict->reason},
                         {"time", sim::to_seconds(verdict->time_ns)}};
  }
}

nlohmann::ordered_json report(const sim::Simulation& simulation, const Recorder& recorder,
                              const TimeStatistics& time) {
  nlohmann::ordered_json robots = nlohmann::ordered_json::array();
  for (int i = 0; i < simulation.robot_count(); ++i) {
    const sim::RobotStatistics& s = simulation.statistics(i);
    const sim::Pose& X_WB = simulation.body(i).X_WB;
    robots.push_back({{"name", simulation.world().robots[static_cast<std::size_t>(i)].name},
                      {"path_length", s.path_length_m},
                      {"collisions", s.collisions},
                      {"least_clearance", s.least_clearance_m},
                      {"stalled_time", s.stalled_time_s},
                      {"final_pose", {{"x", X_WB.x_m}, {"y", X_WB.y_m}, {"yaw", X_WB.yaw_rad}}}});
    if (const auto driven_s = recorder.driven_time_s(static_cast<std::size_t>(i))) {
      robots.back()["driven_time"] = *driven_s;
    }
    add_achievements(recorder, static_cast<std::size_t>(i), robots.back());
  }
  nlohmann::ordered_json said = nlohmann::ordered_json::array();
  for (const sim::SpokenText& u : simulation.spoken_texts()) {
    said.push_back({{"time", sim::to_seconds(u.time_ns)},
                    {"robot", simulation.world().robots[static_cast<std::size_t>(u.robot)].name},
                    {"text", u.text}});
  }
  nlohmann::ordered_json whole = {
      {"run",
       {{"world", simulation.world().name},
        {"seed", simulation.world().simulation.seed},
        {"realism", sim::to_string(simulation.world().simulation.realism)},
        {"steps", simulation.steps()},
        {"sim_time", sim::to_seconds(simulation.now_ns())},
        {"wall_time", time.wall_time_s},
        {"real_time_factor", time.real_time_factor},
        {"state_hash", nullptr}}},
      {"robots", robots},
      {"said", said}};
  add_events(simulation, recorder.goals().goals(), whole);
  add_arena(simulation, whole);
  add_refusals(recorder.refusals(), whole);
  if (recorder.mirror() != nullptr) whole["mirror"] = recorder.mirror()->report();
  // `playpen plot` reads the scene from this file.
  std::error_code error;
  const fs::path file = fs::absolute(simulation.world().file, error);
  if (!error && fs::is_regular_file(file, error)) whole["run"]["world_file"] = file.string();
  whole["run"]["repeatable"] = time.unrepeatable.empty();
  if (!time.unrepeatable.empty()) whole["run"]["repeatable_why"] = time.unrepeatable;
  return whole;
}

// The path, without ending, of a client's "picture" or "map" in the output folder. The name may
// include the first ending.
std::string saved_stem(const std::string& folder, const std::string& what, const std::string& name,
                       std::initializer_list<std::string_view> endings) {
  const std::string_view first = *endings.begin();
  if (!is_plain_file_name(name)) {
    throw SessionError(
        SessionError::Code::kBadArgument,
        "a " + what + " is saved in the run's output folder, under a plain file name of 1 to " +
            std::to_string(kMaxFileName) + " characters such as \"map" + std::string(first) +
            "\", without folders and no dot in front; but the name is \"" +
            name.substr(0, kMaxFileName) + '"');
  }
  if (folder.empty()) {
    throw SessionError(SessionError::Code::kNotAvailable,
                       "there is no folder to save " + what +
                           "s in: name one by `playpen run --out FOLDER` or PLAYPEN_OUT");
  }
  const std::string plain =
      name.ends_with(first) ? name.substr(0, name.size() - first.size()) : name;
  std::string stem = (fs::path(folder) / plain).string();
  for (const std::string_view ending : endings) {
    const std::string file = stem + std::string(ending);
    std::error_code ignored;  // if the file cannot be checked, writing it fails too
    if (fs::is_symlink(file, ignored)) {
      throw SessionError(SessionError::Code::kNotAvailable,
                         file + " is a link, which may lead out of the output folder");
    }
  }
  return stem;
}

}  // namespace

void remove_snapshots(const std::string& folder) {
  remove_files(fs::path(folder) / kSnapshotFolder, [](const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("scene_") && name.ends_with("s.png");
  });
  remove_if_empty(fs::path(folder) / kSnapshotFolder);
}

void remove_results(const std::string& folder) {
  constexpr std::array<std::string_view, 7> kFiles = {
      "report.json", "report.part.json", "scene.png",     "scene.part.png",
      "canvas.png",  "canvas.part.png",  "trajectory.csv"};
  for (const std::string_view name : kFiles) {
    std::error_code error;
    const fs::path file = fs::path(folder) / name;
    fs::remove(file, error);
    if (error) {
      throw std::runtime_error("an earlier result, " + file.string() +
                               ", can't be removed: " + error.message());
    }
  }
  remove_layers(folder);
  remove_snapshots(folder);
  // Pictures that a user saved from the live window.
  remove_files(folder, [](const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("view_") && name.ends_with(".png");
  });
}

nlohmann::ordered_json to_json(const RunEnd& end) {
  const char* by = nullptr;
  switch (end.by) {
    case RunEnd::By::kNothing:
      return nullptr;
    case RunEnd::By::kDuration:
      by = "duration";
      break;
    case RunEnd::By::kVerdict:
      by = "verdict";
      break;
    case RunEnd::By::kProgram:
      by = "program";
      break;
    case RunEnd::By::kRequest:
      by = "request";
      break;
    case RunEnd::By::kWindow:
      by = "window";
      break;
    case RunEnd::By::kRealRobot:
      by = "real robot";
      break;
    case RunEnd::By::kSignal:
      by = "signal";
      break;
  }
  nlohmann::ordered_json ended = {{"by", by}};
  if (end.status) ended["status"] = *end.status;
  if (end.signal) {
    const char* const name = sigabbrev_np(*end.signal);
    ended["signal"] = name != nullptr ? std::string("SIG") + name : std::to_string(*end.signal);
  }
  return ended;
}

nlohmann::ordered_json report_json(const sim::Simulation& simulation, const Recorder& recorder,
                                   const TimeStatistics& time, const RunEnd& end) {
  nlohmann::ordered_json whole = report(simulation, recorder, time);
  whole["ended"] = to_json(end);
  return whole;
}

// Texts of robots may be invalid UTF-8.
std::string text_of_report(const nlohmann::ordered_json& report) {
  return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string report_text(const sim::Simulation& simulation, const Recorder& recorder,
                        const TimeStatistics& time, const RunEnd& end) {
  return text_of_report(report_json(simulation, recorder, time, end));
}

void write_report(const std::string& folder, const std::string& text) {
  const std::string file = (fs::path(folder) / "report.json").string();
  if (const int error = sim::replace_file(file, text)) {
    throw std::runtime_error("cannot write " + file + ": " + std::strerror(error));
  }
}

void write_pictures(const std::string& folder, const sim::LayerStack& layers,
                    const sim::SceneSnapshot& scene, const sim::render::RenderOptions& options) {
  const fs::path out(folder);
  // A failure must not prevent the other writes.
  std::exception_ptr failure;
  const auto attempt = [&failure](const auto& write) {
    try {
      write();
    } catch (const std::exception&) {
      if (!failure) failure = std::current_exception();
    }
  };
  attempt([&] {
    const bool mini_map = scene.view_mode == sim::ViewMode::kMiniMap;
    sim::render::SceneRenderer renderer(scene_options(options));
    sim::render::write_png(
        renderer.draw(scene, mini_map ? sim::ViewMode::kMiniMap : sim::ViewMode::kGround),
        (out / "scene.png").string());
  });
  attempt([&] {
    sim::render::write_png(sim::render::draw_canvas(scene.canvas_description, scene.canvas,
                                                    cell_scale(scene.canvas_description)),
                           (out / "canvas.png").string());
  });
  attempt([&] { write_layers(out, layers); });
  if (failure) std::rethrow_exception(failure);
}

bool is_plain_file_name(const std::string& name) {
  return !name.empty() && name.size() <= kMaxFileName && name.front() != '.' &&
         std::none_of(name.begin(), name.end(), [](char c) {
           const auto byte = static_cast<unsigned char>(c);
           return c == '/' || c == '\\' || byte < 0x20 || byte == 0x7f;
         });
}

sim::OccupancyMap occupancy_map(const sim::CanvasDescription& canvas,
                                const std::vector<sim::CellValue>& cells) {
  sim::OccupancyMap map;
  map.width = canvas.width;
  map.height = canvas.height;
  map.cell_size_m = canvas.cell_size_m;
  map.origin = canvas.origin;
  map.cells.reserve(cells.size());
  for (const sim::CellValue& cell : cells) map.cells.push_back(cell.occupancy());
  return map;
}

std::string picture_file(const std::string& folder, const std::string& name, int scale) {
  constexpr int kMaxScale = 64;
  const std::string stem = saved_stem(folder, "picture", name, {".png"});
  if (scale < 1 || scale > kMaxScale) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a picture has 1 to " + std::to_string(kMaxScale) +
                           " pixels along a cell's side, but " + std::to_string(scale) +
                           " were asked for");
  }
  return stem + ".png";
}

std::string map_stem(const std::string& folder, const std::string& name) {
  return saved_stem(folder, "map", name, {".yaml", ".pgm"});
}

void write_picture(const sim::CanvasDescription& canvas, const std::vector<std::uint8_t>& rgba,
                   int scale, const std::string& file) {
  try {
    sim::render::write_png(sim::render::draw_canvas(canvas, rgba, scale), file);
  } catch (const std::exception& e) {
    throw SessionError(SessionError::Code::kNotAvailable, e.what());
  }
}

void write_map_files(const sim::OccupancyMap& map, const std::string& stem, sim::io::MapMode mode) {
  try {
    sim::io::write_map(map, stem, mode);
  } catch (const std::exception& e) {
    throw SessionError(SessionError::Code::kNotAvailable, e.what());
  }
}

}  // namespace playerlike
