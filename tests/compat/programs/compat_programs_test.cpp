// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Client programs in the styles of those out there, unchanged, each in a world that suits it: they
// end, and the robots have done what the programs meant and stood against nothing for long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
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
using test_support::address_of;
using test_support::nightly;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessResult;
using test_support::read_report;
using test_support::run_process;
using test_support::TemporaryFolder;
using test_support::without_wall_time;
using testing::HasSubstr;
using testing::Not;

constexpr double kAny = 1e9;

/// A program, where it runs, and what it must have done then.
struct Case {
  std::string program;
  std::string world;                     ///< below worlds/
  std::vector<std::string> says;         ///< parts of what it prints
  double least_path_m = 0.0;             ///< of the first robot
  double most_path_m = kAny;             ///< of the first robot
  int most_collisions = 0;               ///< of all robots
  int moving_robots = 1;                 ///< so many have driven at least 0.1 m
  std::vector<std::string> arguments{};  ///< of the program
  std::string duration_s = "60";         ///< simulated
};

// For the names of the tests.
void PrintTo(const Case& c, std::ostream* os) { *os << c.program << " in " << c.world; }

const std::string kPioneer = "examples/pioneer.json";
const std::string kCave = "cave.json";
const std::string kOffice = "office.json";
const std::string kMaze = "examples/roomba_maze.json";

