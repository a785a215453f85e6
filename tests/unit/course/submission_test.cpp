// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/submission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "course/build.h"
#include "sim/core/error.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace playpen::course;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string message_of(const std::string& roster) {
  try {
    static_cast<void>(read_roster_text(roster, "roster.csv"));
  } catch (const sim::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Roster, Columns_AnyOrderSeparatorAndQuotes) {
  const std::vector<Person> people = read_roster_text(
      "\xEF\xBB\xBFName;Group;ID\r\n\"Byron; Ada\";1; 4711\r\n\r\n\"a \"\"b\"\"\nc\";;7", "r.csv");
  ASSERT_EQ(people.size(), 2U);
  EXPECT_EQ(people[0].id, "4711");
  EXPECT_EQ(people[0].name, "Byron; Ada");
  EXPECT_EQ(people[1].id, "7");
  EXPECT_EQ(people[1].name, "a \"b\"\nc");
}

TEST(Roster, Bad_SaysFileAndLine) {
  EXPECT_THAT(message_of(""), HasSubstr("roster.csv:1: expected a first line"));
  EXPECT_THAT(message_of("name\nx"), HasSubstr("found no column \"id\""));
  EXPECT_THAT(message_of("id,name\n1,a\n,b\n"), HasSubstr("roster.csv:3: expected an id"));
  EXPECT_THAT(message_of("id,name\n1,\"a\nb\"\n1,c\n"),
              HasSubstr("roster.csv:4: expected different ids, found '1', which line 2 has"));
  EXPECT_THROW(static_cast<void>(read_roster("/no/such/roster.csv")), sim::ConfigError);
}

class Submissions : public testing::Test {
 protected:
  std::vector<std::string> ids(const std::vector<Person>& roster = {}) {
    std::vector<std::string> result;
    for (const Submission& one : find_submissions(folder_.path(), roster)) {
      result.push_back(one.person.id + (one.place.empty() ? " missing" : "") +
                       (one.is_archive ? " archive" : ""));
    }
    return result;
  }
  TemporaryFolder folder_;
};

TEST_F(Submissions, Entries_FoldersAndArchives) {
  folder_.write("bob/main.cpp", "");
  folder_.write("ada.zip", "");
  folder_.write("carl.tar.gz", "");
  folder_.write("notes.txt", "");
  folder_.write(".hidden/main.cpp", "");
  fs::create_directory_symlink(folder_.path(), folder_.path() / "link");
  EXPECT_THAT(ids(), ElementsAre("ada archive", "bob", "carl archive"));
}

TEST_F(Submissions, Roster_NamesMatchedByWord) {
  folder_.write("Ada_Byron_4711_file/main.cpp", "");
  folder_.write("14711/main.cpp", "");
  const std::vector<Person> roster = {{"4711", "Ada"}, {"99", "Bob"}};
  EXPECT_THAT(ids(roster), ElementsAre("14711", "4711", "99 missing"));
  folder_.write("4711.zip", "");
  EXPECT_THROW(static_cast<void>(ids(roster)), sim::ConfigError) << "two submissions of one person";
}

TEST_F(Submissions, None_Error) {
  EXPECT_THROW(static_cast<void>(ids()), sim::ConfigError);
  EXPECT_THROW(static_cast<void>(find_submissions(folder_ / "missing", {})), sim::ConfigError);
}

TEST_F(Submissions, Folders_GoodForPathsAndDifferent) {
  for (const char* name : {"a b", "a_b", "A<b", ".."}) {
    if (std::string(name) != "..") folder_.write(std::string(name) + "/x.c", "");
  }
  std::vector<std::string> folders;
  for (const Submission& one : find_submissions(folder_.path(), {{"..", ""}, {"../x", ""}})) {
    folders.push_back(one.folder);
  }
  EXPECT_THAT(folders, ElementsAre("_.", "_._x", "A_b", "a_b_2", "a_b_3"));
}

