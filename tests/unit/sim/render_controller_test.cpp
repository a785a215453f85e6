// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Pictures of what the arena controller does: moving blocks, traps, countdowns, texts, scores,
// verdicts and events.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "sim/core/time.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

using Rgb = std::array<int, 3>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// An arena of 4 x 4 m. In a picture of 1000 px without a legend, the floor is 924 px wide and 38 px
// from each edge: 231 px per metre.
constexpr double kMarginPx = 38.0;
constexpr double kPixelsPerMetre = 231.0;
constexpr int kFooterPx = 74;

SceneSnapshot empty_scene() {
  SceneSnapshot scene;
  scene.world_name = "test";
  scene.arena.size = {4.0, 4.0};
  scene.canvas_description = {.width = 40, .height = 40, .cell_size_m = 0.1, .origin = {0.0, 0.0}};
  scene.time_s = 10.0;
  return scene;
}

RobotSnapshot robot_at(double x, double y) {
  RobotSnapshot robot;
  robot.name = "r1";
  robot.colour = {0x10, 0x20, 0xe0};
  robot.X_WB = {x, y, 0.0};
  robot.footprint = {{0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}, {-0.1, -0.1}};
  return robot;
}

// A dynamic block of 0.8 x 0.4 m in the middle, which has risen to a share of its height.
SceneSnapshot scene_with_block(BlockPhase phase, double share) {
  SceneSnapshot scene = empty_scene();
  ObstacleDescription block;
  block.name = "gate";
  block.type = ObstacleType::kDynamic;
  block.center = {2.0, 2.0};
  block.size = {0.8, 0.4};
  block.height_m = 0.2;
  block.state =
      phase == BlockPhase::kRetracted ? ObstacleState::kRetracted : ObstacleState::kExtended;
  if (phase != BlockPhase::kRetracted) block.present_height_m = share * block.height_m;
  scene.arena.obstacles = {block};
  scene.moving_blocks = {{0, phase, share * block.height_m}};
  return scene;
}

TrapMark box_trap(const std::string& name, const Vec2& low, const Vec2& high) {
  TrapMark trap;
  trap.name = name;
  trap.outline = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  return trap;
}

TrapMark circle_trap(const std::string& name, const Vec2& center, double radius_m) {
  TrapMark trap;
  trap.name = name;
  trap.center = center;
  trap.radius_m = radius_m;
  return trap;
}

ArenaEvent event_of(ArenaEventKind kind, const std::string& what, double time_s) {
  ArenaEvent event;
  event.kind = kind;
  event.what = what;
  event.time_ns = from_seconds(time_s);
  return event;
}

RenderOptions plain() {
  RenderOptions options;
  options.names = false;
  options.legend = false;
  return options;
}

RenderOptions without_controller(RenderOptions options) {
  options.traps = options.timers = options.texts = options.scores = false;
  return options;
}

Rgb pixel(const Image& image, int x, int y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

int column_of(double x) { return static_cast<int>(kMarginPx + kPixelsPerMetre * x); }
int row_of(double y) { return static_cast<int>(1000.0 - kMarginPx - kPixelsPerMetre * y); }

// Mean of a channel over a rectangle of the floor [m].
double mean(const Image& image, std::size_t channel, const Vec2& low, const Vec2& high) {
  double sum = 0.0;
  int count = 0;
  for (int y = row_of(high.y()); y < row_of(low.y()); ++y) {
    for (int x = column_of(low.x()); x < column_of(high.x()); ++x, ++count) {
      sum += pixel(image, x, y)[channel];
    }
  }
  return sum / count;
}

// The part of a picture in which it differs from another one: left, top, right and bottom.
std::array<int, 4> difference(const Image& a, const Image& b) {
  std::array<int, 4> part{a.width, a.height, 0, 0};
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (pixel(a, x, y) == pixel(b, x, y)) continue;
      part = {std::min(part[0], x), std::min(part[1], y), std::max(part[2], x + 1),
              std::max(part[3], y + 1)};
    }
  }
  return part;
}