std::vector<Case> cases() {
  return {
      {"arena_gate",
       "examples/living_arena.json",
       {"2 configurations, the last is open", "did you mean \"open\"?", "gate: sinking",
        "gate: 0 m high", "1.6 retracted gate", "trap goal", "10 points",
        "verdict: the runner is at the goal"},
       2.7,
       3.0},
      {"arm_waves",
       "examples/pioneer_arm.json",
       {"6 joints", "joint 5: linear, 0.02 m, from 0.00 to 0.06", "reached it", "stalled at 2.09",
        "braked 1", "home again"},
       0.5},
      {"background_thread", kCave, {"ended at"}, 1.5},
      {"bigbob_collects",
       "examples/bigbob.json",
       {"4 sonars, 180 beams", "between the teeth: orange1", "orange2 is at -10 -10"},
       5.0},
      {"bigbob_pair",
       "examples/bigbob_pair.json",
       {"puck4 is at -1.5 -6.2", "puck1 moved to 6.0 -6.5", "3 rays, 180 beams"},
       5.0,
       kAny,
       2,  // bob2 touches a puck
       2},
      {"blackboard", kCave, {"at first 0 bytes", "places heard, looks at it"}, 2.0},
      {"blob_chase", kPioneer, {"of 80x60 reached", "#2040e0"}, 0.5, 3.0},
      {"bumper_maze", kPioneer, {"10 bumpers", "bumped"}, 2.0, kAny, 50},
      {"can_collector", "examples/pioneer_gripper.json", {"can 1", "2 cans in the store"}, 4.0},
      {"carlike", "examples/car.json", {"turned"}, 4.5, 5.0},
      {"epuck_lights", "examples/epuck.json", {"5 of 8 lights shone"}, 1.5},
      {"exceptions", kCave, {"robot on port 6665", "no arm", "ended:"}, 5.0, 6.1},
      {"fiducial_chase", kPioneer, {"reached fiducial"}, 0.2},
      {"four_ports", kCave, {"robot 3"}, 1.0, kAny, 0, 4},
      {"globals", kCave, {"after main"}, 1.0},
      {"goto_goal", kPioneer, {"3 goals reached"}, 2.5, 5.0},
      {"infrared", "examples/epuck.json", {"8 sensors", "highest voltage"}, 0.5},
      {"infrared", kOffice, {"8 sensors", "highest voltage"}, 2.0},
      {"infrared", "examples/s1r_full.json", {"8 sensors", "highest voltage"}, 2.0},
      {"instruments", kOffice, {"charge"}, 1.8, 2.2},
      {"logger", kPioneer, {"position2d:0", "laser:0"}, 1.8, 2.2, 0, 1, {"log.txt"}},
      {"map_reader", kOffice, {"occupied", "#"}, 0.0, 0.01, 0, 0},
      {"never_deleted", kPioneer, {"stopped at"}, 0.3},
      {"one_port",
       "examples/one_port.json",
       {"robot 12: ", "13 of 13 robots drove", ", 16 sonars"},
       8.0,
       kAny,
       0,
       13},
      {"omnidirectional", "examples/omni.json", {"to the left"}, 0.7, 1.5},
      {"own_goto", kPioneer, {"distance left 0.0"}, 1.4, 2.5},
      {"own_proxy", kPioneer, {"50 scans"}, 0.0, 0.01, 0, 0},
      {"posix_threads", kCave, {"nearest"}, 0.5},
      {"past_the_end", kCave, {"sonar 99 reads -1", "nothing was thrown"}, 3.0},
      {"potential_field", kCave, {}, 2.0},
      {"read_signals", kCave, {"150 poses"}, 1.0},
      {"roomba_blobs", "examples/roomba_room.json", {"bumped into red, seen often"}, 4.0, 9.0, 1},
      {"roomba_goal",
       "examples/roomba_room.json",
       {"361 beams; I am at (-5.", "odometry says (0.0", "at the goal"},
       11.0,
       13.0},
      {"roomba_maze", kMaze, {"out of the maze", "straight ahead"}, 60.0, 110.0, 60, 1, {}, "400"},
      {"scorpion_wander",
       "examples/scorpion.json",
       {"13 infra-reds", "left one looks to 90 degrees"},
       8.0},
      {"simulation", kPioneer, {"moved by 0.3", "nobody is at 42"}, 0.1, kAny, 0, 1, {"pioneer1"}},
      {"speaking", kPioneer, {"inputs"}, 1.8, 2.2},
      {"sonar_ranger",
       "examples/stage_simple.json",
       {"16 sonars, 361 beams, start at -7 -7"},
       10.0},
      {"square_by_odometry", kPioneer, {"closed within 0.0"}, 3.9, 4.4},
      {"square_by_odometry", "examples/open_field.json", {"closed within 0.0"}, 3.9, 4.4},
      {"square_counting_turns", kPioneer, {"at "}, 3.8, 4.2},
      {"square_of_two_metres",
       "examples/open_field.json",
       {"straight on: 5 m", "square closed"},
       17.9,
       18.1},
      {"square_sleeping", kPioneer, {}, 3.9, 4.1},
      {"standard_threads", kCave, {}, 0.5, kAny, 0, 2},
      {"three_sonars", "examples/s1r_sonar.json", {"3 sonars"}, 6.0},
      {"two_clients_one_port", kCave, {"way "}, 1.0},
      {"urg_wander", "examples/pioneer_urg.json", {"667 beams from -120 to 120"}, 12.0},
      {"urg_wander", "syrotek.json", {"682 beams from -134.8"}, 4.0},
      {"urg_wander", "examples/s1r_full.json", {"682 beams from -134.8"}, 4.0},
      {"wall_clock", kPioneer, {"took 1.0"}, 0.8, 1.1},
      {"wall_follow", kOffice, {}, 8.0},
      {"wander_laser", kCave, {"#PlayerClient"}, 4.0},
      {"wander_ranger", kCave, {"ranges: ", "max 8"}, 8.0},
      {"wander_ranger", "examples/pioneer_laser.json", {"ranges: 361 from -90 to 90"}, 8.0},
      {"wander_sonar", kCave, {}, 2.0},
  };
}

/// Whether this is the first world of its program.
bool crosses_networks(const Case& c) {
  const std::vector<Case> all = cases();
  const auto first = std::find_if(all.begin(), all.end(),
                                  [&c](const Case& other) { return other.program == c.program; });
  return first->world == c.world;
}

/// Expects that a program has done what it was written for.
void expect_outcome(const Case& c, const ProcessResult& result, const json& report) {
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  for (const std::string& part : c.says) EXPECT_THAT(result.out, HasSubstr(part)) << result.err;
  const json& robots = report.at("robots");
  EXPECT_GE(robots[0].at("path_length"), c.least_path_m) << result.out << result.err;
  EXPECT_LE(robots[0].at("path_length"), c.most_path_m) << result.out << result.err;
  int collisions = 0;
  int moving = 0;
  for (const json& robot : robots) {
    collisions += robot.at("collisions").get<int>();
    if (robot.at("path_length") >= 0.1) ++moving;
    EXPECT_LE(robot.at("stalled_time"), 0.1 * report.at("run").at("sim_time").get<double>())
        << robot.at("name") << " stood against something\n"
        << result.out << result.err;
  }
  EXPECT_LE(collisions, c.most_collisions) << result.out << result.err;
  EXPECT_EQ(moving, c.moving_robots) << result.out << result.err;
}

