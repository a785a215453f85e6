// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Pair;
using testing::ThrowsMessage;
using testing::UnorderedElementsAre;

TEST(RunEnvironment, UnsetVariables_Removed) {
  EXPECT_THAT(
      run_environment("", RunSettings{}),
      UnorderedElementsAre(
          Pair("PLAYPEN_WORLD", std::nullopt), Pair("PLAYPEN_OUT", std::nullopt),
          Pair("PLAYPEN_RECORD", std::nullopt), Pair("PLAYPEN_SEED", std::nullopt),
          Pair("PLAYPEN_DURATION", std::nullopt), Pair("PLAYPEN_TIME", std::nullopt),
          Pair("PLAYPEN_PROGRESS", std::nullopt), Pair("PLAYPEN_RUN", std::nullopt),
          Pair("PLAYPEN_RECORD_FPS", std::nullopt), Pair("PLAYPEN_RECORD_SPEED", std::nullopt),
          Pair("PLAYPEN_RECORD_FROM", std::nullopt), Pair("PLAYPEN_RECORD_SIZE", std::nullopt),
          Pair("PLAYPEN_FOLLOW", std::nullopt), Pair("PLAYPEN_CROP", std::nullopt),
          Pair("PLAYPEN_HIDE", std::nullopt), Pair("PLAYPEN_COLOUR_BY", std::nullopt),
          Pair("PLAYPEN_SNAPSHOT_EVERY", std::nullopt), Pair("PLAYPEN_VIEW_MODE", std::nullopt),
          Pair("PLAYPEN_VIEW", std::nullopt), Pair("PLAYPEN_PAGE", std::nullopt),
          Pair("PLAYPEN_RESULTS", std::nullopt), Pair("PLAYPEN_PREPARED", std::nullopt),
          Pair("PLAYPEN_CLIENTS", std::nullopt), Pair("PLAYPEN_INTERFACES", std::nullopt),
          Pair("PLAYPEN_GRADE", std::nullopt), Pair("PLAYPEN_VIRTUAL_TIME", std::nullopt),
          Pair("PLAYPEN_STATE", std::nullopt), Pair("PLAYPEN_REALISM", std::nullopt),
          Pair("PLAYPEN_REAL", std::nullopt), Pair("PLAYPEN_PLAYER_PORT", std::nullopt),
          Pair("PLAYPEN_TAKE_OVER", std::nullopt), Pair("PLAYPEN_TASK", std::nullopt),
          Pair("PLAYPEN_PORT", std::nullopt), Pair("PLAYPEN_DESK", std::nullopt),
          Pair("PLAYPEN_START", std::nullopt), Pair("PLAYPEN_UNTIL", std::nullopt),
          Pair("PLAYPEN_THEN", std::nullopt)));
}

TEST(RunEnvironment, Paths_MadeAbsolute) {
  RunSettings settings;
  settings.output_folder = "a/../out";
  settings.film = "/films/./run.mp4";
  const EnvironmentChanges changes = run_environment("world.json", settings);
  EXPECT_EQ(changes.at("PLAYPEN_WORLD"), (fs::current_path() / "world.json").string());
  EXPECT_EQ(changes.at("PLAYPEN_OUT"), (fs::current_path() / "out").string());
  EXPECT_EQ(changes.at("PLAYPEN_RECORD"), "/films/run.mp4");
}

/// Sets environment variables of this process, and restores them.
class ScopedEnvironment {
 public:
  explicit ScopedEnvironment(const EnvironmentChanges& changes) {
    for (const auto& [name, value] : changes) {
      const char* old = std::getenv(name.c_str());
      old_[name] = old != nullptr ? std::optional<std::string>(old) : std::nullopt;
      set(name, value);
    }
  }
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;
  ~ScopedEnvironment() {
    for (const auto& [name, value] : old_) set(name, value);
  }

 private:
  static void set(const std::string& name, const std::optional<std::string>& value) {
    if (value) {
      setenv(name.c_str(), value->c_str(), 1);
    } else {
      unsetenv(name.c_str());
    }
  }
  EnvironmentChanges old_;
};

