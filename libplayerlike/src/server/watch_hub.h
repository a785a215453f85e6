// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "server/peer.h"
#include "sim/canvas/cell_raster.h"

namespace playerlike::server {

/// A copy of the composed canvas that knows which of its tiles have changed when.
class CanvasCopy {
 public:
  static constexpr int kTileSide = 16;  ///< cells

  /// Counts pictures: 0 before the first, then one more for each that differs from the last.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Size and place of the newest.
  [[nodiscard]] const CanvasInfo& info() const noexcept { return info_; }
  /// Whether picture number `count` had another size than the newest; so had none (0).
  [[nodiscard]] bool resized_since(std::uint64_t count) const noexcept { return count < resized_; }

  /// Takes another picture over, by swapping it with the old one.
  /// @param rgba  RGBA bytes, row-major from the top, four for each cell; or none, if the canvas is
  ///              too large to be copied: then no cells are known.
  void take(const CanvasInfo& info, std::vector<std::uint8_t>& rgba);

  /// Rectangles that hold all that has changed since picture number `count`, apart from one
  /// another; the whole canvas, if it had another size then or `count` is 0.
  [[nodiscard]] std::vector<sim::CellRect> changed_since(std::uint64_t count) const;
  /// RGBA bytes of a rectangle that lies inside.
  [[nodiscard]] std::vector<std::uint8_t> cells(const sim::CellRect& rect) const;

 private:
  void stamp_changes(const std::vector<std::uint8_t>& old);

  CanvasInfo info_;
  std::uint64_t count_ = 0;
  std::uint64_t resized_ = 0;  ///< the first picture of this size
  std::vector<std::uint8_t> rgba_;
  std::vector<std::uint64_t> stamps_;  ///< of each tile: the first picture with what it holds now
};

/// Sends those who `watch` (docs/protocol.md) what they watch.
///
/// However many they are: at a moment when somebody is to be told, one look at the simulation
/// serves all who are to be told about then, and those who are to be told the same get the same
/// bytes. Moments are multiples of the periods, so that equal rates coincide. Used by the server's
/// thread only.
class WatchHub {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kMinRate_hz = 0.01;
  static constexpr double kMaxRate_hz = 60.0;
  /// A canvas of more cells is not sent.
  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 20U;

  /// @param hub  lives longer.
  explicit WatchHub(Hub& hub);

  /// Begins to tell a peer; from the start, if it was told already.
  /// @param rate_hz  wall clock, in [kMinRate_hz, kMaxRate_hz].
  /// @param canvas   whether of the canvas, too.
  void watch(Peer& peer, protocol::Encoding encoding, double rate_hz, bool canvas);
  /// Ends that. A peer must be forgotten before it goes.
  void forget(const Peer& peer) noexcept;

  /// Tells all who are to be told by now. Called by the timer; public for tests.
  void tick(Clock::time_point now);

 private:
  struct Watcher {
    Peer* peer;
    protocol::Encoding encoding;
    Clock::duration period;
    bool canvas;
    Clock::time_point due;
    std::uint64_t sent = 0;  ///< the picture that it has; 0: none
  };
  /// What is told of the simulation, but for the canvas.
  struct Moment {
    sim::SimTime t_ns = 0;
    bool finished = false;
    std::vector<sim::Pose> poses;
  };

  [[nodiscard]] Clock::time_point next_due(const Watcher& watcher, Clock::time_point now) const;
  [[nodiscard]] Moment look(bool with_canvas, Clock::time_point now);
  [[nodiscard]] std::shared_ptr<const std::string> record(const Moment& moment,
                                                          const Watcher& watcher) const;
  void schedule(Clock::time_point now);

  Hub& hub_;
  Clock::time_point epoch_;
  std::vector<Watcher> watchers_;
  CanvasCopy canvas_;
  std::vector<std::uint8_t> scratch_;
  std::uint64_t stack_version_ = 0;  ///< sim::LayerStack::version() of canvas_
  Clock::time_point next_copy_{};    ///< the canvas is not copied before, see look()
  std::uint64_t timer_ = 0;
  Clock::time_point timer_due_;      ///< max(): none is set
  std::shared_ptr<WatchHub*> self_;  ///< outlived by timers that are still set
};

}  // namespace playerlike::server
