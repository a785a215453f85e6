// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "server/peer.h"
#include "sim/canvas/cell_raster.h"

namespace playerlike::server {

/// A copy of the composed canvas that records when each tile changed.
class CanvasCopy {
 public:
  static constexpr int kTileSide = 16;  ///< cells

  /// Number of pictures so far: 0 before the first; each picture that differs from the last adds
  /// one.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Size and position of the newest picture.
  [[nodiscard]] const CanvasInfo& info() const noexcept { return info_; }
  /// Whether picture number `count` had another size than the newest one; true for 0.
  [[nodiscard]] bool resized_since(std::uint64_t count) const noexcept { return count < resized_; }

  /// Takes a new picture by swapping its buffer with the old one.
  /// @param rgba  RGBA bytes, row-major from the top, four per cell; empty if the canvas is too
  ///              large to copy: then no cells are known.
  void take(const CanvasInfo& info, std::vector<std::uint8_t>& rgba);

  /// Disjoint rectangles that contain all changes since picture number `count`; the whole canvas if
  /// the size has changed since then or `count` is 0.
  [[nodiscard]] std::vector<sim::CellRect> changed_since(std::uint64_t count) const;
  /// RGBA bytes of a rectangle, which must lie inside the canvas.
  [[nodiscard]] std::vector<std::uint8_t> cells(const sim::CellRect& rect) const;

 private:
  void stamp_changes(const std::vector<std::uint8_t>& old);

  CanvasInfo info_;
  std::uint64_t count_ = 0;
  std::uint64_t resized_ = 0;  ///< the first picture of the present size
  std::vector<std::uint8_t> rgba_;
  std::vector<std::uint64_t> stamps_;  ///< by tile: the picture that brought its present contents
};

/// Sends events to connections that `watch` (docs/protocol.md).
///
/// The cost is almost independent of the number of watchers: one access to the simulation serves
/// all watchers that are due, and watchers of equal contents get the same bytes. Due times are
/// multiples of the periods, so that equal rates coincide. Used by the server's thread only.
class WatchHub {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kMinRate_hz = 0.01;
  static constexpr double kMaxRate_hz = 60.0;
  /// A canvas with more cells is not sent.
  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 20U;

  /// @param hub  must outlive this object.
  explicit WatchHub(Hub& hub);

  /// Starts to send events to a peer; restarts if it watches already.
  /// @param rate_hz  wall clock, in [kMinRate_hz, kMaxRate_hz].
  /// @param canvas   whether to send the canvas too.
  void watch(Peer& peer, protocol::Encoding encoding, double rate_hz, bool canvas);
  /// Stops sending events. Must be called before the peer is destroyed.
  void forget(const Peer& peer) noexcept;

  /// An onlooker's session, for requests about the canvas.
  [[nodiscard]] Session& session();

  /// Sends all events that are due. Called by the timer; public for tests.
  void tick(Clock::time_point now);

 private:
  struct Watcher {
    Peer* peer;
    protocol::Encoding encoding;
    Clock::duration period;
    bool canvas;
    Clock::time_point due;
    std::uint64_t sent = 0;  ///< number of the picture sent last; 0: none
  };
  /// The state of the simulation in an event, without the canvas.
  struct Moment {
    sim::SimTime t_ns = 0;
    bool finished = false;
    std::vector<sim::Pose> poses;
  };

  [[nodiscard]] Clock::time_point next_due(const Watcher& watcher, Clock::time_point now) const;
  [[nodiscard]] Moment look(bool with_canvas, Clock::time_point now);
  /// Copies the canvas, if it has another version or size than the last copy.
  void copy_canvas(std::uint64_t version);
  [[nodiscard]] std::shared_ptr<const std::string> record(const Moment& moment,
                                                          const Watcher& watcher) const;
  void schedule(Clock::time_point now);

  Hub& hub_;
  Clock::time_point epoch_;
  std::vector<Watcher> watchers_;
  CanvasCopy canvas_;
  std::unique_ptr<EventClient> client_;  ///< created on first use
  std::uint64_t stack_version_ = 0;      ///< sim::LayerStack::version() of canvas_
  Clock::time_point next_copy_{};  ///< earliest time of the next copy of the canvas, see look()
  std::uint64_t timer_ = 0;
  Clock::time_point timer_due_;      ///< max(): no timer is set
  std::shared_ptr<WatchHub*> self_;  ///< expires with this object; pending timers check it
};

}  // namespace playerlike::server
