// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/core/body_state.h"
#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/core/random_stream.h"
#include "sim/core/state_archive.h"
#include "sim/core/time.h"

namespace sim {

class Motion;
class Pen;
class PhysicsWorld;
struct RobotSnapshot;
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
};

/// A reading that a device has handed out: it stays as it is, for whoever has it.
using SharedReading = std::shared_ptr<const Reading>;

/// Drive with this velocity until told otherwise.
struct TwistCommand {
  Twist twist;
};
/// Switch the motors on or off; off stops the robot and ignores twists until they are on again.
struct MotorEnableCommand {
  bool enabled;
};
/// Make a localisation device (pose, odometry) report this pose for where the robot is now; an imu,
/// its heading.
struct SetPoseCommand {
  Pose pose;
};
/// Drive to a point of the world (waypoint). All numbers finite, tolerance and speed > 0.
struct GotoCommand {
  Vec2 goal_m;               ///< in W [m]
  double tolerance_m = 0.5;  ///< so near to it the robot has arrived [m]
  double speed_mps = 1.0;    ///< forward speed, at most; the motors' limits hold too [m/s]
};
/// Stop on the way to the goal, which is kept (waypoint).
struct StopCommand {};
/// Go on to the goal that was given last (waypoint).
struct ResumeCommand {};
/// Put the robot there, at rest (teleport).
struct PlaceCommand {
  Pose pose;  ///< X_WB
};
/// Put the robot elsewhere, its heading unchanged, at rest (teleport).
struct TranslateCommand {
  Vec2 offset_m;  ///< from where it is, along W's axes, as MORSE has it [m]
};
/// Turn the robot where it stands, at once, and leave it at rest (teleport).
struct RotateCommand {
  double yaw_rad;  ///< counter-clockwise [rad]
};
/// Drive with this speed and turn to a heading, and hold that, until told otherwise (motion).
struct HeadingCommand {
  double v_mps = 0.0;        ///< forward [m/s]
  double lateral_mps = 0.0;  ///< to the left [m/s]; drives that cannot ignore it
  double yaw_rad = 0.0;      ///< heading in `frame`, counter-clockwise [rad]
  int frame = -1;  ///< index of the robot's localisation device (pose, odometry) in whose frame the
                   ///< heading is; -1: W
};
/// Drive to a pose and stand there, by the motors' own control (motion).
struct PositionCommand {
  Pose goal;                         ///< of B in `frame`
  double max_speed_mps = 0.0;        ///< on the way; 0: the motors' limit. The sign does not matter
  double max_turn_rate_radps = 0.0;  ///< the same [rad/s]
  int frame = -1;                    ///< as of HeadingCommand
};
/// Drive as a car does, until told otherwise (motion).
struct CarCommand {
  double v_mps = 0.0;         ///< forward speed [m/s]
  double steering_rad = 0.0;  ///< angle of the front wheels, counter-clockwise [rad]
};
/// Say something (speech).
struct SayCommand {
  std::string text;  ///< UTF-8, at most kMaxSpeech bytes; empty: be quiet
};
/// Set the first outputs of a dio device; the others stay as they are.
struct DigitalOutputCommand {
  int count;           ///< how many, 0..32
  std::uint32_t bits;  ///< output i is bit i
};
/// Set one output of an aio device.
struct AnalogOutputCommand {
  int channel;       ///< from 0
  double voltage_v;  ///< [V]
};
/// Change a light; what has no value stays as it is (blinkenlight).
struct LightCommand {
  std::optional<bool> enabled;
  std::optional<Colour> colour;
  std::optional<double> period_s;    ///< of one on and off, >= 0; 0: it does not blink [s]
  std::optional<double> duty_cycle;  ///< share of the period that it is lit, [0, 1]
};
/// Move the paddles of a gripper, or what they hold (gripper).
struct GripCommand {
  enum class Action {
    kOpen,      ///< and put down what they hold
    kClose,     ///< until they hold something, or meet
    kStop,      ///< where they are
    kStore,     ///< put what they hold into the store
    kRetrieve,  ///< take what was stored last
  };
  Action action = Action::kStop;
};
/// Send a message (opaque).
struct OpaqueCommand {
  std::vector<std::uint8_t> data;  ///< at most kMaxOpaque bytes
};
/// Point a camera somewhere (ptz). Limits of the head hold.
struct PointCommand {
  double pan_rad = 0.0;           ///< to the left [rad]
  double tilt_rad = 0.0;          ///< upwards [rad]
  double view_rad = 0.0;          ///< field of view from side to side; 0 or less: it stays [rad]
  double pan_speed_radps = 0.0;   ///< on the way; 0: as fast as it can. The sign does not matter
  double tilt_speed_radps = 0.0;  ///< the same [rad/s]
};
/// Turn and zoom a camera at speeds, until told otherwise or at a limit (ptz).
struct PanCommand {
  double pan_speed_radps = 0.0;   ///< to the left [rad/s]
  double tilt_speed_radps = 0.0;  ///< upwards [rad/s]
  double zoom_speed_radps = 0.0;  ///< of the field of view, > 0 widens it [rad/s]
};
inline constexpr std::size_t kMaxSpeech = 255;    ///< bytes
inline constexpr std::size_t kMaxOpaque = 65536;  ///< bytes
/// Whatever a device can be told to do.
using Command =
    std::variant<TwistCommand, MotorEnableCommand, SetPoseCommand, GotoCommand, StopCommand,
                 ResumeCommand, PlaceCommand, TranslateCommand, RotateCommand, HeadingCommand,
                 PositionCommand, CarCommand, SayCommand, DigitalOutputCommand, AnalogOutputCommand,
                 LightCommand, GripCommand, OpaqueCommand, PointCommand, PanCommand>;

