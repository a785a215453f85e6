// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// How the playpen command resolves names of worlds, tasks and models, lists them and checks them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// An empty folder, so that names cannot refer to files.
ProcessOptions in(const TemporaryFolder& folder) {
  ProcessOptions options;
  options.folder = folder / ".";
  return options;
}

TEST(PlaypenNames, AllCommands_FindWorldByEachName) {
  const TemporaryFolder folder;
  for (const char* name : {"par_intro", "tasks/par_intro", "tasks/par_intro.json", "cave",
                           "cave.json", "default", "thirteen_robots", "devices/laser"}) {
    const ProcessResult render =
        playpen({"render", name, "--out", folder / "a.png", "--size", "64"}, in(folder));
    EXPECT_EQ(render.status, 0) << name << ": " << render.err;
    const ProcessResult check = playpen({"check", name}, in(folder));
    EXPECT_EQ(check.status, 0) << name << ": " << check.err;
    // /bin/true connects to no simulation. This error comes after the world was found and read.
    const ProcessResult run = playpen({"run", name, "--out", folder / "out", "--", "/bin/true"});
    EXPECT_EQ(run.status, 1) << name;
    EXPECT_THAT(run.err, HasSubstr("never connected")) << name;
    // An address that no machine has. This error comes after the world was read.
    const ProcessResult serve = playpen({"serve", name, "--bind", "256.0.0.1"}, in(folder));
    EXPECT_EQ(serve.status, 2) << name;
    EXPECT_THAT(serve.err, HasSubstr("256.0.0.1")) << name;
  }
}

TEST(PlaypenNames, GradeAndRun_FindSameNames) {
  const TemporaryFolder folder;
  for (const char* name :
       {"par_intro", "tasks/par_intro", "par_intro.task.json", "tasks/par_intro.json"}) {
    const ProcessResult grade = playpen(
        {"grade", name, "--seeds", "1,", "--out", folder / "out", "--", "/bin/true"}, in(folder));
    EXPECT_EQ(grade.status, 1) << name << ": " << grade.err;
    EXPECT_THAT(grade.out, HasSubstr("par_intro: 0 of 1 runs passed")) << name;
    const ProcessResult run =
        playpen({"run", name, "--out", folder / "out", "--", "/bin/true"}, in(folder));
    EXPECT_THAT(run.err, HasSubstr("never connected")) << name;
  }
}

TEST(PlaypenNames, FilesOfFolder_FirstAndWithoutExtension) {
  const TemporaryFolder folder;
  folder.write("cave.json", room_world());  // a cave of its own, 2 m wide
  folder.write("mine.json", room_world());
  for (const char* name : {"cave", "cave.json", "mine", "./mine"}) {
    const ProcessResult result = playpen({"check", name}, in(folder));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("2.00 m x 2.00 m")) << name;
  }
  // A folder of that name does not hide the shipped world.
  fs::create_directory(folder / "office");
  EXPECT_EQ(
      playpen({"render", "office", "--out", folder / "a.png", "--size", "64"}, in(folder)).status,
      0);
}

TEST(PlaypenNames, UnknownName_SuggestsNearest) {
  const TemporaryFolder folder;
  folder.write("my_room.json", room_world());
  struct Case {
    std::vector<std::string> call;
    const char* near;
  };
  const std::vector<Case> cases = {
      {{"run", "par_intor", "--", "/bin/true"}, "\"par_intro\""},
      {{"run", "tasks/par_intor", "--", "/bin/true"}, "\"tasks/par_intro\""},
      {{"run", "caev", "--", "/bin/true"}, "\"cave\""},
      {{"serve", "ofice"}, "\"office\""},
      {{"render", "cav.json", "--out", "a.png"}, "\"cave\""},
      {{"grade", "par_exploraton", "--", "/bin/true"}, "\"par_exploration\""},
      {{"grade", "exploration", "--", "/bin/true"}, "\"par_exploration\""},
      {{"check", "pioneer2dz"}, "\"pioneer2dx\""},
      {{"run", "my_rom.json", "--", "/bin/true"}, "\"my_room.json\""},
      {{"run", "defualt", "--", "/bin/true"}, "\"default\""},
  };
  for (const Case& c : cases) {
    const ProcessResult result = playpen(c.call, in(folder));
    EXPECT_EQ(result.status, 2) << c.call[1];
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(c.call[1]), HasSubstr("did you mean"), HasSubstr(c.near),
                      HasSubstr("playpen list"), HasSubstr("[file/missing]")))
        << c.call[1];
  }
  // Several names are similar: the hint lists all of them.
  EXPECT_THAT(playpen({"check", "par_planing_3"}, in(folder)).err,
              AllOf(HasSubstr("par_planning_2"), HasSubstr(" or ")));
  // No name is similar: there is no hint.
  EXPECT_THAT(playpen({"check", "xyzzyxyzzy"}, in(folder)).err, Not(HasSubstr("did you mean")));
}

