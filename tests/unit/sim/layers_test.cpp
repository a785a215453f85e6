// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "sim/core/state_archive.h"

namespace sim {
namespace {

using testing::ElementsAre;

constexpr Colour kNothing{0, 0, 0, 0};
constexpr Colour kRed{255, 0, 0, 255};
constexpr Colour kBlue{0, 0, 255, 255};

LayerStack stack_of(int width, int height) {
  return LayerStack({.width = width, .height = height, .cell_size_m = 0.5, .origin = {-1.0, 2.0}});
}

LayerStyle named(const std::string& name) {
  LayerStyle style;
  style.name = name;
  return style;
}

DrawOperation pixel(LayerId layer, int column, int row, CellValue value) {
  return {DrawOperation::Kind::kPixel, layer, column, row, 0, 0, value};
}
DrawOperation line(LayerId layer, int x0, int y0, int x1, int y1, CellValue value) {
  return {DrawOperation::Kind::kLine, layer, x0, y0, x1, y1, value};
}
DrawOperation fill(LayerId layer, CellValue value) {
  return {DrawOperation::Kind::kFill, layer, 0, 0, 0, 0, value};
}

void draw(LayerStack& stack, const DrawOperation& operation) { stack.draw({&operation, 1}); }

Colour colour_at(const std::vector<std::uint8_t>& bytes, int width, int column, int row) {
  const auto at = 4 * static_cast<std::size_t>(row * width + column);
  return {bytes.at(at), bytes.at(at + 1), bytes.at(at + 2), bytes.at(at + 3)};
}
Colour composed_at(LayerStack& stack, int column, int row) {
  return colour_at(stack.composed(), stack.width(), column, row);
}

std::vector<LayerId> order_of(const LayerStack& stack) {
  std::vector<LayerId> ids;
  for (const LayerInfo& info : stack.layers()) ids.push_back(info.id);
  return ids;
}

/// Number of cells that composing has to compute now.
std::uint64_t cost_of_composing(LayerStack& stack) {
  const std::uint64_t before = stack.recomposed_cells();
  static_cast<void>(stack.composed());
  return stack.recomposed_cells() - before;
}

// ---- a reference stack, composed cell by cell and completely each time ----

std::int64_t rounded_quotient(std::int64_t a, std::int64_t b) { return (2 * a + b) / (2 * b); }

struct PlainLayer {
  LayerInfo info;
  std::vector<CellValue> cells;
};

Colour drawn_plainly(const PlainLayer& layer, CellValue value) {
  const LayerStyle& style = layer.info.style;
  Colour colour = kNothing;
  if (layer.info.kind == LayerKind::kColour) colour = value.colour();
  if (layer.info.kind == LayerKind::kBinary && value.set()) colour = style.colour;
  if (layer.info.kind == LayerKind::kGrey) {
    double p = static_cast<double>(value.occupancy());
    if (std::isnan(p)) p = 0.5;
    p = std::max(0.0, std::min(1.0, p));
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - p)));
    colour = {grey, grey, grey, 255};
  }
  if (style.transparent_colour.has_value()) {
    Colour hidden = *style.transparent_colour;
    hidden.a = colour.a;
    if (hidden == colour) return kNothing;
  }
  const double transparency = std::max(0.0, std::min(1.0, style.transparency));
  const std::int64_t opacity = std::lround(255.0 * (1.0 - transparency));
  colour.a = static_cast<std::uint8_t>(rounded_quotient(colour.a * opacity, 255));
  return colour;
}

Colour over_plainly(Colour above, Colour below) {
  const std::int64_t wa = above.a * 255;
  const std::int64_t wb = below.a * (255 - above.a);
  if (wa == 0) return below;
  const auto mean = [&](std::int64_t a, std::int64_t b) {
    return static_cast<std::uint8_t>(rounded_quotient(a * wa + b * wb, wa + wb));
  };
  return {mean(above.r, below.r), mean(above.g, below.g), mean(above.b, below.b),
          static_cast<std::uint8_t>(rounded_quotient(wa + wb, 255))};
}

