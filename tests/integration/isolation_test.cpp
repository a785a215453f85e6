// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Programs in a sandbox, apart from the simulation: what honest ones get, and what others do not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::expect_equal_files;
using test_support::files_of_run;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

constexpr const char* kSecret = "what nobody but the teacher knows";
constexpr const char* kMarker = "left_by_attack";

/// Whether this machine can isolate programs at all. A container may forbid it.
bool can_isolate() {
  static const bool can = playpen({"run", "default", "--isolated", "required", "--out",
                                   TemporaryFolder() / "out", "--", "/usr/bin/true"})
                              .err.find("cannot be isolated") == std::string::npos;
  return can;
}

class Isolation : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_isolate()) GTEST_SKIP() << "no program can be isolated here: see playpen doctor";
  }
  TemporaryFolder folder_;
};

// --- Honest programs

class IsolatedRuns : public Isolation {
 protected:
  void expect_same_as_together(const std::string& world, const Words& program,
                               const Words& options = {}) {
    SCOPED_TRACE(program.front());
    const auto run = [&](const std::string& level) {
      Words call = {"run", world, "--quiet", "--isolated", level, "--out", folder_ / level};
      call.insert(call.end(), options.begin(), options.end());
      call.emplace_back("--");
      call.insert(call.end(), program.begin(), program.end());
      return playpen(call);
    };
    const ProcessResult together = run("off");
    const ProcessResult apart = run("required");
    EXPECT_EQ(apart.status, together.status) << apart.err;
    EXPECT_EQ(apart.out, together.out);
    const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
    EXPECT_EQ(first_line(apart.err), first_line(together.err));
    if (!fs::exists(folder_ / "off/report.json")) {
      EXPECT_FALSE(fs::exists(folder_ / "required/report.json"));
      return;
    }
    expect_equal_files(files_of_run(folder_ / "required"), files_of_run(folder_ / "off"));
  }
};

TEST_F(IsolatedRuns, Course_SameAsTogether) {
  expect_same_as_together("par_intro", {AVOID_PROGRAM}, {"--duration", "30"});
  expect_same_as_together("par_planning", {DIJKSTRA_PROGRAM, "--goal-x=3.1", "--goal-y=3.3"});
  expect_same_as_together("par_exploration", {NEAREST_PROGRAM}, {"--duration", "10"});
}

// Grades of the course: solutions, which pass, and templates, which do not.
class IsolatedGrades : public Isolation {
 protected:
  /// grade.json without what differs, and the trajectories of its runs.
  json grade(const std::string& task, const std::string& program, const std::string& level) {
    const std::string out = folder_ / level;
    const std::string path = fs::path(AVOID_PROGRAM).parent_path() / program;
    const ProcessResult result =
        playpen({"grade", task, "--isolated", level, "--seeds", test_support::cases("1,", "3"),
                 "--timeout", "9999", "--out", out, "--", path});
    json whole = json::parse(read_bytes(out + "/grade.json"));
    EXPECT_EQ(whole.at("isolated"), level == "required");
    EXPECT_EQ(result.status == 0, whole.at("passed").get<bool>()) << result.err;
    whole.erase("isolated");
    for (json& run : whole.at("runs")) {
      run.erase("wall_time");
      run["trajectory"] =
          read_bytes(fs::path(out) / run.at("folder").get<std::string>() / "trajectory.csv");
    }
    return whole;
  }
};

