// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/math.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "why/look.h"
#include "why/reasons.h"

namespace playpen::why {
namespace {

constexpr double kAhead_rad = 0.14;  // 8 degrees: neither left nor right
constexpr double kTurn_radps = 0.1;  // less is no turn
constexpr double kLeastGap_s = 0.5;  // without a read or command: too long near obstacles
constexpr double kStaleAge_s = 0.25;
constexpr double kWindow_s = 1.5;  // in which commands before a contact are judged
constexpr double kSlowTurn_radps = 0.3;
constexpr int kManyChanges = 3;           // of the turn's direction in that time
constexpr double kEarlyReaction_s = 0.8;  // earlier is not late

/// Which part of a time the program commanded what, with respect to a place.
struct Reaction {
  double away = 0.0;                   ///< turned away or braked [s]
  double towards = 0.0;                ///< [s]
  double straight = 0.0;               ///< [s]
  std::optional<double> away_since_s;  ///< until the contact without an interruption
  double turn_radps = 0.0;             ///< greatest turn rate since then
  double slowly_away = 0.0;            ///< turned away with less than kTurn_radps [s]
  int changes = 0;                     ///< of the turn's direction
  double off_axis = 0.0;               ///< integral of the absolute bearing [rad s]
  sim::Twist last;                     ///< commanded at the contact
  double bearing_rad = 0.0;            ///< of the place at the end
};

double bearing_of(const sim::Pose& X_WB, const sim::Vec2& place) {
  const sim::Vec2 p_B = X_WB.inverse() * place;
  return sim::math::atan2(p_B.y(), p_B.x());
}

enum class Turn { kAway, kTowards, kStraight };

Turn turn_of(const sim::Twist& commanded, double bearing_rad) {
  const bool behind = std::abs(bearing_rad) > std::numbers::pi / 2.0;
  const bool approaches = behind ? commanded.v_mps < -0.02 : commanded.v_mps > 0.02;
  if (std::abs(commanded.omega_radps) < kTurn_radps) {
    return approaches ? Turn::kStraight : Turn::kAway;
  }
  if (std::abs(bearing_rad) < kAhead_rad) return Turn::kAway;
  return (commanded.omega_radps > 0.0) == (bearing_rad > 0.0) ? Turn::kTowards : Turn::kAway;
}

void note_turn(double dt_s, double turn_before_radps, double since_s, Reaction& reaction) {
  const double omega_radps = reaction.last.omega_radps;
  const Turn turn = turn_of(reaction.last, reaction.bearing_rad);
  (turn == Turn::kAway      ? reaction.away
   : turn == Turn::kTowards ? reaction.towards
                            : reaction.straight) += dt_s;
  reaction.off_axis += std::abs(reaction.bearing_rad) * dt_s;
  if (turn_before_radps * omega_radps < 0.0) ++reaction.changes;
  if (turn != Turn::kAway) {
    reaction.away_since_s.reset();
    reaction.turn_radps = 0.0;
    constexpr double kLeastTurn_radps = 0.005;
    const bool to_other_side = (omega_radps > 0.0) != (reaction.bearing_rad > 0.0);
    if (turn == Turn::kStraight && std::abs(omega_radps) > kLeastTurn_radps &&
        (to_other_side || std::abs(reaction.bearing_rad) < kAhead_rad)) {
      reaction.slowly_away += dt_s;
    }
    return;
  }
  if (!reaction.away_since_s) reaction.away_since_s = since_s;
  reaction.turn_radps = std::max(reaction.turn_radps, std::abs(omega_radps));
}

Reaction reaction_before(const Story& story, const sim::Vec2& place, double from_s,
                         double until_s) {
  Reaction reaction;
  const Sample* before = nullptr;
  for (const Sample& sample : story.samples) {
    if (sample.time_s > until_s) break;
    if (sample.time_s >= from_s && before != nullptr) {
      const double turn_before_radps = reaction.last.omega_radps;
      reaction.bearing_rad = bearing_of(before->X_WB, place);
      reaction.last = sample.commanded;
      note_turn(sample.time_s - before->time_s, turn_before_radps, before->time_s, reaction);
    }
    before = &sample;
  }
  return reaction;
}

/// Whether the program turned to what it hit, or turned about and kept it ahead.
bool turned_towards(const Reaction& reaction) {
  constexpr double kKeptAhead_rad = 0.35;
  const double whole = reaction.away + reaction.towards + reaction.straight;
  return reaction.towards > 0.5 * whole ||
         (reaction.changes >= kManyChanges && reaction.off_axis < kKeptAhead_rad * whole);
}

/// The longest time without something in the seconds before a contact [s].
template <typename List>
double longest_gap(const List& list, double time_s) {
  constexpr double kLooked_s = 3.0;
  double last_s = std::max(0.0, time_s - kLooked_s);
  double longest_s = 0.0;
  for (const auto& entry : list) {
    if (entry.time_s > time_s) break;
    if (entry.time_s > last_s) longest_s = std::max(longest_s, entry.time_s - last_s);
    last_s = std::max(last_s, entry.time_s);
  }
  return std::max(longest_s, time_s - last_s);
}

/// How long before a time something happened last; the whole time if it did not.
template <typename List>
double gap_before(const List& list, double time_s) {
  double last_s = 0.0;
  for (const auto& entry : list) {
    if (entry.time_s > time_s) break;
    last_s = entry.time_s;
  }
  return time_s - last_s;
}

/// Median age of the readings in the time before a contact [s].
double age_before(const Story& story, double time_s) {
  constexpr double kReads_s = 2.0;
  std::vector<double> ages;
  for (const Read& read : story.reads) {
    if (read.time_s <= time_s && read.time_s >= time_s - kReads_s) ages.push_back(read.age_s);
  }
  if (ages.empty()) return 0.0;
  std::nth_element(ages.begin(), ages.begin() + static_cast<std::ptrdiff_t>(ages.size() / 2),
                   ages.end());
  return ages[ages.size() / 2];
}

/// The nearer side in a scan: 1 left, -1 right, 0: both are alike, or far away.
int nearer_side(const std::optional<Transducers>& transducers, const Scan& scan) {
  constexpr double kView_rad = std::numbers::pi / 3.0;
  constexpr double kNear_m = 1.0;
  constexpr double kAlike_m = 0.05;
  double left_m = scan.range_max_m;
  double right_m = scan.range_max_m;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad =
        transducers ? transducers->X_BS[i].yaw_rad
                    : scan.angle_min_rad + static_cast<double>(i) * scan.resolution_rad;
    if (transducers && std::abs(angle_rad) < kAhead_rad) continue;  // both sides
    if (std::abs(angle_rad) > kView_rad) continue;
    double& side_m = angle_rad > 0.0 ? left_m : right_m;
    side_m = std::min(side_m, static_cast<double>(scan.ranges_m[i]));
  }
  if (std::min(left_m, right_m) > kNear_m || std::abs(left_m - right_m) < kAlike_m) return 0;
  return left_m < right_m ? 1 : -1;
}

/// How long before its commands the scans were to which a program's turns fit: it turns away from
/// the nearer side of the scan of that time more often than of the present one. 0: it does not.
double lag_of_turns(const Story& story) {
  constexpr std::size_t kMostScans = 20;
  constexpr std::size_t kLeastLag = 3;
  constexpr int kLeastTurns = 20;
  constexpr double kGoodShare = 0.75;
  constexpr double kBetter = 0.1;
  std::vector<int> sides;
  for (const Scan& scan : story.scans) sides.push_back(nearer_side(story.transducers, scan));
  std::vector<int> fits(kMostScans + 1, 0);
  std::vector<int> all(kMostScans + 1, 0);
  std::size_t newest = 0;
  for (const Told& told : story.told) {
    while (newest + 1 < sides.size() && story.scans[newest + 1].time_s <= told.time_s) ++newest;
    if (std::abs(told.twist.omega_radps) < kTurn_radps) continue;
    for (std::size_t lag = 0; lag <= std::min(kMostScans, newest); ++lag) {
      const int side = sides.empty() ? 0 : sides[newest - lag];
      if (side == 0) continue;
      ++all[lag];
      if ((side > 0) == (told.twist.omega_radps < 0.0)) ++fits[lag];
    }
  }
  const auto share = [&](std::size_t lag) {
    return all[lag] < kLeastTurns ? 0.0 : static_cast<double>(fits[lag]) / all[lag];
  };
  std::size_t best = 0;
  for (std::size_t lag = 1; lag <= kMostScans; ++lag) {
    if (share(lag) > share(best)) best = lag;
  }
  if (best < kLeastLag || share(best) < kGoodShare || share(best) < share(0) + kBetter) return 0.0;
  return static_cast<double>(best) * (story.scans[1].time_s - story.scans[0].time_s);
}

/// The numbers of a contact that its text is made of, and those that it does not mention.
void note_numbers(const Story& story, const SightOfContact& sight, double time_s,
                  const Reaction& reaction, Reason& reason) {
  std::map<std::string, double>& numbers = reason.numbers;
  numbers["commanded_mps"] = reaction.last.v_mps;
  numbers["commanded_radps"] = reaction.last.omega_radps;
  numbers["read_gap_s"] = longest_gap(story.reads, time_s);
  numbers["command_gap_s"] = gap_before(story.told, time_s);
  numbers["reading_age_s"] = age_before(story, time_s);
  numbers["turn_changes"] = reaction.changes;
  if (reaction.away_since_s) numbers["reacted_before_s"] = time_s - *reaction.away_since_s;
  if (!sight.since) return;
  numbers["shown_for_s"] = time_s - sight.since->time_s;
  numbers["last_shown_before_s"] = time_s - *sight.last_shown_s;
  numbers["first_range_m"] = sight.first.range_m;
  numbers[story.transducers ? "transducer" : "beam"] = static_cast<double>(sight.first.beam);
  numbers["shown_at_rad"] = sight.first.bearing_rad;
}

/// Decides why the program did not avoid what a beam showed.
void judge(const Story& story, const SightOfContact& sight, double time_s, const Reaction& reaction,
           Reason& reason) {
  const double shown_s = sight.since ? time_s - sight.since->time_s : 0.0;
  const double read_gap_s = longest_gap(story.reads, time_s);
  const double told_gap_s = gap_before(story.told, time_s);
  const double age_s = age_before(story, time_s);
  const auto say = [&reason](const char* kind, std::string text) {
    reason.kind = kind;
    reason.text.push_back(std::move(text));
  };
  const std::string commanded = "It commanded " + twist_text(reaction.last);
  if (!sight.since) {
    say(kind::kUnseen, commanded + " when it touched it.");
  } else if (read_gap_s > kLeastGap_s && shown_s > kLeastGap_s) {
    say(kind::kNoRead,
        "The program read too seldom: in the seconds before the contact it read no "
        "data for " +
            seconds_text(read_gap_s) + ", and the command " + twist_text(reaction.last) +
            " stayed in force.");
  } else if (age_s > kStaleAge_s) {
    say(kind::kStale, "The program worked on old data: the readings that it took were " +
                          seconds_text(age_s) +
                          " old. It reads less often than data come, and its client keeps them.");
  } else if (told_gap_s > kLeastGap_s && reaction.away_since_s.value_or(time_s) >= time_s) {
    say(kind::kNoReaction, "The program read data, but commanded nothing for " +
                               seconds_text(told_gap_s) + " before the contact; the command " +
                               twist_text(reaction.last) + " stayed in force.");
  } else if (turned_towards(reaction)) {
    say(kind::kTowards,
        "It was " + bearing_text(reaction.bearing_rad) + " and the program turned towards it (" +
            twist_text(reaction.last) + "): is a sign wrong, or left and right " +
            (story.transducers ? "of its " + story.sensor + " exchanged?"
                               : "of the scan exchanged? Beam 0 is the rightmost."));
  } else if (const double lag_s = lag_of_turns(story); lag_s > 0.0) {
    say(kind::kStale, "Its turns fit what the " + story.sensor + " had shown about " +
                          seconds_text(lag_s) +
                          " before them, not what it showed then: does the program work on old "
                          "data?");
  } else if (reaction.changes >= kManyChanges) {
    say(kind::kOscillation, "In the last " + seconds_text(kWindow_s) +
                                " it turned left and right in turn and moved on: what one reading "
                                "asks for, the next reverses. " +
                                commanded + " at last.");
  } else if (reaction.slowly_away > kEarlyReaction_s) {
    say(kind::kSlowTurn, "It turned away, but so slowly that it made no difference (" +
                             sim::rounded_text(std::abs(reaction.last.omega_radps), 2) +
                             " rad/s at last). Is an angle converted from degrees twice?");
  } else if (reaction.away_since_s && time_s - *reaction.away_since_s > kEarlyReaction_s &&
             reaction.turn_radps < kSlowTurn_radps) {
    say(kind::kSlowTurn, "It turned away " + seconds_text(time_s - *reaction.away_since_s) +
                             " before the contact, but with at most " +
                             sim::rounded_text(reaction.turn_radps, 2) + " rad/s.");
  } else if (reaction.away_since_s) {
    say(kind::kLate,
        "It began to turn away or to brake only " + seconds_text(time_s - *reaction.away_since_s) +
            " before the contact; it commanded " + twist_text(reaction.last) + " at last.");
  } else {
    say(kind::kStraight, commanded + " and drove on.");
  }
}

}  // namespace

