// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "sim/io/reader.h"
#include "sim/world/description.h"
#include "sim/world/limits.h"

/// Reads the obstacles of an arena.
namespace sim::io {

inline constexpr std::size_t kMaxObstacles = 100'000;
inline constexpr NumberRange kPositionInWorld{-kFarthest_m, kFarthest_m, false, "m"};
inline constexpr NumberRange kArenaLength{kLeastLength_m, kGreatestLength_m, false, "m"};
inline constexpr NumberRange kHeight{kLeastLength_m, 10.0, false, "m"};

/// The first free name among prefix1, prefix2, ... from `number` on; marks it as taken.
[[nodiscard]] std::string free_name(const std::string& prefix, std::size_t number,
                                    std::set<std::string>& taken);

/// Appends the obstacles or dock separators of the list `key` to `blocks`.
/// @param prefix      of the names of those that have none.
/// @param separators  they are static boxes without further properties.
void read_blocks(Reader& arena, const char* key, const char* prefix, bool separators,
                 std::vector<ObstacleDescription>& blocks);

}  // namespace sim::io
