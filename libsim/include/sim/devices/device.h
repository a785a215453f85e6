// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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
struct ArenaDescription;
struct RobotSnapshot;
struct WorldDescription;

/// What a device can read at the end of a step.
struct StepContext {
  SimTime now_ns;                 ///< simulated time at the end of the step
  const BodyState& body;          ///< of the device's robot
  const PhysicsWorld& physics;    ///< for range sensing, contacts and the states of other robots
  int robot;                      ///< index of the device's robot
  const WorldDescription& world;  ///< for names, docks and obstacles, with their current state
};

/// Common part of all sensor readings.
struct Reading {
  SimTime time_ns = 0;         ///< simulated time of the measurement
  std::uint64_t sequence = 0;  ///< 1 for a sensor's first reading, then increasing by one; 0: no
                               ///< reading yet

  Reading() = default;
  Reading(const Reading&) = default;
  Reading& operator=(const Reading&) = default;
  virtual ~Reading() = default;
};

/// A reading that a device has handed out. It never changes.
using SharedReading = std::shared_ptr<const Reading>;

/// Drive with this velocity until another command (motion).
struct TwistCommand {
  Twist twist;
};
/// Switch the motors on or off. While off, the robot stops and ignores twists (motion).
struct MotorEnableCommand {
  bool enabled;
};
/// Set the pose that a localisation device (pose, odometry) reports for the robot's current pose,
/// or the heading that an imu reports; or tell amcl where the robot is.
struct SetPoseCommand {
  Pose pose;
  /// Variances of x, y [m^2] and yaw [rad^2], for amcl; none: those of its settings.
  std::optional<std::array<double, 3>> variance = {};
  /// Covariances of x y [m^2], y yaw and x yaw [m rad], with `variance`; none: 0.
  std::optional<std::array<double, 3>> covariance = {};
};
/// Greatest absolute value of a coordinate in a SetPoseCommand [m], and of the standard deviations
/// in its covariance [m, rad]. Larger than any map's grid on Earth, and small enough for exact sums
/// of squares.
inline constexpr double kFarthestPose = 1e9;
/// What is wrong with the numbers of a command: not finite, beyond kFarthestPose, or no covariance.
/// @return nullopt if nothing is.
[[nodiscard]] std::optional<std::string> fault_of(const SetPoseCommand& command);

