// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that tell and set where a robot is, and drive it: position2d, localize and planner.
#include <algorithm>
#include <cmath>
#include <memory>

#include "libplayerc++/playererror.h"
#include "libplayerinterface/player_constants.h"
#include "proxies/goal_driver.h"
#include "proxies/planner.h"
#include "session/player_values.h"
#include "session/player_values/localize.h"
#include "session/player_values/planner.h"
#include "session/player_values/position2d.h"
#include "sim/devices/amcl.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

// Calls share_driver() or share_planner(), whose errors become those of sessions.
template <typename Make>
auto made_driver(Make make) {
  try {
    return make();
  } catch (const PlayerCc::PlayerError& e) {
    throw SessionError(SessionError::Code::kNotAvailable, e.GetErrorStr());
  }
}

/// Position2dProxy's counterpart.
class Position2d final : public RobotDevice {
 public:
  explicit Position2d(const DeviceContext& context)
      : RobotDevice(context),
        max_speed_mps_(robot().max_speed_mps),
        max_turn_rate_radps_(robot().max_turn_rate_radps) {
    if (binding().driver != nullptr) {
      driver_ = made_driver([&] { return share_driver(session(), binding()); });
    }
    if (!binding().motion) return;
    const DeviceSettings& limits = device_of(*binding().motion).properties;
    const auto tighten = [&](const char* name, double& value) {
      const auto it = limits.find(name);
      if (it != limits.end()) value = std::min(value, it->second);
    };
    tighten("max_speed", max_speed_mps_);
    tighten("max_turn_rate", max_turn_rate_radps_);
  }

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    const auto* measured = reading_as<sim::PoseReading>(reading);
    if (measured == nullptr) return;
    constexpr std::size_t kLength = 6 * sizeof(double) + 4;
    sink.data(PLAYER_POSITION2D_DATA_STATE,
              encode_long(to_players<player::Position2dData>(*measured), kLength));
  }

  void command(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_POSITION2D_CMD_VEL:
        return drive(
            from_players<sim::TwistCommand>(player::decode<player::Position2dCmdVel>(payload)));
      case PLAYER_POSITION2D_CMD_POS:
        return go_to(player::decode<player::Position2dCmdPos>(payload));
      case PLAYER_POSITION2D_CMD_CAR:
        return drive(
            from_players<sim::CarCommand>(player::decode<player::Position2dCmdCar>(payload)));
      case PLAYER_POSITION2D_CMD_VEL_HEAD: {
        auto command = from_players<sim::HeadingCommand>(
            player::decode<player::Position2dCmdVelHead>(payload));
        require_number("the heading", command.yaw_rad);
        command.yaw_rad = sim::normalize_angle(command.yaw_rad);
        command.frame = binding().reading.device;
        return drive(command);
      }
      default:
        return;
    }
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_POSITION2D_REQ_GET_GEOM:
        return player::encode(
            player::Position2dGeom{center_of<player::Pose3d>(robot()), box_3d(robot())});
      case PLAYER_POSITION2D_REQ_MOTOR_POWER:
        switch_motors(player::decode<player::Position2dPowerConfig>(payload).state != 0);
        return empty_payload();
      case PLAYER_POSITION2D_REQ_SET_ODOM:
        set_odometry(player::decode<player::Position2dSetOdomReq>(payload).pose);
        return empty_payload();
      case PLAYER_POSITION2D_REQ_RESET_ODOM:
        set_odometry({});
        return empty_payload();
      default:
        // The motors have one control loop, and its gains cannot be set.
        return std::nullopt;
    }
  }

 private:
  [[nodiscard]] const DeviceInfo& device_of(DeviceId device) const {
    return robot().devices.at(static_cast<std::size_t>(device.device));
  }

  // The watchdog of a mirror, see TakeChargeRequest.
  std::optional<std::string> own_property(std::uint8_t subtype, std::string_view payload) override {
    if (subtype == PLAYER_SET_BOOLPROP_REQ) {
      const auto asked = player::decode<player::BoolpropReq>(payload);
      if (player::text_of(asked.key) != kTakeOverProperty) return std::nullopt;
      take_over_ = asked.value != 0;
      return empty_payload();
    }
    if (subtype != PLAYER_GET_DBLPROP_REQ && subtype != PLAYER_SET_DBLPROP_REQ) return std::nullopt;
    auto asked = player::decode<player::DblpropReq>(payload);
    if (player::text_of(asked.key) != kWatchdogProperty) return std::nullopt;
    if (subtype == PLAYER_GET_DBLPROP_REQ) {
      asked.value = watchdog_s_;
      return player::encode(asked);
    }
    session().request(TakeChargeRequest{binding().reading, asked.value,
                                        std::exchange(take_over_, false),
                                        "a client in Player's protocol"});
    watchdog_s_ = asked.value;
    return empty_payload();
  }

  void send_to_motors(const sim::Command& command) const {
    if (!binding().motion) throw no_motors(robot());
    session().send(*binding().motion, command);
  }

  // Sends a command that moves the robot; cancels the driver's goal.
  void drive(const sim::Command& command) const {
    playerlike::require_finite(command);
    if (driver_ != nullptr) driver_->cancel();
    send_to_motors(command);
  }

  void go_to(const player::Position2dCmdPos& asked) const {
    for (const double number : {asked.pos.px, asked.pos.py, asked.pos.pa}) {
      require_number("a goal's coordinate", number);
    }
    for (const double number : {asked.vel.px, asked.vel.py, asked.vel.pa}) {
      require_number("a speed", number);
    }
    if (driver_ == nullptr) {
      return drive(position_command(asked.pos, asked.vel, binding().reading.device));
    }
    driver_->go_to(driver_goal(asked.pos, asked.vel, max_speed_mps_, max_turn_rate_radps_));
  }

  void switch_motors(bool on) const {
    if (!on && driver_ != nullptr) {
      driver_->cancel();
      // Otherwise the driver's last speeds would apply again if the motors are re-enabled before
      // the next step.
      send_to_motors(sim::TwistCommand{});
    }
    send_to_motors(sim::MotorEnableCommand{on});
  }

  void set_odometry(const player::Pose2d& pose) const {
    require_number("a coordinate of the odometry", pose.px + pose.py);
    require_number("the heading", pose.pa);
    send(sim::SetPoseCommand{normalized_pose(pose)});
  }

  double max_speed_mps_;
  double max_turn_rate_radps_;
  double watchdog_s_ = 0.0;  // 0: this client is not in charge of the robot
  bool take_over_ = false;
  std::shared_ptr<GoalDriver> driver_;  // null except at the index of a driver
};

