// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/source_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::IsEmpty;

// All entries below a folder, sorted; folders are left out.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) found.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(SourceExport, SourcesInFolders_AreCopiedWithTheirFolders) {
  const TemporaryFolder folder;
  for (const char* name :
       {"ada/main.cc", "ada/src/robot.CPP", "ada/src/robot.hpp", "ada/a.c", "ada/b.cxx", "ada/c.h",
        "ada/d.cpp", "ada/README.md", "ada/robot", "ada/cpp", "bob/main.cc"}) {
    folder.write(name, name);
  }
  const auto exported =
      export_sources({{"ada", folder / "ada"}, {"bob", folder / "bob"}}, folder / "export");
  EXPECT_THAT(files_in(folder / "export"),
              ElementsAre("ada/a.c", "ada/b.cxx", "ada/c.h", "ada/d.cpp", "ada/main.cc",
                          "ada/src/robot.CPP", "ada/src/robot.hpp", "bob/main.cc"));
  ASSERT_EQ(exported.size(), 2U);
  EXPECT_EQ(exported[0].id, "ada");
  EXPECT_EQ(exported[0].files, 7U);
  EXPECT_EQ(exported[0].left_out, 0U);
  std::ifstream copy(folder / "export/ada/src/robot.CPP");
  std::stringstream text;
  text << copy.rdbuf();
  EXPECT_EQ(text.str(), "ada/src/robot.CPP");
}

TEST(SourceExport, Links_AreNotFollowed) {
  const TemporaryFolder folder;
  folder.write("secret/solution.cc", "solution");
  folder.write("ada/main.cc", "ada");
  fs::create_symlink(folder / "secret/solution.cc", folder / "ada/mine.cc");
  fs::create_directory_symlink(folder / "secret", folder / "ada/more");
  fs::create_directory_symlink(folder / "ada", folder / "bob");
  const auto exported =
      export_sources({{"ada", folder / "ada"}, {"bob", folder / "bob"}}, folder / "export");
  EXPECT_THAT(files_in(folder / "export"), ElementsAre("ada/main.cc"));
  EXPECT_EQ(exported[1].files, 0U);
}

TEST(SourceExport, BuildAndHiddenFolders_AreLeftOut) {
  const TemporaryFolder folder;
  folder.write("ada/.git/hook.c", "");
  folder.write("ada/out/CMakeCache.txt", "");
  folder.write("ada/out/generated.cc", "");
  folder.write("ada/CMakeFiles/probe.c", "");
  folder.write("ada/main.cc", "");
  (void)export_sources({{"ada", folder / "ada"}}, folder / "export");
  EXPECT_THAT(files_in(folder / "export"), ElementsAre("ada/main.cc"));
}

TEST(SourceExport, TooManyTooLargeTooDeep_AreLeftOut) {
  const TemporaryFolder folder;
  folder.write("ada/a.cc", "12345");
  folder.write("ada/b.cc", "123456");
  folder.write("ada/c.cc", "");
  folder.write("ada/d.cc", "");
  folder.write("ada/1/2/3/deep.cc", "");
  const auto exported = export_sources({{"ada", folder / "ada"}}, folder / "export",
                                       {.most_files = 2, .most_bytes = 5, .most_depth = 2});
  EXPECT_THAT(files_in(folder / "export"), ElementsAre("ada/a.cc", "ada/c.cc"));
  EXPECT_EQ(exported[0].left_out, 2U);
}

TEST(SourceExport, EarlierExport_IsReplaced) {
  const TemporaryFolder folder;
  folder.write("export/ada/old.cc", "");
  folder.write("ada/main.cc", "");
  (void)export_sources({{"ada", folder / "ada"}}, folder / "export");
  EXPECT_THAT(files_in(folder / "export"), ElementsAre("ada/main.cc"));
}

TEST(SourceExport, MissingFolder_HasNoFiles) {
  const TemporaryFolder folder;
  const auto exported = export_sources({{"ada", folder / "none"}}, folder / "export");
  ASSERT_EQ(exported.size(), 1U);
  EXPECT_EQ(exported[0].files, 0U);
  EXPECT_THAT(files_in(folder / "export"), IsEmpty());
}

TEST(SourceExport, IdThatIsNoName_IsRefused) {
  const TemporaryFolder folder;
  for (const char* id : {"", ".", "..", "a/b", "/tmp"}) {
    EXPECT_THROW((void)export_sources({{id, folder / "ada"}}, folder / "export"),
                 std::invalid_argument)
        << id;
  }
}

}  // namespace
}  // namespace playpen::course