/// Drive to a point of the world (waypoint, destination). All numbers must be finite, tolerance and
/// speed > 0.
struct GotoCommand {
  Vec2 goal_m;               ///< in W [m]
  double tolerance_m = 0.5;  ///< distance to the goal at which the robot has arrived [m]
  double speed_mps = 1.0;    ///< maximum forward speed [m/s]; the motors' limits apply too
  /// Height of the goal (Elevation) [m]; none: that of the robot. A waypoint ignores it.
  std::optional<double> z_m = {};
};
/// Stop on the way to the goal, but keep the goal (waypoint).
struct StopCommand {};
/// Continue to the last goal (waypoint).
struct ResumeCommand {};
/// Place the robot at a pose, at rest (teleport).
struct PlaceCommand {
  Pose pose;  ///< X_WB
  /// Height and inclination; members without a value keep theirs (Elevation).
  std::optional<double> z_m = {};
  std::optional<double> roll_rad = {};
  std::optional<double> pitch_rad = {};
};
/// Move the robot to another position at once, with the same heading, at rest (teleport).
struct TranslateCommand {
  Vec2 offset_m;  ///< relative to its position, along W's axes (as in MORSE) [m]
};
/// Rotate the robot on the spot at once and leave it at rest (teleport).
struct RotateCommand {
  double yaw_rad;  ///< counter-clockwise [rad]
};
/// Turn the body to these angles and hold them (orientation).
struct OrientCommand {
  double roll_rad = 0.0;   ///< about the body's x axis [rad]
  double pitch_rad = 0.0;  ///< about the body's y axis; positive: nose down [rad]
  double yaw_rad = 0.0;    ///< heading in W, counter-clockwise [rad]
};
/// Change what a proximity sensor detects; members without a value keep their settings.
struct TrackCommand {
  std::optional<double> range_m = {};   ///< (0, 1000] [m]
  std::optional<std::string> tag = {};  ///< empty: everything
};
/// Drive at this speed, turn to a heading and hold it, until another command (motion).
struct HeadingCommand {
  double v_mps = 0.0;        ///< forward [m/s]
  double lateral_mps = 0.0;  ///< to the left [m/s]; ignored by drives that cannot move sideways
  double yaw_rad = 0.0;      ///< heading in `frame`, counter-clockwise [rad]
  int frame = -1;  ///< index of the robot's localisation device (pose, odometry) in whose frame the
                   ///< heading is given; -1: W
};
/// Drive to a pose and stop there, under the motors' position control (motion).
struct PositionCommand {
  Pose goal;                         ///< of B in `frame`
  double max_speed_mps = 0.0;        ///< maximum [m/s]; 0: the motors' limit; the sign is ignored
  double max_turn_rate_radps = 0.0;  ///< maximum [rad/s]; 0: the motors' limit; the sign is ignored
  int frame = -1;                    ///< as in HeadingCommand
};
/// Drive like a car, until another command (motion).
struct CarCommand {
  double v_mps = 0.0;         ///< forward speed [m/s]
  double steering_rad = 0.0;  ///< angle of the front wheels, counter-clockwise [rad]
};
/// Say a text (speech).
struct SayCommand {
  std::string text;  ///< UTF-8, at most kMaxSpeech bytes; empty: remove the shown text
};
/// Set the first outputs of a dio device; the others keep their values.
struct DigitalOutputCommand {
  int count;           ///< how many, 0..32
  std::uint32_t bits;  ///< output i is bit i
};
/// Set one output of an aio device.
struct AnalogOutputCommand {
  int channel;       ///< from 0
  double voltage_v;  ///< [V]
};
/// Change a light; members without a value keep their settings (blinkenlight).
struct LightCommand {
  std::optional<bool> enabled;
  std::optional<Colour> colour;
  std::optional<double> period_s;    ///< of one on-off cycle, >= 0 [s]; 0: does not blink
  std::optional<double> duty_cycle;  ///< fraction of the period in which it is lit, [0, 1]
};
/// Move the paddles of a gripper, or the object that they hold (gripper).
struct GripCommand {
  enum class Action {
    kOpen,      ///< open, and put down what they hold
    kClose,     ///< close until they hold something or meet
    kStop,      ///< stop where they are
    kStore,     ///< move what they hold into the store
    kRetrieve,  ///< take out what was stored last
  };
  Action action = Action::kStop;
};
/// Send a message (opaque).
struct OpaqueCommand {
  std::vector<std::uint8_t> data;  ///< at most kMaxOpaque bytes
};
/// Point a camera (ptz). The limits of the head apply.
struct PointCommand {
  double pan_rad = 0.0;           ///< to the left [rad]
  double tilt_rad = 0.0;          ///< upwards [rad]
  double view_rad = 0.0;          ///< horizontal field of view [rad]; 0 or less: unchanged
  double pan_speed_radps = 0.0;   ///< maximum [rad/s]; 0: the head's limit; the sign is ignored
  double tilt_speed_radps = 0.0;  ///< maximum [rad/s]; 0: the head's limit; the sign is ignored
};
/// Pan, tilt and zoom a camera at these speeds, until another command or a limit (ptz).
struct PanCommand {
  double pan_speed_radps = 0.0;   ///< to the left [rad/s]
  double tilt_speed_radps = 0.0;  ///< upwards [rad/s]
  double zoom_speed_radps = 0.0;  ///< of the field of view, > 0 widens it [rad/s]
};
/// Move joints of an arm (actarray). A value has the unit of the mode and of the joint's type.
struct JointCommand {
  enum class Mode {
    kPosition,  ///< to positions [m or rad]
    kSpeed,     ///< at speeds [m/s or rad/s], until another command or a limit
    kCurrent,   ///< with currents through the motors [A], until another command
    kHome,      ///< to the home positions; takes no values
    kPlace,     ///< to positions at once [m or rad]
  };
  Mode mode = Mode::kPosition;
  int joint = 0;               ///< first joint, counted from 0; -1: all joints
  std::vector<double> values;  ///< of this joint and the following ones; one value if joint is -1
};
/// Change a setting of an arm's joints (actarray).
struct JointSettingCommand {
  enum class Setting {
    kPower,         ///< of all joints: 0 off, otherwise on
    kBrakes,        ///< of all joints that have brakes: 0 released, otherwise applied
    kSpeed,         ///< for position commands, > 0 [m/s or rad/s]
    kAcceleration,  ///< of all movements, > 0 [m/s^2 or rad/s^2]
  };
  Setting setting = Setting::kPower;
  int joint = -1;  ///< counted from 0; -1: all joints; ignored for power and brakes
  double value = 0.0;
};
/// Move all joints of an arm through positions at given times (actarray).
struct TrajectoryCommand {
  /// Simulated time from which the times count [s]; none, or earlier than now: now.
  std::optional<double> start_s = {};
  std::vector<double> times_s;    ///< of the positions, >= 0, ascending, at most kMaxTrajectory [s]
  std::vector<double> positions;  ///< of all joints for each time, one after the other [m or rad]
};
inline constexpr std::size_t kMaxTrajectory = 10000;  ///< positions of a trajectory
inline constexpr std::size_t kMaxSpeech = 255;        ///< bytes
inline constexpr std::size_t kMaxOpaque = 65536;      ///< bytes
/// Any command to a device.
using Command =
    std::variant<TwistCommand, MotorEnableCommand, SetPoseCommand, GotoCommand, StopCommand,
                 ResumeCommand, PlaceCommand, TranslateCommand, RotateCommand, HeadingCommand,
                 PositionCommand, CarCommand, SayCommand, DigitalOutputCommand, AnalogOutputCommand,
                 LightCommand, GripCommand, OpaqueCommand, PointCommand, PanCommand, JointCommand,
                 JointSettingCommand, OrientCommand, TrackCommand, TrajectoryCommand>;

