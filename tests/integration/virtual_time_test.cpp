// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Programs with sleeps, clocks and threads, under `playpen run`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "machine_load.h"
#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::cases;
using test_support::MachineLoad;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::room_world;
using test_support::TemporaryFolder;
using test_support::without_wall_time;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// Runs programs of virtual_time_program on the room, in a separate folder.
class VirtualTime : public testing::Test {
 protected:
  [[nodiscard]] ProcessResult run(const std::string& name,
                                  const std::vector<std::string>& options = {}) const {
    std::vector<std::string> call = {"run", world_, "--out", out_};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", SLEEPING_PROGRAM, name});
    return playpen(call);
  }
  /// The program's output, without the summary.
  [[nodiscard]] std::string printed(const std::string& name) const {
    const ProcessResult result = run(name, {"--quiet", "--duration", "100"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    return result.out;
  }
  /// The report, without wall-clock values.
  [[nodiscard]] json report() const { return without_wall_time(read_report(out_)); }
  [[nodiscard]] json robot() const { return report().at("robots").at(0); }
  [[nodiscard]] double sim_time() const { return report().at("run").at("sim_time").get<double>(); }

  [[nodiscard]] std::vector<std::string> whys() const {
    const json run = report().at("run");
    EXPECT_EQ(run.at("repeatable"), !run.contains("repeatable_why"));
    return run.value("repeatable_why", std::vector<std::string>());
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world(0.01));
  std::string out_ = folder_ / "out";
};

TEST_F(VirtualTime, ProgramWithoutReads_DrivesWhileItSleeps) {
  ASSERT_EQ(run("drive_by_sleeping").status, 0);
  EXPECT_DOUBLE_EQ(sim_time(), 3.5);
  // 3 s at 0.1 m/s, minus the loss by acceleration and braking at 1 m/s^2 or more: 2 * 0.05 s * v.
  EXPECT_NEAR(robot().at("path_length").get<double>(), 0.3, 0.011);
}

TEST_F(VirtualTime, EverySleep_AdvancesSimulatedTime) {
  std::istringstream lines(printed("sleep_in_all_ways"));
  int ways = 0;
  for (std::string line; std::getline(lines, line); ++ways) {
    const bool whole = line.starts_with("sleep:") || line.find("until:") != std::string::npos ||
                       line.find("timedwait") != std::string::npos;
    const bool second = whole && !line.starts_with("sleep_until:");
    const char* expected = second ? ": 1.00 1.00" : ": 0.50 0.50";
    // 100000 * 1 us and 100 * 1.5 ms.
    if (line.starts_with("small ones")) expected = ": 0.25 0.25";
    // Reading the clock repeatedly advances time in whole steps.
    if (line.starts_with("clock:")) expected = ": 0.51 0.51";
    EXPECT_THAT(line, EndsWith(expected));
  }
  EXPECT_EQ(ways, 24);
}

TEST_F(VirtualTime, HeavyLoad_SameReport) {
  const std::string duration_s = cases("20", "60");
  for (const char* name :
       {"drive_by_sleeping", "read_and_sleep", "read_in_background", "read_in_own_thread"}) {
    const ProcessResult first = run(name, {"--duration", duration_s, "--quiet"});
    ASSERT_EQ(first.status, 0) << first.err;
    const json first_report = report();
    const std::string trajectory = read_bytes(fs::path(out_) / "trajectory.csv");

    std::optional<MachineLoad> load(4U);
    const ProcessResult second = run(name, {"--duration", duration_s, "--quiet"});
    load.reset();
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(first_report, report()) << name;
    EXPECT_TRUE(trajectory == read_bytes(fs::path(out_) / "trajectory.csv")) << name;
    EXPECT_EQ(first.out, second.out) << name;
  }
}

// Video encoders have their own threads, which are not threads of the program. They may wait for
// one another while a step waits for them.
TEST_F(VirtualTime, Film_DoesNotChangeRun) {
  const std::string duration_s = cases("3", "20");
  for (const char* name : {"read_in_background", "read_in_own_thread"}) {
    ASSERT_EQ(run(name, {"--duration", duration_s, "--quiet"}).status, 0);
    const json without = report();
    ASSERT_EQ(
        run(name, {"--duration", duration_s, "--quiet", "--record", folder_ / "film.mp4"}).status,
        0);
    EXPECT_EQ(report(), without) << name;
    EXPECT_GT(fs::file_size(folder_ / "film.mp4"), 1000U);
  }
}

TEST_F(VirtualTime, SixtySecondsOfReadsAndSleeps_TakeSixtySimulatedSeconds) {
  ASSERT_EQ(run("read_and_sleep", {"--duration", "60"}).status, 0);
  EXPECT_DOUBLE_EQ(sim_time(), 60.0);
}

TEST_F(VirtualTime, BackgroundThread_StaysInLockstep) {
  const ProcessResult result = run("read_in_background");
  ASSERT_EQ(result.status, 0);
  EXPECT_THAT(result.err, Not(HasSubstr("warning")));
  // 1 s and 200 * 70 ms, and up to two clock reads of 10 ms until the thread notices that it must
  // stop.
  EXPECT_GE(sim_time(), 15.0);
  EXPECT_LE(sim_time(), 15.02);
  EXPECT_GT(robot().at("path_length").get<double>(), 0.5);
}

TEST_F(VirtualTime, Threads_TakeTurnsInSameOrder) {
  const std::string first = printed("read_in_own_thread");
  const std::string second = printed("read_in_own_thread");
  EXPECT_EQ(first, second);
  // 100 iterations of 50 ms, and a count every 30 ms.
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 100);
  EXPECT_THAT(first, AllOf(HasSubstr(" 1\n"), HasSubstr(" 2\n"), Not(HasSubstr(" 3\n"))));
}

TEST_F(VirtualTime, ThreadsStartedTogether_RunInSameOrder) {
  const std::string first = printed("have_threads_with_clients");
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 80);
  const json first_report = report();
  EXPECT_EQ(first, printed("have_threads_with_clients"));
  EXPECT_EQ(first_report, report());
}