TEST_F(Submissions, Fingerprint_DependsOnNamesAndContentOnly) {
  const auto fingerprint = [this] {
    return fingerprint_of(find_submissions(folder_.path(), {}).front());
  };
  folder_.write("ada/main.cpp", "int x;");
  const std::string first = fingerprint();
  folder_.write("ada/main.cpp", "int x;");
  fs::create_symlink("/etc/passwd", folder_.path() / "ada/link.h");
  EXPECT_EQ(fingerprint(), first);
  folder_.write("ada/main.cpp", "int y;");
  EXPECT_NE(fingerprint(), first);
  folder_.write("ada/main.cpp", "int x;");
  fs::rename(folder_.path() / "ada/main.cpp", folder_.path() / "ada/robot.cpp");
  EXPECT_NE(fingerprint(), first);
}

TEST_F(Submissions, Copy_WithoutLinksAndGit) {
  folder_.write("ada/src/main.cpp", "int x;");
  folder_.write("ada/.git/config", "");
  fs::create_symlink("/etc/passwd", folder_.path() / "ada/link.h");
  EXPECT_EQ(copy_sources(one_submission(folder_ / "ada", "", ""), folder_.path() / "copy"), "");
  EXPECT_TRUE(fs::exists(folder_.path() / "copy/src/main.cpp"));
  EXPECT_FALSE(fs::exists(folder_.path() / "copy/.git"));
  EXPECT_FALSE(fs::exists(fs::symlink_status(folder_.path() / "copy/link.h")));
}

TEST_F(Submissions, Copy_TooLargeIsSaid) {
  folder_.write("ada/data", "");
  fs::resize_file(folder_.path() / "ada/data", kMostSubmittedBytes + 1);  // without blocks
  EXPECT_THAT(copy_sources(one_submission(folder_ / "ada", "", ""), folder_.path() / "copy"),
              HasSubstr("more than 100 MB"));
}

TEST_F(Submissions, One_FolderOrArchiveWithoutResults) {
  folder_.write("ada/main.cpp", "int x;");
  folder_.write("ada/out/log", "");
  folder_.write("x.zip", "");
  const Submission ada = one_submission(folder_ / "ada/.", "", folder_ / "ada/out");
  EXPECT_EQ(ada.person.id, "ada");
  EXPECT_EQ(copy_sources(ada, folder_.path() / "copy"), "");
  EXPECT_FALSE(fs::exists(folder_.path() / "copy/out"));
  const std::string fingerprint = fingerprint_of(ada);
  folder_.write("ada/out/log", "more");
  EXPECT_EQ(fingerprint_of(ada), fingerprint);
  EXPECT_TRUE(one_submission(folder_ / "x.zip", "", "").is_archive);
  EXPECT_EQ(one_submission(folder_ / "x.zip", "4711", "").person.id, "4711");
  for (const char* name : {"missing", "ada/main.cpp"}) {
    EXPECT_THROW(static_cast<void>(one_submission(folder_ / name, "", "")), sim::ConfigError);
  }
}

TEST_F(Submissions, Programs_NewOnesOfThisMachine) {
  const fs::path program = fs::canonical("/proc/self/exe");
  const auto put = [&](const std::string& name) {
    fs::create_directories((folder_.path() / name).parent_path());
    fs::copy_file(program, folder_.path() / name);
  };
  put("build/robot");
  put("build/CMakeFiles/3.22/a.out");
  put("build/libx.so");
  put("old");
  folder_.write("script", "#!/bin/sh\n");
  fs::permissions(folder_.path() / "script", fs::perms::owner_all);
  fs::create_symlink(program, folder_.path() / "link");
  const auto start = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(folder_.path() / "old", start - std::chrono::hours(1));
  EXPECT_THAT(find_programs(folder_.path(), start), ElementsAre("build/robot"));
  EXPECT_THAT(find_programs(folder_ / "missing", start), IsEmpty());
}

}  // namespace
