// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/trajectory.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "sim/core/file.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHeader = "time,robot,x,y,yaw,v,omega,stalled";
constexpr std::size_t kMostTrajectoryBytes = std::size_t{1} << 30U;

std::string trajectory_text(const fs::path& file) {
  sim::FileLimits limits;
  limits.most_bytes = kMostTrajectoryBytes;
  std::string text;
  if (const auto problem = sim::read_whole_file(file.string(), limits, text)) {
    throw std::runtime_error("cannot read " + file.string() + ": found " + problem->found);
  }
  return text;
}

[[noreturn]] void refuse_row(const fs::path& file, std::size_t line, std::string_view found) {
  constexpr std::size_t kMostShown = 60;
  throw std::runtime_error(file.string() + ", line " + std::to_string(line) + ": expected " +
                           std::string(kHeader) + ", found '" +
                           std::string(found.substr(0, kMostShown)) + "'");
}

bool read_number(std::string_view word, double& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

Trajectory& of_robot(std::vector<Trajectory>& all, std::string_view robot) {
  for (Trajectory& one : all) {
    if (one.robot == robot) return one;
  }
  all.emplace_back().robot = robot;
  return all.back();
}

// Number of columns of a header; 0: it is no header of a trajectory. Columns of mirrored robots may
// follow the usual ones.
std::size_t columns_of(std::string_view header) {
  if (!header.starts_with(kHeader)) return 0;
  const std::string_view rest = header.substr(kHeader.size());
  if (!rest.empty() && rest.front() != ',') return 0;
  return 1 + static_cast<std::size_t>(std::count(header.begin(), header.end(), ','));
}

// Appends a row to the trajectory of its robot. @return whether the row is valid.
bool add_row(std::vector<Trajectory>& all, std::string_view row, std::size_t columns) {
  constexpr std::size_t kRowWords = 8;
  std::array<std::string_view, kRowWords> words;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin <= row.size(); ++count) {
    if (count == columns) return false;
    const std::size_t end = std::min(row.find(',', begin), row.size());
    if (count < kRowWords) words.at(count) = row.substr(begin, end - begin);
    begin = end + 1;
  }
  if (count != columns || words[1].empty()) return false;
  std::array<double, kRowWords> numbers{};
  for (const std::size_t i : std::initializer_list<std::size_t>{0, 2, 3, 4, 5, 6, 7}) {
    if (!read_number(words.at(i), numbers.at(i))) return false;
  }
  Trajectory& one = of_robot(all, words[1]);
  if (!one.time_s.empty() && numbers[0] < one.time_s.back()) return false;
  one.time_s.push_back(numbers[0]);
  one.X_WB.push_back({numbers[2], numbers[3], numbers[4]});
  one.v_mps.push_back(numbers[5]);
  one.omega_radps.push_back(numbers[6]);
  return true;
}

}  // namespace

std::vector<Trajectory> read_trajectories(const std::filesystem::path& file) {
  const std::string text = trajectory_text(file);
  std::vector<Trajectory> all;
  std::size_t line = 0;
  std::size_t columns = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view row = std::string_view(text).substr(begin, end - begin);
    // If the program crashed, the last row may be incomplete.
    const bool is_whole = end < text.size();
    begin = end + 1;
    ++line;
    if (line == 1) {
      columns = columns_of(row);
      if (columns == 0) refuse_row(file, line, row);
    } else if (is_whole && !add_row(all, row, columns)) {
      refuse_row(file, line, row);
    }
  }
  if (all.empty()) {
    throw std::runtime_error(file.string() + ": expected rows of robots, found none");
  }
  return all;
}

}  // namespace playpen::grade
