// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

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
using testing::HasSubstr;

typedef unsigned char uchar;

class Window : public testing::Test {
 protected:
  ~Window() override { delete &window; }

  std::shared_ptr<FakeWorld> world = make_fake_world();
  PlayerClient client{fake_session(world)};
  WindowProxy& window = WindowProxy::GetInstance(&client, 172, 186);
};

TEST(WindowInstances, ThereIsNoneUntilMade) {
  EXPECT_EQ(error_code_of([] { WindowProxy::GetInstance(); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([] { WindowProxy::GetInstance(nullptr, 172, 186); }),
            PlayerError::kBadArgument);
}

TEST(WindowInstances, DeletedOnesAreMadeAnew) {
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

TEST(WindowInstances, ShowTheWholeGridMapWhateverSizeIsAskedFor) {
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

TEST(WindowInstances, EachClientMayHaveOneAndTheNewestIsFound) {
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

TEST_F(Window, ColumnsAndRowsFollowTheCanvas) {
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

TEST_F(Window, ColoursMayBeWrittenInManyWays) {
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
  window.SetPixel(next(), 7, 0, 0.5, 1);  // one of them floating: all are shares
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
  window.SetPixel(static_cast<unsigned>(next()), 7L, 2, 2, 2);
  EXPECT_EQ(drawn(), ImageColour_t(2, 2, 2));
}

TEST_F(Window, BadColoursAreRefused) {
  EXPECT_EQ(error_code_of([&] { window.SetPixel(1, 1, std::nan(""), 0.0, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { window.SetPixel(1, 1, "green"); }), PlayerError::kBadArgument);
  EXPECT_EQ(world->draw_calls, 0);
}

TEST_F(Window, AlphaBlendsOverWhatIsThere) {
  window.Clear(0, 0, 0);
  window.SetPixel(3, 3, 255, 255, 255, 128);
  // Source-over: 255 * 128/255 + 0.
  EXPECT_NEAR(window.GetPixel(3, 3).r, 128, 1);
  window.SetPixel(3, 3, 255, 255, 255, 0);
  EXPECT_NEAR(window.GetPixel(3, 3).r, 128, 1);
}

TEST_F(Window, LinesDrawBothEnds) {
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

TEST_F(Window, ClearFillsEveryCell) {
  window.Clear("#102030");
  EXPECT_EQ(window.GetPixel(171, 185), ImageColour_t(0x10, 0x20, 0x30));
  window.Clear(0.0, 0.0, 1.0, 0.5);
  EXPECT_EQ(window.GetPixel(0, 0), ImageColour_t(0, 0, 255, 128));
  window.Clear();
  EXPECT_EQ(window.GetPixel(0, 0), ImageColour_t(0, 0, 0, 0));
}

TEST_F(Window, PixelsAreReadInManyWays) {
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

TEST_F(Window, LayerIsReachedByName) {
  EXPECT_THAT(window.GetLayerNames(), ElementsAre("canvas"));
  CCMorse::GridMapLayer& layer = window.GetLayer();
  EXPECT_EQ(&window.GetLayer("canvas"), &layer);
  EXPECT_EQ(error_code_of([&] { window.GetLayer("map"); }), PlayerError::kBadArgument);
  layer.SetName("map");
  EXPECT_EQ(&window.GetLayer("map"), &layer);
  layer.SetPriority(3);
  EXPECT_EQ(layer.GetPriority(), 3);
}

TEST_F(Window, LayerDrawsInItsColourAndTransparency) {
  CCMorse::GridMapLayer& layer = window.GetLayer();
  layer.SetColour(255, 0, 0);
  layer.SetPixel(1, 1);
  layer.SetLine(1, 2, 3, 2);
  EXPECT_EQ(window.GetPixel(1, 1), ImageColour_t(255, 0, 0));
  EXPECT_EQ(window.GetPixel(3, 2), ImageColour_t(255, 0, 0));
  layer.SetTransparency(0.5);
  EXPECT_DOUBLE_EQ(layer.GetTransparency(), 0.5);
  window.SetPixel(4, 4, 0, 0, 255);  // the window draws through the layer
  EXPECT_NEAR(window.GetPixel(4, 4).a, 128, 1);
  layer.SetTransparency(1.0);
  layer.SetPixel(5, 5);
  EXPECT_EQ(window.GetPixel(5, 5).a, 0);
}

TEST_F(Window, TransparentColourDrawsNothing) {
  CCMorse::GridMapLayer& layer = window.GetLayer();
  EXPECT_FALSE(layer.HasTransparentColour());
  layer.SetTransparentColour("#ffffff");
  window.SetPixel(1, 1, 255, 255, 255);
  EXPECT_EQ(window.GetPixel(1, 1).a, 0);
  window.SetPixel(1, 1, 255, 255, 254);
  EXPECT_EQ(window.GetPixel(1, 1).a, 255);
  layer.ResetTransparentColour();
  window.SetPixel(2, 2, 255, 255, 255);
  EXPECT_EQ(window.GetPixel(2, 2).a, 255);
}

TEST_F(Window, PrintsItsSizeAndLayers) {
  std::ostringstream out;
  out << window;
  EXPECT_THAT(out.str(), HasSubstr("172\t186\t0.02"));
  EXPECT_THAT(out.str(), HasSubstr("canvas"));
}

}  // namespace
