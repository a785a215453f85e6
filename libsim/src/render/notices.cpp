// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Texts of the arena controller: names of traps, texts on the scene, messages and countdowns.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "render/controller_painter.h"
#include "render/robot_place.h"
#include "sim/core/number_text.h"

namespace sim::render {
namespace {

constexpr std::size_t kMostCountdowns = 6;
constexpr std::size_t kMostMessages = 2;
constexpr std::size_t kMostLines = 60;
constexpr double kSoon_s = 3.0;  // a countdown's end is near

Rectangle grown(const Rectangle& place, double by) {
  return {place.left - by, place.top - by, place.right + by, place.bottom + by};
}

// The rectangle of a given size that lies nearest to a middle and inside a frame; if the frame is
// too small, in its middle.
Rectangle placed_within(const Rectangle& frame, const Vec2& middle, const Vec2& half) {
  const auto within = [](double at, double low, double high) {
    return low <= high ? std::clamp(at, low, high) : 0.5 * (low + high);
  };
  const Vec2 center(within(middle.x(), frame.left + half.x(), frame.right - half.x()),
                    within(middle.y(), frame.top + half.y(), frame.bottom - half.y()));
  return rectangle(center - half, center + half);
}

Rectangle bounds_of(const std::vector<Vec2>& points) {
  Vec2 low = points.front();
  Vec2 high = low;
  for (const Vec2& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return rectangle(low, high);
}

// Tenths of seconds up to 100 s, then seconds.
std::string countdown_text(double time_s) {
  return fixed_text(std::max(time_s, 0.0), time_s < 99.95 ? 1 : 0) + " s";
}

std::string message_text(const ArenaEvent& event) {
  std::string text = printable(event.text);
  if (event.kind == ArenaEventKind::kConfiguration) {
    text = std::string("configuration ").append(event.what);
  }
  return text;
}

void fill_rounded(Painter& painter, const Rectangle& place, double radius_px, Colour colour,
                  double opacity) {
  Shape shape;
  shape.add_piece(rounded(place, radius_px));
  painter.fill(shape, colour, opacity);
}

}  // namespace

Notices::Notices(const SceneSnapshot& scene, const Layout& layout, const RenderOptions& options,
                 const Rectangle& covered, bool floor)
    : scene_(scene), layout_(layout) {
  if (!layout.text) return;
  if (options.texts) {
    add_texts();
    add_messages();
  }
  if (options.timers) add_countdowns(covered);
  if (options.traps && floor) add_trap_names(covered);
  // Names of traps do not move aside for points, because they would jump in a film.
  if (options.scores) add_points(covered);
}

std::vector<Rectangle> Notices::places() const {
  std::vector<Rectangle> all;
  for (const Line& name : trap_names_) all.push_back(name.place);
  for (const Line& points : points_) all.push_back(points.place);
  for (const TextBox& box : texts_) all.push_back(box.place);
  for (const TextBox& box : messages_) all.push_back(box.place);
  if (!countdowns_.empty()) all.push_back(countdown_place_);
  return all;
}

void Notices::add_texts() {
  const Rectangle& view = layout_.view;
  for (const SceneText& text : scene_.texts) {
    const Vec2 middle = layout_(text.place);
    if (!is_drawable(middle) || middle.x() < view.left || middle.x() > view.right ||
        middle.y() < view.top || middle.y() > view.bottom) {
      continue;
    }
    const TextStyle style = layout_.text_style(15.0, opaque(text.colour));
    TextBox box(wrapped(printable(text.text), style, 0.44 * (view.right - view.left), 4), style);
    if (box.lines.front().empty()) continue;
    box.place = placed_within(grown(view, -4.0 * layout_.unit_px), middle, box.half_size());
    texts_.push_back(std::move(box));
  }
}

// The newest messages and configurations, at the lower edge of the view.
void Notices::add_messages() {
  const Rectangle& view = layout_.view;
  std::vector<const ArenaEvent*> events;
  for (const ArenaEvent& event : scene_.events) {
    const bool is_message =
        event.kind == ArenaEventKind::kMessage || event.kind == ArenaEventKind::kConfiguration;
    if (is_message && event_age(scene_, event) <= 1.0) events.push_back(&event);
  }
  if (events.size() > kMostMessages) {
    events.erase(events.begin(), events.end() - static_cast<std::ptrdiff_t>(kMostMessages));
  }
  double bottom = view.bottom - 10.0 * layout_.unit_px;
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    TextStyle style = layout_.text_style(12.5, palette::kLight);
    TextBox box(wrapped(message_text(**event), style, 0.7 * (view.right - view.left), 1), style);
    if (box.lines.front().empty()) continue;
    const Vec2 half = box.half_size();
    const double gap_px = 5.0 * layout_.unit_px;
    const auto put = [&] {
      const Vec2 middle(0.5 * (view.left + view.right), bottom - half.y());
      box.place = placed_within(view, middle, half);
    };
    put();
    for (std::size_t tries = 0; tries < texts_.size(); ++tries) {
      const auto hidden = std::find_if(texts_.begin(), texts_.end(), [&](const TextBox& text) {
        return text.place.overlap(box.place) > 0.0;
      });
      if (hidden == texts_.end()) break;
      bottom = hidden->place.top - gap_px;
      put();
    }
    bottom = box.place.top - gap_px;
    messages_.push_back(std::move(box));
    const double age = event_age(scene_, **event);
    message_opacities_.push_back(std::min(1.0, 2.5 * (1.0 - age)));
  }
}

void Notices::add_countdowns(const Rectangle& covered) {
  struct Entry {
    std::size_t timer;
    double time_left_s;
    double flash;
  };
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < scene_.timers.size(); ++i) {
    const TimerMark& timer = scene_.timers[i];
    double flash = 0.0;
    for (const ArenaEvent& event : scene_.events) {
      if (event.kind == ArenaEventKind::kTimer && event.what == timer.name) {
        flash = std::max(flash, 1.0 - event_age(scene_, event));
      }
    }
    if (!timer.time_left_s && flash <= 0.0) continue;
    entries.push_back({i, timer.time_left_s.value_or(-1.0), std::max(flash, 0.0)});
  }
  if (entries.empty()) return;
  if (entries.size() > kMostCountdowns) {
    more_.assign(1, '+');
    more_ += std::to_string(entries.size() - kMostCountdowns);
    more_ += " more";
    // Those that act next, in the world's order.
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.time_left_s < b.time_left_s; });
    entries.resize(kMostCountdowns);
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.timer < b.timer; });
  }
  countdown_style_ = layout_.text_style(11.5, palette::kInk);
  const TextStyle& style = countdown_style_;
  const double cap = style.cap_height_px;
  // The width does not depend on the time, so that the panel stands still in a film.
  const double time_px = Painter::text_width_px("000.0 s", style);
  double name_px = Painter::text_width_px(more_, style);
  for (const Entry& entry : entries) {
    Countdown row;
    row.name = shortened(printable(scene_.timers[entry.timer].name), style,
                         0.2 * (layout_.view.right - layout_.view.left));
    row.time = entry.time_left_s < 0.0 ? "now" : countdown_text(entry.time_left_s);
    row.soon = entry.time_left_s < kSoon_s;
    row.flash = entry.flash;
    name_px = std::max(name_px, Painter::text_width_px(row.name, style));
    countdowns_.push_back(std::move(row));
  }
  const double rows = static_cast<double>(countdowns_.size()) + (more_.empty() ? 0.0 : 1.0);
  const Vec2 size(name_px + time_px + 5.4 * cap, (1.9 * rows + 1.0) * cap);
  countdown_place_ = corner_for(size, covered);
}

