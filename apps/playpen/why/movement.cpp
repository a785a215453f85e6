// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "why/reasons.h"

namespace playpen::why {
namespace {

constexpr double kBeyondLimit = 3.0;       // times the limit
constexpr double kLeastShareBeyond = 0.1;  // of the commands
constexpr double kStall_s = 3.0;
constexpr double kWindowOfTurns_s = 10.0;
constexpr double kOnTheSpot_m = 0.15;
constexpr int kManyTurns = 8;
constexpr double kTurning_radps = 0.1;
constexpr double kManyRounds = 3.0;

double degrees_as_radians(double value) { return value * std::numbers::pi / 180.0; }

/// A longest time [s].
struct Interval {
  double begin_s = 0.0;
  double end_s = 0.0;
  [[nodiscard]] double length_s() const { return end_s - begin_s; }
};

Interval longest_stall(const Story& story) {
  Interval longest;
  Interval now;
  bool stalled = false;
  for (const Sample& sample : story.samples) {
    if (sample.stalled && !stalled) now.begin_s = sample.time_s;
    stalled = sample.stalled;
    now.end_s = sample.time_s;
    if (stalled && now.length_s() > longest.length_s()) longest = now;
  }
  return longest;
}

/// The samples of the last seconds before each sample, and what they have in common.
class TurnWindow {
 public:
  explicit TurnWindow(const std::vector<Sample>& samples) : samples_(samples) {}

