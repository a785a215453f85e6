// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that act, or take messages: actarray, aio, blinkenlight, dio, gripper, opaque, ptz and
// speech.
#include <algorithm>
#include <cmath>
#include <memory>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/actarray.h"
#include "session/player_values/aio.h"
#include "session/player_values/blinkenlight.h"
#include "session/player_values/dio.h"
#include "session/player_values/gripper.h"
#include "session/player_values/ptz.h"
#include "session/player_values/speech.h"
#include "sim/devices/opaque.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

[[noreturn]] void refuse_value(const std::string& text) {
  throw SessionError(SessionError::Code::kBadArgument, text);
}

// --- actarray

class ActArray final : public RobotDevice {
 public:
  explicit ActArray(const DeviceContext& context)
      : RobotDevice(context), count_(count_setting("count", sim::ActArrayParams::kMaxJoints)) {}

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* measured = reading_as<sim::ActArrayReading>(reading);
    if (measured == nullptr) return;
    newest_ = measured->joints;
    sink.data(PLAYER_ACTARRAY_DATA_STATE,
              player::encode(to_players<player::ActarrayData>(*measured)));
  }

  void command(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_ACTARRAY_CMD_POS:
        return move_one(Mode::kPosition, player::decode<player::ActarrayPositionCmd>(payload));
      case PLAYER_ACTARRAY_CMD_MULTI_POS:
        return move(Mode::kPosition, 0,
                    player::decode<player::ActarrayMultiPositionCmd>(payload).positions);
      case PLAYER_ACTARRAY_CMD_SPEED:
        return move_one(Mode::kSpeed, player::decode<player::ActarraySpeedCmd>(payload));
      case PLAYER_ACTARRAY_CMD_MULTI_SPEED:
        return move(Mode::kSpeed, 0, player::decode<player::ActarrayMultiSpeedCmd>(payload).speeds);
      case PLAYER_ACTARRAY_CMD_HOME:
        return move(Mode::kHome, player::decode<player::ActarrayHomeCmd>(payload).joint, {});
      case PLAYER_ACTARRAY_CMD_CURRENT:
        return move_one(Mode::kCurrent, player::decode<player::ActarrayCurrentCmd>(payload));
      case PLAYER_ACTARRAY_CMD_MULTI_CURRENT:
        return move(Mode::kCurrent, 0,
                    player::decode<player::ActarrayMultiCurrentCmd>(payload).currents);
      default:
        return;
    }
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_ACTARRAY_REQ_GET_GEOM:
        return player::encode(geometry());
      case PLAYER_ACTARRAY_REQ_POWER:
        set(Setting::kPower, -1,
            player::decode<player::ActarrayPowerConfig>(payload).value != 0 ? 1.0 : 0.0);
        return empty_payload();
      case PLAYER_ACTARRAY_REQ_BRAKES:
        set(Setting::kBrakes, -1,
            player::decode<player::ActarrayBrakesConfig>(payload).value != 0 ? 1.0 : 0.0);
        return empty_payload();
      case PLAYER_ACTARRAY_REQ_SPEED: {
        const auto asked = player::decode<player::ActarraySpeedConfig>(payload);
        set_rate(Setting::kSpeed, asked.joint, static_cast<double>(asked.speed));
        return empty_payload();
      }
      case PLAYER_ACTARRAY_REQ_ACCEL: {
        const auto asked = player::decode<player::ActarrayAccelConfig>(payload);
        set_rate(Setting::kAcceleration, asked.joint, static_cast<double>(asked.accel));
        return empty_payload();
      }
      default:
        return std::nullopt;
    }
  }

 private:
  using Mode = sim::JointCommand::Mode;
  using Setting = sim::JointSettingCommand::Setting;

  void require_joint(std::int32_t joint) const {
    if (joint == -1 || (joint >= 0 && static_cast<std::uint32_t>(joint) < count_)) return;
    refuse_value("there is no joint " + std::to_string(joint) + ": there are " +
                 std::to_string(count_) + ", counted from 0");
  }

  void move_one(Mode mode, const auto& asked) const {
    const auto& [joint, value] = asked;
    move(mode, joint, {value});
  }

  // Values beyond the last joint have no effect.
  void move(Mode mode, std::int32_t joint, const std::vector<float>& values) const {
    require_joint(joint);
    if (mode != Mode::kHome && values.empty()) return;
    sim::JointCommand command{mode, joint, {}};
    const std::size_t count = std::min<std::size_t>(values.size(), count_);
    for (std::size_t i = 0; i < count; ++i) {
      command.values.push_back(static_cast<double>(values[i]));
    }
    send(command);
  }

  void set(Setting setting, std::int32_t joint, double value) const {
    require_joint(joint);
    send(sim::JointSettingCommand{setting, joint, value});
  }

  void set_rate(Setting setting, std::int32_t joint, double value) const {
    if (!(value > 0.0)) refuse_value("the speed or acceleration of a joint must be positive");
    set(setting, joint, value);
  }

  [[nodiscard]] player::ActarrayGeom geometry() const {
    player::ActarrayGeom geometry;
    for (std::size_t i = 0; i < count_; ++i) {
      geometry.actuators.push_back(actuator_geometry<player::ActarrayActuatorgeom>(
          *settings(), i, i < newest_.size() ? &newest_[i] : nullptr));
    }
    const Mounting base = mounting_of(*settings());
    geometry.base_pos = {base.x_m, base.y_m, base.z_m};
    geometry.base_orientation = {setting("roll"), setting("pitch"), base.yaw_rad};
    return geometry;
  }

  std::uint32_t count_;
  std::vector<sim::JointReading> newest_;  // empty before the first reading
};

