// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fuzz/element.h"
#include "fuzz/fault.h"
#include "grade/world_patch.h"
#include "sim/core/pose.h"
#include "sim/core/random_stream.h"
#include "sim/navigation/distance_field.h"
#include "sim/world/description.h"

/// The search for worlds in which a program fails (docs/fuzz.md).
namespace playpen::fuzz {

/// What differs from the base world.
struct Scenario {
  std::uint64_t seed = 1;                 ///< of the world's noise
  std::optional<grade::StartPose> start;  ///< of the robot; none: the world's
  std::vector<Element> elements;
  std::optional<std::set<std::string>> extended;  ///< dynamic blocks; none: as in the world
  bool real = false;                              ///< the level of realism is `real`
  double latency_s = 0.0;                         ///< of the laser; 0: the world's [s]
  double dropouts = 0.0;  ///< share of its beams that measure nothing; 0: the world's
  std::vector<DeviceFault> faults;
};

/// Distances in Base::World::room are at most this [m].
inline constexpr double kFarthestRoom_m = 0.8;
/// Between the robot at a start of a scenario and everything solid [m].
inline constexpr double kStartRoom_m = 0.1;

/// What scenarios may change, within the bounds of the section "fuzz" of the world and the task.
struct Freedom {
  bool starts = true;
  bool obstacles = true;            ///< that stand
  bool moving = true;               ///< obstacles that move
  bool maps = true;                 ///< generated ones
  bool blocks = true;               ///< which dynamic blocks are raised
  bool noise = true;                ///< levels of realism, latency and dropouts
  std::optional<bool> faults = {};  ///< of devices; none: if the section "fuzz" asks for them
  std::string task_file = {};       ///< whose section "fuzz" replaces keys of the world's; "": none
};

/// The base of all scenarios, and what they may change.
class Base {
 public:
  /// @param file   of the world; "" for the default world.
  /// @param robot  name of the robot under test; "": the first.
  /// @throws sim::ConfigError as grade::read_json_world() and grade::read_fuzz();
  ///     std::invalid_argument for a world without the robot, or if the area of the section "fuzz"
  ///     has no place for it.
  Base(const std::string& file, const std::string& robot, const Freedom& freedom = {});

  [[nodiscard]] const sim::WorldDescription& world() const noexcept { return json_.description; }
  /// Index of the robot under test.
  [[nodiscard]] std::size_t robot() const noexcept { return robot_; }
  [[nodiscard]] const sim::RobotDescription& robot_description() const {
    return world().robots[robot_];
  }
  /// Radius of the smallest circle around the robot's centre that contains its body [m].
  [[nodiscard]] double robot_radius_m() const noexcept { return robot_radius_m_; }
  /// What the world's file, the task and the command allow.
  [[nodiscard]] const Freedom& freedom() const noexcept { return freedom_; }
  /// Whether the world's file states settings of the robot's laser, so that these can be changed.
  [[nodiscard]] bool has_laser_settings() const noexcept { return !laser_.empty(); }

  /// The world file of a scenario, and what it describes.
  struct World {
    std::string text;
    sim::WorldDescription description;
    sim::DistanceField room;  ///< from the solids that stand; limited to kFarthestRoom_m
  };
  /// @return nullopt if there is no such world, or if its robot begins closer to a solid than
  ///     kStartRoom_m. The world's own start may be closer to the world's own solids.
  [[nodiscard]] std::optional<World> world_of(const Scenario& scenario) const;

  /// Whether a simpler scenario still is within the bounds of the section "fuzz".
  [[nodiscard]] bool allows(const Scenario& scenario) const;

  /// A scenario of its own, and a change of a scenario. Both may be no worlds.
  [[nodiscard]] Scenario random(sim::RandomStream& random) const;
  [[nodiscard]] Scenario mutated(Scenario scenario, sim::RandomStream& random) const;

 private:
  void read_bounds();
  void find_devices(const sim::RobotDescription& robot, const std::string& pointer);
  [[nodiscard]] bool is_open(const sim::DistanceField& room) const;
  [[nodiscard]] bool allows_element(const Element& element) const;

  [[nodiscard]] Element::Shape random_shape(bool moves, sim::RandomStream& random) const;
  [[nodiscard]] Element random_element(const Scenario& scenario, sim::RandomStream& random) const;
  [[nodiscard]] std::vector<Element> random_map(const Scenario& scenario,
                                                sim::RandomStream& random) const;
  [[nodiscard]] DeviceFault random_fault(sim::RandomStream& random) const;
  [[nodiscard]] grade::StartPose random_start(sim::RandomStream& random) const;
  [[nodiscard]] sim::Vec2 random_place(sim::RandomStream& random, double margin_m) const;
  [[nodiscard]] sim::Vec2 within_area(const sim::Vec2& place) const;
  [[nodiscard]] sim::Vec2 start_of(const Scenario& scenario) const;
  [[nodiscard]] double random_width(const std::optional<sim::Vec2>& width_m,
                                    sim::RandomStream& random) const;
  [[nodiscard]] sim::Vec2 widths(const std::optional<sim::Vec2>& width_m) const;
  void change_element(Element& element, sim::RandomStream& random) const;
  void change_start(Scenario& scenario, sim::RandomStream& random) const;
  void change_fault(Scenario& scenario, sim::RandomStream& random) const;
  void add_noise(Scenario& scenario, sim::RandomStream& random) const;

  Freedom freedom_;
  sim::FuzzDescription bounds_;
  grade::JsonWorld json_;
  sim::Vec2 low_ = sim::Vec2::Zero();   ///< corners of the area [m]
  sim::Vec2 high_ = sim::Vec2::Zero();  ///< [m]
  std::string obstacles_;               ///< JSON of the list in the file; "": none
  std::string timers_;                  ///< JSON of the controller's timers in the file; "": none
  std::string laser_;                   ///< JSON pointer of the laser's settings; "": none
  std::string odometry_;                ///< JSON pointer for the odometry's settings; "": none
  std::vector<std::string> blocks_;     ///< names of the dynamic ones
  /// Faults that the robot's devices may have; those of a random one are to be set.
  std::vector<DeviceFault> faults_;
  std::vector<Element::Shape> shapes_;  ///< of things that stand, by their frequency
  std::size_t robot_ = 0;
  double robot_radius_m_ = 0.0;
  double own_room_m_ = 0.0;  ///< that the world's own start must keep
};

/// The distance of a place to the nearest solid [m]; 0 outside of the field.
[[nodiscard]] double room_at(const sim::DistanceField& room, const sim::Vec2& place);

/// Scenarios that are a little simpler: with a half, a quarter, ... of the elements left out,
/// without another thing, or with rounder numbers. Each weighs less.
[[nodiscard]] std::vector<Scenario> simpler(const Scenario& scenario);

/// How simple a scenario is: fewer things come first, then rounder numbers.
[[nodiscard]] std::size_t weight_of(const Scenario& scenario);

/// A sentence about what a scenario adds to its world: "a box of 0.20 m x 0.10 m at (1.2, 0.5)".
[[nodiscard]] std::string description_of(const Scenario& scenario);

}  // namespace playpen::fuzz
