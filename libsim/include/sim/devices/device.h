// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "sim/core/body_state.h"
#include "sim/core/hash.h"
#include "sim/core/pose.h"
#include "sim/core/random_stream.h"
#include "sim/core/time.h"

namespace sim {

class PhysicsWorld;
struct WorldDescription;

/// What a device may look at when a step has ended.
struct StepContext {
  SimTime now_ns;                 ///< simulated time at the end of the step
  const BodyState& body;          ///< of the device's robot
  const PhysicsWorld& physics;    ///< for range sensing, contacts and the other robots' bodies
  int robot;                      ///< index of the device's robot
  const WorldDescription& world;  ///< for names, docks and obstacles, with their present state
};

/// What every sensor's reading begins with.
struct Reading {
  SimTime time_ns = 0;         ///< simulated time of the measurement
  std::uint64_t sequence = 0;  ///< 1 for a sensor's first reading, then one more each; 0: none yet

  Reading() = default;
  Reading(const Reading&) = default;
  Reading& operator=(const Reading&) = default;
  virtual ~Reading() = default;
  /// A copy of the whole reading, to be kept.
  [[nodiscard]] virtual std::unique_ptr<Reading> clone() const = 0;
};

/// Drive with this velocity until told otherwise.
struct TwistCommand {
  Twist twist;
};
/// Switch the motors on or off; off stops the robot and ignores twists until they are on again.
struct MotorEnableCommand {
  bool enabled;
};
/// Make a localisation device (pose, odometry) report this pose for where the robot is now.
struct SetPoseCommand {
  Pose pose;
};
/// Whatever a device can be told to do.
using Command = std::variant<TwistCommand, MotorEnableCommand, SetPoseCommand>;

/// A part of a robot that clients address by name. Owned by a Simulation; not thread-safe.
class Device {
 public:
  Device(std::string name, std::string type) : name_(std::move(name)), type_(std::move(type)) {}
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::string& type() const noexcept { return type_; }

  /// Carries out a command at the step boundary.
  /// @return nothing if done; else why not, e.g. that the device does not take such commands.
  virtual std::optional<std::string> apply(const Command& command);

  /// Called once each step, before readings are made (for what must be integrated).
  virtual void integrate(const StepContext& context) { static_cast<void>(context); }

  /// Adds all that distinguishes this device's future from another's.
  virtual void hash(StateHash& hash) const = 0;

 private:
  std::string name_;
  std::string type_;
};

/// A device that makes readings at its own frequency.
class Sensor : public Device {
 public:
  /// @param frequency_hz  readings a simulated second, > 0; the first comes one period after 0.
  Sensor(std::string name, std::string type, double frequency_hz);

  /// Makes a reading if one is due at context.now_ns. A period that is no multiple of the step is
  /// kept on average: each reading comes at the first step at or after its time.
  /// @return whether a reading was made.
  bool update(const StepContext& context);

  /// The newest reading; sequence 0 before the first.
  [[nodiscard]] virtual const Reading& reading() const noexcept = 0;
  [[nodiscard]] double frequency_hz() const noexcept { return frequency_hz_; }

  void hash(StateHash& hash) const override;

 protected:
  /// Fills the reading; time and sequence are given and already set in it by stamp().
  virtual void measure(const StepContext& context) = 0;
  /// For measure(): sets time and the next sequence number.
  void stamp(const StepContext& context, Reading& reading) const {
    reading.time_ns = context.now_ns;
    reading.sequence = sequence_;
  }

 private:
  double frequency_hz_;
  SimTime period_ns_;
  SimTime next_due_ns_;
  std::uint64_t sequence_ = 0;
};

/// A device that acts on its robot or on the canvas.
class Actuator : public Device {
 public:
  using Device::Device;
};

}  // namespace sim
