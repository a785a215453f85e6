// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Pictures of a part of the world, marks of goals and collisions, and optional parts of pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/painter.h"
#include "render/text_outline.h"
#include "sim/render/drawing.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

using testing::HasSubstr;

using Rgb = std::array<int, 3>;

Rgb pixel(const Image& image, double x, double y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

bool is_red(const Rgb& rgb) { return rgb[0] > 190 && rgb[1] < 110 && rgb[2] < 110; }
bool is_blue(const Rgb& rgb) { return rgb[2] > 150 && rgb[0] < 90; }

// The arena is 4 x 4 m. In a picture of 1000 px without legend, the floor is 924 px wide and 38 px
// from each edge.
SceneSnapshot scene_of(int robots) {
  SceneSnapshot scene;
  scene.world_name = "test";
  scene.arena.size = {4.0, 4.0};
  scene.canvas_description = {.width = 40, .height = 40, .cell_size_m = 0.1, .origin = {0.0, 0.0}};
  for (int i = 0; i < robots; ++i) {
    RobotSnapshot robot;
    robot.name = "r" + std::to_string(i + 1);
    robot.colour = {0x10, 0x20, 0xe0};
    robot.X_WB = {0.5 + 3.0 * ((i % 10) / 10.0), 0.5 + 3.0 * ((i / 10) / 10.0), 0.0};
    robot.footprint = {{0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}, {-0.1, -0.1}};
    scene.robots.push_back(robot);
  }
  return scene;
}

RenderOptions plain() {
  RenderOptions options;
  options.names = false;
  options.legend = false;
  return options;
}

TEST(SceneRenderer, PlaceInPicture_IsWhereTheSceneIsDrawn) {
  const SceneSnapshot scene = scene_of(1);
  EXPECT_NEAR((place_in_picture(scene, plain(), {0.0, 0.0}) - Vec2(38.0, 962.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((place_in_picture(scene, plain(), {4.0, 4.0}) - Vec2(962.0, 38.0)).norm(), 0.0, 1e-9);
  RenderOptions options = plain();
  options.follow = "r1";  // whose place is the middle of the picture
  options.follow_width_m = 1.0;
  const Image image = draw_scene(scene, options);
  const Vec2 robot = place_in_picture(scene, options, scene.robots[0].X_WB.position());
  EXPECT_NEAR((robot - 0.5 * Vec2(image.width, image.height)).norm(), 0.0, 1.0);
  // Half a body's width beside it is the robot, not the floor.
  const Vec2 body = place_in_picture(scene, options, Vec2(0.5, 0.5) + Vec2(0.0, 0.07));
  EXPECT_TRUE(is_blue(pixel(image, body.x(), body.y())));
  options.size_px = 1;
  EXPECT_THROW((void)place_in_picture(scene, options, {0.0, 0.0}), std::invalid_argument);
}

// A large shape is drawn some rows at a time.
TEST(Painter, LargeShape_CoversSameWidthInEachRow) {
  Painter painter(400, 700, Colour{255, 255, 255});
  Shape slanted;
  slanted.add_outline({{50.5, 10.0}, {150.5, 10.0}, {350.5, 690.0}, {250.5, 690.0}});
  painter.fill(slanted, Colour{0, 0, 0});
  for (int y = 0; y < 700; ++y) {
    double width_px = 0.0;
    for (int x = 0; x < 400; ++x) width_px += (255 - pixel(painter.image(), x, y)[0]) / 255.0;
    // At most two pixels are covered in part at either side, each rounded to 1/255.
    EXPECT_NEAR(width_px, y < 10 || y >= 690 ? 0.0 : 100.0, 4.0 * 0.5 / 255.0) << y;
  }
}

TEST(Overlay, ShapesOverEachOther_SameAsPainterWithinRounding) {
  Shape below;
  below.add_disc({100.0, 60.0}, 50.0);
  Shape above;
  above.add_line({{10.0, 100.0}, {190.0, 20.0}}, 9.0);
  const auto draw = [&](auto& painter) {
    painter.fill(below, Colour{200, 40, 20}, 0.7);
    painter.fill(above, Colour{10, 90, 250});
  };
  const Painter paper(200, 120, Colour{240, 240, 230});
  Painter painter(200, 120, Colour{240, 240, 230});
  draw(painter);
  const Overlay overlay(200, 120, draw);
  Image image = paper.image();
  overlay.draw_on(image, {0, 0, 200, 120});
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    // The painter rounds after each of the two shapes, the overlay once.
    ASSERT_NEAR(image.rgb[i], painter.image().rgb[i], 1.0) << i;
  }
}

TEST(RenderParts, ExactSize_KeptForAnyArena) {
  for (const auto& [width, height] : {std::array{640, 480}, std::array{300, 900}, {64, 4096}}) {
    RenderOptions options;
    options.width_px = width;
    options.height_px = height;
    for (const ViewMode mode : {ViewMode::kGround, ViewMode::kMiniMap, ViewMode::kFullScreen}) {
      SceneRenderer renderer(options);
      const Image& image = renderer.draw(scene_of(1), mode);
      EXPECT_EQ(image.width, width);
      EXPECT_EQ(image.height, height);
    }
  }
  RenderOptions bad;
  bad.width_px = 640;
  EXPECT_THROW(SceneRenderer{bad}, std::invalid_argument);
  bad.height_px = 9000;
  EXPECT_THROW(SceneRenderer{bad}, std::invalid_argument);
}

TEST(RenderParts, Crop_ShowsThatPartOnly) {
  SceneSnapshot scene = scene_of(2);  // at (0.5, 0.5) and (0.8, 0.5)
  RenderOptions options = plain();
  options.part = ScenePart{{0.0, 0.0}, {1.0, 1.0}, false};
  const Image image = draw_scene(scene, options);
  // The scale is 924 px/m, so the centre of the first robot is at 38 + 462 px and its radius is 92
  // px.
  EXPECT_EQ(image.width, 1000);
  EXPECT_TRUE(is_blue(pixel(image, 500 - 60, 500 + 20)));
  EXPECT_FALSE(is_blue(pixel(image, 500 - 110, 500)));
  // The margin outside of the part is white like paper.
  scene.robots[0].X_WB = {0.0, 0.5, 0.0};  // half of the robot is in the part
  const Image cut = draw_scene(scene, options);
  EXPECT_TRUE(is_blue(pixel(cut, 38 + 20, 500 + 30)));
  EXPECT_GT(pixel(cut, 20, 500)[0], 230);
  options.part->size.x() = 0.0;
  EXPECT_THROW(SceneRenderer{options}, std::invalid_argument);
}

// A robot with two arms: the floor is visible between them. 1 m is 924 px: x px = 38 + 924 x, y px
// = 962 - 924 y. A marking under the robot, at x = 0.25 to 0.75, does not cover it.
TEST(RenderParts, BodyGaps_ShowFloorAndMarkingsLieBelowRobots) {
  SceneSnapshot scene = scene_of(1);  // at (0.5, 0.5)
  scene.robots[0].parts = {{{-0.1, -0.1}, {0.0, -0.1}, {0.0, 0.1}, {-0.1, 0.1}},
                           {{0.0, 0.04}, {0.1, 0.04}, {0.1, 0.1}, {0.0, 0.1}},
                           {{0.0, -0.1}, {0.1, -0.1}, {0.1, -0.04}, {0.0, -0.04}}};
  RenderOptions options = plain();
  options.part = ScenePart{{0.0, 0.0}, {1.0, 1.0}, false};
  const auto at = [&](const Image& image, double x_m, double y_m) {
    return pixel(image, 38.0 + 924.0 * x_m, 962.0 - 924.0 * y_m);
  };
  Image image = draw_scene(scene, options);
  EXPECT_TRUE(is_blue(at(image, 0.45, 0.57)));
  EXPECT_TRUE(is_blue(at(image, 0.55, 0.57)));
  EXPECT_TRUE(is_blue(at(image, 0.55, 0.43)));
  EXPECT_FALSE(is_blue(at(image, 0.57, 0.5))) << "between the arms";
  EXPECT_TRUE(is_blue(at(image, 0.5, 0.57))) << "no line where two parts meet";

  ObstacleDescription marking;
  marking.name = "zone";
  marking.center = {0.5, 0.5};
  marking.size = {0.5, 0.5};
  marking.colour = Colour{0xff, 0, 0, 0xff};
  marking.solid = false;
  scene.arena.obstacles = {marking};
  image = draw_scene(scene, options);
  EXPECT_TRUE(is_blue(at(image, 0.55, 0.57)));
  EXPECT_TRUE(is_red(at(image, 0.57, 0.5)));
  EXPECT_TRUE(is_red(at(image, 0.35, 0.35)));
  // A solid block at the right has a shadow at its lower right, a marking has none.
  const Rgb floor = at(image, 0.85, 0.45);  // away from the grid of 0.1 m
  EXPECT_EQ(at(image, 0.753, 0.45), floor);
  scene.arena.obstacles[0].solid = true;
  EXPECT_NE(at(draw_scene(scene, options), 0.753, 0.45), floor);
}

TEST(RenderParts, LargeWorld_CanBeCropped) {
  SceneSnapshot scene = scene_of(1);
  scene.arena.size = {20000.0, 20000.0};
  RenderOptions options = plain();
  options.part = ScenePart{{0.45, 0.45}, {0.1, 0.1}, false};
  EXPECT_TRUE(is_blue(pixel(draw_scene(scene, options), 300, 700)));
}

TEST(RenderParts, Follow_KeepsRobotInMiddle) {
  SceneSnapshot scene = scene_of(2);
  RenderOptions options = plain();
  options.follow = "r2";
  options.follow_width_m = 1.0;
  SceneRenderer renderer(options);
  for (const double x : {0.8, 2.0, 3.97, 7.0}) {  // the last one is beyond the floor
    scene.robots[1].X_WB = {x, 1.0, 0.0};
    const Image& image = renderer.draw(scene);
    EXPECT_TRUE(is_blue(pixel(image, 500 - 60, 500 + 20))) << x;
    EXPECT_FALSE(is_blue(pixel(image, 500 - 110, 500))) << x;
  }
  // Data that are cached between pictures do not change the pictures.
  EXPECT_EQ(renderer.draw(scene).rgb, SceneRenderer(options).draw(scene).rgb);
  // A picture with the aspect ratio 2:1 shows more at the sides with an equal scale.
  options.width_px = 1600;
  options.height_px = 800;
  const Image wide = draw_scene(scene, options);
  EXPECT_TRUE(is_blue(pixel(wide, 800 - 40, 400 + 10)));
  // An unknown robot shows the whole arena.
  options.follow = "r9";
  EXPECT_EQ(draw_scene(scene, options).width, 1600);
}

// Bytes that the names of some robots change.
long changed_by_names(int robots) {
  SceneSnapshot scene = scene_of(robots);
  for (RobotSnapshot& robot : scene.robots) {
    robot.name += " has a long name";
    robot.X_WB.x_m = 1.5 + 0.2 * robot.X_WB.x_m;
    robot.X_WB.y_m = 1.5 + 0.2 * robot.X_WB.y_m;
  }
  RenderOptions options = plain();
  const Image bare = draw_scene(scene, options);
  options.names = true;
  const Image named = draw_scene(scene, options);
  long changed = 0;
  for (std::size_t i = 0; i < bare.rgb.size(); ++i) changed += bare.rgb[i] != named.rgb[i] ? 1 : 0;
  return changed;
}

TEST(RenderParts, CrowdedNames_DoNotOverlap) {
  const long few = changed_by_names(20);
  const long crowd = changed_by_names(60);
  EXPECT_GT(crowd, few / 20);
  EXPECT_LT(crowd, few);
}

TEST(RenderParts, CollisionsAndGoals_MarkedUnlessHidden) {
  SceneSnapshot scene = scene_of(1);
  scene.collisions = {{0, {2.0, 2.0}, 1.0}, {0, {2.0, 2.0}, 2.0}};
  scene.goals = {{0, {3.0, 3.0}, false, true}, {0, {1.0, 3.0}, true, false}};
  RenderOptions options = plain();
  const auto at = [](const Image& image, double x, double y) {
    return pixel(image, 38 + 231 * x, 962 - 231 * y);
  };
  const Image marked = draw_scene(scene, options);
  EXPECT_TRUE(is_red(at(marked, 2.0, 2.0)));
  const double ring = 10.0 / 231.0;
  EXPECT_LT(at(marked, 3.0 + ring, 3.0)[0], 100);  // the ring, in the robot's colour
  EXPECT_GT(at(marked, 3.0, 3.0)[0], 200);         // not reached: no dot
  EXPECT_LT(at(marked, 1.0, 3.0)[0], 100);         // reached: a dot
  options.collisions = false;
  options.goals = false;
  const Image without = draw_scene(scene, options);
  scene.collisions.clear();
  scene.goals.clear();
  EXPECT_EQ(without.rgb, draw_scene(scene, plain()).rgb);
  // Marks of unknown robots and marks with invalid positions are not drawn.
  scene.goals = {{7, {1.0, 1.0}, true, true}};
  scene.collisions = {{0, {std::nan(""), 1.0}, 0.0}};
  EXPECT_EQ(draw_scene(scene, plain()).rgb, without.rgb);
}

TEST(RenderParts, Colours_FollowRequestedSource) {
  const SceneSnapshot scene = scene_of(3);
  RenderOptions options = plain();
  const auto colour_of = [&](int robot) {
    const Pose& X_WB = scene.robots[static_cast<std::size_t>(robot)].X_WB;
    return pixel(draw_scene(scene, options), 38 + 231 * (X_WB.x_m - 0.05), 962 - 231 * X_WB.y_m);
  };
  EXPECT_EQ(colour_of(0), colour_of(1));
  options.colour_by = ColourBy::kRobot;
  EXPECT_NE(colour_of(0), colour_of(1));
  EXPECT_NE(colour_of(1), colour_of(2));
  options.colour_by = ColourBy::kNone;
  EXPECT_EQ(colour_of(0), colour_of(2));
  EXPECT_LT(std::abs(colour_of(0)[0] - colour_of(0)[2]), 20);
}

TEST(RenderParts, HundredLasers_LeaveFloorLightAndColoured) {
  SceneSnapshot scene = scene_of(100);
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    RobotSnapshot& robot = scene.robots[i];
    robot.colour = i % 2 == 0 ? Colour{0xe0, 0x20, 0x20} : Colour{0x20, 0x60, 0xe0};
    robot.scan_origin = robot.X_WB.position();
    for (int beam = 0; beam < 90; ++beam) {
      const double angle = -std::numbers::pi + beam * std::numbers::pi / 45.0;
      robot.scan_points.push_back(robot.scan_origin + 4.0 * Vec2(std::cos(angle), std::sin(angle)));
    }
  }
  const Image image = draw_scene(scene, plain());
  // Far from all robots, the fans do not change the floor. Near a robot, the floor has the robot's
  // colour.
  EXPECT_GT(pixel(image, 38 + 231 * 3.8, 962 - 231 * 3.8)[0], 240);
  const Rgb beside = pixel(image, 38 + 231 * 0.37, 962 - 231 * 0.5);
  EXPECT_GT(beside[0], beside[1] + 10);
}

TEST(RenderParts, MiniMap_HidesRobotLabelsUnderIt) {
  SceneSnapshot scene = scene_of(1);
  scene.view_mode = ViewMode::kMiniMap;
  RenderOptions options;
  options.legend = false;
  options.names = false;
  // The mini-map is in the top right corner of an empty floor.
  scene.robots[0].X_WB = {3.4, 3.4, 0.0};
  const Image unnamed = draw_view(scene, options);
  options.names = true;
  EXPECT_EQ(draw_view(scene, options).rgb, unnamed.rgb);
  scene.robots[0].says = "hello";
  EXPECT_EQ(draw_view(scene, options).rgb, unnamed.rgb);
  scene.robots[0].X_WB = {1.0, 1.0, 0.0};
  scene.robots[0].says = "";
  const Image seen = draw_view(scene, options);
  options.names = false;
  EXPECT_NE(draw_view(scene, options).rgb, seen.rgb);
}

// --- Texts

TEST(TextOutline, Utf8_ReadByCharacter) {
  EXPECT_EQ(code_points("a\u017d\u20ac\U0001f916"),
            (std::vector<std::uint32_t>{'a', 0x17d, 0x20ac, 0x1f916}));
  // The text contains an invalid byte.
  EXPECT_EQ(code_points("\xff\xc5z"), (std::vector<std::uint32_t>{0xfffd, 0xfffd, 'z'}));
  EXPECT_TRUE(has_wide_characters("k\u016f\u0148"));
  EXPECT_FALSE(has_wide_characters("kun"));
  std::string cut = "k\u016f";
  cut.pop_back();
  drop_cut_character(cut);
  EXPECT_EQ(cut, "k");
  std::string whole = "k\u016f";
  drop_cut_character(whole);
  EXPECT_EQ(whole, "k\u016f");
}

TEST(TextOutline, EveryCharacter_HasOutlineOrBox) {
  // Czech, Greek and Cyrillic characters, and a character that European fonts do not contain.
  double width_px = 0.0;
  for (const char* text : {"\u017dlu\u0165ou\u010dk\u00fd", "\u0395\u03bb\u03bb\u03ac",
                           "\u041a\u0438\u0440", "\U0001fbf0"}) {
    const TextOutline outline = text_outline(text, 20.0);
    EXPECT_GE(outline.contours.size(), code_points(text).size()) << text;
    EXPECT_GT(outline.width_px, 0.0);
    width_px += outline.width_px;
    for (const auto& contour : outline.contours) {
      for (const Vec2& point : contour) EXPECT_LT(std::abs(point.y()), 60.0);
    }
  }
  EXPECT_GT(width_px, 100.0);
  // A box has an outer and an inner edge, and the height of a capital letter.
  const TextOutline box = text_outline("\U0001fbf0", 20.0);
  ASSERT_EQ(box.contours.size(), 2U);
  EXPECT_DOUBLE_EQ(box.contours[0][1].y(), -20.0);
  EXPECT_TRUE(text_outline("\u00a0\t", 20.0).contours.empty());
}

TEST(TextOutline, NamesBeyondAscii_DrawnRepeatably) {
  SceneSnapshot scene = scene_of(1);
  scene.robots[0].name = "\u017dofie";
  scene.world_name = "\u017dlu\u0165ou\u010dk\u00fd k\u016f\u0148";
  const Image first = draw_scene(scene, {});
  EXPECT_EQ(draw_scene(scene, {}).rgb, first.rgb);
  SceneSnapshot other = scene;
  other.robots[0].name = "\u010cofie";
  EXPECT_NE(draw_scene(other, {}).rgb, first.rgb);
  // Invalid bytes cause no error.
  other.world_name = "\xff\xfe";
  other.robots[0].says = std::string(300, '\xc5') + "\u0148";
  static_cast<void>(draw_scene(other, {}));
}

// --- Pages of charts

TEST(Drawing, PictureAndSvg_SameItems) {
  Drawing page(200, 100);
  page.add_line({{10, 50}, {190, 50}}, {0xff, 0, 0, 0xff}, 4.0);
  page.add_line({{10, 80}, {190, 80}}, {0, 0, 0xff, 0xff}, 4.0, true);
  page.add_area({{20, 10}, {40, 10}, {40, 30}, {20, 30}}, {0, 0x80, 0, 0xff});
  page.add_text("a<b & \u010d", {100, 30}, 10.0, {0, 0, 0, 0xff}, Drawing::Align::kMiddle);
  page.add_picture(Image{2, 1, {1, 2, 3, 4, 5, 6}}, {60.0, 5.0});
  page.add_picture(Image{2, 1, {9, 9, 9, 9, 9, 9}}, {199.0, 99.0});  // clipped at the edge
  const Image image = page.image();
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(pixel(image, 100, 50), (Rgb{0xff, 0, 0}));
  // The first dash is 16 pixels long, and the gap after it 10 pixels less the round ends.
  EXPECT_EQ(pixel(image, 18, 80), (Rgb{0, 0, 0xff}));
  EXPECT_EQ(pixel(image, 30.5, 80), (Rgb{0xff, 0xff, 0xff}));
  EXPECT_EQ(pixel(image, 30, 20), (Rgb{0, 0x80, 0}));
  EXPECT_EQ(pixel(image, 61, 5), (Rgb{4, 5, 6}));
  const std::string svg = page.svg();
  EXPECT_THAT(svg, HasSubstr("<polyline fill=\"none\" stroke=\"#ff0000\" stroke-width=\"4\""));
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray=\"16 10.4\""));
  EXPECT_THAT(svg, HasSubstr("points=\"10,50 190,50\""));
  EXPECT_THAT(svg, HasSubstr(">a&lt;b &amp; \u010d</text>"));
  EXPECT_THAT(svg, HasSubstr("data:image/png;base64,iVBORw0KGgo"));
  EXPECT_EQ(svg, page.svg());
  EXPECT_THROW(Drawing(63, 100), std::invalid_argument);
}