TEST_F(VirtualTime, PollingTheClock_AdvancesOneStepPerCall) {
  // 3 s in steps of 10 ms, minus the clock reads before that.
  const std::string out = printed("wait_for_the_clock");
  const int asked = std::atoi(out.substr(std::string("asked ").size()).c_str());
  EXPECT_NEAR(asked, 300, 5);
  EXPECT_DOUBLE_EQ(sim_time(), 3.0);
  EXPECT_NEAR(robot().at("path_length").get<double>(), 0.3, 0.011);
}

TEST_F(VirtualTime, OneClockReadPerRound_AdvancesNothing) {
  // A scan every 0.1 s, and the clock of 2026-01-01, 1767225600 s.
  const std::string out = printed("look_at_the_clock");
  EXPECT_THAT(out, StartsWith("0.100 600.100\n0.200 600.200\n0.300 600.300\n"));
  EXPECT_THAT(out, EndsWith("2.000 602.000\n"));
}

TEST_F(VirtualTime, Clock_ContinuousWhenSimulationStarts) {
  const std::string first = printed("begin_before_the_client");
  EXPECT_THAT(first, HasSubstr("\n0.02\n"));
  // Ten times 1 s by the clock; the last Read() returns with the scan of that time.
  EXPECT_THAT(first, EndsWith("\n10.02\n"));
  EXPECT_EQ(first, printed("begin_before_the_client"));
}

TEST_F(VirtualTime, SleepingProgram_EndsWithRun) {
  const ProcessResult result = run("drive_for_ever", {"--duration", "20"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("drives\n"));
  EXPECT_THAT(result.err, HasSubstr("the run is over: the program was ended while it slept"));
  EXPECT_DOUBLE_EQ(sim_time(), 20.0);
  EXPECT_EQ(run("drive_for_ever", {"--duration", "20", "--quiet"}).err, "");
}

TEST_F(VirtualTime, ProgramThatCatchesErrors_EndsWithRun) {
  EXPECT_EQ(run("drive_for_ever_in_background", {"--duration", "5"}).status, 0);
  EXPECT_DOUBLE_EQ(sim_time(), 5.0);
}

TEST_F(VirtualTime, ProgramWithoutReadsOrSleeps_EndsWithRun) {
  const ProcessResult result = run("command_for_ever", {"--duration", "2"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("was ended while it ran without calling Read()"),
                                Not(HasSubstr("slept"))));
  EXPECT_DOUBLE_EQ(sim_time(), 2.0);
  EXPECT_NEAR(robot().at("path_length").get<double>(), 0.02, 0.002);
  const json first = report().at("run").at("state_hash");
  EXPECT_EQ(run("command_for_ever", {"--duration", "2"}).status, 0);
  EXPECT_EQ(report().at("run").at("state_hash"), first);
}

TEST_F(VirtualTime, EndHandledAsError_NotFailure) {
  const ProcessResult result = run("take_the_end_for_an_error", {"--duration", "5"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("ended with status 255 when the run was over"));
  EXPECT_DOUBLE_EQ(sim_time(), 5.0);
}

// The status 1 may be the end of the run only if it comes then.
TEST_F(VirtualTime, FailureBeforeEnd_IsFailure) {
  const std::string program = SLEEPING_PROGRAM " drive_by_sleeping; exit 1";
  const ProcessResult result =
      playpen({"run", world_, "--out", out_, "--duration", "5", "--", "sh", "-c", program});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("ended with status 1"));
  EXPECT_DOUBLE_EQ(sim_time(), 3.5);
}

TEST_F(VirtualTime, SleepAfterEnd_Works) {
  const ProcessResult result = run("tidy_up_after_the_end", {"--duration", "2"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("over: 1\n"), HasSubstr("tidied up\n")));
  EXPECT_THAT(result.err, HasSubstr("ended with status 7"));
  EXPECT_DOUBLE_EQ(sim_time(), 2.0);
}

TEST_F(VirtualTime, PollingProxies_AdvancesTime) {
  EXPECT_THAT(printed("wait_in_background_for_a_place"), EndsWith("there\n"));
  EXPECT_GT(robot().at("path_length").get<double>(), 0.19);
}

TEST_F(VirtualTime, WaitForKey_PacedWithMessage) {
  const ProcessResult result = run("steer_by_hand");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("steered\n"));
  EXPECT_THAT(result.err, HasSubstr("simulated time now follows the wall clock"));
  const std::string warning = "warning";
  EXPECT_EQ(result.err.find(warning), result.err.rfind(warning)) << result.err;
}