TEST_F(IsolatedGrades, Course_SameAsTogether) {
  struct Case {
    const char* task;
    const char* program;
    bool passes;
  };
  const std::vector<Case> at_night = {
      {"par_intro", "par_intro_solution_avoid", true},
      {"par_intro", "par_intro_solution_wall", true},
      {"par_planning", "par_planning_solution_dijkstra", true},
      {"par_planning", "par_planning_solution_theta", true},
      {"par_planning", "par_planning_template", false},
      {"par_exploration", "par_exploration_solution_nearest", true},
      {"par_exploration", "par_exploration_solution_gain", true},
      {"par_exploration", "par_exploration_template", false},
      {"par_exploration_changing", "par_exploration_changing_solution_again", true},
      {"par_traps", "par_traps_solution_learn", true},
      {"par_chase", "par_chase_solution_patrol", true},
      {"par_chase", "par_chase_template", false},
      {"par_localization", "par_localization_solution_amcl", true},
      {"par_localization", "par_localization_solution_particles", true}};
  const std::vector<Case> on_a_merge = {{"par_traps", "par_traps_template", false},
                                        {"par_chase", "par_chase_solution_patrol", true}};
  for (const Case& one : test_support::cases(on_a_merge, at_night)) {
    SCOPED_TRACE(one.program);
    const json together = grade(one.task, one.program, "off");
    EXPECT_EQ(together.at("passed"), one.passes);
    EXPECT_TRUE(grade(one.task, one.program, "required") == together);
  }
}

TEST_F(IsolatedRuns, ProgramWithThreads_SameAsTogether) {
  expect_same_as_together("par_intro", {THREAD_PROGRAMS, "use_futures"}, {"--duration", "10"});
}

TEST_F(IsolatedRuns, OtherEnds_SameAsTogether) {
  expect_same_as_together("par_intro", {SANDBOX_ATTACKS, "crash"});
  expect_same_as_together("par_intro", {SANDBOX_ATTACKS, "never_connect"});
  expect_same_as_together("par_intro", {"sh", "-c", "exit 3"});
}

TEST_F(IsolatedRuns, Signal_EndsRunWithResults) {
  test_support::Process run(
      {PLAYPEN_COMMAND, "run", "par_intro", "--isolated", "required", "--out", folder_ / "out",
       "--", "sh", "-c", std::string(SANDBOX_ATTACKS) + " connect_only; echo ready; sleep 9999"});
  ASSERT_TRUE(run.read_until("ready"));
  run.send_signal(SIGINT);
  const ProcessResult result = run.finish();
  EXPECT_EQ(json::parse(read_bytes(folder_ / "out/report.json")).at("ended"),
            json({{"by", "request"}, {"signal", "SIGINT"}}))
      << result.err;
}

TEST_F(IsolatedRuns, ReadablePaths_VisibleToProgram) {
  const std::string named = folder_.write("named.txt", "named by an argument");
  const std::string data = folder_.write("data/more.txt", "named by an option");
  const std::string script = "cat " + data + " < \"$0\"; cat \"$0\"";
  const ProcessResult apart =
      playpen({"run", "default", "--isolated", "required", "--readable", folder_ / "data", "--out",
               folder_ / "out", "--", "sh", "-c", script, named});
  EXPECT_THAT(apart.out, AllOf(HasSubstr("named by an argument"), HasSubstr("named by an option")));
  const ProcessResult missing = playpen({"run", "default", "--isolated", "required", "--readable",
                                         folder_ / "none", "--out", folder_ / "out", "--", "true"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("--readable names '" + folder_ / "none"));
}

TEST_F(IsolatedRuns, WorldAndResults_HiddenInVisibleFolders) {
  const std::string world = folder_.write("world.json", test_support::room_world());
  static_cast<void>(folder_.write("seen.txt", "seen by the program"));
  fs::permissions(folder_.path(), fs::perms::others_read | fs::perms::others_exec,
                  fs::perm_options::add);  // if root runs the test
  const ProcessResult apart =
      playpen({"run", world, "--isolated", "required", "--readable", folder_.path(), "--out",
               folder_ / "out", "--", "sh", "-c",
               "cd " + folder_.path().string() + "; cat seen.txt world.json; ls out | wc -l"});
  EXPECT_EQ(apart.out, "seen by the program0\n");
}

TEST(IsolationLevels, WithoutBubblewrap_RequiredStopsAndBestSaysSo) {
  const TemporaryFolder folder;
  ProcessOptions options;
  options.environment["PATH"] = "/nowhere";
  const auto run = [&](const std::string& level) {
    return playpen({"run", "default", "--isolated", level, "--out", folder / "out", "--",
                    SANDBOX_ATTACKS, "connect_only"},
                   options);
  };
  const ProcessResult required = run("required");
  EXPECT_EQ(required.status, 2);
  EXPECT_THAT(required.err, AllOf(HasSubstr("cannot be isolated"), HasSubstr("bubblewrap")));
  const ProcessResult best = run("best");
  EXPECT_EQ(best.status, 0) << best.err;
  EXPECT_THAT(best.err, HasSubstr("programs are not isolated"));
  const ProcessResult wrong = run("much");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("off, best or required"));
}

