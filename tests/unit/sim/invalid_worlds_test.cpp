// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "device_table.h"
#include "sim/io/world_io.h"

namespace sim::io {
namespace {

namespace fs = std::filesystem;

/// The expected errors of a bad file: id and place of the first issue, and words of its message.
struct BadWorld {
  const char* name;
  const char* id;
  const char* pointer;
  int line;  ///< 0: the issue concerns the whole file
  const char* expected;
  const char* found;
};

void PrintTo(const BadWorld& bad, std::ostream* out) { *out << bad.name; }

const BadWorld kBadWorlds[] = {
    // The arena controller; each error is in line 2.
    {"arena_action_without_kind", "world/missing-key", "/controller/timers/0/do/0", 2,
     "an action: one of the keys configuration, extend", "none"},
    {"arena_action_unknown", "world/unknown-key", "/controller/timers/0/do/0/mesage", 2,
     "configuration, extend", "did you mean \"message\"?"},
    {"arena_action_two_kinds", "world/conflicting-keys", "/controller/timers/0/do/0", 2,
     "an action with one of the keys", "extend and message"},
    {"arena_action_wrong_type", "world/wrong-type", "/controller/timers/0/do/0/extend/0", 2,
     "a name in double quotes", "1"},
    {"arena_canvas_half", "world/missing-key", "/controller/timers/0/do/0/canvas", 2, "\"size\"",
     "none"},
    {"arena_condition_two_kinds", "world/conflicting-keys", "/controller/timers/0/if/0", 2,
     "a condition with one of the keys", "time and block"},
    {"arena_condition_limits", "world/out-of-range", "/controller/timers/0/if/0/count", 2,
     "\"at_least\" not above \"at_most\"", "3 and 2"},
    {"arena_condition_time", "world/out-of-range", "/controller/timers/0/if/0/time", 2,
     "\"from\" less than \"to\"", "3 and 2"},
    {"arena_condition_without_battery", "world/missing-device", "/controller/timers/0/if/0/battery",
     2, "a robot with the device \"battery\"", "robot bob without it"},
    {"arena_condition_without_robot", "world/missing-key", "/controller/timers/0/if/0/speed", 2,
     "\"robot\"", "no robot springs a timer"},
    {"arena_configuration_conflicting", "world/conflicting-state",
     "/controller/configurations/a/retracted/0", 2, "one of the two", "\"gate\""},
    {"arena_configuration_name", "world/bad-name", "/controller/configurations/a b", 2, "letters",
     "\"a b\""},
    {"arena_configuration_static", "world/static-obstacle",
     "/controller/configurations/a/extended/0", 2, "a dynamic obstacle", "\"box\""},
    {"arena_configuration_unknown", "world/unknown-configuration",
     "/controller/timers/0/do/0/configuration", 2, "the name of a configuration: open",
     "did you mean \"open\"?"},
    {"arena_configuration_pose", "world/unknown-obstacle", "/controller/configurations/a/poses/bix",
     2, "the name of an obstacle: box or gate", "did you mean \"box\"?"},
    {"arena_duplicate_name", "world/duplicate-name", "/controller/traps/0/name", 2,
     "each timer and trap", "first at /controller/timers/0"},
    {"arena_end_verdict", "world/unknown-value", "/controller/timers/0/do/0/end/verdict", 2,
     "\"passed\" or \"failed\"", "did you mean \"passed\"?"},
    {"arena_end_without_verdict", "world/missing-key", "/controller/timers/0/do/0/end", 2,
     "\"verdict\"", "none"},
    {"arena_too_much_work", "world/too-much-work", "/controller/timers/0", 2,
     "at most 20000 operations in a step", "524290 operations"},
    {"arena_message_too_long", "world/out-of-range", "/controller/timers/0/do/0/message", 2,
     "at most 200 bytes", "201 bytes"},
    {"arena_fault_device", "world/missing-device", "/controller/timers/0/do/0/fault/device", 2,
     "a device of robot bob", "did you mean \"laser\"?"},
    {"arena_fault_type", "world/missing-device", "/controller/timers/0/do/0/fault/device", 2,
     "a laser, sonar or infrared ranger", "\"pose\", which is of type pose"},
    {"arena_fault_jump", "world/missing-device", "/controller/timers/0/do/0/fault/device", 2,
     "an odometry or pose device", "\"laser\", which is of type laser"},
    {"arena_fault_kind", "world/unknown-value", "/controller/timers/0/do/0/fault/kind", 2,
     "\"blind\"", "\"deaf\""},
    // Bounds of playpen fuzz.
    {"fuzz_bounds", "world/out-of-range", "/fuzz/obstacles/size", 2, "[least, greatest]",
     "[0.6, 0.03]"},
    {"fuzz_speed", "world/out-of-range", "/fuzz/moving/speed/1", 2, "from 0.01", "1000"},
    {"fuzz_unknown_key", "world/unknown-key", "/fuzz/corridors/widht", 2, "width",
     "did you mean \"width\"?"},
    {"fuzz_unknown_shape", "world/unknown-value", "/fuzz/obstacles/shapes/1", 2, "\"circle\"",
     "did you mean \"triangle\"?"},
    {"fuzz_no_shape", "world/out-of-range", "/fuzz/obstacles/shapes", 2, "at least one of \"box\"",
     "none"},
    {"fuzz_word_twice", "world/unknown-value", "/fuzz/without/1", 2, "each word once",
     "\"starts\" again"},
    {"arena_timer_at_and_within", "world/conflicting-keys", "/controller/timers/0/at", 2,
     "either \"at\" or \"within\"", "both"},
    {"arena_timer_every", "world/out-of-range", "/controller/timers/0/every", 2, "from 0.001", "0"},
    {"arena_timer_jitter", "world/out-of-range", "/controller/timers/0/jitter", 2,
     "at most half of \"every\": 1 s", "1.5"},
    {"arena_timer_unknown", "world/unknown-trap", "/controller/timers/0/do/0/enable/0", 2,
     "the name of a timer or trap: dawn", "did you mean \"dawn\"?"},
    {"arena_timer_unknown_key", "world/unknown-key", "/controller/timers/0/evry", 2, "every",
     "did you mean \"every\"?"},
    {"arena_timer_within", "world/out-of-range", "/controller/timers/0/within", 2,
     "from not above to", "[3, 2]"},
    {"arena_trap_for", "world/conflicting-keys", "/controller/traps/0/for", 2,
     "only with \"on\": \"stay\"", "\"enter\""},
    {"arena_trap_model", "world/unknown-model", "/controller/traps/0/model", 2,
     "the model of a robot of this world: s1r", "\"s1l\""},
    {"arena_trap_near_nothing", "world/unknown-obstacle", "/controller/traps/0/near/object", 2,
     "the name of a robot or an obstacle: bob, box or gate", "did you mean \"bob\"?"},
    {"arena_trap_near_two", "world/conflicting-keys", "/controller/traps/0/near", 2,
     "one of the keys object or place", "object and place"},
    {"arena_trap_on", "world/unknown-value", "/controller/traps/0/on", 2,
     "\"enter\", \"leave\" or \"stay\"", "did you mean \"enter\"?"},
    {"arena_trap_polygon", "world/out-of-range", "/controller/traps/0/region/polygon", 2,
     "at least 3 corners", "2"},
    {"arena_trap_radius", "world/out-of-range", "/controller/traps/0/region/circle/radius", 2,
     "greater than 0", "0"},
    {"arena_trap_robot", "world/unknown-robot", "/controller/traps/0/robots/0", 2,
     "the name of a robot: bob", "did you mean \"bob\"?"},
    {"arena_trap_two_places", "world/conflicting-keys", "/controller/traps/0", 2,
     "one of the keys region or near", "region and near"},
    {"arena_trap_without_place", "world/missing-key", "/controller/traps/0", 2,
     "one of the keys region or near", "none"},
    // Obstacles that move or can be pushed.
    {"arena_move_angle_and_repeat", "world/conflicting-keys",
     "/controller/timers/0/do/0/move/yaw_deg", 3, "only for a path that ends", "\"repeat\""},
    {"arena_move_dynamic", "world/conflicting-keys", "/controller/timers/0/do/0/move/obstacle", 3,
     "a static obstacle that moves", "a dynamic one of gate"},
    {"arena_move_nowhere", "world/missing-key", "/controller/timers/0/do/0/move", 3,
     "\"to\", \"path\", \"yaw_deg\" or \"stop\"", "none"},
    {"arena_move_stop_and_to", "world/conflicting-keys", "/controller/timers/0/do/0/move/stop", 3,
     "either \"stop\" or a way to move", "both"},
    {"arena_move_to_and_path", "world/conflicting-keys", "/controller/timers/0/do/0/move/to", 3,
     "either \"to\" or \"path\"", "both"},
    {"arena_move_unknown", "world/unknown-obstacle", "/controller/timers/0/do/0/move/obstacle", 3,
     "the name of an obstacle: box or gate", "did you mean \"box\"?"},
    {"arena_move_without_obstacle", "world/missing-key", "/controller/timers/0/do/0/move", 3,
     "\"obstacle\"", "none"},
    {"friction_without_mass", "world/conflicting-keys", "/arena/obstacles/0/friction", 2,
     "only with \"mass\"", "no \"mass\""},
    {"mass_of_a_dynamic_obstacle", "world/conflicting-keys", "/arena/obstacles/0/mass", 2,
     "a static obstacle to push", "a dynamic one"},
    {"mass_out_of_range", "world/out-of-range", "/arena/obstacles/0/mass", 2, "from 0.001", "0"},
    {"motion_area_without_size", "world/missing-key", "/arena/obstacles/0/motion/area", 2,
     "\"size\"", "none"},
    {"motion_force", "world/out-of-range", "/arena/obstacles/0/motion/force/repulsion_range", 2,
     "from 0.001", "0"},
    {"motion_no_points", "world/out-of-range", "/arena/obstacles/0/motion/points", 2,
     "at least one point", "an empty list"},
    {"motion_of_a_concave_outline", "world/bad-outline", "/arena/obstacles/0/outline", 3,
     "a convex outline of at most 8 points", "a concave outline"},
    {"motion_of_a_dynamic_obstacle", "world/conflicting-keys", "/arena/obstacles/0/motion", 2,
     "a static obstacle that moves", "a dynamic one"},
    {"motion_of_a_portable_obstacle", "world/conflicting-keys", "/arena/obstacles/0/motion", 2,
     "a static obstacle that moves", "a portable one"},
    {"motion_point_is_no_pair", "world/wrong-type", "/arena/obstacles/0/motion/points/1", 2,
     "two numbers", "a list of 1"},
    {"motion_repeat", "world/unknown-value", "/arena/obstacles/0/motion/repeat", 2,
     "\"once\", \"back_and_forth\" or \"round\"", "\"random\""},
    {"motion_speed", "world/out-of-range", "/arena/obstacles/0/motion/speed", 2, "greater than 0",
     "0"},
    {"motion_type", "world/unknown-value", "/arena/obstacles/0/motion/type", 2,
     "\"path\", \"random_walk\" or \"pedestrian\"", "did you mean \"path\"?"},
    {"motion_unknown_key", "world/unknown-key", "/arena/obstacles/0/motion/sped", 2, "speed",
     "did you mean \"speed\"?"},
    {"motion_without_points", "world/missing-key", "/arena/obstacles/0/motion", 2, "\"points\"",
     "none"},
    {"motion_without_type", "world/missing-key", "/arena/obstacles/0/motion", 2, "\"type\"",
     "none"},
    {"movable_obstacles_overlap", "world/obstacles-overlap", "/arena/obstacles/0/center", 2,
     "a place clear of obstacle box", "cart at (1.00, 1.00) overlapping it by 0.05 m"},
    {"bottom_of_portable", "world/bottom", "/arena/obstacles/0/bottom", 1,
     "neither moves, nor rises, nor is carried", "of one that does"},
    {"bottom_over_top", "world/bottom", "/arena/obstacles/0/bottom", 1,
     "less than \"height\", 0.3 m", "0.3 m"},
    {"static_obstacle_rises", "world/static-obstacle", "/arena/obstacles/0/rise_speed", 1,
     "a dynamic obstacle", "\"rise_speed\" of a static one"},
    {"when_blocked", "world/unknown-value", "/arena/obstacles/0/when_blocked", 1,
     "\"refuse\" or \"wait\"", "did you mean \"wait\"?"},
    {"bad_colour", "world/bad-colour", "/robots/0/colour", 1, "#ff8800", "orange"},
    {"bad_colour_of_obstacle", "world/bad-colour", "/arena/obstacles/0/colour", 1, "#ff8800",
     "#ff88"},
    {"bad_name", "world/bad-name", "/robots/0/name", 1, "letters", "my robot"},
    {"canvas_too_large", "world/canvas-too-large", "/canvas/cell_size", 1, "8192", "34200 x 37200"},
    {"circle_outside", "world/obstacle-outside", "/arena/obstacles/0", 1, "(3.00, 3.00)",
     "drum sticking out 0.15 m beyond the right side (center is the middle of the circle"},
    {"circle_too_small", "world/out-of-range", "/arena/obstacles/0/radius", 1,
     "from 0.001 to 5000 m", "0.0001"},
    // Its right end is at 9000 m, a millionth of which is 9 mm.
    {"circle_too_small_far_away", "world/out-of-range", "/arena/obstacles/0/radius", 2,
     "at least 0.009", "0.004 m of pin"},
    {"circle_with_size", "world/conflicting-keys", "/arena/obstacles/0/size", 1,
     "no \"size\" with \"shape\": \"circle\"", "both (\"size\" belongs to"},
    {"circle_without_radius", "world/missing-key", "/arena/obstacles/0", 1, "\"radius\"", "none"},
    {"conflicting_keys", "world/conflicting-keys", "/arena/size", 1, "either", "both"},
    {"conflicting_state", "world/conflicting-state", "/arena/retracted/0", 1, "one of the two",
     "\"d3\""},
    {"device_setting_out_of_range", "world/out-of-range", "/robots/0/devices/laser/frequency", 1,
     "greater than 0", "0"},
    {"device_setting_unknown", "world/unknown-key", "/robots/0/devices/laser/frequncy", 1,
     "frequency", "did you mean \"frequency\"?"},
    {"driver_without_type", "world/missing-key", "/robots/0/drivers/0", 1, "\"type\"", "none"},
    {"duplicate_key", "json/duplicate-key", "/name", 4, "each key once", "first in line 2"},
    {"duplicate_name", "world/duplicate-name", "/robots/1/name", 3, "a name of its own",
     "\"bob\" a second time"},
    {"duplicate_obstacle_name", "world/duplicate-name", "/arena/obstacles/0/name", 1,
     "a name of its own", "\"s1\" a second time"},
    {"duplicate_port", "world/duplicate-port", "/robots/1/port", 3, "a port of its own",
     "7000 a second time"},
    {"empty", "file/empty", "", 0, "{}", "nothing"},
    {"floor_too_far", "world/out-of-range", "/arena/origin", 1, "at most 10000 m", "11000 m"},
    {"invalid_utf8", "json/invalid-utf8", "", 1, "UTF-8", "0xf6"},
    {"map_resolution_too_fine", "world/out-of-range", "/arena/map/resolution", 1, "from 0.001",
     "1e-300"},
    {"map_unreadable", "world/map-unreadable", "/arena/map/image", 1, "PNG or PGM", "nowhere.png"},
    {"missing_key", "world/missing-key", "/arena/obstacles/0", 1, "\"center\"", "none"},
    {"model_unreadable", "world/model-unreadable", "/robots/0/model", 1,
     "a file with a robot model", "nowhere/robot.json: no file of that name"},
    {"no_free_place", "world/no-free-place", "/robots/0", 1, "robot r1", "none"},
    {"number_next_to_nothing", "world/out-of-range", "/robots/0/devices/laser/frequency", 1,
     "greater than 0", "1e-300 (a number below 1e-09 counts as 0)"},
    {"number_overflow", "json/number-overflow", "/simulation/duration", 1, "a number", "1e400"},
    {"obstacle_next_to_nothing", "world/out-of-range", "/arena/obstacles/0/size/0", 2,
     "from 0.001 to 10000 m", "1e-300 (the physics cannot build anything thinner"},
    {"obstacle_outside", "world/obstacle-outside", "/arena/obstacles/0", 1, "(3.00, 3.00)",
     "crate sticking out 0.05 m beyond the right side"},
    {"obstacle_too_thin", "world/out-of-range", "/arena/obstacles/0/size/1", 2,
     "from 0.001 to 10000 m", "1e-4 (the physics cannot build anything thinner"},
    // Its right end is at 9000 m, a millionth of which is 9 mm.
    {"obstacle_too_thin_far_away", "world/out-of-range", "/arena/obstacles/0/size/1", 2,
     "at least 0.009 m", "0.002 m of wire"},
    {"outline_crosses_itself", "world/bad-outline", "/arena/obstacles/0/outline", 2,
     "does not cross or touch itself", "sides 0 and 2 that meet in the outline of bow"},
    {"outline_in_a_line", "world/bad-outline", "/arena/obstacles/0/outline", 2,
     "does not cross or touch itself", "of rod"},
    {"outline_missing", "world/missing-key", "/arena/obstacles/0", 1, "\"outline\"", "none"},
    {"outline_not_a_number", "world/wrong-type", "/arena/obstacles/0/outline/1/1", 1, "a number",
     "the text \"0\""},
    {"outline_of_too_many_points", "world/bad-outline", "/arena/obstacles/0/outline", 1,
     "3 to 64 points", "65 points in the outline of gear"},
    {"outline_of_two_points", "world/bad-outline", "/arena/obstacles/0/outline", 1,
     "3 to 64 points", "2 points in the outline of line"},
    // Its right corner is at 2 + 1.2 m.
    {"outline_outside", "world/obstacle-outside", "/arena/obstacles/0", 1, "(3.00, 3.00)",
     "wedge sticking out 0.2 m beyond the right side (center is the place of the outline's"},
    {"outline_repeats_a_point", "world/bad-outline", "/arena/obstacles/0/outline", 2,
     "sides of at least 0.001 m", "0 m from point 4 to the next in the outline of ring (leave out"},
    {"outline_too_thin", "world/bad-outline", "/arena/obstacles/0/outline", 2,
     "at least 0.001 m wide", "m as the width of blade"},
    {"outline_touches_itself", "world/bad-outline", "/arena/obstacles/0/outline", 2,
     "does not cross or touch itself", "of pinch"},
    {"outline_without_area", "world/bad-outline", "/arena/obstacles/0/outline", 2,
     "at least 1 mm^2", "0.5 mm^2 in the outline of speck (points are in m)"},
    {"outline_without_shape", "world/conflicting-keys", "/arena/obstacles/0/outline", 1,
     "no \"outline\" with \"shape\": \"box\"", "both (\"outline\" belongs to"},
    {"out_of_range", "world/out-of-range", "/simulation/step", 1, "from 0.0001 to 0.1 s", "1e300"},
    {"out_of_range_integer", "world/out-of-range", "/simulation/seed", 1, "from 0 to", "-1"},
    {"out_of_range_negative", "world/out-of-range", "/arena/size/1", 1, "from 0.001", "-3"},
    {"reserved_shared_port", "world/reserved-port", "/robots_on_port", 1, "other than 4000",
     "4000"},
    {"reserved_port", "world/reserved-port", "/robots/0/port", 1, "other than 4000", "4000"},
    {"robot_inside_wall", "world/robot-overlaps-wall", "/robots/0/pose", 3, "clear of the map",
     "(3.60, 1.30)"},
    // The S1R extends 0.087 m to the left of its centre at x = 0.05: 0.037 m too far.
    {"robot_outside", "world/robot-outside", "/robots/0/pose", 1, "(3.42, 3.72)",
     "robot r1 at (0.05, 2.39) sticking out 0.037 m beyond the left side"},
    // d3 extends up to y = 0.64, the robot down to 0.7 - 0.081 = 0.619: an overlap of 0.021 m.
    {"robot_overlaps_extended_block", "world/robot-overlaps-obstacle", "/robots/0/pose", 3,
     "obstacle d3", "overlapping it by 0.021 m (move the robot, or leave d3 retracted)"},
    // s1 begins at x = 0.82, the robot extends to 0.75 + 0.087 = 0.837: an overlap of 0.017 m.
    {"robot_overlaps_obstacle", "world/robot-overlaps-obstacle", "/robots/0/pose", 1, "obstacle s1",
     "overlapping it by 0.017 m"},
    // Its front is at 1.45 + 0.087 m, the circle begins at 1.5 m.
    {"robot_overlaps_circle", "world/robot-overlaps-obstacle", "/robots/0/pose", 2,
     "obstacle drum, whose center is (2.00, 2.00)",
     "robot r1 at (1.45, 2.00) overlapping it by 0.037 m"},
    // r1 stands in the notch. The left arm ends at x = 1.5, r2 extends to 1.562 - 0.087 = 1.475.
    {"robot_overlaps_notch", "world/robot-overlaps-obstacle", "/robots/1/pose", 3, "obstacle notch",
     "robot r2 at (1.56, 2.50) overlapping it by 0.025 m"},
    {"robot_overlaps_separator", "world/robot-overlaps-obstacle", "/robots/0/pose", 1,
     "separator separator1", "robot r1 at (0.20,"},
    {"robot_overlaps_wall", "world/robot-overlaps-wall", "/robots/0/pose", 3, "clear of the map",
     "in a wall at (5.00, 1.50)"},
    // 0.1 m apart, each 0.174 m long: an overlap of 0.074 m.
    {"robots_overlap", "world/robots-overlap", "/robots/1/pose", 3, "robot r1 at (0.50, 0.40)",
     "robot r2 at (0.60, 0.40) overlapping it by 0.074 m"},
    {"root_not_object", "world/wrong-type", "", 1, "an object", "a list of 1"},
    {"separator_too_thin", "world/out-of-range", "/arena/dock_separators/0/size/0", 1,
     "from 0.001 to 10000 m", "0.0001"},
    {"separator_with_shape", "world/unknown-key", "/arena/dock_separators/0/shape", 1, "center",
     "\"shape\""},
    {"static_obstacle", "world/static-obstacle", "/arena/extended/0", 1, "a dynamic obstacle",
     "\"s1\""},
    {"static_obstacle_retracted", "world/static-obstacle", "/arena/obstacles/0/state", 1,
     "\"extended\"", "\"retracted\""},
    {"syntax_comma_missing", "json/syntax", "", 3, "','", "is a comma missing"},
    {"syntax_comma_too_many", "json/syntax", "", 3, "a key", "remove the comma"},
    {"syntax_end_of_file", "json/syntax", "", 3, "a value", "opened in line 2"},
    {"syntax_nan", "json/syntax", "", 1, "a value", "'NaN'"},
    {"syntax_single_quotes", "json/syntax", "", 1, "double quotes", "{'name': 'x'}"},
    {"syntax_text_unclosed", "json/syntax", "", 2, "a value", "the end of the line"},
    {"syntax_unclosed", "json/syntax", "", 4, "'}'", "the { of line 3 is still open"},
    {"too_deep", "json/too-deep",
     "/robots/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0", 1, "32 levels",
     "one more"},
    {"too_many", "world/too-many", "/robots", 1, "at most 1000", "1001"},
    {"too_many_errors", "world/unknown-key", "/x0", 2, "robots", "\"x0\""},
    {"trailing_garbage", "json/trailing-garbage", "", 2, "the end of the file",
     "{\"name\": \"y\"}"},
    {"unknown_device", "world/unknown-device", "/robots/0/devices/lazer", 1, "laser, motion",
     "did you mean \"laser\"?"},
    {"unknown_device_removed", "world/unknown-device", "/robots/0/devices/sonar", 1,
     "laser, motion", "\"sonar\""},
    {"unknown_key", "world/unknown-key", "/robots/0/pose/yaw", 3, "x, y or yaw_deg",
     "unknown key \"yaw\" (did you mean \"yaw_deg\"?)"},
    {"unknown_model", "world/unknown-model", "/robots/0/model", 1,
     "pioneer2dx, pioneer3dx, roomba, s1r_full, s1r_sonar or scorpion",
     "\"pioneer4dx\" (did you mean"},
    {"unknown_obstacle", "world/unknown-obstacle", "/arena/extended/0", 1, "d1, d2",
     "\"d33\" (did you mean \"d3\"?)"},
    // Robots that mirror real ones.
    {"real_bad_drive", "world/unknown-value", "/robots/0/real/drive", 1, "\"real\" or \"both\"",
     "\"ghost\""},
    {"real_bad_offset", "world/unknown-key", "/robots/0/real/offset/heading", 1, "x, y or yaw_deg",
     "\"heading\""},
    {"real_bad_on_lost", "world/unknown-value", "/robots/0/real/on_lost", 1,
     "\"continue\", \"end\" or \"reconnect\"", "\"stop\""},
    {"real_bad_watchdog", "world/out-of-range", "/robots/0/real/watchdog", 1, "from 0.05 to 600",
     "0"},
    {"real_bad_port", "world/out-of-range", "/robots/0/real/port", 1, "from 1 to 65535", "0"},
    {"real_bad_pose", "world/bad-real-pose", "/robots/0/real/pose", 1, "\"localize:INDEX\"",
     "\"laser:0\""},
    {"real_bad_server", "world/bad-real-server", "/robots/0/real/server", 1, "player://HOST[:PORT]",
     "\"robot.example.org:6665\""},
    {"real_without_server", "world/missing-key", "/robots/0/real", 1, "\"server\"", "none"},
    {"unknown_privacy", "world/unknown-value", "/simulation/privacy", 1, "\"none\" or \"own\"",
     "\"owm\" (did you mean \"own\"?)"},
    {"unknown_shape", "world/unknown-value", "/arena/obstacles/0/shape", 1,
     "\"box\", \"circle\" or \"polygon\"", "\"circel\" (did you mean \"circle\"?)"},
    {"unknown_value", "world/unknown-value", "/arena/preset", 1, "\"syrotek\"", "\"syrotec\""},
    {"unknown_realism", "world/unknown-value", "/simulation/realism", 1, "\"ideal\"", "\"true\""},
    {"unknown_view_mode", "world/unknown-value", "/canvas/view_mode", 1,
     "\"ground\", \"mini-map\" or \"full-screen\"", "\"minimap\" (did you mean \"mini-map\"?)"},
    {"wrong_type", "world/wrong-type", "/robots/0/pose/x", 1, "a number",
     "the text \"0.5\" (a number stands without quotes)"},
    {"wrong_type_boolean", "world/wrong-type", "/canvas/lock_view_mode", 1, "true or false", "1"},
    {"wrong_type_list", "world/wrong-type", "/robots", 1, "a list", "an object"},
    {"wrong_type_pair", "world/wrong-type", "/arena/size", 1, "two numbers", "a list of 1"},
};

const fs::path kFolder = fs::path(PLAYPEN_SOURCE_DIR) / "tests" / "invalid_worlds";

class InvalidWorld : public testing::TestWithParam<BadWorld> {};

TEST_P(InvalidWorld, RefusedWithIdPlaceAndReason) {
  const BadWorld& bad = GetParam();
  const std::string path = (kFolder / (std::string(bad.name) + ".json")).string();
  try {
    static_cast<void>(read_world(path, test::device_table()));
    FAIL() << path << " was accepted";
  } catch (const ConfigError& error) {
    // Each file contains one error; only too_many_errors contains more.
    const std::size_t count = std::string(bad.name) == "too_many_errors" ? 101 : 1;
    ASSERT_EQ(error.issues().size(), count) << error.what();
    const ConfigIssue& issue = error.issues().front();
    EXPECT_EQ(issue.id, bad.id);
    EXPECT_EQ(issue.pointer, bad.pointer);
    EXPECT_EQ(issue.line, bad.line);
    EXPECT_EQ(issue.file, path);
    EXPECT_THAT(issue.expected, testing::HasSubstr(bad.expected));
    EXPECT_THAT(issue.message(), testing::HasSubstr(bad.found));
    EXPECT_THAT(issue.message(), testing::HasSubstr("expected "));
    EXPECT_THAT(issue.message(), testing::HasSubstr(", found "));
    EXPECT_THAT(issue.message(), testing::StartsWith(path + ":"));
    EXPECT_THAT(issue.message(), testing::EndsWith("[" + std::string(bad.id) + "]"));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, InvalidWorld, testing::ValuesIn(kBadWorlds),
                         [](const testing::TestParamInfo<BadWorld>& bad) {
                           return std::string(bad.param.name);
                         });

TEST(InvalidWorlds, EachFileIsInTable) {
  std::set<std::string> in_table;
  for (const BadWorld& bad : kBadWorlds) in_table.insert(bad.name);
  std::set<std::string> in_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder)) {
    in_folder.insert(entry.path().stem().string());
  }
  EXPECT_EQ(in_table, in_folder);
}

}  // namespace
}  // namespace sim::io