struct PlainStack {
  int width;
  int height;
  std::vector<PlainLayer> layers;

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row * width + column);
  }

  void add(LayerInfo info) {
    const CellValue blank =
        info.kind == LayerKind::kGrey ? CellValue::of(0.5F) : CellValue::of(kNothing);
    layers.push_back({std::move(info), {}});
    layers.back().cells.assign(static_cast<std::size_t>(width * height), blank);
  }

  PlainLayer* find(LayerId id) {
    for (PlainLayer& layer : layers) {
      if (layer.info.id == id) return &layer;
    }
    return nullptr;
  }

  void dot(PlainLayer& layer, int column, int row, CellValue value) const {
    if (column < 0 || row < 0 || column >= width || row >= height) return;
    CellValue& cell = layer.cells[index(column, row)];
    cell = layer.info.kind == LayerKind::kColour
               ? CellValue::of(over_plainly(value.colour(), cell.colour()))
               : value;
  }

  // Each cell is the nearest to the line at its position along the longer axis. If two are equally
  // near, it is the one farther from the end with the smaller coordinate.
  void stroke(PlainLayer& layer, int x0, int y0, int x1, int y1, CellValue value) const {
    const bool steep = std::abs(y1 - y0) > std::abs(x1 - x0);
    if (steep ? y1 < y0 : x1 < x0) {
      std::swap(x0, x1);
      std::swap(y0, y1);
    }
    const int n = steep ? y1 - y0 : x1 - x0;
    for (int i = 0; i <= n; ++i) {
      const int minor_distance = steep ? x1 - x0 : y1 - y0;
      const double exact = n == 0 ? 0.0 : std::abs(minor_distance) * static_cast<double>(i) / n;
      const int steps = static_cast<int>(std::floor(exact + 0.5)) * (minor_distance < 0 ? -1 : 1);
      dot(layer, steep ? x0 + steps : x0 + i, steep ? y0 + i : y0 + steps, value);
    }
  }

  void draw(const DrawOperation& o) {
    PlainLayer* layer = find(o.layer);
    if (layer == nullptr) return;
    if (o.kind == DrawOperation::Kind::kPixel) dot(*layer, o.x0, o.y0, o.value);
    if (o.kind == DrawOperation::Kind::kLine) stroke(*layer, o.x0, o.y0, o.x1, o.y1, o.value);
    if (o.kind == DrawOperation::Kind::kFill) {
      std::fill(layer->cells.begin(), layer->cells.end(), o.value);
    }
  }

  void set_cells(LayerId id, const CellRect& rect, const std::vector<CellValue>& values) {
    PlainLayer* layer = find(id);
    if (layer == nullptr) return;
    for (int row = 0; row < rect.height; ++row) {
      for (int column = 0; column < rect.width; ++column) {
        const int c = rect.column + column;
        const int r = rect.row + row;
        if (c < 0 || r < 0 || c >= width || r >= height) continue;
        layer->cells[index(c, r)] = values[static_cast<std::size_t>(row * rect.width + column)];
      }
    }
  }

  void resize(int new_width, int new_height) {
    PlainStack resized{new_width, new_height, {}};
    for (const PlainLayer& layer : layers) {
      resized.add(layer.info);
      for (int row = 0; row < new_height; ++row) {
        const int old_row = row - new_height + height;
        for (int column = 0; column < new_width; ++column) {
          if (column < width && old_row >= 0) {
            resized.layers.back().cells[resized.index(column, row)] =
                layer.cells[index(column, old_row)];
          }
        }
      }
    }
    *this = std::move(resized);
  }

  [[nodiscard]] std::vector<const PlainLayer*> in_order() const {
    std::vector<const PlainLayer*> order;
    for (const PlainLayer& layer : layers) order.push_back(&layer);
    std::sort(order.begin(), order.end(), [](const PlainLayer* a, const PlainLayer* b) {
      const auto rank = [](const LayerInfo& info) {
        return std::tuple(info.style.priority, info.id == kBaseLayer ? 0 : 1, info.owner, info.id);
      };
      return rank(a->info) < rank(b->info);
    });
    return order;
  }

  [[nodiscard]] std::vector<std::uint8_t> composed() const {
    std::vector<std::uint8_t> bytes;
    const std::vector<const PlainLayer*> order = in_order();
    for (std::size_t i = 0; i < static_cast<std::size_t>(width * height); ++i) {
      Colour colour = kNothing;
      for (const PlainLayer* layer : order) {
        if (!layer->info.style.visible) continue;
        colour = over_plainly(drawn_plainly(*layer, layer->cells[i]), colour);
      }
      bytes.insert(bytes.end(), {colour.r, colour.g, colour.b, colour.a});
    }
    return bytes;
  }
};

/// Applies random edits to both stacks.
class Editor {
 public:
  explicit Editor(unsigned seed) : random_(seed) {
    const int width = number(1, 70);
    const int height = number(1, 70);
    stack = std::make_unique<LayerStack>(stack_of(width, height));
    plain = {width, height, {}};
    plain.add(stack->layers().front());
    for (int i = number(0, 6); i > 0; --i) add_layer();
  }

  void edit() {
    const int what = number(0, 99);
    const LayerId id = some_layer();
    if (what < 40) {
      draw_both(pixel(id, coordinate(), coordinate(), value_for(id)));
    } else if (what < 60) {
      draw_both(line(id, coordinate(), coordinate(), coordinate(), coordinate(), value_for(id)));
    } else if (what < 65) {
      draw_both(fill(id, value_for(id)));
    } else if (what < 75) {
      const CellRect rect{coordinate(), coordinate(), number(0, 60), number(0, 60)};
      std::vector<CellValue> values;
      for (int i = rect.width * rect.height; i > 0; --i) values.push_back(value_for(id));
      stack->set_cells(id, rect, values);
      plain.set_cells(id, rect, values);
    } else if (what < 90) {
      if (PlainLayer* layer = plain.find(id)) {
        layer->info.style = style();
        stack->set_style(id, layer->info.style);
      }
    } else if (what < 94) {
      add_layer();
    } else if (what < 98) {
      EXPECT_EQ(stack->remove(id) != nullptr, id != kBaseLayer && plain.find(id) != nullptr);
      if (id != kBaseLayer) {
        std::erase_if(plain.layers, [id](const PlainLayer& l) { return l.info.id == id; });
      }
    } else {
      const int width = number(1, 70);
      const int height = number(1, 70);
      stack->resize(width, height);
      plain.resize(width, height);
    }
  }

