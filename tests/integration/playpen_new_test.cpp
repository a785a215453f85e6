// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen new` and `playpen doctor` of the build folder. The test builds projects by the commands
// that `playpen new` prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::kOnlyNightly;
using test_support::nightly;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Options for a folder, with enough time for a compiler on a busy machine.
ProcessOptions in(const std::string& folder) {
  ProcessOptions options;
  options.folder = folder;
  options.timeout = std::chrono::minutes(20);
  options.environment["CXX"] = CXX_COMPILER;
  return options;
}

/// The commands in the output of `playpen new`: its indented lines.
std::vector<std::string> commands_of(const std::string& text) {
  std::vector<std::string> commands;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("  ")) commands.push_back(line.substr(2));
  }
  return commands;
}

/// Makes a project in "my robot" of a folder.
/// @return the printed commands.
std::vector<std::string> make_project(const std::string& kind, const TemporaryFolder& folder) {
  const ProcessResult made = playpen({"new", kind, "my robot"}, in(folder / "."));
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(fs::exists(folder / "my robot/README.md"));
  std::vector<std::string> commands = commands_of(made.out);
  EXPECT_EQ(commands.size(), kind == "client" || kind == "test" ? 3U : 4U) << made.out;
  return commands;
}

/// Makes a project and executes the printed commands, except for grading.
void build_and_run(const std::string& kind, const std::string& result) {
  const TemporaryFolder folder;
  const ProcessOptions options = in(folder / ".");
  const std::vector<std::string> commands = make_project(kind, folder);
  ASSERT_GE(commands.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const ProcessResult step = run_process({"sh", "-c", commands[i]}, options);
    ASSERT_EQ(step.status, 0) << commands[i] << '\n' << step.out << step.err;
  }
  EXPECT_TRUE(fs::exists(folder / result)) << result;
}

// Each project, without its build, which takes a compiler some seconds.
TEST(PlaypenNew, MakesEachKindOfProject) {
  for (const std::string task : {"intro", "planning", "exploration", "traps",
                                 "exploration_changing", "chase", "localization"}) {
    SCOPED_TRACE(task);
    const TemporaryFolder folder;
    make_project(task, folder);
    const fs::path source = PLAYPEN_SOURCE_DIR "/apps/par_" + task + "/template";
    for (const auto& file : fs::directory_iterator(source)) {
      EXPECT_TRUE(fs::exists(folder / "my robot" / file.path().filename())) << file.path();
    }
  }
}

TEST(PlaypenNew, IntroTemplate_BuildsAndRuns) {
  build_and_run("intro", "out/par_intro/report.json");
}

// The templates of the tasks differ in their sources only, which the tests ..._template_filled
// compile. So a merge builds one of them, and the client.
TEST(PlaypenNew, PlanningTemplate_BuildsAndRuns) {
  if (!nightly()) GTEST_SKIP() << kOnlyNightly;
  // The template plans nothing and therefore fails; the test only checks that it was built.
  const TemporaryFolder folder;
  const ProcessOptions options = in(folder / ".");
  ASSERT_EQ(playpen({"new", "planning", "p"}, options).status, 0);
  ASSERT_EQ(run_process({"cmake", "-S", "p", "-B", "p/build"}, options).status, 0);
  const ProcessResult built = run_process({"cmake", "--build", "p/build"}, options);
  EXPECT_EQ(built.status, 0) << built.out << built.err;
  EXPECT_TRUE(fs::exists(folder / "p/build/par_planning_template"));
}

TEST(PlaypenNew, ExplorationTemplate_BuildsAndRuns) {
  if (!nightly()) GTEST_SKIP() << kOnlyNightly;
  build_and_run("exploration", "out/par_exploration/report.json");
}

TEST(PlaypenNew, TrapsTemplate_BuildsAndRuns) {
  if (!nightly()) GTEST_SKIP() << kOnlyNightly;
  build_and_run("traps", "out/par_traps/report.json");
}

TEST(PlaypenNew, ChangingArenaTemplates_BuildAndRun) {
  if (!nightly()) GTEST_SKIP() << kOnlyNightly;
  build_and_run("exploration_changing", "out/par_exploration_changing/report.json");
  build_and_run("chase", "out/par_chase/report.json");
  build_and_run("localization", "out/par_localization/report.json");
}

TEST(PlaypenNew, TestTemplate_HasFilesForCi) {
  const TemporaryFolder folder;
  const std::vector<std::string> commands = make_project("test", folder);
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_THAT(commands[2], HasSubstr("ctest --test-dir 'my robot/build'"));
  EXPECT_TRUE(fs::exists(folder / "my robot/.github/workflows/tests.yml"));
  EXPECT_TRUE(fs::exists(folder / "my robot/.gitlab-ci.yml"));
  EXPECT_THAT(read_bytes(folder / "my robot/CMakeLists.txt"),
              ContainsRegex("REQUIRED HINTS \".+\" COMPONENTS testing"));
  EXPECT_THAT(read_bytes(folder / "my robot/.vscode/tasks.json"), HasSubstr("\"ctest\""));
}

TEST(PlaypenNew, Client_BuildsAndDrives) { build_and_run("client", "out/cave/report.json"); }

TEST(PlaypenNew, PrintsNextCommandsForTask) {
  const TemporaryFolder folder;
  const ProcessResult made = playpen({"new", "planning", "p"}, in(folder / "."));
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("cmake -S p -B p/build"),
                              HasSubstr("run par_planning -- p/build/par_planning_template"),
                              HasSubstr("grade par_planning -- p/build/par_planning_template"),
                              HasSubstr("p/README.md")));
  // Build results in the source tree are not copied.
  EXPECT_FALSE(fs::exists(folder / "p/build"));
}