/// How a run across a network compares with one in the program's own process.
enum class Network {
  kEqual,      ///< in lockstep: equal output and report
  kOwnOutput,  ///< in lockstep: equal report, other output
  kOutcome,    ///< in lockstep: does what it was written for
  kRealTime,   ///< runs with a paced server, see SleepingPrograms
  kNone,       ///< cannot run
};
struct Difference {
  Network network = Network::kEqual;
  std::string why;
};
using Differences = std::map<std::string, Difference>;

/// Programs that differ over all protocols.
const Differences& differences() {
  static const std::string sleeps = "its sleeps and clocks follow the wall clock";
  static const Differences known = {
      {"background_thread", {Network::kRealTime, sleeps}},
      {"bumper_maze", {Network::kRealTime, sleeps}},
      {"posix_threads", {Network::kRealTime, sleeps}},
      {"square_sleeping", {Network::kRealTime, sleeps}},
      {"standard_threads", {Network::kRealTime, sleeps}},
      {"wall_clock", {Network::kRealTime, sleeps}},
  };
  return known;
}

/// Further programs that differ over Player's protocol.
const Differences& player_differences() {
  static const std::string precision = "ranges have single precision";
  static const Differences known = {
      {"arena_gate", {Network::kNone, "Player has no interface for arenas"}},
      {"exceptions", {Network::kOwnOutput, "it prints errors, which name the server"}},
      {"infrared", {Network::kOutcome, "ranges and voltages have single precision"}},
      {"logger", {Network::kOwnOutput, "it prints the names of devices and drivers"}},
      {"own_goto",
       {Network::kOutcome, "it peeks, which requests the next data already, as in Player"}},
      {"past_the_end", {Network::kOutcome, precision}},
      {"potential_field", {Network::kOutcome, precision}},
      {"scorpion_wander", {Network::kOutcome, precision}},
      {"three_sonars", {Network::kOutcome, precision}},
      {"wander_laser", {Network::kOwnOutput, "it prints the name of the client"}},
      {"wander_sonar", {Network::kOutcome, precision}},
  };
  return known;
}

Network network_of(const Case& c, const Differences& further = {}) {
  for (const Differences* list : {&further, &differences()}) {
    if (const auto it = list->find(c.program); it != list->end()) return it->second.network;
  }
  return Network::kEqual;
}

/// A folder for the files of a program's run, and how to start it there.
class ProgramRun {
 public:
  explicit ProgramRun(Case what) : case_(std::move(what)) {}

  [[nodiscard]] const Case& what() const { return case_; }
  /// `playpen run WORLD -- PROGRAM`.
  [[nodiscard]] ProcessResult embedded() const {
    std::vector<std::string> call = {"run",        world(),          "--out",   out(),
                                     "--duration", case_.duration_s, "--quiet", "--"};
    const std::vector<std::string> words = program();
    call.insert(call.end(), words.begin(), words.end());
    return playpen(call, in_folder());
  }
  /// `playpen serve WORLD --time TIME OPTIONS`.
  [[nodiscard]] std::unique_ptr<Process> server(const std::string& time,
                                                const std::vector<std::string>& options) const {
    std::vector<std::string> call = {
        PLAYPEN_COMMAND,  "serve",  world(), "--out",      out(), "--duration",
        case_.duration_s, "--time", time,    "--tcp-port", "0",   "--quiet"};
    call.insert(call.end(), options.begin(), options.end());
    return std::make_unique<Process>(call);
  }
  /// The program, whose PLAYPEN_WORLD is a server's address.
  [[nodiscard]] std::unique_ptr<Process> client(const std::string& address) const {
    test_support::ProcessOptions options = in_folder();
    options.environment["PLAYPEN_WORLD"] = address;
    return std::make_unique<Process>(program(), options);
  }
  [[nodiscard]] json report() const { return read_report(out()); }

 private:
  [[nodiscard]] std::string out() const { return folder_ / "out"; }
  [[nodiscard]] std::string world() const { return PLAYPEN_SOURCE_DIR "/worlds/" + case_.world; }
  [[nodiscard]] std::vector<std::string> program() const {
    std::vector<std::string> words = {PROGRAMS + case_.program};
    words.insert(words.end(), case_.arguments.begin(), case_.arguments.end());
    return words;
  }
  [[nodiscard]] test_support::ProcessOptions in_folder() const {
    test_support::ProcessOptions options;
    options.folder = folder_.path();
    return options;
  }

