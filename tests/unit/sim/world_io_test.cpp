// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/world_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "device_table.h"
#include "sim/world/view_mode.h"
#include "temporary_folder.h"

namespace sim::io {
namespace {

using test::PlainParams;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

WorldDescription read(std::string_view text) {
  return read_world_text(text, "<memory>", test::device_table());
}

std::vector<ConfigIssue> issues_of(std::string_view text) {
  try {
    static_cast<void>(read(text));
  } catch (const ConfigError& error) {
    return error.issues();
  }
  return {};
}

std::vector<ConfigIssue> issues_of_file(const std::string& path) {
  try {
    static_cast<void>(read_world(path, test::device_table()));
  } catch (const ConfigError& error) {
    return error.issues();
  }
  return {};
}

std::vector<std::string> device_names(const RobotDescription& robot) {
  std::vector<std::string> names;
  for (const DeviceDescription& device : robot.devices) names.push_back(device.name);
  return names;
}

const DeviceDescription& device(const RobotDescription& robot, const std::string& name) {
  for (const DeviceDescription& d : robot.devices) {
    if (d.name == name) return d;
  }
  throw std::out_of_range(name);
}

TEST(ReadWorld, EmptyObject_DefaultWorld) {
  const WorldDescription world = read("{}");
  EXPECT_EQ(world.name, "unnamed");
  EXPECT_EQ(world.file, "<memory>");
  EXPECT_EQ(world.arena.preset, "syrotek");
  EXPECT_EQ(world.arena.size, Vec2(3.42, 3.72));
  EXPECT_EQ(world.simulation.step_ns, 10'000'000);
  EXPECT_EQ(world.simulation.seed, 1U);
  EXPECT_FALSE(world.simulation.duration_ns.has_value());
  EXPECT_EQ(world.simulation.time_mode, TimeMode::kLockstep);
  EXPECT_EQ(world.simulation.start_gate_clients, 1);
  EXPECT_EQ(world.canvas.width, 172);
  EXPECT_EQ(world.canvas.height, 186);
  EXPECT_EQ(world.canvas.cell_size_m, 0.02);
  EXPECT_EQ(world.canvas.view_mode, ViewMode::kGround);
  EXPECT_FALSE(world.canvas.view_mode_locked);
  ASSERT_THAT(world.robots, SizeIs(1));
  const RobotDescription& robot = world.robots[0];
  EXPECT_EQ(robot.name, "r1");
  EXPECT_EQ(robot.model, "s1r");
  EXPECT_EQ(robot.port, 6665);
  EXPECT_EQ(robot.pose, syrotek_start_pose());
  EXPECT_THAT(device_names(robot), ElementsAre("laser", "motion", "odometry", "pen", "pose"));
  EXPECT_EQ(std::any_cast<PlainParams>(device(robot, "laser").params), PlainParams{});
}

TEST(ReadWorld, AllKeys_Read) {
  const WorldDescription world = read(R"({
    "$schema": "x", "name": "intro", "description": "A room to try all in.",
    "arena": {"size": [4, 3], "origin": [-1, -2], "border": false, "border_height": 0.3,
      "obstacles": [
        {"name": "a", "type": "dynamic", "center": [0, 0], "size": [0.4, 0.2], "yaw_deg": 90,
         "height": 0.5, "state": "retracted", "colour": "#ff8800"},
        {"center": [1, 0]}],
      "docks": [{"name": "bay", "pose": {"x": 2, "y": 0, "yaw_deg": 180}, "size": [0.3, 0.3]},
                {"pose": {"x": 2, "y": 0.5}}],
      "dock_separators": [{"center": [2.5, 0.25], "size": [0.3, 0.02]}]},
    "simulation": {"step": 0.02, "seed": 7, "duration": 120, "time": 2.5, "clients": 3},
    "canvas": {"size": [100, 50], "cell_size": 0.1, "origin": [-2, -2],
      "view_mode": "mini-map", "lock_view_mode": true},
    "robots": [{"name": "bob", "model": "s1r", "pose": {"x": 0.5, "y": -1, "yaw_deg": -90},
      "colour": "#102030", "port": 7000,
      "devices": {"laser": {"frequency": 20, "noise": 0.01}, "pen": null, "odometry": false,
                  "eye": {"type": "camera", "frequency": 5}, "camera": {}},
      "proxies": {"laser": 3, "position2d": 0},
      "drivers": [{"type": "snd", "goal": 1.50, "name": "x", "fast": true}]}]
  })");
  EXPECT_EQ(world.name, "intro");
  EXPECT_EQ(world.description, "A room to try all in.");
  EXPECT_EQ(world.arena.preset, "");
  EXPECT_EQ(world.arena.size, Vec2(4, 3));
  EXPECT_EQ(world.arena.origin, Vec2(-1, -2));
  EXPECT_FALSE(world.arena.border);
  EXPECT_EQ(world.arena.border_height_m, 0.3);
  ASSERT_THAT(world.arena.obstacles, SizeIs(2));
  const ObstacleDescription& a = world.arena.obstacles[0];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.type, ObstacleType::kDynamic);
  EXPECT_EQ(a.size, Vec2(0.4, 0.2));
  EXPECT_EQ(a.yaw_rad, std::numbers::pi / 2);
  EXPECT_EQ(a.height_m, 0.5);
  EXPECT_EQ(a.state, ObstacleState::kRetracted);
  EXPECT_EQ(a.colour, (Colour{0xff, 0x88, 0x00, 0xff}));
  const ObstacleDescription& unnamed = world.arena.obstacles[1];
  EXPECT_EQ(unnamed.name, "o1");
  EXPECT_EQ(unnamed.type, ObstacleType::kStatic);
  EXPECT_EQ(unnamed.state, ObstacleState::kExtended);
  EXPECT_EQ(unnamed.height_m, 0.16);
  EXPECT_EQ(unnamed.colour, std::nullopt);
  ASSERT_THAT(world.arena.docks, SizeIs(2));
  EXPECT_EQ(world.arena.docks[0].name, "bay");
  EXPECT_EQ(world.arena.docks[0].pose, (Pose{2, 0, std::numbers::pi}));
  EXPECT_EQ(world.arena.docks[1].name, "dock1");
  ASSERT_THAT(world.arena.dock_separators, SizeIs(1));
  EXPECT_EQ(world.arena.dock_separators[0].name, "separator1");
  EXPECT_EQ(world.simulation.step_ns, 20'000'000);
  EXPECT_EQ(world.simulation.seed, 7U);
  EXPECT_EQ(world.simulation.duration_ns, 120 * kNanosecondsPerSecond);
  EXPECT_EQ(world.simulation.time_mode, TimeMode::kPaced);
  EXPECT_EQ(world.simulation.time_factor, 2.5);
  EXPECT_EQ(world.simulation.start_gate_clients, 3);
  EXPECT_EQ(world.canvas.width, 100);
  EXPECT_EQ(world.canvas.height, 50);
  EXPECT_EQ(world.canvas.cell_size_m, 0.1);
  EXPECT_EQ(world.canvas.origin, Vec2(-2, -2));
  EXPECT_EQ(world.canvas.view_mode, ViewMode::kMiniMap);
  EXPECT_TRUE(world.canvas.view_mode_locked);
  ASSERT_THAT(world.robots, SizeIs(1));
  const RobotDescription& bob = world.robots[0];
  EXPECT_EQ(bob.name, "bob");
  EXPECT_EQ(bob.pose, (Pose{0.5, -1, -std::numbers::pi / 2}));
  EXPECT_EQ(bob.colour, (Colour{0x10, 0x20, 0x30, 0xff}));
  EXPECT_EQ(bob.port, 7000);
  EXPECT_THAT(device_names(bob), ElementsAre("camera", "eye", "laser", "motion", "pose"));
  EXPECT_EQ(device(bob, "eye").type, "camera");
  EXPECT_EQ(std::any_cast<PlainParams>(device(bob, "eye").params), (PlainParams{5.0, 0.0}));
  EXPECT_EQ(device(bob, "camera").type, "camera");
  EXPECT_EQ(std::any_cast<PlainParams>(device(bob, "laser").params), (PlainParams{20.0, 0.01}));
  EXPECT_EQ(bob.proxies, (std::map<std::string, int>{{"laser", 3}, {"position2d", 0}}));
  ASSERT_THAT(bob.drivers, SizeIs(1));
  EXPECT_EQ(bob.drivers[0].type, "snd");
  EXPECT_EQ(bob.drivers[0].settings, (std::map<std::string, std::string>{
                                         {"goal", "1.50"}, {"name", "x"}, {"fast", "true"}}));
}

