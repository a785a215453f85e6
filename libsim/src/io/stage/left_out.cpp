// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/left_out.h"

#include <algorithm>
#include <iterator>

namespace sim::io::stage {

bool is_look(std::string_view name) {
  constexpr std::string_view kNames[] = {
      "show_clock",  "show_clock_interval", "trail_length", "trail_interval", "paused", "interval",
      "gui_disable", "gui_interval",        "line_style",   "texture",        "say"};
  return name.starts_with("gui_") || name == "window" ||
         std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

bool is_without_effect(std::string_view name) {
  constexpr std::string_view kNames[] = {"alwayson",
                                         "map_resolution",
                                         "event_queue",
                                         "threads",
                                         "resolution",
                                         "friction",
                                         "debug",
                                         "stack_children",
                                         "update_interval",
                                         "watts",
                                         "power_on",
                                         "color",
                                         "color_rgba",
                                         "ssize",
                                         "joules",
                                         "kjoules",
                                         "joules_capacity",
                                         "kjoules_capacity",
                                         "colors_count",
                                         "range_min",
                                         "blobfinder_return",
                                         "audio_return",
                                         "puck_return",
                                         "bitmap_resolution",
                                         "z",
                                         "points",
                                         "noblocks",
                                         "boundary",
                                         "size",
                                         "name",
                                         "mass",
                                         "laser_return",
                                         "ranger_return",
                                         "blob_return",
                                         "gripper_return",
                                         "obstacle_return",
                                         "fiducial_return",
                                         "pose",
                                         "origin",
                                         "test",
                                         "quit_time",
                                         "interval_sim",
                                         "unit_length",
                                         "unit_angle"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

bool is_old_device(std::string_view type) {
  return type == "power" || type == "energy" || type == "speech" || type == "audio";
}

bool is_of_stage_1(std::string_view type) {
  constexpr std::string_view kNames[] = {"environment", "bitmap", "player", "truth",    "gps",
                                         "sonar",       "vision", "lbd",    "broadcast"};
  return std::find(std::begin(kNames), std::end(kNames), type) != std::end(kNames);
}

}  // namespace sim::io::stage
