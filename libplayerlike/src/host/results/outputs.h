// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/canvas/layers.h"
#include "sim/io/map_file.h"
#include "sim/render/render.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/world/occupancy_map.h"

namespace playerlike {

/// Folder of the pictures that are made while a run goes on, in its output folder.
inline constexpr const char* kSnapshotFolder = "snapshots";

/// Removes the pictures of earlier runs from an output folder's snapshots/. @throws
/// std::runtime_error with the file that can't be removed and the reason.
void remove_snapshots(const std::string& folder);

/// Writes report.json into `folder`; see sim::replace_file().
/// @throws std::runtime_error naming the file if it could not be written.
void write_report(const std::string& folder, const std::string& text);

/// Writes scene.png, canvas.png and, for each layer, layers/NAME.png (for grey layers also NAME.pgm
/// and NAME.yaml, see sim::io::write_map) into `folder`.
///
/// scene.png shows the ground, or the mini-map if that is the view mode. canvas.png shows all
/// visible layers, composed. In a layer's NAME, characters other than letters, digits, '-' and '_'
/// become '_'. Equal names get their client's port as a suffix, and a number if they are still
/// equal.
/// @param options  contents of scene.png; the size in it is ignored.
/// @throws std::runtime_error with the first file that could not be written; the other files are
///         written nevertheless.
void write_pictures(const std::string& folder, const sim::LayerStack& layers,
                    const sim::SceneSnapshot& scene,
                    const sim::render::RenderOptions& options = {});

inline constexpr std::size_t kMaxFileName = 100;  ///< bytes
/// Whether a name is a plain file name that cannot leave its folder: 1 to kMaxFileName bytes
/// without separators and control characters, and no dot at the beginning.
[[nodiscard]] bool is_plain_file_name(const std::string& name);

/// Converts the cells of a grey layer to an occupancy grid.
[[nodiscard]] sim::OccupancyMap occupancy_map(const sim::CanvasDescription& canvas,
                                              const std::vector<sim::CellValue>& cells);

/// The path of a picture that a client saves. @throws SessionError as SaveImageRequest.
[[nodiscard]] std::string picture_file(const std::string& folder, const std::string& name,
                                       int scale);
/// Writes the canvas as a PNG with scale x scale pixels per cell. @throws SessionError
/// kNotAvailable if writing fails.
void write_picture(const sim::CanvasDescription& canvas, const std::vector<std::uint8_t>& rgba,
                   int scale, const std::string& file);

/// The path, without ending, of the two files of a map that a client saves. @throws SessionError as
/// SaveMapRequest.
[[nodiscard]] std::string map_stem(const std::string& folder, const std::string& name);
/// Writes a map, see sim::io::write_map(). @throws SessionError kNotAvailable if writing fails.
void write_map_files(const sim::OccupancyMap& map, const std::string& stem, sim::io::MapMode mode);

}  // namespace playerlike
