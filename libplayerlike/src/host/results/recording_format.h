// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/host/rerun.h"
#include "sim/canvas/layers.h"
#include "sim/core/fields.h"
#include "sim/core/state_archive.h"
#include "sim/core/time.h"
#include "sim/simulation/simulation.h"
#include "sim/world/description.h"

/// @file
/// The file of a recording, see Recording: a line of JSON, the head; then items in binary form.
namespace playerlike {

/// A recording ends when it has so many bytes.
inline constexpr std::size_t kMostRecording = std::size_t{64} << 20U;
/// Period of the times at which a recording notes what the program has printed; until then, it is
/// complete on the disk.
inline constexpr sim::SimTime kRecordingPeriod_ns = sim::kNanosecondsPerSecond / 10;
/// Period of the times at which it notes the layers, if they are small.
inline constexpr sim::SimTime kLayersPeriod_ns = sim::kNanosecondsPerSecond / 2;
/// Layers with more cells, all together, are not recorded.
inline constexpr std::size_t kMostRecordedCells = std::size_t{1} << 20U;

/// The items of a recording. Each begins with its kind in one byte.
enum class RecordedItem : std::uint8_t {
  kSteps,        ///< std::uint32_t: so many steps were made
  kCommand,      ///< a device; std::uint8_t: index of the command's kind; its fields
  kSameCommand,  ///< a device, which got its last command again
  kState,        ///< a snapshot that replaces the state after the last step
  kPrinted,      ///< std::uint64_t: size of what the program has printed so far [bytes]
  kLayers,       ///< width and height of the canvas; all layers, see RecordedLayers
  kCells,        ///< changed cells of a layer, see CellChanges
  kRead,  ///< std::uint16_t, std::uint32_t: the port of a client; age of the oldest reading that
          ///< it took [ms]
  kHash,  ///< std::uint64_t: StateParts::hash_without_canvas()
  kFull,  ///< the recording has reached kMostRecording and ends here
  kEnd,   ///< the run has ended
};
/// Writes or reads the kind of an item.
void archive_kind(sim::StateArchive& archive, RecordedItem& item);
/// Writes or reads a device.
void archive_device(sim::StateArchive& archive, sim::Simulation::DeviceId& device);

/// The head of a recording.
struct RecordingHead {
  int format = 0;  ///< kRecordingFormat
  std::string version;
  std::string world;                      ///< name
  std::string world_file;                 ///< absolute path; "": the default world
  std::optional<std::string> world_text;  ///< content of that file, if it is JSON
  std::string world_hash;                 ///< hash_of_world()
  std::uint64_t seed = 0;
  std::string realism;
  std::string view_mode;
  std::optional<double> duration_s;
  std::vector<std::string> interfaces;  ///< InterfaceChoice::text()
  std::optional<int> robot_port;
  std::optional<int> clients;    ///< start gate, if it is not the world's
  bool has_program_log = false;  ///< what the program prints goes into kProgramLog
};
inline constexpr int kRecordingFormat = 1;

/// The recorded layers: a stack of its own, in which writer and reader make the same changes.
class RecordedLayers {
 public:
  explicit RecordedLayers(const sim::CanvasDescription& canvas) : stack_(canvas) {}

  /// Changes size and set of the layers. New layers are blank.
  void set(int width, int height, const std::vector<sim::LayerInfo>& layers);
  /// The layer that shows a layer of the run; nullopt: there is none.
  [[nodiscard]] std::optional<sim::LayerId> find(sim::LayerId of_run) const;
  [[nodiscard]] sim::LayerStack& stack() noexcept { return stack_; }
  [[nodiscard]] const sim::LayerStack& stack() const noexcept { return stack_; }

 private:
  struct Known {
    sim::LayerId id;  ///< in `stack_`
    sim::LayerKind kind;
  };
  sim::LayerStack stack_;
  std::map<sim::LayerId, Known> known_;  ///< by id in the run, without the base
};

/// Changed cells of a layer in runs of equal values. A run does not go beyond its row.
struct CellChanges {
  std::int32_t layer = 0;  ///< id in the run
  /// The values that occur; with at most 256 of them, a run has an index of one byte, otherwise of
  /// four bytes.
  std::vector<std::uint32_t> values;
  /// Of each run: cells since the end of the last one and its length, as numbers in seven bits a
  /// byte, lowest first; then its index.
  std::vector<std::uint8_t> runs;

  void archive(sim::StateArchive& archive) { archive(layer, values, runs); }
  /// The changes from one list of cells, four bytes each, to another. Both have the same size.
  [[nodiscard]] static CellChanges between(std::span<const std::uint8_t> before,
                                           std::span<const std::uint8_t> after, int width);
  /// Makes the changes in a layer.
  /// @throws sim::SnapshotError if they do not fit into it.
  void apply(sim::LayerStack& stack, sim::LayerId to) const;
};

/// sim::world_hash() in 16 digits, as if the run waited for one client: how many clients it waits
/// for is a setting of the run.
[[nodiscard]] std::string hash_of_world(sim::WorldDescription world);

/// The text of a head, without line end, and back.
[[nodiscard]] std::string text_of_head(const RecordingHead& head);
/// @throws std::exception with the reason.
[[nodiscard]] RecordingHead head_from(const std::string& text);

/// The list of all layers as bytes, and back.
[[nodiscard]] std::string text_of_layers(const std::vector<sim::LayerInfo>& layers);
/// @throws std::exception with the reason.
[[nodiscard]] std::vector<sim::LayerInfo> layers_from(const std::string& text);

}  // namespace playerlike

namespace sim {
SIM_HAS_FIELDS(playerlike::RecordingHead)
}  // namespace sim