  int number(int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random_);
  }

  std::unique_ptr<LayerStack> stack;
  PlainStack plain;

 private:
  void draw_both(const DrawOperation& operation) {
    draw(*stack, operation);
    plain.draw(operation);
  }

  int coordinate() { return number(-25, 95); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(number(0, 255)); }

  // Few shades, so that fully transparent colours occur.
  Colour colour() {
    constexpr std::array<std::uint8_t, 3> kShades{0, 128, 255};
    const auto shade = [&] { return kShades[static_cast<std::size_t>(number(0, 2))]; };
    const std::uint8_t alpha = number(0, 2) == 0 ? byte() : shade();
    return {shade(), shade(), shade(), alpha};
  }

  // Sometimes a layer that never existed or was removed.
  LayerId some_layer() {
    if (number(0, 19) == 0) return number(1, 1000);
    return plain
        .layers[static_cast<std::size_t>(number(0, static_cast<int>(plain.layers.size()) - 1))]
        .info.id;
  }

  CellValue value_for(LayerId id) {
    const PlainLayer* layer = plain.find(id);
    if (layer == nullptr || layer->info.kind == LayerKind::kColour) return CellValue::of(colour());
    if (layer->info.kind == LayerKind::kBinary) return CellValue::of(number(0, 1) == 1);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr std::array<float, 8> kOdd{
        0.0F, 0.5F,      1.0F,       -3.0F,
        7.0F, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
    if (number(0, 1) == 0) return CellValue::of(kOdd[static_cast<std::size_t>(number(0, 7))]);
    return CellValue::of(std::uniform_real_distribution<float>(0.0F, 1.0F)(random_));
  }

  LayerStyle style() {
    LayerStyle style;
    style.name = "layer" + std::to_string(number(0, 99));
    style.colour = colour();
    constexpr std::array<double, 6> kTransparencies{0.0, 0.0, 0.3, 1.0, -1.0, 2.0};
    style.transparency = kTransparencies[static_cast<std::size_t>(number(0, 5))];
    if (number(0, 2) == 0) style.transparent_colour = colour();
    style.priority = number(-2, 2);
    style.visible = number(0, 3) != 0;
    return style;
  }

  void add_layer() {
    const auto kind = static_cast<LayerKind>(number(0, 2));
    const int owner = number(0, 3);
    const LayerStyle of = style();
    const LayerId id = stack->add(kind, of, owner);
    ASSERT_EQ(plain.find(id), nullptr);
    plain.add({id, kind, owner, of});
  }

  std::mt19937 random_;
};

TEST(LayerStackRandom, RandomEdits_MatchSlowReference) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    Editor editor(seed);
    std::vector<std::uint8_t> last = editor.stack->composed();
    std::uint64_t last_version = editor.stack->version();
    ASSERT_EQ(last, editor.plain.composed()) << "seed " << seed;
    for (int look = 0; look < 12; ++look) {
      for (int edits = editor.number(0, 6); edits > 0; --edits) editor.edit();
      const std::uint64_t version = editor.stack->version();
      const std::vector<std::uint8_t>& now = editor.stack->composed();
      ASSERT_EQ(now, editor.plain.composed()) << "seed " << seed << ", look " << look;
      ASSERT_EQ(editor.stack->version(), version);
      ASSERT_GE(version, last_version);
      if (version == last_version) {
        ASSERT_EQ(now, last) << "seed " << seed << ", look " << look;
      }
      last = now;
      last_version = version;
    }
    std::vector<LayerId> order;
    for (const PlainLayer* layer : editor.plain.in_order()) {
      const LayerId id = layer->info.id;
      order.push_back(id);
      ASSERT_EQ(editor.stack->cells(id), layer->cells) << "seed " << seed;
      ASSERT_EQ(editor.stack->style(id), layer->info.style);
      PlainStack alone{editor.plain.width, editor.plain.height, {*layer}};
      alone.layers[0].info.style.visible = true;
      ASSERT_EQ(editor.stack->picture(id), alone.composed()) << "seed " << seed;
    }
    ASSERT_EQ(order_of(*editor.stack), order);
  }
}

TEST(LayerStack, Default_CanvasOnly) {
  LayerStack stack = stack_of(5, 4);
  ASSERT_EQ(stack.layers().size(), 1U);
  const LayerInfo base = stack.layers().front();
  EXPECT_EQ(base.id, kBaseLayer);
  EXPECT_EQ(base.kind, LayerKind::kColour);
  EXPECT_EQ(base.style, named("canvas"));
  EXPECT_EQ(stack.composed(), std::vector<std::uint8_t>(5 * 4 * 4, 0));
  EXPECT_EQ(stack.version(), 0U);
  EXPECT_EQ(stack.recomposed_cells(), 0U);
}

