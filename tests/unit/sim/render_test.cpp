// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/render/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "canvas/image_file.h"
#include "canvas/png_codec.h"
#include "render/modules/module_file.h"

namespace sim::render {
namespace {

using ::testing::HasSubstr;

// A folder for one test, removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "playpen_render_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

template <typename Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

using Rgb = std::array<int, 3>;

Rgb pixel(const Image& image, int x, int y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

bool is_red(const Rgb& rgb) { return rgb[0] > 190 && rgb[1] < 110 && rgb[2] < 110; }
bool is_light(const Rgb& rgb) { return rgb[0] > 240 && rgb[1] > 240 && rgb[2] > 235; }

// An arena of 4 x 4 m. In a picture of 1000 px without a legend the margin is 38 px on each side.
// So the floor is 924 px wide: 231 px per metre, its left edge at x = 38, its lower edge at y =
// 962.
constexpr int kMarginPx = 38;
constexpr double kPixelsPerMetre = 231.0;

SceneSnapshot small_scene() {
  SceneSnapshot scene;
  scene.world_name = "test";
  scene.arena.size = {4.0, 4.0};
  scene.canvas_description = {.width = 40, .height = 40, .cell_size_m = 0.1, .origin = {0.0, 0.0}};
  return scene;
}

RobotSnapshot robot_at(const Pose& X_WB, Colour colour) {
  RobotSnapshot robot;
  robot.name = "r1";
  robot.colour = colour;
  robot.X_WB = X_WB;
  robot.footprint = {{0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}, {-0.1, -0.1}};
  return robot;
}

RenderOptions plain_options() {
  RenderOptions options;
  options.size_px = 1000;
  options.names = false;
  options.legend = false;
  return options;
}

Rgb pixel_at(const Image& image, const Vec2& p_W) {
  return pixel(image, static_cast<int>(kMarginPx + p_W.x() * kPixelsPerMetre),
               static_cast<int>(1000 - kMarginPx - p_W.y() * kPixelsPerMetre));
}

ObstacleDescription block(ObstacleType type, ObstacleState state, const Vec2& center) {
  ObstacleDescription obstacle;
  obstacle.type = type;
  obstacle.state = state;
  obstacle.center = center;
  obstacle.size = {0.4, 0.4};
  return obstacle;
}

TEST(DrawScene, LongerSide_HasRequestedSize) {
  for (const Vec2& size_m : {Vec2(3.42, 3.72), Vec2(20.0, 8.0), Vec2(20.0, 0.3), Vec2(0.3, 20.0)}) {
    for (const int size_px : {64, 333, 800, 2000}) {
      for (const bool legend : {false, true}) {
        SceneSnapshot scene = small_scene();
        scene.arena.size = size_m;
        RenderOptions options;
        options.size_px = size_px;
        options.legend = legend;
        const Image image = draw_scene(scene, options);
        EXPECT_EQ(std::max(image.width, image.height), size_px);
        EXPECT_GT(std::min(image.width, image.height), 0);
        EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(image.width * image.height * 3));
      }
    }
  }
}

TEST(DrawScene, InvalidSize_Refused) {
  for (const int size_px : {-1, 0, 63, 8193}) {
    RenderOptions options;
    options.size_px = size_px;
    EXPECT_THROW((void)draw_scene(small_scene(), options), std::invalid_argument) << size_px;
  }
}

TEST(DrawScene, CanvasOfOtherSize_Refused) {
  SceneSnapshot scene = small_scene();
  scene.canvas.assign(39 * 40 * 4, 0);
  EXPECT_THROW((void)draw_scene(scene), std::invalid_argument);
}

TEST(DrawScene, Floor_LightWithBrownBorder) {
  const Image image = draw_scene(small_scene(), plain_options());
  EXPECT_TRUE(is_light(pixel_at(image, {1.25, 2.75})));  // between the grid lines
  // The border is 0.035 m = 8 px thick and is outside of the floor.
  const Rgb border = pixel(image, kMarginPx - 4, 500);
  EXPECT_GT(border[0], border[1] + 20);
  EXPECT_GT(border[1], border[2] + 20);
}

TEST(DrawScene, ExtendedBlocks_FilledAndRetractedNot) {
  SceneSnapshot scene = small_scene();
  scene.arena.obstacles = {
      block(ObstacleType::kDynamic, ObstacleState::kExtended, {0.75, 3.25}),
      block(ObstacleType::kDynamic, ObstacleState::kRetracted, {2.75, 3.25}),
      block(ObstacleType::kStatic, ObstacleState::kExtended, {0.75, 0.75}),
  };
  const Image image = draw_scene(scene, plain_options());
  EXPECT_TRUE(is_red(pixel_at(image, {0.75, 3.25})));
  EXPECT_TRUE(is_light(pixel_at(image, {2.75, 3.25})));
  const Rgb grey = pixel_at(image, {0.75, 0.75});
  EXPECT_NEAR(grey[0], 205, 15);
  EXPECT_NEAR(grey[0], grey[2], 15);
  // The first dash of the retracted block's outline begins at its corner (2.55, 3.45).
  const Rgb corner = pixel_at(image, {2.55, 3.45});
  EXPECT_GT(corner[0], corner[1] + 30);
}

TEST(DrawScene, Robot_DrawnAtPoseInItsColour) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({1.2, 3.1, 0.7}, {10, 120, 200, 255})};
  const Image image = draw_scene(scene, plain_options());
  EXPECT_EQ(pixel_at(image, {1.2, 3.1}), (Rgb{10, 120, 200}));
  EXPECT_TRUE(is_light(pixel_at(image, {1.2, 0.9})));  // not mirrored: y points up
}

TEST(DrawScene, Arms_ReachBeyondRobot) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({2.0, 2.0, 0.5 * std::numbers::pi}, {10, 120, 200, 255})};
  scene.robots[0].arms = {{{0.0, 0.0}, {0.4, 0.0}, {0.4, 0.3}}};  // ahead, then to the left
  const Image image = draw_scene(scene, plain_options());
  const Rgb grey = {198, 205, 216};
  EXPECT_EQ(pixel_at(image, {2.0, 2.2}), grey);
  EXPECT_EQ(pixel_at(image, {1.85, 2.4}), grey);
  EXPECT_EQ(pixel_at(image, {2.0, 2.4}), (Rgb{44, 46, 51}));  // the joint between the links
  EXPECT_TRUE(is_red(pixel_at(image, {1.7, 2.4})));
  EXPECT_TRUE(is_light(pixel_at(image, {1.85, 2.3})));
}

