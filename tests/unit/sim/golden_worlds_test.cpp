// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "random_numbers.h"
#include "sim/core/hash.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "sim/devices/device.h"
#include "sim/io/world_io.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

/// The shipped worlds, by their paths in worlds/.
std::vector<std::string> shipped_worlds() {
  const std::filesystem::path root = PLAYPEN_SOURCE_DIR "/worlds";
  std::vector<std::string> worlds;
  for (const char* folder : {"", "devices", "examples", "tasks"}) {
    for (const auto& entry : std::filesystem::directory_iterator(root / folder)) {
      const std::filesystem::path& file = entry.path();
      const bool is_task = file.stem().extension() == ".task";
      if (file.extension() == ".json" && !is_task) {
        worlds.push_back(file.lexically_relative(root).generic_string());
      }
    }
  }
  std::sort(worlds.begin(), worlds.end());
  return worlds;
}

/// A line of the file: the hash, and since when Box2D took part, in seconds; "-": it did not.
struct Result {
  std::string hash;
  std::string box2d_from;

  friend bool operator==(const Result&, const Result&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Result& result) {
    return out << result.hash << ' ' << result.box2d_from;
  }
};

/// State after a random drive of all robots for 20 s, with all readings of the last step.
Result result_of_drive(const std::string& world) {
  constexpr double kDrive_s = 20.0;
  Simulation simulation(load_world(PLAYPEN_SOURCE_DIR "/worlds/" + world));
  test::Random random(42);
  const SimTime command_ns = from_seconds(0.37);
  SimTime next_ns = 0;
  while (to_seconds(simulation.now_ns()) < kDrive_s) {
    if (simulation.now_ns() >= next_ns) {
      next_ns += command_ns;
      for (int robot = 0; robot < simulation.robot_count(); ++robot) {
        const double v_mps = random.uniform(-0.5, 0.5);
        const double omega_radps = random.uniform(-3.0, 3.0);
        const auto motion = simulation.find_device(robot, "motion");
        if (!motion) continue;
        simulation.apply({robot, *motion},
                         TwistCommand{{.v_mps = v_mps, .omega_radps = omega_radps}});
      }
    }
    simulation.step();
  }
  StateHash hash;
  hash.add(simulation.state_hash());
  const Snapshot snapshot = simulation.save();
  hash.add_bytes(snapshot.data(), snapshot.size());
  const std::optional<SimTime> since_ns = simulation.box2d_since_ns();
  return {hexadecimal_text(hash.value(), 16),
          since_ns ? fixed_text(to_seconds(*since_ns), 2) : std::string("-")};
}

// Each world has one hash: the same for gcc and clang, without and with optimisation, static and
// shared libraries, every processor and C library (docs/trust.md has the table). Box2D's part has
// other bits on other kinds of processors.
TEST(GoldenWorlds, SameHashInEveryBuildOnEveryMachine) {
#ifdef __x86_64__
  constexpr bool kSameBox2d = true;
#else
  constexpr bool kSameBox2d = false;
#endif
  const std::string path = PLAYPEN_SOURCE_DIR "/tests/golden/worlds.txt";
  std::map<std::string, Result> golden;
  std::ifstream file(path);
  Result read;
  for (std::string world; file >> world >> read.hash >> read.box2d_from;) golden[world] = read;
  std::ostringstream now;
  bool same = true;
  for (const std::string& world : shipped_worlds()) {
    const Result result = result_of_drive(world);
    now << world << ' ' << result << '\n';
    Result expected = golden[world];
    if (!kSameBox2d && expected.box2d_from != "-") expected.hash = result.hash;
    EXPECT_EQ(result, expected) << world;
    same = same && result == expected;
    golden.erase(world);
  }
  EXPECT_TRUE(same && golden.empty())
      << "if results were meant to change, say so in the changelog and store in " << path << ":\n"
      << now.str();
}

}  // namespace
}  // namespace sim