TEST(ReadWorld, SyrotekFile_DefaultWorld) {
  const WorldDescription file =
      read_world(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/syrotek.json", test::device_table());
  const WorldDescription none = read("{}");
  EXPECT_EQ(file.arena.obstacles.size(), none.arena.obstacles.size());
  EXPECT_EQ(file.simulation.step_ns, none.simulation.step_ns);
  EXPECT_EQ(file.canvas.width, none.canvas.width);
  EXPECT_EQ(file.canvas.height, none.canvas.height);
  ASSERT_THAT(file.robots, SizeIs(1));
  EXPECT_EQ(file.robots[0].pose, none.robots[0].pose);
  EXPECT_EQ(file.robots[0].colour, none.robots[0].colour);
  EXPECT_EQ(file.robots[0].port, none.robots[0].port);
}

TEST(ReadWorld, ExamplesOfFormatPage_Valid) {
  std::ifstream stream(std::string(PLAYPEN_SOURCE_DIR) + "/docs/world_format.md");
  int examples = 0;
  std::optional<std::string> example;
  for (std::string line; std::getline(stream, line);) {
    if (line == "```json") {
      example = "";
    } else if (line == "```" && example) {
      // The example with plan.png needs a picture that the page's reader provides.
      if (example->find("plan.png") == std::string::npos) {
        ++examples;
        for (const ConfigIssue& issue : issues_of(*example)) {
          ADD_FAILURE() << *example << issue.message();
        }
      }
      example.reset();
    } else if (example) {
      *example += line + '\n';
    }
  }
  EXPECT_GE(examples, 6);
}

TEST(ReadWorld, AllErrors_InOrderOfLines) {
  const std::vector<ConfigIssue> issues = issues_of(R"({
    "robots": [
      {"pose": {"x": 0.5, "y": 0.4, "yaw": 90}, "port": 80},
      {"pose": {"x": 0.9, "y": 2.2}},
      {"pose": {"x": 0.5, "y": 1.0}, "name": "r2"},
      {"pose": {"x": 0.5, "y": 1.0}, "name": "r2"}
    ],
    "simulation": {"step": -1},
    "canvas": {"cellsize": 0.1}
  })");
  std::vector<std::string> found;
  for (const ConfigIssue& issue : issues) {
    found.push_back(std::to_string(issue.line) + " " + issue.id);
  }
  EXPECT_THAT(found,
              ElementsAre("3 world/unknown-key", "3 world/out-of-range",
                          "4 world/robot-overlaps-obstacle", "6 world/duplicate-name",
                          "6 world/robots-overlap", "8 world/out-of-range", "9 world/unknown-key"));
}

