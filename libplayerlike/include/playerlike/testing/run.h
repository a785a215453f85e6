// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "playerlike/testing/world.h"

namespace playpen::testing {

class TestRun;

/// A robot after a step.
struct Sample {
  double time_s = 0.0;       ///< simulated time [s]
  Pose pose;                 ///< true pose
  double speed_mps = 0.0;    ///< magnitude of its velocity over the step [m/s]
  double clearance_m = 0.0;  ///< distance of its body to the nearest solid [m]; 0 if it has
                             ///< collided in the step; infinite if there is no solid
  int nearest = -1;          ///< see TestRun::solid_name(); -1: there is no solid
};

/// The start of a collision.
struct Collision {
  double time_s = 0.0;  ///< simulated time [s]
  std::string robot;
  std::string partner;  ///< name of an obstacle or a robot, "border" or "wall"
  Point place;          ///< contact point
};

/// A cell of a layer of the grid-map.
struct Cell {
  unsigned char red = 0, green = 0, blue = 0, alpha = 0;  ///< alpha 0: nothing is drawn there
  double occupancy = 0.5;                                 ///< of a grey layer, 0..1
};

/// State of a run between two steps: world, robots, devices with their noise, drawings, and
/// commands that wait for the next step. A value; copies share it.
class Moment {
 public:
  Moment(const Moment&) = default;
  Moment& operator=(const Moment&) = default;
  [[nodiscard]] double time_s() const;

  struct Content;  ///< for Playpen itself

 private:
  friend class TestRun;
  explicit Moment(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  std::shared_ptr<const Content> content_;
};

/// A simulation in this process, in lockstep: simulated time advances only while the code under
/// test waits in Read(), or in Advance(). It is repeatable to the bit. Runs are independent of one
/// another, and end when they are destroyed: then Read() of clients that remain throws.
///
/// It is not called Run, because GoogleTest's tests have a member of that name.
///
/// The run records each robot after each step, so matchers judge all of it.
///
/// Robots are named as in the world; "" means the only one. Devices are named "ROBOT.DEVICE", or
/// "DEVICE" of the only robot. Unless stated otherwise, functions throw Error for unknown names;
/// the text lists the known ones. Any thread may call them.
class TestRun {
 public:
  /// @throws Error with all mistakes of the world.
  explicit TestRun(const World& world);
  /// Continues from a moment: independent of the run that has saved it, and without its clients.
  /// Records begin at the moment, so matchers judge what follows.
  explicit TestRun(const Moment& moment);
  TestRun(TestRun&& other) noexcept;
  TestRun& operator=(TestRun&& other) noexcept;
  ~TestRun();

  /// The name by which clients connect: `PlayerClient client(run.host(), 6665)`. It is "test:N",
  /// another one for each run.
  [[nodiscard]] const std::string& host() const noexcept;
  /// Makes "localhost" a name of this run, as long as the run exists, for code that names it.
  /// @throws Error if another run has it.
  TestRun& AsLocalhost();

  /// Lets simulated time pass without the code under test. Robots go on with their last commands.
  /// @param seconds  rounded up to whole steps.
  /// @throws Error if seconds is negative or the run is over.
  void Advance(double seconds);

  /// @name The present
  /// @{
  [[nodiscard]] double time_s() const;  ///< simulated time [s]
  [[nodiscard]] bool finished() const;  ///< whether the world's duration is over
  [[nodiscard]] std::vector<std::string> robots() const;
  [[nodiscard]] const std::string& world_name() const;
  [[nodiscard]] Pose pose(const std::string& robot = "") const;  ///< true pose
  [[nodiscard]] double speed_mps(const std::string& robot = "") const;
  /// Turn rate, counter-clockwise [rad/s].
  [[nodiscard]] double turn_rate_radps(const std::string& robot = "") const;
  [[nodiscard]] double clearance_m(const std::string& robot = "") const;  ///< see Sample
  /// Whether the motors push in vain.
  [[nodiscard]] bool stalled(const std::string& robot = "") const;
  /// Pose of an obstacle or a robot.
  [[nodiscard]] Pose object(const std::string& name) const;
  /// Newest ranges of a laser, sonar or infrared device [m]; empty before the first reading.
  /// @throws Error for other devices.
  [[nodiscard]] std::vector<double> ranges_m(const std::string& device) const;
  /// The cell of a layer at a place.
  /// @param layer  "canvas", or a layer's name; of several, the one on top.
  /// @throws Error for a place outside the grid-map.
  [[nodiscard]] Cell cell(const std::string& layer, const Point& place) const;
  /// Hash of the state: equal hashes mean equal futures.
  [[nodiscard]] std::uint64_t state_hash() const;
  /// @}

  /// @name Since the beginning of the run, or of the fork
  /// @{
  [[nodiscard]] std::vector<Sample> path(const std::string& robot = "") const;
  [[nodiscard]] double path_length_m(const std::string& robot = "") const;
  [[nodiscard]] double least_clearance_m(const std::string& robot = "") const;
  /// Collisions of a robot; "": of all robots.
  [[nodiscard]] std::vector<Collision> collisions(const std::string& robot = "") const;
  /// The solid that Sample::nearest means.
  [[nodiscard]] std::string solid_name(int solid) const;
  /// Whether a robot has reached its goals, in the order of the world; also before a fork.
  [[nodiscard]] std::vector<bool> goals_reached(const std::string& robot = "") const;
  /// @}

  /// @name Faults and changes, between two steps
  /// @{
  /// Switches a device off: a sensor makes no readings, a motion device stops and refuses commands.
  void Kill(const std::string& device);
  void Revive(const std::string& device);
  /// Moves a robot or an obstacle at once.
  /// @throws Error if the place is not free.
  void MoveTo(const std::string& object, const Pose& pose);
  /// Moves a robot or an obstacle by a distance along the world's axes.
  void Push(const std::string& object, const Point& by);
  /// Extends or retracts a dynamic block.
  /// @throws Error if the block is static or a robot stands on it.
  void Extend(const std::string& block);
  void Retract(const std::string& block);
  /// @}

  [[nodiscard]] Moment Save() const;
  /// The same as TestRun(Save()). Several forks try several futures.
  [[nodiscard]] TestRun Fork() const;

  /// Where a picture points to.
  struct Mark {
    std::string robot;
    Sample at;         ///< a ghost of the robot is drawn there
    std::string text;  ///< beside it
  };
  /// Writes a picture of the present, with the path of each robot, collisions and goals.
  /// @throws Error if it cannot be written.
  void SavePicture(const std::string& png_file, const std::optional<Mark>& mark = {}) const;

  struct Content;  ///< for Playpen itself

 private:
  friend struct Judge;
  std::unique_ptr<Content> content_;
};

/// A robot of a run, for expectations of one robot: `EXPECT_THAT(of(run, "r2"), DoesNotCollide())`.
struct RobotOf {
  const TestRun* run;
  std::string robot;
};
/// A robot of a run by its name, which is checked when an expectation uses it.
[[nodiscard]] inline RobotOf of(const TestRun& run, const std::string& robot) {
  return {&run, robot};
}

/// Writes "run of WORLD at 12.3 s", for messages of GoogleTest.
void PrintTo(const TestRun& run, std::ostream* out);
/// The same, with the robot's name.
void PrintTo(const RobotOf& robot, std::ostream* out);

}  // namespace playpen::testing
