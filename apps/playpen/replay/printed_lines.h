// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace playpen::replay {

/// What a program printed into a file, which becomes known with the steps of a run. Not
/// thread-safe.
class PrintedLines {
 public:
  /// @param file  "" or a file that cannot be read: there are no lines.
  explicit PrintedLines(const std::string& file);

  /// The lines that are new and complete once the program has printed so many bytes, with their
  /// line ends. The text is valid as long as this object.
  [[nodiscard]] std::string_view until(std::uint64_t bytes);
  /// What until() has not given yet, of the first `bytes` bytes.
  [[nodiscard]] std::string_view rest(std::uint64_t bytes = ~std::uint64_t{0});

 private:
  [[nodiscard]] std::string_view take(std::size_t end);

  std::string text_;
  std::size_t taken_ = 0;  ///< bytes
};

}  // namespace playpen::replay
