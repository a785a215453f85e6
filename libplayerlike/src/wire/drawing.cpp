// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that draw: graphics2d.
#include <algorithm>
#include <memory>

#include "libplayerinterface/player_constants.h"
#include "session/canvas_cells.h"
#include "wire/robot_device.h"

namespace playerlike::wire {
namespace {

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
    clear();
  }

  [[nodiscard]] std::vector<DeviceId> sources() const override { return {}; }

  void command(std::uint8_t subtype, std::string_view payload) override {
    switch (subtype) {
      case PLAYER_GRAPHICS2D_CMD_CLEAR:
        static_cast<void>(player::decode<player::Empty>(payload));
        return clear();
      case PLAYER_GRAPHICS2D_CMD_POINTS: {
        const auto asked = player::decode<player::Graphics2dCmdPoints>(payload);
        begin(asked.points, asked.color);
        for (const player::Point2d& point : asked.points) draw_cell(point);
        return;
      }
      case PLAYER_GRAPHICS2D_CMD_POLYLINE: {
        const auto asked = player::decode<player::Graphics2dCmdPolyline>(payload);
        begin(asked.points, asked.color);
        return draw_polyline(asked.points);
      }
      case PLAYER_GRAPHICS2D_CMD_POLYGON:
        return draw_polygon(player::decode<player::Graphics2dCmdPolygon>(payload));
      case PLAYER_GRAPHICS2D_CMD_MULTILINE: {
        const auto asked = player::decode<player::Graphics2dCmdMultiline>(payload);
        begin(asked.points, asked.color);
        for (std::size_t i = 0; i + 1 < asked.points.size(); i += 2) {
          draw_line(asked.points[i], asked.points[i + 1]);
        }
        return;
      }
      default:
        return;
    }
  }

 private:
  using Points = std::vector<player::Point2d>;

  // Player's clients often leave alpha 0 and mean an opaque colour.
  [[nodiscard]] static sim::CellValue value_of(const player::Color& c) {
    return sim::CellValue::of(
        sim::Colour{c.red, c.green, c.blue, c.alpha == 0 ? std::uint8_t{255} : c.alpha});
  }

  // Checks the points, and takes colour and canvas for the following cells and lines.
  void begin(const Points& points, const player::Color& colour) {
    for (const player::Point2d& point : points) {
      require_number("a point's x", point.px);
      require_number("a point's y", point.py);
    }
    canvas_ = session().request(CanvasInfoRequest{});
    value_ = value_of(colour);
  }

  void clear() {
    value_ = sim::CellValue::of(sim::Colour{0, 0, 0, 0});
    put(sim::DrawOperation::Kind::kFill, 0, 0, 0, 0);
  }

  void draw_cell(const player::Point2d& point) {
    put(sim::DrawOperation::Kind::kPixel, column_of(canvas_, point.px), row_of(canvas_, point.py),
        0, 0);
  }

  void draw_line(const player::Point2d& from, const player::Point2d& to) {
    put(sim::DrawOperation::Kind::kLine, column_of(canvas_, from.px), row_of(canvas_, from.py),
        column_of(canvas_, to.px), row_of(canvas_, to.py));
  }

  void draw_polyline(const Points& points) {
    if (points.size() == 1) return draw_cell(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) draw_line(points[i - 1], points[i]);
  }

  void draw_polygon(player::Graphics2dCmdPolygon asked) {
    // Filling takes time in proportion to the number of corners in each row.
    constexpr std::size_t kMostCorners = 10000;
    if (asked.filled != 0 && asked.points.size() > kMostCorners) {
      throw SessionError(SessionError::Code::kBadArgument,
                         "a filled polygon has at most " + std::to_string(kMostCorners) +
                             " corners, but this has " + std::to_string(asked.points.size()));
    }
    begin(asked.points, asked.fill_color);
    if (asked.points.empty()) return;
    if (asked.filled != 0) {
      std::vector<sim::Vec2> corners;
      corners.reserve(asked.points.size());
      for (const player::Point2d& point : asked.points) corners.emplace_back(point.px, point.py);
      for (const CellSpan& span : polygon_spans(canvas_, corners)) {
        put(span.first < span.last ? sim::DrawOperation::Kind::kLine
                                   : sim::DrawOperation::Kind::kPixel,
            span.first, span.row, span.last, span.row);
      }
    }
    value_ = value_of(asked.color);
    if (asked.points.size() > 1) asked.points.push_back(player::Point2d(asked.points.front()));
    draw_polyline(asked.points);
  }

  void put(sim::DrawOperation::Kind kind, int x0, int y0, int x1, int y1) {
    sim::DrawOperation operation;
    operation.kind = kind;
    operation.layer = layer_;
    operation.x0 = x0;
    operation.y0 = y0;
    operation.x1 = x1;
    operation.y1 = y1;
    operation.value = value_;
    session().draw({&operation, 1});
  }

  sim::LayerId layer_ = sim::kBaseLayer;
  CanvasInfo canvas_;     // of the present command
  sim::CellValue value_;  // of the present command
};

}  // namespace

MadeDevice make_drawing_device(const DeviceContext& context) {
  if (context.interface != PLAYER_GRAPHICS2D_CODE) return nullptr;
  return std::make_unique<Graphics2d>(context);
}

}  // namespace playerlike::wire
