// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/render/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "canvas/image_file.h"

namespace sim::render {
namespace {

using ::testing::HasSubstr;

// A folder of its own for a test, removed afterwards.
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

// An arena of 4 x 4 m. In a picture of 1000 px without legend the margin is 38 px on each side,
// so the floor is 924 px wide: 231 px a metre, its left edge at x = 38, its lower one at y = 962.
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

TEST(DrawScene, LongerSideHasTheSizeAskedFor) {
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

TEST(DrawScene, RefusesASizeOutOfRange) {
  for (const int size_px : {-1, 0, 63, 8193}) {
    RenderOptions options;
    options.size_px = size_px;
    EXPECT_THROW((void)draw_scene(small_scene(), options), std::invalid_argument) << size_px;
  }
}

TEST(DrawScene, RefusesACanvasOfAnotherSize) {
  SceneSnapshot scene = small_scene();
  scene.canvas.assign(39 * 40 * 4, 0);
  EXPECT_THROW((void)draw_scene(scene), std::invalid_argument);
}

TEST(DrawScene, FloorIsLightAndBorderBrown) {
  const Image image = draw_scene(small_scene(), plain_options());
  EXPECT_TRUE(is_light(pixel_at(image, {1.25, 2.75})));  // between the grid's lines
  // The border is 0.035 m = 8 px thick and lies outside the floor.
  const Rgb border = pixel(image, kMarginPx - 4, 500);
  EXPECT_GT(border[0], border[1] + 20);
  EXPECT_GT(border[1], border[2] + 20);
}

TEST(DrawScene, ExtendedBlocksAreFilledAndRetractedOnesAreNot) {
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
  // A dash of the retracted one's outline begins at its corner (2.55, 3.45).
  const Rgb corner = pixel_at(image, {2.55, 3.45});
  EXPECT_GT(corner[0], corner[1] + 30);
}

TEST(DrawScene, RobotStandsInItsColourWhereItsPoseSays) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({1.2, 3.1, 0.7}, {10, 120, 200, 255})};
  const Image image = draw_scene(scene, plain_options());
  EXPECT_EQ(pixel_at(image, {1.2, 3.1}), (Rgb{10, 120, 200}));
  EXPECT_TRUE(is_light(pixel_at(image, {1.2, 0.9})));  // not mirrored: y points up
}

TEST(DrawScene, CanvasLiesOnTheFloorCellByCell) {
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

TEST(DrawScene, WallsHaveHoles) {
  SceneSnapshot scene = small_scene();
  // A ring: 0.5..3.5 m outside, counter-clockwise, 1..3 m inside, clockwise.
  scene.arena.walls = {{{{0.5, 0.5}, {3.5, 0.5}, {3.5, 3.5}, {0.5, 3.5}}},
                       {{{1.0, 1.0}, {1.0, 3.0}, {3.0, 3.0}, {3.0, 1.0}}}};
  const Image image = draw_scene(scene, plain_options());
  EXPECT_LT(pixel_at(image, {0.75, 2.0})[1], 100);
  EXPECT_TRUE(is_light(pixel_at(image, {1.75, 1.75})));
  EXPECT_TRUE(is_light(pixel_at(image, {0.25, 1.75})));
}

TEST(DrawScene, TrailAndFanAreDrawnWhenAskedForAndStayOnTheFloor) {
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
  EXPECT_LT(pixel_at(drawn, in_fan)[0], 235);  // translucent blue takes red away
  EXPECT_GT(pixel_at(drawn, in_fan)[0], 100);
  EXPECT_TRUE(is_light(pixel_at(bare, in_fan)));
  // Right of the floor and its border, on the way to (9, 2.2).
  const Vec2 outside(4.1, 2.2);
  EXPECT_EQ(pixel_at(drawn, outside), pixel_at(bare, outside));
}

TEST(DrawScene, StalledRobotHasARedRing) {
  SceneSnapshot scene = small_scene();
  scene.robots = {robot_at({2.25, 2.25, 0.0}, {0, 0, 255, 255})};
  scene.robots[0].stalled = true;
  const Image image = draw_scene(scene, plain_options());
  // Its centre line is 6 px outside the circle round the footprint, whose radius is
  // 0.1 m * sqrt(2) * 231 px/m = 32.7 px.
  const double radius_m = 0.1 * std::sqrt(2.0) + 6.0 / kPixelsPerMetre;
  EXPECT_TRUE(is_red(pixel_at(image, {2.25 + radius_m, 2.25})));
}

TEST(DrawScene, NamesAndLegendChangeOnlyWhatTheyShould) {
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
  // The footer is 74 px high; above it, nothing tells the time.
  const auto footer = static_cast<std::ptrdiff_t>(3 * at_0.width * (at_0.height - 74));
  EXPECT_TRUE(std::equal(at_0.rgb.begin(), at_0.rgb.begin() + footer, at_7.rgb.begin()));
}

TEST(DrawScene, TakesExtremeContents) {
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

TEST(DrawScene, SameSceneGivesTheSameBytes) {
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

TEST(DrawCanvas, ScalesCellsAndShowsTransparentAsWhite) {
  const CanvasDescription description{
      .width = 2, .height = 2, .cell_size_m = 0.02, .origin = {0.0, 0.0}};
  Canvas canvas(description);
  canvas.set_pixel(0, 0, {255, 0, 0, 255});
  canvas.set_pixel(1, 1, {0, 0, 0, 51});  // a fifth of black over white: 204
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

TEST(DrawCanvas, RefusesABadScaleOrTooFewBytes) {
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

TEST(WritePng, CanBeReadBack) {
  const TemporaryFolder folder;
  const std::string path = folder.file("grey.png");
  write_png(gradient(40, 3), path);
  const GreyImage read = load_grey_image(path);
  ASSERT_EQ(read.width, 40);
  ASSERT_EQ(read.height, 3);
  EXPECT_EQ(read.pixels[0], 0);
  EXPECT_EQ(read.pixels[39], 156);
}

TEST(WritePng, KeepsRedAndBlueApart) {
  const TemporaryFolder folder;
  const std::string path = folder.file("red.png");
  write_png({1, 1, {200, 0, 100}}, path);
  // Luma 0.299 * 200 + 0.114 * 100 = 71.2; exchanged, it would be 52.7.
  EXPECT_EQ(load_grey_image(path).pixels, (std::vector<std::uint8_t>{71}));
}

TEST(WritePng, ErrorNamesFileAndReason) {
  const TemporaryFolder folder;
  const std::string path = folder.file("missing/scene.png");
  const std::string error = error_of([&] { write_png(gradient(4, 4), path); });
  EXPECT_THAT(error, HasSubstr(path));
  EXPECT_THAT(error, HasSubstr("No such file or directory"));
  EXPECT_NE(error_of([&] { write_png(Image{}, folder.file("empty.png")); }), "");
}

TEST(LoadGreyImage, ReadsPlainAndRawPgm) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.pgm");
  std::ofstream(path) << "P2 # plain\n# a comment\n3 1\n15\n0 5 15\n";
  // Of a maximum of 15: 5/15 of 255 = 85.
  EXPECT_EQ(load_grey_image(path).pixels, (std::vector<std::uint8_t>{0, 85, 255}));
  std::ofstream(path, std::ios::binary) << "P5 2 2 255\n"
                                        << "\x01\x20\x0a\xfe";
  EXPECT_EQ(load_grey_image(path).pixels, (std::vector<std::uint8_t>{1, 32, 10, 254}));
}

TEST(LoadGreyImage, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.pgm");
  const auto error_with = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return error_of([&] { (void)load_grey_image(path); });
  };
  EXPECT_THAT(error_of([&] { (void)load_grey_image(folder.file("none.png")); }),
              HasSubstr("none.png: cannot read the picture: No such file or directory"));
  EXPECT_THAT(error_of([&] { (void)load_grey_image(folder.file("")); }), HasSubstr("directory"));
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

// Frames that a reader finds in a film, and their size.
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

TEST(FilmWriter, WritesFramesThatCanBeReadBack) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.AVI"}) {
    const std::string path = folder.file(name);
    {
      FilmWriter film(path, 25.0);
      for (int i = 0; i < 7; ++i) film.add(gradient(65, 49));
    }
    const FilmContents contents = read_film(path);
    EXPECT_EQ(contents.frames, 7) << name;
    EXPECT_EQ(contents.width, 64) << name;  // cut to even numbers
    EXPECT_EQ(contents.height, 48) << name;
  }
}

TEST(FilmWriter, ErrorsNameFileAndReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("film.gif"), 25.0); }),
              HasSubstr("film.gif: cannot write the film: unknown ending \".gif\""));
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("film"), 25.0); }),
              HasSubstr("must end in .mp4 or .avi"));
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("missing/film.mp4"), 25.0); }),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(error_of([&] { FilmWriter(folder.file("film.mp4"), 0.0); }),
              HasSubstr("frames per second"));
}

TEST(FilmWriter, RefusesAFrameOfAnotherSize) {
  const TemporaryFolder folder;
  FilmWriter film(folder.file("film.mp4"), 25.0);
  film.add(gradient(64, 48));
  EXPECT_THAT(error_of([&] { film.add(gradient(64, 50)); }),
              HasSubstr("a frame is 64 x 50 pixels, those before were 64 x 48"));
}

TEST(FilmWriter, LeavesNoFileWithoutFrames) {
  const TemporaryFolder folder;
  const std::string path = folder.file("film.mp4");
  { const FilmWriter film(path, 25.0); }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace sim::render
