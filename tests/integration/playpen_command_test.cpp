// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The playpen command as a user runs it: help, bad arguments, check and render.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(PlaypenCommand, Help_ListsCommandsAndExitStatuses) {
  const ProcessResult result = playpen({"--help"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("run"), HasSubstr("serve"), HasSubstr("grade"),
                                HasSubstr("check"), HasSubstr("render"), HasSubstr("Exit status")));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST(PlaypenCommand, NoCommand_PrintsHelp) {
  const ProcessResult result = playpen({});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, playpen({"--help"}).out);
}

TEST(PlaypenCommand, Version_MatchesProject) {
  const ProcessResult result = playpen({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "playpen " PLAYPEN_VERSION "\n");
}

TEST(PlaypenCommand, Help_ExistsForEachCommand) {
  for (const char* command :
       {"run", "serve", "grade", "check", "render", "list", "new", "token", "doctor"}) {
    const ProcessResult result = playpen({command, "--help"});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_THAT(result.out, HasSubstr(std::string("Usage: playpen ") + command)) << command;
  }
}

TEST(PlaypenCommand, UnknownCommandsAndMissingArguments_Refused) {
  const std::vector<std::vector<std::string>> calls = {
      {"fly"}, {"--fly"}, {"check"}, {"run"}, {"serve"}, {"run", "x.json"}, {"render", "x.json"},
  };
  for (const auto& call : calls) {
    const ProcessResult result = playpen(call);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(call);
    EXPECT_THAT(result.err, Not(IsEmpty())) << testing::PrintToString(call);
  }
}

TEST(PlaypenCommand, FilmSettingsWithoutFilm_Refused) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  for (const char* option : {"--record-fps", "--record-speed"}) {
    const ProcessResult result = playpen({"run", world, option, "5", "--", "/bin/true"});
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.err, AllOf(HasSubstr(option), HasSubstr("--record")));
  }
}

TEST(PlaypenCommand, InvalidOptionValues_RefusedByNameAndValue) {
  struct Case {
    const char* option;
    const char* value;
  };
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  for (const Case& c : std::vector<Case>{{"--duration", "0"},
                                         {"--duration", "nan"},
                                         {"--duration", "10s"},
                                         {"--seed", "-1"},
                                         {"--seed", "18446744073709551616"},  // 2^64
                                         {"--time", "never"},
                                         {"--time", "0"},
                                         {"--record", "film.gif"},
                                         {"--record-fps", "0.5"},
                                         {"--record-fps", "fast"},
                                         {"--record-speed", "0"},
                                         {"--record-speed", "2000"},
                                         {"--snapshot-every", "-1"},
                                         {"--snapshot-every", "1s"},
                                         {"--view-mode", "fullscreen"},
                                         {"--realism", "high"}}) {
    const ProcessResult result =
        playpen({"run", world, std::string(c.option) + "=" + c.value, "--", "/bin/true"});
    EXPECT_EQ(result.status, 2) << c.option << ' ' << c.value;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(c.option), HasSubstr(std::string("'") + c.value + "'")));
  }
  for (const Case& c : std::vector<Case>{{"--size", "63"},
                                         {"--size", "8193"},
                                         {"--out", "picture.jpg"},
                                         {"--view-mode", "map"}}) {
    const std::string option = std::string(c.option) + "=" + c.value;
    std::vector<std::string> call = {"render", world, option};
    if (c.option != std::string("--out")) call.insert(call.end(), {"--out", folder / "a.png"});
    const ProcessResult result = playpen(call);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(c.option), HasSubstr(std::string("'") + c.value + "'")));
  }
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(PlaypenCheck, ValidWorld_Summarized) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  const ProcessResult result = playpen({"check", world});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, world + ": ok (world: 1 robot, 0 obstacles, 2.00 m x 2.00 m)\n");
  EXPECT_THAT(result.err, IsEmpty());
}

TEST(PlaypenCheck, Pipes_AcceptedOnCommandLine) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  const std::string command = PLAYPEN_COMMAND;
  const auto shell = [](const std::string& line) {
    return test_support::run_process({"bash", "-c", line});
  };
  EXPECT_THAT(shell("cat " + world + " | " + command + " check /dev/stdin").out,
              HasSubstr(": ok (world: 1 robot"));
  EXPECT_THAT(shell(command + " check <(cat " + world + ")").out,
              HasSubstr(": ok (world: 1 robot"));
  EXPECT_THAT(shell(command + " check <(true)").err, HasSubstr("[file/empty]"));
  EXPECT_THAT(shell("head -c 20000000 /dev/zero | " + command + " check /dev/stdin").err,
              HasSubstr("[file/too-large]"));
  EXPECT_THAT(shell(command + " check /dev/zero").err,
              AllOf(HasSubstr("found a device"), HasSubstr("[file/not-a-file]")));
}