TEST(ReadWorld, InvalidValue_ReportedOnce) {
  // The pose defaults to (0, 0), where the robot would extend beyond the floor.
  const std::vector<ConfigIssue> pose = issues_of(R"({"robots": [{"pose": {"x": "a", "y": 1}}]})");
  ASSERT_THAT(pose, SizeIs(1));
  EXPECT_EQ(pose[0].pointer, "/robots/0/pose/x");
  // The arena defaults to another size, in which the robot would be outside.
  const std::vector<ConfigIssue> arena =
      issues_of(R"({"arena": {"size": [9, "9"]}, "robots": [{"pose": {"x": 8, "y": 8}}]})");
  ASSERT_THAT(arena, SizeIs(1));
  EXPECT_EQ(arena[0].pointer, "/arena/size/1");
}

TEST(ReadWorld, Robots_GetDistinctNamesPortsAndColours) {
  const WorldDescription world =
      read(R"({"arena": {"size": [4, 4]}, "robots": [{"name": "r2"}, {}, {"port": 6665}, {}]})");
  std::vector<std::string> names;
  std::vector<int> ports;
  for (const RobotDescription& robot : world.robots) {
    names.push_back(robot.name);
    ports.push_back(robot.port);
  }
  // The name r2 and the port 6665 are taken, so the other robots get the next free ones.
  EXPECT_THAT(names, ElementsAre("r2", "r3", "r4", "r5"));
  EXPECT_THAT(std::set<std::string>(names.begin(), names.end()), SizeIs(4));
  EXPECT_THAT(std::set<int>(ports.begin(), ports.end()), SizeIs(4));
  EXPECT_EQ(ports[2], 6665);

  std::string thirteen = R"({"arena": {"size": [9, 9]}, "robots": [{})";
  for (int i = 1; i < 13; ++i) thirteen += ", {}";
  std::set<std::string> colours;
  for (const RobotDescription& robot : read(thirteen + "]}").robots) {
    colours.insert(to_string(robot.colour));
  }
  EXPECT_THAT(colours, SizeIs(13));
}

