// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What a run leaves for each way of ending it, and that no process of it continues.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

class PlaypenEnds : public testing::Test {
 protected:
  /// `playpen run room.json OPTIONS --out out -- ends_program PROGRAM`.
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& options,
                                                 const std::vector<std::string>& program) const {
    return test_support::run_call(world_, options, out_, ENDS_PROGRAM, program);
  }
  [[nodiscard]] fs::path result(const std::string& name) const { return fs::path(out_) / name; }
  [[nodiscard]] json report() const { return read_report(out_); }
  [[nodiscard]] bool has(const std::string& name) const {
    return fs::is_regular_file(result(name)) && fs::file_size(result(name)) > 0;
  }
  void expect_all_results() const {
    for (const char* name : {"report.json", "trajectory.csv", "scene.png", "canvas.png"}) {
      EXPECT_TRUE(has(name)) << name;
    }
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
  std::string out_ = folder_ / "out";
};

TEST_F(PlaypenEnds, RepeatedSignal_EndsRunOnce) {
  for (const char* time : {"lockstep", "20"}) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      SCOPED_TRACE(std::string(time) + ", signal " + std::to_string(signal));
      Process process(command({"--quiet", "--time", time}, {"drive"}));
      ASSERT_TRUE(process.read_until("ready"));
      // As timeout does: sends the signal to the command, and to its group.
      process.send_signal(signal);
      process.send_signal_to_group(signal);
      const ProcessResult end = process.finish();
      ASSERT_FALSE(end.timed_out);
      EXPECT_EQ(end.status, 0) << end.err;
      expect_all_results();
      const json ended = report().at("ended");
      EXPECT_EQ(ended.at("by"), "request");
      EXPECT_EQ(ended.at("signal"), std::string("SIG") + sigabbrev_np(signal));
    }
  }
}

TEST_F(PlaypenEnds, ProgramHandler_GetsSignalOnce) {
  Process process(command({"--real-sleep"}, {"handler"}));
  ASSERT_TRUE(process.read_until("ready"));
  process.send_signal(SIGTERM);
  process.send_signal(SIGTERM);
  const ProcessResult end = process.finish();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("signals 1"));
  EXPECT_EQ(report().at("ended").at("by"), "program");
}

TEST_F(PlaypenEnds, IgnoredSignals_StayIgnored) {
  ProcessOptions options;
  options.ignored_signals = {SIGHUP};  // as under nohup
  Process process(command({"--time", "20"}, {"drive"}), options);
  ASSERT_TRUE(process.read_until("ready"));
  process.send_signal_to_group(SIGHUP);
  process.send_signal(SIGTERM);
  EXPECT_EQ(process.finish().status, 0);
  EXPECT_EQ(report().at("ended").at("signal"), "SIGTERM");
}

TEST_F(PlaypenEnds, Descendants_EndWithRun) {
  Process process(command({}, {"child"}));
  // Returns when the last process that holds the output has ended.
  const ProcessResult end = process.finish();
  EXPECT_FALSE(end.timed_out);
  EXPECT_EQ(end.status, 0) << end.err;
  expect_all_results();
  EXPECT_EQ(report().at("ended"), json({{"by", "program"}, {"status", 0}}));
}

TEST_F(PlaypenEnds, KilledCommand_EndsProgramAndDescendants) {
  for (const char* what : {"drive", "compute"}) {
    for (const bool group : {false, true}) {
      SCOPED_TRACE(std::string(what) + (group ? ", the group" : ""));
      fs::remove_all(out_);
      Process process(command({"--time", "20"}, {what}));
      ASSERT_TRUE(process.read_until("ready"));
      group ? process.send_signal_to_group(SIGKILL) : process.send_signal(SIGKILL);
      const ProcessResult end = process.finish();
      EXPECT_FALSE(end.timed_out) << "something goes on";
      EXPECT_EQ(end.signal, SIGKILL);
      expect_all_results();
      EXPECT_FALSE(report().at("ended").is_null());
    }
  }
}