TEST(RunEnvironment, InvalidStartAndStop_Named) {
  const auto read = [] { static_cast<void>(RunSettings::from_environment()); };
  {
    const ScopedEnvironment environment(
        EnvironmentChanges{{"PLAYPEN_UNTIL", "soon"}, {"PLAYPEN_THEN", "fly"}});
    EXPECT_THAT(read, ThrowsMessage<sim::ConfigError>(
                          AllOf(HasSubstr("PLAYPEN_UNTIL"), HasSubstr("a number of seconds"),
                                HasSubstr("PLAYPEN_THEN"), HasSubstr("\"fly\""))));
  }
  {
    const ScopedEnvironment environment(EnvironmentChanges{{"PLAYPEN_THEN", "view"}});
    EXPECT_THAT(read, ThrowsMessage<sim::ConfigError>(HasSubstr("PLAYPEN_UNTIL beside it")));
  }
  const ScopedEnvironment environment(
      EnvironmentChanges{{"PLAYPEN_START", "/tmp/state"}, {"PLAYPEN_GRADE", "17"}});
  EXPECT_THAT(read, ThrowsMessage<sim::ConfigError>(HasSubstr("begins at the beginning")));
}

TEST(RunEnvironment, RoundTrips) {
  RunSettings settings;
  settings.seed = 18446744073709551615U;  // 2^64 - 1: a double could not hold it
  settings.duration_s = 0.1;              // no finite binary fraction: must survive the text
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 2.5;
  settings.output_folder = "/out";
  settings.film = "/film.mp4";
  settings.film_fps = 29.97;
  settings.film_speed = 0.1;
  settings.snapshot_period_s = 2.5;
  settings.view_mode = sim::ViewMode::kMiniMap;
  settings.realism = sim::Realism::kReal;
  settings.progress = true;
  settings.quiet_end = true;
  settings.virtual_time = true;
  settings.clients = 12;
  settings.start_state = "/tmp/state";
  settings.stop = {31.05, RunStop::Then::kView};
  settings.robot_port = 7000;
  settings.interfaces = {{"", "ranger", 0, "sonar"}, {"r.1", "position2d", 1, "pose"}};
  const ScopedEnvironment environment(run_environment("/world.json", settings));
  const RunSettings read = RunSettings::from_environment();
  EXPECT_EQ(read.seed, settings.seed);
  EXPECT_EQ(read.duration_s, settings.duration_s);
  EXPECT_EQ(read.time_mode, settings.time_mode);
  EXPECT_EQ(read.time_factor, settings.time_factor);
  EXPECT_EQ(read.output_folder, settings.output_folder);
  EXPECT_EQ(read.film, settings.film);
  EXPECT_EQ(read.start_state, settings.start_state);
  ASSERT_TRUE(read.stop);
  EXPECT_EQ(read.stop->time_s, settings.stop->time_s);
  EXPECT_EQ(read.stop->then, settings.stop->then);
  EXPECT_EQ(read.film_fps, settings.film_fps);
  EXPECT_EQ(read.film_speed, settings.film_speed);
  EXPECT_EQ(read.snapshot_period_s, settings.snapshot_period_s);
  EXPECT_EQ(read.view_mode, settings.view_mode);
  EXPECT_EQ(read.realism, settings.realism);
  EXPECT_EQ(read.progress, settings.progress);
  EXPECT_EQ(read.quiet_end, settings.quiet_end);
  EXPECT_EQ(read.virtual_time, settings.virtual_time);
  EXPECT_EQ(read.clients, settings.clients);
  EXPECT_EQ(read.robot_port, settings.robot_port);
  ASSERT_EQ(read.interfaces.size(), 2U);
  EXPECT_EQ(read.interfaces[0].text(), "ranger:0=sonar");
  EXPECT_EQ(read.interfaces[1].text(), "r.1.position2d:1=pose");
  EXPECT_EQ(read.interfaces[1].robot, "r.1");
  sim::WorldDescription world;
  RunSettings without_robots = read;
  without_robots.interfaces.clear();
  without_robots.apply_to(world);
  EXPECT_EQ(world.simulation.start_gate_clients, 12);
}

