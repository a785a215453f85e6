// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/results/printed_bytes.h"
#include "host/results/recording_format.h"
#include "playerlike/host/run_settings.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Writes a run's recording, see Recording: all that a run depends on besides its world, and what
/// its program drew and printed. The thread that steps calls it. Not thread-safe: guarded by the
/// host's mutex.
class RecordingWriter {
 public:
  /// Begins a recording in the run's output folder, before the first step.
  /// @param simulation  must outlive this object; its commands are watched from now on. If the
  ///     settings name a state, this is the simulation in that state.
  /// @throws std::runtime_error if the file cannot be created.
  RecordingWriter(const RunSettings& settings, sim::Simulation& simulation);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  ~RecordingWriter();

  /// To be called after each step.
  /// @return an error, once, after which nothing more is recorded.
  [[nodiscard]] std::optional<std::string> observe();
  /// A client has taken readings.
  /// @param port  of the client. Numbers of clients depend on who connects first.
  /// @param oldest_ns  time stamp of the oldest of them.
  void note_read(int port, sim::SimTime oldest_ns);
  /// Completes the file; nothing is recorded afterwards.
  /// @return the error, unless it was returned before.
  [[nodiscard]] std::optional<std::string> close();

 private:
  void note_command(sim::Simulation::DeviceId device, const sim::Command& command);
  void note_commands();
  void begin_item(RecordedItem item);
  void note_steps();
  void note_reads();
  void note_state();
  void note_printed();
  void note_layers();
  /// Writes what was noted to the disk. @return as observe().
  [[nodiscard]] std::optional<std::string> write();

  sim::Simulation& simulation_;
  const std::string file_;
  const PrintedBytes printed_bytes_;
  std::ofstream out_;
  std::size_t written_ = 0;      ///< bytes
  sim::StateArchive items_;      ///< not written yet
  std::uint32_t new_steps_ = 0;  ///< since the last item
  std::uint64_t interventions_;  ///< of the simulation when they were last looked at
  struct NewCommand {
    sim::Simulation::DeviceId device;
    std::vector<std::uint8_t> bytes;  ///< kind and fields
  };
  std::vector<NewCommand> new_commands_;  ///< since the last step
  bool robots_alone_ = true;              ///< whether none of these concerns other robots
  /// The last command of each device, as in the file.
  std::map<std::pair<int, int>, std::vector<std::uint8_t>> commands_;
  std::vector<std::pair<std::uint16_t, std::uint32_t>> reads_;  ///< since the last step
  RecordedLayers layers_;
  std::uint64_t layers_version_ = 0;
  std::optional<std::uint64_t> layers_revision_;
  std::uint64_t printed_ = 0;
  sim::SimTime next_look_ns_ = 0;
  sim::SimTime next_layers_ns_ = 0;
  sim::SimTime next_hash_ns_ = 0;
};

}  // namespace playerlike
