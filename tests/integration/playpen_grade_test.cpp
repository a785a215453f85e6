// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen grade` as a user runs it, with programs that behave and programs that misbehave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kIntroTask = PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.task.json";

/// Gradings in a separate folder, by default of a task on a room with two seeds.
class PlaypenGrade : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> arguments(const std::vector<std::string>& options,
                                                   const std::vector<std::string>& program) const {
    std::vector<std::string> call = {"grade", task_};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--out", out_, "--"});
    call.insert(call.end(), program.begin(), program.end());
    return call;
  }
  [[nodiscard]] ProcessResult grade(const std::vector<std::string>& options,
                                    const std::vector<std::string>& program) const {
    std::vector<std::string> patient = options;
    if (std::find(options.begin(), options.end(), "--timeout") == options.end()) {
      // The task's own time limit is for an idle machine.
      patient.insert(patient.end(), {"--timeout", "3000"});
    }
    return playpen(arguments(patient, program));
  }
  [[nodiscard]] json result() const {
    return json::parse(read_bytes(fs::path(out_) / "grade.json"));
  }
  [[nodiscard]] std::string log(const std::string& run) const {
    return read_bytes(fs::path(out_) / run / "program.log");
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
  std::string task_ = folder_.write(
      "try.task.json",
      R"({"worlds": ["room.json"], "seeds": 2, "duration": 5, "thresholds": {"max_collisions": 0}})");
  std::string out_ = folder_ / "out";
};

TEST_F(PlaypenGrade, SolutionsOfIntroduction_Pass) {
  task_ = kIntroTask;
  for (const char* program : {WALL_PROGRAM, AVOID_PROGRAM}) {
    const ProcessResult run = grade({"--seeds", "2"}, {program});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_THAT(run.out, AllOf(StartsWith("world "), HasSubstr("pass  time over"),
                               HasSubstr("par_intro: 2 of 2 runs passed"), Not(HasSubstr("FAIL"))));
    EXPECT_THAT(run.err, IsEmpty()) << "no progress line where nobody looks";
    const json whole = result();
    EXPECT_EQ(whole.at("passed"), true);
    ASSERT_EQ(whole.at("runs").size(), 2U);
    EXPECT_GT(whole.at("runs").at(0).at("path_length").get<double>(), 12.0);
    EXPECT_EQ(whole.at("runs").at(1).at("seed"), 2);
    for (const char* file : {"report.json", "scene.png", "canvas.png", "trajectory.csv"}) {
      EXPECT_TRUE(fs::exists(fs::path(out_) / "par_intro_seed2" / file)) << file;
    }
  }
}

TEST_F(PlaypenGrade, SolutionsOfIntroduction_PassWithRealism) {
  task_ = kIntroTask;
  for (const char* program : {WALL_PROGRAM, AVOID_PROGRAM}) {
    const ProcessResult run = grade({"--seeds", "2", "--realism", "real"}, {program});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const json report = read_report(fs::path(out_) / "par_intro_seed2");
    EXPECT_EQ(report.at("run").at("realism"), "real");
  }
}

TEST_F(PlaypenGrade, Template_FailsWithoutCrash) {
  task_ = kIntroTask;
  const ProcessResult run = grade({"--seeds", "1,"}, {TEMPLATE_PROGRAM});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(
      run.out,
      HasSubstr("par_intro seed 1: distance driven (movements on the spot excluded) 0.00 m, at "
                "least 12 m needed"));
  EXPECT_EQ(result().at("runs").at(0).at("end"), json({{"kind", "time-over"}}));
}

