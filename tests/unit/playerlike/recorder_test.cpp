// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/core/time.h"
#include "sim/render/render.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

sim::WorldDescription small_world(double step_s = 0.01) {
  sim::WorldDescription world = sim::load_world_text(R"({
    "name": "small", "arena": {"size": [1, 1]}, "canvas": {"size": [20, 20]},
    "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5, "yaw_deg": 0}}]})");
  world.simulation.step_ns = sim::from_seconds(step_s);
  return world;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::is_directory(folder)) return names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

struct Case {
  double duration_s;
  double fps;
  double speed;
  double step_s;
  std::size_t frames;
};

TEST(Recorder, Film_MayBeginLater) {
  // floor((0.4 - 0.25) * 25) + 1 frames: at 0.25, 0.29, 0.33 and 0.37 s.
  const TemporaryFolder folder;
  RunSettings settings;
  settings.film = folder / "film";
  settings.film_from_s = 0.25;
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  for (int step = 0; step < 40; ++step) {
    simulation.step();
    recorder.observe(simulation);
  }
  recorder.close_film();
  EXPECT_EQ(files_in(folder / "film").size(), 4U);
}

TEST(Recorder, RunFromTheMiddle_FilmBeginsThere) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder / "out";
  settings.film = folder / "film";
  settings.snapshot_period_s = 0.1;
  sim::Simulation simulation(small_world());
  for (int step = 0; step < 500; ++step) simulation.step();
  fs::create_directories(settings.output_folder);
  Recorder recorder(settings, simulation);
  for (int step = 0; step < 20; ++step) {
    simulation.step();
    recorder.observe(simulation);
  }
  recorder.close_film();
  // At 5, 5.04, ... 5.2 s.
  EXPECT_EQ(files_in(folder / "film").size(), 6U);
  EXPECT_EQ(files_in(folder / "out/snapshots").size(), 3U);
}

TEST(Recorder, FilmAfterEnd_Reported) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.film = folder / "film.mp4";
  settings.film_from_s = 2.0;
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  simulation.step();
  recorder.observe(simulation);
  EXPECT_THAT([&] { recorder.close_film(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("start at 2 s (--record-from)")));
  EXPECT_FALSE(fs::exists(settings.film));
}

TEST(Recorder, Film_FramePerPeriodAndStart) {
  // floor(duration * fps / speed) + 1 each.
  for (const Case& c : std::vector<Case>{
           {0.4, 25.0, 1.0, 0.01, 11},   // 10 + 1
           {0.39, 25.0, 1.0, 0.01, 10},  // 9.75
           {0.5, 30.0, 1.0, 0.01, 16},   // 15 + 1; periods of 33.3 ms lie between steps
           {2.0, 25.0, 10.0, 0.01, 6},   // 5 + 1
           {0.1, 25.0, 0.3, 0.01, 9},    // 8.33
           {0.12, 25.0, 0.3, 0.01, 11},  // 10 + 1: 0.12 * 25 / 0.3 is 10, though not in doubles
           {0.2, 100.0, 1.0, 0.05, 21},  // 20 + 1: five frames a step
           {0.0, 25.0, 1.0, 0.01, 1},    // the start
       }) {
    const TemporaryFolder folder;
    RunSettings settings;
    settings.film = folder / "film";
    settings.film_fps = c.fps;
    settings.film_speed = c.speed;
    sim::Simulation simulation(small_world(c.step_s));
    Recorder recorder(settings, simulation);
    while (sim::to_seconds(simulation.now_ns()) < c.duration_s - 1e-9) {
      simulation.step();
      recorder.observe(simulation);
    }
    recorder.close_film();
    EXPECT_EQ(files_in(folder / "film").size(), c.frames)
        << c.duration_s << " s, " << c.fps << " fps, speed " << c.speed;
  }
}