int count_differences(const Image& a, const Image& b) {
  int count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) count += pixel(a, x, y) == pixel(b, x, y) ? 0 : 1;
  }
  return count;
}

TEST(RenderController, NoController_PictureUnchanged) {
  SceneSnapshot scene = empty_scene();
  scene.robots = {robot_at(1.0, 1.0)};
  for (const ViewMode mode : {ViewMode::kGround, ViewMode::kMiniMap, ViewMode::kFullScreen}) {
    scene.view_mode = mode;
    EXPECT_EQ(draw_view(scene).rgb, draw_view(scene, without_controller({})).rgb);
  }
}

// --- Blocks

TEST(RenderController, RisingBlock_FilledUpToItsHeight) {
  const Vec2 low(1.62, 1.82);  // within the block's edge line
  for (const double share : {0.1, 0.3, 0.8}) {
    const Image image = draw_scene(scene_with_block(BlockPhase::kRising, share), plain());
    // The gauge fills the block from its left end. The arrow is in the middle, at most 0.05 m high.
    const double end = 1.6 + 0.8 * share;
    EXPECT_LT(mean(image, 1, low, {end - 0.02, 1.93}), 85.0) << share;
    // Pale stripes fill the rest.
    EXPECT_GT(mean(image, 1, {end + 0.02, 1.82}, {2.38, 1.93}), 170.0) << share;
    EXPECT_GT(mean(image, 0, {end + 0.02, 1.82}, {2.38, 1.93}), 210.0) << share;
  }
}

TEST(RenderController, BlockShadow_GrowsWithHeight) {
  // Just below the block's lower edge.
  const auto shadow = [](double share) {
    const Image image = draw_scene(scene_with_block(BlockPhase::kSinking, share), plain());
    return mean(image, 1, {1.7, 1.8 - 4.0 / kPixelsPerMetre}, {2.3, 1.8 - 2.0 / kPixelsPerMetre});
  };
  EXPECT_GT(shadow(0.1), shadow(0.5) + 2.0);
  EXPECT_GT(shadow(0.5), shadow(1.0) + 2.0);
}

TEST(RenderController, Arrows_DistinguishRisingFromSinking) {
  const Image rising = draw_scene(scene_with_block(BlockPhase::kRising, 0.5), plain());
  const Image sinking = draw_scene(scene_with_block(BlockPhase::kSinking, 0.5), plain());
  EXPECT_GT(count_differences(rising, sinking), 50);
  // The arrows differ in the disc of 11 px around the block's centre only.
  const auto part = difference(rising, sinking);
  EXPECT_GE(part[0], column_of(2.0) - 12);
  EXPECT_LE(part[2], column_of(2.0) + 13);
  EXPECT_GE(part[1], row_of(2.0) - 12);
  EXPECT_LE(part[3], row_of(2.0) + 13);
}

TEST(RenderController, WaitingBlock_OrangeAroundRobot) {
  const Image waiting = draw_scene(scene_with_block(BlockPhase::kRetracted, 0.0), plain());
  // The corner of the dashed outline; the hourglass is at the lower right corner.
  const Rgb corner = pixel(waiting, column_of(1.6), row_of(1.8));
  EXPECT_GT(corner[0], 200);
  EXPECT_NEAR(corner[1], 0x7a, 40);
  EXPECT_LT(corner[2], 90);
  SceneSnapshot still = scene_with_block(BlockPhase::kRetracted, 0.0);
  still.moving_blocks.clear();
  const auto part = difference(waiting, draw_scene(still, plain()));
  EXPECT_GE(part[0], column_of(1.6) - 4);
  EXPECT_LE(part[2], column_of(2.4) + 14);
  // The middle stays light.
  EXPECT_GT(mean(waiting, 1, {1.8, 1.9}, {2.2, 2.1}), 225.0);
}

TEST(RenderController, StationaryBlock_Unchanged) {
  SceneSnapshot scene = scene_with_block(BlockPhase::kRising, 1.0);
  scene.arena.obstacles[0].present_height_m.reset();
  scene.moving_blocks.clear();
  const Image image = draw_scene(scene, plain());
  EXPECT_EQ(pixel(image, column_of(2.0), row_of(2.0)), (Rgb{0xd6, 0x45, 0x41}));
}