class Device;
class Sensor;

/// Looks up devices of all robots of a world, for devices that are wired to others.
class DeviceDirectory {
 public:
  virtual ~DeviceDirectory() = default;
  /// @return nullptr if there is no such robot or device. The pointer is valid until a reset, after
  ///     which all devices are connected again.
  [[nodiscard]] virtual const Device* find(std::string_view robot,
                                           std::string_view device) const = 0;
  /// The arena in its state at the start of the run.
  [[nodiscard]] virtual const ArenaDescription& arena() const = 0;
};

/// Actions that a device may perform on its robot. Valid only during the call that receives it.
class RobotControl {
 public:
  virtual ~RobotControl() = default;

  [[nodiscard]] virtual const BodyState& body() const = 0;
  /// Estimate of the robot's pose by the robot's device of that index (Device::pose_estimate);
  /// nullopt if there is no such device, or if it has no estimate.
  [[nodiscard]] virtual std::optional<Pose> pose_estimate_of(int device) const = 0;
  /// Makes `device` the one that drives the robot; notifies all other devices of the robot
  /// (Device::on_motors_taken).
  /// @return false if the robot has no motors, or if `device` is a motion device but not the one
  ///     that moves the robot.
  virtual bool acquire_motors(const Device& device) = 0;
  /// Sets the target twist of the motors, like a TwistCommand. No effect if the robot has no
  /// motors, or if they are off.
  virtual void drive(const Twist& twist) = 0;
  /// Places the robot at a pose, at rest. Notifies all its devices (Device::placed).
  /// @return nothing on success, otherwise the reason, which names the obstacle in the way.
  virtual std::optional<std::string> place(const Pose& X_WB) = 0;
  /// Sets the robot's height and inclination (BodyState::elevation).
  virtual void elevate(const Elevation& elevation) = 0;
  /// Publishes a text that the robot says, for the log and the run's report.
  virtual void say(const std::string& text) = 0;