TEST(ReadWorld, RobotsWithoutPose_GetFreePlaces) {
  std::string text = R"({"robots": [{"pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90}})";
  for (int i = 1; i < 13; ++i) text += ", {}";
  // check_world, which read() calls, would refuse places that are not free.
  EXPECT_THAT(read(text + "]}").robots, SizeIs(13));
}

TEST(ReadWorld, EmptyRoom_RobotInMiddle) {
  const WorldDescription world = read(R"({"arena": {"size": [4, 2], "origin": [1, 1]}})");
  ASSERT_THAT(world.robots, SizeIs(1));
  EXPECT_NEAR(world.robots[0].pose.x_m, 3.0, 0.05);  // half the spacing of the candidate places
  EXPECT_NEAR(world.robots[0].pose.y_m, 2.0, 0.05);
  EXPECT_EQ(world.robots[0].pose.yaw_rad, 0.0);  // the direction with more room
}

TEST(ReadWorld, EmptyRobotList_Accepted) {
  EXPECT_THAT(read(R"({"robots": []})").robots, SizeIs(0));
}

TEST(ReadWorld, Lists_SetStateOfDynamicObstacles) {
  const WorldDescription world = read(R"({"arena": {"preset": "syrotek", "extended": ["d3"],
    "obstacles": [{"name": "mine", "type": "dynamic", "center": [3, 3.2], "size": [0.1, 0.1]}],
    "retracted": ["mine"]}})");
  for (const ObstacleDescription& obstacle : world.arena.obstacles) {
    const bool extended = obstacle.type == ObstacleType::kStatic || obstacle.name == "d3";
    EXPECT_EQ(obstacle.state == ObstacleState::kExtended, extended) << obstacle.name;
  }
}

TEST(ReadWorld, Time_WordOrFactor) {
  EXPECT_EQ(read(R"({"simulation": {"time": "lockstep"}})").simulation.time_mode,
            TimeMode::kLockstep);
  const SimulationDescription real = read(R"({"simulation": {"time": "real"}})").simulation;
  EXPECT_EQ(real.time_mode, TimeMode::kPaced);
  EXPECT_EQ(real.time_factor, 1.0);
  EXPECT_EQ(read(R"({"simulation": {"time": 10}})").simulation.time_factor, 10.0);
  EXPECT_EQ(issues_of(R"({"simulation": {"time": "fast"}})").at(0).id, "world/unknown-value");
  EXPECT_EQ(issues_of(R"({"simulation": {"time": 0}})").at(0).id, "world/out-of-range");
  EXPECT_EQ(issues_of(R"({"simulation": {"time": []}})").at(0).id, "world/wrong-type");
}