// --- Attacks

/// An attack, and its run's end and reason to fail.
struct Attack {
  std::string name;
  std::string on = {};     ///< argument
  std::string fault = {};  ///< part of the reasons; "": that the robot did not drive
  bool harmless = false;   ///< whether it can also be tried without a sandbox
};

/// Others on this machine, which attacks try to reach.
class Others {
 public:
  explicit Others(const TemporaryFolder& folder) : socket_file_(folder / "others_socket") {
    port_socket_ = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    open(port_socket_, &address, sizeof address);
    socklen_t size = sizeof address;
    getsockname(port_socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    file_socket_ = socket(AF_UNIX, SOCK_STREAM, 0);
    open_named(file_socket_, socket_file_);
    abstract_socket_ = socket(AF_UNIX, SOCK_STREAM, 0);
    abstract_name_ = "@playpen_test_" + std::to_string(getpid());
    open_named(abstract_socket_, abstract_name_);
    memory_ = shmget(key(), 4096, IPC_CREAT | 0600);
    EXPECT_GE(memory_, 0);
  }
  Others(const Others&) = delete;
  Others& operator=(const Others&) = delete;
  ~Others() {
    for (const int one : {port_socket_, file_socket_, abstract_socket_}) close(one);
    shmctl(memory_, IPC_RMID, nullptr);
  }

  [[nodiscard]] std::string port() const { return std::to_string(port_); }
  [[nodiscard]] const std::string& socket_file() const { return socket_file_; }
  [[nodiscard]] const std::string& abstract_name() const { return abstract_name_; }
  [[nodiscard]] static int key() { return 0x706c0000 + getpid() % 0x10000; }

 private:
  template <typename Address>
  static void open(int one, const Address* address, socklen_t size) {
    EXPECT_EQ(bind(one, reinterpret_cast<const sockaddr*>(address), size), 0);
    EXPECT_EQ(listen(one, 4), 0);
  }
  static void open_named(int one, const std::string& name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name.front() == '@') address.sun_path[0] = '\0';
    open(one, &address, static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size()));
  }

  int port_socket_ = -1;
  int port_ = 0;
  int file_socket_ = -1;
  int abstract_socket_ = -1;
  std::string socket_file_;
  std::string abstract_name_;
  int memory_ = -1;
};

/// A class: a program of one student attacks, and there is a secret of the teacher, a submission of
/// another student, and the results.
class SandboxAttacks : public Isolation {
 protected:
  void SetUp() override {
    Isolation::SetUp();
    secret_ = folder_.write("teacher/secret.txt", kSecret);
    other_ = folder_.write("submissions/alice/robot.cpp", kSecret);
    fs::create_directories(folder_ / "submissions/mallory");
    fs::copy_file(SANDBOX_ATTACKS, folder_ / "submissions/mallory/robot");
    program_ = folder_ / "submissions/mallory/robot";
    scratch_ = folder_ / "scratch";
    fs::create_directories(scratch_);
  }

  /// A task with a world for each attack, called after it, and an honest program at both ends.
  void write_task(const std::vector<Attack>& attacks, double timeout_s) {
    const std::string world = R"({"arena": {"size": [4.0, 2.0]}, "simulation": {"duration": 5},
      "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 1.0}, "devices": {"laser": {}}}]})";
    json task = {{"may_use", {{"robots", {"r1"}}, {"world", json::array()}}},
                 {"seeds", json::array({1})},
                 {"timeout", timeout_s},
                 {"thresholds", {{"min_distance", 0.5}, {"max_collisions", 0}}}};
    std::vector<Attack> all = attacks;
    all.insert(all.begin(), {"drive"});
    all.push_back({"drive"});
    for (std::size_t i = 0; i < all.size(); ++i) {
      names_.push_back(std::to_string(i) + '_' + all[i].name);
      folder_.write("task/" + names_.back() + ".json", world);
      task["worlds"].push_back(
          {{"world", names_.back() + ".json"}, {"arguments", {all[i].name, "on=" + all[i].on}}});
    }
    task_ = folder_.write("task/attacks.task.json", task.dump());
  }

