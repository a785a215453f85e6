// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "wire/player_device.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libplayerinterface/player_constants.h"
#include "proxies/interfaces.h"
#include "session/checks.h"
#include "wire/robot_device.h"

namespace playerlike::wire {

void PlayerDevice::on_reading(DeviceId device, const sim::Reading& reading, DataSink& sink) {
  static_cast<void>(device);
  static_cast<void>(reading);
  static_cast<void>(sink);
}

void PlayerDevice::on_round(DataSink& sink) { static_cast<void>(sink); }

void PlayerDevice::command(std::uint8_t subtype, std::string_view payload) {
  static_cast<void>(subtype);
  static_cast<void>(payload);
}

std::unique_ptr<Drawings> PlayerDevice::drawings(std::uint8_t subtype, std::string_view payload) {
  static_cast<void>(subtype);
  static_cast<void>(payload);
  return nullptr;
}

LongAnswer PlayerDevice::long_answer(std::uint8_t subtype, std::string_view payload) {
  static_cast<void>(subtype);
  static_cast<void>(payload);
  return {};
}

std::optional<std::string> PlayerDevice::request(std::uint8_t subtype, std::string_view payload) {
  static_cast<void>(subtype);
  static_cast<void>(payload);
  return std::nullopt;
}

// --- CommonDevice

bool CommonDevice::has_capability(std::string_view payload) const {
  const auto asked = player::decode<player::CapabilitiesReq>(payload);
  if (asked.type == PLAYER_MSGTYPE_REQ &&
      (asked.subtype == PLAYER_CAPABILITIES_REQ || asked.subtype == PLAYER_GET_BOOLPROP_REQ ||
       asked.subtype == PLAYER_GET_INTPROP_REQ || asked.subtype == PLAYER_GET_DBLPROP_REQ ||
       asked.subtype == PLAYER_GET_STRPROP_REQ)) {
    return true;
  }
  // A robot without motors still has position2d devices.
  const bool needs_motors =
      context_.interface == PLAYER_POSITION2D_CODE &&
      (asked.type == PLAYER_MSGTYPE_CMD ||
       (asked.type == PLAYER_MSGTYPE_REQ && asked.subtype == PLAYER_POSITION2D_REQ_MOTOR_POWER));
  return PlayerCc::has_message(static_cast<std::uint32_t>(context_.interface), asked.type,
                               asked.subtype) &&
         (!needs_motors || context_.binding.motion.has_value());
}

namespace {

// Answers a request for a numeric property with `accepts(value)`, in the request's own form.
template <typename Property, typename Accepts>
std::optional<std::string> property_answer(const DeviceSettings* settings, std::string_view payload,
                                           Accepts accepts) {
  auto asked = player::decode<Property>(payload);
  if (settings == nullptr) return std::nullopt;
  const auto found = settings->find(player::text_of(asked.key));
  if (found == settings->end() || !accepts(found->second)) return std::nullopt;
  asked.value = static_cast<decltype(asked.value)>(found->second);
  return player::encode(asked);
}

// The server's log gets the reason.
template <typename Property>
[[noreturn]] void refuse_to_set(std::string_view payload) {
  constexpr std::size_t kShown = 64;
  std::string key = player::text_of(player::decode<Property>(payload).key).substr(0, kShown);
  if (!is_printable(key)) key = "?";
  throw SessionError(SessionError::Code::kNotAvailable,
                     "the property \"" + key +
                         "\" cannot be set: properties are settings of the world file, which do "
                         "not change during a run");
}

}  // namespace

std::optional<std::string> CommonDevice::text_answer(std::string_view payload) const {
  auto asked = player::decode<player::StrpropReq>(payload);
  const std::optional<std::string> text = text_setting(player::text_of(asked.key));
  if (!text) return std::nullopt;
  asked.value = player::text_bytes(*text);
  return player::encode(asked);
}

std::optional<std::string> CommonDevice::request(std::uint8_t subtype, std::string_view payload) {
  if (auto own = own_property(subtype, payload)) return own;
  switch (subtype) {
    case PLAYER_CAPABILITIES_REQ:
      return has_capability(payload) ? std::optional(empty_payload()) : std::nullopt;
    case PLAYER_GET_DBLPROP_REQ:
      return property_answer<player::DblpropReq>(settings(), payload, [](double) { return true; });
    case PLAYER_GET_INTPROP_REQ:
      return property_answer<player::IntpropReq>(settings(), payload, [](double value) {
        return value == std::floor(value) &&
               std::abs(value) <= std::numeric_limits<std::int32_t>::max();
      });
    case PLAYER_GET_BOOLPROP_REQ:
      return property_answer<player::BoolpropReq>(
          settings(), payload, [](double value) { return value == 0.0 || value == 1.0; });
    case PLAYER_GET_STRPROP_REQ:
      return text_answer(payload);
    case PLAYER_SET_BOOLPROP_REQ:
      refuse_to_set<player::BoolpropReq>(payload);
    case PLAYER_SET_INTPROP_REQ:
      refuse_to_set<player::IntpropReq>(payload);
    case PLAYER_SET_DBLPROP_REQ:
      refuse_to_set<player::DblpropReq>(payload);
    case PLAYER_SET_STRPROP_REQ:
      refuse_to_set<player::StrpropReq>(payload);
    default:
      return answer(subtype, payload);
  }
}

std::optional<std::string> CommonDevice::answer(std::uint8_t subtype, std::string_view payload) {
  static_cast<void>(subtype);
  static_cast<void>(payload);
  return std::nullopt;
}

sim::SimTime CommonDevice::now_ns() const { return session().request(TimeRequest{}).sim_time_ns; }

// --- RobotDevice

RobotDevice::RobotDevice(const DeviceContext& context)
    : CommonDevice(context),
      robot_(context.session.robots().at(static_cast<std::size_t>(context.binding.robot))),
      info_(require_device(context.session.robots(), context.binding.reading)) {}

std::string RobotDevice::driver() const {
  const char* const type = binding().driver_type();
  return type != nullptr ? type : info_.type;
}

std::uint32_t RobotDevice::count_setting(const std::string& name, std::uint32_t most) const {
  const double count = setting(name);
  if (!(count > 0.0)) return 0;  // or NaN
  return static_cast<std::uint32_t>(std::llround(std::min<double>(count, most)));
}

void require_number(const char* what, double value) {
  if (std::isfinite(value)) return;
  throw SessionError(SessionError::Code::kBadArgument,
                     std::string(what) + " must be a finite number");
}

std::string printable_text(const char* what, std::string_view bytes) {
  std::string text = player::text_of(bytes);
  if (is_printable(text)) return text;
  throw SessionError(SessionError::Code::kBadArgument,
                     std::string(what) + " has control characters");
}

std::unique_ptr<PlayerDevice> make_player_device(Session& session, int port,
                                                 std::string_view interface, int index) {
  const std::optional<int> code = PlayerCc::interface_code(std::string(interface));
  if (!code) return nullptr;
  const DeviceContext context{session, *code, index,
                              find_interface(session.robots(), port, interface, index)};
  for (const auto make : {make_driving_device, make_ranging_device, make_sensing_device,
                          make_acting_device, make_drawing_device, make_world_device}) {
    if (MadeDevice made = make(context)) return made;
  }
  return nullptr;
}

}  // namespace playerlike::wire
