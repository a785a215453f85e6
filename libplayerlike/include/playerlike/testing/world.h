// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// The target playpen::testing defines it: the folder of the shipped worlds.
#ifndef PLAYPEN_WORLDS_DIR
#define PLAYPEN_WORLDS_DIR ""
#endif

/// Tests of robot programs beside GoogleTest. Actions and matchers are spelt as in GoogleTest,
/// queries as in the rest of Playpen. Headers are C++17.
namespace playpen::testing {

/// What a test asks for is impossible, or its world is wrong. The text says where, what was
/// expected and what was found.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A point in the world.
struct Point {
  double x_m = 0.0;  ///< [m]
  double y_m = 0.0;  ///< [m]
};

/// Pose of a robot (the middle of its axle) or of an obstacle (its centre) in the world.
struct Pose {
  double x_m = 0.0;      ///< [m]
  double y_m = 0.0;      ///< [m]
  double yaw_rad = 0.0;  ///< counter-clockwise from the x axis [rad]; see Degrees()
};

/// Extent of a box along its own axes.
struct Size {
  double x_m = 0.0;  ///< [m]
  double y_m = 0.0;  ///< [m]
};

/// An angle in radians.
constexpr double Degrees(double angle_deg) { return angle_deg * 3.14159265358979323846 / 180.0; }

/// Value of a setting of a world.
class Value {
 public:
  Value(double number);
  Value(int number);
  Value(bool flag);
  Value(const char* text);
  Value(const std::string& text);
  /// Any value as JSON, such as "[1, 2]".
  [[nodiscard]] static Value Json(std::string json);

  [[nodiscard]] const std::string& json() const noexcept { return json_; }

 private:
  Value() = default;
  std::string json_;
};

/// A world in code. Each function adds to the world and returns it, so that calls can be chained:
///
///     World().Room(4, 3).Robot("r1", {1, 1.5, 0}).Box({3, 1.5, 0}, {0.3, 0.3}, "crate")
///
/// The functions write a world file in memory (docs/world_format.md), which a TestRun reads like a
/// file. So the checks are those of files, and what is left out has the defaults of files: without
/// Room() and File() the arena is SyRoTek's, without Robot() there is one S1R.
class World {
 public:
  World();
  World(const World& other);
  World(World&& other) noexcept;
  World& operator=(World other) noexcept;
  ~World();

  /// Begins with a world file, to which later calls add. Call it first.
  /// @param name  path of a file, or name of a shipped world such as "par_intro" or
  ///     "tasks/par_intro".
  /// @param shipped  folder of the shipped worlds; "": none is known.
  /// @throws Error if there is no such file, if it is no JSON, or after another call.
  World& File(const std::string& name, const std::string& shipped = PLAYPEN_WORLDS_DIR);

  /// The name of the world in messages and pictures ["test"].
  World& Name(const std::string& name);
  /// A room with a border and nothing in it: x from 0 to width, y from 0 to height [m].
  World& Room(double width_m, double height_m);

  /// Adds a robot, or moves the robot of that name.
  /// @param model  a name of `playpen list`, such as "s1r", or the file of a model; "": the default
  ///     or the robot's model before.
  World& Robot(const std::string& name, const Pose& pose, const std::string& model = "");

  /// @name Obstacles
  ///
  /// Without a name they are called after their kind and number: wall1, box1, circle1, ...
  /// @{

  /// A wall from point to point; its thickness lies half on each side.
  World& Wall(const Point& from, const Point& to, double thickness_m = 0.05,
              const std::string& name = "");
  World& Box(const Pose& pose, const Size& size, const std::string& name = "");
  World& Circle(const Point& center, double radius_m, const std::string& name = "");
  /// A circle that moves from the first point to the others and back, again and again.
  /// @param points  at least two.
  World& MovingCircle(const std::vector<Point>& points, double radius_m, double speed_mps,
                      const std::string& name = "");
  /// A box that TestRun::Extend() and TestRun::Retract() move.
  World& Block(const Pose& pose, const Size& size, const std::string& name = "",
               bool extended = true);
  /// A box that robots can push.
  World& Crate(const Pose& pose, const Size& size, double mass_kg, const std::string& name = "");
  /// @}

  /// A goal of a robot: the matcher ReachesGoals() expects it to be within the tolerance of the
  /// point at some time. Pictures show it.
  World& Goal(const std::string& robot, const Point& point, double tolerance_m = 0.1);

  /// Seed of noise and of everything else that is random [1].
  World& Seed(unsigned seed);
  /// Level of realism: "ideal", "course" or "real" (docs/realism.md).
  World& Realism(const std::string& level);
  /// Simulated time after which the run ends [s]; without it, it does not end.
  World& Duration(double seconds);

  /// Sets a value of the world file, such as Set("/arena/border", false).
  /// @param pointer  JSON pointer (RFC 6901); missing objects on the way are made.
  /// @throws Error if the pointer does not fit the world.
  World& Set(const std::string& pointer, const Value& value);
  /// Sets a setting of a robot's device, such as Set("r1.laser", "dropouts", 0.1). With those of
  /// docs/realism.md a sensor is noisy or late and wheels slip.
  /// @throws Error if there is no such robot yet. A wrong device or setting is an error of the
  /// TestRun.
  World& Set(const std::string& device, const std::string& setting, const Value& value);

  /// The world file.
  [[nodiscard]] std::string json() const;

 private:
  friend class TestRun;
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace playpen::testing
