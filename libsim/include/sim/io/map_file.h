// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/world/occupancy_map.h"

/// Occupancy grids in the two-file format of ROS's map_server: an image (PGM) and its position
/// (YAML). Format: http://wiki.ros.org/map_server
namespace sim::io {

/// Conversion between occupancy and shades of grey.
enum class MapMode {
  kTrinary,  ///< occupied, free or unknown; most tools expect this mode
  kScale,    ///< all shades between free and occupied
};

/// The mode with that name, as in the key `mode`: "trinary" or "scale"; nullopt for anything else.
[[nodiscard]] std::optional<MapMode> parse_map_mode(std::string_view text);
/// The name that parse_map_mode reads.
[[nodiscard]] std::string_view to_string(MapMode mode);

/// Writes STEM.pgm (raw PGM, 8 bits, maximum 255) and STEM.yaml, which refers to it.
///
/// In trinary mode a cell over 0.65 is written as occupied (0), a cell below 0.196 as free (254),
/// and any other, including NaN, as unknown (205), as map_saver does. In scale mode read_map
/// returns each value to within 1/500, and 0 and 1 exactly; unknown is stored like 0.5. Values
/// outside 0..1 are clamped.
/// @param stem  path without extension; the folder must exist.
/// @pre the map has at least one cell, and exactly width * height cells (asserted).
/// @throws std::runtime_error naming the file and the reason.
void write_map(const OccupancyMap& map, const std::string& stem, MapMode mode = MapMode::kTrinary);

/// Reads a map by its YAML file. The keys image, resolution, origin, negate, occupied_thresh and
/// free_thresh are required, mode is optional; other keys are ignored, as map_server does.
///
/// The image (its name is relative to the YAML file) may be a plain or raw PGM or a PNG, at most
/// 8192 pixels a side. With p = (255 - shade) / 255, or shade / 255 if negated:
/// - trinary (the default): p > occupied_thresh is 1, p < free_thresh is 0, all else 0.5;
/// - scale: like trinary, but all else is (p - free_thresh) / (occupied_thresh - free_thresh);
/// - raw: the shade (255 - shade if negated) is the occupancy in percent; over 100 is unknown, 0.5.
///
/// Unlike map_server, this function converts colours to luma and transparency to white, and refuses
/// rotated maps (the third number of origin must be 0).
/// @throws ConfigError that names the file, the place, the expected and the found value of each
///     wrong key.
[[nodiscard]] OccupancyMap read_map(const std::string& yaml_file);

}  // namespace sim::io
