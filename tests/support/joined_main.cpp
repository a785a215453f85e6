// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The main function of a program that contains the tests of several sources
// (docs/decisions/build_time.md).
//
// joined_tests [--source=FILE.cpp]... [GoogleTest's options]
// With --source, only the tests of these files run; each file must contain one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <string_view>

namespace {

/// A GoogleTest filter for the tests of these sources. If a source contains no tests, prints its
/// name to stderr and returns an empty filter.
std::string filter_of(const std::set<std::string>& sources) {
  std::string filter;
  std::set<std::string> missing = sources;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      const std::string source = std::filesystem::path(test.file()).filename().string();
      if (!sources.contains(source)) continue;
      missing.erase(source);
      filter.append(filter.empty() ? "" : ":").append(suite.name()).append(".").append(test.name());
    }
  }
  for (const std::string& source : missing) {
    std::cerr << "there is no test of " << source << " in this program\n";
  }
  return missing.empty() ? filter : "";
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  constexpr std::string_view kOption = "--source=";
  std::set<std::string> sources;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (!argument.starts_with(kOption)) {
      std::cerr << "unknown argument " << argument << "; expected --source=FILE.cpp\n";
      return 2;
    }
    sources.emplace(argument.substr(kOption.size()));
  }
  if (!sources.empty() && GTEST_FLAG_GET(filter) == "*") {
    GTEST_FLAG_SET(filter, filter_of(sources));
    if (GTEST_FLAG_GET(filter).empty()) return 2;
  }
  return RUN_ALL_TESTS();
}
