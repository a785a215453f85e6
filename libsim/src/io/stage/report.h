// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/stage/entity.h"
#include "sim/core/error.h"
#include "sim/core/pose.h"

namespace sim::io::stage {

/// What a translation tells its user: errors, and what was left out or means something else.
class Report {
 public:
  /// @param world_file  path of the world file, or of the configuration file until it has named
  ///     that.
  explicit Report(std::string world_file) : world_file_(std::move(world_file)) {}

  [[nodiscard]] const std::string& world_file() const { return world_file_; }
  void set_world_file(std::string path) { world_file_ = std::move(path); }
  /// Records an error. After 100 errors, further ones are ignored.
  void error(const Place& place, std::string id, std::string expected, std::string found,
             std::string hint = "");
  /// Records what the user should know. Notes of one topic are reported once, at the first place,
  /// with the number of the others.
  void note(const std::string& topic, const Place& place, const std::string& text);
  /// Records a property of the look of Stage's window. All of them are one note.
  void look(const std::string& name, const Place& place);

  [[nodiscard]] bool has_errors() const { return !errors_.empty(); }
  [[nodiscard]] const std::vector<ConfigIssue>& errors() const { return errors_; }
  /// "FILE:LINE: TEXT" for each topic, in the order of their first places.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Note {
    Place place;
    std::string text;
    std::size_t more = 0;
  };

  std::string world_file_;
  std::vector<ConfigIssue> errors_;
  std::vector<Note> notes_;
  std::map<std::string, std::size_t> topics_;
  std::vector<std::string> look_;  ///< names
  Place look_place_;
};

/// Units of a world file, see `unit_length` and `unit_angle`.
struct Units {
  double length_m = 1.0;
  double angle_rad = 0.017453292519943295;
  bool three_number_poses_turn = false;  ///< as in Stage 2: pose [x y heading]
  bool flat = false;                     ///< as in Stage 2: nothing has a height
};

/// A pose in three dimensions, as world files have them: x, y and z, and a heading.
struct Pose3 {
  Pose pose;
  double z_m = 0.0;
};

/// Typed access to the properties of an entity. Each getter marks its property as used, gives the
/// fallback if there is none, and records an error if it has another type. As in Stage, a text of
/// digits is a number, and a number in place of a text is its digits.
class Properties {
 public:
  Properties(const Entity& entity, const Units& units, Report& report)
      : entity_(entity), units_(units), report_(report) {}

  [[nodiscard]] const Entity& entity() const { return entity_; }
  [[nodiscard]] bool has(std::string_view name) const { return entity_.find(name) != nullptr; }
  /// Place of a property, or of the entity if there is none.
  [[nodiscard]] const Place& place_of(std::string_view name) const;
  [[nodiscard]] double number(std::string_view name, double fallback) const;
  [[nodiscard]] double length_m(std::string_view name, double fallback_m) const;
  [[nodiscard]] double angle_rad(std::string_view name, double fallback_rad) const;
  [[nodiscard]] int integer(std::string_view name, int fallback) const;
  [[nodiscard]] bool flag(std::string_view name, bool fallback) const;
  [[nodiscard]] std::string text(std::string_view name, const std::string& fallback) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view name) const;
  /// The first `most` numbers of a tuple, without units; a tuple may be shorter.
  [[nodiscard]] std::vector<double> numbers(std::string_view name, std::size_t most) const;
  /// Numbers of a tuple over the fallback, by their kinds as in Stage: 'l' length, 'a' angle, 'f'
  /// number.
  template <std::size_t kCount>
  [[nodiscard]] std::array<double, kCount> tuple(std::string_view name,
                                                 const char (&kinds)[kCount + 1],
                                                 std::array<double, kCount> fallback) const {
    const std::vector<double> given = numbers(name, kCount);
    for (std::size_t i = 0; i < given.size(); ++i) fallback[i] = given[i] * unit(kinds[i]);
    return fallback;
  }
  /// `[x y z heading]`; `[x y heading]` in files of Stage 2.
  [[nodiscard]] Pose3 pose(std::string_view name, const Pose3& fallback = {}) const;

  /// A property that is one of these words. @return its index; the fallback and a note for others.
  [[nodiscard]] std::size_t choice(std::string_view name, std::size_t fallback,
                                   const std::vector<std::string>& words) const;

 private:
  [[nodiscard]] double unit(char kind) const;
  [[nodiscard]] std::optional<double> single(std::string_view name, const char* expected) const;
  void wrong_type(const Property& property, const char* expected) const;

  const Entity& entity_;
  const Units& units_;
  Report& report_;
};

}  // namespace sim::io::stage
