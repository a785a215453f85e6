// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen class` on small classes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Words = std::vector<std::string>;

constexpr const char* kTask = R"({
  "worlds": ["room.json"], "seeds": 2, "duration": 1,
  "thresholds": {"min_path_length": 0.1, "max_collisions": 0}
})";
constexpr const char* kWorld = R"({
  "arena": {"size": [4, 4]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 2}}]
})";
constexpr const char* kDriver = R"(#include <libplayerc++/playerc++.h>
int main() {
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::Position2dProxy base(&robot, 0);
  for (;;) {
    robot.Read();
    base.SetSpeed(0.3, 0.0);
  }
}
)";
// A program that is quickly made, but never connects.
constexpr const char* kMakefile = "robot: ; cp /usr/bin/true robot\n";

/// class.json without what the clock says.
json result_of(const std::string& out) {
  json whole = json::parse(read_bytes(out + "/class.json"));
  for (json& one : whole.at("submissions")) {
    one.at("build").erase("wall_time");
    for (json& task : one.at("tasks")) {
      for (json& run : task.at("runs")) run.erase("wall_time");
    }
  }
  return whole;
}

const json& row_of(const json& whole, const std::string& id) {
  for (const json& one : whole.at("submissions")) {
    if (one.at("id") == id) return one;
  }
  throw std::runtime_error("no row for " + id);
}

class Class : public testing::Test {
 protected:
  Class() {
    folder_.write("task/room.json", kWorld);
    folder_.write("task/drive.task.json", kTask);
  }

  void hand_in(const std::string& file, const std::string& text) {
    folder_.write("handed_in/" + file, text);
  }
  [[nodiscard]] Words call(const std::string& out, const Words& more = {}) const {
    Words words = {"class",         folder_ / "task/drive.task.json",
                   "--submissions", folder_ / "handed_in",
                   "--out",         folder_ / out,
                   "--isolated",    isolation_,
                   "--timeout",     "9999"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] ProcessResult grade(const std::string& out = "out", const Words& more = {}) const {
    ProcessOptions options;
    options.timeout = std::chrono::minutes(20);  // compilers on a busy machine
    return playpen(call(out, more), options);
  }

  TemporaryFolder folder_;
  std::string isolation_ = "best";
};

TEST_F(Class, Submissions_EachHasItsRow) {
  hand_in("ada/main.cc", kDriver);
  hand_in("bob/Makefile", kMakefile);
  hand_in("carl/Makefile", "robot: ; cp /usr/bin/false $(NAME)\n");
  hand_in("dan/Makefile", "all: ; cp /usr/bin/true a; cp /usr/bin/true b\n");
  hand_in("eve/readme.txt", "");
  hand_in("../zed/inner/Makefile", kMakefile);
  ASSERT_EQ(
      std::system(("tar -C " + folder_ / "zed" + " -cf " + folder_ / "handed_in/zed.tar" + " inner")
                      .c_str()),
      0);
  folder_.write("roster.csv", "id,name\nada,Ada Byron\nfay,Fay\n");

  const ProcessResult first = grade("out", {"--roster", folder_ / "roster.csv"});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.err,
              AllOf(HasSubstr("compile: 6 submissions\n"), HasSubstr("drive: 6 runs\n")));
  const json whole = result_of(folder_ / "out");
  const std::string page = read_bytes(folder_ / "out/submissions/bob/index.html");
  EXPECT_THAT(page, HasSubstr("playpen run room --seed"));
  const json& ada = row_of(whole, "ada");
  EXPECT_EQ(ada.at("passed"), 2) << ada << read_bytes(folder_ / "out/submissions/ada/build.log");
  EXPECT_EQ(ada.at("name"), "Ada Byron");
  EXPECT_EQ(ada.at("points"), 100.0);
  EXPECT_EQ(ada.at("most_points"), 100.0);
  for (const char* id : {"bob", "zed"}) {
    EXPECT_THAT(row_of(whole, id).at("reason").get<std::string>(),
                HasSubstr("the program never connected"));
  }
  EXPECT_EQ(row_of(whole, "carl").at("reason"), "does not compile");
  EXPECT_EQ(row_of(whole, "dan").at("reason"), "compiles to several programs: a, b");
  EXPECT_EQ(row_of(whole, "fay").at("reason"), "nothing was handed in");
  EXPECT_THAT(read_bytes(folder_ / "out/submissions/eve/build.log"),
              HasSubstr("neither CMakeLists.txt, nor a makefile, nor sources"));
  EXPECT_THAT(first.out, HasSubstr("7 submissions, 3 compiled, 1 passed all runs\n"));
  EXPECT_THAT(read_bytes(folder_ / "out/index.html"),
              AllOf(HasSubstr("href=\"submissions/ada/index.html\""),
                    HasSubstr("<b>7</b> submissions</li><li><b>3</b> compile")));
  EXPECT_THAT(read_bytes(folder_ / "out/submissions/ada/index.html"),
              HasSubstr("src=\"drive/room_seed1/scene.png\""));
  for (const char* file : {"results.csv", "junit.xml", "submissions/ada/results.json",
                           "submissions/ada/drive/room_seed1/trajectory.csv"}) {
    EXPECT_TRUE(fs::exists(folder_ / "out/" + file)) << file;
  }