TEST(LayerStack, BaseDrawings_Noticed) {
  LayerStack stack = stack_of(5, 4);
  stack.base().set_pixel(2, 1, kRed);
  EXPECT_EQ(composed_at(stack, 2, 1), kRed);
  EXPECT_EQ(stack.cell(kBaseLayer, 2, 1), CellValue::of(kRed));
  draw(stack, pixel(kBaseLayer, 3, 1, CellValue::of(kBlue)));
  EXPECT_EQ(stack.base().pixel(3, 1), kBlue);
}

TEST(LayerStack, Order_PriorityThenOwnerThenAge) {
  LayerStack stack = stack_of(4, 4);
  const auto add = [&](int priority, int owner) {
    LayerStyle style = named("x");
    style.priority = priority;
    return stack.add(LayerKind::kColour, style, owner);
  };
  const LayerId late_owner = add(0, 5);
  const LayerId low = add(-1, 9);
  const LayerId early_owner = add(0, -5);
  const LayerId high = add(1, 0);
  const LayerId again = add(0, -5);
  EXPECT_THAT(order_of(stack), ElementsAre(low, kBaseLayer, early_owner, again, late_owner, high));
  LayerStyle raised = stack.style(kBaseLayer);
  raised.priority = 2;
  stack.set_style(kBaseLayer, raised);
  EXPECT_THAT(order_of(stack), ElementsAre(low, early_owner, again, late_owner, high, kBaseLayer));
}

TEST(LayerStack, Ids_NeverReused) {
  LayerStack stack = stack_of(4, 4);
  const LayerId first = stack.add(LayerKind::kGrey, named("a"), 0);
  EXPECT_TRUE(stack.remove(first));
  EXPECT_FALSE(stack.contains(first));
  EXPECT_FALSE(stack.remove(first));
  EXPECT_NE(stack.add(LayerKind::kGrey, named("a"), 0), first);
}

TEST(LayerStack, BaseLayer_NotRemovable) {
  LayerStack stack = stack_of(4, 4);
  EXPECT_FALSE(stack.remove(kBaseLayer));
  EXPECT_TRUE(stack.contains(kBaseLayer));
}

TEST(LayerStack, Kinds_DrawnInTheirColours) {
  LayerStack stack = stack_of(4, 1);
  LayerStyle light_blue = named("inflated");
  light_blue.colour = {100, 150, 255, 255};
  const LayerId binary = stack.add(LayerKind::kBinary, light_blue, 0);
  draw(stack, pixel(binary, 0, 0, CellValue::of(true)));
  EXPECT_EQ(composed_at(stack, 0, 0), light_blue.colour);
  EXPECT_EQ(composed_at(stack, 1, 0), kNothing);

  const LayerId grey = stack.add(LayerKind::kGrey, named("occupancy"), 0);
  const std::array<CellValue, 4> values{CellValue::of(0.0F), CellValue::of(1.0F),
                                        CellValue::of(0.5F), CellValue::of(0.2F)};
  stack.set_cells(grey, {0, 0, 4, 1}, values);
  EXPECT_EQ(composed_at(stack, 0, 0), (Colour{255, 255, 255, 255}));
  EXPECT_EQ(composed_at(stack, 1, 0), (Colour{0, 0, 0, 255}));
  EXPECT_EQ(composed_at(stack, 2, 0), (Colour{128, 128, 128, 255}));  // 127.5, rounded
  EXPECT_EQ(composed_at(stack, 3, 0), (Colour{204, 204, 204, 255}));  // 255 * 0.8
}

TEST(LayerStack, TransparentCells_ShowLayersBelow) {
  LayerStack stack = stack_of(2, 1);
  stack.base().clear({200, 100, 0, 255});
  LayerStyle style = named("grey");
  style.transparency = 0.8;  // 255 * 0.2 = 51 of 255
  const LayerId grey = stack.add(LayerKind::kGrey, style, 0);
  draw(stack, pixel(grey, 0, 0, CellValue::of(0.0F)));
  draw(stack, pixel(grey, 1, 0, CellValue::of(1.0F)));
  // White with alpha 1/5 over (200, 100, 0), then black with alpha 1/5 over the result.
  EXPECT_EQ(composed_at(stack, 0, 0), (Colour{211, 131, 51, 255}));
  EXPECT_EQ(composed_at(stack, 1, 0), (Colour{160, 80, 0, 255}));
  style.transparent_colour = Colour{255, 255, 255, 255};
  stack.set_style(grey, style);
  EXPECT_EQ(composed_at(stack, 0, 0), (Colour{200, 100, 0, 255}));
  EXPECT_EQ(composed_at(stack, 1, 0), (Colour{160, 80, 0, 255}));
}