  /// The context for the robot's devices between two steps, as in Device::integrate().
  [[nodiscard]] virtual StepContext context() const = 0;
  /// Picks up an obstacle (by index) in its current pose. From now on it moves with the robot
  /// (ObstacleDescription::carried_by). It blocks nobody, and the sensors of others see it as a
  /// part of the robot.
  /// @return nothing on success, otherwise the reason: it is not portable, retracted, or already
  ///     carried.
  virtual std::optional<std::string> pick_up(int obstacle) = 0;
  /// Changes the pose at which the robot carries an object.
  /// @param X_BT    pose of the object in B.
  /// @param inside  the object is inside the robot, where no sensor sees it.
  virtual void carry_at(int obstacle, const Pose& X_BT, bool inside) = 0;
  /// Puts down a carried object in its current pose.
  /// @return nothing on success, otherwise the reason, which names the obstacle in the way; the
  ///     robot then keeps carrying the object.
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

  /// Whether the device is switched on; initially true. An inactive device makes no readings, gets
  /// no commands and does not act.
  [[nodiscard]] bool active() const noexcept { return active_; }
  void set_active(bool active, RobotControl& robot);
  /// Whether a sensor of ranges reads its maximum everywhere (FaultAction); initially false. Other
  /// devices ignore it.
  [[nodiscard]] bool blind() const noexcept { return blind_; }
  void set_blind(bool blind) noexcept { blind_ = blind; }

  /// Called once after all devices of the world are created. A device that is wired to others looks
  /// them up here.
  /// @param robot  name of the device's own robot.
  /// @return nothing on success; otherwise what is missing, as a text that follows "expected ".
  virtual std::optional<std::string> connect(std::string_view robot,
                                             const DeviceDirectory& devices) {
    static_cast<void>(robot);
    static_cast<void>(devices);
    return std::nullopt;
  }

  /// Executes a command between two steps.
  /// @return nothing on success; otherwise the reason, e.g. that the device does not take such
  ///     commands.
  virtual std::optional<std::string> apply(const Command& command);
  /// Executes a command that acts on the robot. The default calls apply().
  virtual std::optional<std::string> execute(const Command& command, RobotControl& robot);

  /// Called before each step in which the device is active and its robot may move, in the order of
  /// devices. A device that drives the robot does so here. The default does nothing and is not
  /// called again.
  virtual void act(RobotControl& robot) {
    static_cast<void>(robot);
    acts_ = false;
  }
  /// Called once per step, before readings are made, for state that must be integrated. The default
  /// does nothing and is not called again.
  virtual void integrate(const StepContext& context) {
    static_cast<void>(context);
    integrates_ = false;
  }
  /// Whether act() and integrate() are overridden. True until the first call of the default.
  [[nodiscard]] bool acts() const noexcept { return acts_; }
  [[nodiscard]] bool integrates() const noexcept { return integrates_; }

  /// Called when another device starts to drive the robot.
  virtual void on_motors_taken() {}
  /// Called when the robot was placed at X_WB, at rest, without driving there.
  virtual void placed(const Pose& X_WB) { static_cast<void>(X_WB); }
  /// Called on a new or restored device that replaces `before` in a reset or restore. Takes over
  /// the counters of `before`, and shifts its own schedule by `later_ns`.
  /// @pre `before` has the same class.
  virtual void take_over_from(const Device& before, SimTime later_ns) {
    static_cast<void>(before);
    static_cast<void>(later_ns);
  }

  /// A localisation device's current estimate of the robot's pose, in its own frame and without the
  /// noise of single readings; nullopt for other devices.
  [[nodiscard]] virtual std::optional<Pose> pose_estimate() const { return std::nullopt; }

  /// Name of the device of the same robot that carries this one; empty: the body does.
  [[nodiscard]] virtual std::string_view carrier() const noexcept { return {}; }