TEST(ReadWorld, Duration_MayBeNull) {
  EXPECT_FALSE(read(R"({"simulation": {"duration": null}})").simulation.duration_ns.has_value());
}

TEST(ReadWorld, ViewModes_ReadByName) {
  for (const ViewMode mode : kViewModes) {
    const std::string name(to_string(mode));
    EXPECT_EQ(parse_view_mode(name), mode);
    const CanvasDescription canvas = read(R"({"canvas": {"view_mode": ")" + name + R"("}})").canvas;
    EXPECT_EQ(canvas.view_mode, mode) << name;
    EXPECT_FALSE(canvas.view_mode_locked);
  }
  for (const char* no_mode : {"", "Ground", "mini_map", "ground "}) {
    EXPECT_EQ(parse_view_mode(no_mode), std::nullopt) << no_mode;
  }
}

TEST(ReadWorld, Canvas_FollowsFloorUnlessGiven) {
  // 3.42 x 3.72 m in cells of 1 cm: 342 x 372.
  const CanvasDescription fine = read(R"({"canvas": {"cell_size": 0.01}})").canvas;
  EXPECT_EQ(fine.width, 342);
  EXPECT_EQ(fine.height, 372);
  // 1000 m in cells of 2 cm would be 50 000; 0.5 m is the first cell that needs at most 4096.
  const CanvasDescription large = read(R"({"arena": {"size": [1000, 10]}})").canvas;
  EXPECT_EQ(large.cell_size_m, 0.5);
  EXPECT_EQ(large.width, 2000);
  EXPECT_EQ(large.height, 20);
}

TEST(ReadWorld, ModelDevice_MayChangeType) {
  const WorldDescription world =
      read(R"({"robots": [{"devices": {"laser": {"type": "camera", "noise": 1}}}]})");
  const DeviceDescription& changed = device(world.robots[0], "laser");
  EXPECT_EQ(changed.type, "camera");
  EXPECT_EQ(std::any_cast<PlainParams>(changed.params), (PlainParams{10.0, 1.0}));
}

TEST(ReadWorld, UnavailableModelDevice_Reported) {
  try {
    static_cast<void>(read_world_text("{}", "<memory>", {}));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    ASSERT_THAT(error.issues(), SizeIs(5));
    EXPECT_EQ(error.issues()[0].id, "world/unknown-device-type");
    EXPECT_THAT(error.issues()[0].found, HasSubstr("\"laser\""));
  }
}

TEST(ReadWorld, UnreadableFiles_Explained) {
  const std::string folder = std::string(PLAYPEN_SOURCE_DIR) + "/worlds";
  const std::vector<ConfigIssue> missing = issues_of_file(folder + "/syrotk.json");
  ASSERT_THAT(missing, SizeIs(1));
  EXPECT_EQ(missing[0].id, "file/missing");
  EXPECT_THAT(missing[0].hint, HasSubstr("syrotek.json"));

  const std::vector<ConfigIssue> a_folder = issues_of_file(folder);
  ASSERT_THAT(a_folder, SizeIs(1));
  EXPECT_EQ(a_folder[0].id, "file/not-a-file");
  EXPECT_THAT(a_folder[0].hint, HasSubstr("cave.json"));  // the first file in it

  const std::vector<ConfigIssue> endless = issues_of_file("/dev/zero");
  ASSERT_THAT(endless, SizeIs(1));
  EXPECT_EQ(endless[0].id, "file/not-a-file");
}

TEST(ReadWorld, StageExtension_MayHoldJson) {
  const test_support::TemporaryFolder folder;
  // An extension alone does not make a file of Stage, unless the file is empty.
  EXPECT_THAT(issues_of_file(folder.write("json.world", "// ours\n{}")), testing::IsEmpty());
  const std::vector<ConfigIssue> empty = issues_of_file(folder.write("empty.world", " \n"));
  ASSERT_THAT(empty, SizeIs(1));
  EXPECT_EQ(empty[0].id, "stage/empty");
}

