// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Blobfinder, pan-tilt-zoom head, and camera.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/camera.h"
#include "sim/devices/ptz.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Blob = BlobfinderReading::Blob;

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = kPi / 180.0;
constexpr Colour kRed{0xff, 0x00, 0x00, 0xff};
constexpr Colour kBlue{0x00, 0x00, 0xff, 0xff};

/// A room of 8 x 8 m; its first robot stands at (2, 4) and faces along x.
WorldDescription room(const std::string& devices, const std::string& obstacles = "",
                      const std::string& robots = "") {
  return load_world_text(R"({"arena": {"size": [8, 8], "obstacles": [)" + obstacles +
                         R"(]}, "robots": [{"name": "r1", "pose": {"x": 2, "y": 4}, "devices": )" +
                         devices + "}" + robots + "]}");
}

/// A box centred at (x, y).
std::string box(double x, double y, double side, const std::string& more) {
  return R"({"center": [)" + fixed_text(x, 6) + ", " + fixed_text(y, 6) + R"(], "size": [)" +
         fixed_text(side, 6) + ", " + fixed_text(side, 6) + "]" + more + "}";
}

template <typename DeviceType>
const DeviceType& device(const Simulation& simulation, const std::string& name) {
  return dynamic_cast<const DeviceType&>(
      simulation.device(0, simulation.find_device(0, name).value()));
}

