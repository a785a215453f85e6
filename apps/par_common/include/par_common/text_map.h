// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <stdexcept>
#include <string>

#include "par_common/grid.h"

namespace par {

/// A map file that cannot be read; what() says where the error is, what was expected and what was
/// found.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a map from text. The first line is the number of rows. The rows follow from top to bottom,
/// all of equal length: `.` is a free cell and `#` a wall. Spaces at the ends of lines, Windows
/// line ends, and empty lines after the last row are ignored.
///
/// @param name         name of the text, for error messages.
/// @param cell_size_m  side of a cell [m]; the grid's origin is (0, 0).
/// @return 1 where there is a wall.
/// @throw MapError     "NAME:LINE: ..." unless the text is such a map of 1..8192 rows and columns.
[[nodiscard]] Mask read_text_map(std::istream& text, const std::string& name,
                                 double cell_size_m = 0.02);

/// Reads a map from a file. @throw MapError also if the file cannot be opened.
[[nodiscard]] Mask load_text_map(const std::string& path, double cell_size_m = 0.02);

/// Writes a map in the format that read_text_map() reads.
[[nodiscard]] std::string to_text_map(const Mask& walls);

}  // namespace par