TEST(PlaypenCheck, InvalidWorlds_EveryIssueReported) {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.json", room_world());
  // Two faults: a key that does not exist, and a seed of the wrong type.
  const std::string bad =
      folder.write("bad.json", R"({"name": "bad", "robotz": [], "simulation": {"seed": "seven"}})");
  const ProcessResult result = playpen({"check", bad, folder / "none.json", good});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.out, HasSubstr(good + ": ok"));
  EXPECT_THAT(result.err,
              AllOf(HasSubstr(bad + ":"), HasSubstr("robotz"), HasSubstr("robots"),
                    HasSubstr("/simulation/seed"), HasSubstr("seven"), HasSubstr("none.json")));
}

TEST(PlaypenCheck, InstalledWorlds_Found) {
  const TemporaryFolder prefix;
  const std::string command = prefix.write("bin/playpen", "");
  fs::copy_file(PLAYPEN_COMMAND, command, fs::copy_options::overwrite_existing);
  fs::permissions(command, fs::perms::owner_all);
  prefix.write("share/playpen/worlds/tasks/room.json", room_world());
  for (const char* name : {"tasks/room", "tasks/room.json"}) {
    const ProcessResult result = test_support::run_process({command, "check", name});
    EXPECT_EQ(result.status, 0) << name << ": " << result.err;
  }
  EXPECT_EQ(test_support::run_process({command, "check", "tasks/rooms"}).status, 2);
}

TEST(PlaypenRender, DrawsWorldInRequestedSize) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  const ProcessResult result =
      playpen({"render", world, "--out", folder / "a.png", "--size", "300"});
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string png = read_bytes(folder / "a.png");
  // PNG: eight bytes of signature, length and type of IHDR, then width and height, big-endian.
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const auto number_at = [&png](std::size_t at) {
    int value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = 256 * value + static_cast<unsigned char>(png[at + i]);
    }
    return value;
  };
  EXPECT_EQ(std::max(number_at(16), number_at(20)), 300);
}

TEST(PlaypenRender, DrawsCanvasTrueMapAndMapFiles) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  const auto render = [&](const std::string& from, const std::string& out,
                          std::vector<std::string> options) {
    options.insert(options.begin(), {"render", from, "--out", folder / out});
    const ProcessResult result = playpen(options);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  render(world, "canvas.png", {"--canvas"});
  render(world, "full.png", {"--view-mode", "full-screen"});
  render(world, "map.png", {"--map"});
  render(world, "map.yaml", {"--map"});
  render(folder / "map.yaml", "read.png", {});
  // 172 x 186 cells in 1000 px: 5 pixels per cell.
  const std::string canvas = read_bytes(folder / "canvas.png");
  EXPECT_EQ(static_cast<unsigned char>(canvas[18]) * 256 + static_cast<unsigned char>(canvas[19]),
            172 * 5);
  EXPECT_THAT(read_bytes(folder / "map.yaml"), HasSubstr("map.pgm"));
  EXPECT_TRUE(read_bytes(folder / "map.png") == read_bytes(folder / "read.png"));
  EXPECT_FALSE(read_bytes(folder / "map.png") == canvas);
  EXPECT_GT(read_bytes(folder / "full.png").size(), 1000U);
}

TEST(PlaypenRender, ConflictingOptions_Refused) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--out", folder / "a.png", "--canvas", "--map"},
        {"--out", folder / "a.yaml"}}) {
    std::vector<std::string> call = {"render", world};
    call.insert(call.end(), options.begin(), options.end());
    const ProcessResult result = playpen(call);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("--map"));
  }
}

TEST(PlaypenRender, InvalidWorldAndUnwritableFile_Refused) {
  const TemporaryFolder folder;
  const std::string world = folder.write("room.json", room_world());
  EXPECT_EQ(playpen({"render", folder / "none.json", "--out", folder / "a.png"}).status, 2);
  const ProcessResult result = playpen({"render", world, "--out", folder / "no/such/a.png"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("no/such/a.png"));
}

}  // namespace