TEST(Recorder, Frame_ShowsSceneOfItsTime) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.film = folder / "film";
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  std::string expected;
  for (int step = 1; step <= 12; ++step) {
    simulation.canvas().set_pixel(step, step, {255, 0, 0, 255});
    simulation.step();
    recorder.observe(simulation);
    if (step == 8) {  // 0.08 s = 2 / 25 s: frame 3, as the first one is that of the start
      const sim::render::Image image =
          sim::render::draw_view(recorder.scene(simulation), {.size_px = 800});
      sim::render::write_png(image, folder / "expected.png");
      expected = read_bytes(folder / "expected.png");
    }
  }
  recorder.close_film();
  EXPECT_TRUE(read_bytes(folder / "film/frame_000003.png") == expected);
  EXPECT_FALSE(read_bytes(folder / "film/frame_000002.png") == expected);
}

TEST(Recorder, Snapshots_NamedByTimeAndReplaceEarlierRuns) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path();
  settings.snapshot_period_s = 0.1;
  folder.write("snapshots/scene_000009.000s.png", "old");
  folder.write("snapshots/mine.png", "kept");
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  for (int step = 0; step < 25; ++step) {
    simulation.step();
    recorder.observe(simulation);
  }
  recorder.close_film();
  EXPECT_THAT(files_in(folder / "snapshots"),
              ElementsAre("mine.png", "scene_000000.000s.png", "scene_000000.100s.png",
                          "scene_000000.200s.png"));
}

TEST(Recorder, Snapshots_ShowViewModeOfTheirTime) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path();
  settings.snapshot_period_s = 0.01;
  sim::Simulation simulation(small_world());
  simulation.canvas().set_pixel(3, 3, {255, 0, 0, 255});
  Recorder recorder(settings, simulation);
  ASSERT_FALSE(simulation.set_view_mode(sim::ViewMode::kFullScreen));
  simulation.step();
  recorder.observe(simulation);
  const sim::render::Image image =
      sim::render::draw_view(recorder.scene(simulation), {.size_px = 1200});
  recorder.close_film();
  sim::render::write_png(image, folder / "expected.png");
  EXPECT_TRUE(read_bytes(folder / "snapshots/scene_000000.010s.png") ==
              read_bytes(folder / "expected.png"));
}

TEST(Recorder, NoPeriod_NoSnapshots) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path();
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  recorder.close_film();
  EXPECT_THAT(files_in(folder.path()), ElementsAre("trajectory.csv"));
}

TEST(Recorder, Failure_ReportedAtEndWithoutStoppingRun) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.film = folder / "film";
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  fs::remove_all(folder / "film");
  // The thread may have written frames before the folder was removed; it can't write any
  // afterwards.
  for (int step = 0; step < 200; ++step) {
    simulation.step();
    recorder.observe(simulation);
  }
  EXPECT_THAT([&] { recorder.close_film(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("film/frame_0")));
  recorder.close_film();  // no error is left to report
}

TEST(Recorder, FilmLimit_EndsFilmWithMessage) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.film = folder / "film";
  settings.film_limit = 1;
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  for (int step = 0; step < 50; ++step) {
    simulation.step();
    recorder.observe(simulation);
  }
  EXPECT_THAT([&] { recorder.close_film(); },
              ThrowsMessage<std::runtime_error>(HasSubstr("has reached 1 bytes")));
  EXPECT_EQ(files_in(folder / "film").size(), 1U);
}