  // The second time nothing is done; and what is new is done alone.
  const ProcessResult second = grade("out", {"--roster", folder_ / "roster.csv"});
  EXPECT_THAT(second.err, AllOf(HasSubstr("compile: 0 submissions, 6 known from before\n"),
                                HasSubstr("drive: 0 runs, 6 known from before\n")));
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(result_of(folder_ / "out"), whole);
  EXPECT_EQ(read_bytes(folder_ / "out/submissions/bob/index.html"), page);
  hand_in("dan/Makefile", kMakefile);
  const ProcessResult third = grade("out", {"--roster", folder_ / "roster.csv"});
  EXPECT_THAT(third.err, AllOf(HasSubstr("compile: 1 submissions, 5 known from before\n"),
                               HasSubstr("drive: 2 runs, 6 known from before\n")));
}

TEST_F(Class, Plots_DrawnOnceAndAgainIfStale) {
  hand_in("ada/Makefile", "robot: ; cp driver robot\n");
  fs::copy_file(DRIVING_PROGRAM, folder_.path() / "handed_in/ada/driver");
  hand_in("bob/Makefile", kMakefile);
  const fs::path submission = folder_.path() / "out/submissions/ada";
  const fs::path run = submission / "drive/room_seed1";
  const auto drawn = [&run] { return fs::last_write_time(run / "plot.png"); };
  const auto page = [&submission] { return read_bytes(submission / "index.html"); };
  constexpr const char* kShown = "src=\"drive/room_seed1/plot.png\"";
  constexpr const char* kDrawn = "plots: 1 runs\n";

  // Both runs are equally good, so one is shown; the run without a trajectory has no plot.
  const ProcessResult first = grade();
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.err, HasSubstr(kDrawn)) << read_bytes(run / "program.log");
  EXPECT_THAT(read_bytes(run / "plot.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(page(), HasSubstr(kShown));
  EXPECT_FALSE(fs::exists(folder_ / "out/submissions/bob/drive/room_seed1/plot.png"));
  const auto before = drawn();
  EXPECT_THAT(grade().err, Not(HasSubstr("plots:")));
  EXPECT_EQ(drawn(), before);
  constexpr const char* kReplayed = "href=\"drive/room_seed1/replay.html\"";
  EXPECT_THAT(page(), Not(HasSubstr(kReplayed)));
  ASSERT_EQ(grade("out", {"--replays"}).status, 0);
  EXPECT_THAT(page(), HasSubstr(kReplayed));
  EXPECT_THAT(read_bytes(run / "replay.html"), StartsWith("<!DOCTYPE html>"));
  EXPECT_EQ(drawn(), before);

  // Older than the results of its run, as after a run that was run again; or a link.
  fs::last_write_time(run / "plot.png", fs::last_write_time(run / "report.json"));
  EXPECT_THAT(grade().err, HasSubstr(kDrawn));
  EXPECT_GT(drawn(), fs::last_write_time(run / "report.json"));
  const std::string secret = folder_.write("secret", "not to be overwritten");
  fs::remove(run / "plot.png");
  fs::create_symlink(secret, run / "plot.png");
  EXPECT_THAT(grade().err, HasSubstr(kDrawn));
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(run / "plot.png")));
  EXPECT_EQ(read_bytes(secret), "not to be overwritten");

  // Results that no simulation has written do not stop the report.
  const std::string row = ",r1,1e300,-1e300,1e300,1e300,-1e300,0\n";
  for (const std::string& rows : {"0" + row + "1" + row, std::string("no rows")}) {
    folder_.write("out/submissions/ada/drive/room_seed1/trajectory.csv",
                  "time,robot,x,y,yaw,v,omega,stalled\n" + rows + "\n");
    const ProcessResult result = grade();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr(kDrawn));
    EXPECT_EQ(fs::exists(run / "plot.png"), page().find(kShown) != std::string::npos);
    EXPECT_FALSE(fs::exists(run / "plot.part.png"));
  }
  EXPECT_FALSE(fs::exists(run / "plot.png"));
}