TEST_F(PlaypenEnds, ProgramWithoutReads_IsEnded) {
  for (const char* whom : {"command", "group", "program"}) {
    SCOPED_TRACE(whom);
    fs::remove_all(out_);
    Process process(command({}, {"compute"}));
    ASSERT_TRUE(process.read_until("\n"));
    if (whom == std::string("command")) process.send_signal(SIGINT);
    if (whom == std::string("group")) process.send_signal_to_group(SIGINT);
    if (whom == std::string("program")) kill(std::stoi(process.output().substr(6)), SIGINT);
    const ProcessResult end = process.finish();
    EXPECT_FALSE(end.timed_out);
    EXPECT_EQ(end.status, 1);
    EXPECT_THAT(end.err, HasSubstr("had been asked to end"));
    expect_all_results();
    EXPECT_EQ(report().at("run").at("steps"), 510);
    EXPECT_EQ(report().at("ended"), json({{"by", "request"}, {"signal", "SIGINT"}}));
  }
}

TEST_F(PlaypenEnds, Crash_KeepsResultsOfLastStep) {
  // The results of a run that ends normally at the same moment.
  const std::string crashed = out_;
  out_ = folder_ / "whole";
  ASSERT_EQ(test_support::run_process(command({"--duration", "5.1"}, {"drive", "99"})).status, 0);
  const std::string whole = out_;
  const json whole_report = report();
  out_ = crashed;
  struct Case {
    const char* what;
    json ended;
    const char* told;
  };
  const std::vector<Case> cases = {
      {"segv", {{"by", "signal"}, {"signal", "SIGSEGV"}}, "gdb -ex run --args"},
      {"null", {{"by", "signal"}, {"signal", "SIGSEGV"}}, "-- gdb -ex run --args"},
      {"abort", {{"by", "signal"}, {"signal", "SIGABRT"}}, "was ended by signal 6"},
      {"throw", {{"by", "signal"}, {"signal", "SIGABRT"}}, "thrown by the program"},
      {"kill", {{"by", "signal"}, {"signal", "SIGKILL"}}, "was ended by signal 9"},
      {"leave", {{"by", "program"}, {"status", 3}}, "ended with status 3"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    fs::remove_all(out_);
    const ProcessResult end = test_support::run_process(command({}, {c.what}));
    EXPECT_EQ(end.status, 1);
    EXPECT_THAT(end.err, HasSubstr(c.told));
    EXPECT_EQ(report().at("ended"), c.ended);
    EXPECT_EQ(report().at("robots"), whole_report.at("robots"));
    EXPECT_EQ(report().at("run").at("steps"), 510);
    for (const char* name : {"trajectory.csv", "scene.png", "canvas.png", "layers/canvas.png",
                             "layers/graphics2d.png"}) {
      EXPECT_TRUE(read_bytes(result(name)) == read_bytes(fs::path(whole) / name)) << name;
    }
  }
}

TEST_F(PlaypenEnds, Verdict_EndsRunAndCrashKeepsEvents) {
  world_ = folder_.write("arena.json", R"({"arena": {"size": [4, 4]},
    "robots": [{"name": "r1", "pose": {"x": 2, "y": 2}}],
    "controller": {"timers": [{"name": "tick", "every": 0.1, "do": [{"score": {"robot": "r1"}}]},
      {"name": "end", "at": 3, "do": [{"end": {"verdict": "failed", "reason": "too late"}}]}]}})");
  const ProcessResult end = test_support::run_process(command({}, {"drive"}));
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(report().at("ended").at("by"), "verdict");
  EXPECT_EQ(report().at("run").at("steps"), 300);
  EXPECT_EQ(report().at("verdict"),
            json({{"passed", false}, {"reason", "too late"}, {"time", 3.0}}));
  EXPECT_EQ(report().at("scores"), json({{"r1", 30.0}}));
  EXPECT_EQ(report().at("events").size(), 62U);  // 30 times two, and the end
  // The program dies after 2 s, with the 20th event of the timer.
  const json before = report().at("events");
  fs::remove_all(out_);
  EXPECT_EQ(test_support::run_process(command({}, {"segv", "19"})).status, 1);
  EXPECT_EQ(report().at("ended").at("by"), "signal");
  const json events = report().at("events");
  EXPECT_EQ(report().at("run").at("steps"), 200);
  ASSERT_EQ(events.size(), 40U);
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i], before[i]);
  EXPECT_EQ(report().at("scores"), json({{"r1", 20.0}}));
  EXPECT_EQ(report().at("verdict"), nullptr);
}

