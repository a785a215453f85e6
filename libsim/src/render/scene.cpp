// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "render/arena_painter.h"
#include "render/canvas_view.h"
#include "render/controller_painter.h"
#include "render/footer.h"
#include "render/layout.h"
#include "render/painter.h"
#include "render/robot_painter.h"
#include "sim/render/drawing.h"
#include "sim/render/render.h"

namespace sim::render {
namespace {

constexpr int kLeastSizePx = 64;
constexpr int kGreatestSizePx = 8192;

/// All properties of an arena that its picture depends on; equal keys give equal pictures.
struct ArenaKey {
  std::vector<double> numbers;
  std::vector<std::string> names;

  ArenaKey() = default;
  explicit ArenaKey(const ArenaDescription& arena) {
    add(arena.origin);
    add(arena.size);
    numbers.push_back(arena.border ? 1.0 : 0.0);
    for (const auto* boxes : {&arena.obstacles, &arena.dock_separators}) {
      numbers.push_back(static_cast<double>(boxes->size()));
      for (const ObstacleDescription& box : *boxes) {
        numbers.push_back(is_movable(box) ? 1.0 : 0.0);  // drawn anew in each picture
        if (is_movable(box)) continue;
        add(box.center);
        add(box.size);
        numbers.push_back(box.yaw_rad);
        numbers.push_back(static_cast<double>(box.shape));
        for (const Vec2& vertex : box.outline) add(vertex);
        numbers.push_back(static_cast<double>(box.type));
        numbers.push_back(static_cast<double>(box.state));
        numbers.push_back(box.present_height_m ? 1.0 : 0.0);  // drawn anew in each picture
        numbers.push_back(box.solid ? 1.0 : 0.0);
        const Colour colour = box.colour.value_or(Colour{0, 0, 0, 0});
        for (const int channel :
             {int{colour.r}, int{colour.g}, int{colour.b}, box.colour ? 1 : 0}) {
          numbers.push_back(channel);
        }
      }
    }
    for (const DockDescription& dock : arena.docks) {
      add(dock.pose.position());
      add(dock.size);
      numbers.push_back(dock.pose.yaw_rad);
      names.push_back(dock.name);
    }
    for (const WallLoop& loop : arena.walls) {
      numbers.push_back(static_cast<double>(loop.vertices.size()));
      numbers.push_back(loop.solid ? 1.0 : 0.0);
      for (const Vec2& vertex : loop.vertices) add(vertex);
    }
  }
  void add(const Vec2& v) {
    numbers.push_back(v.x());
    numbers.push_back(v.y());
  }

  friend bool operator==(const ArenaKey&, const ArenaKey&) = default;
};

Rectangle to_rectangle(const PixelRect& part) {
  return {static_cast<double>(part.left), static_cast<double>(part.top),
          static_cast<double>(part.right), static_cast<double>(part.bottom)};
}

void fill_rectangle(Painter& painter, const Rectangle& place, double grown_px, Colour colour,
                    double opacity = 1.0) {
  Shape shape;
  shape.add_piece(rectangle_corners(place, grown_px));
  painter.fill(shape, colour, opacity);
}

/// The cached parts of an arena's pictures.
class ArenaView {
 public:
  /// @param once  whether draw() is called only once, which needs fewer copies of the picture.
  ArenaView(const ArenaDescription& arena, const RenderOptions& options,
            const std::optional<ScenePart>& part, bool once)
      : options_(options),
        once_(once),
        layout_(arena, options, part),
        painter_(layout_.width, layout_.height, palette::kPaper) {
    draw_ground(arena, layout_, painter_);
    ground_ = std::move(painter_.image());  // each picture begins with another image
    for (const DockDescription& dock : arena.docks) {
      const Vec2 center = layout_(dock.pose.position());
      const Vec2 half = 0.5 * layout_.pixels_per_m * dock.size;
      docks_.push_back({center.x() - half.x(), center.y() - half.y(), center.x() + half.x(),
                        center.y() + half.y()});
    }
    const auto overlay = [&](auto draw_it) {
      return Overlay(layout_.width, layout_.height,
                     [&](Overlay::Canvas& canvas) { draw_it(arena, layout_, canvas); });
    };
    retracted_ = overlay(draw_retracted);
    solids_ = overlay(draw_solids);
  }