std::string texts_of(const std::vector<Tick>& ticks) {
  std::string texts;
  for (const Tick& tick : ticks) texts += (texts.empty() ? "" : " ") + tick.text;
  return texts;
}

TEST(Ticks, Ranges_RoundNumbers) {
  EXPECT_EQ(texts_of(ticks(0.0, 1.0, 5)), "0 0.2 0.4 0.6 0.8 1");
  EXPECT_EQ(texts_of(ticks(-0.3, 0.3, 6)), "-0.3 -0.2 -0.1 0 0.1 0.2 0.3");
  EXPECT_EQ(texts_of(ticks(0.1, 10.9, 5)), "5 10");
  EXPECT_EQ(texts_of(ticks(1e9, 1e9 + 4.0, 4)),
            "1000000000 1000000001 1000000002 1000000003 1000000004");
  EXPECT_EQ(texts_of(ticks(0.0, 3e300, 3)), "0 1e+300 2e+300 3e+300");
  EXPECT_EQ(texts_of(ticks(-2e-17, 2e-17, 4)), "-2e-17 -1e-17 0 1e-17 2e-17");
}

TEST(Ticks, UnusableRange_NoTicks) {
  EXPECT_EQ(texts_of(ticks(1.0, 1.0, 5)), "");
  EXPECT_EQ(texts_of(ticks(2.0, 1.0, 5)), "");
  EXPECT_EQ(texts_of(ticks(1.0, std::nextafter(1.0, 2.0), 5)), "");
  EXPECT_EQ(texts_of(ticks(-1.7e308, 1.7e308, 5)), "");
}

TEST(Drawing, ManyColours_Differ) {
  for (std::size_t i = 0; i < 30; ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(distinct_colour(i) == distinct_colour(k));
  }
}

}  // namespace
}  // namespace sim::render