  /// @name Special kinds of devices
  /// @{
  /// The device as a sensor; null if it is none.
  [[nodiscard]] virtual const Sensor* sensor() const noexcept { return nullptr; }
  [[nodiscard]] Sensor* sensor() noexcept {
    return const_cast<Sensor*>(std::as_const(*this).sensor());
  }
  /// The first motion device of a robot moves it.
  [[nodiscard]] virtual Motion* motion() noexcept { return nullptr; }
  /// The first pen of a robot draws its trail.
  [[nodiscard]] virtual Pen* pen() noexcept { return nullptr; }
  /// Whether it reads other devices' readings, or effects of their step, and therefore must measure
  /// after all others.
  [[nodiscard]] virtual bool measures_after_others() const noexcept { return false; }
  /// @}

  /// Adds what pictures show of the device, or of its newest reading, to its robot's snapshot.
  virtual void show(SimTime now_ns, RobotSnapshot& shot) const {
    static_cast<void>(now_ns);
    static_cast<void>(shot);
  }

  /// Writes the state, or reads one that a device with the same settings has written. The state is
  /// everything that a step or a command changes. Overrides call the base class's function first.
  /// @throws SnapshotError if the bytes are invalid; the device's behaviour is then undefined.
  virtual void archive(StateArchive& archive);

 protected:
  /// Called when active() has become false; the device releases the robot here.
  virtual void deactivated(RobotControl& robot) { static_cast<void>(robot); }

 private:
  bool active_ = true;
  bool blind_ = false;
  bool acts_ = true;
  bool integrates_ = true;
  std::string name_;
  std::string type_;
};

/// A device that makes readings at its own frequency.
///
/// A sensor may have a latency: a reading then becomes the newest one that long after it was
/// measured. Its time remains that of the measurement.
class Sensor : public Device {
 public:
  /// @param frequency_hz  readings per simulated second, > 0; the first comes one period after 0.
  /// @param latency_s  time from a measurement until its reading is available [s], >= 0.
  Sensor(std::string name, std::string type, double frequency_hz, double latency_s = 0.0);

  /// Makes a reading if one is due at context.now_ns. A period that is not a multiple of the step
  /// is kept on average: each reading comes at the first step at or after its due time. The
  /// schedule of an inactive sensor continues without readings.
  /// @return whether there is a new reading: made now, or with a latency, made before.
  bool update(const StepContext& context);

  /// The newest reading; its sequence is 0 before the first.
  [[nodiscard]] virtual const Reading& reading() const noexcept = 0;
  /// Shared ownership of the newest reading. Any thread may release it.
  [[nodiscard]] virtual SharedReading share() const noexcept = 0;
  [[nodiscard]] double frequency_hz() const noexcept { return frequency_hz_; }
  /// Time of the next call of update() that has an effect: it makes a reading, skips it because the
  /// sensor is inactive, or delivers one.
  [[nodiscard]] SimTime next_due_ns() const noexcept {
    return latency_ns_ == 0 ? next_due_ns_ : std::min(next_due_ns_, next_delivery_ns());
  }

  [[nodiscard]] const Sensor* sensor() const noexcept final { return this; }

  void take_over_from(const Device& before, SimTime later_ns) override;
  void archive(StateArchive& archive) override;

 protected:
  /// Makes the next reading in the object that SensorOf::next() returns.
  virtual void measure(const StepContext& context) = 0;
  /// For measure(): sets the time and the next sequence number.
  void stamp(const StepContext& context, Reading& reading) const {
    reading.time_ns = context.now_ns;
    reading.sequence = sequence_;
  }
  [[nodiscard]] SimTime latency_ns() const noexcept { return latency_ns_; }
  /// With a latency: the time at which the oldest reading in transit is due.
  [[nodiscard]] virtual SimTime next_delivery_ns() const noexcept = 0;
  /// With a latency: makes the newest reading that is due at this time the newest one of all.
  /// @return whether there was one.
  virtual bool deliver(SimTime now_ns) = 0;
  /// Changes the number of measurements made.
  void set_sequence(std::uint64_t sequence) noexcept { sequence_ = sequence; }

 private:
  double frequency_hz_;
  SimTime latency_ns_;
  SimTime period_ns_;
  SimTime next_due_ns_;
  std::uint64_t sequence_ = 0;
};