TEST_F(PlaypenGrade, FailingPrograms_AreResults) {
  const std::string script =
      "echo seed $PLAYPEN_SEED; echo error >&2\n"
      "case $PLAYPEN_SEED in\n"
      "1) kill -SEGV $$ ;;\n"
      "2) exit 3 ;;\n"
      "3) exit 0 ;;\n"
      "4) exec " TEMPLATE_PROGRAM
      " ;;\n"
      "5) echo '{\"run\": 1}' > \"$PLAYPEN_OUT/report.json\" ;;\n"
      "esac";
  const ProcessResult run = grade({"--seeds", "5"}, {"sh", "-c", script});
  EXPECT_EQ(run.status, 1) << run.err;
  const json runs = result().at("runs");
  ASSERT_EQ(runs.size(), 5U);
  EXPECT_EQ(runs.at(0).at("end"), json({{"kind", "signal"}, {"signal", SIGSEGV}}));
  EXPECT_EQ(runs.at(1).at("end"), json({{"kind", "bad-status"}, {"status", 3}}));
  EXPECT_EQ(runs.at(2).at("end"), json({{"kind", "by-itself"}}));
  EXPECT_THAT(runs.at(2).at("faults").at(0).get<std::string>(), HasSubstr("never connected"));
  EXPECT_EQ(runs.at(3).at("passed"), true) << "it stands still and hits nothing";
  EXPECT_THAT(runs.at(4).at("faults").at(0).get<std::string>(), HasSubstr("not signed"));
  EXPECT_THAT(run.out, AllOf(HasSubstr("room      1  FAIL  signal 11"),
                             HasSubstr("room      2  FAIL  status 3"),
                             HasSubstr("room      4  pass  time over"),
                             HasSubstr("try: 1 of 5 runs passed"), Not(HasSubstr("seed 2\n"))));
  EXPECT_EQ(log("room_seed2"), "seed 2\nerror\n");
}

TEST_F(PlaypenGrade, FailedRun_KeepsResults) {
  struct Case {
    const char* how;
    const char* fault;
    bool is_crash;
  };
  for (const Case& c :
       {Case{"null", "the program was ended by signal 11 (Segmentation fault)", true},
        Case{"abort", "the program was ended by signal 6 (Aborted)", true},
        Case{"kill", "the program was ended by signal 9 (Killed)", false},
        Case{"leave", "the program ended with status 3", false}}) {
    SCOPED_TRACE(c.how);
    const ProcessResult graded = grade({"--seeds", "7,"}, {ENDS_PROGRAM, c.how, "20"});
    EXPECT_EQ(graded.status, 1);
    const std::string run_folder = folder_ / "run";
    EXPECT_EQ(playpen({"run", world_, "--seed", "7", "--duration", "5", "--out", run_folder, "--",
                       ENDS_PROGRAM, c.how, "20"})
                  .status,
              1);
    // The same steps, distances and pictures.
    json report = read_report(fs::path(out_) / "room_seed7");
    json of_run = read_report(run_folder);
    for (json* one : {&report, &of_run}) {
      one->erase("graded");
      for (const char* key : {"wall_time", "real_time_factor"}) (*one)["run"].erase(key);
    }
    EXPECT_EQ(report, of_run);
    EXPECT_FALSE(report.at("ended").is_null());
    for (const char* file : {"scene.png", "canvas.png"}) {
      EXPECT_EQ(read_bytes(fs::path(out_) / "room_seed7" / file),
                read_bytes(fs::path(run_folder) / file))
          << file;
    }
    const json run = result().at("runs").at(0);
    EXPECT_EQ(run.at("path_length"), report.at("robots").at(0).at("path_length"));
    EXPECT_EQ(run.at("sim_time"), 2.1);
    EXPECT_EQ(run.at("faults"), json({std::string(c.fault) + " after 2.10 s of simulated time"}));
    // The table says where to look and what to do.
    EXPECT_THAT(
        graded.out,
        AllOf(HasSubstr("  picture: " + out_ + "/room_seed7/scene.png\n"),
              HasSubstr("  what the program printed: " + out_ + "/room_seed7/program.log\n"),
              HasSubstr("  why: " PLAYPEN_COMMAND " why " + out_ + "/room_seed7\n"),
              HasSubstr("  repeat: " PLAYPEN_COMMAND " run " + world_ +
                        " --seed 7 --duration 5 -- " ENDS_PROGRAM " " + c.how + " 20\n")));
    EXPECT_EQ(graded.out.find("-- gdb -ex run --args " ENDS_PROGRAM) != std::string::npos,
              c.is_crash);
  }
}