  ProcessResult grade(const std::string& level) {
    ProcessOptions options;
    options.environment["ATTACK_SECRET"] = kSecret;
    options.environment["HOME"] = folder_.path();
    options.environment["TMPDIR"] = scratch_;  // other tests have files of theirs in the common one
    options.folder = folder_.path();
    ProcessResult result = playpen({"grade", task_, "--isolated", level, "--jobs", "2", "--out",
                                    folder_ / "results", "--", program_},
                                   options);
    runs_ = json::parse(read_bytes(folder_ / "results/grade.json")).at("runs");
    return result;
  }

  [[nodiscard]] std::string log_of(const json& run) const {
    return read_bytes(fs::path(folder_ / "results") / run.at("folder").get<std::string>() /
                      "program.log");
  }

  /// Checks the whole table: the honest program passes, the attacks fail and reach nothing.
  void expect_held(const std::vector<Attack>& attacks, double timeout_s) {
    write_task(attacks, timeout_s);
    const ProcessResult result = grade("required");
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_THAT(result.out + result.err, Not(HasSubstr("\033")));
    ASSERT_EQ(runs_.size(), attacks.size() + 2);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      SCOPED_TRACE(runs_[i].at("world").dump() + runs_[i].at("faults").dump());
      EXPECT_EQ(runs_[i].at("world"), names_[i]);
      const bool honest = i == 0 || i + 1 == runs_.size();
      EXPECT_EQ(runs_[i].at("passed"), honest);
      const std::string log = log_of(runs_[i]);
      EXPECT_THAT(log, AllOf(Not(HasSubstr("BROKEN OUT")), Not(HasSubstr(kSecret)))) << log;
      if (honest) continue;
      const std::string& fault = attacks[i - 1].fault;
      EXPECT_THAT(runs_[i].at("faults").dump(), HasSubstr(fault.empty() ? "distance" : fault))
          << log;
    }
    expect_nothing_left();
  }

  void expect_nothing_left() const {
    EXPECT_EQ(read_bytes(secret_), kSecret);
    EXPECT_EQ(read_bytes(other_), kSecret);
    EXPECT_EQ(entries(folder_ / "teacher").size(), 1U);
    EXPECT_EQ(entries(folder_ / "submissions/mallory"), std::set<fs::path>{program_});
    for (const fs::path& path : entries(folder_ / "results")) {
      EXPECT_THAT(path.filename().string(), Not(testing::StartsWith(".running")));
    }
    EXPECT_EQ(entries(scratch_), std::set<fs::path>{});
    for (const fs::path& path : entries("/proc")) {
      std::ifstream stream(path / "comm");
      std::string name;
      EXPECT_FALSE(std::getline(stream, name) && name == kMarker) << path;
    }
  }

  static std::set<fs::path> entries(const fs::path& folder) {
    std::set<fs::path> all;
    for (const auto& entry : fs::directory_iterator(folder)) all.insert(entry.path());
    return all;
  }

  std::string secret_;
  std::string other_;
  std::string program_;
  std::string scratch_;  ///< folder for temporary files
  std::string task_;
  std::vector<std::string> names_;
  json runs_;
};

