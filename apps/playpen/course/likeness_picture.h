// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "course/likeness.h"
#include "sim/render/drawing.h"
#include "sim/world/description.h"

namespace playpen::course {

/// Two drives through the same world, for people to compare.
struct PairPicture {
  std::string first;   ///< whose drive is drawn as a wide line
  std::string second;  ///< whose drive is drawn as a thin line on it
  std::string run;     ///< name of the run: "cave, seed 3"
  const sim::ArenaDescription& arena;
  const Drive& first_drive;
  const Drive& second_drive;
  std::optional<double> parted_s;  ///< when they parted [s]; none: never
};

/// Draws two drives over each other on their arena: the first one wide and pale, the second one
/// thin and dark on it, so that both can be seen where they are alike. Crosses mark the places
/// where they part. What they drove afterwards is faint, below the rest.
///
/// The page is as high as the arena needs. Obstacles have their initial poses.
[[nodiscard]] sim::render::Drawing pair_picture(const PairPicture& pair);

}  // namespace playpen::course