// The corner of the view where a panel covers the least of the arena. Robots and the states of
// blocks have no influence, because the panel would otherwise jump in a film.
Rectangle Notices::corner_for(const Vec2& size, const Rectangle& covered) const {
  const Rectangle& view = layout_.view;
  const double gap_px = 12.0 * layout_.unit_px;
  const Rectangle frame = grown(view, -gap_px);
  const Vec2 half = 0.5 * size;
  Rectangle best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& corner : {Vec2(frame.right, frame.top), Vec2(frame.left, frame.top),
                             Vec2(frame.right, frame.bottom), Vec2(frame.left, frame.bottom)}) {
    const Rectangle place = placed_within(frame, corner, half);
    double hidden = 20.0 * covered.overlap(place);
    const auto add = [&](const std::vector<Vec2>& points, double weight) {
      if (!points.empty()) hidden += weight * bounds_of(points).overlap(place);
    };
    if (!layout_.cropped) {
      for (const ObstacleDescription& box : scene_.arena.obstacles) {
        if (!box.portable) add(obstacle_outline(box, layout_), 1.0);
      }
      for (const ObstacleDescription& box : scene_.arena.dock_separators) {
        add(obstacle_outline(box, layout_), 1.0);
      }
      for (const DockDescription& dock : scene_.arena.docks) {
        add(layout_(box_corners(dock.pose, dock.size)), 1.0);
      }
      for (const WallLoop& loop : scene_.arena.walls) {
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
          const Vec2 a = layout_(loop.vertices[i]);
          const Vec2 b = layout_(loop.vertices[(i + 1) % loop.vertices.size()]);
          hidden += grown(bounds_of({a, b}), 3.0 * layout_.unit_px).overlap(place);
        }
      }
      for (const TrapMark& trap : scene_.traps) add(layout_(trap.outline), 0.3);
    }
    for (const TextBox& text : texts_) hidden += 3.0 * text.place.overlap(place);
    if (hidden >= least) continue;
    least = hidden;
    best = place;
  }
  return best;
}