  Image& draw(const SceneSnapshot& scene, ViewMode mode) {
    if (mode == ViewMode::kFullScreen) return draw_full_screen(scene);
    draw_arena(scene, mode == ViewMode::kGround);
    Rectangle covered;
    if (mode == ViewMode::kMiniMap && options_.canvas) {
      draw_mini_map(scene);
      covered = to_rectangle(mini_place_);
    }
    if (layout_.cropped) draw_surround();
    if (layout_.text) draw_texts(scene, layout_, covered, true);
    if (options_.legend && layout_.text) {
      const double border_px = layout_.cropped ? 0.0 : layout_.border_px;
      const double left = std::min(layout_.view.left - border_px, layout_.margin_px);
      draw_footer(scene, layout_,
                  {left, layout_.view.bottom + border_px, layout_.width - left,
                   layout_.view.bottom + layout_.footer_px},
                  layout_.pixels_per_m, painter_);
    }
    return painter_.image();
  }

 private:
  [[nodiscard]] const std::vector<std::uint8_t>& cells_of(const SceneSnapshot& scene,
                                                          bool shown) const {
    return shown && options_.canvas ? scene.canvas : no_cells_;
  }

  void draw_arena(const SceneSnapshot& scene, bool with_canvas) {
    const CanvasDescription& canvas = scene.canvas_description;
    const Vec2 top_left =
        layout_(Vec2(canvas.origin.x(), canvas.origin.y() + canvas.height * canvas.cell_size_m));
    const PixelRect floor = layout_.floor_pixels();
    const CanvasView::Place place = {.columns = canvas.width,
                                     .rows = canvas.height,
                                     .left_px = top_left.x(),
                                     .top_px = top_left.y(),
                                     .cell_px = layout_.pixels_per_m * canvas.cell_size_m,
                                     .part = floor};
    const std::vector<std::uint8_t>& cells = cells_of(scene, with_canvas);
    if (once_) {
      painter_.image() = on_ground_.draw_once(place, cells, std::move(ground_), &retracted_);
    } else {
      painter_.image() = on_ground_.update(place, cells, ground_, &retracted_);
    }
    // Without borders, scans and trails may extend beyond the floor.
    painter_.set_clip(floor);
    if (options_.scans) draw_fans(scene, cells, layout_, painter_);
    if (options_.trails) draw_tracks(scene, layout_, painter_);
    if (options_.trails) draw_trails(scene, cells, layout_, painter_);
    if (options_.traps) draw_traps(scene, layout_, painter_);
    painter_.clear_clip();
    draw_moving_shadows(scene, layout_, painter_);
    draw_mover_shadows(scene, layout_, painter_);
    solids_.draw_on(painter_.image(), {0, 0, layout_.width, layout_.height});
    draw_moving_blocks(scene, layout_, painter_);
    draw_movers(scene, layout_, painter_);
    if (options_.traps) {
      painter_.set_clip(floor);
      draw_covered_traps(scene, layout_, painter_);
      painter_.clear_clip();
    }
    if (options_.scans) draw_seen_surfaces(scene, layout_, painter_);
    draw_robots(scene, layout_, painter_);
    if (options_.goals) draw_goals(scene, layout_, painter_);
    if (options_.collisions) draw_collisions(scene, layout_, painter_);
    draw_events(scene, layout_, options_.traps, painter_);
  }

  // Draws all texts above the scene. `floor` says whether the scene shows the arena's floor.
  void draw_texts(const SceneSnapshot& scene, const Layout& layout, const Rectangle& covered,
                  bool floor) {
    const Notices notices(scene, layout, options_, covered, floor);
    const LabelOptions labels{options_.names, options_.scores, covered, notices.places()};
    notices.draw_trap_names(painter_);
    draw_labels(scene, layout, labels, painter_);
    notices.draw_panels(painter_);
    draw_speech(scene, layout, labels, painter_);
  }

  // Covers everything outside of the shown part and draws a frame around the part.
  void draw_surround() {
    const Rectangle& view = layout_.view;
    const double width = layout_.width;
    const double height = layout_.height;
    for (const Rectangle& side :
         {Rectangle{0.0, 0.0, width, view.top}, Rectangle{0.0, view.bottom, width, height},
          Rectangle{0.0, view.top, view.left, view.bottom},
          Rectangle{view.right, view.top, width, view.bottom}}) {
      fill_rectangle(painter_, side, 0.0, palette::kPaper);
    }
    Shape frame;
    frame.add_line(rectangle_corners(view, 0.0), layout_.line_px(1.4, 1.0), true);
    painter_.fill(frame, palette::kFaintInk);
  }