TEST(RunEnvironment, Lockstep_RoundTrips) {
  RunSettings settings;
  settings.time_mode = sim::TimeMode::kLockstep;
  const ScopedEnvironment environment(run_environment("", settings));
  EXPECT_EQ(RunSettings::from_environment().time_mode, sim::TimeMode::kLockstep);
}

TEST(RunSettings, InvalidVariables_NamedWithValue) {
  const EnvironmentChanges bad = {{"PLAYPEN_RECORD", "film.gif"},
                                  {"PLAYPEN_RECORD_FPS", "0"},
                                  {"PLAYPEN_RECORD_SPEED", "1001"},
                                  {"PLAYPEN_RECORD_SIZE", "640x63"},
                                  {"PLAYPEN_FOLLOW", "r1,0"},
                                  {"PLAYPEN_CROP", "0,0,1"},
                                  {"PLAYPEN_HIDE", "fans,walls"},
                                  {"PLAYPEN_COLOUR_BY", "speed"},
                                  {"PLAYPEN_SNAPSHOT_EVERY", "0"},
                                  {"PLAYPEN_VIEW_MODE", "fullscreen"},
                                  {"PLAYPEN_REALISM", "true"},
                                  {"PLAYPEN_CLIENTS", "1001"},
                                  {"PLAYPEN_INTERFACES", "ranger:0=laser,ranger=sonar"},
                                  {"PLAYPEN_OUT", "out"}};
  const ScopedEnvironment environment(bad);
  try {
    static_cast<void>(RunSettings::from_environment());
    FAIL() << "taken";
  } catch (const sim::ConfigError& error) {
    for (const auto& [name, value] : bad) {
      if (name == "PLAYPEN_OUT") continue;
      EXPECT_THAT(error.what(), AllOf(HasSubstr(name), HasSubstr('"' + *value + '"')));
    }
  }
}

TEST(RunSettings, Pictures_RoundTrip) {
  RunSettings settings;
  EXPECT_TRUE(parse_film_size("640x480", settings.pictures));
  EXPECT_TRUE(parse_follow("r1,2.5", settings.pictures));
  EXPECT_TRUE(parse_crop("0.1,-1,1.5,2", settings.pictures));
  EXPECT_TRUE(parse_hide("fans,labels,canvas", settings.pictures));
  EXPECT_TRUE(parse_colour_by("robot", settings.pictures));
  EXPECT_FALSE(settings.pictures.names);
  EXPECT_TRUE(settings.pictures.trails);
  EXPECT_TRUE(settings.pictures.traps);
  EXPECT_TRUE(parse_hide("traps,timers,texts,scores", settings.pictures));
  EXPECT_FALSE(settings.pictures.traps);
  EXPECT_FALSE(settings.pictures.timers);
  EXPECT_FALSE(settings.pictures.texts);
  EXPECT_FALSE(settings.pictures.scores);
  {
    const ScopedEnvironment environment(run_environment("", settings));
    EXPECT_EQ(RunSettings::from_environment().pictures, settings.pictures);
  }
  EXPECT_TRUE(parse_film_size("640", settings.pictures));
  EXPECT_TRUE(parse_follow("r1", settings.pictures));
  EXPECT_EQ(settings.pictures.width_px, 0);
  const ScopedEnvironment environment(run_environment("", settings));
  EXPECT_EQ(RunSettings::from_environment().pictures, settings.pictures);
}

TEST(RunSettings, InvalidPictureSettings_ChangeNothing) {
  sim::render::RenderOptions options;
  const sim::render::RenderOptions before = options;
  for (const char* size : {"", "x", "63", "4097", "640x", "x480", "640x480x3", "640 x 480"}) {
    EXPECT_FALSE(parse_film_size(size, options)) << size;
  }
  for (const char* crop :
       {"", "1,2,3", "1,2,3,4,5", "0,0,0,1", "0,0,1,-1", "nan,0,1,1", "a,0,1,1"}) {
    EXPECT_FALSE(parse_crop(crop, options)) << crop;
  }
  for (const char* follow : {"", ",1", "r1,", "r1,-1", "r1,1,1"}) {
    EXPECT_FALSE(parse_follow(follow, options)) << follow;
  }
  for (const char* hide : {"", "fan", "fans,", "fans labels"}) {
    EXPECT_FALSE(parse_hide(hide, options)) << hide;
  }
  EXPECT_FALSE(parse_colour_by("", options));
  EXPECT_EQ(options, before);
}