TEST(PlaypenNew, ExistingFiles_Kept) {
  const TemporaryFolder folder;
  const std::string mine = folder.write("full/robot.cc", "int mine;");
  const ProcessResult full = playpen({"new", "intro", folder / "full"});
  EXPECT_EQ(full.status, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("not empty"), HasSubstr("full")));
  EXPECT_EQ(read_bytes(mine), "int mine;");
  EXPECT_FALSE(fs::exists(folder / "full/CMakeLists.txt"));

  const ProcessResult file = playpen({"new", "intro", mine});
  EXPECT_EQ(file.status, 2);
  EXPECT_THAT(file.err, HasSubstr("is a file"));

  fs::create_directory(folder / "empty");
  EXPECT_EQ(playpen({"new", "intro", folder / "empty"}).status, 0);
  EXPECT_EQ(playpen({"new", "intro", folder / "a/b/c"}).status, 0);
}

TEST(PlaypenNew, MissingTemplates_ErrorSaysWhatIsMissing) {
  const TemporaryFolder prefix;
  const std::string command = prefix.write("bin/playpen", "");
  fs::copy_file(PLAYPEN_COMMAND, command, fs::copy_options::overwrite_existing);
  fs::permissions(command, fs::perms::owner_all);
  const ProcessResult result = run_process({command, "new", "client", prefix / "robot"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("share/playpen/templates/client"), HasSubstr("install Playpen")));
}

TEST(PlaypenDoctor, WorkingSystem_Passes) {
  const TemporaryFolder folder;
  ProcessOptions options = in(folder / ".");
  options.environment["DISPLAY"] = "";
  options.environment["WAYLAND_DISPLAY"] = "";
  const ProcessResult result = playpen({"doctor"}, options);
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("playpen " PLAYPEN_VERSION), HasSubstr("Runs work."),
            HasSubstr("read a laser in the default world"),
            HasSubstr("configured and built by CMake"), HasSubstr("Films"), HasSubstr("Core dumps"),
            HasSubstr("the last bits are as everywhere"), Not(HasSubstr("BROKEN"))));
  EXPECT_THAT(result.out, ContainsRegex("WARN +there is no display"));
  EXPECT_THAT(result.out, HasSubstr("--record film.mp4"));
  EXPECT_TRUE(fs::is_empty(folder / ".")) << "it leaves something behind";
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    // Only an unbreakable path may make a line longer.
    const bool is_one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
    EXPECT_TRUE(line.size() <= 80 || is_one_word) << line;
  }
}

/// doctor's output with these variables. There is no compiler, because building takes time.
ProcessResult doctor_with(const std::map<std::string, std::string>& environment) {
  ProcessOptions options;
  options.environment = environment;
  options.environment["CXX"] = "no-such-compiler";
  return playpen({"doctor"}, options);
}

TEST(PlaypenDoctor, VariablesAndInvalidDisplay_Reported) {
  const ProcessResult result = doctor_with({{"DISPLAY", ":4321"},
                                            {"PLAYPEN_SEED", "seven"},
                                            {"PLAYPEN_WROLD", "cave.json"},
                                            {"PLAYPEN_ENCODING", "json"}});
  EXPECT_EQ(result.status, 0) << result.out;  // a run sets PLAYPEN_SEED itself
  EXPECT_THAT(result.out, ContainsRegex("WARN +the display :4321"));
  EXPECT_THAT(result.out, ContainsRegex("WARN +PLAYPEN_SEED"));
  EXPECT_THAT(result.out, ContainsRegex("note +PLAYPEN_ENCODING=json"));
  EXPECT_THAT(result.out, ContainsRegex("WARN +PLAYPEN_WROLD"));
  EXPECT_THAT(result.out, HasSubstr("did you mean PLAYPEN_WORLD?"));
  EXPECT_THAT(result.out, AllOf(ContainsRegex("WARN +C\\+\\+ compiler: none"),
                                HasSubstr("sudo apt install g++")));
}

TEST(PlaypenDoctor, WithoutToolsOfAClass_NamesTheirPackages) {
  const TemporaryFolder empty;
  const ProcessResult result = doctor_with({{"PATH", empty / "."}, {"CC", ""}});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(
      result.out,
      AllOf(ContainsRegex("WARN +bsdtar, for submissions that are archives: none"),
            HasSubstr("sudo apt install libarchive-tools"), ContainsRegex("WARN +C compiler: none"),
            ContainsRegex("WARN +submissions do not compile: no CMake"),
            HasSubstr("sudo apt install cmake")));
}

TEST(PlaypenDoctor, BrokenSystem_Fails) {
  const TemporaryFolder prefix;
  const std::string command = prefix.write("bin/playpen", "");
  fs::copy_file(PLAYPEN_COMMAND, command, fs::copy_options::overwrite_existing);
  fs::permissions(command, fs::perms::owner_all);
  ProcessOptions options;
  options.environment["CXX"] = "no-such-compiler";
  const ProcessResult result = run_process({command, "doctor"}, options);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out,
              AllOf(ContainsRegex("BROKEN +the folder of worlds"),
                    ContainsRegex("BROKEN +the library that makes sleeps"),
                    ContainsRegex("WARN +--view lacks"), ContainsRegex("WARN +'playpen new' lacks"),
                    HasSubstr("Runs do not work")));
}

}  // namespace
