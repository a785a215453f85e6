// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Worlds of Stage in the commands of playpen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "playpen_process.h"
#include "temporary_folder.h"

namespace {

using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kWorld = R"(
include "pioneer.inc"
include "sick.inc"
model ( name "room" size [ 8 6 0.5 ] boundary 1 noblocks 1 )
pioneer2dx ( name "r0" pose [ -3 -2 0 0 ] sicklaser( pose [ 0 0 0 0 ] ) ctrl "fasr" )
)";

class StageCommands : public testing::Test {
 protected:
  [[nodiscard]] ProcessResult run(const std::string& world) const {
    return playpen({"run", world, "--out", folder_ / "out", "--quiet", "--duration", "10", "--",
                    STAGE_PROGRAM});
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.world", kWorld);
};

// Ten rounds of 0.1 s: the first command takes effect after the first round. Then it drives on.
TEST_F(StageCommands, Program_DrivesRobotOfWorldFile) {
  const ProcessResult result = run(world_);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("16 sonars, 180 beams"));
  EXPECT_THAT(result.out, HasSubstr("x -2."));  // 0.5 m/s for 2 s, from -3
  EXPECT_THAT(result.err, HasSubstr("room.world:5: the controller \"fasr\""));
}

TEST_F(StageCommands, ImportedWorld_RunsTheSame) {
  const ProcessResult imported = playpen({"import", world_, "--out", folder_ / "made"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  const std::string made = folder_ / "made/room.json";
  EXPECT_EQ(imported.out, made + "\n");
  EXPECT_EQ(run(made).out, run(world_).out);
  EXPECT_EQ(playpen({"check", made}).status, 0);
  EXPECT_EQ(playpen({"check", world_}).status, 0);
  EXPECT_EQ(playpen({"render", world_, "--out", folder_ / "a.png", "--size", "64"}).status, 0);
}

TEST_F(StageCommands, ConfigurationFile_LoadsItsWorld) {
  const std::string config = folder_.write("other.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "room.world" )
driver ( name "stage" provides ["position2d:0" "ranger:0" "ranger:1"] model "r0" )
)");
  EXPECT_EQ(run(config).status, 0);
  const ProcessResult missing = playpen({"check", folder_.write("bad.world", "pioneer2dx ( )")});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("bad.world:1:1: expected a model"));
}

}  // namespace
