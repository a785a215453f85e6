// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "grade/evaluation.h"

namespace playpen::grade {

/// What a task or its worlds must have, or else a figure never has a value.
enum class FigureNeed { kNothing, kGoal, kMap, kController };

/// A figure of a run: its name in the JSON file, the measure that it is, and what it needs.
struct Figure {
  using Member = std::variant<std::optional<double> Measures::*, std::optional<int> Measures::*,
                              std::optional<bool> Measures::*>;
  std::string_view name;
  Member member;
  FigureNeed need = FigureNeed::kNothing;
  std::string_view unit = {};  ///< of its numbers; "": none
};

/// The figures of a run that are measures, in the order of the JSON file.
inline constexpr std::array kFigures{
    Figure{"reached", &Measures::reached, FigureNeed::kGoal},
    Figure{"goal_distance", &Measures::goal_distance_m, FigureNeed::kGoal, "m"},
    Figure{"coverage", &Measures::coverage, FigureNeed::kMap},
    Figure{"correctness", &Measures::correctness, FigureNeed::kMap},
    Figure{"drawn", &Measures::drawn, FigureNeed::kMap},
    Figure{"seen", &Measures::seen, FigureNeed::kMap},
    Figure{"path_length", &Measures::path_length_m, FigureNeed::kNothing, "m"},
    Figure{"distance", &Measures::distance_m, FigureNeed::kNothing, "m"},
    Figure{"visited_area", &Measures::visited_area_m2, FigureNeed::kNothing, "m^2"},
    Figure{"shortest_path", &Measures::shortest_path_m, FigureNeed::kGoal, "m"},
    Figure{"path_ratio", &Measures::path_ratio, FigureNeed::kGoal},
    Figure{"collisions", &Measures::collisions},
    Figure{"least_clearance", &Measures::least_clearance_m, FigureNeed::kNothing, "m"},
    Figure{"stalled_time", &Measures::stalled_time_s, FigureNeed::kNothing, "s"},
    Figure{"sim_time", &Measures::sim_time_s, FigureNeed::kNothing, "s"},
    Figure{"score", &Measures::score, FigureNeed::kController},
};

/// The verdict of the world's controller. The JSON file has it as a word.
inline constexpr Figure kVerdictFigure{"verdict", &Measures::verdict, FigureNeed::kController};

/// Whether a figure is true or false, and not a number.
[[nodiscard]] constexpr bool is_yes_or_no(const Figure& figure) {
  return std::holds_alternative<std::optional<bool> Measures::*>(figure.member);
}

/// A figure of a run as a number: 1 for true, 0 for false; nullopt if it has no value.
[[nodiscard]] inline std::optional<double> value_of(const Measures& measures,
                                                    const Figure& figure) {
  return std::visit(
      [&measures](auto member) -> std::optional<double> {
        if (!(measures.*member)) return std::nullopt;
        return static_cast<double>(*(measures.*member));
      },
      figure.member);
}

}  // namespace playpen::grade
