// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/canvas/layers.h"
#include "sim/io/map_file.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"

namespace playerlike {

class Recorder;

/// Folder of the pictures that are made while a run goes on, in its output folder.
inline constexpr const char* kSnapshotFolder = "snapshots";

/// Removes the pictures of earlier runs from an output folder's snapshots/.
/// @throws std::runtime_error naming the file that can't be removed and the reason.
void remove_snapshots(const std::string& folder);

/// How a run came to its end, as its report tells.
struct RunEnd {
  enum class By {
    kNothing,   ///< it goes on; a report says so that was written meanwhile
    kDuration,  ///< its time was over
    kProgram,   ///< the program ended, or had enough
    kRequest,   ///< a signal asked for it
    kWindow,    ///< its window was closed
    kSignal,    ///< a signal ended the program: it crashed, or was killed
  };
  By by = By::kNothing;
  std::optional<int> status = {};  ///< exit status of the program, where that ended the run
  std::optional<int> signal = {};  ///< number of the signal of kRequest and kSignal
};

/// The report's "ended": null, or an object with "by" and, where they are known, "status" and
/// "signal" (its name, such as "SIGINT").
[[nodiscard]] nlohmann::ordered_json to_json(const RunEnd& end);

/// The text of report.json.
[[nodiscard]] std::string report_text(const sim::Simulation& simulation, const Recorder& recorder,
                                      const TimeStatistics& time, const RunEnd& end);
/// Writes report.json into `folder`; see sim::replace_file().
/// @throws std::runtime_error naming the file if it could not be written.
void write_report(const std::string& folder, const std::string& text);

/// Writes scene.png, canvas.png and, for each layer, layers/NAME.png (and NAME.pgm with NAME.yaml
/// for grey ones, see sim::io::write_map) into `folder`.
///
/// scene.png shows the ground, or the mini-map if that is the view mode; canvas.png all visible
/// layers over one another. Letters, digits, '-' and '_' of a layer's name stay, others become '_';
/// layers of one name get their clients' ports behind it, and a number if that is not enough.
/// @throws std::runtime_error naming the first file that could not be written; the others are.
void write_pictures(const std::string& folder, const sim::LayerStack& layers,
                    const sim::SceneSnapshot& scene);

inline constexpr std::size_t kMaxFileName = 100;  ///< bytes
/// Whether a name is that of a file in a folder, and no way out of it: 1 to kMaxFileName bytes
/// without separators and control characters, and no dot in front.
[[nodiscard]] bool is_plain_file_name(const std::string& name);

/// A grey layer's cells as an occupancy grid. @pre stack.contains(layer)
[[nodiscard]] sim::OccupancyMap occupancy_map(const sim::LayerStack& stack, sim::LayerId layer);

/// Where a picture goes that a client wants saved.
/// @throws SessionError as SaveImageRequest.
[[nodiscard]] std::string picture_file(const std::string& folder, const std::string& name,
                                       int scale);
/// Writes the canvas as a PNG, scale x scale pixels a cell.
/// @throws SessionError kNotAvailable if it cannot be written.
void write_picture(const sim::CanvasDescription& canvas, const std::vector<std::uint8_t>& rgba,
                   int scale, const std::string& file);

/// Where the two files of a map go that a client wants saved, without their endings.
/// @throws SessionError as SaveMapRequest.
[[nodiscard]] std::string map_stem(const std::string& folder, const std::string& name);
/// Writes a map as sim::io::write_map() does.
/// @throws SessionError kNotAvailable if it cannot be written.
void write_map_files(const sim::OccupancyMap& map, const std::string& stem, sim::io::MapMode mode);

}  // namespace playerlike
