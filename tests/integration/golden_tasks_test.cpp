// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Each task of the course, with a solution, has one hash: the same in every build and on every
// machine (docs/trust.md). The solutions call the C library's mathematics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <ostream>
#include <sstream>
#include <string>

#include "playpen_process.h"
#include "run_files.h"
#include "sim/core/hash.h"
#include "temporary_folder.h"

namespace {

using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;

struct Case {
  const char* task;
  const char* program;
  const char* name;  ///< of the program
};

constexpr Case kCases[] = {
    {"par_intro", AVOID_PROGRAM, "avoid"},
    {"par_intro", WALL_PROGRAM, "wall"},
    {"par_planning", THETA_PROGRAM, "theta"},
    {"par_exploration", GAIN_PROGRAM, "gain"},
    {"par_exploration_changing", CHANGING_PROGRAM, "again"},
    {"par_traps", TRAPS_PROGRAM, "learn"},
    {"par_chase", CHASE_PROGRAM, "patrol"},
    {"par_localization", PARTICLES_PROGRAM, "particles"},
    {"par_localization", AMCL_PROGRAM, "amcl"},
};

/// Hash of the path, the final state and the figures of 20 s in a task's first world.
std::string hash_of_run(const Case& task, const ProcessOptions& options) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const ProcessResult run = playpen(
      {"run", task.task, "--duration", "20", "--quiet", "--out", out, "--", task.program}, options);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const nlohmann::json report = test_support::read_report(out);
  EXPECT_EQ(report.at("run").at("repeatable"), true);
  sim::StateHash hash;
  hash.add(report.at("run").at("state_hash").dump());
  hash.add(report.at("robots").dump());
  hash.add(read_bytes(out + "/trajectory.csv"));
  std::ostringstream text;
  text << std::hex << hash.value();
  return text.str();
}

TEST(GoldenTasks, SameHashOnEveryProcessorAndInEveryBuild) {
  const std::string path = PLAYPEN_SOURCE_DIR "/tests/golden/tasks.txt";
  std::map<std::string, std::string> golden;
  std::ifstream file(path);
  for (std::string task, hash; file >> task >> hash;) golden[task] = hash;
  // The C library takes the functions for older processors.
  ProcessOptions older;
  older.environment["GLIBC_TUNABLES"] = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F";
  std::ostringstream now;
  bool same = true;
  for (const Case& task : kCases) {
    const std::string name = std::string(task.task) + '/' + task.name;
    const std::string hash = hash_of_run(task, {});
    now << name << ' ' << hash << '\n';
    EXPECT_EQ(hash, golden[name]) << name;
    EXPECT_EQ(hash_of_run(task, older), hash) << name;
    same = same && hash == golden[name];
  }
  EXPECT_TRUE(same) << "if results were meant to change, say so in the changelog and store in "
                    << path << ":\n"
                    << now.str();
}

}  // namespace