// --- Inputs and outputs

class Aio final : public PlainDevice<sim::AioReading, player::AioData, PLAYER_AIO_DATA_STATE> {
 public:
  using PlainDevice::PlainDevice;

  void command(std::uint8_t subtype, std::string_view payload) override {
    if (subtype != PLAYER_AIO_CMD_STATE) return;
    const auto asked = player::decode<player::AioCmd>(payload);
    const std::uint32_t count = count_setting("outputs", sim::AioParams::kMaxLines);
    const auto output = from_players<sim::AnalogOutputCommand>(asked);
    if (asked.id >= count || !is_line_voltage(output.voltage_v)) {
      refuse_value(output_fault(asked.id, output.voltage_v, count));
    }
    send(output);
  }
};

class Dio final : public PlainDevice<sim::DioReading, player::DioData, PLAYER_DIO_DATA_VALUES> {
 public:
  using PlainDevice::PlainDevice;

  void command(std::uint8_t subtype, std::string_view payload) override {
    if (subtype != PLAYER_DIO_CMD_VALUES) return;
    auto asked = player::decode<player::DioCmd>(payload);
    asked.count = std::min(asked.count, count_setting("outputs", sim::DioParams::kMaxLines));
    send(from_players<sim::DigitalOutputCommand>(asked));
  }
};

class Blinkenlight final : public PlainDevice<sim::BlinkenlightReading, player::BlinkenlightData,
                                              PLAYER_BLINKENLIGHT_DATA_STATE> {
 public:
  using PlainDevice::PlainDevice;

  void command(std::uint8_t subtype, std::string_view payload) override {
    sim::LightCommand change;
    switch (subtype) {
      case PLAYER_BLINKENLIGHT_CMD_STATE: {
        const auto asked = player::decode<player::BlinkenlightCmd>(payload);
        change.enabled = asked.enable != 0;
        set_flashing(asked.period, asked.dutycycle, change);
        set_colour(asked.color, change);
        break;
      }
      case PLAYER_BLINKENLIGHT_CMD_POWER:
        change.enabled = player::decode<player::BlinkenlightCmdPower>(payload).enable != 0;
        break;
      case PLAYER_BLINKENLIGHT_CMD_COLOR:
        set_colour(player::decode<player::BlinkenlightCmdColor>(payload).color, change);
        break;
      case PLAYER_BLINKENLIGHT_CMD_FLASH: {
        const auto asked = player::decode<player::BlinkenlightCmdFlash>(payload);
        set_flashing(asked.period, asked.dutycycle, change);
        break;
      }
      default:
        return;
    }
    send(change);
  }

 private:
  static void set_colour(const player::Color& colour, sim::LightCommand& change) {
    change.colour = sim::Colour{colour.red, colour.green, colour.blue, 255};
  }
  static void set_flashing(float period, float duty_cycle, sim::LightCommand& change) {
    change.period_s = static_cast<double>(period);
    change.duty_cycle = static_cast<double>(duty_cycle);
    if (const auto fault = flashing_fault(change)) refuse_value(*fault);
  }
};

// --- Gripper and camera head

