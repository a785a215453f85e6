// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>

namespace playpen {

std::size_t terminal_columns(int descriptor) {
  winsize size{};
  if (isatty(descriptor) == 0 || ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
    return kUsualColumns;
  }
  return size.ws_col;
}

bool shows_colour(int descriptor) {
  const char* const no_colour = std::getenv("NO_COLOR");
  if (no_colour != nullptr && *no_colour != '\0') return false;
  const char* const terminal = std::getenv("TERM");
  return isatty(descriptor) != 0 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  constexpr std::size_t kLeast = 20;
  const std::size_t room = columns > indent + kLeast ? columns - indent : kLeast;
  std::string lines;
  std::size_t used = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (used > 0 && used + 1 + word.size() > room) {
      lines += '\n' + std::string(indent, ' ');
      used = 0;
    } else if (used > 0) {
      lines += ' ';
      ++used;
    }
    lines += word;
    used += word.size();
  }
  return lines;
}

std::string tinted(const std::string& text, Tint tint, bool colour) {
  if (!colour) return text;
  const char* code = "1";  // ECMA-48, select graphic rendition: bold
  if (tint == Tint::kGood) code = "32";
  if (tint == Tint::kBad) code = "1;31";
  if (tint == Tint::kWarning) code = "33";
  return std::string("\033[") + code + 'm' + text + "\033[0m";
}

}  // namespace playpen
