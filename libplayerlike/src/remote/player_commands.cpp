// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "remote/player_commands.h"

#include <vector>

#include "protocol/player_xdr.h"
#include "session/player_values/aio.h"
#include "session/player_values/dio.h"
#include "session/player_values/gripper.h"
#include "session/player_values/position2d.h"
#include "session/player_values/ptz.h"

namespace playerlike {
namespace {

template <typename Payload>
PlayerCommand command_of(std::uint8_t subtype, const Payload& payload) {
  return {false, subtype, player::encode(payload)};
}

template <typename Payload>
PlayerCommand request_of(std::uint8_t subtype, const Payload& payload) {
  return {true, subtype, player::encode(payload)};
}

std::uint8_t flag(bool value) { return value ? 1 : 0; }
float narrow(double value) { return static_cast<float>(value); }

std::vector<float> narrow(const std::vector<double>& values) {
  std::vector<float> narrowed;
  narrowed.reserve(values.size());
  for (const double value : values) narrowed.push_back(narrow(value));
  return narrowed;
}

/// Converts each type of command; none that the interface does not know.
struct Converter {
  using Converted = std::optional<PlayerCommand>;

  unsigned interface;

  [[nodiscard]] bool drives() const { return interface == PLAYER_POSITION2D_CODE; }

  Converted operator()(const sim::TwistCommand& what) const {
    if (!drives()) return std::nullopt;
    auto payload = to_players<player::Position2dCmdVel>(what);
    payload.state = 1;
    return command_of(PLAYER_POSITION2D_CMD_VEL, payload);
  }
  Converted operator()(const sim::HeadingCommand& what) const {
    if (!drives()) return std::nullopt;
    return command_of(PLAYER_POSITION2D_CMD_VEL_HEAD,
                      to_players<player::Position2dCmdVelHead>(what));
  }
  Converted operator()(const sim::PositionCommand& what) const {
    if (!drives()) return std::nullopt;
    return command_of(PLAYER_POSITION2D_CMD_POS,
                      player::Position2dCmdPos{to_players<player::Pose2d>(what.goal),
                                               {what.max_speed_mps, 0.0, what.max_turn_rate_radps},
                                               1});
  }
  Converted operator()(const sim::CarCommand& what) const {
    if (!drives()) return std::nullopt;
    return command_of(PLAYER_POSITION2D_CMD_CAR, to_players<player::Position2dCmdCar>(what));
  }
  Converted operator()(const sim::MotorEnableCommand& what) const {
    if (!drives()) return std::nullopt;
    return request_of(PLAYER_POSITION2D_REQ_MOTOR_POWER,
                      player::Position2dPowerConfig{flag(what.enabled)});
  }
  Converted operator()(const sim::SetPoseCommand& what) const {
    if (interface == PLAYER_POSITION2D_CODE) {
      return request_of(PLAYER_POSITION2D_REQ_SET_ODOM,
                        player::Position2dSetOdomReq{to_players<player::Pose2d>(what.pose)});
    }
    if (interface == PLAYER_LOCALIZE_CODE) {
      // Without a covariance: 0.5 m and 15 degrees.
      constexpr double kPosition_m2 = 0.25;
      constexpr double kHeading_rad2 = 0.0685;
      player::LocalizeSetPose payload;
      payload.mean = to_players<player::Pose2d>(what.pose);
      const std::array<double, 3> variance =
          what.variance.value_or(std::array{kPosition_m2, kPosition_m2, kHeading_rad2});
      const std::array<double, 3> covariance = what.covariance.value_or(std::array<double, 3>{});
      std::copy(variance.begin(), variance.end(), payload.cov.begin());
      std::copy(covariance.begin(), covariance.end(), payload.cov.begin() + 3);
      return request_of(PLAYER_LOCALIZE_REQ_SET_POSE, payload);
    }
    if (interface == PLAYER_IMU_CODE) {
      player::ImuResetEulerConfig payload;
      payload.orientation.pyaw = what.pose.yaw_rad;
      return request_of(PLAYER_IMU_REQ_RESET_EULER, payload);
    }
    return std::nullopt;
  }

  Converted operator()(const sim::SayCommand& what) const {
    if (interface != PLAYER_SPEECH_CODE) return std::nullopt;
    return command_of(PLAYER_SPEECH_CMD_SAY, player::SpeechCmd{player::text_bytes(what.text)});
  }
  Converted operator()(const sim::DigitalOutputCommand& what) const {
    if (interface != PLAYER_DIO_CODE) return std::nullopt;
    return command_of(PLAYER_DIO_CMD_VALUES, to_players<player::DioCmd>(what));
  }
  Converted operator()(const sim::AnalogOutputCommand& what) const {
    if (interface != PLAYER_AIO_CODE) return std::nullopt;
    return command_of(PLAYER_AIO_CMD_STATE, to_players<player::AioCmd>(what));
  }
  Converted operator()(const sim::OpaqueCommand& what) const {
    if (interface != PLAYER_OPAQUE_CODE) return std::nullopt;
    return command_of(PLAYER_OPAQUE_CMD_DATA, player::OpaqueData{what.data});
  }

  /// A command to flash has both period and duty cycle; the session adds the one that is missing.
  Converted operator()(const sim::LightCommand& what) const {
    if (interface != PLAYER_BLINKENLIGHT_CODE) return std::nullopt;
    if (const auto& colour = what.colour) {
      return command_of(PLAYER_BLINKENLIGHT_CMD_COLOR,
                        player::BlinkenlightCmdColor{0, {0, colour->r, colour->g, colour->b}});
    }
    if (what.period_s || what.duty_cycle) {
      return command_of(PLAYER_BLINKENLIGHT_CMD_FLASH,
                        player::BlinkenlightCmdFlash{0, narrow(what.period_s.value_or(1.0)),
                                                     narrow(what.duty_cycle.value_or(0.5))});
    }
    return command_of(PLAYER_BLINKENLIGHT_CMD_POWER,
                      player::BlinkenlightCmdPower{0, flag(what.enabled.value_or(true))});
  }

