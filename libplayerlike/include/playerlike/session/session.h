// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/devices/pen.h"

namespace playerlike {

/// Receives the readings of a round.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  /// `reading` is valid during the call only. Must not call the session back.
  virtual void on_reading(DeviceId device, const sim::Reading& reading) = 0;
};

/// A client's end of a connection to a simulation: the one seam between the client library and
/// whatever runs the world. Proxies cannot tell what stands behind it.
///
/// All members may be called from any thread. In lockstep a session belongs to the thread that
/// last waited on it, and simulated time stands still until every such thread waits again.
/// Calls on a closed session throw SessionError kDisconnected, but for those marked noexcept.
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

  /// Asks for a device's readings, as often as unsubscribe() is called later.
  virtual void subscribe(DeviceId device) = 0;
  virtual void unsubscribe(DeviceId device) = 0;
  /// Whether a newer reading replaces an older one that was not taken yet (default), or queues
  /// behind it (at most 1000; then the oldest is dropped and counted as overflow).
  /// @param device  nullopt: all devices, also those subscribed to later.
  virtual void set_replace(std::optional<DeviceId> device, bool replace) = 0;
  [[nodiscard]] virtual std::uint32_t overflow_count() const = 0;

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

  /// Draws on the canvas, in order; others see it from the next step on, this session at once.
  virtual void draw(std::span<const sim::CanvasOperation> operations) = 0;
  [[nodiscard]] virtual CanvasInfo canvas_info() const = 0;
  /// Colour of a cell; nullopt outside the canvas.
  [[nodiscard]] virtual std::optional<sim::Colour> pixel(int column, int row) = 0;
  /// All cells as RGBA bytes, row-major from the top.
  [[nodiscard]] virtual std::vector<std::uint8_t> canvas_image() = 0;

  [[nodiscard]] virtual TimeStatistics time() const = 0;
  /// Lets simulated time pass (lockstep), or waits (paced). seconds >= 0.
  virtual void sleep(double seconds) = 0;
  /// For clients that read in the background: switches a lockstep simulation whose time mode
  /// nobody chose to real time, once, with a warning. See docs/architecture.md.
  virtual void prefer_real_time(const std::string& reason) = 0;

  /// Ends the connection; the client no longer holds up others. Waiting threads throw.
  virtual void close() noexcept = 0;
};

}  // namespace playerlike
