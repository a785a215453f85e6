// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/text.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "sim/core/number_text.h"
#include "sim/core/replace_file.h"
#include "sim/core/utf8.h"

namespace playpen::grade {

std::string telling_number(double value, double limit, int decimals) {
  constexpr int kMostDecimals = 9;
  while (decimals < kMostDecimals && value != limit &&
         sim::fixed_text(value, decimals) == sim::fixed_text(limit, decimals)) {
    ++decimals;
  }
  return sim::fixed_text(value, decimals);
}

std::string plain_text(const std::string& text) {
  std::string result;
  for (const char c : sim::escape_invalid_utf8(text)) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' || c == '\x7F';
    result += is_control ? '?' : c;
  }
  return result;
}

std::size_t character_count(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::string markup_escaped(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

std::string csv_value(const std::string& text) {
  std::string value = plain_text(text);
  if (!value.empty() && std::strchr("=+-@", value.front()) != nullptr) value.insert(0, "'");
  if (value.find_first_of(",\"\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string shell_word(const std::string& word) {
  const bool is_plain = !word.empty() && word.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789_-./+:@%,=~") == std::string::npos;
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + '\'';
}

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  std::error_code ignored;  // a missing folder is an error of the file
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  if (const int error = sim::replace_file(file.string(), text)) {
    throw std::runtime_error("the file '" + file.string() +
                             "' can't be written: " + std::strerror(error));
  }
}

}  // namespace playpen::grade