TEST_F(SandboxAttacks, FilesOfOthers_NeitherReadNorWritten) {
  expect_held({{"read", secret_},
               {"read", other_},
               {"read", folder_ / "submissions/alice"},
               {"read", folder_ / "task"},
               {"read", folder_ / "results"},
               {"read", "/etc/passwd"},
               {"read", "/root"},
               {"read", "/home"},
               {"read", "/proc/1/environ"},
               {"write", secret_},
               {"write", other_},
               {"write", folder_ / "results/grade.json"},
               {"write", "/usr/lib/planted"},
               {"write_through_link", secret_},
               {"write_through_link", folder_ / "results/grade.json"},
               {"change_own_program"},
               {"forge_report", "", "report"},
               {"fill_disks", "", "report"},
               {"open_devices"}},
              9999);
}

TEST_F(SandboxAttacks, ProcessesAndKernel_OutOfReach) {
  expect_held({{"find_descriptors"},
               {"read_environments"},
               {"look_at_processes"},
               {"trace_parent"},
               {"kill_all", "", "report"},
               {"leave_processes", kMarker, "report"},
               {"gain_rights"},
               {"make_namespaces"},
               {"use_large_calls"},
               {"use_other_machine"},
               {"type_into_terminal"},
               {"change_clock"}},
              9999);
}

TEST_F(SandboxAttacks, OthersOnTheMachine_OutOfReach) {
  const Others others(folder_);
  const std::vector<Attack> attacks = {{"connect_to_port", others.port()},
                                       {"connect_to_socket", others.socket_file()},
                                       {"connect_to_socket", others.abstract_name()},
                                       {"find_shared_memory", std::to_string(Others::key())}};
  expect_held(attacks, 9999);
}

TEST_F(SandboxAttacks, Simulation_GivesWhatTaskGrants) {
  expect_held({{"true_pose", "", "asked for poses"},
               {"move_robot", "", "asked for poses"},
               {"ask_for_map", "", "asked for the map"},
               {"ask_as_morse"},
               {"quit_simulation"},
               {"other_world", "", "report"},
               {"other_environment", "", "report"},
               {"never_connect", "", "report"},
               {"connect_only", "", "never stepped"},
               {"send_noise"},
               {"send_without_end"},
               {"hold_connections", "", "never stepped"},
               {"sleep_beside_the_library"},
               {"crash", "", "signal 6"},
               {"print_escapes"}},
              9999);
}

TEST_F(SandboxAttacks, Bombs_EndThemselvesOnly) {
  expect_held({{"fork_bomb", "", "signal 9"},
               {"thread_bomb", "", "report"},
               {"memory_bomb", "", "signal 9"}},
              9999);
}

TEST_F(SandboxAttacks, ProgramsWithoutEnd_EndAtTimeLimit) {
  // The honest program, which has the same limit, is not checked here.
  write_task({{"hang"}, {"compute"}, {"print_for_ever"}, {"ignore_signals"}, {"stop_parents"}}, 3);
  static_cast<void>(grade("required"));
  for (std::size_t i = 1; i + 1 < runs_.size(); ++i) {
    EXPECT_EQ(runs_[i].at("passed"), false) << runs_[i];
    EXPECT_THAT(runs_[i].at("end").at("kind"), testing::AnyOf("timeout", "signal")) << runs_[i];
    EXPECT_LT(log_of(runs_[i]).size(), 11'000'000U);
  }
}

// Attacks that do reach something without a sandbox: so it is the sandbox that stops them.
TEST_F(SandboxAttacks, WithoutSandbox_TheyReachSomething) {
  const Others others(folder_);
  write_task({{"read", secret_},
              {"read", folder_ / "task"},
              {"read", "/etc/passwd"},
              {"write", folder_ / "teacher/planted"},
              {"write_through_link", folder_ / "teacher/planted"},
              {"read_environments"},
              {"look_at_processes"},
              {"find_descriptors"},
              {"connect_to_port", others.port()},
              {"connect_to_socket", others.socket_file()},
              {"connect_to_socket", others.abstract_name()},
              {"find_shared_memory", std::to_string(Others::key())}},
             9999);
  static_cast<void>(grade("off"));
  for (std::size_t i = 1; i + 1 < runs_.size(); ++i) {
    EXPECT_THAT(log_of(runs_[i]), HasSubstr("BROKEN OUT")) << runs_[i];
  }
}

}  // namespace