TEST_F(PlaypenEnds, ProgramThatKillsItsParent_Ends) {
  Process process(command({}, {"killer"}));
  const ProcessResult end = process.finish();
  EXPECT_FALSE(end.timed_out) << "something goes on";
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.err, HasSubstr("was ended by signal 9"));
  expect_all_results();
}

TEST_F(PlaypenEnds, StoppedProgram_ReportedAndEnded) {
  for (const int signal : {SIGTERM, SIGKILL}) {
    SCOPED_TRACE(signal);
    fs::remove_all(out_);
    Process process(command({}, {"stop"}));
    ASSERT_TRUE(process.read_error_until("has stopped itself (SIGSTOP)"));
    process.send_signal(signal);
    const ProcessResult end = process.finish();
    EXPECT_FALSE(end.timed_out) << "something goes on";
    expect_all_results();
    EXPECT_GE(report().at("run").at("steps"), 510);
  }
}

TEST_F(PlaypenEnds, FileSizeLimit_KeepsReport) {
  ProcessOptions options;
  options.file_limit = 4096;  // enough for the report, but not for a picture
  const ProcessResult end =
      test_support::run_process(command({"--duration", "1"}, {"drive"}), options);
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.err, HasSubstr("scene.png"));
  EXPECT_EQ(report().at("ended").at("by"), "duration");
  EXPECT_FALSE(fs::exists(result("scene.png")));
  EXPECT_FALSE(fs::exists(result("scene.part.png")));
}

// Trajectory and pictures take all the room, but not that of the report.
TEST_F(PlaypenEnds, FullDisk_KeepsReport) {
  // A disk of its own, in a mount namespace; without privileges, also in a user namespace.
  const std::string disk = folder_ / "disk";
  fs::create_directories(disk);
  std::vector<std::string> alone = {"unshare", "--mount"};
  if (geteuid() != 0) alone = {"unshare", "--user", "--map-root-user", "--mount"};
  const auto on_disk = [&](const std::string& script) {
    std::vector<std::string> call = alone;
    call.insert(call.end(),
                {"sh", "-c", "mount -t tmpfs -o size=256k none \"$1\" || exit 77; shift; " + script,
                 "sh", disk});
    out_ = disk + "/out";
    const std::vector<std::string> run = command({"--quiet", "--duration", "400"}, {"drive", "-1"});
    call.insert(call.end(), run.begin(), run.end());
    return test_support::run_process(call);
  };
  // 256 kB are 64 pages; the rows of 400 s take more than 200 kB.
  const ProcessResult end =
      on_disk("\"$@\"; status=$?; cat " + disk + "/out/report.json; tail -c 1 " + disk +
              "/out/trajectory.csv | wc -l >&2; exit $status");
  if (end.status == 77) GTEST_SKIP() << "no disk can be mounted here: " << end.err;
  EXPECT_EQ(end.status, 1) << end.err;
  EXPECT_THAT(end.err, HasSubstr("trajectory.csv ends before "));
  EXPECT_THAT(end.err, HasSubstr("No space left on device"));
  EXPECT_THAT(end.err, testing::EndsWith("1\n")) << "the last row is cut off";
  const json report = json::parse(end.out);
  EXPECT_EQ(report.at("run").at("sim_time"), 400.0);
  EXPECT_EQ(report.at("ended").at("by"), "duration");
}

// --- The table of ends: what a run leaves, by how and when it ends. A merge tries each end once, a
// nightly run once in each phase. PLAYPEN_ENDS_TRIES=20 tries each end in each phase 20 times. With
// each phase, the table's rows are printed.

enum class Whom { kCommand, kProgram, kGroup, kDisk, kTerminal };
enum class Phase { kStart, kRun, kPictures, kFilm };

struct WayToEnd {
  const char* name;
  int signal;
  Whom whom;
};

void PrintTo(const WayToEnd& way, std::ostream* out) { *out << way.name; }

