// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "comma_locale.h"
#include "host/results/make_report.h"
#include "host/results/recorder.h"
#include "playerlike/host/program.h"
#include "playerlike/host/report_summary.h"
#include "playerlike/host/results.h"
#include "playerlike/host/run_settings.h"
#include "sim/canvas/layers.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/io/map_file.h"
#include "sim/render/render.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::IsEmpty;

class Outputs : public testing::Test {
 protected:
  sim::LayerId add(sim::LayerKind kind, const std::string& name, int owner) {
    sim::LayerStyle style;
    style.name = name;
    return simulation_.layers().add(kind, style, owner);
  }
  void write() const {
    write_report(folder_.path(),
                 text_of_report(make_report(simulation_, Recorder({}, simulation_), {}, {})));
    write_pictures(folder_.path(), simulation_.layers(), simulation_.snapshot());
  }
  [[nodiscard]] std::vector<std::string> layer_files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "layers")) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  [[nodiscard]] std::string bytes(const std::string& name) const {
    return read_bytes(folder_.path() / name);
  }

  TemporaryFolder folder_;
  sim::Simulation simulation_{sim::load_world_text(R"({
      "name": "small", "arena": {"size": [1, 1]}, "canvas": {"size": [20, 30], "cell_size": 0.05},
      "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5, "yaw_deg": 0}}]})")};
};

TEST_F(Outputs, EachLayer_HasFileAndGreyLayersMap) {
  const sim::LayerId grey = add(sim::LayerKind::kGrey, "occupancy", 6665);
  const sim::LayerId path = add(sim::LayerKind::kBinary, "path", 6665);
  const std::vector<sim::CellValue> wall = {sim::CellValue::of(1.0F)};
  simulation_.layers().set_cells(grey, {.column = 3, .row = 0, .width = 1, .height = 1}, wall);
  write();
  EXPECT_THAT(layer_files(), ElementsAre("canvas.png", "occupancy.pgm", "occupancy.png",
                                         "occupancy.yaml", "path.png"));
  // 20 x 30 cells: 1200 / 30 = 40 pixels per cell.
  sim::render::write_png(sim::render::draw_canvas(simulation_.layers().description(),
                                                  simulation_.layers().picture(path), 40),
                         folder_ / "expected.png");
  EXPECT_TRUE(bytes("layers/path.png") == bytes("expected.png"));
  const sim::OccupancyMap map = sim::io::read_map(folder_ / "layers/occupancy.yaml");
  EXPECT_EQ(map.width, 20);
  EXPECT_EQ(map.height, 30);
  EXPECT_DOUBLE_EQ(map.cell_size_m, 0.05);
  EXPECT_GT(map.at(3, 0), 0.95F);
  EXPECT_NEAR(map.at(4, 0), 0.5, 0.01);  // unknown, in shades of a byte
}

TEST_F(Outputs, LayerNames_MadeSafeAndDistinct) {
  add(sim::LayerKind::kBinary, "../../etc/x", 6665);
  add(sim::LayerKind::kBinary, "path", 6665);
  add(sim::LayerKind::kBinary, "Path", 6666);    // equal if case is ignored
  add(sim::LayerKind::kBinary, "canvas", 6666);  // the name of the base layer
  add(sim::LayerKind::kBinary, "a b", 6665);
  add(sim::LayerKind::kBinary, "a.b", 6665);  // and of the same port
  write();
  EXPECT_THAT(layer_files(),
              ElementsAre("Path_6666.png", "______etc_x.png", "a_b_6665.png", "a_b_6665_2.png",
                          "canvas.png", "canvas_6666.png", "path_6665.png"));
}

TEST_F(Outputs, EqualRuns_SameBytesAndRemovedLayersNoFile) {
  const sim::LayerId grey = add(sim::LayerKind::kGrey, "occupancy", 6665);
  write();
  std::vector<std::string> first;
  const std::vector<std::string> names = layer_files();
  for (const std::string& name : names) first.push_back(bytes("layers/" + name));
  write();
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_TRUE(bytes("layers/" + names[i]) == first[i]) << names[i];
  }
  simulation_.layers().remove(grey);
  write();
  EXPECT_THAT(layer_files(), ElementsAre("canvas.png"));
}

