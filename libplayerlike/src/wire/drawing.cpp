// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that draw: graphics2d.
#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "libplayerinterface/player_constants.h"
#include "session/canvas_cells.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

using Kind = sim::DrawOperation::Kind;
using Points = std::vector<player::Point2d>;

// A batch has so many drawings, or was found with so many comparisons of a polygon's corners.
constexpr std::size_t kBatch = 4096;
constexpr std::size_t kComparisons = std::size_t{1} << 20U;

/// Drawings of one layer: the inside of a polygon, then single cells and lines.
class Sketch final : public Drawings {
 public:
  Sketch(sim::LayerId layer, const CanvasInfo& canvas) : layer_(layer), canvas_(canvas) {}

  void set_colour(const sim::CellValue& value) { value_ = value; }
  void fill() { put(Kind::kFill, 0, 0, 0, 0); }
  void draw_cell(const player::Point2d& point) {
    put(Kind::kPixel, column_of(canvas_, point.px), row_of(canvas_, point.py), 0, 0);
  }
  void draw_line(const player::Point2d& from, const player::Point2d& to) {
    put(Kind::kLine, column_of(canvas_, from.px), row_of(canvas_, from.py),
        column_of(canvas_, to.px), row_of(canvas_, to.py));
  }
  void draw_polyline(const Points& points) {
    if (points.size() == 1) return draw_cell(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) draw_line(points[i - 1], points[i]);
  }
  /// Comes before everything else.
  void fill_polygon(std::span<const sim::Vec2> corners) {
    inside_.emplace(canvas_, corners);
    corners_ = corners.size();
    fill_value_ = value_;
  }

  bool next(std::vector<sim::DrawOperation>& batch) override {
    batch.clear();
    if (inside_) {
      next_inside(batch);
      return true;
    }
    const std::size_t count = std::min(kBatch, drawings_.size() - next_);
    const auto first = drawings_.begin() + static_cast<std::ptrdiff_t>(next_);
    batch.assign(first, first + static_cast<std::ptrdiff_t>(count));
    next_ += count;
    return count > 0;
  }

 private:
  void next_inside(std::vector<sim::DrawOperation>& batch) {
    for (std::size_t compared = 0; compared < kComparisons && batch.size() < kBatch;
         compared += corners_) {
      spans_.clear();
      if (!inside_->next(spans_)) return inside_.reset();
      for (const CellSpan& span : spans_) {
        batch.push_back(operation(span.first < span.last ? Kind::kLine : Kind::kPixel, span.first,
                                  span.row, span.last, span.row, fill_value_));
      }
    }
  }

  void put(Kind kind, int x0, int y0, int x1, int y1) {
    drawings_.push_back(operation(kind, x0, y0, x1, y1, value_));
  }

  [[nodiscard]] sim::DrawOperation operation(Kind kind, int x0, int y0, int x1, int y1,
                                             const sim::CellValue& value) const {
    sim::DrawOperation made;
    made.kind = kind;
    made.layer = layer_;
    made.x0 = x0;
    made.y0 = y0;
    made.x1 = x1;
    made.y1 = y1;
    made.value = value;
    return made;
  }

  sim::LayerId layer_;
  CanvasInfo canvas_;
  sim::CellValue value_;
  std::optional<PolygonRows> inside_;  // while rows are left
  std::size_t corners_ = 0;
  sim::CellValue fill_value_;
  std::vector<CellSpan> spans_;
  std::vector<sim::DrawOperation> drawings_;
  std::size_t next_ = 0;
};

/// Graphics2dProxy's counterpart: draws on a layer of the client. The layer remains when the device
/// is closed, and is cleared when it is opened again.
class Graphics2d final : public RobotDevice {
 public:
  explicit Graphics2d(const DeviceContext& context) : RobotDevice(context) {
    sim::LayerStyle style;
    style.name = "graphics2d";
    if (context.index > 0) style.name += '_' + std::to_string(context.index);
    constexpr int kPriority = 100;
    style.priority = kPriority;
    const std::vector<sim::LayerInfo> layers = session().request(LayersRequest{});
    const auto earlier = std::find_if(layers.begin(), layers.end(), [&](const sim::LayerInfo& l) {
      return l.style.name == style.name;
    });
    if (earlier == layers.end()) {
      layer_ = session().request(CreateLayerRequest{sim::LayerKind::kColour, style});
      return;
    }
    layer_ = earlier->id;
    command(PLAYER_GRAPHICS2D_CMD_CLEAR, {});
  }