  // Pixels per cell, as many as fit into the area: an integer, or the inverse of an integer.
  static double whole_scale(const CanvasDescription& canvas, double width_px, double height_px) {
    const double most = std::min(width_px / canvas.width, height_px / canvas.height);
    return most >= 1.0 ? std::floor(most) : 1.0 / std::ceil(1.0 / most);
  }

  // Draws the canvas in a corner of the floor. The choice of the corner ignores robots, since the
  // mini-map would otherwise jump in a film. Robots appear in it as dots.
  void draw_mini_map(const SceneSnapshot& scene) {
    const CanvasDescription& canvas = scene.canvas_description;
    constexpr double kShare = 0.36;  // maximum fraction of the floor's sides
    // Minimum fraction of the above size for integer pixels per cell.
    constexpr double kCrispAtLeast = 0.75;
    const Rectangle& floor = layout_.view;
    const double room_x = kShare * (floor.right - floor.left);
    const double room_y = kShare * (floor.bottom - floor.top);
    double cell_px = std::min(room_x / canvas.width, room_y / canvas.height);
    if (std::floor(cell_px) >= kCrispAtLeast * cell_px) cell_px = std::floor(cell_px);
    const int width = std::max(1, static_cast<int>(std::ceil(canvas.width * cell_px - 1e-9)));
    const int height = std::max(1, static_cast<int>(std::ceil(canvas.height * cell_px - 1e-9)));
    if (mini_ground_.width != width || mini_ground_.height != height) {
      mini_ground_ = Painter(width, height, Colour{255, 255, 255}).image();
      in_corner_.forget();
      mini_place_ = corner_for(width, height);
    }
    const Image& map = in_corner_.update({.columns = canvas.width,
                                          .rows = canvas.height,
                                          .left_px = 0.0,
                                          .top_px = 0.0,
                                          .cell_px = cell_px,
                                          .part = {0, 0, width, height}},
                                         scene.canvas, mini_ground_, nullptr);
    const Rectangle place = to_rectangle(mini_place_);
    const double frame_px = std::max(std::round(1.6 * layout_.unit_px), 1.0);
    for (const double distance : {1.5, 3.0, 5.0}) {
      Rectangle shadow = place;
      shadow.right += distance * layout_.unit_px;
      shadow.bottom += distance * layout_.unit_px;
      fill_rectangle(painter_, shadow, frame_px, palette::kShadow, 0.1);
    }
    fill_rectangle(painter_, place, frame_px, palette::kInk);
    for (int y = 0; y < height; ++y) {
      const std::size_t row_bytes = 3 * static_cast<std::size_t>(width);
      std::copy_n(map.rgb.begin() + static_cast<std::ptrdiff_t>(row_bytes) * y, row_bytes,
                  painter_.image().rgb.begin() +
                      3 * (static_cast<std::ptrdiff_t>(mini_place_.top + y) * layout_.width +
                           mini_place_.left));
    }
    draw_dots(scene, cell_px / canvas.cell_size_m);
  }

  // Draws the robots on the mini-map.
  void draw_dots(const SceneSnapshot& scene, double pixels_per_m) {
    const CanvasDescription& canvas = scene.canvas_description;
    painter_.set_clip(mini_place_);
    for (const RobotSnapshot& robot : scene.robots) {
      const Vec2 from_corner = (robot.X_WB.position() - canvas.origin) * pixels_per_m;
      const Vec2 center(
          mini_place_.left + from_corner.x(),
          mini_place_.top + canvas.height * canvas.cell_size_m * pixels_per_m - from_corner.y());
      if (!is_drawable(center)) continue;
      const double radius_px = layout_.line_px(5.0, 2.5);
      Shape rim;
      rim.add_disc(center, radius_px + layout_.line_px(1.5, 1.0));
      painter_.fill(rim, palette::kHalo);
      Shape dot;
      dot.add_disc(center, radius_px);
      painter_.fill(dot, opaque(robot.colour));
    }
    painter_.clear_clip();
  }