TEST(RunSettings, Pictures_RequireObjectsOfWorld) {
  sim::WorldDescription world = sim::load_world_text(
      R"({"name": "small", "arena": {"size": [2, 1]}, "robots": [{"name": "r1"}]})");
  RunSettings settings;
  settings.pictures.follow = "r2";
  EXPECT_THAT([&] { settings.apply_to(world); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("run/follow"), HasSubstr("r1"), HasSubstr("\"r2\""))));
  settings.pictures.follow = "r1";
  settings.apply_to(world);
  settings.pictures.follow.clear();
  EXPECT_TRUE(parse_crop("2,0,1,1", settings.pictures));
  EXPECT_THAT([&] { settings.apply_to(world); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("run/crop"), HasSubstr("to 2, 1"), HasSubstr("2,0,1,1"))));
  EXPECT_TRUE(parse_crop("1.9,0,1,1", settings.pictures));
  settings.apply_to(world);
}

// --- --port

std::vector<int> ports_from(int lowest, const std::string& world) {
  sim::WorldDescription description = sim::load_world_text(world);
  RunSettings settings;
  settings.robot_port = lowest;
  settings.apply_to(description);
  settings.apply_to(description);  // as a server does
  std::vector<int> ports;
  for (const sim::RobotDescription& robot : description.robots) ports.push_back(robot.port);
  return ports;
}

TEST(RunSettings, Port_ShiftsAllRobots) {
  using testing::ElementsAre;
  // By default 6665 and 6666.
  EXPECT_THAT(ports_from(7000, R"({"arena": {"size": [4, 4]}, "robots": [
                {"pose": {"x": 1, "y": 1}}, {"pose": {"x": 3, "y": 3}}]})"),
              ElementsAre(7000, 7001));
  // The lowest one is the first: 7000 - 6665 = 335, and 6668 + 335 = 7003.
  EXPECT_THAT(ports_from(7000, R"({"arena": {"size": [4, 4]}, "robots": [
                {"pose": {"x": 1, "y": 1}, "port": 6668},
                {"pose": {"x": 3, "y": 3}, "port": 6665}]})"),
              ElementsAre(7003, 7000));
  EXPECT_THAT(ports_from(7000, R"({"arena": {"size": [4, 4]}, "robots_on_port": 6665, "robots": [
                {"pose": {"x": 1, "y": 1}}, {"pose": {"x": 3, "y": 3}}]})"),
              ElementsAre(7000, 7000));
}

TEST(RunSettings, PortOfRealRobot_NotShifted) {
  sim::WorldDescription world = sim::load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}}]})");
  RunSettings settings;
  settings.real_robots = {{"r1", "tcp://lab"}};
  settings.robot_port = 7000;
  settings.apply_to(world);
  EXPECT_EQ(world.robots[0].port, 7000);
  EXPECT_EQ(world.robots[0].real->port, 6665);
}

TEST(RunSettings, InvalidPorts_Refused) {
  const std::string world = R"({"arena": {"size": [4, 4]}, "robots": [
      {"name": "r1", "pose": {"x": 1, "y": 1}}, {"name": "r2", "pose": {"x": 3, "y": 3}}]})";
  EXPECT_THAT([&] { ports_from(65535, world); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("run/port"), HasSubstr("up to 65534"), HasSubstr("65535"))));
  EXPECT_THAT([&] { ports_from(3999, world); },
              ThrowsMessage<sim::ConfigError>(
                  AllOf(HasSubstr("run/port"), HasSubstr("4000"), HasSubstr("robot r2"))));
}

TEST(RunSettings, Snapshots_NeedOutputFolder) {
  const ScopedEnvironment environment(
      {{"PLAYPEN_SNAPSHOT_EVERY", "1"}, {"PLAYPEN_OUT", std::nullopt}});
  EXPECT_THAT([] { static_cast<void>(RunSettings::from_environment()); },
              ThrowsMessage<sim::ConfigError>(HasSubstr("PLAYPEN_OUT beside it")));
}

