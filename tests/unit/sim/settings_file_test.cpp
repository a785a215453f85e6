// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/settings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "temporary_folder.h"

namespace sim::io {
namespace {

using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<ConfigIssue> issues_of(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const ConfigError& error) {
    return error.issues();
  }
  return {};
}

TEST(ReadSettings, Comments_Accepted) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.json", "// why\n{\"n\": 2 /* here */}\n");
  double n = 0.0;
  read_settings(file, "task", [&](Reader& root) {
    n = root.number("n", 0.0);
    EXPECT_EQ(root.file(), file);
    root.finish();
  });
  EXPECT_EQ(n, 2.0);
}

TEST(ReadSettings, Issues_AllThrownInOrderOfLines) {
  const std::vector<ConfigIssue> issues = issues_of([] {
    read_settings_text("{\n\"a\": 1,\n\"n\": \"x\"}", "t.json", "task", [](Reader& root) {
      static_cast<void>(root.number("n", 0.0));
      root.finish();
    });
  });
  ASSERT_THAT(issues, SizeIs(2));
  EXPECT_EQ(issues[0].id, "world/unknown-key");
  EXPECT_EQ(issues[0].line, 2);
  EXPECT_EQ(issues[1].id, "world/wrong-type");
  EXPECT_EQ(issues[1].pointer, "/n");
  EXPECT_EQ(issues[1].file, "t.json");
}

TEST(ReadSettings, Kind_NamedInErrors) {
  const auto nothing = [](Reader&) { FAIL() << "there is nothing to parse"; };
  const TemporaryFolder folder;
  const auto missing = issues_of([&] { read_settings(folder / "no.json", "task", nothing); });
  ASSERT_THAT(missing, SizeIs(1));
  EXPECT_EQ(missing[0].id, "file/missing");
  EXPECT_EQ(missing[0].expected, "a task file");
  const auto empty = issues_of([&] { read_settings_text(" ", "t.json", "task", nothing); });
  ASSERT_THAT(empty, SizeIs(1));
  EXPECT_EQ(empty[0].id, "file/empty");
  EXPECT_EQ(empty[0].expected, "a task");
  const auto more = issues_of([&] { read_settings_text("{} {}", "t.json", "task", nothing); });
  ASSERT_THAT(more, SizeIs(1));
  EXPECT_EQ(more[0].id, "json/trailing-garbage");
  EXPECT_THAT(more[0].hint, HasSubstr("a task file holds one object"));
}

TEST(ReadSettings, LongText_Refused) {
  const auto issues = issues_of([] {
    read_settings_text(std::string((16U << 20U) + 1, ' '), "t.json", "task", [](Reader&) {});
  });
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "file/too-large");
}

}  // namespace
}  // namespace sim::io
