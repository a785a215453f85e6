// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Client programs under `playpen run`, including those of the course.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

constexpr const char* kIntroWorld = PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json";

std::vector<std::string> keys(const json& object) {
  std::vector<std::string> result;
  for (const auto& item : object.items()) result.push_back(item.key());
  return result;
}

/// Each run has its own folder, and uses the room unless it names another world.
class PlaypenRun : public testing::Test {
 protected:
  /// `playpen run WORLD OPTIONS --out out -- PROGRAM`.
  [[nodiscard]] std::vector<std::string> arguments(const std::vector<std::string>& options,
                                                   const std::vector<std::string>& program) const {
    std::vector<std::string> call = {"run", world_};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--out", out_, "--"});
    call.insert(call.end(), program.begin(), program.end());
    return call;
  }
  [[nodiscard]] ProcessResult run(const std::vector<std::string>& options,
                                  const std::vector<std::string>& program,
                                  const ProcessOptions& process = {}) const {
    return playpen(arguments(options, program), process);
  }
  [[nodiscard]] json report() const { return read_report(out_); }
  [[nodiscard]] std::string output(const std::string& name) const {
    return read_bytes(fs::path(out_) / name);
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
  std::string out_ = folder_ / "out";
};

// The command reads the world to check it, and the program reads it once more.
TEST_F(PlaypenRun, World_ReadFromPipe) {
  const std::string line = std::string(PLAYPEN_COMMAND) + " run <(cat " + kIntroWorld +
                           ") --duration 1 --out " + out_ + " -- " + WALL_PROGRAM;
  const ProcessResult result = test_support::run_process({"bash", "-c", line});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(report().at("run").at("steps"), 100);
}

TEST_F(PlaypenRun, WritesReportPicturesAndTrajectory) {
  world_ = kIntroWorld;
  const ProcessResult result = run({"--duration", "20"}, {WALL_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;

  const json whole = report();
  EXPECT_THAT(keys(whole.at("run")), IsSupersetOf({"world", "seed", "steps", "sim_time",
                                                   "wall_time", "real_time_factor", "state_hash"}));
  ASSERT_EQ(whole.at("robots").size(), 1U);
  const json& robot = whole.at("robots").at(0);
  EXPECT_THAT(keys(robot), IsSupersetOf({"name", "path_length", "collisions", "least_clearance",
                                         "stalled_time", "final_pose"}));
  EXPECT_DOUBLE_EQ(whole.at("run").at("sim_time").get<double>(), 20.0);
  EXPECT_EQ(whole.at("run").at("steps").get<int>(), 2000);  // 20 s of 10 ms
  EXPECT_EQ(robot.at("name").get<std::string>(), "r1");
  EXPECT_EQ(robot.at("collisions").get<int>(), 0);

  EXPECT_THAT(output("scene.png"), HasSubstr("PNG"));
  EXPECT_THAT(output("canvas.png"), HasSubstr("PNG"));
  // A line of headings and at least one line per second.
  const std::string trajectory = output("trajectory.csv");
  EXPECT_GT(std::count(trajectory.begin(), trajectory.end(), '\n'), 20);

  EXPECT_THAT(result.out, AllOf(HasSubstr("20.0 s simulated"), HasSubstr("r1"),
                                HasSubstr("scene.png"), HasSubstr("canvas.png")));
}

TEST_F(PlaypenRun, FilesRepeatable_ExceptWallTime) {
  world_ = kIntroWorld;
  ASSERT_EQ(run({"--duration", "20"}, {WALL_PROGRAM}).status, 0);
  json first = report();
  const std::vector<std::string> names = {"scene.png", "canvas.png", "trajectory.csv"};
  std::vector<std::string> files;
  for (const std::string& name : names) files.push_back(output(name));

  ASSERT_EQ(run({"--duration", "20"}, {WALL_PROGRAM}).status, 0);
  json second = report();
  for (json* whole : {&first, &second}) {
    EXPECT_EQ((*whole)["run"].erase("wall_time"), 1U);
    EXPECT_EQ((*whole)["run"].erase("real_time_factor"), 1U);
  }
  EXPECT_EQ(first, second);
  for (std::size_t i = 0; i < names.size(); ++i) {
    // Not EXPECT_EQ, because pictures do not print well.
    EXPECT_TRUE(files[i] == output(names[i])) << names[i] << " differs between two equal runs";
  }
}

TEST_F(PlaypenRun, Port_SetsThatOfFirstRobot) {
  const std::vector<std::string> program = {WALL_PROGRAM, "--port", "7000"};
  const ProcessResult result = run({"--duration", "1", "--port", "7000"}, program);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(report().at("run").at("sim_time"), 1.0);
  EXPECT_EQ(report().at("run").at("repeatable"), true);
  EXPECT_EQ(report().at("run").at("repeatable_on"), "any machine");
  EXPECT_FALSE(report().at("run").contains("box2d_from"));
  const ProcessResult unset = run({"--duration", "1"}, program);
  EXPECT_NE(unset.status, 0);
  EXPECT_THAT(unset.err, AllOf(HasSubstr("port 7000"), HasSubstr("--port 7000")));
  for (const std::string port : {"0", "4000", "65536", "http"}) {
    const ProcessResult bad = run({"--port", port}, program);
    EXPECT_EQ(bad.status, 2) << port;
    EXPECT_THAT(bad.err, AllOf(HasSubstr("--port"), HasSubstr("1 to 65535 except for 4000"),
                               HasSubstr('\'' + port + '\'')));
  }
}

TEST_F(PlaypenRun, Seed_ChangesNoisyTrajectory) {
  world_ = folder_.write("noisy.json", room_world(0.01));
  ASSERT_EQ(run({"--duration", "10", "--seed", "1"}, {WALL_PROGRAM}).status, 0);
  const std::string first = output("trajectory.csv");
  EXPECT_EQ(report().at("run").at("seed").get<int>(), 1);
  ASSERT_EQ(run({"--duration", "10", "--seed", "2"}, {WALL_PROGRAM}).status, 0);
  EXPECT_EQ(report().at("run").at("seed").get<int>(), 2);
  EXPECT_TRUE(first != output("trajectory.csv"));
}

TEST_F(PlaypenRun, Template_StandsStillAndExits) {
  const ProcessResult result = run({"--duration", "5"}, {TEMPLATE_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_DOUBLE_EQ(report().at("robots").at(0).at("path_length").get<double>(), 0.0);
  EXPECT_THAT(result.err, Not(HasSubstr("ERROR")));
}

TEST_F(PlaypenRun, Solutions_DriveFarWithoutCollision) {
  world_ = kIntroWorld;
  for (const char* program : {WALL_PROGRAM, AVOID_PROGRAM}) {
    const ProcessResult result = run({"--duration", "120"}, {program});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("ERROR")));
    const json robot = report().at("robots").at(0);
    EXPECT_EQ(robot.at("collisions").get<int>(), 0) << program;
    EXPECT_GT(robot.at("path_length").get<double>(), 12.0) << program;
    EXPECT_DOUBLE_EQ(robot.at("stalled_time").get<double>(), 0.0) << program;
  }
}

TEST_F(PlaypenRun, ExpectationsUnmet_FailAndSayWhere) {
  const ProcessResult result = run({"--duration", "1", "--quiet", "--expect", "collisions == 0",
                                    "--expect", "r1.path_length > 1", "--expect", "sim_time <= 1"},
                                   {TEMPLATE_PROGRAM});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("expected r1.path_length > 1, but r1 has 0\n"));
  EXPECT_THAT(result.err, HasSubstr("results: " + out_));
  EXPECT_THAT(result.err, Not(HasSubstr("expected collisions")));
  EXPECT_THAT(output("replay.html"), HasSubstr("<!DOCTYPE html>"));
  EXPECT_EQ(playpen({"expect", "collisions == 0", "--in", out_}).status, 0);
  EXPECT_EQ(playpen({"expect", "collisions > 0", "--in", out_}).status, 1);
}

TEST_F(PlaypenRun, WrongExpectation_RefusedBeforeProgramStarts) {
  const std::pair<const char*, const char*> cases[] = {
      {"collision == 0", "--expect: there is no figure 'collision'"},
      {"r7.collisions == 0", "the world has no robot 'r7'; its robots are r1"}};
  for (const auto& [expectation, words] : cases) {
    const ProcessResult result = run({"--expect", expectation}, {TEMPLATE_PROGRAM});
    EXPECT_EQ(result.status, 2) << expectation;
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_FALSE(fs::exists(out_));
  }
  const ProcessResult nowhere = playpen({"expect", "collisions == 0", "--in", folder_ / "nowhere"});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("found no folder"));
}

TEST_F(PlaypenRun, WallFollower_AcceptsLeftOrRightHandOnly) {
  world_ = kIntroWorld;
  const ProcessResult right = run({"--duration", "60"}, {WALL_PROGRAM, "--side", "right"});
  ASSERT_EQ(right.status, 0) << right.err;
  EXPECT_EQ(report().at("robots").at(0).at("collisions").get<int>(), 0);
  EXPECT_GT(report().at("robots").at(0).at("path_length").get<double>(), 6.0);
  EXPECT_EQ(run({"--duration", "1"}, {WALL_PROGRAM, "--side", "middle"}).status, 1);
}

TEST_F(PlaypenRun, InvalidWorld_RefusedBeforeProgramStarts) {
  world_ = folder_.write("bad.json", R"({"robotz": []})");
  const ProcessResult result = run({}, {"/bin/echo", "started"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("bad.json"), HasSubstr("robotz")));
  EXPECT_THAT(result.out, Not(HasSubstr("started")));
}

TEST_F(PlaypenRun, ProgramThatCannotStart_Explained) {
  const std::string text = folder_.write("text.txt", "no program");
  const std::string script = folder_.write("here", "#!/bin/sh\n");
  fs::permissions(script, fs::perms::owner_all);
  ProcessOptions inside;
  inside.folder = folder_.path();
  struct Case {
    std::string program;
    std::string reason;
  };
  for (const Case& c : std::vector<Case>{{folder_ / "none", "there is no program"},
                                         {folder_.path(), "is a folder"},
                                         {text, "no executable file"},
                                         {"no_program_has_this_name", "on the PATH"},
                                         {"here", "write ./here"}}) {
    const ProcessResult result = run({}, {c.program}, inside);
    EXPECT_EQ(result.status, 2) << c.program;
    EXPECT_THAT(result.err, AllOf(HasSubstr(c.program), HasSubstr(c.reason)));
  }
  EXPECT_FALSE(fs::exists(out_)) << "nothing ran, so nothing should be left";
}

TEST_F(PlaypenRun, FailedProgram_ReportedWithStatus) {
  const ProcessResult result = run({}, {"sh", "-c", "exit 3"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("ended with status 3"));
}

TEST_F(PlaypenRun, SignalledProgram_ReportedWithSignalName) {
  const ProcessResult result = run({}, {"sh", "-c", "kill -KILL $$"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("was ended by signal 9 (Killed)"));
}

TEST_F(PlaypenRun, ProgramWithoutClient_FailsDespiteOldResults) {
  folder_.write("out/report.json", "{}");
  folder_.write("out/scene.png", "old");
  folder_.write("out/mine.txt", "kept");
  const ProcessResult result = run({}, {"true"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("true never connected to a simulation"));
  EXPECT_FALSE(fs::exists(fs::path(out_) / "report.json"));
  EXPECT_FALSE(fs::exists(fs::path(out_) / "scene.png"));
  EXPECT_EQ(output("mine.txt"), "kept");
}

TEST_F(PlaypenRun, UnwritablePictures_Fail) {
  // A folder at the place of a picture. The program's shell creates it, because earlier results are
  // removed before the run.
  const ProcessResult result =
      run({"--duration", "1"}, {"sh", "-c", "mkdir \"$1\" && exec \"$0\"", TEMPLATE_PROGRAM,
                                (fs::path(out_) / "scene.png").string()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("results of the run are missing"));
  EXPECT_THAT(result.err, HasSubstr("not all pictures could be written"));
  EXPECT_THAT(result.err, Not(HasSubstr("never connected")));
  EXPECT_TRUE(fs::is_regular_file(fs::path(out_) / "report.json")) << "it waits for no picture";
}

TEST_F(PlaypenRun, Signals_PassedToProgram) {
  std::vector<std::string> command = arguments({}, {"sh", "-c", "echo ready; exec cat"});
  command.insert(command.begin(), PLAYPEN_COMMAND);
  for (const int signal : {SIGTERM, SIGINT}) {
    Process process(command);
    ASSERT_TRUE(process.read_until("ready\n"));
    process.send_signal(signal);
    const ProcessResult result = process.finish();
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("was ended by signal " + std::to_string(signal)));
  }
}

TEST_F(PlaypenRun, Environment_DescribesRunToProgram) {
  ProcessOptions options;
  options.folder = folder_.path();
  // The shell's variables are of other runs.
  options.environment = {
      {"PLAYPEN_TIME", "7"}, {"PLAYPEN_SEED", "99"}, {"PLAYPEN_RECORD", "x.mp4"}};
  const ProcessResult result = playpen({"run", "room.json", "--duration", "1e1", "--seed",
                                        "18446744073709551615", "--out", "results", "--", "env"},
                                       options);
  const std::string folder = fs::canonical(folder_.path());
  EXPECT_THAT("\n" + result.out,
              AllOf(HasSubstr("\nPLAYPEN_WORLD=" + folder + "/room.json\n"),
                    HasSubstr("\nPLAYPEN_OUT=" + folder + "/results\n"),
                    HasSubstr("\nPLAYPEN_DURATION=10\n"),
                    HasSubstr("\nPLAYPEN_SEED=18446744073709551615\n"),
                    HasSubstr("\nPLAYPEN_PROGRESS=1\n"), HasSubstr("\nPLAYPEN_RUN=1\n"),
                    Not(HasSubstr("PLAYPEN_TIME")), Not(HasSubstr("PLAYPEN_RECORD"))));
}

TEST_F(PlaypenRun, Arguments_PassedUnchanged) {
  const ProcessResult result =
      run({}, {"printf", "[%s]", "--seed", "-1", "--", "run", "a b", "[c,d]"});
  EXPECT_THAT(result.out, HasSubstr("[--seed][-1][--][run][a b][[c,d]]"));
}

TEST_F(PlaypenRun, Quiet_PrintsNothing) {
  const ProcessResult result = run({"--quiet", "--duration", "1"}, {TEMPLATE_PROGRAM});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, Not(HasSubstr("playpen")));
}

TEST_F(PlaypenRun, DefaultFolder_NamedAfterWorld) {
  ProcessOptions options;
  options.folder = folder_.path();
  const ProcessResult result =
      playpen({"run", "room.json", "--duration", "1", "--", TEMPLATE_PROGRAM}, options);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(folder_ / "out/room/report.json"));
}

TEST_F(PlaypenRun, DefaultWorld_NeedsNoFile) {
  world_ = "default";
  ASSERT_EQ(run({"--duration", "1"}, {TEMPLATE_PROGRAM}).status, 0);
  EXPECT_DOUBLE_EQ(report().at("run").at("sim_time").get<double>(), 1.0);
}

TEST_F(PlaypenRun, RecordsFilm) {
  const std::string film = folder_ / "film.mp4";
  const ProcessResult result = run({"--duration", "1", "--record", film}, {WALL_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  // An MP4 begins with a box of type "ftyp".
  EXPECT_EQ(read_bytes(film).substr(4, 4), "ftyp");
  EXPECT_THAT(result.out, HasSubstr("film.mp4"));
  EXPECT_EQ(run({"--record", folder_ / "none/film.mp4"}, {WALL_PROGRAM}).status, 2);
}

TEST_F(PlaypenRun, Film_HasRequestedFramesSizeAndRate) {
  for (const char* name : {"film.mp4", "film.avi"}) {
    const std::string film = folder_ / name;
    const ProcessResult result =
        run({"--duration", "2", "--record", film, "--record-fps", "20", "--record-speed", "0.5"},
            {WALL_PROGRAM});
    ASSERT_EQ(result.status, 0) << result.err;
    const ProcessResult probe = test_support::run_process(
        {"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
         "stream=width,height,r_frame_rate,nb_read_frames", "-of", "csv=p=0", film});
    ASSERT_EQ(probe.status, 0) << probe.err;
    // 2 s * 20 / 0.5 + 1 frames. The arena is a square. With margins of 30 px on the left, on the
    // right and above, and 59 below, a picture of 800 px height has a square of 711 px. It is 771
    // px wide, and 770 in films.
    EXPECT_EQ(probe.out, "770,800,20/1,81\n") << name;
  }
}

TEST_F(PlaypenRun, FilmFolderAndSnapshots_Written) {
  folder_.write("out/snapshots/scene_000077.000s.png", "old");
  folder_.write("out/layers/old.png", "old");
  const ProcessResult result =
      run({"--duration", "2", "--record", folder_ / "frames", "--record-speed", "10",
           "--snapshot-every", "0.5", "--view-mode", "mini-map"},
          {WALL_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto count = [](const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  };
  EXPECT_EQ(count(folder_ / "frames"), 6);         // 2 * 25 / 10 + 1
  EXPECT_EQ(count(folder_ / "out/snapshots"), 5);  // at 0, 0.5, 1, 1.5 and 2 s
  EXPECT_TRUE(fs::exists(folder_ / "out/layers/canvas.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out/layers/old.png"));
  // scene.png is drawn in the same mode and at the same moment.
  EXPECT_TRUE(output("scene.png") == output("snapshots/scene_000002.000s.png"));
}

TEST_F(PlaypenRun, Realism_FromOptionOrWorld) {
  json hashes;
  for (const char* level : {"ideal", "course", "real"}) {
    const ProcessResult result = run({"--duration", "3", "--realism", level}, {WALL_PROGRAM});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(report().at("run").at("realism"), level);
    hashes[level] = report().at("run").at("state_hash");
  }
  EXPECT_NE(hashes["real"], hashes["course"]);
  json world = json::parse(room_world());
  world["simulation"]["realism"] = "real";
  world_ = folder_.write("worn.json", world.dump());
  const ProcessResult result = run({"--duration", "3"}, {WALL_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("realism real"));
  EXPECT_EQ(report().at("run").at("state_hash"), hashes["real"]);
  ASSERT_EQ(run({"--duration", "3", "--realism", "course"}, {WALL_PROGRAM}).status, 0);
  EXPECT_EQ(report().at("run").at("state_hash"), hashes["course"]);
}

TEST_F(PlaypenRun, ForbiddenViewMode_RefusedBeforeProgramStarts) {
  json world = json::parse(room_world());
  world["canvas"]["view_mode"] = "full-screen";
  world["canvas"]["lock_view_mode"] = true;
  world_ = folder_.write("locked.json", world.dump());
  const ProcessResult result = run({"--view-mode", "ground"}, {"touch", folder_ / "started"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("run/view_mode_locked"), HasSubstr("full-screen")));
  EXPECT_FALSE(fs::exists(folder_ / "started"));
}

}  // namespace