// --- Traps

TEST(RenderController, Traps_VioletOutlineInThreeStrengths) {
  SceneSnapshot scene = empty_scene();
  scene.robots = {robot_at(0.5, 0.5)};
  scene.traps = {box_trap("", {1.1, 2.1}, {1.4, 2.4}), box_trap("", {1.6, 2.1}, {1.9, 2.4}),
                 box_trap("", {2.1, 2.1}, {2.4, 2.4})};
  scene.traps[1].enabled = false;
  scene.traps[2].robots = {0};
  const Image image = draw_scene(scene, plain());
  // Corners lie within a dash.
  const Rgb on = pixel(image, column_of(1.1), row_of(2.1));
  const Rgb off = pixel(image, column_of(1.6), row_of(2.1));
  const Rgb occupied = pixel(image, column_of(2.1), row_of(2.1));
  EXPECT_GT(on[2], on[1] + 30);  // more blue than green
  EXPECT_LT(on[1], off[1] - 20);
  EXPECT_LE(occupied[1], on[1]);
  // The areas: none, faint and clear.
  const auto area = [&](double x) { return mean(image, 1, {x + 0.03, 2.13}, {x + 0.2, 2.3}); };
  EXPECT_GT(area(1.6), area(1.1) + 4.0);
  EXPECT_GT(area(1.1), area(2.1) + 10.0);
}

TEST(RenderController, CircleTrap_DrawnAroundObject) {
  SceneSnapshot scene = empty_scene();
  scene.traps = {circle_trap("", {2.25, 1.25}, 0.5)};
  const Image bare = draw_scene(scene, without_controller(plain()));
  const auto part = difference(draw_scene(scene, plain()), bare);
  EXPECT_NEAR(part[0], column_of(1.75), 2);
  EXPECT_NEAR(part[1], row_of(1.75), 2);
  EXPECT_NEAR(part[2], column_of(2.75), 3);
  EXPECT_NEAR(part[3], row_of(0.75), 3);
}

TEST(RenderController, Traps_ShowThroughBlocks) {
  SceneSnapshot scene = scene_with_block(BlockPhase::kRising, 1.0);
  scene.arena.obstacles[0].present_height_m.reset();
  scene.moving_blocks.clear();
  const Image bare = draw_scene(scene, plain());
  scene.traps = {box_trap("", {1.9, 1.9}, {2.1, 2.1})};
  const int changed = count_differences(draw_scene(scene, plain()), bare);
  EXPECT_GT(changed, 50);
  EXPECT_LT(changed, 400);  // only the line
}

TEST(RenderController, TrapNames_DoNotOverlap) {
  SceneSnapshot scene = empty_scene();
  scene.traps = {box_trap("", {1.1, 1.1}, {1.9, 1.9})};
  const Image unnamed = draw_scene(scene, plain());
  scene.traps[0].name = "plate";
  const auto part = difference(draw_scene(scene, plain()), unnamed);
  // The name is centred on the upper edge, and its capitals are 10.5 px high.
  EXPECT_NEAR(0.5 * (part[0] + part[2]), column_of(1.5), 4);
  EXPECT_NEAR(0.5 * (part[1] + part[3]), row_of(1.9), 5);
  EXPECT_LT(part[3] - part[1], 30);
  // A second trap at the same place has its name elsewhere, and a hundredth has none.
  scene.traps.push_back(scene.traps[0]);
  const Image two = draw_scene(scene, plain());
  const auto both = difference(two, unnamed);
  EXPECT_GT(both[3] - both[1], 100);
}

