// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "playerlike/host/run_settings.h"
#include "sim/canvas/layers.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Name of a recording in the output folder of its run.
inline constexpr const char* kRecordingFile = "recording.bin";
/// Name of the file in the same folder that keeps what a program prints.
inline constexpr const char* kProgramLog = "program.log";

/// A run cannot be made again from its recording. what() is a sentence: "FILE: expected X, found
/// Y", with the byte of the file where it is known.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A command that a device got between two steps.
struct RecordedCommand {
  sim::Simulation::DeviceId device{0, 0};
  sim::Command command;
};

/// A read of a client, other than onlookers and drivers of this process: it took readings between
/// two steps.
struct RecordedRead {
  int port = 0;             ///< of the client
  sim::SimTime age_ns = 0;  ///< of the oldest reading that it took, to the millisecond
};

/// A finished run, made again from its recording (recording.bin in its output folder).
///
/// A simulation is deterministic, so a recording holds only what a run depends on besides its
/// world: the commands, and the states after changes of another kind. From them, this class makes
/// the same run again, with all poses and readings, some thousand times faster than real time. It
/// also gives what was drawn on the layers, every half second, and how much the program had
/// printed, every tenth of a second. The recording holds hashes, by which a different run is
/// noticed.
///
/// Plain computation without threads. Not thread-safe.
class Rerun {
 public:
  /// Reads the recording in a run's output folder, and its world. The text of the world is that of
  /// the recording; other files that it names, such as maps, are read from where they were.
  /// @throws RecordingError if there is none, it is damaged, of another version, or of a world that
  ///         cannot be read or has changed.
  explicit Rerun(const std::string& folder);
  Rerun(Rerun&&) noexcept;
  Rerun& operator=(Rerun&&) noexcept;
  ~Rerun();

  /// The run's simulation as it was after the present step. Its layers are those of layers().
  [[nodiscard]] const sim::Simulation& simulation() const noexcept;
  /// Makes the next step.
  /// @return false: the recording ends here.
  /// @throws RecordingError if the rest is damaged, or the run is no longer the recorded one.
  bool step();
  /// Makes steps until a simulated time, or the end.
  /// @return whether that time has come. @throws RecordingError as step().
  bool advance_to(sim::SimTime time_ns);

  /// The commands that were executed right before the present step, oldest first.
  [[nodiscard]] std::span<const RecordedCommand> commands() const noexcept;
  /// The reads between the step before and the present step, oldest first. The readings are those
  /// of earlier steps.
  [[nodiscard]] std::span<const RecordedRead> reads() const noexcept;
  /// The layers as they were recorded last.
  [[nodiscard]] const sim::LayerStack& layers() const noexcept;
  /// Counts the changes of layers() up to the present step.
  [[nodiscard]] std::uint64_t layer_changes() const noexcept;
  /// How much of program_log() the program had printed by now [bytes].
  [[nodiscard]] std::uint64_t printed_bytes() const noexcept;
  /// Path of the file with what the program printed; "": it is not known.
  [[nodiscard]] const std::string& program_log() const noexcept;
  /// Path of the world's file; "": the default world.
  [[nodiscard]] const std::string& world_file() const noexcept;
  /// The settings of the run that belong to its world: seed, duration, realism, view mode,
  /// interfaces, port and start gate. The duration is that of the world if the run had no other.
  [[nodiscard]] const RunSettings& settings() const noexcept;
  /// The present state, for Simulation::restore(). Its base layer is that of layers(), and it has
  /// no other layers.
  [[nodiscard]] sim::Snapshot state() const;
  /// Whether the recording contains the end of the run: it does not if the program was killed, or
  /// wrote more than fits.
  [[nodiscard]] bool complete() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace playerlike