TEST(DrawScene, Canvas_CoversFloorCellByCell) {
  SceneSnapshot scene = small_scene();
  Canvas canvas(scene.canvas_description);
  const Vec2 place(2.35, 3.15);  // the centre of a cell of 0.1 m, which is 23.1 px wide
  canvas.set_pixel(canvas.column(place.x()), canvas.row(place.y()), {0, 200, 0, 255});
  scene.canvas = canvas.data();
  const Image image = draw_scene(scene, plain_options());
  EXPECT_EQ(pixel_at(image, place), (Rgb{0, 200, 0}));
  EXPECT_EQ(pixel_at(image, place + Vec2(0.04, 0.04)), (Rgb{0, 200, 0}));
  EXPECT_TRUE(is_light(pixel_at(image, place + Vec2(0.07, 0.0))));
  EXPECT_TRUE(is_light(pixel_at(image, place - Vec2(0.0, 0.07))));

  RenderOptions options = plain_options();
  options.canvas = false;
  EXPECT_TRUE(is_light(pixel_at(draw_scene(scene, options), place)));
}

TEST(DrawScene, Walls_HaveHoles) {
  SceneSnapshot scene = small_scene();
  // A ring: outer square from 0.5 to 3.5 m, counter-clockwise; inner square from 1 to 3 m,
  // clockwise.
  scene.arena.walls = {{{{0.5, 0.5}, {3.5, 0.5}, {3.5, 3.5}, {0.5, 3.5}}},
                       {{{1.0, 1.0}, {1.0, 3.0}, {3.0, 3.0}, {3.0, 1.0}}}};
  const Image image = draw_scene(scene, plain_options());
  EXPECT_LT(pixel_at(image, {0.75, 2.0})[1], 100);
  EXPECT_TRUE(is_light(pixel_at(image, {1.75, 1.75})));
  EXPECT_TRUE(is_light(pixel_at(image, {0.25, 1.75})));
}

TEST(DrawScene, TrailAndFan_DrawnOnRequestOnFloor) {
  SceneSnapshot scene = small_scene();
  RobotSnapshot robot = robot_at({2.0, 2.0, 0.0}, {0, 0, 255, 255});
  robot.trail = {{1.0, 2.2}, {3.2, 2.2}, {9.0, 2.2}};
  robot.scan_origin = {2.0, 2.0};
  robot.scan_points = {{1.3, 1.2}, {2.0, 1.1}, {2.7, 1.2}};
  scene.robots = {robot};
  RenderOptions with = plain_options();
  RenderOptions without = plain_options();
  without.trails = without.scans = false;
  const Image drawn = draw_scene(scene, with);
  const Image bare = draw_scene(scene, without);
  const Vec2 on_trail(3.2, 2.2);
  const Vec2 in_fan(2.05, 1.4);
  EXPECT_LT(pixel_at(drawn, on_trail)[0], 200);
  EXPECT_TRUE(is_light(pixel_at(bare, on_trail)));
  EXPECT_LT(pixel_at(drawn, in_fan)[0], 235);  // translucent blue reduces red
  EXPECT_GT(pixel_at(drawn, in_fan)[0], 100);
  EXPECT_TRUE(is_light(pixel_at(bare, in_fan)));
  // Right of the floor and its border, in the direction of (9, 2.2).
  const Vec2 outside(4.1, 2.2);
  EXPECT_EQ(pixel_at(drawn, outside), pixel_at(bare, outside));
}

TEST(DrawScene, ConesRaysBumpersAndViews_Drawn) {
  SceneSnapshot scene = small_scene();
  RobotSnapshot robot = robot_at({2.0, 2.0, 0.0}, {0, 0, 255, 255});
  constexpr double kPi = 3.14159265358979;
  robot.cones = {{{2.05, 2.05, 0.5 * kPi}, 1.0, kPi / 6.0, true},  // up, an echo from 1 m
                 {{2.05, 2.05, -0.5 * kPi}, 1.0, kPi / 6.0, false},
                 {{2.05, 2.05, kPi}, 1.0, 0.0, true}};  // a ray to the left
  robot.bumpers = {{{{0.2, -0.1}, {0.2, 0.1}}, true}, {{{-0.2, -0.1}, {-0.2, 0.1}}, false}};
  robot.sights = {{{2.05, 2.05}, {3.17, 3.29}}};  // none of them on a grid line
  scene.robots = {robot};
  RenderOptions without = plain_options();
  without.scans = false;
  const Image drawn = draw_scene(scene, plain_options());
  const Image bare = draw_scene(scene, without);
  // Translucent blue reduces red: by a sixth within a cone with an echo, by less in the other.
  EXPECT_LT(pixel_at(drawn, {2.05, 2.65})[0], 225);
  EXPECT_GT(pixel_at(drawn, {2.05, 2.65})[0], 190);
  EXPECT_LT(pixel_at(drawn, {2.05, 1.45})[0], 245);
  EXPECT_GT(pixel_at(drawn, {2.05, 1.45})[0], pixel_at(drawn, {2.05, 2.65})[0]);
  EXPECT_TRUE(is_light(pixel_at(drawn, {2.75, 2.3})));
  EXPECT_LT(pixel_at(drawn, {2.05, 3.048})[0], 160);     // the echo's arc, 2 pixels wide
  EXPECT_LT(pixel_at(drawn, {1.05, 2.05})[0], 120);      // the dot at the ray's end
  EXPECT_LT(pixel_at(drawn, {2.61, 2.67})[0], 200);      // on the line of sight
  EXPECT_TRUE(is_light(pixel_at(drawn, {3.17, 3.29})));  // in the ring
  for (const Vec2& place : {Vec2(2.05, 2.65), Vec2(1.05, 2.05), Vec2(2.61, 2.67)}) {
    EXPECT_TRUE(is_light(pixel_at(bare, place)));
  }
  // Bumpers are part of the robot's drawing.
  for (const Image* image : {&drawn, &bare}) {
    EXPECT_TRUE(is_red(pixel_at(*image, {2.2, 2.0})));
    EXPECT_FALSE(is_red(pixel_at(*image, {1.8, 2.0})));
  }
  // Sensors without a valid pose are not drawn.
  scene.robots[0].cones = {{{std::nan(""), 2.0, 0.0}, 1.0, 1.0, true},
                           {{2.0, 2.0, 0.0}, 1e300, 1.0, true}};
  scene.robots[0].sights = {{{2.0, 2.0}, {std::nan(""), 1e300}}};
  EXPECT_TRUE(is_light(pixel_at(draw_scene(scene, plain_options()), {2.75, 2.3})));
}