TEST_F(VirtualTime, JoiningThread_TakesNoTime) {
  const std::string out = printed("join_threads");
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 3);
  EXPECT_EQ(out, printed("join_threads"));
}

TEST_F(VirtualTime, SignalledThread_RunsBeforeTimeAdvances) {
  const std::string first = printed("steer_when_told");
  const json first_report = report();
  EXPECT_THAT(first, StartsWith("0.200000000\n0.300000000\n0.400000000\n"));
  EXPECT_THAT(first, EndsWith("\n20.100000000\n"));
  EXPECT_EQ(first, printed("steer_when_told"));
  EXPECT_EQ(first_report, report());
}

TEST_F(VirtualTime, TimedWait_EndsWhenSignalled) {
  EXPECT_EQ(printed("wait_for_each_other"), "came 1\nanswered 1\n1\n");
}

TEST_F(VirtualTime, Signal_EndsSleep) {
  Process process({PLAYPEN_COMMAND, "run", world_, "--quiet", "--out", out_, "--", SLEEPING_PROGRAM,
                   "be_woken"});
  ASSERT_TRUE(process.read_until("\n"));
  const pid_t program = std::atoi(process.output().c_str());
  std::atomic<bool> woken{false};
  // Send it repeatedly: the first one may come before the sleep has begun.
  std::thread wake([&] {
    while (!woken) {
      kill(program, SIGUSR1);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  EXPECT_TRUE(process.read_until("alone"));
  woken = true;
  wake.join();
  const ProcessResult result = process.finish();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, EndsWith("\nalone 1\n-1 1 86399.5\n"));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("a signal ended a sleep")));
}

TEST_F(VirtualTime, WallClockUse_MarksRunAsNotRepeatable) {
  ASSERT_EQ(run("read_and_sleep", {"--duration", "2"}).status, 0);
  EXPECT_EQ(report().at("run").at("repeatable"), true);
  EXPECT_FALSE(report().at("run").contains("repeatable_why"));

  const ProcessResult blocked = run("steer_by_hand", {"--time", "lockstep"});
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("100 ms of wall time")));
  EXPECT_THAT(blocked.out, HasSubstr("another run may differ:\n  a thread of the program"));
  static_cast<void>(run("steer_by_hand"));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("followed the wall clock")));
  static_cast<void>(run("drive_by_sleeping", {"--time", "100"}));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("followed the wall clock")));
  static_cast<void>(run("have_threads_with_clients", {"--real-sleep", "--duration", "1"}));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("several threads")));
}

TEST_F(VirtualTime, RealSleep_RepeatableWithOneThreadOnly) {
  static_cast<void>(run("look_at_the_clock", {"--real-sleep", "--duration", "1"}));
  EXPECT_EQ(report().at("run").at("repeatable"), true);
  // Its other thread has no client.
  static_cast<void>(run("take_speeds_from_a_thread", {"--real-sleep"}));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("several threads")));
  // The thread that draws is Playpen's own.
  const std::vector<std::string> film = {"--real-sleep", "--record", folder_ / "film",
                                         "--record-fps", "1"};
  static_cast<void>(run("look_at_the_clock", film));
  EXPECT_EQ(report().at("run").at("repeatable"), true);
  static_cast<void>(run("take_speeds_from_a_thread", film));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("several threads")));
}

TEST_F(VirtualTime, SilenceLimit_ContinuesAndMarksReport) {
  ProcessOptions options;
  options.environment = {{"PLAYPEN_SILENCE_LIMIT", "0.2"}};
  const ProcessResult result =
      playpen({"run", world_, "--out", out_, "--", SLEEPING_PROGRAM, "compute_for_long"}, options);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("client 1 (port 6665) has not called Read() for 0.2"));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("the silence limit")));
}