TEST(RenderController, Traps_StayInsideCroppedView) {
  SceneSnapshot scene = empty_scene();
  scene.traps = {box_trap("wide", {0.1, 0.1}, {3.9, 3.9}), circle_trap("near", {1.0, 1.0}, 0.4),
                 box_trap("elsewhere", {3.0, 3.0}, {3.5, 3.5})};
  scene.traps[0].robots = {0};
  scene.robots = {robot_at(1.2, 1.2)};
  scene.texts = {{{1.0, 1.4}, "a text at the edge of the view", {0, 0, 0}, {}},
                 {{3.2, 3.2}, "elsewhere", {0, 0, 0}, {}}};
  scene.timers = {{"timer", 3.0}};
  scene.scores = {5.0};
  scene.events = {event_of(ArenaEventKind::kTrap, "near", 9.5),
                  event_of(ArenaEventKind::kMessage, "timer", 9.5)};
  scene.events[1].text = "a message";
  RenderOptions options = plain();
  options.part = ScenePart{{0.8, 0.8}, {0.7, 0.7}, false};
  for (const bool names : {false, true}) {
    options.names = names;
    const Image bare = draw_scene(scene, without_controller(options));
    const auto part = difference(draw_scene(scene, options), bare);
    EXPECT_GE(part[0], 38);
    EXPECT_GE(part[1], 38);
    EXPECT_LE(part[2], 962);
    EXPECT_LE(part[3], 962);
  }
  options.part.reset();
  options.follow = "r1";
  const Image followed = draw_scene(scene, options);
  EXPECT_GT(count_differences(followed, draw_scene(scene, without_controller(options))), 100);
}

// --- Countdowns

TEST(RenderController, Countdowns_InFreeCorner) {
  SceneSnapshot scene = empty_scene();
  const Image bare = draw_scene(scene, plain());
  scene.timers = {{"off", {}}};
  EXPECT_EQ(draw_scene(scene, plain()).rgb, bare.rgb);
  scene.timers.push_back({"opening", 12.34});
  const Image image = draw_scene(scene, plain());
  auto part = difference(image, bare);
  EXPECT_GT(part[0], 700);  // the top right corner
  EXPECT_LT(part[3], 120);
  EXPECT_LE(part[2], 962);
  EXPECT_EQ(draw_scene(scene, without_controller(plain())).rgb, bare.rgb);
  // The panel keeps its place while the time runs.
  scene.timers[1].time_left_s = 2.3;
  EXPECT_EQ(difference(draw_scene(scene, plain()), bare), part);
  // A block in that corner moves the panel to another one, whatever the block's state.
  ObstacleDescription block;
  block.type = ObstacleType::kDynamic;
  block.center = {3.6, 3.7};
  block.size = {0.6, 0.3};
  for (const ObstacleState state : {ObstacleState::kExtended, ObstacleState::kRetracted}) {
    block.state = state;
    scene.arena.obstacles = {block};
    part = difference(draw_scene(scene, plain()), draw_scene(scene, without_controller(plain())));
    EXPECT_LT(part[2], 400);
  }
}

TEST(RenderController, Countdowns_AtMostSix) {
  SceneSnapshot scene = empty_scene();
  const Image bare = draw_scene(scene, plain());
  const auto height = [&](int timers) {
    scene.timers.clear();
    for (int i = 0; i < timers; ++i) scene.timers.push_back({"t", 5.0 + i});
    const auto part = difference(draw_scene(scene, plain()), bare);
    return part[3] - part[1];
  };
  EXPECT_GT(height(6), height(5));
  EXPECT_GT(height(7), height(6));  // a line tells how many are left out
  EXPECT_EQ(height(8), height(7));
  EXPECT_EQ(height(100), height(7));
}

TEST(RenderController, ActingTimer_Highlighted) {
  SceneSnapshot scene = empty_scene();
  scene.timers = {{"opening", 20.0}};
  const Image before = draw_scene(scene, plain());
  scene.events = {event_of(ArenaEventKind::kTimer, "opening", 9.9)};
  const Image after = draw_scene(scene, plain());
  const auto part = difference(after, before);
  EXPECT_GT(part[0], 700);
  EXPECT_GT(count_differences(after, before), 500);
  // One that acts for the last time is still shown for a second.
  scene.timers[0].time_left_s.reset();
  EXPECT_GT(count_differences(draw_scene(scene, plain()), draw_scene(empty_scene(), plain())), 500);
  scene.time_s = 11.5;
  EXPECT_EQ(draw_scene(scene, plain()).rgb, draw_scene(empty_scene(), plain()).rgb);
}