TEST(LayerStack, Outside_ClippedAndNotRead) {
  LayerStack stack = stack_of(20, 18);
  const LayerId layer = stack.add(LayerKind::kBinary, named("b"), 0);
  constexpr int kLeast = std::numeric_limits<int>::min();
  constexpr int kGreatest = std::numeric_limits<int>::max();
  const CellValue set = CellValue::of(true);
  const std::array<DrawOperation, 6> outside{
      pixel(layer, -1, 0, set),         pixel(layer, 20, 17, set),
      pixel(layer, 0, 18, set),         pixel(layer, kLeast, kGreatest, set),
      line(layer, -9, -1, 40, -1, set), line(layer, 20, kLeast, 20, kGreatest, set)};
  stack.draw(outside);
  const std::vector<CellValue> four(4, set);
  stack.set_cells(layer, {kGreatest - 1, 0, 2, 2}, four);
  stack.set_cells(layer, {kLeast, kLeast, 2, 2}, four);
  EXPECT_EQ(stack.cells(layer), std::vector<CellValue>(20 * 18));
  EXPECT_EQ(stack.version(), 0U);
  for (const auto& [column, row] : {std::pair{-1, 0}, {20, 0}, {0, -1}, {0, 18}}) {
    EXPECT_EQ(stack.cell(layer, column, row), std::nullopt);
  }
  // Of a square at the bottom right corner, one cell is inside.
  stack.set_cells(layer, {19, 17, 2, 2}, four);
  EXPECT_EQ(stack.cell(layer, 19, 17), set);
  draw(stack, line(layer, kLeast, 0, kGreatest, 0, set));
  const std::vector<CellValue> cells = stack.cells(layer);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), set), 1 + 20);
}

TEST(LayerStack, RemovedLayers_NoEffect) {
  LayerStack stack = stack_of(4, 4);
  const LayerId layer = stack.add(LayerKind::kColour, named("gone"), 0);
  stack.remove(layer);
  const std::vector<CellValue> one{CellValue::of(kRed)};
  stack.set_cells(layer, {0, 0, 1, 1}, one);
  draw(stack, fill(layer, CellValue::of(kRed)));
  EXPECT_EQ(stack.cell(layer, 0, 0), std::nullopt);
  EXPECT_EQ(stack.composed(), std::vector<std::uint8_t>(4 * 4 * 4, 0));
}

TEST(LayerStack, Colours_BlendedAndOtherKindsReplaced) {
  LayerStack stack = stack_of(3, 1);
  const LayerId colours = stack.add(LayerKind::kColour, named("c"), 0);
  draw(stack, fill(colours, CellValue::of(Colour{200, 100, 0, 255})));
  draw(stack, pixel(colours, 0, 0, CellValue::of(Colour{0, 0, 255, 51})));
  // Blue with alpha 1/5 over it, as in Canvas.TranslucentColours_Blended.
  EXPECT_EQ(stack.cell(colours, 0, 0)->colour(), (Colour{160, 80, 51, 255}));
  draw(stack, fill(colours, CellValue::of(Colour{1, 2, 3, 4})));
  EXPECT_EQ(stack.cell(colours, 0, 0)->colour(), (Colour{1, 2, 3, 4}));

  const LayerId grey = stack.add(LayerKind::kGrey, named("g"), 0);
  EXPECT_EQ(stack.cell(grey, 1, 0)->occupancy(), 0.5F);
  draw(stack, line(grey, 0, 0, 1, 0, CellValue::of(0.25F)));
  EXPECT_EQ(stack.cell(grey, 1, 0)->occupancy(), 0.25F);
  EXPECT_EQ(stack.cell(grey, 2, 0)->occupancy(), 0.5F);
}

TEST(LayerStack, Resize_KeepsDrawingsInPlace) {
  LayerStack stack = stack_of(6, 4);
  const LayerId grey = stack.add(LayerKind::kGrey, named("g"), 0);
  const double x_m = 0.3;  // column floor((0.3 + 1) / 0.5) = 2
  const double y_m = 2.7;  // one cell above the lowest
  const auto mark = [&] { return std::pair{stack.base().column(x_m), stack.base().row(y_m)}; };
  EXPECT_EQ(mark(), (std::pair{2, 2}));
  stack.base().set_pixel(mark().first, mark().second, kRed);
  draw(stack, pixel(grey, mark().first, mark().second, CellValue::of(0.75F)));
  for (const auto& [width, height] : {std::pair{40, 33}, {3, 2}, {6, 4}}) {
    stack.resize(width, height);
    EXPECT_EQ(stack.width(), width);
    EXPECT_EQ(stack.description().height, height);
    EXPECT_EQ(stack.description().origin, Vec2(-1.0, 2.0));
    EXPECT_EQ(stack.base().data().size(), static_cast<std::size_t>(width * height * 4));
    EXPECT_EQ(mark(), (std::pair{2, height - 2}));
    EXPECT_EQ(stack.base().pixel(mark().first, mark().second), kRed) << width;
    EXPECT_EQ(stack.cell(grey, mark().first, mark().second)->occupancy(), 0.75F) << width;
    const std::vector<CellValue> cells = stack.cells(grey);
    EXPECT_EQ(std::count(cells.begin(), cells.end(), CellValue::of(0.5F)), width * height - 1);
  }
  stack.resize(2, 4);  // cuts the column off
  stack.resize(6, 4);
  EXPECT_EQ(stack.base().pixel(2, 2), kNothing);
}