TEST_F(PlaypenGrade, CommonFaults_PrintedOnce) {
  // It drives in a circle of 0.8 m and meets the wall of the room at y = 2 m.
  json world = json::parse(room_world());
  world["robots"][0]["pose"]["y"] = 1.6;
  folder_.write("room.json", world.dump());
  const ProcessResult graded = grade({"--seeds", "3"}, {ENDS_PROGRAM, "drive"});
  EXPECT_EQ(graded.status, 1);
  const json first = result().at("runs").at(0).at("first_collision");
  ASSERT_FALSE(first.is_null()) << graded.out;
  EXPECT_EQ(first.at("with"), "border");
  EXPECT_THAT(graded.out, HasSubstr("\nroom seeds 1 to 3: collisions "));
  EXPECT_THAT(graded.out, HasSubstr("at most 0 allowed: first hit border at ("));
  EXPECT_EQ(first.at("sight").at("state"), "shown");
  EXPECT_THAT(graded.out, HasSubstr(" s; the laser had shown it for "));
  EXPECT_THAT(graded.out, Not(HasSubstr("seed 2")));
  EXPECT_THAT(graded.out, HasSubstr("picture: " + out_ + "/room_seed1/scene.png\n"));
}

TEST_F(PlaypenGrade, HangingProgram_IsEnded) {
  const ProcessResult run =
      grade({"--seeds", "1,", "--timeout", "0.2"}, {"sh", "-c", "sleep 1000"});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(result().at("runs").at(0).at("end"), json({{"kind", "timeout"}}));
  EXPECT_THAT(run.out, HasSubstr("timeout: still running after 0.2 s"));
  const ProcessResult stopped =
      grade({"--seeds", "1,", "--timeout", "0.2"}, {"sh", "-c", "kill -STOP $$; exit 0"});
  EXPECT_EQ(stopped.status, 1);
  EXPECT_EQ(result().at("runs").at(0).at("end"), json({{"kind", "timeout"}}));
}

/// Removes all wall times.
void drop_wall_times(json& value) {
  if (value.is_object()) value.erase("wall_time");
  for (json& part : value) {
    if (part.is_structured()) drop_wall_times(part);
  }
}

TEST_F(PlaypenGrade, ParallelRuns_SameAsSequential) {
  folder_.write("room.json", room_world(0.01));  // with noise, so that seeds matter
  std::vector<json> results;
  for (const char* jobs : {"1", "4"}) {
    ASSERT_EQ(grade({"--seeds", "4", "--jobs", jobs}, {WALL_PROGRAM}).status, 0);
    results.push_back(result());
    drop_wall_times(results.back());
  }
  EXPECT_EQ(results[0], results[1]);
  const json& runs = results[0].at("runs");
  EXPECT_NE(runs.at(0).at("path_length"), runs.at(1).at("path_length"));
  EXPECT_FALSE(runs.at(0).contains("wall_time"));
}

TEST_F(PlaypenGrade, WorldsSeedsAndArguments_FromTaskAndCommandLine) {
  folder_.write("other.json", room_world());
  folder_.write("try.task.json", R"({
    "worlds": [{"world": "room.json", "arguments": ["--in", "a room"]}, "other.json"],
    "seeds": [3], "arguments": ["--always"]})");
  const std::vector<std::string> program = {"sh", "-c", "echo \"$0 $@\"", "[x,y]"};
  EXPECT_EQ(grade({}, program).status, 1);
  EXPECT_EQ(log("room_seed3"), "[x,y] --always --in a room\n");
  EXPECT_EQ(log("other_seed3"), "[x,y] --always\n");
  EXPECT_EQ(result().at("program"), json(program));

  out_ = folder_ / "second";
  EXPECT_EQ(grade({world_, "default", "--seeds", "8,18446744073709551615"}, program).status, 1);
  EXPECT_EQ(result().at("runs").size(), 4U);
  EXPECT_EQ(log("room_seed8"), "[x,y] --always --in a room\n");
  EXPECT_EQ(log("default_seed18446744073709551615"), "[x,y] --always\n");
}