// --- Texts

TEST(RenderController, Texts_ReadableOnAnyBackground) {
  SceneSnapshot scene = empty_scene();
  scene.texts = {{{2.0, 2.0}, "open", {0x20, 0x20, 0x20}, {}},
                 {{2.0, 1.0}, "closed", {0xff, 0xff, 0xff}, 3.0}};
  const Image bare = draw_scene(scene, without_controller(plain()));
  EXPECT_EQ(bare.rgb, draw_scene(empty_scene(), plain()).rgb);
  const Image image = draw_scene(scene, plain());
  const auto part = difference(image, bare);
  EXPECT_NEAR(0.5 * (part[0] + part[2]), column_of(2.0), 3);
  // Beside the letters: a light backdrop of the dark text, a dark one of the light text.
  EXPECT_GT(pixel(image, column_of(2.0), row_of(2.0) - 14)[0], 240);
  EXPECT_LT(pixel(image, column_of(2.0), row_of(1.0) - 14)[0], 90);
}

TEST(RenderController, LongTexts_WrappedInsideView) {
  SceneSnapshot scene = empty_scene();
  std::string text;
  for (int i = 0; i < 20; ++i) text += "some words \xc5\xbe ";
  scene.texts = {{{3.99, 3.99}, text, {0x20, 0x20, 0x20}, {}}};
  const auto part =
      difference(draw_scene(scene, plain()), draw_scene(scene, without_controller(plain())));
  EXPECT_GT(part[0], 450);
  EXPECT_GE(part[1], 38);
  EXPECT_LE(part[2], 963);
  EXPECT_LT(part[3], 200);
}

TEST(RenderController, Messages_ShownForOneSecond) {
  SceneSnapshot scene = empty_scene();
  const Image bare = draw_scene(scene, plain());
  scene.events = {event_of(ArenaEventKind::kMessage, "timer", 9.8)};
  scene.events[0].text = "the gate opens";
  const auto part = difference(draw_scene(scene, plain()), bare);
  EXPECT_NEAR(0.5 * (part[0] + part[2]), 500, 3);
  EXPECT_GT(part[1], 900);  // at the lower edge
  EXPECT_LE(part[3], 962);
  EXPECT_EQ(draw_scene(scene, without_controller(plain())).rgb, bare.rgb);
  scene.events[0].time_ns = from_seconds(8.9);
  EXPECT_EQ(draw_scene(scene, plain()).rgb, bare.rgb);
  scene.events[0].time_ns = from_seconds(10.5);  // later than a restored state
  EXPECT_EQ(draw_scene(scene, plain()).rgb, bare.rgb);
}

// --- Scores and the verdict

TEST(RenderController, Scores_ShownFromFirstPoint) {
  SceneSnapshot scene = empty_scene();
  scene.robots = {robot_at(1.0, 1.0), robot_at(3.0, 3.0)};
  scene.robots[1].name = "r2";
  const Image without = draw_scene(scene);
  scene.scores = {0.0, 0.0};
  EXPECT_EQ(draw_scene(scene).rgb, without.rgb);
  scene.scores = {0.0, -2.5};
  const Image with = draw_scene(scene);
  EXPECT_GT(count_differences(with, without), 200);
  EXPECT_EQ(draw_scene(scene, without_controller({})).rgb, without.rgb);
  // They need no names.
  EXPECT_NE(draw_scene(scene, plain()).rgb, draw_scene(scene, without_controller(plain())).rgb);
}