const std::vector<Blob>& blobs(const Simulation& simulation) {
  return device<Blobfinder>(simulation, "blobfinder").reading().blobs;
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

std::array<int, 4> edges(const Blob& blob) {
  return {blob.left, blob.right, blob.top, blob.bottom};
}

// --- projection

TEST(PinholeView, FocalLength_FromAngle) {
  const PinholeView view{80, 60, kPi / 3.0};
  EXPECT_NEAR(view.focal_px(), 40.0 * std::sqrt(3.0), 1e-12);  // 40 / tan 30
  // The centres of the outer columns are half a pixel inside of 30 degrees.
  EXPECT_NEAR(view.slope(0), 39.5 / view.focal_px(), 1e-12);
  EXPECT_NEAR(view.slope(79), -39.5 / view.focal_px(), 1e-12);
}

TEST(PinholeView, Rows_FromHeightDepthAndTilt) {
  PinholeView view{80, 60, kPi / 3.0};
  EXPECT_EQ(view.row_px(2.0, 0.0), 30.0);  // at the height of the lens: the centre
  EXPECT_NEAR(view.row_px(2.0, -0.2), 30.0 + 6.9282032, 1e-6);
  EXPECT_EQ(view.row_px(2.0, std::numeric_limits<double>::infinity()),
            -std::numeric_limits<double>::infinity());
  view.tilt_rad = 10.0 * kDegrees;  // looking up moves objects down: 69.282 * tan 10 = 12.216
  EXPECT_NEAR(view.row_px(2.0, 0.0), 42.2163, 1e-4);
}

// --- blobfinder

TEST(Blobfinder, BoxAhead_HasEdgesOfItsFace) {
  // The face is at x = 4, 2 m ahead, 0.4 m wide and 0.3 m high; the lens is 0.1 m high. f = 69.282.
  // Columns: 40 -+ f 0.1 = 33.07 .. 46.93, with centres 33.5 .. 46.5. Rows: from 30 - f 0.2 / 2 =
  // 23.07, so from 23, to 30 + f 0.1 / 2 = 33.46, so to 32 (its centre is 32.5).
  Simulation simulation(room(R"({"blobfinder": {"height": 0.1}})",
                             box(4.2, 4, 0.4, R"(, "height": 0.3, "colour": "#ff0000")")));
  EXPECT_THAT(blobs(simulation), IsEmpty());
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  const Blob& blob = blobs(simulation)[0];
  EXPECT_EQ(edges(blob), (std::array{33, 46, 23, 32}));
  EXPECT_EQ(blob.area, 14 * 10);
  EXPECT_EQ(blob.x, 40);  // the centre of 33 .. 47 is 40.0
  EXPECT_EQ(blob.y, 28);  // the centre of 23 .. 33 is 28.0
  EXPECT_EQ(blob.colour, kRed);
  // The mean of 2 sqrt(1 + t^2), t = 0.5 / f, 1.5 / f ... 6.5 / f: 2 + mean t^2, about.
  EXPECT_NEAR(blob.range_m, 2.0 + 16.25 / (69.282 * 69.282), 1e-5);
  EXPECT_EQ(device<Blobfinder>(simulation, "blobfinder").reading().width, 80);
  EXPECT_EQ(device<Blobfinder>(simulation, "blobfinder").reading().height, 60);
}

TEST(Blobfinder, LowObjects_SeenFromAbove) {
  // The lens is 0.3 m high, the box 0.1 m. Its front covers 30 + f 0.2 / 2 = 36.93 to 30 + f 0.3 /
  // 2 = 40.39. Its top ends at the far edge, 2.4 m away, at 30 + f 0.2 / 2.4 = 35.77: rows 36 ..
  // 39.
  Simulation simulation(room(R"({"blobfinder": {"height": 0.3}})",
                             box(4.2, 4, 0.4, R"(, "height": 0.1, "colour": "#f00")")));
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  EXPECT_EQ(edges(blobs(simulation)[0]), (std::array{33, 46, 36, 39}));
  // At its far edge the top is narrower in the picture, 40 -+ f 0.2 / 2.4 = 34.23 .. 45.77. So
  // columns 33, 34 (centre 34.5), 45 and 46 leave it at the sides, at most 2.4 m away.
  EXPECT_NEAR(blobs(simulation)[0].range_m, 2.0, 0.01);
}

TEST(Blobfinder, TwoColours_RightToLeft) {
  // Each box is 2 m ahead and 0.5 m to one side. The left one's face covers 40 - f (0.25 +- 0.1),
  // 15.75 .. 29.61; its inner side continues to the far corner at 40 - f 0.3 / 2.4 = 31.34. The
  // right one covers 48.66 to 64.25.
  const std::string two = box(4.2, 4.5, 0.4, R"(, "height": 0.3, "colour": "#ff0000")") + ", " +
                          box(4.2, 3.5, 0.4, R"(, "height": 0.3, "colour": "#0000ff80")");
  Simulation simulation(room(R"({"blobfinder": {"height": 0.3}})", two));
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(2));
  EXPECT_EQ(blobs(simulation)[0].colour, kBlue);  // opaque, unlike in pictures of the scene
  EXPECT_EQ(blobs(simulation)[0].left, 49);
  EXPECT_EQ(blobs(simulation)[0].right, 63);
  EXPECT_EQ(blobs(simulation)[1].colour, kRed);
  EXPECT_EQ(blobs(simulation)[1].left, 16);
  EXPECT_EQ(blobs(simulation)[1].right, 30);
}

TEST(Blobfinder, OtherColours_Ignored) {
  const std::string two = box(4, 4.5, 0.2, R"(, "colour": "#ff0000")") + ", " +
                          box(4, 3.5, 0.2, R"(, "colour": "#0000ff")");
  Simulation simulation(room(R"({"blobfinder": {"colours": ["#00f", "#00ff00"]}})", two));
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  EXPECT_EQ(blobs(simulation)[0].colour, kBlue);
}

TEST(Blobfinder, RobotsAndColouredObjects_Only) {
  // A box without a colour, and a robot whose flat front is 2 - 0.087 m away and 0.18 m high.
  Simulation simulation(room(R"({"blobfinder": {"height": 0.1}})", box(4, 5, 0.3, ""),
                             R"(, {"name": "r2", "colour": "#00f", "pose": {"x": 4, "y": 4,
                             "yaw_deg": 180}})"));
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  const Blob& blob = blobs(simulation)[0];
  EXPECT_EQ(blob.colour, kBlue);
  // 30 - f 0.08 / 1.913 = 27.1 and 30 + f 0.1 / 1.913 = 33.6.
  EXPECT_EQ(blob.top, 27);
  EXPECT_EQ(blob.bottom, 33);
  ASSERT_FALSE(simulation.set_object_colour("r2", kRed).has_value());
  run(simulation, 10);
  EXPECT_EQ(blobs(simulation).at(0).colour, kRed);
}

TEST(Blobfinder, NearerObjects_HideFartherUpToTheirHeight) {
  const std::string far_box = box(5.2, 4, 0.4, R"(, "height": 0.6, "colour": "#ff0000")");
  const auto seen = [&](const std::string& near_box) {
    Simulation simulation(room(R"({"blobfinder": {"height": 0.1}})", far_box + ", " + near_box));
    run(simulation, 10);
    return blobs(simulation);
  };
  // Alone, its face 3 m away covers columns 40 -+ f 0.2 / 3 = 35.4 .. 44.6 and rows 30 - f 0.5 / 3
  // = 18.45 to 30 + f 0.1 / 3 = 32.3.
  const std::vector<Blob> alone = seen(box(7, 7, 0.2, ""));
  ASSERT_THAT(alone, SizeIs(1));
  EXPECT_EQ(edges(alone[0]), (std::array{35, 44, 18, 31}));
  // Behind an uncoloured box 1 m away, 0.6 m wide and equally high.
  EXPECT_THAT(seen(box(3.3, 4, 0.6, R"(, "height": 0.6)")), IsEmpty());
  // If that box is 0.2 m high, it ends at row 30 - f 0.1 = 23.07 and includes row 23.
  const std::vector<Blob> over = seen(box(3.3, 4, 0.6, R"(, "height": 0.2)"));
  ASSERT_THAT(over, SizeIs(1));
  EXPECT_EQ(edges(over[0]), (std::array{35, 44, 18, 22}));
  // With equal colours the two are one blob; the range is that of their nearer parts.
  const std::vector<Blob> one = seen(box(3.3, 4, 0.6, R"(, "height": 0.2, "colour": "#f00")"));
  ASSERT_THAT(one, SizeIs(1));
  EXPECT_EQ(one[0].top, 18);
  EXPECT_NEAR(one[0].range_m, 1.03, 0.02);
}

TEST(Blobfinder, ColumnInFront_SplitsBlob) {
  // A post 1 m away, 0.1 m wide: 40 -+ f 0.05 = 36.5 .. 43.5, inside of 26.1 .. 53.9.
  Simulation simulation(
      room(R"({"blobfinder": {}})", box(4.4, 4, 0.8, R"(, "height": 0.5, "colour": "#f00")") +
                                        ", " + box(3.05, 4, 0.1, R"(, "height": 1)")));
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(2));
  EXPECT_EQ(blobs(simulation)[0].right, 53);
  EXPECT_GT(blobs(simulation)[0].left, 42);
  EXPECT_LT(blobs(simulation)[1].right, 37);
  EXPECT_EQ(blobs(simulation)[1].left, 26);
}

TEST(Blobfinder, MapWalls_HideObjects) {
  // A wall to the left of y = 4, 1 m away, of unlimited height: of the box behind it, only the
  // columns from 40 on are visible.
  WorldDescription world = room(R"({"blobfinder": {"height": 0.1}, "camera": {"height": 0.1}})",
                                box(4.2, 4, 0.4, R"(, "height": 0.3, "colour": "#f00")"));
  world.arena.walls.push_back({{{3.0, 4.0}, {3.2, 4.0}, {3.2, 6.0}, {3.0, 6.0}}});
  Simulation simulation(world);
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  EXPECT_EQ(edges(blobs(simulation)[0]), (std::array{40, 46, 23, 32}));
  // 0.95 (0x45, 0x4b, 0x54), up to the top row.
  const CameraReading& picture = device<Camera>(simulation, "camera").reading();
  const std::size_t pixel = 3 * 39;
  EXPECT_EQ(picture.pixels[pixel], 66);
  EXPECT_EQ(picture.pixels[pixel + 1], 71);
  EXPECT_EQ(picture.pixels[pixel + 2], 80);
  EXPECT_NE(picture.pixels[pixel + 3], 66);
}

TEST(Blobfinder, RangeAndExtension_Limit) {
  const std::string block = box(4, 4, 0.2, R"(, "type": "dynamic", "name": "d", "colour": "#f00")");
  Simulation near_sighted(room(R"({"blobfinder": {"range_max": 1.89}})", block));
  run(near_sighted, 10);
  EXPECT_THAT(blobs(near_sighted), IsEmpty());  // its face is 1.9 m away
  Simulation simulation(room(R"({"blobfinder": {"range_max": 1.95}})", block));
  run(simulation, 10);
  EXPECT_THAT(blobs(simulation), SizeIs(1));
  ASSERT_FALSE(simulation.set_obstacle_state("d", ObstacleState::kRetracted).has_value());
  run(simulation, 10);
  EXPECT_THAT(blobs(simulation), IsEmpty());
}

TEST(Blobfinder, Mounting_SetsDirection) {
  // There is a box to the left; the lens is 0.2 m to the left of the robot's centre.
  Simulation simulation(room(R"({"blobfinder": {"pose": {"y": 0.2, "yaw_deg": 90}}})",
                             box(2, 6.2, 0.4, R"(, "height": 0.4, "colour": "#f00")")));
  run(simulation, 10);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  EXPECT_EQ(blobs(simulation)[0].x, 40);
  // 1.8 m away: 40 -+ f 0.2 / 1.8 = 32.3 .. 47.7.
  EXPECT_EQ(blobs(simulation)[0].left, 32);
  EXPECT_EQ(blobs(simulation)[0].right, 47);
}

TEST(Blobfinder, RangeNoise_HasDeviation) {
  Simulation simulation(room(R"({"blobfinder": {"frequency": 100, "noise": 0.05}})",
                             box(4.2, 4, 0.4, R"(, "height": 0.3, "colour": "#f00")")));
  constexpr int kReadings = 1000;
  const double truth = 2.0 + 16.25 / (69.282 * 69.282);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kReadings; ++i) {
    simulation.step();
    const double error = blobs(simulation).at(0).range_m - truth;
    sum += error;
    squares += error * error;
  }
  // Four standard errors: of a mean sigma / sqrt(n), of a deviation sigma / sqrt(2 n).
  EXPECT_NEAR(sum / kReadings, 0.0, 4.0 * 0.05 / std::sqrt(kReadings));
  EXPECT_NEAR(std::sqrt(squares / kReadings), 0.05, 4.0 * 0.05 / std::sqrt(2.0 * kReadings));
}

TEST(Blobfinder, InvalidSettings_Refused) {
  const auto issue_of = [](const std::string& settings) -> ConfigIssue {
    try {
      const Simulation simulation(room(R"({"blobfinder": )" + settings + "}"));
    } catch (const ConfigError& error) {
      return error.issues().at(0);
    }
    return {};
  };
  EXPECT_EQ(issue_of(R"({"image": [80, 481]})").id, "device/image-height");
  EXPECT_EQ(issue_of(R"({"image": [641, 60]})").id, "world/out-of-range");
  EXPECT_EQ(issue_of(R"({"field_of_view_deg": 180})").id, "world/out-of-range");
  const ConfigIssue colour = issue_of(R"({"colours": ["#f00", "orange"]})");
  EXPECT_EQ(colour.id, "world/bad-colour");
  EXPECT_EQ(colour.pointer, "/robots/0/devices/blobfinder/colours/1");
  EXPECT_THAT(colour.found, HasSubstr("\"orange\""));
  const ConfigIssue head = issue_of(R"({"ptz": "neck"})");
  EXPECT_EQ(head.id, "device/wiring");
  EXPECT_THAT(head.expected, HasSubstr("\"neck\" on robot r1"));
}

// --- ptz

void command(Simulation& simulation, const Command& what) {
  const auto refusal = simulation.apply({0, simulation.find_device(0, "ptz").value()}, what);
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

TEST(Ptz, Speeds_LimitTravel) {
  Simulation simulation(room(R"({"ptz": {"frequency": 100}})"));
  const PtzReading& reading = device<Ptz>(simulation, "ptz").reading();
  run(simulation, 1);
  EXPECT_EQ(reading.pan_rad, 0.0);
  EXPECT_NEAR(reading.view_rad, 60.0 * kDegrees, 1e-12);
  EXPECT_FALSE(reading.moving);
  command(simulation, PointCommand{40.0 * kDegrees, -10.0 * kDegrees, 30.0 * kDegrees});
  run(simulation, 20);
  // 80, 50 and 30 degrees/s: after 0.2 s 16 degrees of pan, all 10 of tilt, 6 of the 30 of zoom.
  EXPECT_NEAR(reading.pan_rad, 16.0 * kDegrees, 1e-9);
  EXPECT_NEAR(reading.pan_speed_radps, 80.0 * kDegrees, 1e-9);
  EXPECT_NEAR(reading.tilt_rad, -10.0 * kDegrees, 1e-9);
  EXPECT_NEAR(reading.view_rad, 54.0 * kDegrees, 1e-9);
  EXPECT_TRUE(reading.moving);
  run(simulation, 29);
  EXPECT_NEAR(reading.pan_rad, 39.2 * kDegrees, 1e-9);
  run(simulation, 52);
  EXPECT_EQ(reading.pan_rad, 40.0 * kDegrees);  // exactly at its goal
  EXPECT_EQ(reading.view_rad, 30.0 * kDegrees);
  EXPECT_EQ(reading.pan_speed_radps, 0.0);
  EXPECT_FALSE(reading.moving);
}

TEST(Ptz, Limits_Stop) {
  Simulation simulation(
      room(R"({"ptz": {"frequency": 100, "pan_max_deg": 30, "field_of_view_min_deg": 20}})"));
  const PtzReading& reading = device<Ptz>(simulation, "ptz").reading();
  command(simulation, PointCommand{2.0, 1.0, 0.01});
  run(simulation, 300);
  EXPECT_NEAR(reading.pan_rad, 30.0 * kDegrees, 1e-12);
  EXPECT_NEAR(reading.tilt_rad, 25.0 * kDegrees, 1e-12);
  EXPECT_NEAR(reading.view_rad, 20.0 * kDegrees, 1e-12);
  // a field of view of 0 is invalid: it stays unchanged
  command(simulation, PointCommand{0.0, 0.0, 0.0, 0.1});
  run(simulation, 100);
  EXPECT_NEAR(reading.pan_rad, 30.0 * kDegrees - 0.1, 1e-9);  // at 0.1 rad/s
  EXPECT_NEAR(reading.view_rad, 20.0 * kDegrees, 1e-12);
}

TEST(Ptz, SpeedCommands_TurnUntilReplaced) {
  Simulation simulation(room(R"({"ptz": {"frequency": 100}})"));
  const PtzReading& reading = device<Ptz>(simulation, "ptz").reading();
  command(simulation, PanCommand{-0.5, 10.0, -0.2});
  run(simulation, 10);
  EXPECT_NEAR(reading.pan_rad, -0.05, 1e-9);
  EXPECT_NEAR(reading.tilt_rad, 5.0 * kDegrees, 1e-9);  // at most 50 degrees/s
  EXPECT_NEAR(reading.view_rad, 60.0 * kDegrees - 0.02, 1e-9);
  command(simulation, PanCommand{});
  run(simulation, 10);
  EXPECT_NEAR(reading.pan_rad, -0.05, 1e-9);
  command(simulation, PanCommand{-1.0, 0.0, 0.0});
  run(simulation, 500);
  EXPECT_NEAR(reading.pan_rad, -100.0 * kDegrees, 1e-9);
  EXPECT_FALSE(reading.moving);
}

TEST(Ptz, MountedBlobfinder_Turns) {
  // A box 30 degrees to the left, 2 m away, rotated so that its face is perpendicular to the view.
  const std::string to_left =
      box(2 + 2.1 * std::cos(30 * kDegrees), 4 + 2.1 * std::sin(30 * kDegrees), 0.2,
          R"(, "yaw_deg": 30, "height": 0.4, "colour": "#f00")");
  Simulation simulation(
      room(R"({"ptz": {}, "blobfinder": {"ptz": "ptz", "height": 0.2}})", to_left));
  command(simulation, PointCommand{30.0 * kDegrees, 0.0, 0.0});
  run(simulation, 100);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  // f 0.1 / 2 = 3.46 to either side, f 0.2 / 2 = 6.93 up and down.
  EXPECT_EQ(edges(blobs(simulation)[0]), (std::array{37, 42, 23, 36}));
  // With a field of view of half the size: 40 / tan 15 = 149.3, so 7.46 and 14.9.
  command(simulation, PointCommand{30.0 * kDegrees, 0.0, 30.0 * kDegrees});
  run(simulation, 200);
  ASSERT_THAT(blobs(simulation), SizeIs(1));
  EXPECT_EQ(edges(blobs(simulation)[0]), (std::array{33, 46, 15, 44}));
  // Tilting up by 3 degrees moves it down by 149.3 tan 3 = 7.82: 22.89 .. 52.76.
  command(simulation, PointCommand{30.0 * kDegrees, 3.0 * kDegrees, 0.0});
  run(simulation, 100);
  EXPECT_EQ(edges(blobs(simulation).at(0)), (std::array{33, 46, 23, 52}));
}

TEST(Ptz, InvalidView_Refused) {
  try {
    static_cast<void>(
        room(R"({"ptz": {"field_of_view_min_deg": 50, "field_of_view_max_deg": 40}})"));
    FAIL() << "limits the wrong way round were read";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().at(0).id, "device/ptz-field-of-view");
  }
}

// --- camera

struct Pixels {
  const CameraReading& reading;
  [[nodiscard]] Colour at(int column, int row) const {
    const auto first = static_cast<std::size_t>(3 * (row * reading.width + column));
    return {reading.pixels[first], reading.pixels[first + 1], reading.pixels[first + 2], 255};
  }
};

TEST(Camera, Colours_DarkerWithDepth) {
  EXPECT_EQ(brightness(0.0, 12.0), 1.0);
  EXPECT_NEAR(brightness(2.0, 12.0), 0.9, 1e-12);
  EXPECT_NEAR(brightness(20.0, 12.0), 0.4, 1e-12);

  // The box of the blobfinder's first test; its face is perpendicular to x, so its brightness is 1.
  Simulation simulation(room(R"({"camera": {"height": 0.1}})",
                             box(4.2, 4, 0.4, R"(, "height": 0.3, "colour": "#c88020")")));
  run(simulation, 10);
  const CameraReading& reading = device<Camera>(simulation, "camera").reading();
  EXPECT_EQ(reading.width, 80);
  EXPECT_EQ(reading.height, 60);
  ASSERT_THAT(reading.pixels, SizeIs(80 * 60 * 3));
  const Pixels pixels{reading};
  // 0.9 (200, 128, 32) = (180, 115.2, 28.8)
  const Colour side{180, 115, 29, 255};
  for (const auto& [column, row] :
       {std::pair(33, 23), std::pair(46, 23), std::pair(33, 32), std::pair(46, 32)}) {
    EXPECT_EQ(pixels.at(column, row), side) << column << ", " << row;
  }
  for (const auto& [column, row] :
       {std::pair(32, 23), std::pair(47, 23), std::pair(33, 22), std::pair(46, 33)}) {
    EXPECT_NE(pixels.at(column, row), side) << column << ", " << row;
  }
  EXPECT_EQ(pixels.at(0, 0), pixels.at(79, 0));  // air over the border
  // The lowest row sees the floor at 69.282 * 0.1 / 29.5 = 0.2349 m: 0.98826 (252, 251, 248).
  EXPECT_EQ(pixels.at(40, 59), (Colour{249, 248, 245, 255}));
  // The border, 6 m ahead and 0.16 m high, appears in row 30 - f 0.06 / 6 = 29.3, centre 29.5: 0.7
  // (140, 94, 60).
  EXPECT_EQ(pixels.at(20, 29), (Colour{98, 66, 42, 255}));
}

TEST(Camera, Sides_LitByNormalAndTopsFully) {
  // The lens is 0.3 m high, the box 0.1 m and rotated by 90 degrees. A face is perpendicular to x
  // again, from 36.93 down to 40.39; the top begins at 35.77, so it covers row 36, with the
  // brightness of the front.
  const auto pixel = [](double yaw_deg, int row) {
    Simulation simulation(
        room(R"({"camera": {"height": 0.3}})",
             box(4.2, 4, 0.4,
                 R"(, "height": 0.1, "colour": "#c8c8c8", "yaw_deg": )" + fixed_text(yaw_deg, 6))));
    run(simulation, 10);
    return Pixels{device<Camera>(simulation, "camera").reading()}.at(40, row).r;
  };
  EXPECT_EQ(pixel(90.0, 38), 180);
  EXPECT_EQ(pixel(90.0, 36), 180);
  // Rotated by 20 degrees: 0.85 + 0.15 cos 40 = 0.9649. The middle column hits the face at 4.2 -
  // 0.2 / cos 20 - 0.0005, 1.987 m away: 200 * 0.9649 * 0.90065 = 173.8; the top is 200 * 0.90065 =
  // 180.1.
  EXPECT_EQ(pixel(20.0, 38), 174);
  EXPECT_EQ(pixel(20.0, 36), 180);
}

}  // namespace
}  // namespace sim