TEST(RunSettings, ViewMode_SetUnlessWorldLocksAnother) {
  RunSettings settings;
  settings.view_mode = sim::ViewMode::kFullScreen;
  settings.realism = sim::Realism::kIdeal;
  sim::WorldDescription world;
  settings.apply_to(world);
  EXPECT_EQ(world.canvas.view_mode, sim::ViewMode::kFullScreen);
  EXPECT_EQ(world.simulation.realism, sim::Realism::kIdeal);

  world.canvas.view_mode_locked = true;
  settings.apply_to(world);  // identical settings: no warning
  settings.view_mode = sim::ViewMode::kGround;
  EXPECT_THAT(
      [&] { settings.apply_to(world); },
      ThrowsMessage<sim::ConfigError>(
          AllOf(HasSubstr("run/view_mode_locked"), HasSubstr("full-screen"), HasSubstr("ground"))));
}

/// A child process that does the same thing until it is killed.
class Child {
 public:
  explicit Child(void (*what)()) : id_(fork()) {
    if (id_ != 0) return;
    for (;;) what();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  [[nodiscard]] pid_t id() const { return id_; }

 private:
  pid_t id_;
};

using std::chrono::milliseconds;

TEST(TimeGiven, ComputingProcess_GivenItsProcessorTime) {
  const Child child([] {});
  TimeGiven given(child.id());
  while (given.computed() < milliseconds(30)) {
    std::this_thread::sleep_for(milliseconds(1));
    given.look();
  }
  EXPECT_EQ(given.idle(), milliseconds(0));
}

TEST(TimeGiven, SleepingProcess_GivenItsSleep) {
  const Child child([] { pause(); });
  TimeGiven given(child.id());
  while (given.idle() < milliseconds(30)) {
    std::this_thread::sleep_for(milliseconds(1));
    given.look();
  }
  EXPECT_LT(given.computed(), milliseconds(30));
  EXPECT_GE(given.total(), milliseconds(30));
}

TEST(TimeGiven, LongPauseBetweenLooks_CountsAsTenthOfSecond) {
  const Child child([] { pause(); });
  TimeGiven given(child.id());
  std::this_thread::sleep_for(milliseconds(150));
  given.look();
  EXPECT_LE(given.total() - given.computed(), milliseconds(100));
}

TEST(FindProgram, NameWithSlash_IsPath) {
  EXPECT_EQ(find_program("/bin/sh"), "/bin/sh");
  EXPECT_THAT([] { static_cast<void>(find_program("./no/such/program")); },
              ThrowsMessage<ProgramError>(HasSubstr("there is no program './no/such/program'")));
}

TEST(FindProgram, Path_SearchedInOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"first/tool", "second/tool"}) {
    fs::permissions(folder.write(name, "#!/bin/sh\n"), fs::perms::owner_all);
  }
  // Not executable, so that it is skipped.
  folder.write("zeroth/tool", "text");
  const ScopedEnvironment environment(
      {{"PATH", folder / "zeroth" + ":" + folder / "first" + ":" + folder / "second"}});
  EXPECT_EQ(find_program("tool"), folder / "first/tool");
  EXPECT_THAT([] { static_cast<void>(find_program("tol")); },
              ThrowsMessage<ProgramError>(HasSubstr("'tol' on the PATH")));
}

TEST(FindProgram, FoldersAndEmptyName_Refused) {
  EXPECT_THAT([] { static_cast<void>(find_program("/")); },
              ThrowsMessage<ProgramError>(HasSubstr("is a folder")));
  EXPECT_THAT([] { static_cast<void>(find_program("")); },
              ThrowsMessage<ProgramError>(HasSubstr("empty")));
}

TEST(RunProgram, ReportsEnd) {
  const ProgramEnd fine = run_program({"/bin/sh", "-c", "exit 0"}, {});
  EXPECT_TRUE(fine.success());
  const ProgramEnd failed = run_program({"/bin/sh", "-c", "exit 42"}, {});
  EXPECT_FALSE(failed.success());
  EXPECT_EQ(failed.text(), "ended with status 42");
  const ProgramEnd killed = run_program({"/bin/sh", "-c", "kill -TERM $$"}, {});
  EXPECT_FALSE(killed.success());
  EXPECT_EQ(killed.signal, SIGTERM);
  EXPECT_EQ(killed.text(), "was ended by signal 15 (Terminated)");
}