  const Case case_;
  const TemporaryFolder folder_;
};

/// A server and its address.
struct Served {
  std::unique_ptr<Process> server;
  std::string address;  ///< for PLAYPEN_WORLD
};

Served serve_own(const ProgramRun& run, const std::string& time) {
  Served served{run.server(time, {}), ""};
  served.address = address_of(*served.server);
  return served;
}

/// Serves Player's protocol. The ports of robots must follow one another, as programs for several
/// robots expect, and others may have them.
Served serve_player(const ProgramRun& run, const std::string& time) {
  static int attempts = 0;
  for (int i = 0; i < 50; ++i) {
    const int first = 20'000 + (getpid() * 101 + attempts++ * 1009) % 30'000;
    Served served{run.server(time, {"--player-port", std::to_string(first)}),
                  "player://127.0.0.1:" + std::to_string(first)};
    if (served.server->read_until("listening on ") && served.server->read_until("\n")) {
      return served;
    }
  }
  return {};
}

/// Ends a server. A program may end before its run does.
void end_server(Process& server) {
  server.send_signal(SIGTERM);
  const ProcessResult end = server.finish();
  EXPECT_EQ(end.status, 0) << end.err;
}

class CompatPrograms : public testing::TestWithParam<Case> {
 protected:
  using Serve = Served (*)(const ProgramRun&, const std::string&);

  /// The report of the run, as far as a run across a network repeats it: the server ends after its
  /// client.
  [[nodiscard]] static json repeatable(const json& report) {
    json part = without_wall_time(report);
    part.erase("ended");
    return part;
  }

  /// Runs the program with a server in lockstep and compares with the run in its own process.
  void expect_across_a_network(Serve serve, Network network) const {
    if (network == Network::kNone || network == Network::kRealTime) return;
    const ProgramRun run(GetParam());
    const Served served = serve(run, "lockstep");
    ASSERT_NE(served.server, nullptr);
    ProcessResult there = run.client(served.address)->finish();
    end_server(*served.server);
    ASSERT_FALSE(there.timed_out) << there.out << there.err;
    const json report = repeatable(run.report());
    // At the end of a run the server closes the connections. Player's clients cannot tell that from
    // a lost connection: those that do not expect it end with an exception.
    if (serve == serve_player && there.status != 0) {
      EXPECT_THAT(there.err, HasSubstr("has closed the connection"));
      EXPECT_EQ(report.at("run").at("sim_time"), report_.at("run").at("sim_time"));
      there.status = 0;
      there.out = here_.out;
    }
    expect_outcome(run.what(), there, run.report());
    if (network == Network::kOutcome) return;
    if (network == Network::kEqual) {
      EXPECT_EQ(there.out, here_.out) << there.err;
    }
    EXPECT_EQ(report.dump(1), report_.dump(1)) << there.err;
  }

  ProcessResult here_;  ///< of the run in the program's own process
  json report_;         ///< of that run
};

// A program that runs in several worlds crosses the network only in the first of them on a merge.
TEST_P(CompatPrograms, PassInLockstep) {
  const Case& c = GetParam();
  const ProgramRun run(c);
  here_ = run.embedded();
  ASSERT_FALSE(here_.timed_out) << here_.out << here_.err;
  if (c.program == "two_clients_one_port") {
    for (const char* host : {"\"192.0.2.17\"", "\"robot-lab\""}) {
      EXPECT_THAT(here_.err, HasSubstr(host));
    }
  }
  expect_outcome(c, here_, run.report());
  if (HasFailure() || !(nightly() || crosses_networks(c))) return;
  report_ = repeatable(run.report());
  {
    SCOPED_TRACE("over Playpen's protocol");
    expect_across_a_network(serve_own, network_of(c));
  }
  SCOPED_TRACE("over Player's protocol");
  expect_across_a_network(serve_player, network_of(c, player_differences()));
}

