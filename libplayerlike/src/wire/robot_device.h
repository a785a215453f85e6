// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "playerlike/session/session.h"
#include "protocol/player_structs.h"
#include "protocol/player_xdr.h"
#include "session/player_values.h"
#include "session/player_values/poses.h"
#include "session/range_settings.h"
#include "session/reading_as.h"
#include "wire/player_device.h"

/// Shared parts of the devices of Player's protocol.
namespace playerlike::wire {

/// What every device knows: its session, and the address behind it.
struct DeviceContext {
  Session& session;
  int interface = 0;  ///< Player's code
  int index = 0;
  InterfaceBinding binding;
};

/// A device with the requests that all interfaces share: capabilities and properties.
class CommonDevice : public PlayerDevice {
 public:
  explicit CommonDevice(DeviceContext context) : context_(std::move(context)) {}

  [[nodiscard]] std::optional<std::string> request(std::uint8_t subtype,
                                                   std::string_view payload) final;
  [[nodiscard]] std::string driver() const override { return "world"; }

 protected:
  /// Answers a request of the interface; see PlayerDevice::request().
  [[nodiscard]] virtual std::optional<std::string> answer(std::uint8_t subtype,
                                                          std::string_view payload);
  /// The device's numeric settings; null without a device.
  [[nodiscard]] virtual const DeviceSettings* settings() const { return nullptr; }
  /// Answers a request for a property that is no setting. @return nullopt for other properties.
  [[nodiscard]] virtual std::optional<std::string> own_property(std::uint8_t /*subtype*/,
                                                                std::string_view /*payload*/) {
    return std::nullopt;
  }
  /// A text property by its name; none without a device.
  [[nodiscard]] virtual std::optional<std::string> text_setting(const std::string& /*name*/) const {
    return std::nullopt;
  }

  [[nodiscard]] Session& session() const { return context_.session; }
  [[nodiscard]] const InterfaceBinding& binding() const { return context_.binding; }
  /// Current simulated time.
  [[nodiscard]] sim::SimTime now_ns() const;

 private:
  [[nodiscard]] bool has_capability(std::string_view payload) const;
  [[nodiscard]] std::optional<std::string> text_answer(std::string_view payload) const;

  const DeviceContext context_;
};

/// A device of a robot.
class RobotDevice : public CommonDevice {
 public:
  /// @throws SessionError kNoSuchDevice if the binding names no device of the session.
  explicit RobotDevice(const DeviceContext& context);

  [[nodiscard]] std::vector<DeviceId> sources() const override { return {binding().reading}; }
  [[nodiscard]] std::string driver() const override;

 protected:
  [[nodiscard]] const DeviceSettings* settings() const override { return &info_.properties; }
  [[nodiscard]] std::optional<std::string> text_setting(const std::string& name) const override {
    return text_property(robot_, info_, name);
  }
  [[nodiscard]] const RobotInfo& robot() const { return robot_; }
  [[nodiscard]] const DeviceInfo& info() const { return info_; }
  [[nodiscard]] double setting(const std::string& name) const {
    return setting_of(info_.properties, name);
  }
  /// A setting that is a whole number in [0, most]; other values are clamped.
  [[nodiscard]] std::uint32_t count_setting(const std::string& name, std::uint32_t most) const;
  /// Sends a command to the device that readings come from.
  void send(const sim::Command& command) const { session().send(binding().reading, command); }

 private:
  const RobotInfo& robot_;
  const DeviceInfo& info_;
};

/// A device whose readings are one of Player's structs, see same_values().
template <typename Reading, typename Data, std::uint8_t kSubtype>
class PlainDevice : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* measured = reading_as<Reading>(reading);
    if (measured != nullptr) sink.data(kSubtype, player::encode(to_players<Data>(*measured)));
  }
};

/// @name Values in Player's form
/// @{
[[nodiscard]] inline player::Pose2d pose_2d(const sim::Pose& pose) {
  return to_players<player::Pose2d>(pose);
}
/// @param placed  a Mounting or a sim::Pose.
[[nodiscard]] player::Pose3d pose_3d(const auto& placed) {
  return to_players<player::Pose3d>(placed);
}
/// @param sized  a BoxSize or a RobotInfo.
[[nodiscard]] player::Bbox3d box_3d(const auto& sized) { return to_players<player::Bbox3d>(sized); }
/// @}

/// A text of a message without its final zero byte.
/// @param what  "the name of the object".
/// @throws SessionError kBadArgument if it has control characters, since it may be shown.
[[nodiscard]] std::string printable_text(const char* what, std::string_view bytes);

/// Encodes a payload of about this length without allocating memory twice [bytes].
template <typename Payload>
[[nodiscard]] std::string encode_long(const Payload& payload, std::size_t length) {
  std::string bytes;
  bytes.reserve(length);
  player::append(bytes, payload);
  return bytes;
}

/// Payload of messages without fields.
[[nodiscard]] inline std::string empty_payload() { return {}; }

/// Throws SessionError kBadArgument if a number is NaN or infinite. @param what  "a joint's speed".
void require_number(const char* what, double value);

/// @name Makers of devices, by family
/// @return null if the family does not have the interface.
/// @{
using MadeDevice = std::unique_ptr<PlayerDevice>;
[[nodiscard]] MadeDevice make_ranging_device(const DeviceContext& context);
[[nodiscard]] MadeDevice make_driving_device(const DeviceContext& context);
[[nodiscard]] MadeDevice make_sensing_device(const DeviceContext& context);
[[nodiscard]] MadeDevice make_acting_device(const DeviceContext& context);
[[nodiscard]] MadeDevice make_drawing_device(const DeviceContext& context);
[[nodiscard]] MadeDevice make_world_device(const DeviceContext& context);
/// @}

}  // namespace playerlike::wire