TEST_F(PlaypenGrade, PathRatio_ComparesWithShortestPath) {
  folder_.write("try.task.json", R"({
    "worlds": [{"world": "room.json", "goal": {"x": 1.5, "y": 1, "tolerance": 0.05}}],
    "seeds": 1, "duration": 1, "thresholds": {"must_reach": true}})");
  const ProcessResult missed = grade({}, {TEMPLATE_PROGRAM});
  EXPECT_EQ(missed.status, 1);
  EXPECT_THAT(missed.out, HasSubstr("goal not reached: 1.00 m away from it at the end"));
  const json run = result().at("runs").at(0);
  EXPECT_EQ(run.at("reached"), false);
  EXPECT_NEAR(run.at("shortest_path").get<double>(), 1.0, 1e-4);
}

TEST_F(PlaypenGrade, ForgedReport_Refused) {
  folder_.write("try.task.json", R"({
    "worlds": [{"world": "room.json", "goal": {"x": 1.5, "y": 1}}], "seeds": 1,
    "thresholds": {"must_reach": true, "must_end": true, "max_path_ratio": 1.5}})");
  const std::string script =
      "echo '{\"run\": {\"sim_time\": 7, \"steps\": 700}, \"robots\": [{\"name\": \"r1\","
      "\"path_length\": 1.2, \"collisions\": 0, \"least_clearance\": 0.1, \"stalled_time\": 0,"
      "\"final_pose\": {\"x\": 1.48, \"y\": 1, \"yaw\": 0}}]}' > \"$PLAYPEN_OUT/report.json\"";
  EXPECT_EQ(grade({}, {"sh", "-c", script}).status, 1);
  EXPECT_THAT(result().at("runs").at(0).at("faults"),
              ElementsAre(HasSubstr("not signed by the simulation of this run")));
  // A report of an earlier run does not count either.
  folder_.write("try.task.json", R"({"worlds": ["room.json"], "seeds": 1, "duration": 1})");
  ASSERT_EQ(grade({}, {TEMPLATE_PROGRAM}).status, 0);
  const std::string old = folder_.write("old.json", read_bytes(out_ + "/room_seed1/report.json"));
  EXPECT_EQ(grade({}, {"sh", "-c", "cp " + old + " \"$PLAYPEN_OUT/report.json\""}).status, 1);
  EXPECT_THAT(result().at("runs").at(0).at("faults"),
              ElementsAre("the report is that of another run"));
}

TEST_F(PlaypenGrade, ReportOfOtherWorldOrSettings_Refused) {
  folder_.write("try.task.json", R"({"worlds": ["room.json"], "seeds": 1, "duration": 1})");
  json other = json::parse(room_world());
  other["name"] = "easy";
  other["robots"][0]["pose"]["x"] = 1.0;
  const std::string easy = folder_.write("easy.json", other.dump());
  const std::string exec = " exec " TEMPLATE_PROGRAM;
  struct Case {
    std::string script;
    std::string fault;
    std::string log;
  };
  for (const Case& c : std::vector<Case>{
           {"exec " TEMPLATE_PROGRAM, "", ""},
           {"PLAYPEN_WORLD=" + easy + exec, "the program ran the world \"easy\"", ""},
           {"PLAYPEN_SEED=9" + exec, "the seed 9, not with 1", ""},
           {"PLAYPEN_DURATION=0.5" + exec, "a duration of 0.5 s, not of 1 s", ""},
           {"PLAYPEN_TIME=100" + exec, "the time 100, not with lockstep", ""},
           {"PLAYPEN_REALISM=ideal" + exec, "the realism ideal, not with course", ""},
           {"PLAYPEN_GRADE=" + exec, "not signed", ""},
           {PLAYPEN_COMMAND " run " + easy +
                " --duration 1 --out \"$PLAYPEN_OUT\" -- " TEMPLATE_PROGRAM,
            "not signed", ""},
           {"exec " TEMPLATE_PROGRAM " --host sim:" + easy, "", "it opens the world \"sim:" + easy},
           {"exec " TEMPLATE_PROGRAM " --host tcp://localhost:1", "",
            "it connects to the server \"tcp://localhost:1\""},
           {"exec " CHANGES_WORLD_PROGRAM " PLAYPEN_WORLD " + easy, "",
            "it has changed PLAYPEN_WORLD from \"" + world_ + "\" to \"" + easy + '"'},
           {"exec " CHANGES_WORLD_PROGRAM " PLAYPEN_SEED 77", "",
            "it has changed PLAYPEN_SEED from \"1\" to \"77\""}}) {
    const bool is_fine = c.fault.empty() && c.log.empty();
    EXPECT_EQ(grade({}, {"sh", "-c", c.script}).status, is_fine ? 0 : 1) << c.script;
    const json run = result().at("runs").at(0);
    EXPECT_EQ(run.at("passed"), is_fine) << c.script << run;
    if (!c.fault.empty()) {
      EXPECT_THAT(run.at("faults").at(0).get<std::string>(), HasSubstr(c.fault)) << c.script;
    }
    EXPECT_THAT(log("room_seed1"), HasSubstr(c.log)) << c.script;
  }
}