  // The corner of the floor where a mini-map covers the least of docks and solids.
  [[nodiscard]] PixelRect corner_for(int width, int height) const {
    const double gap_px = 14.0 * layout_.unit_px;
    const int left = static_cast<int>(std::lround(layout_.view.left + gap_px));
    const int top = static_cast<int>(std::lround(layout_.view.top + gap_px));
    const int right =
        std::max(left, static_cast<int>(std::lround(layout_.view.right - gap_px)) - width);
    const int bottom =
        std::max(top, static_cast<int>(std::lround(layout_.view.bottom - gap_px)) - height);
    PixelRect best;
    double least = 0.0;
    for (const auto& [x, y] : {std::array{right, top}, std::array{left, top},
                               std::array{right, bottom}, std::array{left, bottom}}) {
      const PixelRect place{x, y, std::min(x + width, layout_.width),
                            std::min(y + height, layout_.height)};
      double hidden = solids_.hidden_px(place);
      for (const Rectangle& dock : docks_) hidden += dock.overlap(to_rectangle(place));
      if (best.right == 0 || hidden < least) {
        best = place;
        least = hidden;
      }
    }
    return best;
  }

  // Draws the canvas with the robots on it. The picture has the same size as the arena's, so that a
  // film can change its mode.
  Image& draw_full_screen(const SceneSnapshot& scene) {
    const CanvasDescription& canvas = scene.canvas_description;
    const bool footer = options_.legend && layout_.text;
    const double frame_px = std::max(std::round(layout_.unit_px), 1.0);
    // The height of the arena's footer without the border.
    const double footer_px = footer ? std::round(66.0 * layout_.unit_px) : frame_px;
    const double room_x = layout_.width - 2.0 * frame_px;
    const double room_y = layout_.height - footer_px - frame_px;
    const double cell_px = whole_scale(canvas, room_x, room_y);
    const int width = std::max(1, static_cast<int>(std::ceil(canvas.width * cell_px - 1e-9)));
    const int height = std::max(1, static_cast<int>(std::ceil(canvas.height * cell_px - 1e-9)));
    const int left = (layout_.width - width) / 2;
    const int top = static_cast<int>(frame_px + std::floor(0.5 * (room_y - height)));
    const PixelRect place{left, top, left + width, top + height};
    if (full_place_ != place) {
      full_place_ = place;
      Painter ground(layout_.width, layout_.height, palette::kPaper);
      fill_rectangle(ground, to_rectangle(place), frame_px, palette::kFaintInk);
      fill_rectangle(ground, to_rectangle(place), 0.0, Colour{255, 255, 255});
      full_ground_ = ground.image();
      alone_.forget();
    }
    painter_.image() = alone_.update({.columns = canvas.width,
                                      .rows = canvas.height,
                                      .left_px = static_cast<double>(left),
                                      .top_px = static_cast<double>(top),
                                      .cell_px = cell_px,
                                      .part = place},
                                     cells_of(scene, true), full_ground_, nullptr);
    // The mapping of W to the picture for the scale of the canvas.
    Layout on_canvas = layout_;
    on_canvas.pixels_per_m = cell_px / canvas.cell_size_m;
    on_canvas.origin = canvas.origin;
    on_canvas.view_only = true;
    on_canvas.floor = {static_cast<double>(left), static_cast<double>(top),
                       left + canvas.width * cell_px, top + canvas.height * cell_px};
    on_canvas.view = on_canvas.floor;
    painter_.set_clip(place);
    draw_robots(scene, on_canvas, painter_);
    painter_.clear_clip();
    if (layout_.text) draw_texts(scene, on_canvas, {}, false);
    if (footer) {
      const double bottom = layout_.height;
      draw_footer(
          scene, layout_,
          {layout_.margin_px, bottom - footer_px, layout_.width - layout_.margin_px, bottom},
          cell_px / canvas.cell_size_m, painter_);
    }
    return painter_.image();
  }