TEST_F(Class, SourcesInC_MayUseMathLibrary) {
  // Neither the compiler nor the linker adds it to a program in C.
  hand_in("ada/main.c",
          "#include <math.h>\n#include <stdlib.h>\n"
          "int main(void) { return (int)sin(atof(getenv(\"HOME\"))); }\n");
  ASSERT_EQ(grade().status, 0);
  EXPECT_EQ(row_of(result_of(folder_ / "out"), "ada").at("build").at("built"), true)
      << read_bytes(folder_ / "out/submissions/ada/build.log");
}

TEST_F(Class, Killed_GoesOnToTheSameResult) {
  for (const char* id : {"a", "b", "c", "d"}) hand_in(std::string(id) + "/Makefile", kMakefile);
  ASSERT_EQ(grade("whole", {"--seeds", "3"}).status, 0);
  const auto records = [this] {
    std::size_t count = 0;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder_ / "killed", error), end;
         !error && entry != end; entry.increment(error)) {
      count +=
          entry->path().parent_path().filename() == "drive" && entry->path().extension() == ".json"
              ? 1
              : 0;
    }
    return count;
  };
  for (const std::size_t at : {std::size_t{2}, std::size_t{6}}) {
    Words words = call("killed", {"--seeds", "3"});
    words.insert(words.begin(), PLAYPEN_COMMAND);
    test_support::Process process(words);
    while (records() < at) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    process.send_signal(SIGKILL);
    static_cast<void>(process.finish());
  }
  const ProcessResult last = grade("killed", {"--seeds", "3"});
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("known from before"));
  EXPECT_EQ(result_of(folder_ / "killed"), result_of(folder_ / "whole"));
}