TEST_F(PlaypenGrade, MissingReport_NotHiddenByEarlierResults) {
  ASSERT_EQ(grade({}, {TEMPLATE_PROGRAM}).status, 0);
  ASSERT_EQ(grade({}, {"true"}).status, 1);
  EXPECT_FALSE(fs::exists(fs::path(out_) / "room_seed1/report.json"));
}

TEST_F(PlaypenGrade, JsonFile_WrittenToRequestedPath) {
  const std::string file = folder_ / "marks/robot.json";
  EXPECT_EQ(grade({"--json", file}, {TEMPLATE_PROGRAM}).status, 0);
  EXPECT_EQ(json::parse(read_bytes(file)).at("task"), "try");
  EXPECT_FALSE(fs::exists(fs::path(out_) / "grade.json"));
}

TEST_F(PlaypenGrade, JsonFile_CompleteAfterEachRun) {
  const std::string fifo = folder_ / "fifo";
  ASSERT_EQ(std::system(("mkfifo " + fifo).c_str()), 0);
  std::vector<std::string> command = arguments(
      {"--seeds", "2", "--jobs", "1"},
      {"sh", "-c", "test $PLAYPEN_SEED = 1 && exit 3; echo up > " + fifo + "; sleep 1000"});
  command.insert(command.begin(), PLAYPEN_COMMAND);
  Process process(command);
  std::ifstream from_program(fifo);
  std::string word;
  from_program >> word;
  EXPECT_EQ(word, "up");
  const json present = result();
  EXPECT_EQ(present.at("runs").at(0).at("end"), json({{"kind", "bad-status"}, {"status", 3}}));
  EXPECT_EQ(present.at("runs").at(1).at("faults"), json({"not run yet"}));
  process.send_signal(SIGKILL);
  EXPECT_FALSE(process.finish().timed_out) << "something goes on";
  EXPECT_EQ(result(), present);
}

TEST_F(PlaypenGrade, JudgedResults_NotReachableByProgram) {
  // The program writes to the place of its results, and into those of the first run.
  const ProcessResult run = grade({"--seeds", "2", "--jobs", "1"},
                                  {"sh", "-c",
                                   "for d in room_seed1 room_seed2; do echo '{}' > " + out_ +
                                       "/$d/report.json; done; "
                                       "exec \"$0\"",
                                   TEMPLATE_PROGRAM});
  EXPECT_EQ(run.status, 0) << run.out;
  for (const auto& entry : fs::directory_iterator(out_)) {
    EXPECT_THAT(entry.path().filename().string(), Not(testing::StartsWith(".running")));
  }
}

TEST_F(PlaypenGrade, Interrupt_EndsProgramsAndWritesResults) {
  const std::string fifo = folder_ / "fifo";
  ASSERT_EQ(std::system(("mkfifo " + fifo).c_str()), 0);
  std::vector<std::string> command =
      arguments({"--seeds", "3", "--jobs", "1"},
                {"sh", "-c", "exec 3> " + fifo + "; echo up >&3; sleep 1000"});
  command.insert(command.begin(), PLAYPEN_COMMAND);
  Process process(command);
  std::ifstream from_program(fifo);  // blocks until the program opens it
  std::string word;
  from_program >> word;
  EXPECT_EQ(word, "up");
  process.send_signal(SIGINT);
  const ProcessResult run = process.finish();
  EXPECT_FALSE(run.timed_out);
  EXPECT_EQ(run.status, 1);
  // The end of file arrives when neither the shell nor its child holds the other end.
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(from_program), {}), "\n");
  const json runs = result().at("runs");
  EXPECT_EQ(runs.at(0).at("end"), json({{"kind", "interrupted"}}));
  EXPECT_EQ(runs.at(1).at("end"), json({{"kind", "not-run"}}));
  EXPECT_THAT(run.out, HasSubstr("not run: the grader was interrupted"));
}

