// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "playerlike/messages/messages.h"
#include "playerlike/messages/requests.h"
#include "playerlike/session/draw_queue.h"
#include "sim/canvas/layers.h"

namespace playerlike {

inline constexpr std::size_t kMaxLayers = 64;     ///< of a session, without the base layer
inline constexpr std::size_t kMaxLayerName = 64;  ///< bytes
/// Of all layers of a simulation together: 256 MiB.
inline constexpr std::size_t kMaxLayerCells = std::size_t{1} << 26U;

/// Receives the readings of a round.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  /// A reading, which may be kept. Must not call the session back.
  virtual void on_reading(DeviceId device, const sim::SharedReading& reading) = 0;
};

/// A client's end of a connection to a simulation: the one seam between the client library and
/// whatever runs the world. Proxies cannot tell what stands behind it.
///
/// All members may be called from any thread. In lockstep a session belongs to the thread that
/// last waited on it, and simulated time stands still until every such thread waits again.
/// Calls on a closed session throw SessionError kDisconnected, but for those marked noexcept.
///
/// Drawings go through a queue of the session. It is emptied, in order, before each step (the
/// clients in the order in which they connected), when it is full, and before any request that
/// concerns the canvas: so this session sees its drawings at once, others from the next step on at
/// the latest.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;

  /// The world's robots and devices; constant over a session's life.
  [[nodiscard]] virtual const std::vector<RobotInfo>& robots() const noexcept = 0;
  /// The port this session was opened on.
  [[nodiscard]] virtual int port() const noexcept = 0;
  [[nodiscard]] virtual bool connected() const noexcept = 0;

  /// Waits until at least one subscribed device has a reading that was not taken yet; without
  /// any subscription, until a tenth of a simulated second has passed. In lockstep this is what
  /// lets simulated time go on.
  /// @throws SessionError kFinished when the run is over and nothing is left to take.
  virtual void wait() = 0;
  /// Hands over all readings that were not taken yet, oldest first, in order of device.
  /// @return how many; 0 too for a round without subscriptions.
  virtual int take(ReadingSink& sink) = 0;
  /// Whether a reading waits (or the run is over, so that take() must be tried).
  /// Lockstep: with timeout 0, the first call after a take() only looks; further ones in a row
  /// each let one step pass. With a timeout, up to that much simulated time passes.
  /// Paced: waits up to the timeout of wall time.
  [[nodiscard]] virtual bool peek(std::chrono::milliseconds timeout) = 0;

  /// Queues a command for the next step.
  virtual void send(DeviceId device, const sim::Command& command) = 0;

  /// Asks for anything else: `session.request(ObjectPoseRequest{"robot1"})` gives an ObjectPose.
  /// Each request says what it does and throws.
  template <typename One>
  typename One::Result request(One what) {
    if constexpr (std::is_void_v<typename One::Result>) {
      static_cast<void>(answer(Request(std::move(what))));
    } else {
      return std::get<typename One::Result>(answer(Request(std::move(what))));
    }
  }
  /// As request(), for a request of any type.
  virtual Answer answer(const Request& request) = 0;

  /// Draws on the canvas (layer kBaseLayer) and on this session's layers, in order. What lies
  /// outside is clipped; what names another layer, also another session's, is left out.
  void draw(std::span<const sim::DrawOperation> operations);
  /// The queue, for those who draw cell by cell: push() onto it is draw() without a virtual call.
  /// A push that fails is tried again after a FlushDrawingsRequest.
  [[nodiscard]] virtual DrawQueue& draw_queue() noexcept = 0;
  /// How often the canvas was resized, by anyone: while this stays the same, so does what a
  /// CanvasInfoRequest tells. Cheap.
  [[nodiscard]] virtual std::uint64_t canvas_generation() const noexcept = 0;

  /// Opens a further session of the same simulation and port, for a driver that a program runs in
  /// a thread of its own. In lockstep such a follower holds simulated time while its thread thinks,
  /// as any session, but never lets it go on by itself: time stands while no other session takes
  /// part. It does not count for the start gate, and its commands are executed before those
  /// of other sessions, so that a program has the last word.
  [[nodiscard]] virtual std::unique_ptr<Session> open_follower() = 0;
  /// The same for all sessions of one simulation, and different for others that exist now.
  [[nodiscard]] virtual const void* simulation() const noexcept = 0;

  /// Ends the connection; the client no longer holds up others. Waiting threads throw.
  virtual void close() noexcept = 0;
};

}  // namespace playerlike