/// LocalizeProxy's counterpart.
class Localize final : public RobotDevice {
 public:
  using RobotDevice::RobotDevice;

  void on_reading(DeviceId /*device*/, const sim::Reading& reading, DataSink& sink) override {
    player::LocalizeData data;
    if (const auto* filtered = reading_as<sim::AmclReading>(reading)) {
      data.pending_count = filtered->pending;
      data.pending_time = sim::to_seconds(filtered->time_ns);
      for (const sim::PoseHypothesis& hypothesis : filtered->hypotheses) {
        data.hypoths.push_back(hypothesis_of<player::LocalizeHypoth>(hypothesis));
      }
      sink.data(PLAYER_LOCALIZE_DATA_HYPOTHS, player::encode(data));
      return;
    }
    const auto* measured = reading_as<sim::PoseReading>(reading);
    if (measured == nullptr) return;
    pose_ = pose_2d(measured->pose);
    data.hypoths.push_back(hypothesis_of<player::LocalizeHypoth>(*measured, *settings()));
    sink.data(PLAYER_LOCALIZE_DATA_HYPOTHS, player::encode(data));
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_LOCALIZE_REQ_SET_POSE: {
        const auto asked = player::decode<player::LocalizeSetPose>(payload);
        for (const double number : {asked.mean.px, asked.mean.py, asked.mean.pa}) {
          require_number("a coordinate of the pose", number);
        }
        if (!is_filter()) return empty_payload();  // it needs no first pose
        for (const double number : asked.cov) require_number("a covariance", number);
        // Refuses what is no pose or no covariance.
        send(set_pose_command(normalized_pose(asked.mean), asked.cov));
        return empty_payload();
      }
      case PLAYER_LOCALIZE_REQ_GET_PARTICLES:
        if (is_filter()) return particles();
        if (!pose_) return std::nullopt;
        return player::encode(player::LocalizeGetParticles{*pose_, 0.0, {{*pose_, 1.0}}});
      default:
        return std::nullopt;
    }
  }

 private:
  [[nodiscard]] bool is_filter() const { return info().type == "amcl"; }

  [[nodiscard]] std::string particles() const {
    const auto particles = session().request(ParticlesRequest{binding().reading});
    const ParticleMoments moments = moments_of(particles);
    player::LocalizeGetParticles answer{pose_2d(moments.mean), moments.variance_m2, {}};
    answer.particles.reserve(particles.size());
    for (const LocalizationParticle& particle : particles) {
      answer.particles.push_back({pose_2d(particle.pose), particle.weight});
    }
    return player::encode(answer);
  }

  std::optional<player::Pose2d> pose_;  // of a measured pose; none before the first reading
};

