// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/world/occupancy_map.h"

/// Occupancy grids as pairs of files that ROS's map_server reads and writes: a picture (PGM) and
/// its place (YAML). Format: http://wiki.ros.org/map_server
namespace sim::io {

/// How occupancy becomes shades of grey, and these become occupancy.
enum class MapMode {
  kTrinary,  ///< occupied, free or unknown; what most tools take a map for
  kScale,    ///< all shades between free and occupied
};

/// The mode of that name, as the key `mode` has it: "trinary" or "scale"; nullopt for anything
/// else.
[[nodiscard]] std::optional<MapMode> parse_map_mode(std::string_view text);
/// The name that parse_map_mode reads.
[[nodiscard]] std::string_view to_string(MapMode mode);

/// Writes STEM.pgm (raw PGM, 8 bit, the maximum 255) and STEM.yaml, which names it.
///
/// In trinary mode a cell over 0.65 is written as occupied (0), one below 0.196 as free (254), any
/// other (NaN too) as unknown (205), as map_saver does. In scale mode each shade comes back from
/// read_map to within 1/500, and 0 and 1 exactly; unknown is no more than the shade of 0.5 there.
/// What lies outside 0..1 counts as the nearer end.
/// @param stem  path without ending; the folder must be there.
/// @pre the map has at least one cell, and width * height of them (asserted).
/// @throws std::runtime_error naming the file and the reason.
void write_map(const OccupancyMap& map, const std::string& stem, MapMode mode = MapMode::kTrinary);

/// Reads a pair by its YAML file, which must have the keys image, resolution, origin, negate,
/// occupied_thresh and free_thresh, and may have mode; others are passed over, as map_server does.
///
/// The picture (its name relative to the YAML file) may be a PGM, plain or raw, or a PNG, at most
/// 8192 pixels a side. With p = (255 - shade) / 255, negated: shade / 255,
/// - trinary (the default): p > occupied_thresh is 1, p < free_thresh 0, all else 0.5;
/// - scale: the same, but all else is (p - free_thresh) / (occupied_thresh - free_thresh);
/// - raw: the shade (negated: 255 - it) is the occupancy in percent, over 100 is unknown, 0.5.
/// Unlike map_server, colours count by their luma and what is transparent as white; and only maps
/// that are not turned (the third number of origin is 0) are taken.
/// @throws ConfigError saying which file, where, what was expected and what was found, for each
///         key that is wrong.
[[nodiscard]] OccupancyMap read_map(const std::string& yaml_file);

}  // namespace sim::io