// Names stand on the upper edge of their traps, or elsewhere if other texts or blocks are there.
void Notices::add_trap_names(const Rectangle& covered) {
  if (scene_.traps.empty()) return;
  std::vector<Rectangle> taken = places();
  if (covered.right > covered.left) taken.push_back(covered);
  std::vector<Rectangle> blocks;
  for (const ObstacleDescription& box : scene_.arena.obstacles) {
    blocks.push_back(bounds_of(obstacle_outline(box, layout_)));
  }
  for (const TrapMark& trap : scene_.traps) {
    if (trap_names_.size() == kMostLines) return;
    const std::vector<Vec2> outline = trap_outline(trap, layout_);
    if (outline.empty()) continue;
    Line name;
    const bool occupied = trap.enabled && !trap.robots.empty();
    name.style = layout_.text_style(
        10.5, trap.enabled ? mix(palette::kTrap, palette::kInk, occupied ? 0.0 : 0.2)
                           : mix(palette::kTrap, palette::kPaper, 0.45));
    name.style.weight = occupied ? 0.19 : 0.14;
    name.style.halo = palette::kHalo;
    name.style.halo_px = std::max(3.0 * layout_.unit_px, 1.5);
    name.text = shortened(printable(trap.name), name.style, 0.25 * layout_.width);
    if (name.text.empty() || !find_place(name, outline, taken, blocks)) continue;
    taken.push_back(name.place);
    trap_names_.push_back(std::move(name));
  }
}

// Returns whether there is a place where the name and other texts are legible.
bool Notices::find_place(Line& name, const std::vector<Vec2>& outline,
                         const std::vector<Rectangle>& taken,
                         const std::vector<Rectangle>& blocks) const {
  // The width must not depend on whether a robot is inside.
  TextStyle measured = name.style;
  measured.weight = 0.14;
  const Vec2 half(0.5 * Painter::text_width_px(name.text, measured),
                  0.5 * name.style.cap_height_px);
  Vec2 top = 0.5 * (outline.front() + outline.back());
  Vec2 bottom = top;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    const Vec2 middle = 0.5 * (outline[i - 1] + outline[i]);
    if (middle.y() < top.y()) top = middle;
    if (middle.y() > bottom.y()) bottom = middle;
  }
  const Rectangle bounds = bounds_of(outline);
  constexpr std::size_t kMostCorners = 8;  // an outline with more of them is round
  if (outline.size() > kMostCorners) {
    const double x = 0.5 * (bounds.left + bounds.right);
    top = {x, bounds.top};
    bottom = {x, bounds.bottom};
  }
  const double step = 2.4 * half.y() + 3.0 * layout_.unit_px;
  const std::array<Vec2, 6> middles = {top,
                                       bottom,
                                       Vec2(top.x(), bounds.top + step),
                                       Vec2(top.x(), bounds.top - step),
                                       Vec2(bottom.x(), bounds.bottom + step),
                                       Vec2(0.5 * (top + bottom))};
  const double area = 4.0 * half.x() * half.y();
  const Rectangle frame = grown(layout_.view, -6.0 * layout_.unit_px);
  double least = std::numeric_limits<double>::infinity();
  double overlap = 0.0;
  double preference = 0.0;
  for (const Vec2& middle : middles) {
    const Rectangle place = placed_within(frame, middle, half);
    const Rectangle with_halo = grown(place, name.style.halo_px + 1.0);
    double other = 0.0;
    for (const Rectangle& text : taken) other += with_halo.overlap(text) / area;
    double cost = preference + 4.0 * other;
    for (const Rectangle& block : blocks) cost += 0.8 * place.overlap(block) / area;
    cost += (Vec2(place.left, place.top) + half - middle).norm() / half.norm();
    preference += 0.15;
    if (cost >= least) continue;
    least = cost;
    overlap = other;
    name.place = place;
  }
  return overlap <= 0.5;
}