TEST(RenderController, Verdict_InFooter) {
  for (const bool with_layer : {false, true}) {
    for (const bool passed : {false, true}) {
      SceneSnapshot scene = empty_scene();
      if (with_layer) {
        LayerInfo layer;
        layer.id = 1;
        layer.style.name = "path";
        scene.layers = {layer};
      }
      const Image before = draw_scene(scene);
      scene.verdict = Verdict{passed, "the runner is at the goal", from_seconds(9.0)};
      const Image after = draw_scene(scene);
      const auto part = difference(after, before);
      EXPECT_GE(part[1], after.height - kFooterPx);
      int coloured = 0;
      for (int y = after.height - kFooterPx; y < after.height; ++y) {
        for (int x = 0; x < after.width; ++x) {
          const Rgb rgb = pixel(after, x, y);
          coloured += rgb[passed ? 1 : 0] > rgb[passed ? 0 : 1] + 60 ? 1 : 0;
        }
      }
      EXPECT_GT(coloured, 500);
      // A reason that does not fit is shortened.
      scene.verdict->reason = std::string(200, 'w') + "\n";
      EXPECT_GT(count_differences(draw_scene(scene), after), 100);
    }
  }
}

// --- Events

TEST(RenderController, Events_FlashAtTheirPlaces) {
  SceneSnapshot scene = scene_with_block(BlockPhase::kRetracted, 0.0);
  scene.moving_blocks.clear();
  scene.robots = {robot_at(1.0, 1.0)};
  scene.traps = {circle_trap("near", {3.0, 3.0}, 0.3)};
  const Image before = draw_scene(scene, plain());
  const auto flash = [&](ArenaEventKind kind, const std::string& what) {
    scene.events = {event_of(kind, what, 9.7)};
    scene.events[0].who = "r1";
    scene.events[0].value = 5.0;
    const Image image = draw_scene(scene, plain());
    auto part = difference(image, before);
    if (part[2] == 0) part = {};
    scene.events[0].time_ns = from_seconds(8.9);
    EXPECT_EQ(draw_scene(scene, plain()).rgb, before.rgb) << what;
    return Vec2(0.5 * (part[0] + part[2]), 0.5 * (part[1] + part[3]));
  };
  const auto at = [](double x, double y) { return Vec2(column_of(x), row_of(y)); };
  constexpr double kTolerancePx = 3.0;
  EXPECT_LT((flash(ArenaEventKind::kTrap, "near") - at(3.0, 3.0)).norm(), kTolerancePx);
  EXPECT_LT((flash(ArenaEventKind::kRetracted, "gate") - at(2.0, 2.0)).norm(), kTolerancePx);
  EXPECT_LT((flash(ArenaEventKind::kRefused, "gate") - at(2.0, 2.0)).norm(), kTolerancePx);
  EXPECT_LT((flash(ArenaEventKind::kRefused, "r1") - at(1.0, 1.0)).norm(), kTolerancePx);
  EXPECT_LT((flash(ArenaEventKind::kRestart, "r1") - at(1.0, 1.0)).norm(), kTolerancePx);
  // Points rise to the right of the robot.
  EXPECT_LT((flash(ArenaEventKind::kScore, "near") - at(1.22, 1.05)).norm(), 12.0);
  for (const ArenaEventKind kind : {ArenaEventKind::kTrap, ArenaEventKind::kExtended,
                                    ArenaEventKind::kPlaced, ArenaEventKind::kWaiting}) {
    EXPECT_EQ(flash(kind, "unknown"), Vec2::Zero());
  }
}

// --- All together

// A scene with everything, which depends on a number.
SceneSnapshot full_scene(int round) {
  SceneSnapshot scene = scene_with_block(static_cast<BlockPhase>(1 + round % 3),
                                         round % 3 == 0 ? 0.0 : 0.1 * (round % 10));
  scene.robots = {robot_at(1.0 + 0.1 * round, 1.0), robot_at(3.0, 3.0 - 0.1 * round)};
  scene.time_s = 10.0 + 0.1 * round;
  scene.traps = {box_trap("plate", {0.5, 0.5}, {1.5, 1.5}),
                 circle_trap("near", scene.robots[1].X_WB.position(), 0.4)};
  scene.traps[0].enabled = round % 2 == 0;
  scene.traps[1].robots = {round % 2};
  scene.timers = {{"opening", 10.0 - 0.1 * round}};
  scene.texts = {{{1.0, 3.0}, "open", {0x2f, 0xae, 0x4e}, {}}};
  scene.scores = {static_cast<double>(round), 0.0};
  scene.events = {event_of(ArenaEventKind::kTrap, "plate", 10.0),
                  event_of(ArenaEventKind::kTimer, "opening", 10.5),
                  event_of(ArenaEventKind::kConfiguration, "open", 10.8)};
  if (round > 15) scene.verdict = Verdict{round % 2 == 0, "", 0};
  scene.view_mode = static_cast<ViewMode>((round / 4) % 3);
  return scene;
}