TEST_F(Outputs, ScenePicture_ShowsGroundExceptInMiniMap) {
  simulation_.canvas().draw_line(0, 0, 19, 29, {255, 0, 0, 255});
  write();
  const std::string ground = bytes("scene.png");
  ASSERT_FALSE(simulation_.set_view_mode(sim::ViewMode::kFullScreen));
  write();
  EXPECT_TRUE(bytes("scene.png") == ground);
  ASSERT_FALSE(simulation_.set_view_mode(sim::ViewMode::kMiniMap));
  write();
  EXPECT_FALSE(bytes("scene.png") == ground);
}

TEST_F(Outputs, RemovedResults_OtherFilesStay) {
  add(sim::LayerKind::kGrey, "occupancy", 6665);
  write();
  folder_.write("snapshots/scene_000001.000s.png", "old");
  folder_.write("notes.txt", "mine");
  folder_.write("layers/notes.txt", "mine");
  remove_results(folder_.path());
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
    if (entry.is_regular_file()) left.push_back(fs::relative(entry.path(), folder_.path()));
  }
  std::sort(left.begin(), left.end());
  EXPECT_THAT(left, ElementsAre("layers/notes.txt", "notes.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "snapshots"));
  remove_results(folder_ / "none");  // nothing to do
}

/// Everything that a run writes and prints, by name. The run's world and readings are full of
/// fractions and large numbers.
std::map<std::string, std::string> all_texts_of_a_run() {
  const TemporaryFolder folder;
  std::map<std::string, std::string> texts;
  const std::string world = folder.write("world.json", R"({
      "name": "fractions", "arena": {"size": [1.25, 1.5]},
      "canvas": {"size": [20, 30], "cell_size": 0.05, "origin": [-0.125, 0.0625]},
      "simulation": {"seed": 1234567, "step": 0.0125},
      "robots": [{"name": "r1", "pose": {"x": 0.525, "y": 0.75, "yaw_deg": 22.5},
                  "devices": {"laser": {"noise": 0.0125, "range_max": 234.5}},
                  "drivers": [{"type": "snd", "max_speed": 0.25, "robot_radius": 1.25e-1}]}]})");
  // The world's file is removed after this, so its name must not matter.
  sim::WorldDescription description = sim::load_world(world);
  for (const auto& [key, value] : description.robots.at(0).drivers.at(0).settings) {
    texts["setting " + key] = value;
  }
  sim::Simulation simulation(description);
  simulation.layers().add(sim::LayerKind::kGrey, {.name = "occupancy"}, 6665);
  RunSettings settings;
  settings.output_folder = folder / "out";
  fs::create_directories(folder / "out");
  settings.snapshot_period_s = 0.1;
  settings.duration_s = 1234.5;
  settings.silence_limit_s = 0.25;
  {
    Recorder recorder(settings, simulation);
    const auto motion = simulation.find_device(0, "motion");
    EXPECT_FALSE(
        simulation.apply({0, *motion}, sim::TwistCommand{{.v_mps = 0.0625, .omega_radps = 0.5}}));
    for (int step = 0; step < 20; ++step) {
      simulation.step();
      recorder.observe(simulation);
    }
    recorder.close_trajectory();
    recorder.close_film();
    TimeStatistics time;
    time.wall_time_s = 12.345;
    time.real_time_factor = 1234.5;
    write_report(settings.output_folder,
                 text_of_report(make_report(simulation, Recorder({}, simulation), time, {})));
    write_pictures(settings.output_folder, simulation.layers(), recorder.scene(simulation));
  }
  for (const auto& entry : fs::recursive_directory_iterator(settings.output_folder)) {
    if (!entry.is_regular_file()) continue;
    std::string& text = texts[fs::relative(entry.path(), settings.output_folder)];
    text = read_bytes(entry.path());
    // The report names the world's file, and each call uses a different folder.
    const std::string own = folder.path();
    if (const std::size_t at = text.find(own); at != text.npos) text.replace(at, own.size(), "");
  }
  texts["summary"] = summarize_report(folder / "out/report.json");
  for (const auto& [name, value] : run_environment("", settings)) {
    if (value && name != "PLAYPEN_OUT") texts[name] = *value;
  }
  const sim::OccupancyMap map = sim::io::read_map(folder / "out/layers/occupancy.yaml");
  texts["map"] = sim::shortest_text(map.cell_size_m) + ' ' + sim::shortest_text(map.origin.x());
  for (const char* bad :
       {R"({"robots": [{"pose": {"x": 1.75, "y": 123456.5}}]})",
        R"({"simulation": {"step": 0.75}})",
        R"({"robots": [{"devices": {"battery": {"empty_voltage": 12.75, "full_voltage": 9.5}}}]})",
        R"({"arena": {"size": [1.5, 1.5]}, "robots": [{"pose": {"x": 1.45, "y": 0.5}}]})",
        R"({"robots": [{"pose": {"x": "1.75", "y": 0.5}}]})"}) {
    try {
      static_cast<void>(sim::load_world_text(bad));
    } catch (const sim::ConfigError& error) {
      texts[bad] = error.what();
    }
  }
  return texts;
}