Reason reason_of_contact(const Story& story, const sim::Collision& contact) {
  const double time_s = sim::to_seconds(contact.time_ns);
  const sim::SimTime before_ns = contact.time_ns - sim::kNanosecondsPerSecond / 20;
  const Sample& at = sample_at(story, sim::to_seconds(before_ns));
  Reason reason;
  reason.time_s = time_s;
  reason.place = contact.place;
  reason.numbers["speed_mps"] = std::abs(at.twist.v_mps);
  reason.numbers["bearing_rad"] = bearing_of(at.X_WB, contact.place);
  reason.text.push_back("It first hit " + contact.partner + " at " + place_text(contact.place) +
                        " after " + seconds_text(time_s) + ", at " +
                        sim::fixed_text(std::abs(at.twist.v_mps), 2) + " m/s; the place was " +
                        bearing_text(bearing_of(at.X_WB, contact.place)) + ".");
  const SightOfContact sight = sight_before(story, contact.place, time_s);
  reason.text.push_back(sight_sentence(story, sight, at.X_WB.inverse() * contact.place, time_s));
  const double from_s =
      std::max(time_s - kWindow_s, sight.since ? sight.since->time_s : time_s - kWindow_s);
  const Reaction reaction = reaction_before(story, contact.place, from_s, time_s - 0.02);
  judge(story, sight, time_s, reaction, reason);
  note_numbers(story, sight, time_s, reaction, reason);
  return reason;
}

}  // namespace playpen::why