class Device;
class Sensor;

/// Finds devices of all robots of a world, for those that are wired to others.
class DeviceDirectory {
 public:
  virtual ~DeviceDirectory() = default;
  /// @return nullptr if there is no such robot, or it has no such device. What it points to stays
  ///         until a reset, after which all devices are connected anew.
  [[nodiscard]] virtual const Device* find(std::string_view robot,
                                           std::string_view device) const = 0;
};

/// What a device may do to its robot, valid during the call that it is given to.
class RobotControl {
 public:
  virtual ~RobotControl() = default;

  [[nodiscard]] virtual const BodyState& body() const = 0;
  /// Where the robot's device of that index thinks the robot is (Device::believed_pose); nullopt if
  /// there is no such device, or it does not know.
  [[nodiscard]] virtual std::optional<Pose> pose_by(int device) const = 0;
  /// Makes `device` the one that steers from now on: all others of the robot are told
  /// (Device::motors_taken).
  /// @return false if there is nothing to steer: the robot has no motors, or `device` is a motion
  ///         device but not the one that the robot moves by.
  virtual bool take_motors(const Device& device) = 0;
  /// Tells the motors which twist to strive for, as a TwistCommand would. Without effect if there
  /// are none, or if they are switched off.
  virtual void drive(const Twist& twist) = 0;
  /// Puts the robot somewhere, at rest. All devices are told (Device::placed).
  /// @return nothing if done, else why not, naming what stands there.
  virtual std::optional<std::string> place(const Pose& X_WB) = 0;
  /// Lets everybody know what the robot says: for the log and the run's report.
  virtual void say(const std::string& text) = 0;

  /// What the robot's devices may look at, as in Device::integrate(), between two steps.
  [[nodiscard]] virtual StepContext context() const = 0;
  /// Takes an obstacle, by its index, where it stands. From now on it moves with the robot
  /// (ObstacleDescription::carried_by): it is in nobody's way, and others' sensors see it as a part
  /// of the robot.
  /// @return nothing if done, else why not: it is not portable, retracted, or carried already.
  virtual std::optional<std::string> pick_up(int obstacle) = 0;
  /// Carries what the robot carries at another place of it.
  /// @param X_BT    of the thing in B.
  /// @param inside  nobody's sensors see it there.
  virtual void carry_at(int obstacle, const Pose& X_BT, bool inside) = 0;
  /// Puts down what the robot carries, where it is now.
  /// @return nothing if done, else why not, naming what stands there; the robot goes on carrying
  /// it.
  virtual std::optional<std::string> put_down(int obstacle) = 0;
};

