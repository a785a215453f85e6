// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/text.h"

#include <cstring>
#include <stdexcept>
#include <system_error>

#include "sim/core/number_text.h"
#include "sim/core/replace_file.h"

namespace playpen::grade {

std::string telling_number(double value, double limit, int decimals) {
  constexpr int kMostDecimals = 9;
  while (decimals < kMostDecimals && value != limit &&
         sim::fixed_text(value, decimals) == sim::fixed_text(limit, decimals)) {
    ++decimals;
  }
  return sim::fixed_text(value, decimals);
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