TEST(RunProgram, Environment_ChangedForProgramOnly) {
  const ScopedEnvironment environment({{"PLAYPEN_TEST_OLD", "old"}, {"PLAYPEN_TEST_GONE", "gone"}});
  const ProgramEnd end =
      run_program({"/bin/sh", "-c",
                   "test \"$PLAYPEN_TEST_OLD$PLAYPEN_TEST_NEW${PLAYPEN_TEST_GONE-none}\""
                   " = oldnewnone"},
                  {{"PLAYPEN_TEST_NEW", "new"}, {"PLAYPEN_TEST_GONE", std::nullopt}});
  EXPECT_TRUE(end.success()) << end.text();
  EXPECT_EQ(std::getenv("PLAYPEN_TEST_NEW"), nullptr);
}

TEST(RunProgram, SignalMask_Kept) {
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, nullptr, &before);
  EXPECT_TRUE(run_program({"/bin/sh", "-c", "exit 0"}, {}).success());
  sigset_t after;
  pthread_sigmask(SIG_BLOCK, nullptr, &after);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGCHLD}) {
    EXPECT_EQ(sigismember(&after, signal), sigismember(&before, signal)) << signal;
  }
}

TEST(RunProgram, ProgramThatCannotStart_Throws) {
  const TemporaryFolder folder;
  const std::string script = folder.write("script", "#!/no/such/interpreter\n");
  fs::permissions(script, fs::perms::owner_all);
  EXPECT_THAT([&] { static_cast<void>(run_program({script}, {})); },
              ThrowsMessage<ProgramError>(HasSubstr("can't be started")));
}

/// Jobs that run scripts in a separate folder.
class RunPrograms : public testing::Test {
 protected:
  [[nodiscard]] ProgramJob job(const std::string& script) {
    return {{"/bin/sh", "-c", script}, {}, folder_ / "log" + std::to_string(++count_)};
  }
  [[nodiscard]] std::string log(int number) const {
    return test_support::read_bytes(folder_ / "log" + std::to_string(number));
  }

  TemporaryFolder folder_;

 private:
  int count_ = 0;
};

/// A pipe whose writing end programs inherit. It shows when the last of them has ended.
class HeldByPrograms {
 public:
  HeldByPrograms() { EXPECT_EQ(pipe(ends_.data()), 0); }
  HeldByPrograms(const HeldByPrograms&) = delete;
  HeldByPrograms& operator=(const HeldByPrograms&) = delete;
  ~HeldByPrograms() { close(ends_[0]); }

  /// Waits without limit until no other process has the writing end.
  void wait_until_all_are_gone() {
    close(ends_[1]);
    char byte = 0;
    EXPECT_EQ(read(ends_[0], &byte, 1), 0);
  }

 private:
  std::array<int, 2> ends_{};
};

/// Programs that are started during its lifetime ignore SIGTERM.
class TermIgnored {
 public:
  TermIgnored() : old_(std::signal(SIGTERM, SIG_IGN)) {}
  TermIgnored(const TermIgnored&) = delete;
  TermIgnored& operator=(const TermIgnored&) = delete;
  ~TermIgnored() { std::signal(SIGTERM, old_); }

 private:
  void (*old_)(int);
};