/// A part of a robot that clients address by name. Owned by a Simulation; not thread-safe.
class Device {
 public:
  Device(std::string name, std::string type) : name_(std::move(name)), type_(std::move(type)) {}
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  virtual ~Device() = default;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::string& type() const noexcept { return type_; }

  /// Whether it works; at first it does. One that does not makes no readings, gets no commands and
  /// does not act.
  [[nodiscard]] bool active() const noexcept { return active_; }
  void set_active(bool active, RobotControl& robot);

  /// Called once all devices of the world are made: the moment to look up those that this one is
  /// wired to.
  /// @param robot  name of the device's own.
  /// @return nothing if all is there; else what is not, in words that go on from "expected ".
  virtual std::optional<std::string> connect(std::string_view robot,
                                             const DeviceDirectory& devices) {
    static_cast<void>(robot);
    static_cast<void>(devices);
    return std::nullopt;
  }

  /// Carries out a command at the step boundary.
  /// @return nothing if done; else why not, e.g. that the device does not take such commands.
  virtual std::optional<std::string> apply(const Command& command);
  /// The same for a device that does something to its robot; calls apply() by default.
  virtual std::optional<std::string> execute(const Command& command, RobotControl& robot);

  /// Called before each step in which the device is active and its robot may move, in order of
  /// device: the moment to steer. By default it does nothing, and is not called again.
  virtual void act(RobotControl& robot) {
    static_cast<void>(robot);
    acts_ = false;
  }
  /// Called once each step, before readings are made (for what must be integrated). By default it
  /// does nothing, and is not called again.
  virtual void integrate(const StepContext& context) {
    static_cast<void>(context);
    integrates_ = false;
  }
  /// Whether act() and integrate() do something; before their first call they may.
  [[nodiscard]] bool acts() const noexcept { return acts_; }
  [[nodiscard]] bool integrates() const noexcept { return integrates_; }

  /// Another device of the robot steers from now on.
  virtual void motors_taken() {}
  /// The robot was put at X_WB without driving there, and is at rest.
  virtual void placed(const Pose& X_WB) { static_cast<void>(X_WB); }
  /// This device, just made or restored, stands in for one that a reset or a restore ended: it goes
  /// on with that one's counts, and its schedule begins so much later.
  /// @pre `before` has the same class.
  virtual void succeed(const Device& before, SimTime later_ns) {
    static_cast<void>(before);
    static_cast<void>(later_ns);
  }

  /// Where a localisation device thinks its robot is now, in its own frame, without the noise of
  /// single readings; nullopt for others.
  [[nodiscard]] virtual std::optional<Pose> believed_pose() const { return std::nullopt; }

  /// @name What a simulation does for some devices alone
  /// @{
  [[nodiscard]] virtual Sensor* sensor() noexcept { return nullptr; }
  /// The robot moves by the first of its devices that is one.
  [[nodiscard]] virtual Motion* motion() noexcept { return nullptr; }
  /// The first of them leaves the robot's trail.
  [[nodiscard]] virtual Pen* pen() noexcept { return nullptr; }
  /// Whether it looks at other devices' readings, or at what they did in the step, and so measures
  /// after all others.
  [[nodiscard]] virtual bool measures_after_others() const noexcept { return false; }
  /// @}

  /// Adds what pictures show of the device, or of its newest reading, to its robot's picture.
  virtual void show(SimTime now_ns, RobotSnapshot& shot) const {
    static_cast<void>(now_ns);
    static_cast<void>(shot);
  }

  /// Writes the state, or reads one that a device of the same settings has written: all that a step
  /// or a command changes. Overriders begin with that of their base class.
  /// @throws SnapshotError if the bytes make no sense; what the device does then is undefined.
  virtual void archive(StateArchive& archive) { archive(active_); }

 protected:
  /// Called when active() has become false: the moment to let go of the robot.
  virtual void deactivated(RobotControl& robot) { static_cast<void>(robot); }

