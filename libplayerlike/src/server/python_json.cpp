// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/python_json.h"

#include <array>
#include <charconv>
#include <cmath>

namespace playerlike::server {
namespace {

using nlohmann::json;

// Python's repr() of a float: the shortest text that gives the same number, in fixed notation from
// 1e-4 to 1e16.
std::string number_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0.0 ? "Infinity" : "-Infinity";
  const double size = std::abs(value);
  const bool fixed = size == 0.0 || (size >= 1e-4 && size < 1e16);
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 fixed ? std::chars_format::fixed : std::chars_format::scientific);
  std::string text(buffer.data(), end.ptr);
  if (fixed && text.find('.') == std::string::npos) text += ".0";
  return text;
}

void write(const json& value, std::string& text) {
  if (value.is_object()) {
    text += '{';
    const char* comma = "";
    for (const auto& [key, member] : value.items()) {
      text += comma;
      write(json(key), text);
      text += ": ";
      write(member, text);
      comma = ", ";
    }
    text += '}';
  } else if (value.is_array()) {
    text += '[';
    const char* comma = "";
    for (const json& element : value) {
      text += comma;
      write(element, text);
      comma = ", ";
    }
    text += ']';
  } else if (value.is_number_float()) {
    text += number_text(value.get<double>());
  } else {
    text += value.dump(-1, ' ', true, json::error_handler_t::replace);
  }
}

}  // namespace

std::string python_json(const json& value) {
  std::string text;
  write(value, text);
  return text;
}

}  // namespace playerlike::server