  [[nodiscard]] std::vector<DeviceId> sources() const override { return {}; }

  void command(std::uint8_t subtype, std::string_view payload) override {
    const std::unique_ptr<Drawings> all = drawings(subtype, payload);
    std::vector<sim::DrawOperation> batch;
    while (all != nullptr && all->next(batch)) session().draw(batch);
  }

  [[nodiscard]] std::unique_ptr<Drawings> drawings(std::uint8_t subtype,
                                                   std::string_view payload) override {
    switch (subtype) {
      case PLAYER_GRAPHICS2D_CMD_CLEAR: {
        static_cast<void>(player::decode<player::Empty>(payload));
        auto sketch = begin({}, {});
        sketch->set_colour(sim::CellValue::of(sim::Colour{0, 0, 0, 0}));
        sketch->fill();
        return sketch;
      }
      case PLAYER_GRAPHICS2D_CMD_POINTS: {
        const auto asked = player::decode<player::Graphics2dCmdPoints>(payload);
        auto sketch = begin(asked.points, asked.color);
        for (const player::Point2d& point : asked.points) sketch->draw_cell(point);
        return sketch;
      }
      case PLAYER_GRAPHICS2D_CMD_POLYLINE: {
        const auto asked = player::decode<player::Graphics2dCmdPolyline>(payload);
        auto sketch = begin(asked.points, asked.color);
        sketch->draw_polyline(asked.points);
        return sketch;
      }
      case PLAYER_GRAPHICS2D_CMD_POLYGON:
        return polygon(player::decode<player::Graphics2dCmdPolygon>(payload));
      case PLAYER_GRAPHICS2D_CMD_MULTILINE: {
        const auto asked = player::decode<player::Graphics2dCmdMultiline>(payload);
        auto sketch = begin(asked.points, asked.color);
        for (std::size_t i = 0; i + 1 < asked.points.size(); i += 2) {
          sketch->draw_line(asked.points[i], asked.points[i + 1]);
        }
        return sketch;
      }
      default:
        return nullptr;
    }
  }

 private:
  // Player's clients often leave alpha 0 and mean an opaque colour.
  [[nodiscard]] static sim::CellValue value_of(const player::Color& c) {
    return sim::CellValue::of(
        sim::Colour{c.red, c.green, c.blue, c.alpha == 0 ? std::uint8_t{255} : c.alpha});
  }

  // Checks the points, and takes colour and canvas for the following cells and lines.
  [[nodiscard]] std::unique_ptr<Sketch> begin(const Points& points,
                                              const player::Color& colour) const {
    for (const player::Point2d& point : points) {
      require_number("a point's x", point.px);
      require_number("a point's y", point.py);
    }
    auto sketch = std::make_unique<Sketch>(layer_, session().request(CanvasInfoRequest{}));
    sketch->set_colour(value_of(colour));
    return sketch;
  }

  [[nodiscard]] std::unique_ptr<Drawings> polygon(player::Graphics2dCmdPolygon asked) const {
    // Filling takes time in proportion to the number of corners in each row.
    constexpr std::size_t kMostCorners = 10000;
    if (asked.filled != 0 && asked.points.size() > kMostCorners) {
      throw SessionError(SessionError::Code::kBadArgument,
                         "a filled polygon has at most " + std::to_string(kMostCorners) +
                             " corners, but this has " + std::to_string(asked.points.size()));
    }
    auto sketch = begin(asked.points, asked.fill_color);
    if (asked.points.empty()) return sketch;
    if (asked.filled != 0) {
      std::vector<sim::Vec2> corners;
      corners.reserve(asked.points.size());
      for (const player::Point2d& point : asked.points) corners.emplace_back(point.px, point.py);
      sketch->fill_polygon(corners);
    }
    sketch->set_colour(value_of(asked.color));
    if (asked.points.size() > 1) asked.points.push_back(player::Point2d(asked.points.front()));
    sketch->draw_polyline(asked.points);
    return sketch;
  }

  sim::LayerId layer_ = sim::kBaseLayer;
};

}  // namespace

MadeDevice make_drawing_device(const DeviceContext& context) {
  if (context.interface != PLAYER_GRAPHICS2D_CODE) return nullptr;
  return std::make_unique<Graphics2d>(context);
}

}  // namespace playerlike::wire
