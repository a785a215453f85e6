// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "fake_session.h"
#include "libCCMorse/WindowProxy.h"
#include "libplayerc++/playerc++.h"

namespace {

using CCMorse::ImageColour_t;
using CCMorse::WindowProxy;
using PlayerCc::Graphics2dProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using test::error_code_of;
using test::fake_session;
using test::make_fake_world;
using testing::ElementsAre;
using testing::HasSubstr;

class Graphics2d : public testing::Test {
 protected:
  ~Graphics2d() override { delete &window; }

  // Positions in the fake world: column x / 0.02, row 185 - y / 0.02.
  ImageColour_t at(int column, int row, const char* layer = "graphics2d") {
    return window.GetLayer(layer).GetPixel(column, row);
  }

  std::shared_ptr<test::FakeWorld> world = make_fake_world();
  PlayerClient client{fake_session(world)};
  WindowProxy& window = WindowProxy::GetInstance(&client, 172, 186);
};

TEST_F(Graphics2d, Points_DrawnInMetres) {
  Graphics2dProxy graphics(&client, 0);
  player_point_2d_t points[] = {{0.01, 0.01}, {1.01, 2.01}, {-5.0, 99.0}};
  graphics.Color(255, 0, 0, 255);
  graphics.DrawPoints(points, 2);
  EXPECT_EQ(at(0, 185), ImageColour_t(255, 0, 0));
  EXPECT_EQ(at(50, 85), ImageColour_t(255, 0, 0));
  graphics.DrawPoints(points, 3);  // one outside
  graphics.Clear();
  EXPECT_EQ(at(50, 85).a, 0);
}

TEST_F(Graphics2d, ColoursWithoutAlpha_Opaque) {
  Graphics2dProxy graphics(&client, 0);
  player_point_2d_t point[] = {{0.01, 0.01}};
  graphics.DrawPoints(point, 1);
  EXPECT_EQ(at(0, 185), ImageColour_t(0, 0, 0)) << "black at first";
  player_color_t colour = {};
  colour.green = 200;
  graphics.Color(colour);
  graphics.DrawPoints(point, 1);
  EXPECT_EQ(at(0, 185), ImageColour_t(0, 200, 0));
  graphics.Clear();
  graphics.Color(0, 0, 255, 100);
  graphics.DrawPoints(point, 1);
  EXPECT_EQ(at(0, 185), ImageColour_t(0, 0, 255, 100));
}

TEST_F(Graphics2d, Lines_JoinPoints) {
  Graphics2dProxy graphics(&client, 0);
  graphics.Color(1, 2, 3, 255);
  player_point_2d_t points[] = {{0.01, 0.01}, {0.09, 0.01}, {0.09, 0.09}, {0.01, 0.09}, {1.0, 1.0}};
  graphics.DrawPolyline(points, 4);
  for (const auto& [x, y] : {std::pair(2, 185), {4, 183}, {2, 181}}) {
    EXPECT_EQ(at(x, y), ImageColour_t(1, 2, 3)) << x << ", " << y;
  }
  EXPECT_EQ(at(0, 183).a, 0) << "not closed";
  graphics.Clear();
  graphics.DrawMultiline(points, 5);
  EXPECT_EQ(at(2, 185), ImageColour_t(1, 2, 3));
  EXPECT_EQ(at(2, 181), ImageColour_t(1, 2, 3));
  EXPECT_EQ(at(4, 183).a, 0) << "pairs are not joined";
  EXPECT_EQ(at(50, 135).a, 0) << "the odd one is left out";
}

TEST_F(Graphics2d, Polygons_ClosedAndOptionallyFilled) {
  Graphics2dProxy graphics(&client, 0);
  graphics.Color(255, 0, 0, 255);
  player_point_2d_t square[] = {{0.01, 0.01}, {0.09, 0.01}, {0.09, 0.09}, {0.01, 0.09}};
  player_color_t fill = {};
  fill.blue = 255;
  fill.alpha = 255;
  graphics.DrawPolygon(square, 4, false, fill);
  EXPECT_EQ(at(0, 183), ImageColour_t(255, 0, 0)) << "the closing edge";
  EXPECT_EQ(at(2, 183).a, 0);
  graphics.DrawPolygon(square, 4, true, fill);
  EXPECT_EQ(at(2, 183), ImageColour_t(0, 0, 255));
  EXPECT_EQ(at(0, 183), ImageColour_t(255, 0, 0)) << "the outline is on top";
  graphics.DrawPolygon(square, 0, true, fill);
}

TEST_F(Graphics2d, Proxies_HaveSeparateLayers) {
  window.CreateLayer("graphics2d_1");
  Graphics2dProxy first(&client, 0);
  {
    Graphics2dProxy second(&client, 0);
    player_point_2d_t point[] = {{0.01, 0.01}};
    second.DrawPoints(point, 1);
    first.Clear();
    EXPECT_THAT(window.GetLayerNames(),
                ElementsAre("canvas", "graphics2d_1", "graphics2d", "graphics2d_2"));
    EXPECT_EQ(at(0, 185, "graphics2d_2").a, 255);
    EXPECT_EQ(at(0, 185).a, 0);
  }
  EXPECT_EQ(at(0, 185, "graphics2d_2").a, 255) << "drawings outlive their proxy";
  Graphics2dProxy third(&client, 0);
  EXPECT_EQ(at(0, 185, "graphics2d_2").a, 0) << "until the next one takes the layer over";
  EXPECT_EQ(window.GetLayerNames().size(), 4U);
}

TEST_F(Graphics2d, InvalidArguments_Refused) {
  Graphics2dProxy graphics(&client, 0);
  player_point_2d_t points[] = {{0.0, 0.0}, {std::nan(""), 0.0}};
  const auto refused = [](auto action) {
    EXPECT_EQ(error_code_of(action), PlayerError::kBadArgument);
  };
  refused([&] { graphics.DrawPoints(points, 2); });
  refused([&] { graphics.DrawPolyline(points, -1); });
  refused([&] { graphics.DrawMultiline(nullptr, 2); });
  refused([&] { graphics.DrawPolygon(points, 2, true, player_color_t{}); });
  EXPECT_EQ(error_code_of([&] { Graphics2dProxy missing(&client, 1); }),
            PlayerError::kNoSuchDevice);
}

TEST_F(Graphics2d, ReportsInterfaceDriverAndCapabilities) {
  Graphics2dProxy graphics(&client);
  EXPECT_EQ(graphics.GetInterfaceStr(), "graphics2d");
  EXPECT_EQ(graphics.GetDriverName(), "pen");
  EXPECT_EQ(graphics.HasCapability(PLAYER_MSGTYPE_CMD, PLAYER_GRAPHICS2D_CMD_POLYGON), 1);
  EXPECT_EQ(graphics.HasCapability(PLAYER_MSGTYPE_DATA, 1), 0);
  EXPECT_THAT(world->subscriptions, testing::IsEmpty());
  std::ostringstream out;
  out << graphics;
  EXPECT_THAT(out.str(), HasSubstr("graphics2d:0"));
}

TEST(Graphics2dClient, RequiredForDrawing) {
  auto world = make_fake_world();
  auto client = std::make_unique<PlayerClient>(fake_session(world));
  Graphics2dProxy graphics(client.get());
  client.reset();
  player_point_2d_t point[] = {{0.0, 0.0}};
  EXPECT_EQ(error_code_of([&] { graphics.DrawPoints(point, 1); }), PlayerError::kDisconnected);
  EXPECT_EQ(error_code_of([&] { graphics.Clear(); }), PlayerError::kDisconnected);
}

}  // namespace