class Gripper final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* measured = reading_as<sim::GripperReading>(reading);
    if (measured == nullptr) return;
    sink.data(PLAYER_GRIPPER_DATA_STATE,
              player::encode(player::GripperData{
                  gripper_state_code(measured->state), broken_beams(*measured),
                  static_cast<std::uint8_t>(std::clamp(measured->stored, 0, 255))}));
  }

  void command(std::uint8_t subtype, std::string_view payload) override {
    const auto action = grip_action(subtype);
    if (!action) return;
    static_cast<void>(player::decode<player::Empty>(payload));
    send(sim::GripCommand{*action});
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view /*payload*/) override {
    if (subtype != PLAYER_GRIPPER_REQ_GET_GEOM) return std::nullopt;
    return player::encode(gripper_geometry<player::GripperGeom>(*settings()));
  }
};

class Ptz final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* head = reading_as<sim::PtzReading>(reading);
    if (head == nullptr) return;
    status_ = head->moving ? 1 : 0;
    sink.data(PLAYER_PTZ_DATA_STATE, player::encode(to_players<player::PtzData>(*head)));
  }

  void command(std::uint8_t subtype, std::string_view payload) override {
    if (subtype != PLAYER_PTZ_CMD_STATE) return;
    const auto asked = player::decode<player::PtzCmd>(payload);
    if (controls_speed_) return send(from_players<sim::PanCommand>(asked));
    send(from_players<sim::PointCommand>(asked));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_PTZ_REQ_CONTROL_MODE: {
        const std::uint32_t mode = player::decode<player::PtzReqControlMode>(payload).mode;
        if (mode != PLAYER_PTZ_POSITION_CONTROL && mode != PLAYER_PTZ_VELOCITY_CONTROL) {
          return std::nullopt;
        }
        controls_speed_ = mode == PLAYER_PTZ_VELOCITY_CONTROL;
        return empty_payload();
      }
      case PLAYER_PTZ_REQ_GEOM:
        return player::encode(player::PtzGeom{pose_3d(mounting_of(*settings())), {}});
      case PLAYER_PTZ_REQ_STATUS:
        return player::encode(player::PtzReqStatus{status_});
      default:
        return std::nullopt;
    }
  }

 private:
  bool controls_speed_ = false;  // whether commands are speeds instead of positions
  std::uint32_t status_ = 0;     // 1: the head moves
};

// --- Messages

class Opaque final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  // A reading without a message is no data.
  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* received = reading_as<sim::OpaqueReading>(reading);
    if (received == nullptr || received->data.empty()) return;
    sink.data(PLAYER_OPAQUE_DATA_STATE, player::encode(player::OpaqueData{received->data}));
  }

  void command(std::uint8_t subtype, std::string_view payload) override {
    if (subtype == PLAYER_OPAQUE_CMD_DATA) send_message(payload);
  }

 protected:
  // The answer is empty, because receivers answer with messages of their own.
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    if (subtype != PLAYER_OPAQUE_REQ_DATA) return std::nullopt;
    send_message(payload);
    return player::encode(player::OpaqueData{});
  }

 private:
  void send_message(std::string_view payload) const {
    auto message = player::decode<player::OpaqueData>(payload);
    if (message.data.size() > sim::kMaxOpaque) {
      refuse_value("a message has at most " + std::to_string(sim::kMaxOpaque) +
                   " bytes, but this has " + std::to_string(message.data.size()));
    }
    if (!message.data.empty()) send(sim::OpaqueCommand{std::move(message.data)});
  }
};

class Speech final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  [[nodiscard]] std::vector<DeviceId> sources() const override { return {}; }

  void command(std::uint8_t subtype, std::string_view payload) override {
    if (subtype != PLAYER_SPEECH_CMD_SAY) return;
    const auto asked = player::decode<player::SpeechCmd>(payload);
    send(sim::SayCommand{sayable(player::text_of(asked.string))});
  }
};

}  // namespace

MadeDevice make_acting_device(const DeviceContext& context) {
  switch (context.interface) {
    case PLAYER_ACTARRAY_CODE:
      return std::make_unique<ActArray>(context);
    case PLAYER_AIO_CODE:
      return std::make_unique<Aio>(context);
    case PLAYER_BLINKENLIGHT_CODE:
      return std::make_unique<Blinkenlight>(context);
    case PLAYER_DIO_CODE:
      return std::make_unique<Dio>(context);
    case PLAYER_GRIPPER_CODE:
      return std::make_unique<Gripper>(context);
    case PLAYER_OPAQUE_CODE:
      return std::make_unique<Opaque>(context);
    case PLAYER_PTZ_CODE:
      return std::make_unique<Ptz>(context);
    case PLAYER_SPEECH_CODE:
      return std::make_unique<Speech>(context);
    default:
      return nullptr;
  }
}

}  // namespace playerlike::wire
