// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// docs/add_a_device.md uses the compass as its example: its code equals that of the sources, and it
// names every file that the compass changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;

const fs::path kRoot(PLAYPEN_SOURCE_DIR);

std::string page() { return read_bytes(kRoot / "docs/add_a_device.md"); }

bool mentions_compass(const fs::path& file) {
  // Not COMPASS, because Player has a constant of that name.
  static const std::regex kWord("[Cc]ompass");
  return std::regex_search(read_bytes(file), kWord);
}

bool is_of_program(const std::string& file) {
  for (const char* place : {"tests/", "docs/", "worlds/", "CHANGELOG.md"}) {
    if (file.starts_with(place)) return false;
  }
  return true;
}

/// The files in the first column of the page's tables.
std::set<std::string> files_of_page() {
  static const std::regex kRow(R"(^\| `([^`]+)` \|)");
  std::set<std::string> files;
  std::istringstream lines(page());
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kRow)) files.insert(match[1]);
  }
  return files;
}

/// The files of the source tree that mention the compass, except tests, docs and worlds.
std::set<std::string> files_of_program() {
  std::set<std::string> files;
  const auto look_at = [&files](const fs::path& file) {
    const std::string name = fs::relative(file, kRoot).generic_string();
    if (is_of_program(name) && mentions_compass(file)) files.insert(name);
  };
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot)) {
    if (entry.is_regular_file()) look_at(entry.path());
  }
  for (const char* folder : {".ci", "apps", "libplayerlike", "libsim"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.is_regular_file()) look_at(entry.path());
    }
  }
  return files;
}

TEST(AddADevice, NamesEachFileThatTheCompassHasTouched) {
  std::set<std::string> of_program;
  for (const std::string& file : files_of_page()) {
    ASSERT_TRUE(fs::exists(kRoot / file)) << file;
    EXPECT_TRUE(mentions_compass(kRoot / file)) << file;
    if (is_of_program(file)) of_program.insert(file);
  }
  EXPECT_EQ(of_program, files_of_program());
  EXPECT_LE(of_program.size(), 6U);
}

TEST(AddADevice, ShowsTheSourcesAsTheyAre) {
  constexpr std::string_view kMarker = "<!-- from: ";
  constexpr std::string_view kFence = " -->\n```cpp\n";
  const std::string text = page();
  int blocks = 0;
  for (std::size_t at = text.find(kMarker); at != std::string::npos;
       at = text.find(kMarker, at + 1)) {
    const std::size_t name = at + kMarker.size();
    const std::size_t name_end = text.find(kFence, name);
    ASSERT_NE(name_end, std::string::npos);
    const std::size_t code = name_end + kFence.size();
    const std::size_t code_end = text.find("\n```", code);
    const std::string file = text.substr(name, name_end - name);
    EXPECT_THAT(read_bytes(kRoot / file), testing::HasSubstr(text.substr(code, code_end - code)));
    ++blocks;
  }
  EXPECT_GE(blocks, 7);
}

}  // namespace