/// PlannerProxy's counterpart.
class PlannerDevice final : public RobotDevice {
 public:
  explicit PlannerDevice(const DeviceContext& context)
      : RobotDevice(context),
        planner_(made_driver([&] { return share_planner(session(), binding()); })) {}

  void on_reading(DeviceId /*device*/, const sim::Reading& /*reading*/, DataSink& sink) override {
    const PlannerState state = planner_->state();
    auto data = to_players<player::PlannerData>(state);
    data.waypoints_count = static_cast<std::uint32_t>(state.waypoints.size());
    sink.data(PLAYER_PLANNER_DATA_STATE, player::encode(data));
  }

  void command(std::uint8_t subtype, std::string_view payload) override {
    if (subtype != PLAYER_PLANNER_CMD_GOAL && subtype != PLAYER_PLANNER_CMD_START) return;
    const player::Pose2d pose = player::decode<player::PlannerCmd>(payload).goal;
    for (const double number : {pose.px, pose.py, pose.pa}) {
      require_number("a coordinate of the pose", number);
    }
    const sim::Pose X_W = normalized_pose(pose);
    if (subtype == PLAYER_PLANNER_CMD_GOAL) {
      planner_->set_goal(X_W);
    } else {
      planner_->set_start(X_W);
    }
  }

 protected:
  std::optional<std::string> answer(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_PLANNER_REQ_GET_WAYPOINTS: {
        const PlannerState state = planner_->state();
        player::PlannerWaypointsReq reply;
        reply.waypoints_distance = state.length_m;
        for (const sim::Pose& waypoint : state.waypoints) {
          reply.waypoints.push_back(pose_2d(waypoint));
        }
        return player::encode(reply);
      }
      case PLAYER_PLANNER_REQ_ENABLE:
        planner_->enable(player::decode<player::PlannerEnableReq>(payload).state != 0);
        return empty_payload();
      default:
        return std::nullopt;
    }
  }

 private:
  std::shared_ptr<Planner> planner_;
};

}  // namespace

MadeDevice make_driving_device(const DeviceContext& context) {
  switch (context.interface) {
    case PLAYER_POSITION2D_CODE:
      return std::make_unique<Position2d>(context);
    case PLAYER_LOCALIZE_CODE:
      return std::make_unique<Localize>(context);
    case PLAYER_PLANNER_CODE:
      return std::make_unique<PlannerDevice>(context);
    default:
      return nullptr;
  }
}

}  // namespace playerlike::wire