TEST_F(PlaypenGrade, InvalidInput_ExplainedBeforeRuns) {
  const std::string text = folder_.write("text.txt", "no program");
  const std::string bad_task = folder_.write("bad.task.json", R"({"worlds": ["none.json"]})");
  const std::string bad_world = folder_.write("bad.json", R"({"robotz": []})");
  const std::string far_goal = folder_.write(
      "far.task.json", R"({"worlds": [{"world": "room.json", "goal": {"x": 9, "y": 9}}]})");
  struct Case {
    std::vector<std::string> arguments;
    std::string reason;
  };
  for (const Case& c :
       std::vector<Case>{{{task_}, "PROGRAM"},
                         {{task_, "--"}, "PROGRAM"},
                         {{task_, "--", folder_ / "none"}, "there is no program"},
                         {{task_, "--", text}, "no executable file"},
                         {{folder_ / "no.task.json", "--", "true"}, "a task file"},
                         {{bad_task, "--", "true"}, "task/unknown-world"},
                         {{far_goal, "--", "true"}, "task/unreachable-goal"},
                         {{task_, bad_world, "--", "true"}, "robotz"},
                         {{task_, folder_ / "none.json", "--", "true"}, "file/missing"},
                         {{task_, world_, world_, "--", "true"}, "task/duplicate-world"},
                         {{task_, "--seeds", "0", "--", "true"}, "'0'"},
                         {{task_, "--seeds", "1,1", "--", "true"}, "'1,1'"},
                         {{task_, "--seeds", "1,x", "--", "true"}, "'1,x'"},
                         {{task_, "--seeds", ",", "--", "true"}, "','"},
                         {{task_, "--jobs", "0", "--", "true"}, "--jobs"},
                         {{task_, "--timeout", "-1", "--", "true"}, "--timeout"},
                         {{task_, "--fast", "--", "true"}, "--fast"}}) {
    std::vector<std::string> call = {"grade"};
    call.insert(call.end(), c.arguments.begin(), c.arguments.end());
    call.insert(call.begin() + 1, {"--out", out_});
    const ProcessResult run = playpen(call);
    EXPECT_EQ(run.status, 2) << testing::PrintToString(c.arguments);
    EXPECT_THAT(run.err, HasSubstr(c.reason)) << testing::PrintToString(c.arguments);
    EXPECT_FALSE(fs::exists(out_)) << testing::PrintToString(c.arguments);
  }
}

TEST_F(PlaypenGrade, InstalledTasks_Found) {
  const std::string command = folder_.write("bin/playpen", "");
  fs::copy_file(PLAYPEN_COMMAND, command, fs::copy_options::overwrite_existing);
  fs::permissions(command, fs::perms::owner_all);
  const fs::path libraries = fs::path(PLAYPEN_COMMAND).parent_path() / "../lib/playpen";
  fs::create_directories(folder_ / "lib");
  fs::copy(libraries, folder_ / "lib/playpen");
  folder_.write("share/playpen/worlds/tasks/room.json", room_world());
  folder_.write("share/playpen/worlds/tasks/mine.task.json",
                R"({"worlds": ["room.json"], "duration": 1})");
  for (const char* name : {"mine", "tasks/mine", "tasks/mine.task.json"}) {
    const ProcessResult run = test_support::run_process(
        {command, "grade", name, "--out", out_, "--seeds", "1,", "--", TEMPLATE_PROGRAM});
    EXPECT_NE(run.status, 2) << name << ": " << run.err;
    EXPECT_THAT(run.out, HasSubstr("mine: ")) << name;
  }
}

}  // namespace