TEST(DrawScene, ParticlesAndHypotheses_StrokesAndTwoSigmaEllipses) {
  SceneSnapshot scene = small_scene();
  RobotSnapshot robot = robot_at({2.0, 2.0, 0.0}, {0, 0, 255, 255});
  robot.particles = {{3.05, 3.05, 0.0}, {0.35, 3.55, 0.5 * std::numbers::pi}};
  PoseHypothesis hypothesis;
  hypothesis.mean = {1.05, 1.05, 0.0};
  hypothesis.covariance.variance = {0.04, 0.01, 0.01};  // deviations of 0.2 m and 0.1 m
  hypothesis.weight = 1.0;
  robot.hypotheses = {hypothesis};
  scene.robots = {robot};
  const Image drawn = draw_scene(scene, plain_options());
  const auto is_ink = [&](const Vec2& place) { return pixel_at(drawn, place)[0] < 200; };
  // Strokes of 7 px, 0.03 m, from the particle along its heading.
  EXPECT_TRUE(is_ink({3.05, 3.05}));
  EXPECT_TRUE(is_ink({3.07, 3.05}));
  EXPECT_FALSE(is_ink({3.03, 3.05}));
  EXPECT_TRUE(is_ink({0.35, 3.57}));
  EXPECT_FALSE(is_ink({0.35, 3.53}));
  // The ends of the ellipse's axes, 0.4 m and 0.2 m from its centre, and the heading's line.
  EXPECT_TRUE(is_ink({1.45, 1.05}));
  EXPECT_TRUE(is_ink({0.65, 1.05}));
  EXPECT_TRUE(is_ink({1.05, 1.25}));
  EXPECT_TRUE(is_ink({1.05, 0.85}));
  EXPECT_TRUE(is_ink({1.12, 1.05}));
  EXPECT_TRUE(is_light(pixel_at(drawn, {0.93, 1.05})));
  // Poses that are not numbers are left out.
  scene.robots[0].particles = {{std::nan(""), 1.0, 0.0}};
  scene.robots[0].hypotheses[0].covariance.variance[0] = std::nan("");
  EXPECT_TRUE(is_light(pixel_at(draw_scene(scene, plain_options()), {1.45, 1.05})));
}

// The trail's opacity is 0.8 at its newest end.
TEST(DrawScene, Trail_FaintWhereProgramDraws) {
  SceneSnapshot scene = small_scene();
  RobotSnapshot robot = robot_at({0.5, 0.5, 0.0}, {0, 0, 255, 255});
  for (int i = 0; i <= 20; ++i) robot.trail.push_back({1.05 + 0.1 * i, 2.25});
  scene.robots = {robot};
  const Vec2 newest(3.0, 2.25);
  Canvas canvas(scene.canvas_description);

  // White cells of a map do not count as a drawing of the path. Red decreases from 255 to a fifth,
  // 51, plus a little for the ink that is mixed into the robot's blue.
  canvas.clear({255, 255, 255, 255});
  scene.canvas = canvas.data();
  EXPECT_LT(pixel_at(draw_scene(scene, plain_options()), newest)[0], 70);

  // All cells of the path are red: a tenth of the opacity, 0.08, is left; blue becomes 0.08 x 255 =
  // 20.
  for (int x = 10; x <= 30; ++x) canvas.set_pixel(x, canvas.row(2.25), {220, 0, 0, 255});
  scene.canvas = canvas.data();
  const Rgb drawn = pixel_at(draw_scene(scene, plain_options()), newest);
  EXPECT_GT(drawn[0], 195);
  EXPECT_LT(drawn[2], 30);

  // If the canvas is not on the floor, the trail has its full opacity.
  scene.view_mode = ViewMode::kMiniMap;
  const Rgb apart = pixel_at(draw_view(scene, plain_options()), newest);
  EXPECT_LT(apart[0], 70);
  EXPECT_GT(apart[2], 180);
}

TEST(DrawScene, Fans_FainterOnFullCanvas) {
  SceneSnapshot scene = small_scene();
  RobotSnapshot robot = robot_at({2.0, 2.0, 0.0}, {0, 0, 255, 255});
  robot.scan_origin = {2.0, 2.0};
  robot.scan_points = {{3.2, 1.0}, {3.2, 3.0}};
  scene.robots = {robot};
  RenderOptions bare = plain_options();
  bare.scans = false;
  // The robot's colour has no red, so the loss of red gives the fan's opacity.
  const auto opacity = [&] {
    const Vec2 in_fan(2.75, 2.1);
    return 1.0 - static_cast<double>(pixel_at(draw_scene(scene, plain_options()), in_fan)[0]) /
                     pixel_at(draw_scene(scene, bare), in_fan)[0];
  };
  const double on_floor = opacity();
  EXPECT_GT(on_floor, 0.1);
  Canvas canvas(scene.canvas_description);
  canvas.clear({255, 255, 255, 255});
  scene.canvas = canvas.data();
  // 1 - 0.4 of it; two pixels, each rounded to 1/255.
  EXPECT_NEAR(opacity(), 0.6 * on_floor, 0.01);
}

TEST(DrawScene, StalledRobot_HasRedRing) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({2.25, 2.25, 0.0}, {0, 0, 255, 255})};
  scene.robots[0].stalled = true;
  const Image image = draw_scene(scene, plain_options());
  // Its centre line is 6 px outside of the footprint's circle, whose radius is 0.1 m * sqrt(2) *
  // 231 px/m = 32.7 px.
  const double radius_m = 0.1 * std::sqrt(2.0) + 6.0 / kPixelsPerMetre;
  EXPECT_TRUE(is_red(pixel_at(image, {2.25 + radius_m, 2.25})));
}

TEST(DrawScene, NamesAndLegend_ChangeNothingElse) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({2.0, 2.0, 0.0}, {0, 0, 255, 255})};
  RenderOptions options = plain_options();
  const Image bare = draw_scene(scene, options);
  options.names = true;
  EXPECT_NE(draw_scene(scene, options).rgb, bare.rgb);
  options.legend = true;
  const Image at_0 = draw_scene(scene, options);
  scene.time_s = 7.0;
  const Image at_7 = draw_scene(scene, options);
  ASSERT_EQ(at_0.rgb.size(), at_7.rgb.size());
  EXPECT_NE(at_0.rgb, at_7.rgb);
  // The footer is 74 px high; nothing above it depends on the time.
  const auto footer = static_cast<std::ptrdiff_t>(3 * at_0.width * (at_0.height - 74));
  EXPECT_TRUE(std::equal(at_0.rgb.begin(), at_0.rgb.begin() + footer, at_7.rgb.begin()));
}

