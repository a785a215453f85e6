// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Speed of drawing on layers and composing them, on the canvas of the SyRoTek arena.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "figures.h"
#include "libCCMorse/WindowProxy.h"
#include "libplayerc++/playerc++.h"
#include "sim/canvas/layers.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"

namespace sim::bench {
namespace {

constexpr int kWidth = 172;
constexpr int kHeight = 186;
constexpr int kLayers = 8;  // without the base

// Eight layers as in an exploration task: an opaque grey map, then pixel and binary layers with
// scattered cells, some of them translucent.
struct Canvases {
  Canvases() : stack({.width = kWidth, .height = kHeight}) {
    for (int i = 0; i < kLayers; ++i) {
      LayerStyle style;
      style.name = "layer" + std::to_string(i);
      style.colour = {static_cast<std::uint8_t>(30 * i), 100, 200, 255};
      style.transparency = i % 3 == 2 ? 0.5 : 0.0;
      const LayerKind kind = i == 0       ? LayerKind::kGrey
                             : i % 2 == 1 ? LayerKind::kBinary
                                          : LayerKind::kColour;
      ids.push_back(stack.add(kind, style, 0));
    }
    for (int version = 0; version < 2; ++version) {
      for (int i = 0; i < kWidth * kHeight; ++i) {
        const int cell = i + version;
        colours[version].push_back(
            CellValue::of(Colour{static_cast<std::uint8_t>(cell % 256), 80,
                                 static_cast<std::uint8_t>(cell / 256), 255}));
        binary[version].push_back(CellValue::of(cell % 5 == 0));
        grey[version].push_back(CellValue::of(static_cast<float>(cell % 101) / 100.0F));
      }
    }
    for (const LayerId id : ids) {
      stack.set_cells(id, kWhole,
                      stack.kind(id) == LayerKind::kGrey     ? grey[0]
                      : stack.kind(id) == LayerKind::kBinary ? binary[0]
                                                             : colours[0]);
    }
    for (int i = 0; i < 4096; ++i) {
      pixels.push_back({DrawOperation::Kind::kPixel, kBaseLayer, (7 * i) % kWidth,
                        (13 * i) % kHeight, 0, 0, CellValue::of(Colour{255, 0, 0, 255})});
    }
    static_cast<void>(stack.composed());
  }

  void draw_pixels() { stack.draw(pixels); }
  void draw_pixels_on_canvas() {
    Canvas& canvas = stack.base();
    for (const DrawOperation& pixel : pixels) {
      canvas.set_pixel(pixel.x0, pixel.y0, pixel.value.colour());
    }
  }
  // Every call changes every cell.
  void set_whole(LayerId layer, const std::vector<CellValue> (&images)[2]) {
    turn = 1 - turn;
    stack.set_cells(layer, kWhole, images[turn]);
  }
  void compose_whole() {
    LayerStyle style = stack.style(ids[0]);
    style.transparency = style.transparency > 0.0 ? 0.0 : 0.01;
    stack.set_style(ids[0], style);
    benchmark::DoNotOptimize(stack.composed().data());
  }
  void compose_tile() {
    turn = 1 - turn;
    const DrawOperation pixel{DrawOperation::Kind::kPixel,
                              ids[0],
                              40,
                              40,
                              0,
                              0,
                              CellValue::of(0.25F * static_cast<float>(turn))};
    stack.draw({&pixel, 1});
    benchmark::DoNotOptimize(stack.composed().data());
  }
  void compose_nothing() { benchmark::DoNotOptimize(stack.composed().data()); }

