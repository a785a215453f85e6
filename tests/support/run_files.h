// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "temporary_folder.h"

/// The files that a run leaves in its folder.
namespace test_support {

/// Bytes of files by their paths in a folder.
using Files = std::map<std::string, std::string>;

/// The report of a run, given by its folder.
[[nodiscard]] inline nlohmann::json read_report(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_bytes(folder / "report.json"));
}

/// A report without the values that depend on wall-clock time.
[[nodiscard]] inline nlohmann::json without_wall_time(nlohmann::json report) {
  EXPECT_EQ(report["run"].erase("wall_time"), 1U);
  EXPECT_EQ(report["run"].erase("real_time_factor"), 1U);
  return report;
}

/// Every file of a run. The report is without wall-clock times.
/// @param edit_report  removes more of the report.
[[nodiscard]] inline Files files_of_run(
    const std::filesystem::path& folder,
    const std::function<void(nlohmann::json&)>& edit_report = {}) {
  namespace fs = std::filesystem;
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder).string()] = read_bytes(entry.path());
  }
  nlohmann::json report = without_wall_time(read_report(folder));
  if (edit_report) edit_report(report);
  files["report.json"] = report.dump(1);
  return files;
}

/// Expects the same files with the same bytes.
inline void expect_equal_files(const Files& found, const Files& expected,
                               const std::string& which = {}) {
  EXPECT_EQ(found.at("report.json"), expected.at("report.json")) << which;
  for (const auto& [name, bytes] : expected) {
    // Not EXPECT_EQ, because pictures do not print well.
    EXPECT_TRUE(found.count(name) == 1 && found.at(name) == bytes)
        << which << ": " << name << " differs";
  }
  EXPECT_EQ(found.size(), expected.size()) << which;
}

}  // namespace test_support