TEST(DrawScene, ExtremeContents_Drawn) {
  SceneSnapshot scene = small_scene();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RobotSnapshot lost = robot_at({kNan, 1.0, 0.0}, {1, 2, 3, 255});
  lost.scan_points = {{kNan, kNan}, {1e300, -1e300}};
  lost.trail = {{kNan, 0.0}, {1.0, 1.0}, {-1e9, 1e9}};
  RobotSnapshot far = robot_at({1e6, -1e6, 0.0}, {1, 2, 3, 255});
  far.name = std::string(1000, 'x');
  scene.robots = {lost, far};
  scene.world_name = std::string(5000, 'W') + "\xff\n";
  scene.time_s = 1e12;
  EXPECT_EQ(draw_scene(scene).rgb.size() % 3, 0U);
}

TEST(DrawScene, SameScene_SameBytes) {
  const TemporaryFolder folder;
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({2.0, 2.0, 0.4}, {0, 90, 255, 255})};
  scene.robots[0].scan_points = {{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}};
  scene.arena.docks.resize(2);
  for (const char* name : {"a.png", "b.png"}) write_png(draw_scene(scene), folder.file(name));
  const std::string bytes = file_bytes(folder.file("a.png"));
  EXPECT_GT(bytes.size(), 1000U);
  EXPECT_TRUE(bytes == file_bytes(folder.file("b.png")));
}

LayerInfo layer(LayerId id, LayerKind kind, const std::string& name, Colour colour) {
  LayerInfo info;
  info.id = id;
  info.kind = kind;
  info.style.name = name;
  info.style.colour = colour;
  return info;
}

std::vector<LayerInfo> base_and(std::vector<LayerInfo> others) {
  others.insert(others.begin(), layer(kBaseLayer, LayerKind::kColour, "canvas", {}));
  return others;
}

// Pseudo-random numbers that are equal in every run.
class Sequence {
 public:
  // In [0, end).
  int below(int end) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(end));
  }
  double in(double low, double high) { return low + (high - low) * below(1000) / 999.0; }

 private:
  std::uint64_t state_ = 5;
};

TEST(SceneRenderer, CachedPicture_SameBytesAsFresh) {
  Sequence sequence;
  RenderOptions options;
  options.size_px = 300;
  SceneRenderer renderer(options);
  SceneSnapshot scene = small_scene();
  scene.arena.docks.resize(1);
  scene.arena.docks[0].pose = {0.4, 0.4, 0.3};
  scene.arena.obstacles = {
      block(ObstacleType::kDynamic, ObstacleState::kExtended, {0.75, 3.25}),
      block(ObstacleType::kDynamic, ObstacleState::kRetracted, {2.75, 3.25}),
      block(ObstacleType::kStatic, ObstacleState::kExtended, {2.0, 0.75}),
  };
  scene.robots = {robot_at({2.0, 2.0, 0.4}, {0, 90, 255, 255}),
                  robot_at({1.0, 2.0, 0.4}, {255, 90, 0, 255})};
  Canvas canvas(scene.canvas_description);
  scene.canvas = canvas.data();
  for (int round = 0; round < 120; ++round) {
    for (int i = 0; i < 20; ++i) {
      const auto byte = [&] { return static_cast<std::uint8_t>(sequence.below(256)); };
      canvas.set_pixel(sequence.below(canvas.width()), sequence.below(canvas.height()),
                       {byte(), byte(), byte(), byte()});
    }
    scene.canvas = round % 10 == 9 ? std::vector<std::uint8_t>{} : canvas.data();
    for (RobotSnapshot& robot : scene.robots) {
      robot.X_WB = {sequence.in(0.5, 3.5), sequence.in(0.5, 3.5), sequence.in(-3.0, 3.0)};
      robot.trail.push_back(robot.X_WB.position());
      robot.scan_origin = robot.X_WB.position();
      robot.scan_points = {{sequence.in(0.0, 4.0), 0.0}, {4.0, sequence.in(0.0, 4.0)}};
      robot.arms = {{{0.0, 0.0}, {sequence.in(-0.4, 0.4), sequence.in(-0.4, 0.4)}}};
      robot.stalled = sequence.below(5) == 0;
      robot.marked = sequence.below(5) == 0;
    }
    scene.time_s += 0.1;
    scene.view_mode = static_cast<ViewMode>(sequence.below(3));
    if (round % 17 == 16) {  // a block moves
      ObstacleState& state = scene.arena.obstacles[1].state;
      state =
          state == ObstacleState::kRetracted ? ObstacleState::kExtended : ObstacleState::kRetracted;
    }
    if (round % 23 == 22) {  // the canvas gets another size
      scene.canvas_description.width = 20 + sequence.below(60);
      scene.canvas_description.height = 20 + sequence.below(60);
      canvas = Canvas(scene.canvas_description);
      scene.canvas.clear();
    }
    if (round == 40) {
      scene.layers = base_and({layer(1, LayerKind::kGrey, "occupancy", {}),
                               layer(2, LayerKind::kBinary, "path", {255, 140, 0, 255})});
    }
    const Image& kept = renderer.draw(scene);
    const Image fresh = draw_view(scene, options);
    ASSERT_EQ(kept.width, fresh.width);
    ASSERT_EQ(kept.height, fresh.height);
    ASSERT_TRUE(kept.rgb == fresh.rgb) << "in round " << round;
  }
}

TEST(SceneRenderer, InvalidSizeAndCanvasOfOtherSize_Refused) {
  RenderOptions options;
  options.size_px = 63;
  EXPECT_THROW(SceneRenderer{options}, std::invalid_argument);
  SceneSnapshot scene = small_scene();
  scene.canvas.assign(39 * 40 * 4, 0);
  SceneRenderer renderer;
  EXPECT_THROW((void)renderer.draw(scene), std::invalid_argument);
}

TEST(DrawView, AllModes_SameSize) {
  for (const Vec2& size_m : {Vec2(3.42, 3.72), Vec2(20.0, 0.3), Vec2(0.3, 20.0)}) {
    for (const int size_px : {64, 300}) {
      SceneSnapshot scene = small_scene();
      scene.arena.size = size_m;
      scene.canvas.assign(40 * 40 * 4, 200);
      RenderOptions options;
      options.size_px = size_px;
      const Image ground = draw_scene(scene, options);
      for (const ViewMode mode : {ViewMode::kGround, ViewMode::kMiniMap, ViewMode::kFullScreen}) {
        scene.view_mode = mode;
        const Image image = draw_view(scene, options);
        EXPECT_EQ(image.width, ground.width);
        EXPECT_EQ(image.height, ground.height);
      }
    }
  }
}