TEST(PlaypenNames, FileOfOtherKind_ErrorNamesKind) {
  const TemporaryFolder folder;
  const std::string worlds = std::string(PLAYPEN_SOURCE_DIR) + "/worlds/";
  const auto error_of = [](const std::vector<std::string>& call) {
    const ProcessResult result = playpen(call);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(error_of({"run", worlds + "tasks/par_intro.task.json", "--", "/bin/true"}),
              AllOf(HasSubstr("found a task file"), HasSubstr("playpen grade"),
                    HasSubstr("[file/other-kind]")));
  EXPECT_THAT(error_of({"run", worlds + "models/epuck.json", "--", "/bin/true"}),
              AllOf(HasSubstr("found a model file"), HasSubstr("\"model\"")));
  EXPECT_THAT(error_of({"grade", worlds + "tasks/par_intro.json", "--", "/bin/true"}),
              AllOf(HasSubstr("found a world file"), HasSubstr("par_intro.task.json")));
  EXPECT_THAT(error_of({"grade", worlds + "cave.json", "--", "/bin/true"}),
              AllOf(HasSubstr("found a world file"), HasSubstr("playpen doc grading")));
}

TEST(PlaypenList, ListsWorldsTasksAndModelsInShortLines) {
  const ProcessResult all = playpen({"list"});
  ASSERT_EQ(all.status, 0) << all.err;
  for (const std::string& line : lines_of(all.out)) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_THAT(all.out, AllOf(HasSubstr("Worlds"), HasSubstr("Tasks"), HasSubstr("Robot models")));
  EXPECT_THAT(all.out, Not(HasSubstr("no description")));

  // Each file of the folder has a line with its name.
  const fs::path worlds = fs::path(PLAYPEN_SOURCE_DIR) / "worlds";
  std::map<std::string, std::set<std::string>> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(worlds)) {
    const std::string folder = entry.path().parent_path().filename().string();
    if (entry.path().extension() != ".json" || folder == "schema") continue;
    std::string name = entry.path().stem().string();
    const bool is_task = name.ends_with(".task");
    if (is_task) name.resize(name.size() - 5);
    const std::string kind = is_task ? "tasks" : folder == "models" ? "models" : "worlds";
    EXPECT_TRUE(files[kind].insert(name).second) << name << " is not unique";
  }
  ASSERT_GT(files["worlds"].size(), 30U);
  files["worlds"].insert("default");
  files["models"].insert("s1r");
  for (const char* kind : {"worlds", "tasks", "models"}) {
    const ProcessResult names = playpen({"list", kind, "--names"});
    ASSERT_EQ(names.status, 0) << names.err;
    const std::vector<std::string> listed = lines_of(names.out);
    EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()), files[kind]) << kind;
    EXPECT_EQ(listed.size(), files[kind].size()) << kind;
    const std::string text = playpen({"list", kind}).out;
    for (const std::string& name : listed) {
      EXPECT_THAT(text, testing::ContainsRegex("(^|\n)  " + name + "  +[A-Z]"));
    }
  }
}

TEST(PlaypenList, UnknownKind_Refused) {
  const ProcessResult result = playpen({"list", "robots"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("worlds, tasks or models"), HasSubstr("'robots'")));
}

TEST(PlaypenCheck, KindOfFile_FoundByContent) {
  const TemporaryFolder folder;
  const std::string model = R"({"name": "box", "footprint": [[0, 0], [1, 0], [1, 1], [0, 1]]})";
  folder.write("room.json", room_world());
  const std::string task = folder.write("drive.json", R"({"worlds": ["room.json"], "seeds": 2})");
  const std::string box = folder.write("box.json", model);
  const ProcessResult good = playpen({"check", folder / "room.json", task, box});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_EQ(good.out, folder / "room.json" +
                          std::string(": ok (world: 1 robot, 0 obstacles, 2.00 m x 2.00 m)\n") +
                          task + ": ok (task: worlds room; 2 seeds)\n" + box +
                          ": ok (model: differential drive, 1.00 m x 1.00 m, no devices)\n");

  const std::string bad_task = folder.write("bad.task.json", R"({"worlds": ["none.json"]})");
  const std::string bad_model = folder.write("models/bad.json", R"({"name": "b", "mass": -1})");
  const ProcessResult bad = playpen({"check", bad_task, bad_model});
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("task/unknown-world"), HasSubstr("as a task file"),
                             HasSubstr("/mass"), HasSubstr("as a model file")));
  EXPECT_THAT(bad.out, IsEmpty());
}

TEST(PlaypenCheck, Task_CheckedWithItsWorlds) {
  const TemporaryFolder folder;
  folder.write("room.json", room_world());
  folder.write("bad.json", R"({"robotz": []})");
  const std::string no_robot =
      folder.write("a.task.json", R"({"worlds": ["room.json"], "robot": "r9"})");
  EXPECT_THAT(playpen({"check", no_robot}).err, HasSubstr("r9"));
  const std::string bad_world = folder.write("b.task.json", R"({"worlds": ["bad.json"]})");
  EXPECT_THAT(playpen({"check", bad_world}).err, HasSubstr("robotz"));
}

TEST(PlaypenCheck, AmbiguousName_ChecksAllFiles) {
  const TemporaryFolder folder;
  const ProcessResult result = playpen({"check", "par_intro"}, in(folder));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("(world: "), HasSubstr("(task: ")));
  EXPECT_THAT(playpen({"check", "pioneer2dx"}, in(folder)).out, HasSubstr("(model: "));
}

}  // namespace
