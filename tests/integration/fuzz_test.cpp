// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen fuzz` with the course's solutions and with planted faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class PlaypenFuzz : public testing::Test {
 protected:
  [[nodiscard]] ProcessResult fuzz(const Words& options,
                                   const std::string& program = AVOID_PROGRAM) const {
    Words call = {"fuzz", "par_intro", "--runs", "32", "--most", "1"};
    if (options.front() != "--without") call.insert(call.end(), {"--without", "moving,noise"});
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", program});
    return playpen(call);
  }
  // The world of the first finding without its comment, which names its file.
  [[nodiscard]] static std::string world_in(const std::string& folder) {
    const std::string text = read_bytes(fs::path(folder) / "1.json");
    return text.substr(text.find("\n{"));
  }

  const TemporaryFolder folder_;
};

TEST_F(PlaypenFuzz, Finding_IsSimpleAndHappensAgain) {
  const std::string out = folder_ / "out";
  const ProcessResult result =
      fuzz({"--out", out, "--keep", folder_ / "kept", "--look-for", "collision"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1. found after"), HasSubstr("collision: r1 hits ")));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("did not happen again")));
  EXPECT_TRUE(fs::exists(fs::path(out) / "1/scene.png"));
  EXPECT_THAT(read_bytes(fs::path(out) / "1.json"), HasSubstr("// Again: playpen run"));
  const ProcessResult again =
      playpen({"run", out + "/1.json", "--duration", "30", "--out", folder_ / "again", "--expect",
               "r1.collisions == 0", "--", AVOID_PROGRAM});
  EXPECT_EQ(again.status, 1);
  EXPECT_THAT(again.err, HasSubstr("expected r1.collisions == 0, but r1 has"));
  const std::string kept = read_bytes(folder_ / "kept/found.cmake");
  EXPECT_THAT(kept, AllOf(HasSubstr("playpen_add_test(NAME par_intro_collision_1"),
                          HasSubstr("EXPECT \"r1.collisions == 0\"")));
  EXPECT_TRUE(fs::exists(folder_ / "kept/par_intro_collision_1.json"));
}

// Obstacles that a scenario has added.
std::ptrdiff_t added_to(const std::string& world_file) {
  const auto world = nlohmann::json::parse(read_bytes(world_file), nullptr, true, true);
  const nlohmann::json list = world["arena"].value("obstacles", nlohmann::json::array());
  return std::ranges::count_if(list, [](const nlohmann::json& one) {
    return one["name"].get<std::string>().starts_with("found");
  });
}

// The call in the comment of a world, run in a shell as a user does.
ProcessResult again(const std::string& world_file, const std::string& out) {
  const std::string world = read_bytes(world_file);
  const std::string begin = "// Again: playpen run ";
  const std::size_t at = world.find(begin);
  if (at == std::string::npos) return {};
  const std::size_t arguments = at + begin.size();
  return test_support::run_process(
      {"/bin/sh", "-c",
       std::string("exec '") + PLAYPEN_COMMAND + "' run --out '" + out + "' " +
           world.substr(arguments, world.find('\n', arguments) - arguments)});
}

struct Planted {
  const char* name;
  const char* program;
  const char* fault;
  const char* kind;
  int again_status;  ///< a program that stays somewhere ends well
};

class PlantedFault : public testing::TestWithParam<Planted> {};

TEST_P(PlantedFault, Search_FindsSmallWorldThatRepeatsIt) {
  const Planted& planted = GetParam();
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const ProcessResult result =
      playpen({"fuzz", "par_intro", "--runs", "32", "--most", "1", "--without", "moving,noise",
               "--out", out, "--", planted.program, planted.fault});
  ASSERT_EQ(result.status, 1) << result.out << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("1. found after "), HasSubstr(std::string(planted.kind) + ": r1 "),
                    testing::Not(HasSubstr("did not happen again"))));
  EXPECT_LE(added_to(out + "/1.json"), 3);
  EXPECT_EQ(again(out + "/1.json", folder / "again").status, planted.again_status)
      << read_bytes(out + "/1.json");
}

INSTANTIATE_TEST_SUITE_P(
    Faults, PlantedFault,
    testing::Values(Planted{"roamer_looks_ahead_only", ROAMER_PROGRAM, "narrow", "collision", 1},
                    Planted{"roamer_oscillates", ROAMER_PROGRAM, "oscillates", "stuck", 0},
                    Planted{"wall_follower_is_late", PLANTED_WALL_PROGRAM, "stale", "collision",
                            1}),
    [](const auto& one) { return std::string(one.param.name); });

TEST_F(PlaypenFuzz, ProgramHangs_ItsResultsAreThoseUntilTheLimit) {
  const std::string out = folder_ / "out";
  const ProcessResult result = playpen({"fuzz", "par_intro", "--runs", "1", "--timeout", "1",
                                        "--out", out, "--", ENDS_PROGRAM, "compute"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1. found after"), HasSubstr("and 1 runs, hang: r1 "),
                                HasSubstr("again: timeout 1 playpen run "),
                                testing::Not(HasSubstr("did not happen again"))));
  EXPECT_TRUE(fs::exists(fs::path(out) / "1/scene.png"));
}

