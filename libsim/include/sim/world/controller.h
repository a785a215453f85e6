// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/world/obstacle_motion.h"

/// The description of a world's arena controller: configurations of blocks, timers and traps, with
/// conditions and actions. docs/arena_controller.md explains its meaning and the format of files.
/// Robots, obstacles, timers, traps and configurations are named, because io checks the names.
namespace sim {

/// Maximum length of a message, a text or a reason [bytes].
inline constexpr std::size_t kMaxArenaText = 200;

/// Maximum of times and periods of timers and traps [s]: three years.
inline constexpr double kLongestArenaTime_s = 1e8;

/// Minimum period of a timer [s].
inline constexpr double kLeastArenaPeriod_s = 0.001;

/// Maximum speed at which a block rises and sinks [m/s].
inline constexpr double kMaxRiseSpeed_mps = 100.0;

/// Where an obstacle stands in a configuration.
struct ArenaPlace {
  std::string obstacle;  ///< its name
  Pose pose;             ///< of its centre
};

/// A named arrangement of the arena: which dynamic blocks are extended, and where obstacles stand.
struct ArenaConfiguration {
  /// What happens to dynamic blocks that are in neither list.
  enum class Others { kKeep, kExtended, kRetracted };

  std::string name;                    ///< unique among configurations
  std::vector<std::string> extended;   ///< names of dynamic blocks
  std::vector<std::string> retracted;  ///< names of dynamic blocks
  Others others = Others::kKeep;       ///< what happens to the other dynamic blocks
  std::vector<ArenaPlace> places;      ///< of obstacles
};

/// Limits of a number in a condition, both included.
struct ArenaLimits {
  double at_least = -std::numeric_limits<double>::infinity();  ///< lower limit
  double at_most = std::numeric_limits<double>::infinity();    ///< upper limit