TEST(DrawView, FullScreen_CellsAreSquaresOfTheirColour) {
  SceneSnapshot scene = small_scene();
  scene.view_mode = ViewMode::kFullScreen;
  Sequence sequence;
  const int cells = 40;
  for (int i = 0; i < cells * cells; ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      scene.canvas.push_back(static_cast<std::uint8_t>(sequence.below(256)));
    }
    scene.canvas.push_back(255);
  }
  const Image image = draw_view(scene, plain_options());
  // A picture of 1000 x 1000 with a frame of 1 px: 998 / 40 = 24.95, so 24 px per cell, 960 px in
  // total. The canvas begins 20 px from the left, and (998 - 960) / 2 + 1 = 20 from the top.
  for (int y = 0; y < 960; ++y) {
    for (int x = 0; x < 960; ++x) {
      const auto at = static_cast<std::size_t>(4 * (y / 24 * cells + x / 24));
      ASSERT_EQ(pixel(image, 20 + x, 20 + y),
                (Rgb{scene.canvas[at], scene.canvas[at + 1], scene.canvas[at + 2]}))
          << x << ", " << y;
    }
  }
}

TEST(DrawView, FullScreen_RobotsAtScaleOfCanvas) {
  SceneSnapshot scene = small_scene();
  scene.view_mode = ViewMode::kFullScreen;
  scene.canvas_description.origin = {1.0, 0.5};
  for (int i = 0; i < 40 * 40; ++i) scene.canvas.insert(scene.canvas.end(), {0, 160, 0, 255});
  const Image empty = draw_view(scene, plain_options());
  constexpr double kUp_rad = 1.5707963267948966;
  scene.robots = {robot_at({2.0, 2.0, kUp_rad}, {0, 0, 255, 255}),
                  robot_at({1.0, 3.5, kUp_rad}, {255, 0, 0, 255})};
  const Image image = draw_view(scene, plain_options());
  // As above, 24 px per cell of 0.1 m, and the canvas is in columns and rows 20 to 979. So the
  // first robot is at (20 + 1.0 * 240, 980 - 1.5 * 240) = (260, 620) and extends 24 px to each
  // side. Its nose is an arrow head whose tip is 0.82 of that ahead: 20 px above the centre.
  EXPECT_EQ(pixel(image, 260, 620), (Rgb{0, 0, 255}));
  EXPECT_EQ(pixel(image, 260, 640), (Rgb{0, 0, 255}));
  EXPECT_TRUE(is_light(pixel(image, 260, 601)));
  for (const auto& [x, y] : {std::pair{260, 590}, {230, 620}, {290, 620}, {260, 650}}) {
    EXPECT_EQ(pixel(image, x, y), (Rgb{0, 160, 0})) << x << ", " << y;
  }
  // The second robot is on the left edge, at (20, 980 - 3.0 * 240 = 260), and is cut off there.
  EXPECT_EQ(pixel(image, 30, 260), (Rgb{255, 0, 0}));
  for (int x = 0; x < 20; ++x) EXPECT_EQ(pixel(image, x, 260), pixel(empty, x, 260)) << x;
}

TEST(DrawView, FullScreen_RobotsBeyondCanvasNotDrawn) {
  SceneSnapshot scene = small_scene();
  scene.view_mode = ViewMode::kFullScreen;
  scene.canvas_description.width = 20;  // up to x = 2 m
  RenderOptions options;
  const Image empty = draw_view(scene, options);
  scene.robots = {robot_at({3.0, 2.0, 0.0}, {0, 0, 255, 255})};
  scene.robots[0].says = "hello";
  EXPECT_TRUE(draw_view(scene, options).rgb == empty.rgb);
  scene.robots[0].X_WB.x_m = 1.0;
  const Image with = draw_view(scene, options);
  scene.robots[0].says.clear();
  const Image silent = draw_view(scene, options);
  options.names = false;
  const Image nameless = draw_view(scene, options);
  EXPECT_FALSE(with.rgb == silent.rgb);
  EXPECT_FALSE(silent.rgb == nameless.rgb);
  EXPECT_FALSE(nameless.rgb == empty.rgb);
}

TEST(DrawView, FullScreen_LargeCanvasShrunkByWholeNumber) {
  SceneSnapshot scene = small_scene();
  scene.view_mode = ViewMode::kFullScreen;
  scene.canvas_description.width = 3000;
  scene.canvas_description.height = 3000;
  scene.canvas_description.cell_size_m = 4.0 / 3000;
  // Black and white columns alternate. 998 / 3000 = 1 / 3.006, so 4 cells per pixel, 750 px in
  // total: each pixel has two black and two white cells.
  for (int i = 0; i < 3000 * 3000; ++i) {
    const std::uint8_t shade = i % 2 == 0 ? 0 : 255;
    scene.canvas.insert(scene.canvas.end(), {shade, shade, shade, 255});
  }
  const Image image = draw_view(scene, plain_options());
  for (const int at : {126, 500, 873}) EXPECT_EQ(pixel(image, at, at)[1], 128) << at;
  EXPECT_NE(pixel(image, 120, 500)[1], 128);
}

TEST(DrawView, MiniMap_CanvasInFreeCorner) {
  SceneSnapshot scene = small_scene();
  scene.view_mode = ViewMode::kMiniMap;
  for (int i = 0; i < 40 * 40; ++i) {
    scene.canvas.insert(scene.canvas.end(), {0, 160, 0, 255});
  }
  const auto is_green = [](const Rgb& rgb) { return rgb == Rgb{0, 160, 0}; };
  // The corners in the order of trial: top right, top left, bottom right, bottom left. The first
  // free one counts. The map extends from 0.06 m to more than 1.2 m from the floor's sides.
  const std::vector<Vec2> corners = {{3.3, 3.3}, {0.7, 3.3}, {3.3, 0.7}, {0.7, 0.7}};
  for (std::size_t blocked = 0; blocked < corners.size(); ++blocked) {
    const Image image = draw_view(scene, plain_options());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      EXPECT_EQ(is_green(pixel_at(image, corners[i])), i == blocked) << i << ", " << blocked;
    }
    EXPECT_TRUE(is_light(pixel_at(image, {2.25, 2.25})));  // the canvas is not on the floor
    scene.arena.obstacles.push_back(
        block(ObstacleType::kStatic, ObstacleState::kExtended, corners[blocked]));
  }
}

