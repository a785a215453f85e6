// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "playerlike/host/report.h"
#include "sim/world/description.h"

/// What a user expects of a run (docs/testing.md).
namespace playpen::expect {

/// A bound of a figure of report.json: "collisions == 0", "r1.path_length > 10", "passed == yes".
class Expectation {
 public:
  /// A comparison of what was measured with the bound.
  enum class Comparison { kEqual, kUnequal, kLess, kAtMost, kGreater, kAtLeast };

  /// Reads "[ROBOT.]FIGURE OPERATOR VALUE". Figures of robots without the name of one are expected
  /// of each robot.
  /// @throws std::invalid_argument that says what was expected and found, and names the figures.
  [[nodiscard]] static Expectation parse(const std::string& text);

  /// As the user wrote it, without needless blanks.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  /// @throws std::invalid_argument if the world does not have the robot.
  void require_robot_of(const sim::WorldDescription& world) const;

  /// How a run does not meet it, in sentences without a full stop: "r1 has 2; the first with s2 at
  /// 12.97 s, x 0.94, y 1.71". Empty: it does. A figure without a value meets nothing.
  [[nodiscard]] std::vector<std::string> faults_of(const playerlike::Report& report) const;

 private:
  Expectation() = default;
  [[nodiscard]] bool is_met_by(double value) const noexcept;

  std::string text_;
  std::string robot_;   ///< "": each robot, or a figure of the run
  std::string figure_;  ///< its name
  Comparison comparison_ = Comparison::kEqual;
  double bound_ = 0.0;  ///< of yes and no 1 and 0
};

/// A figure that can be expected.
struct Figure {
  std::string name;
  bool of_robot = false;   ///< of each robot, otherwise of the run
  bool yes_or_no = false;  ///< its values are yes and no, otherwise numbers
};

/// All figures, in the order of the report: numbers of its robots and of the run by their names
/// there, and "reached", "score" and "passed". Figures of the wall clock and settings are not among
/// them.
[[nodiscard]] const std::vector<Figure>& figures();

}  // namespace playpen::expect