constexpr WayToEnd kWaysToEnd[] = {
    {"SIGINT to the command", SIGINT, Whom::kCommand},
    {"SIGINT to the program", SIGINT, Whom::kProgram},
    {"SIGINT to the group (Ctrl-C)", SIGINT, Whom::kGroup},
    {"SIGTERM to the command", SIGTERM, Whom::kCommand},
    {"SIGTERM to the program", SIGTERM, Whom::kProgram},
    {"SIGTERM to the group", SIGTERM, Whom::kGroup},
    {"SIGHUP to the command", SIGHUP, Whom::kCommand},
    {"SIGHUP to the program", SIGHUP, Whom::kProgram},
    {"SIGHUP to the group", SIGHUP, Whom::kGroup},
    {"SIGKILL to the command", SIGKILL, Whom::kCommand},
    {"SIGKILL to the program", SIGKILL, Whom::kProgram},
    {"SIGKILL to the group", SIGKILL, Whom::kGroup},
    {"crash of the program (SIGSEGV)", SIGSEGV, Whom::kProgram},
    {"no more room for files (ulimit -f)", 0, Whom::kDisk},
    {"closed terminal", 0, Whom::kTerminal},
};

/// A program on its own terminal, as leader of its session.
class OnTerminal {
 public:
  explicit OnTerminal(std::vector<std::string> command) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("pipe failed");
    held_ = ends[0];
    child_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (child_ == 0) {
      close(ends[0]);
      for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
      std::vector<char*> arguments;
      for (std::string& word : command) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    close(ends[1]);
  }
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal& operator=(const OnTerminal&) = delete;
  ~OnTerminal() {
    kill(child_, SIGKILL);
    hang_up();
    while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    close(held_);
  }

  [[nodiscard]] bool read_until(const std::string& text) {
    std::array<char, 256> bytes{};
    while (output_.find(text) == std::string::npos) {
      const ssize_t count = read(terminal_, bytes.data(), bytes.size());
      if (count <= 0) return false;
      output_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return true;
  }
  void hang_up() {
    if (terminal_ >= 0) close(std::exchange(terminal_, -1));
  }
  /// Waits until all its processes have ended. @return whether they have.
  [[nodiscard]] bool wait_until_all_are_gone() const {
    pollfd gone{held_, POLLIN, 0};
    const auto limit = std::chrono::milliseconds(test_support::patience()).count();
    return poll(&gone, 1, static_cast<int>(limit)) == 1;
  }

 private:
  pid_t child_ = -1;
  int terminal_ = -1;
  int held_ = -1;
  std::string output_;
};

TEST_F(PlaypenEnds, ClosedTerminal_EndsRun) {
  for (const char* program : {"start", "drive", "compute"}) {
    SCOPED_TRACE(program);
    fs::remove_all(out_);
    OnTerminal process(command({"--quiet", "--time", "20"}, {program}));
    ASSERT_TRUE(process.read_until("ready"));
    process.hang_up();
    ASSERT_TRUE(process.wait_until_all_are_gone());
    expect_all_results();
    EXPECT_EQ(report().at("ended"), json({{"by", "request"}, {"signal", "SIGHUP"}}));
  }
}

class PlaypenEndsTable : public PlaypenEnds, public testing::WithParamInterface<WayToEnd> {
 protected:
  PlaypenEndsTable() {
    // Drawing this world takes a while.
    json world = json::parse(room_world());
    world["canvas"]["size"] = {1600, 1600};
    large_world_ = folder_.write("large.json", world.dump());
    room_world_ = world_;
  }

