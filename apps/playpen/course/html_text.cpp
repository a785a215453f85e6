// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/html_text.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "course/results.h"
#include "grade/text.h"
#include "sim/core/utf8.h"

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

constexpr char kEscape = '\x1b';

// The end of the escape sequence that begins at a place (ECMA-48, sections 5.3 to 5.6).
std::size_t end_of_sequence(std::string_view text, std::size_t begin) {
  std::size_t at = begin + 1;
  if (at >= text.size()) return text.size();
  const char kind = text[at++];
  if (kind == '[') {  // parameters and intermediate bytes, then a final byte
    while (at < text.size() && text[at] >= 0x20 && text[at] < 0x40) ++at;
    return std::min(at + 1, text.size());
  }
  if (kind == ']' || kind == 'P' || kind == 'X' || kind == '^' || kind == '_') {  // a string
    for (; at < text.size(); ++at) {
      if (text[at] == '\a') return at + 1;
      if (text[at] == kEscape) return std::min(at + 2, text.size());
      if (text[at] == '\n') return at;  // a program that does not end it
    }
    return at;
  }
  while (at < text.size() && text[at - 1] >= 0x20 && text[at - 1] < 0x30) ++at;
  return at;
}

std::string shown_line(std::string_view line) {
  std::string shown;
  for (std::size_t at = 0; at < line.size();) {
    const char c = line[at];
    if (c == kEscape) {
      at = end_of_sequence(line, at);
      continue;
    }
    ++at;
    if (c == '\r') {
      if (at < line.size()) shown.clear();
    } else if (c == '\t') {
      shown += "    ";
    } else if (c == '\b') {
      if (!shown.empty()) shown.pop_back();
    } else {
      shown += c;
    }
  }
  return plain_text(shown);
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string shown;
  const std::string plain = plain_text(text);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    // U+0080 to U+009F are control characters, too.
    const bool is_control = plain[i] == '\xC2' && static_cast<unsigned char>(plain[i + 1]) < 0xA0;
    shown += is_control ? '?' : plain[i];
    if (is_control) ++i;
  }
  return grade::markup_escaped(shown);
}

std::string url_of(const fs::path& path) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr std::string_view kPlain = "-._~/";
  std::string url;
  for (const char c : path.generic_string()) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x80 && std::isalnum(byte) != 0) || kPlain.find(c) != std::string_view::npos) {
      url += c;
    } else {
      url += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
  }
  return url;
}

std::string terminal_text(std::string_view output) {
  std::string text;
  for (std::size_t begin = 0; begin < output.size();) {
    const std::size_t end = std::min(output.find('\n', begin), output.size());
    text += shown_line(output.substr(begin, end - begin));
    if (end < output.size()) text += '\n';
    begin = end + 1;
  }
  return text;
}

LogTail tail_of(const fs::path& file, std::size_t most_lines) {
  constexpr std::size_t kMostLineBytes = 500;
  const std::size_t most_bytes = most_lines * kMostLineBytes;
  LogTail tail;
  std::error_code error;
  if (fs::symlink_status(file, error).type() != fs::file_type::regular) return tail;
  std::ifstream in(file, std::ios::binary);
  in.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::size_t>(std::max<std::streamoff>(in.tellg(), 0));
  tail.is_whole = bytes <= most_bytes;
  in.seekg(static_cast<std::streamoff>(tail.is_whole ? 0 : bytes - most_bytes));
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  if (!tail.is_whole && lines.size() > 1) lines.erase(lines.begin());  // it lacks its beginning
  if (lines.size() > most_lines) {
    tail.is_whole = false;
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most_lines));
  }
  for (const std::string_view line : lines) {
    tail.text += terminal_text(line.substr(0, kMostLineBytes));
    tail.text += line.size() > kMostLineBytes ? "...\n" : "\n";
  }
  return tail;
}

}  // namespace playpen::course
