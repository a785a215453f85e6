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

inline constexpr std::size_t kMaxLayers = 64;     ///< per session, without the base layer
inline constexpr std::size_t kMaxLayerName = 64;  ///< length of a layer's name [bytes]
/// Maximum number of cells of all layers of a simulation together: 256 MiB.
inline constexpr std::size_t kMaxLayerCells = std::size_t{1} << 26U;

/// Receives the readings of a round.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  /// Receives a reading. The sink may keep it. It must not call the session.
  virtual void on_reading(DeviceId device, const sim::SharedReading& reading) = 0;
};

/// A client's end of a connection to a simulation: the only interface between the client library
/// and the simulation. Proxies work identically with every implementation.
///
/// Threads: all members may be called from any thread. In lockstep a session belongs to the thread
/// that last waited on it, and simulated time stands still until every such thread waits again.
///
/// Errors: members of a closed session throw SessionError kDisconnected, except those marked
/// noexcept.
///
/// Drawings: each session has a queue of drawings. The queue is emptied, in order, before each step
/// (clients in the order of their connections), when it is full, and before any request for the
/// canvas. This session therefore sees its drawings immediately; other sessions see them at the
/// next step at the latest.
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  virtual ~Session() = default;

  /// The world's robots and devices; constant during a session.
  [[nodiscard]] virtual const std::vector<RobotInfo>& robots() const noexcept = 0;
  /// The port on which this session was opened.
  [[nodiscard]] virtual int port() const noexcept = 0;
  [[nodiscard]] virtual bool connected() const noexcept = 0;

  /// Waits until at least one subscribed device has a reading that was not taken; without any
  /// subscription, for 0.1 s of simulated time. In lockstep, simulated time advances meanwhile.
  /// @throws SessionError kFinished when the run is over and no reading is left.
  virtual void wait() = 0;
  /// Passes all readings that were not taken to the sink, oldest first, in order of device.
  /// @return the number of readings; 0 also for a round without subscriptions.
  virtual int take(ReadingSink& sink) = 0;
  /// Returns whether a reading is available, or the run is over so that take() must be called.
  /// Lockstep: with timeout 0, the first call after a take() only checks; each further call in a
  /// row advances simulated time by one step. With a positive timeout, simulated time advances by
  /// at most the timeout. Paced: waits for at most the timeout of wall time.
  [[nodiscard]] virtual bool peek(std::chrono::milliseconds timeout) = 0;

  /// Queues a command for the next step.
  virtual void send(DeviceId device, const sim::Command& command) = 0;

  /// Sends any other request: `session.request(ObjectPoseRequest{"robot1"})` returns an ObjectPose.
  /// Each request documents its effect and its errors.
  template <typename One>
  typename One::Result request(One what) {
    if constexpr (std::is_void_v<typename One::Result>) {
      static_cast<void>(answer(Request(std::move(what))));
    } else {
      return std::get<typename One::Result>(answer(Request(std::move(what))));
    }
  }
  /// Like request(), for a request whose type is known only at run time.
  virtual Answer answer(const Request& request) = 0;

  /// Draws on the canvas (layer kBaseLayer) and on this session's layers, in order. Drawings are
  /// clipped to the canvas. Drawings on other layers, including those of other sessions, are
  /// skipped.
  void draw(std::span<const sim::DrawOperation> operations);
  /// The queue of drawings, for callers that draw cell by cell: push() is draw() without a virtual
  /// call. If a push fails, send a FlushDrawingsRequest and try again.
  [[nodiscard]] virtual DrawQueue& draw_queue() noexcept = 0;
  /// Number of resizes of the canvas by any client. The result of a CanvasInfoRequest is valid
  /// until this number changes. Cheap.
  [[nodiscard]] virtual std::uint64_t canvas_generation() const noexcept = 0;

  /// Opens another session of the same simulation and port, for a driver in its own thread. In
  /// lockstep such a follower holds simulated time while its thread computes, like any session. It
  /// never advances time alone: time stands still while no other session takes part. It does not
  /// count for the start gate. Its commands are executed before those of other sessions, so that a
  /// program's commands override the driver's.
  [[nodiscard]] virtual std::unique_ptr<Session> open_follower() = 0;
  /// Identity of the simulation: equal for all its sessions, and different from that of every other
  /// existing simulation.
  [[nodiscard]] virtual const void* simulation() const noexcept = 0;

  /// Ends the connection. Other clients no longer wait for this one. Threads that wait in this
  /// session throw.
  virtual void close() noexcept = 0;
};

}  // namespace playerlike