/// A sensor whose readings have the copyable type R.
///
/// A reading that was handed out never changes; the next reading is another object. Objects that
/// nobody uses any more are reused, so a reading needs no allocation in steady state.
template <typename R>
class SensorOf : public Sensor {
 public:
  using Sensor::Sensor;
  [[nodiscard]] const R& reading() const noexcept final { return *newest_; }
  [[nodiscard]] SharedReading share() const noexcept final {
    shared_ = true;
    return newest_;
  }

  /// Includes the newest reading, and those in transit.
  void archive(StateArchive& archive) override {
    Sensor::archive(archive);
    archive_reading(archive, *newest_);
    if (latency_ns() == 0) return;
    archive.list(in_transit_, [&](std::shared_ptr<R>& reading) {
      if (archive.reading()) reading = std::make_shared<R>(*newest_);
      archive_reading(archive, *reading);
      archive.expect(reading->time_ns >= 0 && reading->time_ns <= SimTime{1} << 61, "a time");
    });
  }
  /// The readings in transit keep their distance in time, and follow the last one of `before`.
  void take_over_from(const Device& before, SimTime later_ns) override {
    Sensor::take_over_from(before, later_ns);
    if (latency_ns() == 0) return;
    std::uint64_t sequence = before.sensor()->reading().sequence;
    for (const std::shared_ptr<R>& reading : in_transit_) {
      reading->time_ns += later_ns;
      reading->sequence = ++sequence;
    }
    set_sequence(sequence);
  }

 protected:
  /// Writes or reads a reading: the fields that its table lists. Overrides for readings with
  /// further members call this function first.
  virtual void archive_reading(StateArchive& archive, R& reading) {
    archive(reading.time_ns, reading.sequence);
    archive.fields(reading);
  }
  /// Contents of an object before it is filled.
  enum class Contents {
    kNewest,      ///< those of the newest reading
    kAnyEarlier,  ///< those of any earlier reading; for readings that are overwritten completely
  };

  /// The object for the next reading.
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
  /// The object for the next reading, with time and sequence number set. With a latency it is not
  /// the newest reading yet.
  [[nodiscard]] R& next(const StepContext& context, Contents contents = Contents::kNewest) {
    if (latency_ns() > 0) {
      in_transit_.push_back(
          std::make_shared<R>(in_transit_.empty() ? *newest_ : *in_transit_.back()));
    }
    R& reading = latency_ns() > 0 ? *in_transit_.back() : edit(contents);
    stamp(context, reading);
    return reading;
  }

 private:
  [[nodiscard]] SimTime next_delivery_ns() const noexcept final {
    return in_transit_.empty() ? std::numeric_limits<SimTime>::max()
                               : in_transit_.front()->time_ns + latency_ns();
  }
  bool deliver(SimTime now_ns) final {
    bool is_new = false;
    while (now_ns >= next_delivery_ns()) {
      newest_ = std::move(in_transit_.front());
      in_transit_.erase(in_transit_.begin());
      shared_ = false;
      is_new = true;
    }
    return is_new;
  }
  [[nodiscard]] std::shared_ptr<R>* find_spare() {
    for (std::shared_ptr<R>& spare : spares_) {
      if (spare.use_count() != 1) continue;
      // Copying and releasing the pointer synchronises with the threads that released the object
      // before; use_count() alone does not.
      const std::shared_ptr<R> last_holder = spare;
      return &spare;
    }
    return nullptr;
  }

  std::shared_ptr<R> newest_ = std::make_shared<R>();
  mutable bool shared_ = false;                 ///< the newest was handed out
  std::array<std::shared_ptr<R>, 4> spares_;    ///< objects that were handed out before
  std::size_t oldest_ = 0;                      ///< number of objects added to spares_
  std::vector<std::shared_ptr<R>> in_transit_;  ///< measured, but not delivered yet; oldest first
};

/// A device that acts on its robot or on the canvas.
class Actuator : public Device {
 public:
  using Device::Device;
};

}  // namespace sim
