// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Layers of the grid-map through the client's interface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fake_session.h"
#include "libCCMorse/WindowProxy.h"
#include "sim/io/map_file.h"
#include "temporary_folder.h"

namespace {

using CCMorse::GridMapLayer;
using CCMorse::ImageColour_t;
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

constexpr std::size_t kCells = 172 * 186;

class Layers : public testing::Test {
 protected:
  ~Layers() override { delete &WindowProxy::GetInstance(); }

  // Colour of a cell in the composition of all layers.
  ImageColour_t composed(int column, int row) {
    const std::vector<std::uint8_t> rgba = window.GetComposedImage();
    const std::size_t at = 4 * static_cast<std::size_t>(row * 172 + column);
    return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
  }

  std::shared_ptr<FakeWorld> world = make_fake_world();
  PlayerClient client{fake_session(world)};
  WindowProxy& window = WindowProxy::GetInstance(&client, 172, 186);
};

TEST_F(Layers, MadeFoundAndRemovedByName) {
  EXPECT_THAT(window.GetLayerNames(), ElementsAre("canvas"));
  GridMapLayer& map = window.CreateLayer("map");
  GridMapLayer& below = window.CreateLayer("below", GridMapLayer::BINARY, -1);
  EXPECT_THAT(window.GetLayerNames(), ElementsAre("below", "canvas", "map"));
  EXPECT_EQ(&window.GetLayer("map"), &map);
  EXPECT_EQ(window.FindLayer("below"), &below);
  EXPECT_EQ(window.FindLayer("none"), nullptr);
  EXPECT_TRUE(window.HasLayer("canvas"));
  EXPECT_EQ(below.GetKind(), GridMapLayer::BINARY);
  EXPECT_EQ(below.GetPriority(), -1);
  try {
    window.GetLayer("none");
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("below, canvas, map"));
    EXPECT_EQ(e.GetErrorCode(), PlayerError::kBadArgument);
  }
  window.RemoveLayer("map");
  EXPECT_THAT(window.GetLayerNames(), ElementsAre("below", "canvas"));
  EXPECT_EQ(error_code_of([&] { window.RemoveLayer("map"); }), PlayerError::kBadArgument);
  EXPECT_NE(&window.CreateLayer("map"), &map) << "the old handle stays what it is";
}

TEST_F(Layers, RemovedLayer_RefusesCallsSafely) {
  GridMapLayer& map = window.CreateLayer("map", GridMapLayer::GREY);
  window.RemoveLayer("map");
  EXPECT_EQ(map.GetName(), "map");
  std::vector<double> cells;
  const auto refused = [](auto action) {
    EXPECT_EQ(error_code_of(action), PlayerError::kNotAvailable);
  };
  refused([&] { map.SetPixel(1, 1, 0, 0, 0); });
  refused([&] { map.SetLine(1, 1, 2, 2); });
  refused([&] { map.SetCell(1, 1, 0.5); });
  refused([&] { map.GetPixel(1, 1); });
  refused([&] { map.GetCells(cells); });
  refused([&] { map.SetCells(std::vector<double>(kCells, 0.5)); });
  refused([&] { map.SetPriority(1); });
  refused([&] { map.Clear(); });
  refused([&] { map.SetDiscMetres(1, 1, 0.1, 1, 1, 1); });
}

TEST_F(Layers, Names_Checked) {
  window.CreateLayer("map");
  const auto refused = [this](const std::string& name) {
    EXPECT_EQ(error_code_of([&] { window.CreateLayer(name); }), PlayerError::kBadArgument) << name;
    EXPECT_EQ(error_code_of([&] { window.GetLayer("map").SetName(name); }),
              name == "map" ? 0 : PlayerError::kBadArgument)
        << name;
  };
  for (const char* name : {"", "canvas", "map", "a\nb", "\x7f"}) refused(name);
  refused(std::string(65, 'x'));
  window.CreateLayer(std::string(64, 'x'));
  window.CreateLayer("mapa překážek");
  window.GetLayer("map").SetName("plan");
  EXPECT_EQ(window.GetLayer("plan").GetName(), "plan");
  EXPECT_EQ(window.FindLayer("map"), nullptr);
  EXPECT_EQ(error_code_of([&] { window.CreateLayer("y", static_cast<GridMapLayer::Kind>(3)); }),
            PlayerError::kBadArgument);
}