/// Programs whose sleeps, clocks and threads follow the wall clock, with servers whose simulations
/// do, too. All run at the same time. Their bounds leave room for a busy machine: a sleep that ends
/// late makes a way longer, a late command may make it shorter. On a merge, every other program
/// runs over Playpen's protocol and the rest over Player's.
TEST(SleepingPrograms, RealTime_Pass) {
  const std::vector<Case> sleeping = {
      {"background_thread", kCave, {"ended at"}, 1.5},
      {"bumper_maze", kPioneer, {"10 bumpers"}, 2.0, kAny, 50},
      {"posix_threads", kCave, {"nearest"}, 0.5},
      {"square_sleeping", kPioneer, {}, 3.0, 6.0},
      {"standard_threads", kCave, {}, 0.5, kAny, 0, 2},
      {"wall_clock", kPioneer, {"took "}, 0.5, 2.0},
  };
  struct Running {
    std::unique_ptr<ProgramRun> run;
    Served served;
    std::unique_ptr<Process> client;
    const char* protocol;
  };
  std::vector<Running> all;
  for (std::size_t i = 0; i < sleeping.size(); ++i) {
    const Case& c = sleeping[i];
    EXPECT_EQ(network_of(c), Network::kRealTime) << c.program;
    for (const bool own : {true, false}) {
      if (!nightly() && own != (i % 2 == 0)) continue;
      Running one{std::make_unique<ProgramRun>(c), {}, nullptr, own ? "Playpen's" : "Player's"};
      one.served = own ? serve_own(*one.run, "real") : serve_player(*one.run, "real");
      ASSERT_NE(one.served.server, nullptr);
      one.client = one.run->client(one.served.address);
      all.push_back(std::move(one));
    }
  }
  EXPECT_EQ(sleeping.size(), differences().size());
  for (Running& one : all) {
    SCOPED_TRACE(one.run->what().program + " over " + one.protocol + " protocol");
    const ProcessResult result = one.client->finish();
    end_server(*one.served.server);
    expect_outcome(one.run->what(), result, one.run->report());
  }
}

// Runs a program in a world for which it was not written.
TEST(StalledProgram, Message_NamesPageOfWorlds) {
  const TemporaryFolder folder;
  const ProcessResult result = playpen(
      {"run", "cave", "--out", folder / "out", "--duration", "60", "--", PROGRAMS "push_wall"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, testing::ContainsRegex("\npioneer1 was stalled for [5-9][0-9] % of the "
                                                 "time that it drove: 'playpen doc which_world'"));
  EXPECT_THAT(result.out, Not(HasSubstr("pioneer2 was")));
  const json report = read_report(folder / "out");
  const json& robot = report.at("robots")[0];
  EXPECT_NEAR(robot.at("driven_time"), 28.9, 0.2);
  EXPECT_GT(robot.at("stalled_time"), 0.5 * robot.at("driven_time").get<double>());
  EXPECT_EQ(report.at("robots")[1].at("driven_time"), 0.0);
}

TEST(InterfacesOfARun, MatchCommandLine) {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> options) {
    std::vector<std::string> call = {"run",          "pioneer_laser", "--out",
                                     folder / "out", "--duration",    "20"};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", PROGRAMS "sonar_ranger"});
    return playpen(call);
  };
  EXPECT_THAT(run({}).out, Not(HasSubstr("16 sonars")));
  const ProcessResult chosen = run({"--interface", "ranger:0=sonar"});
  EXPECT_EQ(chosen.status, 0) << chosen.err;
  EXPECT_THAT(chosen.out, HasSubstr("16 sonars, 361 beams"));
  EXPECT_THAT(run({"--interface", "ranger:1=laser", "--interface", "ranger:0=sonar"}).out,
              HasSubstr("16 sonars, 361 beams"));
  const ProcessResult wrong = run({"--interface", "ranger:0=radar"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--interface ranger:0=radar: expected a device with the "
                                   "interface ranger of a robot of this world: laser, sonar"));
}

// Pictures and films need OpenCV, which brings 250 libraries along: only who draws loads it.
TEST(PlainClient, LoadsAtMost15LibrariesAndNoGraphics) {
  const ProcessResult result = run_process({PROGRAMS "loaded_libraries"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("opencv")));
  const std::size_t at = result.out.rfind("libraries ");
  ASSERT_NE(at, std::string::npos) << result.out;
  EXPECT_LE(std::stoi(result.out.substr(at + 10)), 15) << result.out;
}

INSTANTIATE_TEST_SUITE_P(Programs, CompatPrograms, testing::ValuesIn(cases()), [](const auto& one) {
  return one.param.program + "_in_" + fs::path(one.param.world).stem().string();
});

}  // namespace