// Tiles have 16 x 16 cells: 40 x 36 cells are 3 x 3 tiles; the last one is 8 wide and 4 high.
TEST(LayerStackCost, ChangedTiles_ComposedOnly) {
  LayerStack stack = stack_of(40, 36);
  const LayerId grey = stack.add(LayerKind::kGrey, named("g"), 0);
  EXPECT_EQ(cost_of_composing(stack), 40U * 36U);
  EXPECT_EQ(cost_of_composing(stack), 0U);
  draw(stack, pixel(grey, 20, 20, CellValue::of(1.0F)));
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
  stack.base().set_pixel(39, 35, kRed);
  EXPECT_EQ(cost_of_composing(stack), 8U * 4U);
  draw(stack, line(kBaseLayer, 0, 0, 39, 0, CellValue::of(kRed)));
  EXPECT_EQ(cost_of_composing(stack), 40U * 16U);
  const std::vector<CellValue> values(40 * 36, CellValue::of(0.5F));  // all but one are unchanged
  stack.set_cells(grey, {0, 0, 40, 36}, values);
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
}

TEST(LayerStackCost, StyleChange_TouchesDrawnTilesOnly) {
  LayerStack stack = stack_of(40, 36);
  LayerStyle style = named("b");
  const LayerId layer = stack.add(LayerKind::kBinary, style, 0);
  draw(stack, pixel(layer, 0, 0, CellValue::of(true)));
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
  style.colour = kBlue;
  stack.set_style(layer, style);
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
  style.priority = -1;  // below the base
  stack.set_style(layer, style);
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
  draw(stack, fill(layer, CellValue::of(false)));
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
  style.transparency = 0.5;
  stack.set_style(layer, style);  // of a blank layer
  EXPECT_EQ(cost_of_composing(stack), 0U);
}

TEST(LayerStackCost, InvisibleChange_KeepsVersion) {
  LayerStack stack = stack_of(40, 36);
  LayerStyle style = named("hidden");
  style.visible = false;
  const LayerId hidden = stack.add(LayerKind::kGrey, style, 0);
  const LayerId shown = stack.add(LayerKind::kColour, named("shown"), 1);
  draw(stack, pixel(shown, 3, 3, CellValue::of(kRed)));
  static_cast<void>(stack.composed());
  const std::uint64_t version = stack.version();
  const auto expect_untouched = [&](const char* what) {
    EXPECT_EQ(stack.version(), version) << what;
    EXPECT_EQ(cost_of_composing(stack), 0U) << what;
  };

  draw(stack, line(hidden, 0, 0, 30, 30, CellValue::of(1.0F)));
  expect_untouched("drawn on a hidden layer");
  style.transparency = 0.5;
  style.priority = 7;
  stack.set_style(hidden, style);
  expect_untouched("styled a hidden layer");
  LayerStyle renamed = stack.style(shown);
  renamed.name = "else";
  renamed.colour = kBlue;  // layers of colours do not use it
  renamed.priority = 3;    // it is already above the base
  stack.set_style(shown, renamed);
  expect_untouched("renamed");
  stack.set_cells(shown, {0, 0, 40, 36}, stack.cells(shown));
  expect_untouched("set to what it is");
  draw(stack, pixel(shown, 5, 5, CellValue::of(kNothing)));
  expect_untouched("drawn with alpha 0");
  draw(stack, pixel(shown, 40, 5, CellValue::of(kRed)));
  expect_untouched("drawn outside");
  stack.resize(40, 36);
  expect_untouched("resized to the same size");
  stack.remove(hidden);
  expect_untouched("removed a hidden layer");

  draw(stack, pixel(shown, 5, 5, CellValue::of(kRed)));
  EXPECT_EQ(stack.version(), version + 1);
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U);
  EXPECT_EQ(stack.version(), version + 1);
}

TEST(LayerStackCost, ShownLayer_HasEarlierDrawings) {
  LayerStack stack = stack_of(40, 36);
  LayerStyle style = named("l");
  const LayerId layer = stack.add(LayerKind::kColour, style, 0);
  draw(stack, pixel(layer, 0, 0, CellValue::of(kRed)));
  EXPECT_EQ(composed_at(stack, 0, 0), kRed);
  style.visible = false;
  stack.set_style(layer, style);
  draw(stack, pixel(layer, 0, 0, CellValue::of(kBlue)));
  draw(stack, pixel(layer, 39, 35, CellValue::of(kBlue)));
  EXPECT_EQ(composed_at(stack, 0, 0), kNothing);
  style.visible = true;
  stack.set_style(layer, style);
  EXPECT_EQ(cost_of_composing(stack), 16U * 16U + 8U * 4U);
  EXPECT_EQ(composed_at(stack, 0, 0), kBlue);
  EXPECT_EQ(composed_at(stack, 39, 35), kBlue);
}

}  // namespace
/// Drawings of all kinds on the base layer and another one, some of them outside of the canvas.
std::vector<DrawOperation> many_drawings(LayerId other, std::size_t count) {
  std::vector<DrawOperation> drawings(count);
  std::uint32_t state = 12345;
  const auto next = [&](std::uint32_t below) {
    state = state * 1664525U + 1013904223U;
    return (state >> 8U) % below;
  };
  for (DrawOperation& drawing : drawings) {
    const std::uint32_t kind = next(20);
    drawing.kind = kind == 0  ? DrawOperation::Kind::kFill
                   : kind < 8 ? DrawOperation::Kind::kLine
                              : DrawOperation::Kind::kPixel;
    drawing.layer = next(2) == 0 ? kBaseLayer : other;
    for (int* place : {&drawing.x0, &drawing.y0, &drawing.x1, &drawing.y1}) {
      *place = static_cast<int>(next(150)) - 25;
    }
    drawing.value = CellValue::of(Colour{static_cast<std::uint8_t>(next(256)), 7, 9,
                                         static_cast<std::uint8_t>(next(2) == 0 ? 255 : 128)});
  }
  return drawings;
}