TEST(RenderController, CachedPicture_SameBytesAsFresh) {
  RenderOptions options;
  options.size_px = 300;
  SceneRenderer renderer(options);
  for (int round = 0; round < 24; ++round) {
    const SceneSnapshot scene = full_scene(round);
    ASSERT_TRUE(renderer.draw(scene).rgb == draw_view(scene, options).rgb) << "in round " << round;
  }
}

TEST(RenderController, FullScreen_TextsButNoTraps) {
  SceneSnapshot scene = full_scene(0);
  scene.view_mode = ViewMode::kFullScreen;
  scene.events.clear();
  RenderOptions options;
  options.traps = false;
  EXPECT_EQ(draw_view(scene).rgb, draw_view(scene, options).rgb);
  options.texts = false;
  EXPECT_NE(draw_view(scene).rgb, draw_view(scene, options).rgb);
}

TEST(RenderController, ExtremeContents_Drawn) {
  for (const int size_px : {64, 199, 300}) {
    SceneSnapshot scene = full_scene(3);
    scene.arena.obstacles[0].center = {1e7, kNan};
    scene.moving_blocks = {{0, BlockPhase::kRising, kNan},
                           {7, BlockPhase::kRising, 1.0},
                           {-1, BlockPhase::kSinking, 1}};
    ObstacleDescription flat;
    flat.name = std::string(1000, 'b');
    flat.size = {1e6, 1e-9};
    flat.height_m = 0.0;
    flat.present_height_m = 1e9;
    scene.arena.obstacles.push_back(flat);
    scene.moving_blocks.push_back({1, BlockPhase::kSinking, 1e9});
    scene.traps.push_back(circle_trap("a", {kNan, 1.0}, 1.0));
    scene.traps.push_back(circle_trap("b", {1.0, 1.0}, -1.0));
    scene.traps.push_back(circle_trap("c", {1.0, 1.0}, 1e6));
    scene.traps.push_back(circle_trap("d", {1.0, 1.0}, 1e300));
    scene.traps.push_back(box_trap(std::string(1000, 'e'), {-1e5, -1e5}, {1e5, 1e5}));
    scene.traps.push_back(box_trap("f", {1.0, 1.0}, {1.0, 1.0}));
    scene.traps.push_back(box_trap("g\n\xff", {kNan, 1.0}, {1.0, 1.0}));
    for (int i = 0; i < 70; ++i) scene.traps.push_back(scene.traps[0]);
    scene.timers = {{std::string(1000, 't'), 1e18}, {"\xff", -5.0}, {"", kNan}};
    scene.texts = {{{kNan, 1.0}, "x", {}, {}},
                   {{1.0, 1.0}, std::string(200, 'W') + "\n\xff", {}, -1.0},
                   {{1.0, 1.0}, " ", {}, {}}};
    scene.scores = {1e300, -1e-300, kNan};
    scene.events.assign(100, event_of(ArenaEventKind::kScore, "plate", 10.0));
    for (ArenaEvent& event : scene.events) event.who = "r1";
    scene.events.push_back(event_of(ArenaEventKind::kMessage, "", 10.2));
    scene.events.back().text = std::string(200, '\xc5');
    scene.verdict = Verdict{true, std::string(200, '\xff'), 0};
    RenderOptions options;
    options.size_px = size_px;
    EXPECT_EQ(draw_view(scene, options).rgb.size() % 3, 0U);
  }
}

}  // namespace
}  // namespace sim::render