TEST(ReadWorld, LongTexts_Refused) {
  const std::vector<ConfigIssue> bytes = issues_of(std::string((16U << 20U) + 1, ' '));
  ASSERT_THAT(bytes, SizeIs(1));
  EXPECT_EQ(bytes[0].id, "file/too-large");

  std::string values = "[0";
  for (int i = 0; i < 2'000'000; ++i) values += ",0";
  const std::vector<ConfigIssue> many = issues_of(values + "]");
  ASSERT_THAT(many, SizeIs(1));
  EXPECT_EQ(many[0].id, "file/too-large");
}

TEST(ReadWorld, HundredThousandUnknownKeys_ShortReport) {
  std::string text = "{\"a\": 0";
  for (int i = 0; i < 100'000; ++i) text += ", \"k" + std::to_string(i) + "\": 0";
  EXPECT_THAT(issues_of(text + "}"), SizeIs(101));
}

/// The error for a world file that is refused.
std::string refusal_of(const std::string& file) {
  try {
    static_cast<void>(read_world(file, test::device_table()));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NamedFiles, RegularFilesOnly) {
  const test_support::TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
  std::filesystem::create_symlink("loop", folder / "loop");
  for (const auto& [file, found] :
       {std::pair("/dev/zero", "a device"), std::pair("fifo", "a pipe"),
        std::pair("loop", "links that lead round in a circle"), std::pair(".", "a folder")}) {
    const std::string name(file);
    EXPECT_THAT(
        refusal_of(folder.write("map.json", R"({"arena": {"map": {"image": ")" + name + "\"}}}")),
        testing::AllOf(HasSubstr("world/map-unreadable"), HasSubstr(found)));
    EXPECT_THAT(
        refusal_of(folder.write("model.json", R"({"robots": [{"model": "./)" + name + "\"}]}")),
        testing::AnyOf(testing::AllOf(HasSubstr("world/model-unreadable"), HasSubstr(found)),
                       HasSubstr(".//dev/zero: no file of that name")));
  }
  EXPECT_THAT(refusal_of(folder.write("model.json", R"({"robots": [{"model": "/dev/zero"}]})")),
              HasSubstr("a device"));
  EXPECT_THAT(refusal_of("/dev/zero"), HasSubstr("[file/not-a-file]"));
  EXPECT_THAT(refusal_of(folder / "loop"), HasSubstr("links that lead round in a circle"));
}

// A stranger's world may name any file; error messages must not reveal the file's content.
TEST(NamedFiles, NotQuotedUnlessJsonObjects) {
  const test_support::TemporaryFolder folder;
  const std::string world = folder.write("world.json", R"({"robots": [{"model": "./secret"}]})");
  for (const std::string text :
       {"root:hunter2:19000:0:99999:7:::\nme:hunter2:19000\n", "hunter2", "\"hunter2\"", "4711\n",
        "-----BEGIN OPENSSH PRIVATE KEY-----\nhunter2\n", "[hunter2]\nkey = hunter2\n",
        "[\"hunter2\", hunter2]", "// a comment\nhunter2 {", "\"a\": hunter2", "'hunter2'"}) {
    folder.write("secret", text);
    EXPECT_THAT(refusal_of(world),
                testing::AllOf(HasSubstr("secret"), testing::Not(HasSubstr("hunter2")),
                               testing::Not(HasSubstr("4711")), testing::Not(HasSubstr("root")),
                               testing::Not(HasSubstr("accepted"))))
        << text;
  }
  // Errors in a model still quote its line.
  folder.write("secret", "// a robot\n{\"name\": oops}");
  EXPECT_THAT(refusal_of(world), HasSubstr("'oops' in the line: {\"name\": oops}"));
}

TEST(ReadWorld, Pipe_NamesRelativeToCurrentFolder) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const std::string text = R"({"name": "piped", "arena": {"map": {"image": "none.png"}}})";
  ASSERT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  close(ends[1]);
  EXPECT_THAT(refusal_of("/dev/fd/" + std::to_string(ends[0])),
              testing::AllOf(HasSubstr("found none.png: cannot read the picture: no file")));
  close(ends[0]);
}

}  // namespace
}  // namespace sim::io
