// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "why/reasons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"

namespace playpen::why {
namespace {

constexpr double kStill_mps = 0.02;
constexpr double kStill_radps = 0.05;

bool moves(const sim::Twist& twist) {
  return std::abs(twist.v_mps) > kStill_mps || std::abs(twist.omega_radps) > kStill_radps ||
         std::abs(twist.lateral_mps) > kStill_mps;
}

void add_end_of_program(const Story& story, const RunFacts& facts, std::vector<Reason>& reasons) {
  const double end_s = story.samples.back().time_s;
  if (facts.signal) {
    reasons.push_back(
        {kind::kCrash,
         end_s,
         {"The program was ended by " + *facts.signal + " after " + seconds_text(end_s) +
              " of simulated time, at " + place_text(story.samples.back().X_WB.position()) + ".",
          "`playpen run --debug` shows the line."},
         story.samples.back().X_WB.position()});
  }
  for (const auto& [time_s, what] : facts.refused) {
    reasons.push_back({kind::kRefused,
                       time_s,
                       {"After " + seconds_text(time_s) + " the program requested " + what +
                        ", which the task does not allow."},
                       sample_at(story, time_s).X_WB.position()});
  }
}

/// @return whether the program never moved the robot.
bool add_lack_of_commands(const Story& story, std::vector<Reason>& reasons) {
  const bool commanded = std::any_of(story.samples.begin(), story.samples.end(),
                                     [](const Sample& sample) { return moves(sample.commanded); });
  if (commanded) return false;
  if (story.motors_switched_off) {
    reasons.push_back({kind::kMotorsOff,
                       0.0,
                       {"The motors were switched off (SetMotorEnable(false)), so " +
                        std::to_string(story.told.size()) + " commands had no effect."},
                       story.samples.front().X_WB.position(),
                       {{"commands", static_cast<double>(story.told.size())}}});
    return true;
  }
  const std::string what = story.told.empty()
                               ? "The program sent robot " + story.robot + " no command to move."
                               : "All " + std::to_string(story.told.size()) +
                                     " velocities that the program commanded were 0.";
  Reason reason{kind::kNoCommand,
                0.0,
                {what},
                story.samples.front().X_WB.position(),
                {{"commands", static_cast<double>(story.told.size())},
                 {"reads", static_cast<double>(story.reads.size())}}};
  if (story.reads.empty()) reason.text.emplace_back("It has read no data either.");
  reasons.push_back(std::move(reason));
  return true;
}

void add_traps(const Story& story, std::vector<Reason>& reasons) {
  for (const sim::ArenaEvent& event : story.events) {
    const double time_s = sim::to_seconds(event.time_ns);
    if (event.kind == sim::ArenaEventKind::kTrap && event.text == "enter") {
      const sim::Vec2 place = sample_at(story, time_s).X_WB.position();
      Reason reason{kind::kTrap,
                    time_s,
                    {"After " + seconds_text(time_s) + " it entered trap " + event.what + " at " +
                     place_text(place) + "."},
                    place};
      reasons.push_back(std::move(reason));
      return;
    }
  }
}

/// The program was still exploring or driving when the time was over.
void add_slowness(const Story& story, const RunFacts& facts, std::vector<Reason>& reasons) {
  const double end_s = story.samples.back().time_s;
  if (facts.ended_by_program || end_s <= 0.0) return;
  double most_mps = 0.0;
  for (const Sample& sample : story.samples) {
    most_mps = std::max(most_mps, std::abs(sample.commanded.v_mps));
  }
  if (most_mps <= kStill_mps || most_mps > 0.5 * story.model.max_speed_mps) return;
  reasons.push_back({kind::kSlow,
                     end_s,
                     {"It drove with at most " + sim::fixed_text(most_mps, 2) +
                      " m/s until the time was over; the robot reaches " +
                      sim::fixed_text(story.model.max_speed_mps, 2) + " m/s."},
                     std::nullopt,
                     {{"greatest_speed_mps", most_mps}, {"limit_mps", story.model.max_speed_mps}}});
}

/// The part of the run in which the robot got on least: that of several equal parts with the
/// shortest way.
void add_slowest_part(const Story& story, std::vector<Reason>& reasons) {
  constexpr double kPart_s = 20.0;
  const double end_s = story.samples.back().time_s;
  if (end_s < 2.0 * kPart_s) return;
  double least_m = std::numeric_limits<double>::infinity();
  double at_s = 0.0;
  for (double from_s = 0.0; from_s + kPart_s <= end_s; from_s += kPart_s / 4.0) {
    const sim::Vec2 a = sample_at(story, from_s).X_WB.position();
    double extent_m = 0.0;
    for (double t_s = from_s; t_s <= from_s + kPart_s; t_s += 0.5) {
      extent_m = std::max(extent_m, (sample_at(story, t_s).X_WB.position() - a).norm());
    }
    if (extent_m < least_m) {
      least_m = extent_m;
      at_s = from_s;
    }
  }
  reasons.push_back({kind::kSlow,
                     at_s,
                     {"It got on least from " + seconds_text(at_s) + " to " +
                      seconds_text(at_s + kPart_s) + ": it stayed within " + metres_text(least_m) +
                      " of " + place_text(sample_at(story, at_s).X_WB.position()) + "."},
                     sample_at(story, at_s).X_WB.position(),
                     {{"until_s", at_s + kPart_s}, {"extent_m", least_m}}});
}

void add_unseen_floor(const RunFacts& facts, double end_s, std::vector<Reason>& reasons) {
  if (!facts.seen_area_m2) return;
  reasons.push_back(
      {kind::kUnseenFloor,
       end_s,
       {"Its sensors have seen " + sim::fixed_text(*facts.seen_area_m2, 2) + " m^2 of the floor."},
       std::nullopt,
       {{"seen_m2", *facts.seen_area_m2}}});
}

/// Whether one of the reasons why a graded run failed contains a word; true if it was not graded.
bool concerns(const RunFacts& facts, std::initializer_list<std::string_view> words) {
  if (facts.faults.empty()) return true;
  return std::any_of(facts.faults.begin(), facts.faults.end(), [&](const std::string& fault) {
    return std::any_of(words.begin(), words.end(), [&fault](std::string_view word) {
      return fault.find(word) != std::string::npos;
    });
  });
}

}  // namespace

void add_goal_reasons(const Story& story, const RunFacts& facts, std::vector<Reason>& reasons) {
  constexpr double kNear_m = 0.15;
  constexpr double kWrongShare = 0.75;
  constexpr double kSide_rad = 0.35;  // 20 degrees
  constexpr double kFacingAway_rad = 2.0;
  if (!facts.goal) return;
  const Sample* nearest = &story.samples.front();
  double nearest_m = std::numeric_limits<double>::infinity();
  double towards = 0.0;
  double away = 0.0;
  double facing_away = 0.0;
  for (const Sample& sample : story.samples) {
    const sim::Vec2 goal_B = sample.X_WB.inverse() * *facts.goal;
    if (goal_B.norm() < nearest_m) {
      nearest_m = goal_B.norm();
      nearest = &sample;
    }
    const double bearing_rad = sim::math::atan2(goal_B.y(), goal_B.x());
    if (std::abs(bearing_rad) > kFacingAway_rad) facing_away += 1.0;
    if (goal_B.norm() < kNear_m || std::abs(bearing_rad) < kSide_rad) continue;
    if (std::abs(sample.commanded.omega_radps) < kStill_radps) continue;
    ((sample.commanded.omega_radps > 0.0) == (bearing_rad > 0.0) ? towards : away) += 1.0;
  }
  const Sample& last = story.samples.back();
  const double last_m = (last.X_WB.position() - *facts.goal).norm();
  if (nearest_m < kNear_m && last_m > nearest_m + kNear_m) {
    reasons.push_back(
        {kind::kNoStop,
         nearest->time_s,
         {"After " + seconds_text(nearest->time_s) + " it was " + metres_text(nearest_m) +
              " from the goal and drove on (" + twist_text(nearest->commanded) +
              "); at the end it was " + metres_text(last_m) + " away.",
          "A program must stop when it is near the goal, or it passes the goal between two "
          "readings."},
         nearest->X_WB.position(),
         {{"least_distance_m", nearest_m}, {"last_distance_m", last_m}}});
    return;
  }
  if (facts.goal_reached || last_m < kNear_m) return;
  const auto samples = static_cast<double>(story.samples.size());
  const double turned = away + towards;
  if (turned > 50.0 && (away > kWrongShare * turned || facing_away > kWrongShare * samples)) {
    reasons.push_back(
        {kind::kWrongWay,
         nearest->time_s,
         {"It turned away from the goal at " + place_text(*facts.goal) + ": in " +
              sim::fixed_text(100.0 * facing_away / samples, 0) + " % of the time it faced the " +
              "other way.",
          "Is a sign wrong? A positive turn rate turns to the left."},
         nearest->X_WB.position(),
         {{"turned_away_share", away / turned}, {"faced_away_share", facing_away / samples}}});
  }
  const std::string how = moves(last.commanded) ? "was still driving" : "stood still";
  reasons.push_back({kind::kMissed,
                     last.time_s,
                     {"At the end it was " + metres_text(last_m) + " from the goal and " + how +
                      "; it had been nearest after " + seconds_text(nearest->time_s) + ", with " +
                      metres_text(nearest_m) + "."},
                     last.X_WB.position(),
                     {{"last_distance_m", last_m},
                      {"least_distance_m", nearest_m},
                      {"nearest_at_s", nearest->time_s}}});
}

std::vector<Reason> reasons_of(const Story& story, const RunFacts& facts) {
  std::vector<Reason> reasons;
  add_end_of_program(story, facts, reasons);
  if (auto units = unit_reason(story)) reasons.push_back(*std::move(units));
  if (add_lack_of_commands(story, reasons)) return reasons;  // all else follows from that
  const bool contacts_count = concerns(facts, {"collision", "hit", "contact", "clearance"});
  std::vector<Reason> contacts;
  if (!story.collisions.empty())
    contacts.push_back(reason_of_contact(story, story.collisions.front()));
  if (contacts_count) std::move(contacts.begin(), contacts.end(), std::back_inserter(reasons));
  add_traps(story, reasons);
  add_goal_reasons(story, facts, reasons);
  add_movement_reasons(story, reasons);
  if (!contacts_count) std::move(contacts.begin(), contacts.end(), std::back_inserter(reasons));
  const double end_s = story.samples.back().time_s;
  if (facts.ended_by_program && !facts.signal && !facts.passed) {
    reasons.push_back({kind::kEnded,
                       end_s,
                       {"The program ended by itself after " + seconds_text(end_s) +
                        (facts.duration_s ? " of " + seconds_text(*facts.duration_s) : "") + "."},
                       story.samples.back().X_WB.position()});
    if (facts.duration_s) reasons.back().numbers["duration_s"] = *facts.duration_s;
  }
  if (!facts.faults.empty()) {
    add_slowness(story, facts, reasons);
    add_unseen_floor(facts, end_s, reasons);
    add_slowest_part(story, reasons);
  }
  return reasons;
}

}  // namespace playpen::why
