// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <thread>

#include "fake_session.h"
#include "libCCMorse/WindowProxy.h"

namespace {

using CCMorse::ImageColour_t;
using CCMorse::ImagePoint_t;
using CCMorse::PlayerClient;
using CCMorse::WindowProxy;
using PlayerCc::PlayerError;
using test::error_code_of;
using test::fake_session;
using test::FakeWorld;
using test::make_fake_world;
using testing::ElementsAre;
using testing::FieldsAre;
using testing::HasSubstr;

typedef unsigned char uchar;

class Window : public testing::Test {
 protected:
  ~Window() override { delete &window; }

  std::shared_ptr<FakeWorld> world = make_fake_world();
  PlayerClient client{fake_session(world)};
  WindowProxy& window = WindowProxy::GetInstance(&client, 172, 186);
};

TEST(WindowInstances, NoneUntilMade) {
  EXPECT_EQ(error_code_of([] { WindowProxy::GetInstance(); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([] { WindowProxy::GetInstance(nullptr, 172, 186); }),
            PlayerError::kBadArgument);
}

TEST(WindowInstances, Deleted_MadeAnew) {
  auto world = make_fake_world();
  PlayerClient client(fake_session(world));
  WindowProxy& first = WindowProxy::GetInstance(&client, 172, 186);
  EXPECT_EQ(&WindowProxy::GetInstance(), &first);
  EXPECT_EQ(&WindowProxy::GetInstance(&client, 172, 186), &first);
  delete &WindowProxy::GetInstance();
  EXPECT_EQ(error_code_of([] { WindowProxy::GetInstance(); }), PlayerError::kNotAvailable);
  WindowProxy& second = WindowProxy::GetInstance(&client, 172, 186);
  EXPECT_EQ(&WindowProxy::GetInstance(), &second);
  delete &WindowProxy::GetInstance();
}

TEST(WindowInstances, AnySize_ShowsWholeGridMap) {
  auto world = make_fake_world();
  PlayerClient client(fake_session(world));
  WindowProxy& window = WindowProxy::GetInstance(&client, 100, 200);
  EXPECT_EQ(window.GetWidth(), 172);
  EXPECT_EQ(window.GetHeight(), 186);
  delete &window;
  for (const auto& size : {std::pair(0, 186), std::pair(172, -1)}) {
    EXPECT_EQ(error_code_of([&] { WindowProxy::GetInstance(&client, size.first, size.second); }),
              PlayerError::kBadArgument);
  }
}

TEST(WindowInstances, EachClient_NewestIsFound) {
  auto world = make_fake_world();
  auto other_world = make_fake_world();
  PlayerClient client(fake_session(world));
  auto other = std::make_unique<PlayerClient>(fake_session(other_world));
  WindowProxy& first = WindowProxy::GetInstance(&client, 172, 186);
  WindowProxy& second = WindowProxy::GetInstance(other.get(), 172, 186);
  EXPECT_EQ(&WindowProxy::GetInstance(), &second);
  other.reset();
  EXPECT_EQ(&WindowProxy::GetInstance(), &first) << "the other's client is gone";
  EXPECT_EQ(error_code_of([&] { second.SetPixel(1, 1, 255, 0, 0); }), PlayerError::kDisconnected);
  EXPECT_EQ(second.GetX(0.05), 2) << "what needs no client still works";
  delete &second;
  delete &first;
}

TEST_F(Window, ColumnsAndRows_FollowCanvas) {
  EXPECT_EQ(window.GetWidth(), 172);
  EXPECT_EQ(window.GetHeight(), 186);
  EXPECT_DOUBLE_EQ(window.GetCellSize(), 0.02);
  // column = floor(x / 0.02); row = 185 - floor(y / 0.02).
  EXPECT_EQ(window.GetX(0.0), 0);
  EXPECT_EQ(window.GetX(0.51), 25);
  EXPECT_EQ(window.GetX(-0.01), -1);
  EXPECT_EQ(window.GetY(0.0), 185);
  EXPECT_EQ(window.GetY(3.71), 0);
  EXPECT_EQ(window.GetY(4.0), 185 - 200);
  EXPECT_EQ(window.GetPoint(0.51, 3.71), ImagePoint_t(25, 0));
  EXPECT_EQ(error_code_of([&] { window.GetX(std::nan("")); }), PlayerError::kBadArgument);
  EXPECT_GT(window.GetX(1e300), 1000000);
}

TEST_F(Window, Colours_AcceptedInSeveralForms) {
  int x = 0;
  const auto next = [&] { return x++; };
  const auto drawn = [&] { return window.GetPixel(x - 1, 7); };
  window.SetPixel(next(), 7, 255, 0, 254);
  EXPECT_EQ(drawn(), ImageColour_t(255, 0, 254));
  window.SetPixel(next(), 7, 0, 0, 255, 255);
  EXPECT_EQ(drawn(), ImageColour_t(0, 0, 255));
  window.SetPixel(next(), 7, 1.0, 0.5, 0.0);
  EXPECT_EQ(drawn(), ImageColour_t(255, 128, 0));
  window.SetPixel(next(), 7, 1.0f, 0.5f, 0.0f, 1.0f);
  EXPECT_EQ(drawn(), ImageColour_t(255, 128, 0));
  window.SetPixel(next(), 7, 0, 0.5, 1);  // one argument is floating-point: all are fractions
  EXPECT_EQ(drawn(), ImageColour_t(0, 128, 255));
  window.SetPixel(next(), 7, 1U, 2UL, 3LL);
  EXPECT_EQ(drawn(), ImageColour_t(1, 2, 3));
  window.SetPixel(next(), 7, uchar(4), short(5), std::size_t(6));
  EXPECT_EQ(drawn(), ImageColour_t(4, 5, 6));
  window.SetPixel(next(), 7, -5, 300, 256);
  EXPECT_EQ(drawn(), ImageColour_t(0, 255, 255));
  window.SetPixel(next(), 7, -0.5, 1.5, 2.0);
  EXPECT_EQ(drawn(), ImageColour_t(0, 255, 255));
  window.SetPixel(next(), 7, "#34AAFF");
  EXPECT_EQ(drawn(), ImageColour_t(0x34, 0xaa, 0xff));
  window.SetPixel(next(), 7, std::string("#3af"), 255);
  EXPECT_EQ(drawn(), ImageColour_t(0x33, 0xaa, 0xff));
  window.SetPixel(next(), 7, "#34AAFFff", 1.0);
  EXPECT_EQ(drawn(), ImageColour_t(0x34, 0xaa, 0xff));
  window.SetPixel(next(), 7, ImageColour_t(9, 8, 7));
  EXPECT_EQ(drawn(), ImageColour_t(9, 8, 7));
  window.SetPixel(next(), 7, {6, 5, 4});
  EXPECT_EQ(drawn(), ImageColour_t(6, 5, 4));
  window.SetPixel(ImagePoint_t(next(), 7), 1, 1, 1);
  EXPECT_EQ(drawn(), ImageColour_t(1, 1, 1));
  // Students do so despite compiler warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
  window.SetPixel(static_cast<unsigned>(next()), 7L, 2, 2, 2);
#pragma GCC diagnostic pop
  EXPECT_EQ(drawn(), ImageColour_t(2, 2, 2));
}

TEST_F(Window, InvalidColours_Refused) {
  EXPECT_EQ(error_code_of([&] { window.SetPixel(1, 1, std::nan(""), 0.0, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { window.SetPixel(1, 1, "green"); }), PlayerError::kBadArgument);
  window.GetPixel(1, 1);
  EXPECT_EQ(world->drawn, 0U);
}

TEST_F(Window, Alpha_BlendsOverExistingCells) {
  window.Clear(0, 0, 0);
  window.SetPixel(3, 3, 255, 255, 255, 128);
  // Source-over: 255 * 128/255 + 0.
  EXPECT_NEAR(window.GetPixel(3, 3).r, 128, 1);
  window.SetPixel(3, 3, 255, 255, 255, 0);
  EXPECT_NEAR(window.GetPixel(3, 3).r, 128, 1);
}

TEST_F(Window, Lines_DrawBothEnds) {
  window.SetLine(1, 2, 4, 2, 0, 255, 0);
  for (int x = 1; x <= 4; ++x) EXPECT_EQ(window.GetPixel(x, 2), ImageColour_t(0, 255, 0)) << x;
  EXPECT_EQ(window.GetPixel(0, 2).a, 0);
  EXPECT_EQ(window.GetPixel(5, 2).a, 0);
  window.SetLine(1, 5, 4, 5, 0.0, 1.0, 0.0, 1.0);
  EXPECT_EQ(window.GetPixel(4, 5), ImageColour_t(0, 255, 0));
  window.SetLine(1, 6, 4, 6, "#00ff00");
  window.SetLine(1, 7, 4, 7, "#00ff00", 0.5);
  window.SetLine(1, 8, 4, 8, 0, 255, 0, 128);
  window.SetLine(ImagePoint_t(1, 9), ImagePoint_t(4, 9), 0, 255, 0);
  window.SetLine({1, 10}, {4, 10}, "#00ff00");
  for (const int row : {6, 9, 10}) EXPECT_EQ(window.GetPixel(4, row), ImageColour_t(0, 255, 0));
  for (const int row : {7, 8}) EXPECT_NEAR(window.GetPixel(4, row).a, 128, 1);
  window.SetLine(-1000000, 11, 1000000, 11, 1, 2, 3);  // clipped
  EXPECT_EQ(window.GetPixel(171, 11), ImageColour_t(1, 2, 3));
}

TEST_F(Window, Clear_FillsEveryCell) {
  window.Clear("#102030");
  EXPECT_EQ(window.GetPixel(171, 185), ImageColour_t(0x10, 0x20, 0x30));
  window.Clear(0.0, 0.0, 1.0, 0.5);
  EXPECT_EQ(window.GetPixel(0, 0), ImageColour_t(0, 0, 255, 128));
  window.Clear();
  EXPECT_EQ(window.GetPixel(0, 0), ImageColour_t(0, 0, 0, 0));
}

TEST_F(Window, Pixels_ReadInSeveralForms) {
  window.SetPixel(5, 5, 255, 51, 0);
  uchar r = 1, g = 1, b = 1;
  window.GetPixel(5, 5, r, g, b);
  EXPECT_EQ(g, 51);
  int ri = 0, gi = 0, bi = 0, ai = 0;
  window.GetPixel(5, 5, ri, gi, bi, ai);
  EXPECT_EQ(ri, 255);
  EXPECT_EQ(ai, 255);
  double rd = 0.0, gd = 0.0, bd = 0.0;
  window.GetPixel(5, 5, rd, gd, bd);
  EXPECT_DOUBLE_EQ(rd, 1.0);
  EXPECT_DOUBLE_EQ(gd, 0.2);  // 51 of 255
  EXPECT_DOUBLE_EQ(bd, 0.0);
  std::string text;
  window.GetPixel(5, 5, text);
  EXPECT_EQ(text, "#ff3300");
  EXPECT_EQ(error_code_of([&] { window.GetPixel(172, 0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { window.GetPixel(0, -1); }), PlayerError::kBadArgument);
}

TEST_F(Window, Positions_DrawnInTheirCells) {
  // Column floor(x / 0.02), row 185 - floor(y / 0.02).
  window.SetPixelMetres(0.05, 0.03, 255, 0, 0);
  EXPECT_EQ(window.GetPixel(2, 184), ImageColour_t(255, 0, 0));
  window.SetPixelMetres(1, 1, "#00ff00");
  EXPECT_EQ(window.GetPixel(50, 135), ImageColour_t(0, 255, 0));
  window.SetLineMetres(0.01, 3.71, 0.07, 3.71, 0.0, 0.0, 1.0);
  for (int x = 0; x <= 3; ++x) EXPECT_EQ(window.GetPixel(x, 0), ImageColour_t(0, 0, 255)) << x;
  EXPECT_EQ(window.GetPixel(4, 0).a, 0);
  window.SetPolylineMetres({{0.01, 2.01}, {0.05, 2.01}, {0.05, 2.05}}, 1, 2, 3);
  EXPECT_EQ(window.GetPixel(1, 85), ImageColour_t(1, 2, 3));
  EXPECT_EQ(window.GetPixel(2, 84), ImageColour_t(1, 2, 3));
  EXPECT_EQ(window.GetPixel(2, 83), ImageColour_t(1, 2, 3));
  window.SetPolylineMetres({{3.01, 2.01}}, 1, 2, 3);
  EXPECT_EQ(window.GetPixel(150, 85), ImageColour_t(1, 2, 3));
  window.SetPolylineMetres({}, 1, 2, 3);
  EXPECT_EQ(error_code_of([&] { window.SetPixelMetres(std::nan(""), 0.0, 1, 2, 3); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] {
              window.SetPolylineMetres({{0.0, INFINITY}}, 1, 2, 3);
            }),
            PlayerError::kBadArgument);
}

TEST_F(Window, Discs_HoldCellsWithCentreInRadius) {
  constexpr double kX = 1.003, kY = 2.008, kRadius = 0.11;
  window.SetDiscMetres(kX, kY, kRadius, 255, 0, 0, 100);
  int drawn = 0;
  for (int row = 0; row < 186; ++row) {
    for (int column = 0; column < 172; ++column) {
      const double dx = 0.02 * (column + 0.5) - kX;
      const double dy = 0.02 * (186 - row - 0.5) - kY;
      const bool inside = dx * dx + dy * dy <= kRadius * kRadius;
      // Alpha 100: a cell drawn twice would have a higher value.
      ASSERT_EQ(window.GetPixel(column, row).a, inside ? 100 : 0) << column << ", " << row;
      drawn += inside ? 1 : 0;
    }
  }
  EXPECT_NEAR(drawn, 3.1416 * 5.5 * 5.5, 6.0);  // the area in cells, to within its rim
  window.Clear();
  window.SetDiscMetres(0.5, 0.5, 0.0, 0, 0, 255);  // no centre is that near: only the cell itself
  EXPECT_EQ(window.GetPixel(25, 160), ImageColour_t(0, 0, 255));
  window.SetDiscMetres(-0.05, -0.05, 0.1, 0, 255, 0);  // clipped
  EXPECT_EQ(window.GetPixel(0, 185), ImageColour_t(0, 255, 0));
  window.SetDiscMetres(1.0, 1.0, 1e6, 9, 9, 9);
  EXPECT_EQ(window.GetPixel(171, 0), ImageColour_t(9, 9, 9));
  EXPECT_EQ(error_code_of([&] { window.SetDiscMetres(0, 0, -1, 9, 9, 9); }),
            PlayerError::kBadArgument);
}

TEST_F(Window, Polygons_HoldCellsWithCentreInside) {
  // A square of 0.2 m with a square hole: both outlines in one polygon, by the even-odd rule.
  window.SetPolygonMetres({{1.0, 1.0},
                           {1.2, 1.0},
                           {1.2, 1.2},
                           {1.0, 1.2},
                           {1.0, 1.0},
                           {1.06, 1.06},
                           {1.06, 1.14},
                           {1.14, 1.14},
                           {1.14, 1.06},
                           {1.06, 1.06}},
                          255, 0, 0, 100);
  for (int row = 120; row < 140; ++row) {
    for (int column = 45; column < 65; ++column) {
      const double x = 0.02 * (column + 0.5);
      const double y = 0.02 * (186 - row - 0.5);
      const bool in_square = x > 1.0 && x < 1.2 && y > 1.0 && y < 1.2;
      const bool in_hole = x > 1.06 && x < 1.14 && y > 1.06 && y < 1.14;
      ASSERT_EQ(window.GetPixel(column, row).a, in_square && !in_hole ? 100 : 0)
          << column << ", " << row;
    }
  }
  window.SetPolygonMetres({{-1e9, -1e9}, {1e9, -1e9}, {0.0, 1e9}}, "#090909");
  EXPECT_EQ(window.GetPixel(0, 0), ImageColour_t(9, 9, 9));
}

TEST_F(Window, WholeImages_SetAndRead) {
  std::vector<std::uint8_t> rgb(172 * 186 * 3);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<std::uint8_t>(i % 251);
  window.SetImage(rgb);
  EXPECT_EQ(window.GetImage(3), rgb);
  EXPECT_EQ(window.GetPixel(1, 0), ImageColour_t(3, 4, 5));
  std::vector<std::uint8_t> rgba;
  window.GetImage(rgba);
  ASSERT_EQ(rgba.size(), 172U * 186 * 4);
  EXPECT_EQ(rgba[7], 255);
  rgba[4] = 99;
  rgba[7] = 10;
  window.SetImage(rgba.data(), rgba.size());
  EXPECT_EQ(window.GetPixel(1, 0), ImageColour_t(99, 4, 5, 10)) << "no blending";
  EXPECT_EQ(window.GetImage(), rgba);
  rgba.pop_back();
  EXPECT_EQ(error_code_of([&] { window.SetImage(rgba); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { window.SetImage(nullptr, 172 * 186 * 3); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { window.GetImage(2); }), PlayerError::kBadArgument);
}

TEST_F(Window, Images_KeepOrderAmongDrawings) {
  window.SetPixel(1, 1, 1, 1, 1);
  window.SetImage(std::vector<std::uint8_t>(172 * 186 * 4, 7));
  window.SetPixel(2, 2, 2, 2, 2);
  EXPECT_EQ(window.GetPixel(1, 1), ImageColour_t(7, 7, 7, 7));
  EXPECT_EQ(window.GetPixel(2, 2), ImageColour_t(2, 2, 2));
}

TEST_F(Window, PixelLists_Drawn) {
  window.UpdateImage(
      {{1, 1, 255, 0, 0}, {2, 1, ImageColour_t(0, 255, 0, 10)}, {-5, 9999, 1, 1, 1}});
  EXPECT_EQ(window.GetPixel(1, 1), ImageColour_t(255, 0, 0));
  EXPECT_EQ(window.GetPixel(2, 1).a, 10);
}

TEST_F(Window, Resize_KeepsDrawingsInPlace) {
  window.SetPixelMetres(0.05, 0.05, 255, 0, 0);
  window.Resize(100, 50);
  EXPECT_EQ(window.GetWidth(), 100);
  EXPECT_EQ(window.GetHeight(), 50);
  EXPECT_EQ(window.GetY(0.05), 47);  // 49 - 2
  EXPECT_EQ(window.GetPixel(2, 47), ImageColour_t(255, 0, 0));
  EXPECT_EQ(window.GetImage().size(), 100U * 50 * 4);
  for (const auto& size : {std::pair(0, 50), std::pair(100, -1), std::pair(8193, 1)}) {
    EXPECT_EQ(error_code_of([&] { window.Resize(size.first, size.second); }),
              PlayerError::kBadArgument);
  }
  EXPECT_EQ(error_code_of([&] {
              window.CreateLayer("a");
              window.Resize(8192, 8192);  // 2^26 cells, twice
            }),
            PlayerError::kNotAvailable);
}

TEST_F(Window, ViewModes_SentToWorld) {
  EXPECT_EQ(window.GetViewMode(), CCMorse::GROUND);
  window.SetViewMode(CCMorse::FULL_SCREEN);
  EXPECT_EQ(world->view_mode, sim::ViewMode::kFullScreen);
  EXPECT_EQ(window.GetViewMode(), CCMorse::ViewMode::FULL_SCREEN);
  window.SetViewMode(CCMorse::MINI_MAP);
  EXPECT_EQ(window.GetViewMode(), CCMorse::MINI_MAP);
  world->view_mode_locked = true;
  EXPECT_EQ(error_code_of([&] { window.SetViewMode(CCMorse::GROUND); }),
            PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { window.SetViewMode(static_cast<CCMorse::ViewMode>(3)); }),
            PlayerError::kBadArgument);
}

TEST_F(Window, Pictures_SavedByWorld) {
  window.SaveImage("map");
  window.SaveImage("big.png", 4);
  EXPECT_THAT(world->saved, ElementsAre(FieldsAre("map", 1, std::nullopt),
                                        FieldsAre("big.png", 4, std::nullopt)));
}

TEST_F(Window, Threads_MayDraw) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 20000;  // more than the queue holds
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this, t] {
      for (int i = 0; i < kRounds; ++i) window.SetPixel(i % 172, t, t, i % 256, 0);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(window.GetPixel(0, 0).a, 255);
  EXPECT_EQ(world->drawn, static_cast<std::size_t>(kThreads) * kRounds) << "none is lost";
  // The last pixel drawn in column 0: i = 172 * 116 = 19952, 19952 % 256 = 240.
  for (int t = 0; t < kThreads; ++t)
    EXPECT_EQ(window.GetPixel(0, t), ImageColour_t(uchar(t), 240, 0));
}

TEST_F(Window, Prints_SizeAndLayers) {
  std::ostringstream out;
  out << window;
  EXPECT_THAT(out.str(), HasSubstr("172\t186\t0.02"));
  EXPECT_THAT(out.str(), HasSubstr("canvas"));
}

}  // namespace
