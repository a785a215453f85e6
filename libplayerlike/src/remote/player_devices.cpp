// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Calls of a Player session that belong to one interface: drawings, planners, properties and
// particles.
#include <cmath>
#include <type_traits>

#include "protocol/player_xdr.h"
#include "remote/player_commands.h"
#include "remote/player_session.h"
#include "session/player_values.h"
#include "session/player_values/poses.h"

namespace playerlike {

// --- graphics2d

void PlayerSession::draw(unsigned index, const DeviceDrawing& drawing) {
  require_open();
  tell(address_of(PLAYER_GRAPHICS2D_CODE, index), to_player(drawing));
}

// --- planner

namespace {

PlayerCommand planner_command(std::uint8_t subtype, const sim::Pose& pose) {
  return {false, subtype, player::encode(player::PlannerCmd{to_players<player::Pose2d>(pose)})};
}

}  // namespace

void PlayerSession::set_planner_goal(unsigned index, const sim::Pose& goal) {
  require_open();
  tell(address_of(PLAYER_PLANNER_CODE, index), planner_command(PLAYER_PLANNER_CMD_GOAL, goal));
}

void PlayerSession::set_planner_start(unsigned index, const sim::Pose& start) {
  require_open();
  tell(address_of(PLAYER_PLANNER_CODE, index), planner_command(PLAYER_PLANNER_CMD_START, start));
}

void PlayerSession::enable_planner(unsigned index, bool on) {
  require_open();
  const player::PlannerEnableReq payload{static_cast<std::uint8_t>(on ? 1 : 0)};
  tell(address_of(PLAYER_PLANNER_CODE, index),
       {true, PLAYER_PLANNER_REQ_ENABLE, player::encode(payload)});
}

DevicePlanners::Path PlayerSession::planner_path(unsigned index) {
  require_open();
  const std::string bytes =
      ask(address_of(PLAYER_PLANNER_CODE, index), PLAYER_PLANNER_REQ_GET_WAYPOINTS, {});
  Path path;
  try {
    const auto answer = player::decode<player::PlannerWaypointsReq>(bytes);
    path.length_m = answer.waypoints_distance;
    path.waypoints.reserve(answer.waypoints.size());
    for (const player::Pose2d& pose : answer.waypoints) {
      path.waypoints.push_back(from_players<sim::Pose>(pose));
    }
  } catch (const protocol::ProtocolError& e) {
    refuse_bytes(*link(), e.what());
  }
  return path;
}

// --- Properties

namespace {

/// The messages of properties of each type.
template <typename T>
struct PropertyMessages;
template <>
struct PropertyMessages<bool> {
  using Payload = player::BoolpropReq;
  static constexpr std::uint8_t kGet = PLAYER_GET_BOOLPROP_REQ;
  static constexpr std::uint8_t kSet = PLAYER_SET_BOOLPROP_REQ;
};
template <>
struct PropertyMessages<std::int32_t> {
  using Payload = player::IntpropReq;
  static constexpr std::uint8_t kGet = PLAYER_GET_INTPROP_REQ;
  static constexpr std::uint8_t kSet = PLAYER_SET_INTPROP_REQ;
};
template <>
struct PropertyMessages<double> {
  using Payload = player::DblpropReq;
  static constexpr std::uint8_t kGet = PLAYER_GET_DBLPROP_REQ;
  static constexpr std::uint8_t kSet = PLAYER_SET_DBLPROP_REQ;
};
template <>
struct PropertyMessages<std::string> {
  using Payload = player::StrpropReq;
  static constexpr std::uint8_t kGet = PLAYER_GET_STRPROP_REQ;
  static constexpr std::uint8_t kSet = PLAYER_SET_STRPROP_REQ;
};

template <typename T>
std::string property_request(const std::string& name, const T& value) {
  typename PropertyMessages<T>::Payload payload;
  payload.key = player::text_bytes(name);
  if constexpr (std::is_same_v<T, std::string>) {
    payload.value = player::text_bytes(value);
  } else {
    payload.value = static_cast<decltype(payload.value)>(value);
  }
  return player::encode(payload);
}

}  // namespace

std::optional<std::string> PlayerSession::try_to_ask(Address& address, std::uint8_t subtype,
                                                     std::string_view payload) {
  try {
    return ask(address, subtype, payload);
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kNotAvailable) throw;
    return std::nullopt;
  }
}

