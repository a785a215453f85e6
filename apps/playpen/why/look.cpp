// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "why/look.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sim/core/math.h"
#include "sim/world/outline.h"
#include "why/reasons.h"

namespace playpen::why {
namespace {

constexpr double kSamePlace_m = 0.08;  // a beam's range and a place that it shows
constexpr double kNearPlace_m = 0.15;  // the end of a transducer's ray and the place
constexpr double kMargin_rad = 0.02;   // of a cone

Look look_of_beams(const Scan& scan, const sim::Vec2& place) {
  Look look;
  const sim::Vec2 p_L = scan.X_WL.inverse() * place;
  const double distance_m = p_L.norm();
  look.bearing_rad = sim::math::atan2(p_L.y(), p_L.x());
  const double index = std::round((look.bearing_rad - scan.angle_min_rad) / scan.resolution_rad);
  if (index < 0.0 || index >= static_cast<double>(scan.ranges_m.size())) return look;
  look.in_view = true;
  look.beam = static_cast<std::size_t>(index);
  look.range_m = static_cast<double>(scan.ranges_m[look.beam]);
  const std::size_t first = look.beam == 0 ? 0 : look.beam - 1;
  const std::size_t last = std::min(look.beam + 1, scan.ranges_m.size() - 1);
  for (std::size_t i = first; i <= last && !look.shown; ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    look.shown = range_m < scan.range_max_m && std::abs(range_m - distance_m) < kSamePlace_m;
  }
  return look;
}

double angle_of(const sim::Vec2& p) { return sim::math::atan2(p.y(), p.x()); }

/// Distance of the nearest point of a surface in a cone around the x axis of S [m].
double nearest_in_cone_m(const std::vector<grade::SolidSide>& surface, const sim::Pose& X_WS,
                         double half_view_rad) {
  constexpr double kSpacing_m = 0.02;
  double nearest_m = std::numeric_limits<double>::infinity();
  const sim::Pose X_SW = X_WS.inverse();
  for (const grade::SolidSide& side : surface) {
    const sim::Vec2 a = X_SW * side.a;
    const sim::Vec2 ab = X_SW * side.b - a;
    const double parts = std::max(1.0, std::ceil(ab.norm() / kSpacing_m));
    for (double i = 0.0; i <= parts; i += 1.0) {
      const sim::Vec2 p = a + i / parts * ab;
      if (std::abs(angle_of(p)) <= half_view_rad) nearest_m = std::min(nearest_m, p.norm());
    }
  }
  return nearest_m;
}

bool is_near_surface(const std::vector<grade::SolidSide>& surface, const sim::Vec2& p) {
  const grade::SolidSide& side = grade::nearest_side(surface, p);
  return sim::distance_to_segment_m(p, side.a, side.b) < kSamePlace_m;
}

/// What one transducer says of a place.
/// @param p_S  the place in the transducer's frame.
Look look_of_transducer(const Story& story, std::size_t number, double range_m,
                        const sim::Pose& X_WS, const sim::Vec2& p_S) {
  const Transducers& all = *story.transducers;
  Look look;
  look.beam = number;
  look.range_m = range_m;
  look.bearing_rad = all.X_BS[number].yaw_rad;
  const double distance_m = p_S.norm();
  const bool has_echo = range_m < all.ranges_max_m[number];
  const std::vector<grade::SolidSide>& surface = story.surface;
  if (all.view_rad <= 0.0) {
    const sim::Vec2 end_S(range_m, 0.0);
    look.in_view = p_S.x() > 0.0 && std::abs(p_S.y()) < kNearPlace_m;
    look.shown = look.in_view && has_echo && (end_S - p_S).norm() < kNearPlace_m &&
                 (surface.empty() || is_near_surface(surface, X_WS * end_S));
    return look;
  }
  const double half_view_rad = 0.5 * all.view_rad + kMargin_rad;
  look.in_view = std::abs(angle_of(p_S)) <= half_view_rad;
  if (!look.in_view || !has_echo || range_m > distance_m + kSamePlace_m) return look;
  look.shown =
      surface.empty()
          ? range_m > distance_m - kNearPlace_m
          : std::abs(nearest_in_cone_m(surface, X_WS, half_view_rad) - range_m) < kSamePlace_m;
  return look;
}

Look look_of_transducers(const Story& story, const Scan& scan, const sim::Vec2& place) {
  Look best;
  double best_rad = std::numeric_limits<double>::infinity();
  const std::size_t count = std::min(story.transducers->X_BS.size(), scan.ranges_m.size());
  for (std::size_t i = 0; i < count; ++i) {
    const sim::Pose X_WS = scan.X_WL * story.transducers->X_BS[i];
    const sim::Vec2 p_S = X_WS.inverse() * place;
    const Look look =
        look_of_transducer(story, i, static_cast<double>(scan.ranges_m[i]), X_WS, p_S);
    if (!look.in_view) continue;
    const double off_axis_rad = std::abs(angle_of(p_S));
    const bool better = look.shown == best.shown ? off_axis_rad < best_rad : look.shown;
    if (!better) continue;
    best = look;
    best_rad = off_axis_rad;
  }
  return best;
}

/// "sonar 2 (30 degrees to the left)".
std::string transducer_text(const Story& story, std::size_t number) {
  return story.transducers->type + ' ' + std::to_string(number) + " (" +
         bearing_text(story.transducers->X_BS[number].yaw_rad) + ')';
}

/// Between which transducers a direction is: those on its right and left, if they are less than
/// half a turn from each other.
std::string gap_sentence(const Story& story, const sim::Vec2& p_B) {
  const std::vector<sim::Pose>& X_BS = story.transducers->X_BS;
  std::optional<std::size_t> right;
  std::optional<std::size_t> left;
  const auto angle_to = [&](std::size_t i) {
    const sim::Vec2 p_S = X_BS[i].inverse() * p_B;
    return angle_of(p_S);  // positive: the place is left of the axis
  };
  for (std::size_t i = 0; i < X_BS.size(); ++i) {
    const double angle_rad = angle_to(i);
    std::optional<std::size_t>& side = angle_rad > 0.0 ? right : left;
    if (!side || std::abs(angle_rad) < std::abs(angle_to(*side))) side = i;
  }
  const std::string part = story.transducers->view_rad > 0.0 ? "cone" : "ray";
  std::string text = "No " + part + " of its " + story.sensor + " looked there";
  if (right && left && std::abs(angle_to(*right)) + std::abs(angle_to(*left)) < std::numbers::pi) {
    text += ": it was between " + transducer_text(story, *left) + " and " +
            transducer_text(story, *right);
  }
  return text + '.';
}

}  // namespace

Look look_at(const Story& story, const Scan& scan, const sim::Vec2& place) {
  return story.transducers ? look_of_transducers(story, scan, place) : look_of_beams(scan, place);
}

SightOfContact sight_before(const Story& story, const sim::Vec2& place, double time_s) {
  constexpr int kMostMisses = 2;
  constexpr double kLeftView_s = 2.0;
  SightOfContact sight;
  int misses = 0;
  bool newest = true;
  for (auto scan = story.scans.rbegin(); scan != story.scans.rend(); ++scan) {
    if (scan->time_s >= time_s) continue;
    const Look look = look_at(story, *scan, place);
    if (std::exchange(newest, false)) sight.in_view = look.in_view;
    if (look.shown) {
      if (!sight.last_shown_s) sight.last_shown_s = scan->time_s;
      sight.since = *scan;
      sight.first = look;
      misses = 0;
      continue;
    }
    const bool may_have_left =
        story.transducers && !sight.since && time_s - scan->time_s < kLeftView_s;
    if (++misses > kMostMisses && !may_have_left) break;
  }
  return sight;
}

std::string sight_sentence(const Story& story, const SightOfContact& sight, const sim::Vec2& place,
                           double time_s) {
  constexpr double kShownGap_s = 0.5;
  if (story.sensor.empty()) {
    return "It has no laser, sonars or infrared rangers that could have shown it.";
  }
  if (!sight.since) {
    const bool beams = !story.transducers;
    if (!sight.in_view) {
      return beams ? "No beam of its " + story.sensor + " looks there."
                   : gap_sentence(story, place);
    }
    const std::string part = beams ? "beam" : story.transducers->view_rad > 0.0 ? "cone" : "ray";
    return "No " + part + " of its " + story.sensor +
           " showed it: it may be lower or higher than the " + part + "s, or hidden.";
  }
  const double shown_s = time_s - sight.since->time_s;
  const std::string what = story.transducers ? "Its " + transducer_text(story, sight.first.beam)
                                             : "Beam " + std::to_string(sight.first.beam) +
                                                   " of its " + story.sensor + " (" +
                                                   bearing_text(sight.first.bearing_rad) + ")";
  std::string text = what + " had shown it for " + seconds_text(shown_s) + ", at first " +
                     metres_text(sight.first.range_m) + " away.";
  if (time_s - *sight.last_shown_s > kShownGap_s) {
    text += " It left the field of view " + seconds_text(time_s - *sight.last_shown_s) +
            " before the contact.";
  }
  return text;
}

}  // namespace playpen::why
