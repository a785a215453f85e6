// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Texts next to robots: their names and scores, and what they say.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "render/robot_painter.h"
#include "render/robot_place.h"
#include "render/text_box.h"
#include "sim/core/number_text.h"

namespace sim::render {
namespace {

// More robots than this are a crowd.
constexpr std::size_t kCrowd = 20;

class LabelPainter {
 public:
  LabelPainter(const SceneSnapshot& scene, const Layout& layout, const LabelOptions& options,
               Painter& painter)
      : scene_(scene), layout_(layout), options_(options), painter_(painter) {}

  // Draws bubbles next to robots that say something, without overlap if there is room.
  void draw_speech() {
    for (const Bubble& bubble : bubbles()) {
      Shape shape;
      shape.add_piece(rounded(bubble.place, layout_.line_px(5.0, 2.0)));
      shape.add_piece(bubble.tail);
      for (const double distance : {1.2, 2.6}) {
        Shape shadow;
        shadow.append(shape, Vec2(0.6, 1.0) * distance * layout_.unit_px);
        painter_.fill(shadow, palette::kShadow, 0.1);
      }
      // The bubble itself covers the inner half of its rim, and the lines between its parts.
      const double rim_px = 2.0 * layout_.line_px(1.5, 1.0);
      Shape rim;
      rim.add_line(rounded(bubble.place, layout_.line_px(5.0, 2.0)), rim_px, true);
      rim.add_line(bubble.tail, rim_px, true);
      painter_.fill(rim, bubble.rim);
      painter_.fill(shape, palette::kLight);
      bubble.draw_lines(painter_);
    }
  }