TEST(Drawings, PiecesAndWithoutCovered_SameCells) {
  constexpr int kSide = 100;
  const auto make = [](LayerId& other) {
    LayerStack stack(CanvasDescription{kSide, kSide, 0.01, Vec2(0, 0)});
    other = stack.add(LayerKind::kColour, {.name = "other"}, 1);
    return stack;
  };
  LayerId other = 0;
  LayerStack one_by_one = make(other);
  LayerStack at_once = make(other);
  LayerStack in_pieces = make(other);
  const std::vector<DrawOperation> drawings = many_drawings(other, 3000);
  for (const DrawOperation& drawing : drawings) one_by_one.draw({&drawing, 1});
  at_once.draw(drawings);
  DrawProgress progress;
  int pieces = 0;
  constexpr std::size_t kBudget = 500;
  while (progress.operation < drawings.size()) {
    // It may exceed the budget by a line of 100 cells or 16 rows at most.
    EXPECT_LE(in_pieces.draw_some(drawings, progress, kBudget), kBudget + 16 * kSide);
    ++pieces;
  }
  EXPECT_GT(pieces, 1000) << "some 150 fills of 10 000 cells";
  for (const LayerId layer : {kBaseLayer, other}) {
    EXPECT_EQ(at_once.cells(layer), one_by_one.cells(layer));
    EXPECT_EQ(in_pieces.cells(layer), one_by_one.cells(layer));
  }
  EXPECT_EQ(at_once.composed(), one_by_one.composed());
  EXPECT_EQ(in_pieces.composed(), one_by_one.composed());
}

TEST(Drawings, LastFillAndLater_Kept) {
  using Draw = DrawOperation::Kind;
  const auto on = [](Draw kind, LayerId layer, int column = 0) {
    return DrawOperation{kind, layer, column, 0, 0, 0, {}};
  };
  std::vector<DrawOperation> drawings = {
      on(Draw::kPixel, 0),    on(Draw::kFill, 0), on(Draw::kPixel, 1, 5), on(Draw::kFill, 0),
      on(Draw::kPixel, 0, 7), on(Draw::kFill, 1), on(Draw::kFill, 2)};
  drop_covered(drawings);
  ASSERT_EQ(drawings.size(), 4U);
  EXPECT_EQ(drawings[0].kind, Draw::kFill);
  EXPECT_EQ(drawings[1].x0, 7);
  EXPECT_EQ(drawings[2].layer, 1);
  EXPECT_EQ(drawings[3].layer, 2);
}

TEST(Drawings, Cost_CellsInside) {
  using Draw = DrawOperation::Kind;
  const auto cost = [](Draw kind, int x0, int y0, int x1, int y1) {
    return cells_written({kind, 0, x0, y0, x1, y1, {}}, 100, 50);
  };
  EXPECT_EQ(cost(Draw::kPixel, -5, 0, 0, 0), 1U);
  EXPECT_EQ(cost(Draw::kFill, 0, 0, 0, 0), 5000U);
  EXPECT_EQ(cost(Draw::kLine, 0, 0, 9, 3), 10U);
  EXPECT_EQ(cost(Draw::kLine, 9, 30, 0, 0), 31U);
  EXPECT_EQ(cost(Draw::kLine, -2147483647, 0, 2147483647, 9), 100U);
  EXPECT_EQ(cost(Draw::kLine, 200, 0, 300, 40), 1U) << "all outside";
}

TEST(LayerStack, ComposeInPieces_SamePicture) {
  LayerId other = 0;
  LayerStack stack(CanvasDescription{200, 100, 0.01, Vec2(0, 0)});
  other = stack.add(LayerKind::kColour, {.name = "other", .transparency = 0.5}, 1);
  LayerStack whole(CanvasDescription{200, 100, 0.01, Vec2(0, 0)});
  ASSERT_EQ(whole.add(LayerKind::kColour, {.name = "other", .transparency = 0.5}, 1), other);
  const auto drawings = many_drawings(other, 200);
  stack.draw(drawings);
  whole.draw(drawings);
  const std::uint64_t version = stack.version();
  std::vector<std::uint8_t> picture(4 * 200 * 100);
  for (int row = 0; row < 100; row += 7) {
    const auto rows = static_cast<std::size_t>(std::min(7, 100 - row));
    stack.composed_rows(
        row, std::span(picture).subspan(static_cast<std::size_t>(800 * row), 800 * rows));
    EXPECT_EQ(stack.version(), version) << "the picture is what it will be";
  }
  EXPECT_EQ(picture, whole.composed());
  EXPECT_EQ(stack.composed(), whole.composed());
  EXPECT_EQ(stack.recomposed_cells(), whole.recomposed_cells());
}

