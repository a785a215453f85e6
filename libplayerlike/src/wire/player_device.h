// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/session/session.h"
#include "protocol/player_structs.h"

/// Playpen's devices in the words of Player's protocol: readings become DATA messages, commands and
/// requests become calls of a session. docs/player_wire_interfaces.md lists them.
namespace playerlike::wire {

using player::Devaddr;

/// Receives the DATA messages of a device.
class DataSink {
 public:
  /// Takes a message of the device. @param subtype  e.g. PLAYER_LASER_DATA_SCAN.
  virtual void data(std::uint8_t subtype, std::string payload) = 0;

 protected:
  ~DataSink() = default;
};

/// The drawings of a command, in batches, because they may be many and take long to find.
class Drawings {
 public:
  Drawings() = default;
  Drawings(const Drawings&) = delete;
  Drawings& operator=(const Drawings&) = delete;
  virtual ~Drawings() = default;

  /// Replaces a list by the next drawings, of which there may be none yet: a batch is found in a
  /// few milliseconds. Needs neither the device nor its session.
  /// @return false: there are no more.
  virtual bool next(std::vector<sim::DrawOperation>& batch) = 0;
};

/// Makes an answer that takes long, as PlayerDevice::request() does. Needs no device; any thread
/// may call it, with a session of the client that is not checked any more.
using LongAnswer = std::function<std::optional<std::string>(Session&)>;

/// A device as a client of Player's protocol sees it. Each subscription has an object of its own,
/// because settings such as a laser's angles belong to the client.
///
/// Threads: an object must not be used by two threads at once.
class PlayerDevice {
 public:
  PlayerDevice() = default;
  PlayerDevice(const PlayerDevice&) = delete;
  PlayerDevice& operator=(const PlayerDevice&) = delete;
  virtual ~PlayerDevice() = default;

  /// The devices whose readings it needs. The caller subscribes to them and passes their readings
  /// to on_reading().
  [[nodiscard]] virtual std::vector<DeviceId> sources() const { return {}; }
  /// Turns a reading of one of the sources() into messages.
  virtual void on_reading(DeviceId device, const sim::Reading& reading, DataSink& sink);
  /// Sends data that do not come with readings, such as changes of the blackboard. To be called
  /// once a round. @throws SessionError.
  virtual void on_round(DataSink& sink);
  /// Executes a command. Unknown subtypes have no effect, as in Player.
  /// @throws protocol::ProtocolError for a payload that cannot be decoded, SessionError for a
  ///         command that the device refuses.
  virtual void command(std::uint8_t subtype, std::string_view payload);
  /// The drawings of a command that draws, for callers that execute them in turn with others;
  /// null: the command does not draw, see command(). @throws as command().
  [[nodiscard]] virtual std::unique_ptr<Drawings> drawings(std::uint8_t subtype,
                                                           std::string_view payload);
  /// Checks a request whose answer takes long, for callers that have others to serve. @return what
  /// makes the answer; empty: the answer does not take long, see request(). @throws as command().
  [[nodiscard]] virtual LongAnswer long_answer(std::uint8_t subtype, std::string_view payload);
  /// Answers a request.
  /// @return the payload of the acknowledgement; nullopt: the request is refused (NACK).
  /// @throws as command(); the request is then refused, too.
  [[nodiscard]] virtual std::optional<std::string> request(std::uint8_t subtype,
                                                           std::string_view payload);
  /// Name of the driver in Player's lists of devices: the device's or driver's type, or "world".
  [[nodiscard]] virtual std::string driver() const = 0;
};

/// Makes the device of an address for a client.
///
/// @param session  the client's, which checks its rights; it must outlive the device.
/// @param interface  e.g. "laser".
/// @return null if the interface is not offered to Player's clients.
/// @throws SessionError kNoSuchDevice if the port has no such device.
[[nodiscard]] std::unique_ptr<PlayerDevice> make_player_device(Session& session, int port,
                                                               std::string_view interface,
                                                               int index);

}  // namespace playerlike::wire