  // Draws names and scores next to the robots. Each label takes the position around its robot that
  // covers the least of other labels and robots. A second pass moves early labels away from later
  // ones. In a crowd, names that would still cover another one or a robot are left out.
  void draw_labels() {
    std::vector<Label> labels;
    std::vector<Rectangle> bodies;
    const bool scores = options_.scores && any_score();
    if (!options_.names && !scores) return;
    for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
      const RobotSnapshot& robot = scene_.robots[i];
      if (!is_seen(robot)) continue;
      Label label;
      label.center = layout_(robot.X_WB.position());
      label.radius_px = marked_radius_px(robot, layout_) + (robot.marked    ? 15.0
                                                            : robot.stalled ? 8.0
                                                                            : 0.0) *
                                                               layout_.unit_px;
      const Vec2 reach = Vec2::Constant(0.9 * label.radius_px);
      bodies.push_back(rectangle(label.center - reach, label.center + reach));
      const Colour colour = opaque(robot.colour);
      label.style =
          layout_.text_style(11.5, mix(colour, palette::kInk, luma(colour) > 0.5 ? 0.8 : 0.55));
      label.style.weight = 0.15;
      label.style.halo = palette::kHalo;
      label.style.halo_px = std::max(2.4 * layout_.unit_px, 1.5);
      if (options_.names) {
        label.text = shortened(robot.name, label.style, 0.4 * layout_.width);
        label.width_px = Painter::text_width_px(label.text, label.style);
      }
      if (scores && i < scene_.scores.size()) add_score(label, scene_.scores[i]);
      if (!label.text.empty() || !label.score.empty()) labels.push_back(std::move(label));
    }
    for (const Bubble& bubble : bubbles()) bodies.push_back(bubble.place);
    const Rectangle& covered = options_.covered;
    if (covered.right > covered.left) bodies.push_back(covered);
    bodies.insert(bodies.end(), options_.taken.begin(), options_.taken.end());
    for (const int round : {0, 1}) {
      for (std::size_t i = 0; i < labels.size(); ++i) {
        std::vector<Rectangle> names;
        for (std::size_t j = 0; j < labels.size(); ++j) {
          if (j != i && (round == 1 || j < i)) names.push_back(labels[j].place);
        }
        labels[i].place = best_place(labels[i], names, bodies);
      }
    }
    const bool crowd = labels.size() > kCrowd;
    std::vector<Rectangle> taken = bodies;
    for (const Label& label : labels) {
      const bool covers = crowd && std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
                            return label.place.overlap(other) > 0.0;
                          });
      if (!label.text.empty() && !covers) {
        painter_.draw_text(label.text, {label.place.left, label.place.bottom}, label.style);
        const Vec2 gap(0.0, 0.3 * (label.place.bottom - label.place.top));
        taken.push_back(rectangle(Vec2(label.place.left, label.place.top) - gap,
                                  Vec2(label.place.right, label.place.bottom) + gap));
      }
      if (!label.score.empty()) draw_score(label);
    }
  }

 private:
  struct Bubble : TextBox {
    using TextBox::TextBox;
    Colour rim;
    std::vector<Vec2> tail;
  };

  // Whether a robot is in the picture and outside of the covered rectangle.
  [[nodiscard]] bool is_seen(const RobotSnapshot& robot) const {
    if (!has_place(robot, layout_)) return false;
    const Vec2 center = layout_(robot.X_WB.position());
    const Rectangle& covered = options_.covered;
    return !(center.x() > covered.left && center.x() < covered.right && center.y() > covered.top &&
             center.y() < covered.bottom);
  }

  [[nodiscard]] std::vector<Bubble> bubbles() const {
    std::vector<Bubble> all;
    std::vector<Rectangle> bodies;
    for (const RobotSnapshot& robot : scene_.robots) {
      if (!is_seen(robot)) continue;
      const Vec2 center = layout_(robot.X_WB.position());
      const Vec2 reach = Vec2::Constant(marked_radius_px(robot, layout_));
      bodies.push_back(rectangle(center - reach, center + reach));
    }
    for (const RobotSnapshot& robot : scene_.robots) {
      if (robot.says.empty() || !is_seen(robot)) continue;
      const TextStyle style = layout_.text_style(12.5, palette::kInk);
      Bubble bubble(wrapped(printable(robot.says), style, 0.32 * layout_.width, 2), style);
      bubble.rim = mix(opaque(robot.colour), palette::kInk, 0.55);
      put_bubble(bubble, layout_(robot.X_WB.position()), marked_radius_px(robot, layout_), all,
                 bodies);
      all.push_back(std::move(bubble));
    }
    return all;
  }

  // Places a bubble around its robot where it covers the least of others, and computes its tail.
  void put_bubble(Bubble& bubble, const Vec2& center, double radius,
                  const std::vector<Bubble>& others, const std::vector<Rectangle>& bodies) const {
    const Vec2 half = bubble.half_size();
    const double gap = 13.0 * layout_.unit_px;
    const double edge = 4.0 * layout_.unit_px;
    const double area = 4.0 * half.x() * half.y();
    constexpr std::array<std::array<double, 2>, 8> kDirections = {
        {{0.5, -1}, {-0.5, -1}, {0, -1}, {0.5, 1}, {-0.5, 1}, {0, 1}, {1, 0}, {-1, 0}}};
    double least_cost = std::numeric_limits<double>::infinity();
    double preference = 0.0;
    for (const auto& direction : kDirections) {
      const bool beside = direction[1] == 0.0;
      Vec2 middle = center + Vec2(direction[0] * (beside ? radius + gap + half.x() : half.x()),
                                  direction[1] * (radius + gap + half.y()));
      const Vec2 wanted = middle;
      const double bottom = std::max(layout_.view.bottom, 2.0 * half.y() + 2.0 * edge);
      // Inside the floor if it is wide enough, otherwise anywhere in the picture.
      const bool fits = layout_.view.right - layout_.view.left > 2.0 * (half.x() + edge);
      const double least_x = (fits ? layout_.view.left : 0.0) + half.x() + edge;
      const double most_x = (fits ? layout_.view.right : layout_.width) - half.x() - edge;
      middle.x() = std::clamp(middle.x(), least_x, std::max(most_x, least_x));
      middle.y() = std::clamp(middle.y(), half.y() + edge,
                              std::max(bottom - half.y() - edge, half.y() + edge));
      const Rectangle place = rectangle(middle - half, middle + half);
      double cost = preference + 0.5 * (middle - wanted).norm() / half.norm();
      for (const Bubble& other : others) cost += 20.0 * place.overlap(other.place) / area;
      for (const Rectangle& body : bodies) cost += 8.0 * place.overlap(body) / area;
      preference += 0.05;
      if (cost >= least_cost) continue;
      least_cost = cost;
      bubble.place = place;
    }
    // The tail goes from the side that faces the robot to a point just before the robot's rim.
    const Rectangle& place = bubble.place;
    const double foot = std::min(7.0 * layout_.unit_px, 0.4 * half.y());
    const double corner = layout_.line_px(5.0, 2.0) + foot;
    const Vec2 from(std::clamp(center.x(), place.left + corner,
                               std::max(place.right - corner, place.left + corner)),
                    std::clamp(center.y(), place.top + corner,
                               std::max(place.bottom - corner, place.top + corner)));
    const bool above = place.bottom <= center.y();
    const bool below = place.top >= center.y();
    const Vec2 root(above || below            ? from.x()
                    : place.left > center.x() ? place.left + 1.0
                                              : place.right - 1.0,
                    above   ? place.bottom - 1.0
                    : below ? place.top + 1.0
                            : from.y());
    const Vec2 aside = above || below ? Vec2(foot, 0.0) : Vec2(0.0, foot);
    const Vec2 way = root - center;
    const double length = way.norm();
    if (length < radius) {  // the bubble overlaps its robot and needs no tail
      bubble.tail = {root - aside, root + aside, root};
      return;
    }
    const Vec2 tip = center + way * ((radius + 2.0 * layout_.unit_px) / length);
    bubble.tail = {root - aside, root + aside, tip};
  }

  struct Label {
    std::string text;   // the name; may be empty
    std::string score;  // may be empty
    double score_px = 0.0;
    TextStyle style;
    double width_px = 0.0;       // of name and score
    Vec2 center = Vec2::Zero();  // of the robot
    double radius_px = 0.0;      // of the robot
    Rectangle place;
  };

  // Scores appear when a robot has points.
  [[nodiscard]] bool any_score() const {
    return std::any_of(scene_.scores.begin(), scene_.scores.end(),
                       [](double score) { return score != 0.0; });
  }

  [[nodiscard]] static TextStyle score_style(const Label& label) {
    TextStyle style = label.style;
    style.halo_px = 0.0;
    style.colour = palette::kLight;
    return style;
  }

  static void add_score(Label& label, double score) {
    label.score = rounded_text(score, 6);
    const double cap_px = label.style.cap_height_px;
    label.score_px = Painter::text_width_px(label.score, score_style(label)) + 1.1 * cap_px;
    label.width_px += (label.text.empty() ? 0.0 : 0.6 * cap_px) + label.score_px;
  }

  // Draws the score as a pill at the right end of the label.
  void draw_score(const Label& label) {
    const TextStyle style = score_style(label);
    const double above_px = 0.42 * style.cap_height_px;
    const Rectangle pill{label.place.right - label.score_px, label.place.top - above_px,
                         label.place.right, label.place.bottom + above_px};
    const auto fill = [&](double grown_px, Colour colour) {
      Shape shape;
      shape.add_piece(rounded({pill.left - grown_px, pill.top - grown_px, pill.right + grown_px,
                               pill.bottom + grown_px},
                              style.cap_height_px));
      painter_.fill(shape, colour);
    };
    fill(layout_.line_px(1.4, 1.0), palette::kHalo);
    fill(0.0, palette::kInk);
    painter_.draw_text(label.score, {pill.left + 0.55 * style.cap_height_px, label.place.bottom},
                       style);
  }

  [[nodiscard]] Rectangle best_place(const Label& label, const std::vector<Rectangle>& names,
                                     const std::vector<Rectangle>& bodies) const {
    // Directions in order of preference: above, below, right, left, then diagonals.
    constexpr std::array<std::array<double, 2>, 8> kDirections = {
        {{0, -1}, {0, 1}, {1, 0}, {-1, 0}, {0.8, -0.8}, {-0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}}};
    const Vec2 half(0.5 * label.width_px, 0.5 * label.style.cap_height_px);
    const double area = 4.0 * half.x() * half.y();
    const double edge = label.style.halo_px + 1.0;
    Rectangle best;
    double least_cost = std::numeric_limits<double>::infinity();
    double preference = 0.0;
    for (const double gap : {5.5, 16.0}) {
      for (const auto& direction : kDirections) {
        const double reach = label.radius_px + gap * layout_.unit_px;
        Vec2 middle = label.center +
                      Vec2(direction[0] * (reach + half.x()), direction[1] * (reach + half.y()));
        // Inside the floor if it is wide enough, otherwise in the picture above the footer.
        const bool fits = layout_.view.right - layout_.view.left > 2.0 * (half.x() + edge);
        const double least_x = fits ? layout_.view.left : 0.0;
        const double most_x = fits ? layout_.view.right : layout_.width;
        const double least_y = half.y() + edge;
        middle.x() = std::clamp(middle.x(), least_x + half.x() + edge,
                                std::max(most_x - half.x() - edge, least_x + half.x() + edge));
        middle.y() = std::clamp(middle.y(), least_y,
                                std::max(least_y, layout_.view.bottom - half.y() - edge));
        const Rectangle place = rectangle(middle - half, middle + half);
        const Rectangle with_halo =
            rectangle(middle - half - Vec2(edge, edge), middle + half + Vec2(edge, edge));
        double cost = preference;
        for (const Rectangle& name : names) cost += 12.0 * with_halo.overlap(name) / area;
        for (const Rectangle& body : bodies) cost += 5.0 * with_halo.overlap(body) / area;
        cost += 3.0 * (1.0 - place.overlap(layout_.view) / area);
        if (cost < least_cost) {
          least_cost = cost;
          best = place;
        }
        preference += 0.12;
      }
    }
    return best;
  }

  const SceneSnapshot& scene_;
  const Layout& layout_;
  const LabelOptions& options_;
  Painter& painter_;
};

}  // namespace

void draw_speech(const SceneSnapshot& scene, const Layout& layout, const LabelOptions& options,
                 Painter& painter) {
  LabelPainter(scene, layout, options, painter).draw_speech();
}

void draw_labels(const SceneSnapshot& scene, const Layout& layout, const LabelOptions& options,
                 Painter& painter) {
  LabelPainter(scene, layout, options, painter).draw_labels();
}

}  // namespace sim::render