/// Copies a stack in pieces of `cells` cells, and calls between() before each but the first one.
template <typename Between>
LayerCopy copied(LayerStack& stack, std::size_t cells, const Between& between,
                 LayerCopy copy = LayerCopy()) {
  for (;;) {
    const LayerStack::CopyState state = stack.copy_some(copy, cells);
    if (state == LayerStack::CopyState::kComplete) return copy;
    if (state == LayerStack::CopyState::kNeedsMemory) {
      copy.allocate();
    } else {
      between();
    }
  }
}

TEST(LayerStack, CopyInPieces_WorksDuringChanges) {
  LayerStack stack(CanvasDescription{200, 100, 0.01, Vec2(0, 0)});
  const LayerId grey = stack.add(LayerKind::kGrey, {.name = "grey", .priority = -1}, 7);
  stack.draw(many_drawings(grey, 200));
  stack.draw(many_drawings(kBaseLayer, 200));
  int pieces = 0;
  LayerId added = 0;
  // Draws where the copy has been already, clears, and adds a layer, which begins the copy anew.
  LayerCopy copy = copied(stack, 1000, [&] {
    ++pieces;
    DrawOperation cell;
    cell.layer = grey;
    cell.x0 = pieces;
    cell.value = CellValue::of(0.25F);
    if (pieces < 60) stack.draw({&cell, 1});
    if (pieces == 10) stack.base().clear();
    if (pieces == 20) added = stack.add(LayerKind::kBinary, {.name = "late"}, 1);
  });
  EXPECT_GT(pieces, 40) << "of 40 000 cells, half of them twice";
  LayerStack same = copy.take();
  ASSERT_EQ(same.layers().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(same.layers()[i].id, stack.layers()[i].id);
    EXPECT_EQ(same.layers()[i].style, stack.layers()[i].style);
    EXPECT_EQ(same.layers()[i].owner, stack.layers()[i].owner);
  }
  for (const LayerId layer : {kBaseLayer, grey, added}) {
    EXPECT_EQ(same.cells(layer), stack.cells(layer)) << layer;
  }
  EXPECT_EQ(same.composed(), stack.composed());
  // Also in what only archives show: the tiles that count as used.
  StateArchive one;
  StateArchive other;
  for (auto* pair : {&stack, &same}) {
    StateArchive& archive = pair == &stack ? one : other;
    pair->archive_base(archive);
    pair->archive_others(archive);
  }
  EXPECT_EQ(one.take(), other.take());
}

TEST(LayerStack, OvertakenCopy_Restarts) {
  LayerStack stack(CanvasDescription{200, 100, 0.01, Vec2(0, 0)});
  stack.draw(many_drawings(kBaseLayer, 200));
  bool overtaken = false;
  LayerCopy copy = copied(stack, 1000, [&] {
    if (std::exchange(overtaken, true)) return;
    EXPECT_EQ(copied(stack, 1U << 20U, [] {}).take().cells(kBaseLayer), stack.cells(kBaseLayer));
  });
  EXPECT_TRUE(overtaken);
  EXPECT_EQ(copy.take().cells(kBaseLayer), stack.cells(kBaseLayer));
}

TEST(LayerStack, CopyOfOtherSize_Resizes) {
  LayerStack stack(CanvasDescription{40, 30, 0.01, Vec2(0, 0)});
  const LayerId grey = stack.add(LayerKind::kGrey, {.name = "grey"}, 1);
  LayerStack plain(CanvasDescription{40, 30, 0.01, Vec2(0, 0)});
  ASSERT_EQ(plain.add(LayerKind::kGrey, {.name = "grey"}, 1), grey);
  const auto drawings = many_drawings(grey, 100);
  stack.draw(drawings);
  plain.draw(drawings);
  LayerCopy copy = copied(
      stack, 100, [] {}, LayerCopy(50, 20));
  stack.resize(copy);
  plain.resize(50, 20);
  EXPECT_EQ(stack.width(), 50);
  EXPECT_EQ(stack.cells(kBaseLayer), plain.cells(kBaseLayer));
  EXPECT_EQ(stack.cells(grey), plain.cells(grey));
  EXPECT_EQ(stack.composed(), plain.composed());
  std::vector<CellValue> rows(100);
  stack.copy_rows(grey, 3, rows);
  const auto all = stack.cells(grey);
  EXPECT_TRUE(std::equal(rows.begin(), rows.end(), all.begin() + 150));
  std::vector<std::uint8_t> picture(400);
  stack.picture_rows(grey, 3, picture);
  const auto whole = stack.picture(grey);
  EXPECT_TRUE(std::equal(picture.begin(), picture.end(), whole.begin() + 600));
}

}  // namespace sim