TEST(Recorder, FilmThatCannotStart_Error) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.film = folder / "none/film.mp4";
  const sim::Simulation simulation(small_world());
  EXPECT_THAT([&] { Recorder(settings, simulation); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none/film.mp4")));
}

TEST(GoalBook, Goals_KeptWithTimesSetAndReached) {
  sim::WorldDescription world = small_world();
  sim::Simulation simulation(world);
  GoalBook book;
  book.note(0, {0.5, 0.9}, 0.05, 0);
  book.note(0, {0.5, 0.9}, 0.05, 10);  // equal to the goal before
  book.note(0, {0.51, 0.5}, 0.05, 20);
  book.note(0, {std::nan(""), 0.0}, 0.05, 30);  // invalid position
  simulation.step();
  book.observe(simulation);
  ASSERT_EQ(book.goals().size(), 2U);
  EXPECT_FALSE(book.goals()[0].reached_ns);  // replaced before the robot reached it
  EXPECT_EQ(book.goals()[1].set_ns, 20);
  EXPECT_EQ(book.goals()[1].reached_ns, simulation.now_ns());
  const std::vector<sim::GoalMark> marks = book.marks();
  EXPECT_FALSE(marks[0].newest);
  EXPECT_FALSE(marks[0].reached);
  EXPECT_TRUE(marks[1].newest);
  EXPECT_TRUE(marks[1].reached);
  for (int i = 0; i < 2000; ++i) book.note(0, {i, 0.0}, 0.1, i);
  EXPECT_EQ(book.goals().size(), GoalBook::kMostGoals);
  EXPECT_EQ(book.goals().back().place.x(), 1999.0);
  EXPECT_TRUE(book.marks().back().newest);
}

TEST(GoalBook, Goals_OfWaypointsAndMotors) {
  sim::Simulation simulation(sim::load_world_text(R"({
    "arena": {"size": [4, 4]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2, "yaw_deg": 0}, "devices": {"waypoint": {}}},
               {"name": "r2", "pose": {"x": 1, "y": 3, "yaw_deg": 0}}]})"));
  GoalBook book;
  ASSERT_FALSE(simulation.apply({0, simulation.find_device(0, "waypoint").value()},
                                sim::GotoCommand{{2.0, 2.0}, 0.1, 0.5}));
  // The goal is in the frame of odometry, whose origin is the start of the robot.
  const int odometry = simulation.find_device(1, "odometry").value();
  ASSERT_FALSE(simulation.apply({1, simulation.find_device(1, "motion").value()},
                                sim::PositionCommand{{0.5, 0.0, 0.0}, 0.0, 0.0, odometry}));
  for (int step = 0; step < 600; ++step) {
    simulation.step();
    book.observe(simulation);
  }
  ASSERT_EQ(book.goals().size(), 2U);
  EXPECT_NEAR(book.goals()[0].place.x(), 2.0, 1e-9);
  EXPECT_EQ(book.goals()[0].robot, 0);
  EXPECT_TRUE(book.goals()[0].reached_ns);
  EXPECT_NEAR(book.goals()[1].place.x(), 1.5, 0.02);
  EXPECT_NEAR(book.goals()[1].place.y(), 3.0, 0.02);
  EXPECT_TRUE(book.goals()[1].reached_ns);
  EXPECT_LT(*book.goals()[1].reached_ns, simulation.now_ns());
}

TEST(Recorder, Scene_ShowsCollisions) {
  const TemporaryFolder folder;
  RunSettings settings;
  settings.output_folder = folder.path();
  sim::Simulation simulation(small_world());
  Recorder recorder(settings, simulation);
  ASSERT_FALSE(simulation.apply({0, simulation.find_device(0, "motion").value()},
                                sim::TwistCommand{{.v_mps = 0.5}}));
  for (int step = 0; step < 200; ++step) {
    simulation.step();
    recorder.observe(simulation);
  }
  const sim::SceneSnapshot scene = recorder.scene(simulation);
  ASSERT_EQ(scene.collisions.size(), 1U);
  // The border is at x = 1, and the front of the robot is 0.09 m wide.
  EXPECT_NEAR(scene.collisions[0].place.x(), 1.0, 0.02);
  EXPECT_NEAR(scene.collisions[0].place.y(), 0.5, 0.05);
  // The robot drives 0.413 m to the border at 0.5 m/s.
  EXPECT_NEAR(scene.collisions[0].time_s, 0.83, 0.05);
}

}  // namespace
}  // namespace playerlike