TEST_F(Class, Individual_DerivedFromIdAlone) {
  for (const char* id : {"ada", "bob"}) hand_in(std::string(id) + "/Makefile", kMakefile);
  ASSERT_EQ(grade("out", {"--individual"}).status, 0);
  const json whole = result_of(folder_ / "out");
  const json& ada = row_of(whole, "ada");
  EXPECT_THAT(ada.at("note").get<std::string>(), HasSubstr("start at"));
  EXPECT_NE(ada.at("note"), row_of(whole, "bob").at("note"));
  EXPECT_THAT(read_bytes(folder_ / "out/submissions/ada/index.html"),
              HasSubstr("playpen run conditions/drive/room.json --seed"));
  const auto world_of = [this](const std::string& out, const std::string& id) {
    return read_bytes(folder_ / out + "/submissions/" + id + "/conditions/drive/room.json");
  };
  EXPECT_NE(world_of("out", "ada"), world_of("out", "bob"));
  // At home, with another name of the folder.
  folder_.write("home/Makefile", kMakefile);
  const ProcessResult result =
      playpen({"class", folder_ / "task/drive.task.json", "--submission", folder_ / "home", "--id",
               "ada", "--individual", "--out", folder_ / "own", "--isolated", "best"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(world_of("own", "ada"), world_of("out", "ada"));
  EXPECT_EQ(row_of(result_of(folder_ / "own"), "ada").at("note"), ada.at("note"));
}

TEST_F(Class, HostileBuild_ReachesNothing) {
  folder_.write("secret", "what only the teacher knows");
  const std::string mark = folder_ / "mark";
  hand_in("eve/Makefile", "robot:\n\t-cat " + folder_ / "secret" + "\n\t-touch " + mark +
                              "\n\t-touch ../../../../mark\n\t-ls " + folder_ / "handed_in" +
                              "\n\t-ls ../..\n\tln -s / root\n\tcp /usr/bin/true robot\n");
  hand_in("ada/Makefile", kMakefile);
  isolation_ = "required";
  const ProcessResult result = grade();
  if (result.err.find("cannot be isolated") != std::string::npos) GTEST_SKIP() << result.err;
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string log = read_bytes(folder_ / "out/submissions/eve/build.log");
  EXPECT_THAT(log, AllOf(Not(HasSubstr("only the teacher")), Not(HasSubstr("ada"))));
  EXPECT_FALSE(fs::exists(mark));
  EXPECT_FALSE(fs::exists(folder_ / "out/mark"));
  const json whole = result_of(folder_ / "out");
  EXPECT_EQ(row_of(whole, "ada").at("build").at("built"), true);
  EXPECT_EQ(row_of(whole, "eve").at("build").at("program"), "build/source/robot");
}

TEST_F(Class, BuildThatLocksItsFolder_CanBeRepeated) {
  hand_in("eve/Makefile",
          "robot:\n\tmkdir -p a/b/c\n\tchmod 000 a/b\n\tchmod 000 a\n\tchmod 555 .\n");
  ASSERT_EQ(grade().status, 0);
  hand_in("eve/Makefile", kMakefile);
  const ProcessResult result = grade();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(row_of(result_of(folder_ / "out"), "eve").at("build").at("built"), true);
}

TEST_F(Class, BuildThatFillsDisk_IsEndedAndRemoved) {
  hand_in("eve/Makefile",
          "robot:\n\tfor i in 1 2 3 4 5 6 7 8 9 10; do head -c 60000000 /dev/zero > $$i; done\n"
          "\tsleep 1000000\n");
  ASSERT_EQ(grade().status, 0);
  EXPECT_EQ(row_of(result_of(folder_ / "out"), "eve").at("reason"),
            "compiling wrote more than 500 MB");
  EXPECT_FALSE(fs::exists(folder_ / "out/submissions/eve/build/source/1"));
}

TEST_F(Class, BuildWithoutEnd_IsEnded) {
  hand_in("ada/Makefile", "robot: ; sleep 1000000\n");
  const ProcessResult result = grade("out", {"--build-timeout", "0.5"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(row_of(result_of(folder_ / "out"), "ada").at("reason"),
            "compiling took more than 0.5 s");
}

/// A file of a page: the fenced block after the comment that names it.
std::string file_of_page(const std::string& page, const std::string& name) {
  const std::string text = read_bytes(std::string(PLAYPEN_SOURCE_DIR) + "/docs/" + page);
  const std::size_t mark = text.find("<!-- file: " + name + " -->\n```");
  if (mark == std::string::npos) throw std::runtime_error("no file " + name);
  const std::size_t begin = text.find('\n', text.find("```", mark)) + 1;
  return text.substr(begin, text.find("```", begin) - begin);
}

class Services : public Class {
 protected:
  /// Runs a script of the page, whose task is replaced by that of the test.
  ProcessResult run_script(const std::string& name, const Words& arguments,
                           std::map<std::string, std::string> variables, const std::string& in) {
    std::string text = file_of_page("grading_on_push.md", name);
    const std::string task = "par_intro";
    if (const std::size_t at = text.find(task); at != std::string::npos) {
      text.replace(at, task.size(), folder_ / "task/drive.task.json");
    }
    folder_.write(name, text);
    variables["PATH"] =
        fs::path(PLAYPEN_COMMAND).parent_path().string() + ":" + std::getenv("PATH");
    ProcessOptions options;
    options.environment = variables;
    options.folder = in;
    options.timeout = std::chrono::minutes(20);
    Words words = {"/bin/sh", folder_ / name};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return test_support::run_process(words, options);
  }
};

TEST_F(Services, Push_FailsUnlessAllRunsPass) {
  folder_.write("repository/Makefile", kMakefile);
  for (int i = 0; i < 2; ++i) {  // the second time its results are in the folder
    const ProcessResult result =
        run_script("grade.sh", {folder_ / "task/drive.task.json"}, {}, folder_ / "repository");
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_THAT(result.err,
                HasSubstr(i == 0 ? "compile: 1 submissions\n" : "compile: 0 submissions, 1 known"));
    EXPECT_THAT(result.out, HasSubstr("the program never connected"));
  }
  EXPECT_TRUE(fs::exists(folder_ / "repository/graded/junit.xml"));
}

TEST_F(Services, Gradescope_GetsItsFile) {
  folder_.write("autograder/submission/Makefile", kMakefile);
  folder_.write("autograder/results/.keep", "");
  const ProcessResult result =
      run_script("run_autograder", {}, {{"AUTOGRADER", folder_ / "autograder"}}, folder_.path());
  EXPECT_EQ(result.status, 0) << result.err;
  const json results = json::parse(read_bytes(folder_ / "autograder/results/results.json"));
  EXPECT_EQ(results.at("score"), 0.0);
  EXPECT_EQ(results.at("tests").size(), 3U);
  EXPECT_EQ(results.at("tests").at(1).at("status"), "failed");
}

TEST_F(Class, BadInput_Said) {
  EXPECT_THAT(grade().err, HasSubstr("expected a folder with submissions, found"));
  hand_in("notes.txt", "");
  EXPECT_THAT(grade().err, HasSubstr("expected a folder or an archive for each submission"));
  hand_in("ada/Makefile", kMakefile);
  folder_.write("roster.csv", "name\n");
  EXPECT_THAT(playpen({"class", "par_intro", "--out", folder_ / "out"}).err,
              HasSubstr("--submissions or --submission"));
  const ProcessResult result = grade("out", {"--roster", folder_ / "roster.csv"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("no column \"id\""));
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is done before all input is good";
}

}  // namespace