TEST(DrawView, MiniMap_ShowsRobots) {
  SceneSnapshot scene = small_scene();
  scene.view_mode = ViewMode::kMiniMap;
  scene.canvas.assign(40 * 40 * 4, 255);
  scene.robots = {robot_at({1.0, 3.0, 0.0}, {0, 0, 255, 255})};
  const Image image = draw_view(scene, plain_options());
  // The floor is 924 px wide. The mini-map may take 332.64 px of it, a little more than a third: 40
  // cells of 8 px, 320 px. It ends 14 px from the right and upper sides of the floor: at x = 948,
  // and it begins at y = 52. The robot is 10 cells from its left side and 10 from its upper side.
  EXPECT_EQ(pixel(image, 948 - 320 + 80, 52 + 80), (Rgb{0, 0, 255}));
}

// The rows in which two pictures differ: the first and one past the last.
std::pair<int, int> rows_that_differ(const Image& a, const Image& b) {
  std::pair<int, int> rows{a.height, 0};
  for (int y = 0; y < a.height; ++y) {
    const auto begin = static_cast<std::ptrdiff_t>(3 * a.width) * y;
    if (!std::equal(a.rgb.begin() + begin, a.rgb.begin() + begin + 3 * a.width,
                    b.rgb.begin() + begin)) {
      rows.first = std::min(rows.first, y);
      rows.second = y + 1;
    }
  }
  return rows;
}

// Whether a colour occurs in the footer, which is 66 px high in a full-screen picture of 1000 px.
bool footer_has(const Image& image, const Rgb& colour) {
  for (int y = image.height - 64; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (pixel(image, x, y) == colour) return true;
    }
  }
  return false;
}

TEST(DrawView, Legend_NamesVisibleLayersExceptBase) {
  SceneSnapshot scene = small_scene();
  RenderOptions options;  // of 1000 px, with a footer of 74 px
  for (const ViewMode mode : {ViewMode::kGround, ViewMode::kMiniMap, ViewMode::kFullScreen}) {
    scene.view_mode = mode;
    scene.layers.clear();
    const Image without = draw_view(scene, options);
    scene.layers = base_and({});
    EXPECT_TRUE(draw_view(scene, options).rgb == without.rgb);
    scene.layers = base_and({layer(1, LayerKind::kGrey, "occupancy", {}),
                             layer(2, LayerKind::kBinary, "path", {255, 140, 0, 255})});
    const Image with = draw_view(scene, options);
    EXPECT_GE(rows_that_differ(with, without).first, with.height - 74);
    for (const Rgb& colour :
         {Rgb{255, 255, 255}, Rgb{128, 128, 128}, Rgb{0, 0, 0}, Rgb{255, 140, 0}}) {
      EXPECT_TRUE(footer_has(with, colour)) << colour[0];
      EXPECT_FALSE(footer_has(without, colour)) << colour[0];
    }
    scene.layers[2].style.visible = false;
    EXPECT_FALSE(footer_has(draw_view(scene, options), {255, 140, 0}));
    // Half transparent over white: (255 + 255) / 2, (255 + 140) / 2, (255 + 0) / 2.
    scene.layers[2].style.visible = true;
    scene.layers[2].style.transparency = 0.5;
    EXPECT_TRUE(footer_has(draw_view(scene, options), {255, 198, 128}));
  }
}

TEST(DrawView, Legend_LeavesOutTopLayersWithoutRoom) {
  SceneSnapshot scene = small_scene();
  RenderOptions options;
  std::vector<LayerInfo> many;
  for (int i = 0; i < 40; ++i) {
    many.push_back(layer(i + 1, LayerKind::kBinary, "a layer of a long name",
                         {static_cast<std::uint8_t>(i), 200, 10, 255}));
  }
  scene.layers = base_and(many);
  const Image image = draw_view(scene, options);
  EXPECT_TRUE(footer_has(image, {0, 200, 10}));
  EXPECT_FALSE(footer_has(image, {39, 200, 10}));
  scene.layers = base_and({layer(1, LayerKind::kGrey, std::string(5000, 'W'), {})});
  options.size_px = 200;
  EXPECT_EQ(std::max(draw_view(scene, options).width, draw_view(scene, options).height), 200);
}

TEST(DrawScene, MarkedRobot_BetweenDarkCorners) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({2.25, 2.25, 0.0}, {0, 0, 255, 255})};
  // A square around the robot, 13 pixels larger than the circle of its footprint (0.1 m each way).
  const double reach_m = 0.1 * std::sqrt(2.0) + 13.0 / kPixelsPerMetre;
  for (const bool marked : {true, false}) {
    scene.robots[0].marked = marked;
    const Image image = draw_scene(scene, plain_options());
    for (const Vec2& side : {Vec2(1, 1), Vec2(1, -1), Vec2(-1, -1), Vec2(-1, 1)}) {
      const Vec2 corner = Vec2(2.25, 2.25) + reach_m * side;
      EXPECT_EQ(pixel_at(image, {corner.x(), corner.y()})[0] < 110, marked);
    }
  }
}

TEST(DrawCanvas, CellsScaledAndTransparentWhite) {
  const CanvasDescription description{
      .width = 2, .height = 2, .cell_size_m = 0.02, .origin = {0.0, 0.0}};
  Canvas canvas(description);
  canvas.set_pixel(0, 0, {255, 0, 0, 255});
  canvas.set_pixel(1, 1, {0, 0, 0, 51});  // black with alpha 1/5 over white: 204
  const Image image = draw_canvas(description, canvas.data(), 3);
  ASSERT_EQ(image.width, 6);
  ASSERT_EQ(image.height, 6);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool left = x < 3;
      const bool top = y < 3;
      const Rgb expected = left && top     ? Rgb{255, 0, 0}
                           : !left && !top ? Rgb{204, 204, 204}
                                           : Rgb{255, 255, 255};
      EXPECT_EQ(pixel(image, x, y), expected) << x << ", " << y;
    }
  }
}

TEST(DrawCanvas, InvalidScaleOrTooFewBytes_Refused) {
  const CanvasDescription description{
      .width = 2, .height = 2, .cell_size_m = 0.02, .origin = {0.0, 0.0}};
  const std::vector<std::uint8_t> cells(16);
  EXPECT_THROW((void)draw_canvas(description, cells, 0), std::invalid_argument);
  EXPECT_THROW((void)draw_canvas(description, cells, 20000), std::invalid_argument);
  EXPECT_THROW((void)draw_canvas(description, {}, 1), std::invalid_argument);
}