  const std::vector<std::uint8_t> no_cells_;
  RenderOptions options_;
  bool once_;
  Layout layout_;
  Painter painter_;
  Image ground_;  // floor and docks
  std::vector<Rectangle> docks_;
  Overlay retracted_;
  Overlay solids_;
  CanvasView on_ground_;
  Image mini_ground_;
  PixelRect mini_place_;
  CanvasView in_corner_;
  Image full_ground_;
  PixelRect full_place_;
  CanvasView alone_;
};

// @throws std::invalid_argument naming the value that is out of range.
void check(const RenderOptions& options) {
  const auto check_side = [](const char* what, int side_px) {
    if (side_px >= kLeastSizePx && side_px <= kGreatestSizePx) return;
    throw std::invalid_argument(
        std::string(what) + " of a picture must be in " + std::to_string(kLeastSizePx) + ".." +
        std::to_string(kGreatestSizePx) + " pixels, found " + std::to_string(side_px));
  };
  if (options.width_px == 0 && options.height_px == 0) {
    check_side("size", options.size_px);
  } else {
    check_side("width", options.width_px);
    check_side("height", options.height_px);
  }
  if (options.part && !(options.part->size.minCoeff() > 0.0 && options.part->size.allFinite() &&
                        options.part->low.allFinite())) {
    throw std::invalid_argument("the part of the world that a picture shows must have a size");
  }
}

// @throws std::invalid_argument if the canvas does not have as many cells as its description says.
void check(const SceneSnapshot& scene) {
  if (!scene.canvas.empty() && scene.canvas.size() != canvas_bytes(scene.canvas_description)) {
    throw std::invalid_argument("a scene's canvas must have 4 bytes a cell");
  }
}

// Calls draw(scene) with the scene's robots in the colours that the options ask for.
template <typename Draw>
decltype(auto) draw_coloured(const SceneSnapshot& scene, ColourBy colour_by, Draw draw) {
  if (colour_by == ColourBy::kWorld) return draw(scene);
  SceneSnapshot coloured = scene;
  for (std::size_t i = 0; i < coloured.robots.size(); ++i) {
    coloured.robots[i].colour =
        colour_by == ColourBy::kRobot ? distinct_colour(i) : palette::kFaintInk;
  }
  return draw(std::as_const(coloured));
}

// Returns the part of a scene to show; none: the whole arena.
std::optional<ScenePart> shown_part(const SceneSnapshot& scene, const RenderOptions& options,
                                    ViewMode mode) {
  if (mode == ViewMode::kFullScreen) return std::nullopt;
  for (const RobotSnapshot& robot : scene.robots) {
    if (options.follow.empty() || robot.name != options.follow) continue;
    constexpr double kRadii = 20.0;
    double radius_m = 0.0;
    for (const Vec2& corner : robot.footprint) radius_m = std::max(radius_m, corner.norm());
    double width_m = options.follow_width_m > 0.0 ? options.follow_width_m : kRadii * radius_m;
    if (!(width_m > 0.0)) width_m = scene.arena.size.maxCoeff();
    const Vec2 size(width_m, width_m);
    const Vec2 low = robot.X_WB.position() - 0.5 * size;
    if (low.allFinite()) return ScenePart{low, size, true};
  }
  return options.part;
}

}  // namespace

struct SceneRenderer::Impl {
  const Image& draw(const SceneSnapshot& scene, ViewMode mode);

  RenderOptions options;
  ArenaKey key;
  std::optional<ScenePart> part;
  std::optional<ArenaView> view;
};

SceneRenderer::SceneRenderer(const RenderOptions& options) {
  check(options);
  impl_ = std::make_unique<Impl>();
  impl_->options = options;
}

SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

const Image& SceneRenderer::draw(const SceneSnapshot& scene, ViewMode mode) {
  check(scene);
  return draw_coloured(
      scene, impl_->options.colour_by,
      [&](const SceneSnapshot& coloured) -> const Image& { return impl_->draw(coloured, mode); });
}

const Image& SceneRenderer::Impl::draw(const SceneSnapshot& scene, ViewMode mode) {
  ArenaKey newest_key(scene.arena);
  const std::optional<ScenePart> newest_part = shown_part(scene, options, mode);
  if (!view || !(newest_key == key) || newest_part != part) {
    view.emplace(scene.arena, options, newest_part, false);
    key = std::move(newest_key);
    part = newest_part;
  }
  return view->draw(scene, mode);
}

Image draw_view(const SceneSnapshot& scene, ViewMode mode, const RenderOptions& options) {
  check(options);
  check(scene);
  return draw_coloured(scene, options.colour_by, [&](const SceneSnapshot& coloured) {
    ArenaView view(coloured.arena, options, shown_part(coloured, options, mode), true);
    return std::move(view.draw(coloured, mode));
  });
}

Image draw_view(const SceneSnapshot& scene, const RenderOptions& options) {
  return draw_view(scene, scene.view_mode, options);
}

Image draw_scene(const SceneSnapshot& scene, const RenderOptions& options) {
  return draw_view(scene, ViewMode::kGround, options);
}

Vec2 place_in_picture(const SceneSnapshot& scene, const RenderOptions& options, const Vec2& p_W) {
  check(options);
  const Layout layout(scene.arena, options, shown_part(scene, options, ViewMode::kGround));
  return layout(p_W);
}

}  // namespace sim::render
