// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/printed_lines.h"

#include <algorithm>

#include "sim/core/file.h"

namespace playpen::replay {

PrintedLines::PrintedLines(const std::string& file) {
  if (!file.empty()) static_cast<void>(sim::read_whole_file(file, {}, text_));
}

std::string_view PrintedLines::until(std::uint64_t bytes) {
  const std::size_t printed = std::min<std::uint64_t>(bytes, text_.size());
  if (printed <= taken_) return {};
  const std::size_t line_end = text_.rfind('\n', printed - 1);
  return take(line_end == std::string::npos ? 0 : line_end + 1);
}

std::string_view PrintedLines::rest(std::uint64_t bytes) {
  return take(std::min<std::uint64_t>(bytes, text_.size()));
}

std::string_view PrintedLines::take(std::size_t end) {
  if (end <= taken_) return {};
  const std::string_view taken = std::string_view(text_).substr(taken_, end - taken_);
  taken_ = end;
  return taken;
}

}  // namespace playpen::replay