TEST_F(RunPrograms, Ends_InOrderOfJobsWithSeparateOutputs) {
  const std::vector<ProgramJob> jobs = {job("echo one; echo more >&2; exit 3"), job("echo two"),
                                        job("kill -SEGV $$")};
  std::vector<std::size_t> started;
  std::vector<std::size_t> ended;
  const std::vector<JobEnd> ends = run_programs(
      jobs, {.at_once = 3, .timeout_s = 0.0}, [&](std::size_t i) { started.push_back(i); },
      [&](std::size_t i, const JobEnd& end) {
        EXPECT_EQ(end.kind, JobEnd::Kind::kEnded);
        ended.push_back(i);
      });
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_EQ(ends[0].program.status, 3);
  EXPECT_TRUE(ends[1].program.success());
  EXPECT_EQ(ends[2].program.signal, SIGSEGV);
  EXPECT_EQ(log(1), "one\nmore\n");
  EXPECT_EQ(log(2), "two\n");
  EXPECT_THAT(started, testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(ended, testing::UnorderedElementsAre(0, 1, 2));
}

TEST_F(RunPrograms, ParallelJobs_Limited) {
  std::vector<ProgramJob> jobs;
  // Each of a pair waits for the other, so the pair must run in parallel.
  for (const char* fifo : {"a", "b", "c"}) {
    ASSERT_EQ(std::system(("mkfifo " + folder_ / fifo).c_str()), 0);
    jobs.push_back(job("echo x > " + folder_ / fifo));
    jobs.push_back(job("cat " + folder_ / fifo));
  }
  int running = 0;
  int most = 0;
  const std::vector<JobEnd> ends = run_programs(
      jobs, {.at_once = 2}, [&](std::size_t) { most = std::max(most, ++running); },
      [&](std::size_t, const JobEnd&) { --running; });
  for (const JobEnd& end : ends) EXPECT_TRUE(end.program.success());
  EXPECT_EQ(most, 2);
  EXPECT_EQ(running, 0);
}

TEST_F(RunPrograms, WorkingFolder_ThatOfJobOrError) {
  std::vector<ProgramJob> jobs = {job("pwd -P")};
  jobs.front().working_folder = folder_.path();
  EXPECT_TRUE(run_programs(jobs, {}).front().program.success());
  EXPECT_EQ(log(1), std::filesystem::canonical(folder_.path()).string() + "\n");
  jobs.front().working_folder = folder_ / "missing";
  EXPECT_THROW(static_cast<void>(run_programs(jobs, {})), ProgramError);
}

TEST_F(RunPrograms, Input_Empty) {
  EXPECT_TRUE(run_programs({job("test -z \"$(cat)\"")}, {})[0].program.success());
}

TEST_F(RunPrograms, Timeout_SendsSigtermFirst) {
  const std::vector<JobEnd> ends = run_programs(
      {job("sleep 1000"), job("exit 0")}, {.at_once = 1, .timeout_s = 0.1, .grace_s = 1000.0});
  EXPECT_EQ(ends[0].kind, JobEnd::Kind::kTimedOut);
  EXPECT_EQ(ends[0].program.signal, SIGTERM);
  EXPECT_GE(ends[0].wall_time_s, 0.1);
}

TEST_F(RunPrograms, Timeout_KillsAfterGrace) {
  const TermIgnored ignored;
  const std::vector<JobEnd> ends =
      run_programs({job("sleep 1000")}, {.at_once = 1, .timeout_s = 0.1, .grace_s = 0.1});
  EXPECT_EQ(ends[0].kind, JobEnd::Kind::kTimedOut);
  EXPECT_EQ(ends[0].program.signal, SIGKILL);
}

TEST_F(RunPrograms, StoppedProgram_Ended) {
  const std::vector<JobEnd> ends =
      run_programs({job("kill -STOP $$")}, {.at_once = 1, .timeout_s = 0.1, .grace_s = 1000.0});
  EXPECT_EQ(ends[0].kind, JobEnd::Kind::kTimedOut);
}

TEST_F(RunPrograms, LongOutput_FirstBytesKept) {
  ProgramJob loud = job("head -c 300000 /dev/zero | tr '\\0' x; exit 3");
  loud.output_limit = 1000;
  const std::vector<JobEnd> ends = run_programs({loud}, {});
  EXPECT_EQ(ends[0].program.status, 3) << "it is neither blocked nor ended";
  const std::string kept = log(1);
  EXPECT_EQ(kept.substr(0, 1000), std::string(1000, 'x'));
  EXPECT_THAT(kept.substr(1000), HasSubstr("more than 1000 bytes; the last 299000 are left out"));
}

TEST_F(RunPrograms, LargeFolder_EndsProgram) {
  const std::string folder = folder_ / "out";
  fs::create_directories(folder);
  ProgramJob writer = job("head -c 200000 /dev/urandom > " + folder + "/big; sleep 1000");
  writer.folder = folder;
  writer.folder_limit = 100'000;
  ProgramJob modest = job("head -c 50000 /dev/urandom > " + folder_ / "small");
  modest.folder = folder_ / "none";
  modest.folder_limit = 100'000;
  const std::vector<JobEnd> ends = run_programs({writer, modest}, {});
  EXPECT_EQ(ends[0].kind, JobEnd::Kind::kTooMuchOutput);
  EXPECT_EQ(ends[1].kind, JobEnd::Kind::kEnded);
}

TEST_F(RunPrograms, ProcessOutsideGroup_Ended) {
  HeldByPrograms held;
  const std::vector<JobEnd> ends =
      run_programs({job("(trap '' TERM; setsid sh -c 'sleep 1000 & sleep 1000') & exit 0")}, {});
  EXPECT_TRUE(ends[0].program.success());
  held.wait_until_all_are_gone();
}

TEST_F(RunPrograms, KilledSupervisor_EndsItsProgramOnly) {
  HeldByPrograms held;
  const std::vector<JobEnd> ends = run_programs(
      {job("(setsid sleep 1000) & kill -KILL $PPID; sleep 1000"), job("sleep 1; exit 7")}, {2});
  EXPECT_EQ(ends[0].program.signal, SIGKILL);
  EXPECT_EQ(ends[1].program.status, 7);
  held.wait_until_all_are_gone();
}

TEST_F(RunPrograms, End_LeavesNothingRunning) {
  HeldByPrograms held;
  const std::vector<JobEnd> ends = run_programs({job("sleep 1000 & exit 0")}, {});
  EXPECT_TRUE(ends[0].program.success());
  held.wait_until_all_are_gone();
}

TEST_F(RunPrograms, Signal_EndsAllEarly) {
  for (const int signal : {SIGINT, SIGTERM}) {
    int started = 0;
    const std::vector<JobEnd> ends =
        run_programs({job("sleep 1000"), job("sleep 1000"), job("exit 0")},
                     {.at_once = 2, .timeout_s = 0.0, .grace_s = 1000.0}, [&](std::size_t) {
                       if (++started == 2) kill(getpid(), signal);
                     });
    EXPECT_EQ(ends[0].kind, JobEnd::Kind::kInterrupted);
    EXPECT_EQ(ends[0].program.signal, SIGTERM);
    EXPECT_EQ(ends[1].kind, JobEnd::Kind::kInterrupted);
    EXPECT_EQ(ends[2].kind, JobEnd::Kind::kNotStarted);
  }
}

TEST_F(RunPrograms, SecondSignal_EndsGrace) {
  const TermIgnored ignored;
  const std::vector<JobEnd> ends = run_programs(
      {job("sleep 1000")}, {.at_once = 1, .timeout_s = 0.0, .grace_s = 1e6}, [](std::size_t) {
        kill(getpid(), SIGINT);
        kill(getpid(), SIGHUP);  // both continue until they are asked to end
      });
  EXPECT_EQ(ends[0].kind, JobEnd::Kind::kInterrupted);
  EXPECT_EQ(ends[0].program.signal, SIGKILL);
}

TEST_F(RunPrograms, FailedStart_ThrowsAndEndsOthers) {
  HeldByPrograms held;
  ProgramJob no_program = job("");
  no_program.command = {folder_ / "none"};
  EXPECT_THAT(
      [&] {
        static_cast<void>(run_programs({job("sleep 1000"), no_program}, {2}));
      },
      ThrowsMessage<ProgramError>(HasSubstr("can't be started")));
  ProgramJob no_output = job("");
  no_output.output_file = folder_ / "no/such/folder/log";
  EXPECT_THAT(
      [&] {
        static_cast<void>(run_programs({job("sleep 1000"), no_output}, {2}));
      },
      ThrowsMessage<ProgramError>(HasSubstr("can't be made")));
  held.wait_until_all_are_gone();
}

TEST_F(RunPrograms, NoJobs_Accepted) { EXPECT_THAT(run_programs({}, {}), testing::IsEmpty()); }

}  // namespace
}  // namespace playerlike
