// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/text_map.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <vector>

namespace par {
namespace {

constexpr int kMaxSide = 8192;

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw MapError(name + ":" + std::to_string(line) + ": " + what);
}

/// A piece of the file for an error message: quoted, shortened, printable ASCII only.
std::string quoted(const std::string& text) {
  constexpr std::size_t kMost = 20;
  std::string shown = "\"";
  for (const char c : text.substr(0, kMost)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > kMost ? "...\"" : "\"");
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// The next line without trailing blanks; false at the end of the text.
bool next_line(std::istream& text, std::string& line) {
  if (!std::getline(text, line)) return false;
  while (!line.empty() && is_blank(line.back())) line.pop_back();
  line.erase(line.begin(), std::find_if_not(line.begin(), line.end(), is_blank));
  return true;
}

int read_height(const std::string& name, const std::string& line) {
  const bool digits =
      !line.empty() && line.size() <= 4 &&
      std::all_of(line.begin(), line.end(), [](char c) { return c >= '0' && c <= '9'; });
  const int height = digits ? std::stoi(line) : 0;
  if (height < 1 || height > kMaxSide) {
    fail(name, 1,
         "expected the number of rows, a whole number from 1 to " + std::to_string(kMaxSide) +
             ", found " + quoted(line));
  }
  return height;
}

}  // namespace

Mask read_text_map(std::istream& text, const std::string& name, double cell_size_m) {
  std::string line;
  if (!next_line(text, line)) fail(name, 1, "expected the number of rows, found an empty file");
  GridFrame frame;
  frame.height = read_height(name, line);
  frame.width = 0;
  frame.cell_size_m = cell_size_m;

  std::vector<std::uint8_t> walls;
  for (int row = 0; row < frame.height; ++row) {
    const std::size_t number = static_cast<std::size_t>(row) + 2;  // of the line
    if (!next_line(text, line)) {
      fail(name, number,
           "expected row " + std::to_string(row + 1) + " of " + std::to_string(frame.height) +
               ", found the end of the file");
    }
    const int width = static_cast<int>(std::min<std::size_t>(line.size(), kMaxSide + 1));
    if (row == 0) {
      if (width < 1) fail(name, number, "expected a row of . and #, found an empty line");
      if (width > kMaxSide) {
        fail(name, number,
             "expected at most " + std::to_string(kMaxSide) + " cells a row, found " +
                 std::to_string(line.size()));
      }
      frame.width = width;
    } else if (width != frame.width) {
      fail(name, number,
           "expected " + std::to_string(frame.width) + " cells as in the first row, found " +
               std::to_string(line.size()));
    }
    for (std::size_t column = 0; column < line.size(); ++column) {
      if (line[column] != '.' && line[column] != '#') {
        fail(name, number,
             "expected . or # in column " + std::to_string(column + 1) + ", found " +
                 quoted(line.substr(column, 1)));
      }
      walls.push_back(line[column] == '#' ? 1 : 0);
    }
  }
  for (std::size_t number = static_cast<std::size_t>(frame.height) + 2; next_line(text, line);
       ++number) {
    if (!line.empty()) {
      fail(name, number,
           "expected nothing after the " + std::to_string(frame.height) +
               " rows that line 1 announces, found " + quoted(line));
    }
  }
  Mask map(frame);
  map.values() = std::move(walls);
  return map;
}

Mask load_text_map(const std::string& path, double cell_size_m) {
  std::ifstream file(path);
  // A folder can be opened, but not read.
  if (!file || file.peek() == std::ifstream::traits_type::eof()) {
    if (!file.is_open() || file.bad()) throw MapError(path + ": cannot be read");
    file.clear();
  }
  return read_text_map(file, path, cell_size_m);
}

std::string to_text_map(const Mask& walls) {
  std::string text = std::to_string(walls.height()) + "\n";
  for (int row = 0; row < walls.height(); ++row) {
    for (int column = 0; column < walls.width(); ++column) {
      text += walls[{column, row}] != 0 ? '#' : '.';
    }
    text += '\n';
  }
  return text;
}

}  // namespace par