  /// Ends a run in a phase, and checks its results.
  /// @return whether nothing is lost.
  bool attempt(const WayToEnd& way, Phase phase) {
    fs::remove_all(out_);
    const bool on_the_way = phase == Phase::kStart || phase == Phase::kRun;
    world_ = phase == Phase::kPictures ? large_world_ : room_world_;
    std::vector<std::string> options = {"--quiet"};
    if (phase == Phase::kRun) options.insert(options.end(), {"--time", "20"});
    if (!on_the_way) options.insert(options.end(), {"--duration", "5.2"});
    film_ = folder_ / "film.mp4";
    fs::remove(film_);
    if (phase == Phase::kFilm)
      options.insert(options.end(), {"--record", film_, "--record-speed", "4"});
    const std::vector<std::string> call =
        command(options, {phase == Phase::kStart ? "start" : "drive"});
    bool gone = false;
    if (way.whom == Whom::kTerminal) {
      OnTerminal process(call);
      if (!process.read_until("ready")) return false;
      if (!on_the_way) wait_for(phase);
      process.hang_up();
      gone = process.wait_until_all_are_gone();
    } else {
      ProcessOptions process_options;
      // Enough for the report, but not for a picture.
      if (way.whom == Whom::kDisk) process_options.file_limit = 8192;
      Process process(call, process_options);
      if (!process.read_until("\n")) return false;
      if (!on_the_way) wait_for(phase);
      const pid_t program = std::stoi(process.output().substr(std::string("ready ").size()));
      switch (way.whom) {
        case Whom::kCommand:
          process.send_signal(way.signal);
          break;
        case Whom::kProgram:
          kill(program, way.signal);
          break;
        case Whom::kGroup:
          process.send_signal_to_group(way.signal);
          break;
        case Whom::kDisk:
          if (on_the_way) process.send_signal(SIGTERM);
          break;
        case Whom::kTerminal:
          break;
      }
      const ProcessResult end = process.finish();
      gone = !end.timed_out;
    }
    const json ended = has("report.json") ? report().at("ended") : json();
    const bool pictures = has("scene.png") && has("canvas.png");
    bool whole = gone && has("trajectory.csv") && pictures == (way.whom != Whom::kDisk);
    // The limit also applies to the memory shared with the program: if the program must be killed
    // before its first step, there is no report.
    const bool owes_no_report = way.whom == Whom::kDisk && phase == Phase::kStart;
    whole = whole && (owes_no_report || !ended.is_null());
    if (!whole) tell_what_is_left(gone, ended);
    return whole;
  }

  [[nodiscard]] bool has_film() const { return fs::exists(film_); }

 private:
  void tell_what_is_left(bool gone, const json& ended) const {
    std::cout << "not whole: processes " << (gone ? "gone" : "left") << ", ended " << ended;
    if (fs::is_directory(out_)) {
      for (const auto& file : fs::directory_iterator(out_)) {
        std::cout << ", " << file.path().filename() << " of " << file.file_size() << " bytes";
      }
    }
    std::cout << std::endl;
  }

  /// Waits until a run that ends by itself has reached a phase.
  void wait_for(Phase phase) const {
    const auto deadline = std::chrono::steady_clock::now() + test_support::patience();
    const char* const before = phase == Phase::kPictures ? "report.json" : "canvas.png";
    for (;;) {
      if (std::chrono::steady_clock::now() > deadline) return;
      if (has(before) && (phase == Phase::kFilm || !report().at("ended").is_null())) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  std::string room_world_;
  std::string large_world_;
  std::string film_;
};

TEST_P(PlaypenEndsTable, LeavesReportTrajectoryAndPictures) {
  const WayToEnd& way = GetParam();
  const char* const wanted = std::getenv("PLAYPEN_ENDS_TRIES");
  const int tries = wanted == nullptr ? test_support::cases(0, 1) : std::atoi(wanted);
  constexpr Phase kPhases[] = {Phase::kStart, Phase::kRun, Phase::kPictures, Phase::kFilm};
  if (tries <= 0) {
    // A different phase for each end, so that all phases are tested.
    const std::string name = way.name;
    const Phase phase = kPhases[(name.size() + static_cast<std::size_t>(way.signal)) % 4];
    EXPECT_TRUE(attempt(way, phase)) << "phase " << static_cast<int>(phase);
    return;
  }
  std::string row = std::string("| ") + way.name;
  for (const Phase phase : kPhases) {
    int kept = 0;
    int films = 0;
    for (int i = 0; i < tries; ++i) {
      if (attempt(way, phase)) ++kept;
      if (has_film()) ++films;
    }
    EXPECT_EQ(kept, tries) << "phase " << static_cast<int>(phase);
    row += " | " + std::to_string(kept) + " of " + std::to_string(tries);
    if (phase == Phase::kFilm) row += " | " + std::to_string(films);
  }
  std::cout << row << " |" << std::endl;
}

INSTANTIATE_TEST_SUITE_P(All, PlaypenEndsTable, testing::ValuesIn(kWaysToEnd));

}  // namespace
