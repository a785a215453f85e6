// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "grade/evaluation.h"

namespace playpen::grade {

/// A figure of a run: its name in the JSON file, and the measure that it is.
struct Figure {
  using Member = std::variant<std::optional<double> Measures::*, std::optional<int> Measures::*,
                              std::optional<bool> Measures::*>;
  std::string_view name;
  Member member;
};

/// The figures of a run that are measures, in the order of the JSON file.
inline constexpr std::array kFigures{
    Figure{"reached", &Measures::reached},
    Figure{"goal_distance", &Measures::goal_distance_m},
    Figure{"coverage", &Measures::coverage},
    Figure{"correctness", &Measures::correctness},
    Figure{"drawn", &Measures::drawn},
    Figure{"seen", &Measures::seen},
    Figure{"path_length", &Measures::path_length_m},
    Figure{"distance", &Measures::distance_m},
    Figure{"visited_area", &Measures::visited_area_m2},
    Figure{"shortest_path", &Measures::shortest_path_m},
    Figure{"path_ratio", &Measures::path_ratio},
    Figure{"collisions", &Measures::collisions},
    Figure{"least_clearance", &Measures::least_clearance_m},
    Figure{"stalled_time", &Measures::stalled_time_s},
    Figure{"sim_time", &Measures::sim_time_s},
    Figure{"score", &Measures::score},
};

}  // namespace playpen::grade