// Points rise beside the robots that get them.
void Notices::add_points(const Rectangle& covered) {
  for (const ArenaEvent& event : scene_.events) {
    const double age = event_age(scene_, event);
    if (event.kind != ArenaEventKind::kScore || age > 1.0) continue;
    for (const RobotSnapshot& robot : scene_.robots) {
      if (robot.name != event.who || !has_place(robot, layout_)) continue;
      const Vec2 center = layout_(robot.X_WB.position());
      if (covered.overlap(grown(rectangle(center, center), 1.0)) > 0.0) continue;
      Line& points = points_.emplace_back();
      points.style =
          layout_.text_style(14.0, event.value < 0.0 ? palette::kFailed : palette::kPassed);
      points.style.weight = 0.18;
      points.style.halo = palette::kHalo;
      points.style.halo_px = std::max(2.4 * layout_.unit_px, 1.5);
      if (event.value >= 0.0) points.text.assign(1, '+');
      points.text += rounded_text(event.value, 6);
      const Vec2 half(0.5 * Painter::text_width_px(points.text, points.style),
                      0.5 * points.style.cap_height_px);
      const double radius_px = marked_radius_px(robot, layout_);
      const Vec2 middle = center + Vec2(radius_px + half.x() + 6.0 * layout_.unit_px,
                                        -(4.0 + 26.0 * age) * layout_.unit_px);
      points.place = placed_within(grown(layout_.view, -5.0 * layout_.unit_px), middle, half);
    }
  }
}

void Notices::draw_trap_names(Painter& painter) const {
  for (const Line& name : trap_names_) {
    painter.draw_text(name.text, {name.place.left, name.place.bottom}, name.style);
  }
}

void Notices::draw_panels(Painter& painter) const {
  if (!countdowns_.empty()) draw_countdowns(painter);
  for (const TextBox& box : texts_) draw_text_box(box, painter);
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    const TextBox& box = messages_[i];
    const double opacity = message_opacities_[i];
    fill_rounded(painter, box.place, 1.1 * box.style.cap_height_px, palette::kInk, 0.88 * opacity);
    TextBox faded = box;
    faded.style.colour.a = static_cast<std::uint8_t>(std::lround(255.0 * opacity));
    faded.draw_lines(painter);
  }
  for (const Line& points : points_) {
    painter.draw_text(points.text, {points.place.left, points.place.bottom}, points.style);
  }
}

// A light panel with a rim in the text's colour. The panel of a light text is dark.
void Notices::draw_text_box(const TextBox& box, Painter& painter) const {
  const double radius_px = layout_.line_px(5.0, 2.0);
  const bool light = luma(box.style.colour) > 0.55;
  for (const double distance : {1.2, 2.6}) {
    const double d = distance * layout_.unit_px;
    const Rectangle& p = box.place;
    fill_rounded(painter, {p.left + 0.6 * d, p.top + d, p.right + 0.6 * d, p.bottom + d}, radius_px,
                 palette::kShadow, 0.08);
  }
  fill_rounded(painter, box.place, radius_px, light ? palette::kInk : palette::kLight, 0.9);
  Shape rim;
  rim.add_line(rounded(box.place, radius_px), layout_.line_px(1.4, 1.0), true);
  painter.fill(rim, box.style.colour, 0.8);
  box.draw_lines(painter);
}

void Notices::draw_countdowns(Painter& painter) const {
  const TextStyle& style = countdown_style_;
  const double cap = style.cap_height_px;
  const Rectangle& panel = countdown_place_;
  const double radius_px = layout_.line_px(5.0, 2.0);
  fill_rounded(painter, panel, radius_px, palette::kLight, 0.88);
  Shape rim;
  rim.add_line(rounded(panel, radius_px), layout_.line_px(1.1, 0.8), true);
  painter.fill(rim, palette::kFaintInk, 0.6);
  double base = panel.top + 1.95 * cap;
  for (const Countdown& row : countdowns_) {
    const Rectangle band{panel.left + 0.5 * cap, base - 1.4 * cap, panel.right - 0.5 * cap,
                         base + 0.4 * cap};
    if (row.flash > 0.0) {
      fill_rounded(painter, band, 0.5 * cap, palette::kAlert, 0.35 * row.flash);
    }
    TextStyle shown = style;
    if (row.soon) shown.colour = mix(palette::kAlert, palette::kInk, 0.15);
    // A clock.
    const Vec2 center(panel.left + 1.5 * cap, base - 0.5 * cap);
    const double clock_px = 0.62 * cap;
    const double line_px = std::max(0.13 * cap, 1.0);
    painter.fill_ring(center, clock_px, line_px, shown.colour);
    Shape hands;
    hands.add_line(
        {center + Vec2(0.0, -0.62 * clock_px), center, center + Vec2(0.5 * clock_px, 0.0)},
        line_px);
    painter.fill(hands, shown.colour);
    painter.draw_text(row.name, {panel.left + 2.7 * cap, base}, style);
    painter.draw_text(
        row.time, {panel.right - 1.0 * cap - Painter::text_width_px(row.time, shown), base}, shown);
    base += 1.9 * cap;
  }
  if (!more_.empty()) {
    TextStyle faint = style;
    faint.colour = palette::kFaintInk;
    painter.draw_text(more_, {panel.left + 2.7 * cap, base}, faint);
  }
}

}  // namespace sim::render
