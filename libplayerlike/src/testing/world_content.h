// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playerlike/testing/world.h"
#include "sim/world/description.h"

namespace playpen::testing {

/// A goal of World::Goal().
struct GoalRequest {
  std::string robot;
  Point point;
  double tolerance_m = 0.0;
};

struct World::Content {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::string file;                    ///< path of the file that it began with; "": none
  std::map<std::string, int> numbers;  ///< of obstacles without a name, by kind
  std::vector<GoalRequest> goals;

  /// Reads the world file with all checks. @throws Error with all mistakes.
  [[nodiscard]] sim::WorldDescription description() const;
  /// An object of the file, which is made if it is missing. @throws Error if it is something else.
  nlohmann::ordered_json& object(const char* key);
  nlohmann::ordered_json& robots();
  /// The robot of that name; null if there is none.
  nlohmann::ordered_json* find_robot(const std::string& name);
  void add_obstacle(const char* kind, const std::string& name, nlohmann::ordered_json obstacle);
};

}  // namespace playpen::testing