std::optional<DeviceProperties::Value> PlayerSession::property(unsigned interface, unsigned index,
                                                               const std::string& name,
                                                               const Value& kind) {
  require_open();
  Address& address = address_of(interface, index);
  return std::visit(
      [&]<typename T>(const T& /*any*/) -> std::optional<Value> {
        const auto bytes =
            try_to_ask(address, PropertyMessages<T>::kGet, property_request(name, T{}));
        if (!bytes) return std::nullopt;
        try {
          const auto answer = player::decode<typename PropertyMessages<T>::Payload>(*bytes);
          if constexpr (std::is_same_v<T, std::string>) {
            return player::text_of(answer.value);
          } else if constexpr (std::is_same_v<T, bool>) {
            return answer.value != 0;
          } else {
            return answer.value;
          }
        } catch (const protocol::ProtocolError& e) {
          refuse_bytes(*link(), e.what());
        }
      },
      kind);
}

bool PlayerSession::set_property(unsigned interface, unsigned index, const std::string& name,
                                 const Value& value) {
  require_open();
  Address& address = address_of(interface, index);
  return std::visit(
      [&]<typename T>(const T& wanted) {
        return try_to_ask(address, PropertyMessages<T>::kSet, property_request(name, wanted))
            .has_value();
      },
      value);
}

Charge PlayerSession::take_charge(const TakeChargeRequest& what) {
  require_open();
  Address& address = address_of(what.device);
  if (address.at.interf != PLAYER_POSITION2D_CODE) return {};
  const std::string name = kWatchdogProperty;
  if (!has_watchdog_) {
    has_watchdog_ =
        try_to_ask(address, PLAYER_GET_DBLPROP_REQ, property_request(name, 0.0)).has_value();
  }
  if (!*has_watchdog_) return {};
  if (what.take_over) {
    static_cast<void>(try_to_ask(address, PLAYER_SET_BOOLPROP_REQ,
                                 property_request<bool>(kTakeOverProperty, true)));
  }
  try {
    static_cast<void>(
        ask(address, PLAYER_SET_DBLPROP_REQ, property_request(name, what.watchdog_s)));
  } catch (const SessionError& e) {
    if (e.code() != SessionError::Code::kNotAvailable) throw;
    throw SessionError(e.code(),
                       "another client is in charge of the robot, or has taken over; ask to take "
                       "over, or wait until it has left (" +
                           std::string(e.what()) + ')');
  }
  return {true, false};
}

// --- localize

std::vector<LocalizationParticle> PlayerSession::particles(DeviceId device) {
  Address& address = address_of(device);
  if (address.at.interf != PLAYER_LOCALIZE_CODE) {
    throw SessionError(SessionError::Code::kBadArgument, address.name + " has no particles");
  }
  const std::string bytes = ask(address, PLAYER_LOCALIZE_REQ_GET_PARTICLES, {});
  std::vector<LocalizationParticle> particles;
  try {
    for (const auto& particle : player::decode<player::LocalizeGetParticles>(bytes).particles) {
      const auto& [px, py, pa] = particle.pose;
      if (!std::isfinite(px + py + pa + particle.alpha)) continue;
      particles.push_back({normalized_pose(particle.pose), particle.alpha});
    }
  } catch (const protocol::ProtocolError& e) {
    refuse_bytes(*link(), e.what());
  }
  return particles;
}

}  // namespace playerlike