  Converted operator()(const sim::GripCommand& what) const {
    if (interface != PLAYER_GRIPPER_CODE) return std::nullopt;
    return command_of(grip_command(what.action), player::Empty{});
  }

  Converted operator()(const sim::PointCommand& what) const {
    if (interface != PLAYER_PTZ_CODE) return std::nullopt;
    return command_of(PLAYER_PTZ_CMD_STATE, to_players<player::PtzCmd>(what));
  }
  Converted operator()(const sim::PanCommand& what) const {
    if (interface != PLAYER_PTZ_CODE) return std::nullopt;
    return command_of(PLAYER_PTZ_CMD_STATE, to_players<player::PtzCmd>(what));
  }

  Converted operator()(const sim::JointCommand& what) const {
    if (interface != PLAYER_ACTARRAY_CODE) return std::nullopt;
    using Mode = sim::JointCommand::Mode;
    switch (what.mode) {
      case Mode::kPlace:
        return std::nullopt;  // a real arm cannot
      case Mode::kPosition:
        return move<player::ActarrayPositionCmd, player::ActarrayMultiPositionCmd>(
            what, PLAYER_ACTARRAY_CMD_POS, PLAYER_ACTARRAY_CMD_MULTI_POS);
      case Mode::kSpeed:
        return move<player::ActarraySpeedCmd, player::ActarrayMultiSpeedCmd>(
            what, PLAYER_ACTARRAY_CMD_SPEED, PLAYER_ACTARRAY_CMD_MULTI_SPEED);
      case Mode::kCurrent:
        return move<player::ActarrayCurrentCmd, player::ActarrayMultiCurrentCmd>(
            what, PLAYER_ACTARRAY_CMD_CURRENT, PLAYER_ACTARRAY_CMD_MULTI_CURRENT);
      case Mode::kHome:
        break;
    }
    return command_of(PLAYER_ACTARRAY_CMD_HOME, player::ActarrayHomeCmd{what.joint});
  }
  Converted operator()(const sim::JointSettingCommand& what) const {
    if (interface != PLAYER_ACTARRAY_CODE) return std::nullopt;
    using Setting = sim::JointSettingCommand::Setting;
    switch (what.setting) {
      case Setting::kPower:
        return request_of(PLAYER_ACTARRAY_REQ_POWER,
                          player::ActarrayPowerConfig{flag(what.value != 0.0)});
      case Setting::kBrakes:
        return request_of(PLAYER_ACTARRAY_REQ_BRAKES,
                          player::ActarrayBrakesConfig{flag(what.value != 0.0)});
      case Setting::kSpeed:
        return request_of(PLAYER_ACTARRAY_REQ_SPEED,
                          player::ActarraySpeedConfig{what.joint, narrow(what.value)});
      case Setting::kAcceleration:
        break;
    }
    return request_of(PLAYER_ACTARRAY_REQ_ACCEL,
                      player::ActarrayAccelConfig{what.joint, narrow(what.value)});
  }

  /// The command to one joint, or to several from the first one on.
  template <typename One, typename Many>
  static PlayerCommand move(const sim::JointCommand& what, std::uint8_t one, std::uint8_t many) {
    if (what.values.size() > 1) return command_of(many, Many{narrow(what.values)});
    return command_of(one,
                      One{what.joint, what.values.empty() ? 0.0F : narrow(what.values.front())});
  }

  // Player has neither waypoints nor teleports of a robot.
  Converted operator()(const sim::GotoCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::StopCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::ResumeCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::PlaceCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::TranslateCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::RotateCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::OrientCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::TrackCommand& /*what*/) const { return std::nullopt; }
  Converted operator()(const sim::TrajectoryCommand& /*what*/) const { return std::nullopt; }
};

}  // namespace

PlayerCommand to_player(const DeviceDrawing& drawing) {
  const auto colour_of = [](const sim::Colour& colour) {
    player::Color converted;
    converted.alpha = colour.a;
    converted.red = colour.r;
    converted.green = colour.g;
    converted.blue = colour.b;
    return converted;
  };
  const auto points_of = [&](auto payload) {
    for (const sim::Vec2& point : drawing.points) {
      payload.points.push_back({point.x(), point.y()});
    }
    payload.color = colour_of(drawing.colour);
    return payload;
  };
  using Kind = DeviceDrawing::Kind;
  switch (drawing.kind) {
    case Kind::kPoints:
      return command_of(PLAYER_GRAPHICS2D_CMD_POINTS, points_of(player::Graphics2dCmdPoints()));
    case Kind::kPolyline:
      return command_of(PLAYER_GRAPHICS2D_CMD_POLYLINE, points_of(player::Graphics2dCmdPolyline()));
    case Kind::kMultiline:
      return command_of(PLAYER_GRAPHICS2D_CMD_MULTILINE,
                        points_of(player::Graphics2dCmdMultiline()));
    case Kind::kPolygon: {
      auto payload = points_of(player::Graphics2dCmdPolygon());
      payload.fill_color = colour_of(drawing.fill);
      payload.filled = flag(drawing.filled);
      return command_of(PLAYER_GRAPHICS2D_CMD_POLYGON, payload);
    }
    case Kind::kClear:
      break;
  }
  return command_of(PLAYER_GRAPHICS2D_CMD_CLEAR, player::Empty{});
}

std::optional<PlayerCommand> to_player(unsigned interface, const sim::Command& command) {
  return std::visit(Converter{interface}, command);
}

}  // namespace playerlike
