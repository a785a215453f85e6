// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/mirror/mirror.h"
#include "host/results/kept_layout.h"
#include "host/results/recorder.h"
#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The host's side of a KeptRun. Not thread-safe: guarded by the host's mutex.
class KeptWriter {
 public:
  /// @param file  RunSettings::kept_run. @return null if there is no such file or it belongs to the
  ///              host of another running process.
  [[nodiscard]] static std::unique_ptr<KeptWriter> open(const std::string& file);
  KeptWriter(const KeptWriter&) = delete;
  KeptWriter& operator=(const KeptWriter&) = delete;
  ~KeptWriter();

  void set_phase(KeptRun::Phase phase) noexcept;
  /// Whether another program of the run has requested the world and was refused.
  [[nodiscard]] bool conflict_noted() const noexcept { return header_->conflict != 0; }
  /// Where the signal handler stores the signal's number. Valid until the process ends.
  [[nodiscard]] std::atomic<std::uint32_t>& noted() const noexcept { return header_->noted; }

  /// Stores the simulation's state after a step, except for the data of keep_looks().
  void keep_step(const TimeStatistics& time, const Recorder& recorder, sim::Simulation& simulation);
  /// Stores where the motors of the run's real robots are.
  void keep_motors(const std::vector<RealMotors>& motors);
  /// Stores the report and the contents of a picture besides robots, trails, scans and cells.
  /// Called periodically.
  void keep_looks(const std::string& report, const sim::Simulation& simulation);

 private:
  /// A text that is replaced repeatedly (double buffer): the new text does not overwrite the
  /// previous one.
  struct Text {
    std::array<std::uint64_t, 2> places{};
    std::array<std::uint64_t, 2> sizes{};  ///< capacities
    std::size_t next = 0;
  };
  /// The memory of a layer's cells.
  struct Cells {
    std::uint64_t place = 0;
    std::uint64_t size = 0;
  };

  KeptWriter(KeptHeader* header, std::size_t size) : header_(header), size_(size) {}

  template <typename T>
  [[nodiscard]] T* at(std::uint64_t place) const noexcept {
    return reinterpret_cast<T*>(reinterpret_cast<std::byte*>(header_) + place);
  }
  /// Allocates memory; 0: the memory is full.
  [[nodiscard]] std::uint64_t allocate(std::uint64_t size) noexcept;
  void begin(const sim::Simulation& simulation);
  void keep_trail(std::size_t robot, const std::vector<sim::Vec2>& points, KeptRobot& kept);
  void keep_scan(std::size_t robot, const sim::Simulation& simulation, KeptRobot& kept);
  void keep_cells(sim::Simulation& simulation);
  void place_layers(const sim::LayerStack& layers);
  void keep_scene(const sim::Simulation& simulation);
  void keep_text(std::atomic<std::uint64_t>& where, Text& text, const std::string& content);

  KeptHeader* header_;
  std::size_t size_;
  std::uint64_t used_ = kKeptHeaderSize;
  bool begun_ = false;
  std::vector<std::size_t> trail_points_;      ///< points stored, by robot
  std::vector<int> lasers_;                    ///< index of each robot's first laser; -1: none
  std::vector<std::uint64_t> scan_sequences_;  ///< of the stored scans
  std::map<sim::LayerId, Cells> cells_;
  std::vector<Cells> free_cells_;
  std::uint64_t revision_ = 0;
  Text report_;
  Text scene_;
  Text motors_;
};

}  // namespace playerlike
