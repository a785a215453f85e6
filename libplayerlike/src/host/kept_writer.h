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

#include "host/kept_layout.h"
#include "host/recorder.h"
#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// A host's side of a KeptRun. Not thread-safe: the host serialises.
class KeptWriter {
 public:
  /// @param file  RunSettings::kept_run.
  /// @return null if there is none, or if it belongs to the host of another living process.
  [[nodiscard]] static std::unique_ptr<KeptWriter> open(const std::string& file);
  KeptWriter(const KeptWriter&) = delete;
  KeptWriter& operator=(const KeptWriter&) = delete;
  ~KeptWriter();

  void set_phase(KeptRun::Phase phase) noexcept;
  /// Where a signal's handler writes its number. Stays there as long as the process lives.
  [[nodiscard]] std::atomic<std::uint32_t>& noted() const noexcept { return header_->noted; }

  /// Keeps the simulation's state after a step, but for what keep_looks() keeps.
  void keep_step(const TimeStatistics& time, const Recorder& recorder, sim::Simulation& simulation);
  /// Keeps the report, and what a picture shows beside robots, trails, scans and cells. It is
  /// called now and then.
  void keep_looks(const std::string& report, const sim::Simulation& simulation);

 private:
  /// A text that is replaced again and again: the new one is written beside the one before.
  struct Text {
    std::array<std::uint64_t, 2> places{};
    std::array<std::uint64_t, 2> sizes{};  ///< that there is room for
    std::size_t next = 0;
  };
  /// Where a layer's cells are.
  struct Cells {
    std::uint64_t place = 0;
    std::uint64_t size = 0;
  };

  KeptWriter(KeptHeader* header, std::size_t size) : header_(header), size_(size) {}

  template <typename T>
  [[nodiscard]] T* at(std::uint64_t place) const noexcept {
    return reinterpret_cast<T*>(reinterpret_cast<std::byte*>(header_) + place);
  }
  /// A place for so many bytes; 0: there is no room.
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
  std::vector<std::size_t> trail_points_;      ///< kept, robot by robot
  std::vector<int> lasers_;                    ///< index of each robot's first one; -1: none
  std::vector<std::uint64_t> scan_sequences_;  ///< of the scans kept
  std::map<sim::LayerId, Cells> cells_;
  std::vector<Cells> free_cells_;
  std::uint64_t revision_ = 0;
  Text report_;
  Text scene_;
};

}  // namespace playerlike