 private:
  bool active_ = true;
  bool acts_ = true;
  bool integrates_ = true;
  std::string name_;
  std::string type_;
};

/// A device that makes readings at its own frequency.
class Sensor : public Device {
 public:
  /// @param frequency_hz  readings a simulated second, > 0; the first comes one period after 0.
  Sensor(std::string name, std::string type, double frequency_hz);

  /// Makes a reading if one is due at context.now_ns. A period that is no multiple of the step is
  /// kept on average: each reading comes at the first step at or after its time. While the sensor
  /// is not active the schedule goes on without readings.
  /// @return whether a reading was made.
  bool update(const StepContext& context);

  /// The newest reading; sequence 0 before the first.
  [[nodiscard]] virtual const Reading& reading() const noexcept = 0;
  /// The same to be kept. It may be let go of by any thread.
  [[nodiscard]] virtual SharedReading share() const noexcept = 0;
  [[nodiscard]] double frequency_hz() const noexcept { return frequency_hz_; }
  /// When update() will make the next reading, or let it pass.
  [[nodiscard]] SimTime next_due_ns() const noexcept { return next_due_ns_; }

  [[nodiscard]] Sensor* sensor() noexcept final { return this; }

  void succeed(const Device& before, SimTime later_ns) override;
  void archive(StateArchive& archive) override;

 protected:
  /// Makes the next reading, which next() of SensorOf gives.
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

/// A sensor whose readings are of type R, which can be copied.
///
/// A reading that was handed out is never changed: the next one is another object. Objects that
/// nobody has any more are used again, so a reading costs no memory of its own.
template <typename R>
class SensorOf : public Sensor {
 public:
  using Sensor::Sensor;
  [[nodiscard]] const R& reading() const noexcept final { return *newest_; }
  [[nodiscard]] SharedReading share() const noexcept final {
    shared_ = true;
    return newest_;
  }

  /// With the newest reading: what its table lists.
  void archive(StateArchive& archive) override {
    Sensor::archive(archive);
    archive(newest_->time_ns, newest_->sequence);
    archive.fields(*newest_);
  }

 protected:
  /// The newest reading for archive(), which may have members that its table does not list.
  [[nodiscard]] R& archived() noexcept { return *newest_; }
  /// What an object holds before it is filled.
  enum class Contents {
    kNewest,      ///< what the newest reading holds
    kAnyEarlier,  ///< what some earlier one holds: for readings that are overwritten in whole
  };

  /// The object of the next reading.
  [[nodiscard]] R& edit(Contents contents = Contents::kNewest) {
    if (!shared_) return *newest_;
    shared_ = false;
    std::shared_ptr<R>* const spare = find_spare();
    if (spare == nullptr) {
      auto made = std::make_shared<R>(*newest_);
      spares_[oldest_++ % spares_.size()] = std::exchange(newest_, std::move(made));
      return *newest_;
    }
    if (contents == Contents::kNewest) **spare = *newest_;
    spare->swap(newest_);
    return *newest_;
  }
  /// The same, with time and sequence number set.
  [[nodiscard]] R& next(const StepContext& context, Contents contents = Contents::kNewest) {
    R& reading = edit(contents);
    stamp(context, reading);
    return reading;
  }

 private:
  [[nodiscard]] std::shared_ptr<R>* find_spare() {
    for (std::shared_ptr<R>& spare : spares_) {
      if (spare.use_count() != 1) continue;
      // Counting up and down makes what other threads did with the object before they let go of it
      // happen before what follows: use_count() alone does not.
      const std::shared_ptr<R> last_holder = spare;
      return &spare;
    }
    return nullptr;
  }

  std::shared_ptr<R> newest_ = std::make_shared<R>();
  mutable bool shared_ = false;               ///< the newest was handed out
  std::array<std::shared_ptr<R>, 4> spares_;  ///< objects that were handed out
  std::size_t oldest_ = 0;                    ///< counts those that were added
};

/// A device that acts on its robot or on the canvas.
class Actuator : public Device {
 public:
  using Device::Device;
};

}  // namespace sim