// A search whose program computes for ever, after it has begun. Its processes inherit the test's
// pipes, so the test notices if one of them is left.
class InterruptedSearch {
 public:
  explicit InterruptedSearch(const std::string& out)
      : search_({PLAYPEN_COMMAND, "fuzz", "par_intro", "--runs", "1000", "--timeout", "1000",
                 "--jobs", "2", "--out", out, "--", ENDS_PROGRAM, "compute", "0"}) {
    while (!fs::exists(out)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  [[nodiscard]] ProcessResult end_by(int signal) {
    search_.send_signal(signal);
    return search_.finish();
  }

 private:
  test_support::Process search_;
};

TEST_F(PlaypenFuzz, Interrupted_ReportsAndLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const ProcessResult result = InterruptedSearch(folder_ / std::to_string(signal)).end_by(signal);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_THAT(result.out, HasSubstr("interrupted, nothing found: 0 runs"));
  }
}

TEST_F(PlaypenFuzz, Killed_LeavesNoProcess) {
  const ProcessResult result = InterruptedSearch(folder_ / "out").end_by(SIGKILL);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, SIGKILL);
}

TEST_F(PlaypenFuzz, FolderToKeepCannotBeMade_StatusTwoBeforeTheSearch) {
  const std::string file = folder_ / "file";
  std::ofstream(file) << "no folder";
  const ProcessResult result = fuzz({"--out", folder_ / "out", "--keep", file + "/kept"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr(file));
}

TEST_F(PlaypenFuzz, ProgramWithoutFault_NothingFound) {
  const ProcessResult result = playpen({"fuzz", "par_intro", "--runs", "64", "--without", "moving",
                                        "--out", folder_ / "out", "--", ROAMER_PROGRAM, "none"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("nothing found: "));
}

TEST_F(PlaypenFuzz, NumberOfJobs_DoesNotChangeFindings) {
  for (const char* const jobs : {"1", "3"}) {
    EXPECT_EQ(fuzz({"--jobs", jobs, "--out", folder_ / jobs}).status, 1);
  }
  EXPECT_EQ(world_in(folder_ / "1"), world_in(folder_ / "3"));
}

TEST_F(PlaypenFuzz, NothingFound_StatusZero) {
  const ProcessResult result =
      fuzz({"--out", folder_ / "out", "--look-for", "crash,hang", "--duration", "5"});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("nothing found: 32 runs"));
}

TEST_F(PlaypenFuzz, Faults_AreInTheWorldThatIsFound) {
  // An avoider of obstacles whose laser is blind drives against the wall.
  const std::string world = folder_ / "room.json";
  std::ofstream(world) << R"({"arena": {"size": [3, 3]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 1.5}, "devices": {"laser": {}}}],
      "fuzz": {"without": ["starts", "obstacles", "moving", "maps", "noise"],
               "with": ["faults"], "faults": {"kinds": ["blind"], "at": [1, 5]}}})";
  const std::string out = folder_ / "out";
  const ProcessResult result = playpen({"fuzz", world, "--runs", "32", "--most", "1", "--look-for",
                                        "collision", "--out", out, "--", AVOID_PROGRAM});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("in the device laser blind from "));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("did not happen again")));
  EXPECT_THAT(world_in(out), HasSubstr("\"kind\": \"blind\""));
}

TEST_F(PlaypenFuzz, SectionOfWorldIsWrong_StatusTwo) {
  const std::string world = folder_ / "room.json";
  std::ofstream(world) << R"({"fuzz": {"doors": {"width": [2, 1]}}})";
  const ProcessResult result = playpen({"fuzz", world, "--", AVOID_PROGRAM});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("/fuzz/doors/width"), HasSubstr("[least, greatest]")));
}

TEST_F(PlaypenFuzz, BadArguments_AreRefused) {
  const std::pair<Words, const char*> cases[] = {
      {{"--look-for", "boredom"}, "crash, sanitizer"},
      {{"--without", "walls"}, "starts, obstacles, moving"},
      {{"--with", "moving"}, "faults"},
      {{"--budget", "0"}, "30s, 5m or 1h"},
      {{"--robot", "r9"}, "no robot 'r9'"},
      {{"--expect", "luck > 1"}, "no figure 'luck'"}};
  for (const auto& [options, words] : cases) {
    const ProcessResult result = fuzz(options);
    EXPECT_EQ(result.status, 2) << options[0];
    EXPECT_THAT(result.err, HasSubstr(words));
  }
  const ProcessResult other = fuzz({"--out", folder_ / "out"}, "/bin/true");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("linked with Playpen"));
}

}  // namespace