TEST_F(VirtualTime, UnsupportedCall_ReportedOnce) {
  const ProcessResult result = run("set_an_alarm", {"--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("alarm() counts real time"));
  EXPECT_EQ(result.err.find("alarm()"), result.err.rfind("alarm()"));
  EXPECT_THAT(whys(), ElementsAre(HasSubstr("alarm() counts real time")));
}

TEST_F(VirtualTime, ClientsOption_HoldsTimeUntilTheyJoin) {
  // Two clients in two threads, each of which waits for a second client.
  ASSERT_EQ(run("have_threads_with_clients", {"--clients", "2"}).status, 0);
  EXPECT_EQ(report().at("run").at("repeatable"), true);
  ProcessOptions options;
  options.environment = {{"PLAYPEN_SILENCE_LIMIT", "0.2"}};
  Process waiting({PLAYPEN_COMMAND, "run", world_, "--out", out_, "--clients", "3", "--",
                   SLEEPING_PROGRAM, "have_threads_with_clients"},
                  options);
  EXPECT_TRUE(waiting.read_error_until("the start gate waits for 3 clients; 2 have joined"));
  for (const char* bad : {"0", "1001", "two"}) {
    const ProcessResult result = run("drive_by_sleeping", {std::string("--clients=") + bad});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, AllOf(HasSubstr("--clients"), HasSubstr("from 1 to 1000"))) << bad;
  }
}

TEST_F(VirtualTime, ChildrenAndOtherPrograms_Unaffected) {
  EXPECT_EQ(printed("have_a_child"), "child 5, own 0\n");
  const std::time_t now = std::time(nullptr);
  const ProcessResult date = playpen({"run", world_, "--out", out_, "--", "date", "+%s"});
  EXPECT_GE(std::atoll(date.out.c_str()), now);
}

TEST_F(VirtualTime, OffWithRealSleepAndPacedTime) {
  // In this mode the program's own sleeps do not count: no client ever waits, so no time passes.
  EXPECT_EQ(run("drive_by_sleeping", {"--real-sleep"}).status, 0);
  EXPECT_DOUBLE_EQ(sim_time(), 0.0);
  EXPECT_EQ(run("drive_by_sleeping", {"--time", "10"}).status, 0);
  EXPECT_GT(sim_time(), 3.5);  // ten times as much, if the machine is fast enough
}

TEST_F(VirtualTime, ExistingPreload_Kept) {
  ProcessOptions options;
  options.environment = {{"LD_PRELOAD", "libm.so.6"}};
  const std::vector<std::string> env = {"--out", out_, "--", "env"};
  std::vector<std::string> call = {"run", world_};
  call.insert(call.end(), env.begin(), env.end());
  EXPECT_THAT(playpen(call, options).out, AllOf(HasSubstr("\nLD_PRELOAD=libm.so.6:/"),
                                                HasSubstr("libplaypen_virtual_time.so\n"),
                                                HasSubstr("\nPLAYPEN_VIRTUAL_TIME=1\n")));
  call.insert(call.begin() + 2, "--real-sleep");
  EXPECT_THAT(playpen(call, options).out,
              AllOf(HasSubstr("LD_PRELOAD=libm.so.6\n"), Not(HasSubstr("PLAYPEN_VIRTUAL_TIME"))));
}

TEST_F(VirtualTime, MissingLibrary_Reported) {
  const std::string command = folder_ / "bin/playpen";
  fs::create_directories(folder_ / "bin");
  fs::copy_file(PLAYPEN_COMMAND, command);
  const auto call = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {command, "run", world_, "--out", out_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), {"--", SLEEPING_PROGRAM, "drive_by_sleeping"});
    return test_support::run_process(arguments);
  };
  const ProcessResult result = call({});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("lib/playpen/libplaypen_virtual_time.so, is missing"),
                                HasSubstr("--real-sleep")));
  EXPECT_EQ(call({"--real-sleep"}).status, 0);
}

TEST_F(VirtualTime, LibraryPathWithBlanks_Works) {
  const fs::path place = folder_ / "my own place";
  fs::create_directories(place / "bin");
  fs::create_directories(place / "lib/playpen");
  fs::copy_file(PLAYPEN_COMMAND, place / "bin/playpen");
  const fs::path name = "lib/playpen/libplaypen_virtual_time.so";
  fs::copy_file(fs::path(PLAYPEN_COMMAND).parent_path().parent_path() / name, place / name);
  const ProcessResult result =
      test_support::run_process({(place / "bin/playpen").string(), "run", world_, "--out", out_,
                                 "--", SLEEPING_PROGRAM, "drive_by_sleeping"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_DOUBLE_EQ(sim_time(), 3.5);
}

}  // namespace