  /// Adds the next sample.
  void advance() {
    const Sample& now = samples_[end_++];
    note(now, +1);
    while (samples_[begin_].time_s < now.time_s - kWindowOfTurns_s) note(samples_[begin_++], -1);
  }
  [[nodiscard]] bool full() const {
    return samples_[end_ - 1].time_s - samples_[begin_].time_s > kWindowOfTurns_s - 0.5;
  }
  [[nodiscard]] const Sample& first() const { return samples_[begin_]; }
  [[nodiscard]] int changes() const { return changes_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  /// Largest side of the rectangle around all positions [m]. O(window).
  [[nodiscard]] double extent_m() const {
    sim::Vec2 low = samples_[begin_].X_WB.position();
    sim::Vec2 high = low;
    for (std::size_t i = begin_; i < end_; ++i) {
      low = low.cwiseMin(samples_[i].X_WB.position());
      high = high.cwiseMax(samples_[i].X_WB.position());
    }
    return (high - low).maxCoeff();
  }

 private:
  /// Counts the changes of the turn's direction, and the turn.
  void note(const Sample& sample, int sign) {
    double& last_radps = sign > 0 ? newest_radps_ : oldest_radps_;
    const double omega_radps = sample.commanded.omega_radps;
    if (std::abs(omega_radps) > kTurning_radps) {
      if (last_radps * omega_radps < 0.0) changes_ += sign;
      last_radps = omega_radps;
    }
    turned_rad_ += sign * sample.twist.omega_radps * step_s();
  }
  [[nodiscard]] double step_s() const { return samples_[1].time_s - samples_[0].time_s; }

  const std::vector<Sample>& samples_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  int changes_ = 0;
  double turned_rad_ = 0.0;
  double newest_radps_ = 0.0;
  double oldest_radps_ = 0.0;
};

void add_turn_reasons(const Story& story, std::vector<Reason>& reasons) {
  if (story.samples.size() < 3) return;
  TurnWindow window(story.samples);
  bool oscillates = false;
  bool circles = false;
  for (std::size_t i = 0; i < story.samples.size(); ++i) {
    window.advance();
    if (!window.full() || i % 10 != 0) continue;
    const double rounds = std::abs(window.turned_rad()) / (2.0 * std::numbers::pi);
    const double from_s = window.first().time_s;
    if (!oscillates && window.changes() >= kManyTurns && window.extent_m() < kOnTheSpot_m) {
      oscillates = true;
      reasons.push_back(
          {kind::kOscillation,
           from_s,
           {"From " + seconds_text(from_s) + " on, it turned left and right in turn (" +
                std::to_string(window.changes()) + " changes in " + seconds_text(kWindowOfTurns_s) +
                ") and did not leave the spot.",
            "Two rules of the program may undo each other: what one side asks for, the next "
            "reading reverses."},
           window.first().X_WB.position(),
           {{"changes", window.changes()}, {"window_s", kWindowOfTurns_s}}});
    } else if (!circles && rounds > kManyRounds && window.extent_m() < 1.0) {
      circles = true;
      reasons.push_back({kind::kCircles,
                         from_s,
                         {"From " + seconds_text(from_s) +
                          " on, it drove in circles: " + sim::fixed_text(rounds, 1) + " turns in " +
                          seconds_text(kWindowOfTurns_s) + "."},
                         window.first().X_WB.position(),
                         {{"rounds", rounds}, {"window_s", kWindowOfTurns_s}}});
    }
  }
}

}  // namespace

std::string seconds_text(double time_s) { return sim::fixed_text(time_s, 1) + " s"; }
std::string metres_text(double distance_m) { return sim::fixed_text(distance_m, 2) + " m"; }
std::string place_text(const sim::Vec2& place) {
  return '(' + sim::fixed_text(place.x(), 2) + ", " + sim::fixed_text(place.y(), 2) + ')';
}
std::string twist_text(const sim::Twist& twist) {
  return sim::fixed_text(twist.v_mps, 2) + " m/s, " + sim::fixed_text(twist.omega_radps, 2) +
         " rad/s";
}
std::string bearing_text(double bearing_rad) {
  const double degrees = std::abs(bearing_rad) * 180.0 / std::numbers::pi;
  if (degrees < 5.0) return "straight ahead";
  if (degrees > 175.0) return "straight behind it";
  return sim::fixed_text(degrees, 0) + " degrees to the " + (bearing_rad > 0.0 ? "left" : "right");
}

std::optional<Reason> unit_reason(const Story& story) {
  const sim::RobotModel& model = story.model;
  const Told* worst = nullptr;
  bool turn = false;
  double most = kBeyondLimit;
  std::size_t beyond = 0;
  for (const Told& told : story.told) {
    const double v = std::abs(told.twist.v_mps) / model.max_speed_mps;
    const double omega = std::abs(told.twist.omega_radps) / model.max_turn_rate_radps;
    if (std::max(v, omega) < kBeyondLimit) continue;
    ++beyond;
    if (std::max(v, omega) <= most) continue;
    most = std::max(v, omega);
    turn = omega > v;
    worst = &told;
  }
  if (worst == nullptr ||
      static_cast<double>(beyond) < kLeastShareBeyond * static_cast<double>(story.told.size())) {
    return std::nullopt;
  }
  const double value = turn ? worst->twist.omega_radps : worst->twist.v_mps;
  const std::string unit = turn ? " rad/s" : " m/s";
  const double limit = turn ? model.max_turn_rate_radps : model.max_speed_mps;
  Reason reason{kind::kUnits,
                worst->time_s,
                {},
                sample_at(story, worst->time_s).X_WB.position(),
                {{turn ? "commanded_radps" : "commanded_mps", value},
                 {turn ? "limit_radps" : "limit_mps", limit},
                 {"commands_beyond", static_cast<double>(beyond)},
                 {"commands", static_cast<double>(story.told.size())}}};
  reason.text.push_back("It commanded up to " + sim::rounded_text(std::abs(value), 3) + unit +
                        " (first of these at " + seconds_text(worst->time_s) +
                        "), but the robot reaches " + sim::rounded_text(limit, 3) + unit + "; " +
                        std::to_string(beyond) + " of " + std::to_string(story.told.size()) +
                        " commands were so far beyond its limits.");
  if (turn) {
    reason.text.push_back("Are these degrees? " + sim::rounded_text(std::abs(value), 3) +
                          " degrees are " +
                          sim::fixed_text(degrees_as_radians(std::abs(value)), 2) +
                          " rad: Playpen and Player take radians.");
  } else {
    reason.text.push_back("Are these centimetres or millimetres? Playpen and Player take metres.");
  }
  return reason;
}

void add_movement_reasons(const Story& story, std::vector<Reason>& reasons) {
  const Interval stall = longest_stall(story);
  if (stall.length_s() >= kStall_s) {
    const Sample& at = sample_at(story, stall.end_s);
    std::string against;
    for (const sim::Collision& c : story.collisions) {
      if (sim::to_seconds(c.time_ns) <= stall.begin_s + 0.5) against = " against " + c.partner;
    }
    reasons.push_back(
        {kind::kStall,
         stall.begin_s,
         {"From " + seconds_text(stall.begin_s) + " to " + seconds_text(stall.end_s) + " it stood" +
              against + " at " + place_text(at.X_WB.position()) +
              " although it was commanded to move (" + twist_text(at.commanded) + ").",
          "A program notices this by Position2dProxy::GetStall()."},
         at.X_WB.position(),
         {{"until_s", stall.end_s},
          {"commanded_mps", at.commanded.v_mps},
          {"commanded_radps", at.commanded.omega_radps}}});
  }
  add_turn_reasons(story, reasons);
}

}  // namespace playpen::why