Image gradient(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.rgb.push_back(static_cast<std::uint8_t>(x * 4));
      image.rgb.push_back(static_cast<std::uint8_t>(x * 4));
      image.rgb.push_back(static_cast<std::uint8_t>(x * 4));
    }
  }
  return image;
}

TEST(WritePng, RoundTrips) {
  const TemporaryFolder folder;
  const std::string path = folder.file("grey.png");
  write_png(gradient(40, 3), path);
  const GreyImage read = load_grey_image(path);
  ASSERT_EQ(read.width, 40);
  ASSERT_EQ(read.height, 3);
  EXPECT_EQ(read.pixels[0], 0);
  EXPECT_EQ(read.pixels[39], 156);
}

TEST(WritePng, RedAndBlue_NotSwapped) {
  const TemporaryFolder folder;
  const std::string path = folder.file("red.png");
  write_png({1, 1, {200, 0, 100}}, path);
  // Luma 0.299 * 200 + 0.114 * 100 = 71.2; with exchanged channels it would be 52.7.
  EXPECT_EQ(load_grey_image(path).pixels, (std::vector<std::uint8_t>{71}));
}

// Pictures with a palette have indices of 1, 2, 4 or 8 bits; others have none.
TEST(WritePng, AnyNumberOfColours_SamePixels) {
  const TemporaryFolder folder;
  const std::string path = folder.file("colours.png");
  for (const int colours : {1, 2, 3, 4, 5, 16, 17, 255, 256, 257, 1000}) {
    SCOPED_TRACE(colours);
    Image image{37, 41, {}};  // a row is no whole number of bytes
    for (int i = 0; i < image.width * image.height; ++i) {
      const int colour = i / image.width % 3 == 0 ? 0 : i % colours;  // some rows are equal
      image.rgb.push_back(static_cast<std::uint8_t>(colour % 256));
      image.rgb.push_back(static_cast<std::uint8_t>(255 - colour % 256));
      image.rgb.push_back(static_cast<std::uint8_t>(colour / 256));
    }
    write_png(image, path);
    const std::string file = file_bytes(path);
    std::vector<std::uint8_t> read;
    const bool whole =
        decode_png({file.begin(), file.end()}, image.width, image.height, [&](const PngRow& row) {
          ASSERT_EQ(row.channels, 3);
          read.insert(read.end(), row.samples, row.samples + 3 * row.width);
        });
    ASSERT_TRUE(whole);
    EXPECT_TRUE(read == image.rgb);
  }
}

TEST(WritePng, Error_NamesFileAndReason) {
  const TemporaryFolder folder;
  const std::string path = folder.file("missing/scene.png");
  const std::string error = error_of([&] { write_png(gradient(4, 4), path); });
  EXPECT_THAT(error, HasSubstr(path));
  EXPECT_THAT(error, HasSubstr("No such file or directory"));
  EXPECT_NE(error_of([&] { write_png(Image{}, folder.file("empty.png")); }), "");
}

TEST(LoadGreyImage, PlainAndRawPgm_Read) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.pgm");
  std::ofstream(path) << "P2 # plain\n# a comment\n3 1\n15\n0 5 15\n";
  // With a maximum of 15: 5/15 of 255 = 85.
  EXPECT_EQ(load_grey_image(path).pixels, (std::vector<std::uint8_t>{0, 85, 255}));
  std::ofstream(path, std::ios::binary) << "P5 2 2 255\n"
                                        << "\x01\x20\x0a\xfe";
  EXPECT_EQ(load_grey_image(path).pixels, (std::vector<std::uint8_t>{1, 32, 10, 254}));
}

TEST(LoadGreyImage, InvalidFile_Explained) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.pgm");
  const auto error_with = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return error_of([&] { (void)load_grey_image(path); });
  };
  EXPECT_THAT(error_of([&] { (void)load_grey_image(folder.file("none.png")); }),
              HasSubstr("none.png: cannot read the picture: no file of that name"));
  EXPECT_THAT(error_of([&] { (void)load_grey_image(folder.file("")); }), HasSubstr("a folder"));
  EXPECT_THAT(error_with(""), HasSubstr("empty"));
  EXPECT_THAT(error_with("GIF89a"), HasSubstr("not a PNG or PGM picture"));
  EXPECT_THAT(error_with("P5 20000 2 255\n"), HasSubstr("20000 x 2 pixels, at most 16384"));
  EXPECT_THAT(error_with("P5 4 4 255\nabc"), HasSubstr("cut short"));
  EXPECT_THAT(error_with("P2 2 2 255\n1 2 3"), HasSubstr("cut short"));
  EXPECT_THAT(error_with("P5 0 4 255\n"), HasSubstr("no pixels"));
  EXPECT_THAT(error_with("P5 x 4 255\n"), HasSubstr("expected a number as width"));
  write_png(gradient(40, 40), path);
  EXPECT_THAT(error_with(file_bytes(path).substr(0, 60)), HasSubstr("PNG is damaged"));
  EXPECT_THAT(error_with(file_bytes(path).substr(0, 20)), HasSubstr("cut short"));
}

// Number and size of the frames that a reader finds in a film.
struct FilmContents {
  int frames = 0;
  int width = 0;
  int height = 0;
};

FilmContents read_film(const std::string& path) {
  cv::VideoCapture film(path);
  FilmContents contents;
  cv::Mat frame;
  while (film.read(frame)) {
    ++contents.frames;
    contents.width = frame.cols;
    contents.height = frame.rows;
  }
  return contents;
}

TEST(CanvasPngWriter, ChangedCellsScaleAndShape_SameFileAsOfWholePicture) {
  const TemporaryFolder folder;
  CanvasPngWriter writer;
  const auto check = [&](int width, int height, const std::vector<std::uint8_t>& rgba, int scale) {
    const CanvasDescription canvas{.width = width, .height = height, .cell_size_m = 0.1};
    writer.write(canvas, rgba, scale, folder.file("a.png"));
    write_png(draw_canvas(canvas, rgba, scale), folder.file("b.png"));
    EXPECT_TRUE(file_bytes(folder.file("a.png")) == file_bytes(folder.file("b.png")));
  };
  std::vector<std::uint8_t> few;   // two colours
  std::vector<std::uint8_t> many;  // more than a palette holds
  for (int i = 0; i < 600; ++i) {
    const auto low = static_cast<std::uint8_t>(i % 250);
    for (const int byte : {i % 2 == 0 ? 0 : 255, 20, 30, 255}) {
      few.push_back(static_cast<std::uint8_t>(byte));
    }
    many.insert(many.end(), {low, static_cast<std::uint8_t>(i / 250), 9, 200});
  }
  check(30, 20, few, 3);
  check(30, 20, few, 3);  // not encoded again
  check(30, 20, few, 1);
  check(20, 30, few, 1);
  check(20, 30, many, 1);
  check(20, 30, many, 4);
}