TEST(OutputsOfAnArenaController, EventsScoresAndVerdict_Written) {
  const auto report_of = [](const std::string& more) {
    sim::Simulation simulation(sim::load_world_text(
        R"({"arena": {"size": [4, 4]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}])" +
        more + "}"));
    simulation.step();
    return nlohmann::json::parse(
        text_of_report(make_report(simulation, Recorder({}, simulation), {}, {})));
  };
  const nlohmann::json report = report_of(R"(, "controller": {"traps": [
      {"name": "p", "region": {"circle": {"center": [1, 1]}},
       "do": [{"score": {"points": 2}}, {"end": {"verdict": "failed", "reason": "why"}}]}]})");
  EXPECT_EQ(report.at("events"), nlohmann::json::parse(R"([
    {"number": 1, "time": 0.0, "kind": "trap", "what": "p", "who": "r1", "text": "enter"},
    {"number": 2, "time": 0.0, "kind": "score", "what": "p", "who": "r1", "value": 2.0},
    {"number": 3, "time": 0.0, "kind": "end", "what": "p", "text": "why", "value": 0.0}])"));
  EXPECT_EQ(report.at("scores"), nlohmann::json::parse(R"({"r1": 2.0})"));
  EXPECT_EQ(report.at("verdict"),
            nlohmann::json::parse(R"({"passed": false, "reason": "why", "time": 0.0})"));
  EXPECT_EQ(report.at("blocks"), nlohmann::json::object());
  for (const char* key : {"events", "blocks", "scores", "verdict"}) {
    EXPECT_FALSE(report_of("").contains(key)) << key;
  }
}

TEST(OutputsOfAnArenaController, DynamicBlocks_StateWritten) {
  sim::Simulation simulation(sim::load_world_text(R"({"arena": {"size": [4, 4], "obstacles": [
      {"name": "wall", "center": [3, 1]}, {"name": "a", "center": [3, 2], "type": "dynamic"},
      {"name": "b", "center": [3, 3], "type": "dynamic", "rise_speed": 0.1},
      {"name": "c", "center": [1, 1], "type": "dynamic", "state": "retracted",
       "when_blocked": "wait"}]},
    "robots": [{"pose": {"x": 1, "y": 1}}],
    "controller": {"timers": [{"at": 0, "do": [{"extend": ["c"]}, {"retract": ["b"]}]}]}})"));
  simulation.step();
  const auto report = nlohmann::json::parse(
      text_of_report(make_report(simulation, Recorder({}, simulation), {}, {})));
  EXPECT_EQ(report.at("blocks"),
            nlohmann::json::parse(R"({"a": "extended", "b": "sinking", "c": "waiting"})"));
}

TEST(OutputsInALocale, DecimalComma_SameBytes) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "C");
  const std::map<std::string, std::string> expected = all_texts_of_a_run();
  std::map<std::string, std::string> found;
  {
    const test_support::CommaLocale locale;
    if (locale.is_whole()) {
      ASSERT_EQ(std::to_string(0.5), "0,500000") << "the locale has no comma";
    }
    found = all_texts_of_a_run();
  }
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_THAT(expected.at("trajectory.csv"), testing::HasSubstr("\n0.000,r1,0.525000,0.750000,"));
  EXPECT_TRUE(expected.contains("snapshots/scene_000000.100s.png"));
  EXPECT_TRUE(expected.contains("layers/occupancy.yaml"));
  EXPECT_TRUE(expected.contains("report.json"));
  EXPECT_EQ(expected.at("setting robot_radius"), "1.25e-1");
  EXPECT_EQ(expected.at("map"), "0.05 -0.125");
  for (const auto& [name, text] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name) == text) << name << ":\n"
                                        << (name.ends_with(".png") ? "" : found.at(name));
  }
  EXPECT_EQ(found.size(), expected.size());
}

}  // namespace
}  // namespace playerlike