TEST_F(Layers, Canvas_NeitherRemovedNorRenamed) {
  EXPECT_EQ(error_code_of([&] { window.RemoveLayer("canvas"); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { window.GetLayer().SetName("map"); }), PlayerError::kNotAvailable);
  window.GetLayer().SetPixel(3, 3, 1, 2, 3);
  EXPECT_EQ(window.GetPixel(3, 3), ImageColour_t(1, 2, 3)) << "the window draws on it";
}

TEST_F(Layers, Number_Limited) {
  for (int i = 0; i < 64; ++i) window.CreateLayer("l" + std::to_string(i));
  EXPECT_EQ(error_code_of([&] { window.CreateLayer("one more"); }), PlayerError::kNotAvailable);
  window.RemoveLayer("l5");
  window.CreateLayer("one more");
}

TEST_F(Layers, Priority_OrdersLayers) {
  GridMapLayer& red = window.CreateLayer("red");
  GridMapLayer& blue = window.CreateLayer("blue");
  red.SetPixel(4, 4, 255, 0, 0);
  blue.SetPixel(4, 4, 0, 0, 255);
  window.SetPixel(4, 4, 0, 255, 0);
  EXPECT_EQ(composed(4, 4), ImageColour_t(0, 0, 255)) << "the newer of equals";
  red.SetPriority(1);
  EXPECT_EQ(composed(4, 4), ImageColour_t(255, 0, 0));
  EXPECT_EQ(window.GetLayerNames(), (std::vector<std::string>{"canvas", "blue", "red"}));
  red.Hide();
  EXPECT_FALSE(red.IsVisible());
  EXPECT_EQ(composed(4, 4), ImageColour_t(0, 0, 255));
  blue.SetPriority(-1);
  EXPECT_EQ(composed(4, 4), ImageColour_t(0, 255, 0));
  red.Show();
  EXPECT_EQ(composed(4, 4), ImageColour_t(255, 0, 0));
  EXPECT_EQ(red.GetPixel(4, 4), ImageColour_t(255, 0, 0));
}

TEST_F(Layers, Settings_ApplyToDrawings) {
  GridMapLayer& layer = window.CreateLayer("layer");
  layer.SetPixel(1, 1, 255, 0, 0);
  layer.SetTransparency(0.5);
  EXPECT_DOUBLE_EQ(layer.GetTransparency(), 0.5);
  EXPECT_EQ(composed(1, 1), ImageColour_t(255, 0, 0, 128));  // 127.5
  EXPECT_EQ(layer.GetPixel(1, 1), ImageColour_t(255, 0, 0)) << "the cell keeps its colour";
  layer.SetTransparency(7.0);
  EXPECT_DOUBLE_EQ(layer.GetTransparency(), 1.0);
  layer.SetTransparency(0.0);
  EXPECT_EQ(error_code_of([&] { layer.SetTransparency(std::nan("")); }), PlayerError::kBadArgument);
  EXPECT_FALSE(layer.HasTransparentColour());
  layer.SetTransparentColour("#ff0000");
  EXPECT_TRUE(layer.HasTransparentColour());
  EXPECT_EQ(layer.GetTransparentColour(), ImageColour_t(255, 0, 0));
  EXPECT_EQ(composed(1, 1).a, 0);
  layer.ResetTransparentColour();
  EXPECT_EQ(composed(1, 1), ImageColour_t(255, 0, 0));
}

TEST_F(Layers, Colours_AcceptedInSeveralForms) {
  GridMapLayer& layer = window.CreateLayer("layer");
  EXPECT_EQ(layer.GetColour(), ImageColour_t(0, 0, 0));
  layer.SetColour(1, 2, 3);
  EXPECT_EQ(layer.GetColour(), ImageColour_t(1, 2, 3));
  layer.SetColour(1.0, 0.0, 1.0, 0.0);
  EXPECT_EQ(layer.GetColour(), ImageColour_t(255, 0, 255, 0));
  layer.SetColour("#0000ff", 10);
  EXPECT_EQ(layer.GetColour(), ImageColour_t(0, 0, 255, 10));
  layer.SetColour(ImageColour_t(9, 8, 7));
  layer.SetPixel(1, 1);
  layer.SetLine(1, 2, 3, 2);
  layer.SetPixelMetres(0.01, 0.01);
  layer.SetLineMetres(0.05, 0.01, 0.09, 0.01);
  layer.SetPixel(CCMorse::ImagePoint_t(7, 7));
  layer.SetLine({1, 9}, {2, 9});
  for (const auto& [x, y] : {std::pair(1, 1), {3, 2}, {0, 185}, {3, 185}, {7, 7}, {2, 9}}) {
    EXPECT_EQ(layer.GetPixel(x, y), ImageColour_t(9, 8, 7)) << x << ", " << y;
  }
}

TEST_F(Layers, BinaryCells_SetOrUnset) {
  GridMapLayer& layer = window.CreateLayer("obstacles", GridMapLayer::BINARY);
  layer.SetColour("#0000ff");
  layer.SetCell(1, 1, true);
  layer.SetCell(2, 1, 1);
  layer.SetCell(3, 1, 0.25);
  layer.SetCell(4, 1, std::size_t{7});
  layer.SetPixel(5, 1, 255, 255, 255);
  layer.SetPixel(6, 1);
  layer.SetCell(-1, 500, true);  // clipped
  for (int x = 1; x <= 6; ++x) {
    EXPECT_EQ(layer.GetCell(x, 1), 1.0) << x;
    EXPECT_EQ(composed(x, 1), ImageColour_t(0, 0, 255)) << x;
    EXPECT_EQ(layer.GetPixel(x, 1), ImageColour_t(0, 0, 255)) << x;
  }
  layer.SetCell(1, 1, false);
  layer.SetPixel(2, 1, 0, 0, 0, 0);
  EXPECT_EQ(layer.GetCell(1, 1), 0.0);
  EXPECT_EQ(layer.GetCell(2, 1), 0.0);
  EXPECT_EQ(composed(1, 1).a, 0);
  layer.SetColour(255, 0, 0);
  EXPECT_EQ(composed(3, 1), ImageColour_t(255, 0, 0)) << "all change colour";
  layer.Clear();
  EXPECT_EQ(layer.GetCell(3, 1), 0.0);
}

TEST_F(Layers, GreyCells_AreOccupancies) {
  GridMapLayer& layer = window.CreateLayer("occupancy", GridMapLayer::GREY);
  EXPECT_DOUBLE_EQ(layer.GetCell(9, 9), 0.5);
  layer.SetCell(1, 1, 0.0);
  layer.SetCell(2, 1, 1.0);
  layer.SetCell(3, 1, std::uint8_t(51));  // 51 / 255
  layer.SetCell(4, 1, 2.5);
  layer.SetCell(5, 1, -1);
  layer.SetPixel(6, 1, 255, 255, 255);
  layer.SetPixel(7, 1, 0, 0, 0);
  layer.SetPixel(8, 1);
  EXPECT_EQ(composed(1, 1), ImageColour_t(255, 255, 255));
  EXPECT_EQ(composed(2, 1), ImageColour_t(0, 0, 0));
  EXPECT_EQ(composed(9, 9), ImageColour_t(128, 128, 128));  // 127.5
  EXPECT_EQ(layer.GetPixel(9, 9), ImageColour_t(128, 128, 128));
  EXPECT_FLOAT_EQ(static_cast<float>(layer.GetCell(3, 1)), 0.2F);
  EXPECT_EQ(layer.GetCell(4, 1), 1.0);
  EXPECT_EQ(layer.GetCell(5, 1), 0.0);
  EXPECT_EQ(layer.GetCell(6, 1), 0.0);
  EXPECT_EQ(layer.GetCell(7, 1), 1.0);
  EXPECT_EQ(layer.GetCell(8, 1), 1.0);
  EXPECT_EQ(error_code_of([&] { layer.SetCell(1, 1, std::nan("")); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { layer.GetCell(172, 1); }), PlayerError::kBadArgument);
  layer.Clear();
  EXPECT_DOUBLE_EQ(layer.GetCell(1, 1), 0.5);
}

template <typename T>
class WholeLayers : public Layers {};
using CellTypes = testing::Types<std::uint8_t, float, double>;
TYPED_TEST_SUITE(WholeLayers, CellTypes);

TYPED_TEST(WholeLayers, SetAndReadInEveryKind) {
  const bool bytes = std::is_same_v<TypeParam, std::uint8_t>;
  const auto number = [&](std::size_t i) {
    return static_cast<TypeParam>(bytes ? static_cast<double>(i % 256)
                                        : static_cast<double>(i % 256) / 256.0);
  };
  std::vector<TypeParam> cells(kCells), found;
  for (std::size_t i = 0; i < kCells; ++i) cells[i] = number(i);

  GridMapLayer& grey = this->window.CreateLayer("grey", GridMapLayer::GREY);
  grey.SetCells(cells);
  grey.GetCells(found);
  EXPECT_EQ(found, cells);  // 256ths are exact in single precision, and bytes come back as bytes
  // Cell 172 is the first of the second row.
  EXPECT_FLOAT_EQ(static_cast<float>(grey.GetCell(0, 1)), bytes ? 172.0F / 255.0F : 0.671875F);

  GridMapLayer& binary = this->window.CreateLayer("binary", GridMapLayer::BINARY);
  binary.SetCells(cells.data(), cells.size());
  binary.GetCells(found);
  for (std::size_t i = 0; i < kCells; ++i) ASSERT_EQ(found[i], TypeParam(i % 256 != 0)) << i;

  GridMapLayer& colour = this->window.CreateLayer("colour");
  const TypeParam full = bytes ? TypeParam(255) : TypeParam(1);
  std::vector<TypeParam> rgb(3 * kCells);
  for (std::size_t i = 0; i < kCells; ++i) rgb[3 * i] = full;
  colour.SetCells(rgb);
  EXPECT_EQ(colour.GetPixel(171, 185), ImageColour_t(255, 0, 0));
  colour.GetCells(found);
  ASSERT_EQ(found.size(), 4 * kCells);
  EXPECT_EQ(found[3], full);
  found[2] = full;
  found[3] = TypeParam(0);
  colour.SetCells(found);
  EXPECT_EQ(colour.GetPixel(0, 0), ImageColour_t(255, 0, 255, 0));

  for (GridMapLayer* layer : {&grey, &binary, &colour}) {
    EXPECT_EQ(error_code_of([&] { layer->SetCells(cells.data(), kCells - 1); }),
              PlayerError::kBadArgument);
    EXPECT_EQ(error_code_of([&] { layer->SetCells(static_cast<TypeParam*>(nullptr), kCells); }),
              PlayerError::kBadArgument);
  }
  if constexpr (std::is_floating_point_v<TypeParam>) {
    cells[5] = std::numeric_limits<TypeParam>::quiet_NaN();
    EXPECT_EQ(error_code_of([&] { grey.SetCells(cells); }), PlayerError::kBadArgument);
  }
}

TEST_F(Layers, ColourLayers_HaveNoCellNumbers) {
  GridMapLayer& layer = window.CreateLayer("layer");
  EXPECT_EQ(error_code_of([&] { layer.SetCell(1, 1, 1); }), PlayerError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { layer.GetCell(1, 1); }), PlayerError::kNotAvailable);
}

TEST_F(Layers, Images_ConvertedToKindOfLayer) {
  GridMapLayer& grey = window.CreateLayer("grey", GridMapLayer::GREY);
  std::vector<std::uint8_t> rgb(3 * kCells, 255);
  rgb[0] = rgb[1] = rgb[2] = 0;
  grey.SetImage(rgb);
  EXPECT_EQ(grey.GetCell(0, 0), 1.0);
  EXPECT_EQ(grey.GetCell(1, 0), 0.0);
  EXPECT_EQ(grey.GetImage(3), rgb);
}

TEST_F(Layers, SavedOneByOne) {
  GridMapLayer& trail = window.CreateLayer("trail", GridMapLayer::BINARY);
  GridMapLayer& map = window.CreateLayer("map", GridMapLayer::GREY);
  trail.SaveImage("way");
  map.SaveImage("big.png", 4);
  window.GetLayer("canvas").SaveImage("floor");
  ASSERT_EQ(world->saved.size(), 3U);
  const sim::LayerId trail_id = world->saved[0].layer.value_or(-1);
  const sim::LayerId map_id = world->saved[1].layer.value_or(-1);
  EXPECT_EQ(world->layers.style(trail_id).name, "trail");
  EXPECT_EQ(world->layers.style(map_id).name, "map");
  EXPECT_THAT(world->saved,
              ElementsAre(FieldsAre("way", 1, trail_id), FieldsAre("big.png", 4, map_id),
                          FieldsAre("floor", 1, sim::kBaseLayer)));

  map.SaveMap("plan");
  map.SaveMap("shades", GridMapLayer::SCALE);
  EXPECT_THAT(world->saved_maps,
              ElementsAre(FieldsAre(map_id, "plan", sim::io::MapMode::kTrinary),
                          FieldsAre(map_id, "shades", sim::io::MapMode::kScale)));
  EXPECT_EQ(error_code_of([&] { trail.SaveMap("way"); }), PlayerError::kNotAvailable);
  EXPECT_EQ(world->saved_maps.size(), 2U);
}

// A map of 3 x 2 cells of 4 cm with its bottom left corner at (0.10, 0.06). Each of its cells
// covers 2 x 2 cells of the canvas: columns 5 to 10 and rows 185 - 3 = 182 up to 179.
class LoadedMaps : public Layers {
 protected:
  LoadedMaps() {
    sim::OccupancyMap map;
    map.width = 3;
    map.height = 2;
    map.cell_size_m = 0.04;
    map.origin = {0.10, 0.06};
    map.cells = {0.0F, 1.0F, 0.5F,   // the upper row
                 1.0F, 0.0F, 0.0F};  // the lower one
    sim::io::write_map(map, stem);
  }

  test_support::TemporaryFolder folder;
  std::string stem = (folder.path() / "map").string();
};

TEST_F(LoadedMaps, PlacedByWorldPosition) {
  GridMapLayer& layer = window.CreateLayer("map", GridMapLayer::GREY);
  layer.SetCells(std::vector<double>(kCells, 0.25));
  EXPECT_EQ(layer.LoadMap(stem + ".yaml"), 24);
  const double expected[2][3] = {{0.0, 1.0, 0.5}, {1.0, 0.0, 0.0}};
  std::size_t others = 0;
  for (int row = 0; row < 186; ++row) {
    for (int column = 0; column < 172; ++column) {
      if (column >= 5 && column <= 10 && row >= 179 && row <= 182) {
        EXPECT_EQ(layer.GetCell(column, row), expected[(row - 179) / 2][(column - 5) / 2])
            << column << ", " << row;
      } else {
        others += layer.GetCell(column, row) == 0.25;
      }
    }
  }
  EXPECT_EQ(others, kCells - 24) << "what the map does not cover stays";
}

TEST_F(LoadedMaps, PartsBeyondCanvas_CutOff) {
  GridMapLayer& layer = window.CreateLayer("map", GridMapLayer::GREY);
  window.Resize(8,
                5);  // to x = 0.16, y = 0.10: the lower left cell of the map, half the middle one
  EXPECT_EQ(layer.LoadMap(stem + ".yaml"), 6);
  EXPECT_EQ(layer.GetCell(5, 0), 1.0);
  EXPECT_EQ(layer.GetCell(6, 1), 1.0);
  EXPECT_EQ(layer.GetCell(7, 1), 0.0);
  EXPECT_EQ(layer.GetCell(5, 2), 0.5);
  window.Resize(4, 5);
  EXPECT_EQ(layer.LoadMap(stem + ".yaml"), 0) << "it lies wholly outside";
}

TEST_F(LoadedMaps, SmallerCells_SampledAtCentres) {
  sim::OccupancyMap map;  // 4 x 4 cells of 1 cm: 2 x 2 of the canvas's
  map.width = map.height = 4;
  map.cell_size_m = 0.01;
  map.cells = {1, 1, 0, 0,  //
               1, 0, 0, 1,  // centres are on corners of four cells: the upper right one counts
               0, 0, 0, 0,  //
               0, 0, 1, 0};
  sim::io::write_map(map, stem);
  GridMapLayer& layer = window.CreateLayer("map", GridMapLayer::GREY);
  EXPECT_EQ(layer.LoadMap(stem + ".yaml"), 4);
  EXPECT_EQ(layer.GetCell(0, 184), 1.0);
  EXPECT_EQ(layer.GetCell(1, 184), 0.0);
  EXPECT_EQ(layer.GetCell(0, 185), 0.0);
  EXPECT_EQ(layer.GetCell(1, 185), 0.0);
}

TEST_F(LoadedMaps, InvalidMaps_Refused) {
  GridMapLayer& layer = window.CreateLayer("map", GridMapLayer::GREY);
  try {
    layer.LoadMap(stem + "_2.yaml");
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorCode(), PlayerError::kBadArgument);
    EXPECT_THAT(e.GetErrorStr(), HasSubstr(stem + "_2.yaml"));
  }
  EXPECT_EQ(error_code_of([&] { layer.LoadMap(stem + ".pgm"); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { window.GetLayer("canvas").LoadMap(stem + ".yaml"); }),
            PlayerError::kNotAvailable);
  window.RemoveLayer("map");
  EXPECT_EQ(error_code_of([&] { layer.LoadMap(stem + ".yaml"); }), PlayerError::kNotAvailable);
}

TEST_F(Layers, ResizedWithCanvas) {
  GridMapLayer& layer = window.CreateLayer("layer", GridMapLayer::GREY);
  layer.SetCell(0, 185, 1.0);
  window.Resize(20, 10);
  EXPECT_EQ(layer.GetWidth(), 20);
  EXPECT_EQ(layer.GetCell(0, 9), 1.0);
  layer.SetCells(std::vector<float>(200, 0.0F));
}

TEST_F(Layers, OutliveWindow) {
  window.CreateLayer("map", GridMapLayer::BINARY).SetCell(3, 3, 1);
  delete &window;
  WindowProxy& next = WindowProxy::GetInstance(&client, 172, 186);
  EXPECT_EQ(next.GetLayer("map").GetKind(), GridMapLayer::BINARY);
  EXPECT_EQ(next.GetLayer("map").GetCell(3, 3), 1.0);
}

}  // namespace