TEST(FilmWriter, Frames_CanBeReadBack) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.AVI"}) {
    const std::string path = folder.file(name);
    {
      FilmWriter film(path, 25.0);
      for (int i = 0; i < 7; ++i) film.add(gradient(65, 49));
      film.finish();
    }
    const FilmContents contents = read_film(path);
    EXPECT_EQ(contents.frames, 7) << name;
    EXPECT_EQ(contents.width, 64) << name;  // rounded down to even numbers
    EXPECT_EQ(contents.height, 48) << name;
  }
}

TEST(FilmWriter, Errors_NameFileAndReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("film.gif"), 25.0); }),
              HasSubstr("film.gif: cannot write the film: unknown ending \".gif\""));
  EXPECT_THAT(error_of([&] { FilmWriter("", 25.0); }), HasSubstr("it has no name"));
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("missing/film.mp4"), 25.0); }),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("film.mp4"), 0.0); }),
              HasSubstr("frames per second"));
}

TEST(FilmWriter, CompleteFilm_AcceptedAtAnyLengthAndRate) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.avi"}) {
    for (const double rate : {1.0, 7.5, 29.97, 240.0}) {
      for (const int frames : {0, 1, 2, 61}) {
        FilmWriter film(folder.file(name), rate);
        for (int i = 0; i < frames; ++i) film.add(gradient(16, 16));
        EXPECT_EQ(error_of([&] { film.finish(); }), "") << name << ", " << rate << ", " << frames;
      }
    }
  }
}

// While this object exists, files cannot exceed a size, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_limit_{};
};

TEST(FilmWriter, TruncatedFilm_Error) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.avi"}) {
    FilmWriter film(folder.file(name), 25.0);
    // Noise, which compresses badly: some kB per frame, 60 frames.
    std::minstd_rand random(1);
    std::string error;
    {
      const FileSizeLimit full_disk(20'000);
      for (int i = 0; i < 60; ++i) {
        Image noise = gradient(64, 64);
        for (std::uint8_t& sample : noise.rgb) sample = static_cast<std::uint8_t>(random() >> 8U);
        film.add(noise);
      }
      error = error_of([&] { film.finish(); });
    }
    EXPECT_THAT(error, HasSubstr(folder.file(name)));
    EXPECT_THAT(error, HasSubstr("not whole"));
  }
}

TEST(FilmWriter, FrameOfOtherSize_Refused) {
  const TemporaryFolder folder;
  FilmWriter film(folder.file("film.mp4"), 25.0);
  film.add(gradient(64, 48));
  EXPECT_THAT(error_of([&] { film.add(gradient(64, 50)); }),
              HasSubstr("a frame is 64 x 50 pixels, those before were 64 x 48"));
}

TEST(FilmWriter, Folder_WrittenAndEarlierFramesRemoved) {
  const TemporaryFolder folder;
  const std::string path = folder.file("film/pictures");
  std::filesystem::create_directories(path);
  for (const char* name : {"frame_000007.png", "frame_1.png", "notes.txt"}) {
    std::ofstream(path + "/" + name) << "x";
  }
  {
    FilmWriter film(path, 25.0);
    for (int i = 0; i < 3; ++i) film.add(gradient(64 + 1, 49));  // odd sizes are kept
  }
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    names.push_back(entry.path().filename());
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre("frame_000001.png", "frame_000002.png",
                                                   "frame_000003.png", "frame_1.png", "notes.txt"));
  const cv::Mat read = cv::imread(path + "/frame_000003.png");
  EXPECT_EQ(read.cols, 65);
  EXPECT_EQ(read.rows, 49);
  EXPECT_EQ(read.at<cv::Vec3b>(10, 30)[1], 120);  // 30 * 4
}

TEST(FilmWriter, UnwritableFolder_Explained) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("taken")) << "x";
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("taken"), 25.0); }),
              HasSubstr("taken: cannot write the film: "));
}

TEST(FilmWriter, Films_RecognisedByName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("run.1"));
  for (const std::string& name :
       {std::string("a.mp4"), std::string("A.AVI"), std::string("frames"), std::string("a.gif/"),
        std::string("out.d/frames"), folder.file("run.1")}) {
    EXPECT_TRUE(FilmWriter::is_film_name(name)) << name;
  }
  for (const char* name : {"", "a.gif", "a.mp4.png"}) {
    EXPECT_FALSE(FilmWriter::is_film_name(name)) << name;
  }
}

TEST(FilmWriter, NoFrames_NoFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("film.mp4");
  { const FilmWriter film(path, 25.0); }
  EXPECT_FALSE(std::filesystem::exists(path));
  const std::string pictures = folder.file("pictures");
  { const FilmWriter film(pictures, 25.0); }
  EXPECT_FALSE(std::filesystem::exists(pictures));
}

TEST(PictureModules, MissingModule_ErrorListsSearchedPlaces) {
  EXPECT_THAT(error_of([] { static_cast<void>(modules::load_module("libplaypen_x.so", "x")); }),
              testing::AllOf(HasSubstr("libplaypen_x.so"), HasSubstr("is missing; looked for in /"),
                             HasSubstr("lib/playpen"), HasSubstr("PLAYPEN_LIBRARIES")));
}

TEST(PictureModules, EnvironmentFolder_Searched) {
  const TemporaryFolder folder;
  const std::string file = folder.file("libplaypen_x.so");
  std::ofstream(file) << "this is no library";
  setenv("PLAYPEN_LIBRARIES", std::filesystem::path(file).parent_path().c_str(), 1);
  const std::string error =
      error_of([] { static_cast<void>(modules::load_module("libplaypen_x.so", "x")); });
  unsetenv("PLAYPEN_LIBRARIES");
  EXPECT_THAT(error, testing::AllOf(HasSubstr(file), HasSubstr("cannot be loaded")));
}

TEST(PictureModules, MissingFunction_Refused) {
  EXPECT_THAT(
      error_of([] { static_cast<void>(modules::load_module("libplaypen_text.so", "no_such")); }),
      testing::AllOf(HasSubstr("libplaypen_text.so"), HasSubstr("no_such")));
}

}  // namespace
}  // namespace sim::render