  /// Whether a number is within the limits.
  [[nodiscard]] bool contain(double x) const noexcept { return at_least <= x && x <= at_most; }
};

/// Simulated time since the start of the run or the last reset: from_s <= t < to_s.
struct TimeCondition {
  double from_s = 0.0;                                    ///< [s]
  double to_s = std::numeric_limits<double>::infinity();  ///< [s]
};

/// How often a timer or trap has acted.
struct CountCondition {
  std::string of;      ///< name of a timer or trap
  ArenaLimits limits;  ///< of the count
};

/// What a dynamic block does now.
enum class BlockPhase { kExtended, kRetracted, kRising, kSinking };

/// What a dynamic block does.
struct BlockCondition {
  std::string block;                         ///< name of a dynamic block
  BlockPhase phase = BlockPhase::kExtended;  ///< expected
};

/// A number that a condition compares for a robot.
enum class RobotQuantity {
  kCollisions,  ///< begun contacts since the start of the run
  kSpeed,       ///< magnitude of the velocity [m/s]
  kBattery,     ///< charge that the robot's first battery has reported last [%]
  kScore,       ///< points
};

/// A number of a robot. It does not hold for a robot without battery.
struct QuantityCondition {
  RobotQuantity quantity = RobotQuantity::kCollisions;  ///< what is compared
  std::string robot;                                    ///< ""; the robot that sprang the trap
  ArenaLimits limits;                                   ///< of the quantity
};

/// Whether a robot's first fiducial device has seen a number in its newest reading.
struct FiducialCondition {
  std::string robot;  ///< "": the robot that sprang the trap
  int number = 1;     ///< that it has seen
};

/// A condition of a timer or a trap.
using ArenaCondition = std::variant<TimeCondition, CountCondition, BlockCondition,
                                    QuantityCondition, FiducialCondition>;

/// Puts the arena into a configuration.
struct ConfigurationAction {
  std::string configuration;  ///< its name
};

/// Extends, retracts or toggles dynamic blocks.
struct BlocksAction {
  /// What is done to a block. kToggle extends a block that is retracted or sinks.
  enum class Change { kExtend, kRetract, kToggle };
  Change change = Change::kExtend;  ///< for each block
  std::vector<std::string> blocks;  ///< names
};

/// Places an obstacle.
struct PlaceAction {
  std::string obstacle;  ///< its name
  Pose pose;             ///< of its centre in W
};

/// Moves or turns an obstacle at a speed, instead of what it does now.
struct MoveAction {
  std::string obstacle;   ///< its name; it has a drive because of this action
  ObstacleMotion motion;  ///< a path, which begins where the obstacle is, or kStand: it stops
};

/// Tells clients something; the event is all that happens.
struct MessageAction {
  std::string text;  ///< UTF-8
};

/// Shows a text on the scene. It replaces an earlier text at the same place.
struct TextAction {
  std::string text;                                ///< UTF-8; "" removes the text at that place
  std::optional<Vec2> place = {};                  ///< of its middle, in W [m]; none: the floor's
  double duration_s = 0.0;                         ///< [s]; 0: until the end of the run
  Colour colour = Colour{0x20, 0x20, 0x20, 0xff};  ///< of the letters
};

/// Changes the grid-map that robots draw on.
struct CanvasAction {
  /// A rectangle with sides along W's axes.
  struct Area {
    Vec2 center = Vec2::Zero();  ///< in W [m]
    Vec2 size = Vec2::Zero();    ///< [m]
  };
  std::optional<Area> area;      ///< none: the whole canvas
  std::optional<Colour> colour;  ///< none: the cells become transparent
};

/// What is done if something stands in the way.
enum class WhenBlocked {
  kRefuse,  ///< it is not done
  kWait,    ///< it is done once the way is free
};

/// Puts a robot back to its start pose, at rest.
struct RestartAction {
  std::string robot;                                ///< "": the robot that sprang the trap
  WhenBlocked when_blocked = WhenBlocked::kRefuse;  ///< if its place is taken
};

/// Adds points to a robot's score.
struct ScoreAction {
  std::string robot;    ///< "": the robot that sprang the trap
  double points = 1.0;  ///< may be negative
};

/// Switches timers and traps on or off.
struct SwitchAction {
  bool on = true;                  ///< or off
  std::vector<std::string> names;  ///< of timers and traps
};

/// Ends the run with a verdict.
struct EndAction {
  bool passed = true;  ///< or failed
  std::string reason;  ///< for people
};

/// Gives a device of a robot a fault, instead of the one that it has.
struct FaultAction {
  /// What is wrong with a device.
  enum class Kind {
    kDead,   ///< it is switched off: a sensor makes no readings, motors stop
    kBlind,  ///< a laser, sonar or infrared ranger reads its maximum range everywhere
    kJump,   ///< the pose of an odometry or pose device jumps once; no lasting fault
    kNone,   ///< nothing: it is repaired
  };
  std::string robot;        ///< "": the robot that sprang the trap
  std::string device;       ///< its name
  Kind kind = Kind::kDead;  ///< what happens
  Pose by;                  ///< of a jump: the new estimate is the old one times this
};

/// An action of a timer or a trap.
using ArenaAction = std::variant<ConfigurationAction, BlocksAction, PlaceAction, MessageAction,
                                 TextAction, CanvasAction, RestartAction, ScoreAction, SwitchAction,
                                 EndAction, MoveAction, FaultAction>;

/// Acts at certain times. Times count from when the timer is switched on.
struct TimerDescription {
  std::string name;       ///< unique among timers and traps
  double at_s = 0.0;      ///< first time [s]
  double every_s = 0.0;   ///< period of further times [s]; 0: once
  int times = 0;          ///< it is switched off after having acted so often; 0: no limit
  double jitter_s = 0.0;  ///< each time is moved by a random number in [-jitter_s, jitter_s) [s]
  std::optional<Vec2> within_s;            ///< the first time is random in this interval [s],
                                           ///< instead of at_s
  bool enabled = true;                     ///< at the start
  std::vector<ArenaCondition> conditions;  ///< all must hold when it is time
  std::vector<ArenaAction> actions;        ///< in this order
};

/// A region of the floor.
struct BoxRegion {
  Vec2 center = Vec2::Zero();  ///< in W [m]
  Vec2 size = {0.2, 0.2};      ///< along its own axes [m]
  double yaw_rad = 0.0;        ///< turn of its axes against W's [rad]
};

/// A region of the floor.
struct CircleRegion {
  Vec2 center = Vec2::Zero();  ///< in W [m]
  double radius_m = 0.1;       ///< [m]
};

/// A region of the floor.
struct PolygonRegion {
  std::vector<Vec2> corners;  ///< in W [m], in either direction
};

/// The surroundings of a robot or an obstacle; they move with its centre.
struct NearRegion {
  std::string object;       ///< name of a robot or an obstacle
  double distance_m = 0.2;  ///< [m]
};

/// Where a trap is.
using TrapRegion = std::variant<BoxRegion, CircleRegion, PolygonRegion, NearRegion>;

/// Acts when a robot's centre B is in a region.
struct TrapDescription {
  /// When a trap springs.
  enum class On {
    kEnter,  ///< a robot comes in, or is inside when the trap is switched on
    kLeave,  ///< a robot goes out
    kStay,   ///< a robot has been inside for stay_s
  };
  std::string name;                        ///< unique among timers and traps
  TrapRegion region;                       ///< where it is
  std::vector<std::string> robots;         ///< those that it is for; empty: any
  std::string model;                       ///< only robots of that model; "": of any
  On on = On::kEnter;                      ///< what springs it
  double stay_s = 0.0;                     ///< of kStay [s]
  bool once = false;                       ///< it is switched off after springing
  bool enabled = true;                     ///< at the start
  std::vector<ArenaCondition> conditions;  ///< all must hold when it springs
  std::vector<ArenaAction> actions;        ///< in this order
};

/// The arena controller of a world.
struct ControllerDescription {
  std::vector<ArenaConfiguration> configurations;  ///< in the file's order
  std::vector<TimerDescription> timers;            ///< in the file's order
  std::vector<TrapDescription> traps;              ///< in the file's order

  /// Whether the world has no controller.
  [[nodiscard]] bool empty() const noexcept {
    return configurations.empty() && timers.empty() && traps.empty();
  }
};

}  // namespace sim