  static constexpr CellRect kWhole{0, 0, kWidth, kHeight};
  LayerStack stack;
  std::vector<LayerId> ids;
  std::vector<CellValue> colours[2];
  std::vector<CellValue> binary[2];
  std::vector<CellValue> grey[2];
  std::vector<DrawOperation> pixels;
  int turn = 0;
};

void BM_DrawPixels4096(benchmark::State& state) {
  Canvases canvases;
  for (auto _ : state) canvases.draw_pixels();
}
BENCHMARK(BM_DrawPixels4096)->Unit(benchmark::kMicrosecond);

void BM_SetWholeColourImage(benchmark::State& state) {
  Canvases canvases;
  for (auto _ : state) canvases.set_whole(canvases.ids[2], canvases.colours);
}
BENCHMARK(BM_SetWholeColourImage)->Unit(benchmark::kMicrosecond);

void BM_ComposeEightLayers(benchmark::State& state) {
  Canvases canvases;
  for (auto _ : state) canvases.compose_whole();
}
BENCHMARK(BM_ComposeEightLayers)->Unit(benchmark::kMicrosecond);

void BM_ComposeOneTile(benchmark::State& state) {
  Canvases canvases;
  for (auto _ : state) canvases.compose_tile();
}
BENCHMARK(BM_ComposeOneTile)->Unit(benchmark::kMicrosecond);

void BM_TrueMap(benchmark::State& state) {
  const WorldDescription world = load_world("");
  for (auto _ : state) benchmark::DoNotOptimize(true_map(world.arena, world.canvas).cells.data());
}
BENCHMARK(BM_TrueMap)->Unit(benchmark::kMicrosecond);

void print_layer_figures() {
  Canvases c;
  const auto pixels = static_cast<double>(c.pixels.size());
  const double pixel_s = seconds_per_call([&] { c.draw_pixels(); }, 200) / pixels;
  const double canvas_s = seconds_per_call([&] { c.draw_pixels_on_canvas(); }, 200) / pixels;
  figure("layer_pixels_per_second", 1.0 / pixel_s);
  figure("layer_ns_per_pixel", pixel_s * 1e9);
  figure("canvas_ns_per_pixel", canvas_s * 1e9);
  figure("set_whole_rgba_ms",
         1e3 * seconds_per_call([&] { c.set_whole(c.ids[2], c.colours); }, 100));
  figure("set_whole_binary_ms",
         1e3 * seconds_per_call([&] { c.set_whole(c.ids[1], c.binary); }, 100));
  figure("set_whole_grey_ms", 1e3 * seconds_per_call([&] { c.set_whole(c.ids[0], c.grey); }, 100));
  const double whole_s = seconds_per_call([&] { c.compose_whole(); }, 20);
  const double tile_s = seconds_per_call([&] { c.compose_tile(); }, 1000);
  figure("compose_8_layers_ms", whole_s * 1e3);
  figure("compose_1_tile_ms", tile_s * 1e3);
  figure("compose_whole_over_tile", whole_s / tile_s);
  figure("compose_nothing_us", 1e6 * seconds_per_call([&] { c.compose_nothing(); }, 1000));
  const WorldDescription world = load_world("");
  figure(
      "true_map_us",
      1e6 * seconds_per_call(
                [&] { benchmark::DoNotOptimize(true_map(world.arena, world.canvas).cells.data()); },
                50));
}

// The same measurement through the client's interface: WindowProxy, GridMapLayer and the host.
void print_window_figures() {
  PlayerCc::PlayerClient client("localhost", 6665);
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, kWidth, kHeight);
  CCMorse::GridMapLayer& layer = window.CreateLayer("layer");
  CCMorse::GridMapLayer& grey = window.CreateLayer("grey", CCMorse::GridMapLayer::GREY);
  // Set every cell once, and then look at one, so that the host executes all drawings.
  const auto draw_all = [](CCMorse::Drawing& drawing) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) drawing.SetPixel(x, y, x, y, 80);
    }
    benchmark::DoNotOptimize(drawing.GetPixel(0, 0));
  };
  constexpr double kPixels = static_cast<double>(kWidth) * kHeight;
  figure("window_pixels_per_second", kPixels / seconds_per_call([&] { draw_all(window); }, 1, 300));
  figure("window_layer_pixels_per_second",
         kPixels / seconds_per_call([&] { draw_all(layer); }, 1, 300));
  const std::vector<std::uint8_t> rgba(static_cast<std::size_t>(kWidth * kHeight * 4), 200);
  const std::vector<std::uint8_t> rgb(static_cast<std::size_t>(kWidth * kHeight * 3), 200);
  const std::vector<double> cells(static_cast<std::size_t>(kWidth * kHeight), 0.3);
  figure("whole_image_us", 1e6 * seconds_per_call([&] { window.SetImage(rgba); }, 10, 100));
  figure("whole_image_rgb_us", 1e6 * seconds_per_call([&] { window.SetImage(rgb); }, 10, 100));
  figure("whole_grey_doubles_us", 1e6 * seconds_per_call([&] { grey.SetCells(cells); }, 10, 100));
  delete &window;
}

}  // namespace
}  // namespace sim::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  sim::bench::print_layer_figures();
  sim::bench::print_window_figures();
}
