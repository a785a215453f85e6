// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/likeness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

namespace playpen::course {
namespace {

using sim::Vec2;

constexpr double kPeriod_s = 0.1;  // of the samples that are compared
constexpr double kHop_m = 0.25;    // length of the straight moves that a distance consists of
constexpr double kTurn_rad = 0.2;  // size of the turns that a sum of turns consists of
constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

// A drive, sampled at k * kPeriod_s.
struct Samples {
  std::vector<Vec2> p_W;
  std::vector<double> driven_m;    // until each sample
  std::vector<double> turned_rad;  // until each sample, to both sides

  [[nodiscard]] bool empty() const noexcept { return p_W.empty(); }
  // The last sample for a later time: a robot whose program has ended stays where it is.
  [[nodiscard]] std::size_t at(std::size_t k) const { return std::min(k, p_W.size() - 1); }
  [[nodiscard]] double driven_m_between(std::size_t from, std::size_t to) const {
    return driven_m[at(to)] - driven_m[at(from)];
  }
  [[nodiscard]] double turned_rad_between(std::size_t from, std::size_t to) const {
    return turned_rad[at(to)] - turned_rad[at(from)];
  }
};

// Sums up moves and turns of a drive.
class Sums {
 public:
  explicit Sums(const sim::Pose& start) : place_(start.position()), yaw_rad_(start.yaw_rad) {}

  void add(const Vec2& place, double yaw_rad, Samples& samples) {
    const double hop_m = (place - place_).norm();
    if (hop_m >= kHop_m) {
      driven_m_ += hop_m;
      place_ = place;
    }
    const double turn_rad = std::abs(sim::normalize_angle(yaw_rad - yaw_rad_));
    if (turn_rad >= kTurn_rad) {
      turned_rad_ += turn_rad;
      yaw_rad_ = yaw_rad;
    }
    samples.p_W.push_back(place);
    samples.driven_m.push_back(driven_m_);
    samples.turned_rad.push_back(turned_rad_);
  }

 private:
  Vec2 place_;      // where the current move began
  double yaw_rad_;  // where the current turn began
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
};

Samples samples_of(const Drive& drive) {
  Samples samples;
  if (drive.empty()) return samples;
  Sums sums(drive.X_WB.front());
  // Rows with this period fall on the samples but for rounding.
  const double end_s = drive.time_s.back() + 1e-6;
  std::size_t row = 0;
  for (std::size_t k = 0; static_cast<double>(k) * kPeriod_s <= end_s; ++k) {
    const double time_s = static_cast<double>(k) * kPeriod_s;
    while (row + 1 < drive.time_s.size() && drive.time_s[row + 1] <= time_s + 1e-6) ++row;
    Vec2 place = drive.X_WB[row].position();
    if (row + 1 < drive.time_s.size() && time_s > drive.time_s[row]) {
      const double share =
          (time_s - drive.time_s[row]) / (drive.time_s[row + 1] - drive.time_s[row]);
      place += share * (drive.X_WB[row + 1].position() - place);
    }
    sums.add(place, drive.X_WB[row].yaw_rad, samples);
  }
  return samples;
}

std::vector<Samples> samples_of(const ProgramDrives& drives) {
  std::vector<Samples> all;
  all.reserve(drives.size());
  for (const Drive& drive : drives) all.push_back(samples_of(drive));
  return all;
}

// The first sample at which two robots are apart; kNever: none.
std::size_t parting(const Samples& a, const Samples& b, double apart_m) {
  const double square = apart_m * apart_m;
  const std::size_t end = std::max(a.p_W.size(), b.p_W.size());
  for (std::size_t k = 0; k < end; ++k) {
    if ((a.p_W[a.at(k)] - b.p_W[b.at(k)]).squaredNorm() > square) return k;
  }
  return kNever;
}

// --- The speeds that a program commands --------------------------------------------------------

constexpr double kDrives_mps = 0.05;     // slower robots stand, or turn on the spot
constexpr double kStraight_radps = 0.5;  // faster turns are curves
constexpr double kTurns_radps = 0.1;     // slower turns are corrections
constexpr double kOnTheSpot_mps = 0.01;
constexpr double kSpeedStep_mps = 1e-4;  // resolution of speeds; trajectories have 1e-5
constexpr double kTurnStep_radps = 1e-4;
constexpr double kLeastShare = 0.1;  // of the time, for a speed that is commanded often
constexpr int kFewest = 20;          // samples of a speed that is commanded often

// How often each speed occurs, in steps of a resolution.
class SpeedCounts {
 public:
  explicit SpeedCounts(double step) : step_(step) {}

  void add(double speed) { ++counts_[std::lround(speed / step_)]; }
  // A sample that has no such speed, but belongs to the whole.
  void add_to_whole() { ++whole_; }

  // The speeds that occur often, the most frequent first.
  [[nodiscard]] std::vector<double> frequent() const {
    std::map<long, int> left = counts_;
    std::vector<double> speeds;
    for (;;) {
      long best = 0;
      int most = 0;
      for (const auto& [value, count] : left) {
        const int near = count + count_of(left, value - 1) + count_of(left, value + 1);
        if (near > most) {
          most = near;
          best = value;
        }
      }
      if (most < kFewest || most < kLeastShare * whole_) return speeds;
      speeds.push_back(static_cast<double>(best) * step_);
      for (long value = best - 2; value <= best + 2; ++value) left.erase(value);
    }
  }

 private:
  static int count_of(const std::map<long, int>& counts, long value) {
    const auto found = counts.find(value);
    return found == counts.end() ? 0 : found->second;
  }

  double step_;
  std::map<long, int> counts_;
  int whole_ = 0;
};

struct Speeds {
  std::vector<double> straight_mps;
  std::vector<double> on_the_spot_radps;
};

Speeds speeds_of(const ProgramDrives& drives) {
  SpeedCounts straight(kSpeedStep_mps);
  SpeedCounts on_the_spot(kTurnStep_radps);
  for (const Drive& drive : drives) {
    for (std::size_t k = 1; k < drive.time_s.size(); ++k) {
      const double time_s = drive.time_s[k] - drive.time_s[k - 1];
      if (time_s < 0.5 * kPeriod_s) continue;
      const sim::Pose& from = drive.X_WB[k - 1];
      const sim::Pose& to = drive.X_WB[k];
      const double speed_mps = (to.position() - from.position()).norm() / time_s;
      const double turn_radps = std::abs(sim::normalize_angle(to.yaw_rad - from.yaw_rad)) / time_s;
      if (speed_mps > kDrives_mps) straight.add_to_whole();
      if (speed_mps > kDrives_mps && turn_radps < kStraight_radps) straight.add(speed_mps);
      if (turn_radps > kTurns_radps) on_the_spot.add_to_whole();
      if (turn_radps > kTurns_radps && speed_mps < kOnTheSpot_mps) on_the_spot.add(turn_radps);
    }
  }
  return {straight.frequent(), on_the_spot.frequent()};
}

enum class SpeedRelation { kUnknown, kEqual, kChanged, kOther };

// How the most frequent speed of one program is found in another.
SpeedRelation relation_of(double speed, const std::vector<double>& others, double step,
                          double nearly_equal) {
  SpeedRelation relation = SpeedRelation::kOther;
  for (const double other : others) {
    const double difference = std::abs(speed - other);
    // Half a step of rounding each, and one of the neighbours that were counted together.
    if (difference < 2.5 * step) return SpeedRelation::kEqual;
    if (difference <= nearly_equal * std::max(speed, other)) relation = SpeedRelation::kChanged;
  }
  return relation;
}

SpeedRelation relation_of(const std::vector<double>& a, const std::vector<double>& b, double step,
                          double nearly_equal) {
  if (a.empty() || b.empty()) return SpeedRelation::kUnknown;
  return std::max(relation_of(a.front(), b, step, nearly_equal),
                  relation_of(b.front(), a, step, nearly_equal));
}

// The factor of the least likeness of a pair.
double factor_of(const Speeds& a, const Speeds& b, const LikenessLimits& limits) {
  const SpeedRelation straight =
      relation_of(a.straight_mps, b.straight_mps, kSpeedStep_mps, limits.nearly_equal);
  const SpeedRelation turns =
      relation_of(a.on_the_spot_radps, b.on_the_spot_radps, kTurnStep_radps, limits.nearly_equal);
  if (std::max(straight, turns) == SpeedRelation::kOther) return limits.other_factor;
  const bool both = straight == SpeedRelation::kChanged && turns == SpeedRelation::kChanged;
  return both ? limits.changed_factor : 1.0;
}

// --- Pairs --------------------------------------------------------------------------------------

// A program, prepared for comparisons.
struct Program {
  Speeds speeds;
  std::vector<Samples> runs;
  // Per run: the sample at which the program has parted from all baselines; 0: there is none;
  // kNever: it drives like one of them.
  std::vector<std::size_t> left;
  std::vector<std::size_t> same_as;  // per run: the first run of its world with the same samples
};

Program program_of(const std::vector<std::string>& worlds, const ProgramDrives& drives,
                   const std::vector<std::vector<Samples>>& baselines, double apart_m) {
  Program program;
  program.speeds = speeds_of(drives);
  program.runs = samples_of(drives);
  for (std::size_t r = 0; r < drives.size(); ++r) {
    const Samples& own = program.runs[r];
    std::size_t left = 0;
    for (const std::vector<Samples>& baseline : baselines) {
      if (own.empty() || baseline[r].empty()) continue;
      left = std::max(left, parting(own, baseline[r], apart_m));
    }
    program.left.push_back(left);
    std::size_t same = 0;
    while (worlds[same] != worlds[r] || program.runs[same].p_W != own.p_W) ++same;
    program.same_as.push_back(same);
  }
  return program;
}

// What one run says about a pair.
struct Shared {
  std::size_t run = 0;
  double driven_m = 0.0;  // together, after the baselines
  double likeness = 0.0;
  std::size_t parted = kNever;
};

// @return none: the run says nothing.
std::optional<Shared> compare(const Program& a, const Program& b, std::size_t run,
                              const LikenessLimits& limits) {
  const Samples& of_a = a.runs[run];
  const Samples& of_b = b.runs[run];
  if (of_a.empty() || of_b.empty()) return std::nullopt;
  if (a.same_as[run] == b.same_as[run] && a.same_as[run] != run) return std::nullopt;
  if (std::max(of_a.driven_m_between(a.left[run], kNever),
               of_b.driven_m_between(b.left[run], kNever)) < limits.least_driven_m) {
    return std::nullopt;
  }
  Shared shared;
  shared.run = run;
  shared.parted = parting(of_a, of_b, limits.apart_m);
  const std::size_t from = std::max(a.left[run], b.left[run]);
  if (from >= shared.parted) return shared;
  shared.driven_m = std::min(of_a.driven_m_between(from, shared.parted),
                             of_b.driven_m_between(from, shared.parted));
  const double turned_rad = std::min(of_a.turned_rad_between(from, shared.parted),
                                     of_b.turned_rad_between(from, shared.parted));
  shared.likeness = std::sqrt(shared.driven_m * turned_rad);
  return shared;
}

double mean_distance_m(const Samples& a, const Samples& b, std::size_t parted) {
  const std::size_t end = std::min(parted, std::max(a.p_W.size(), b.p_W.size()));
  double sum_m = 0.0;
  for (std::size_t k = 0; k < end; ++k) sum_m += (a.p_W[a.at(k)] - b.p_W[b.at(k)]).norm();
  return end == 0 ? 0.0 : sum_m / static_cast<double>(end);
}

// @return none: the pair is not alike.
std::optional<Likeness> likeness_of(const std::vector<std::string>& worlds, const Program& a,
                                    const Program& b, const LikenessLimits& limits) {
  Likeness pair;
  std::vector<Shared> compared;
  std::set<std::string_view> compared_worlds;
  for (std::size_t run = 0; run < worlds.size(); ++run) {
    const std::optional<Shared> shared = compare(a, b, run, limits);
    if (!shared) continue;
    compared.push_back(*shared);
    compared_worlds.insert(worlds[run]);
    pair.likeness += shared->likeness;
  }
  if (compared.empty()) return std::nullopt;
  pair.runs = compared.size();
  pair.worlds = compared_worlds.size();
  pair.likeness /= static_cast<double>(pair.runs);
  pair.threshold = factor_of(a.speeds, b.speeds, limits) * limits.least_in(pair.worlds);
  if (pair.likeness < pair.threshold) return std::nullopt;
  const Shared* most = &compared.front();
  for (const Shared& shared : compared) {
    if (shared.likeness >= pair.threshold) ++pair.alike;
    if (shared.likeness > most->likeness) most = &shared;
  }
  pair.run = most->run;
  pair.shared_m = most->driven_m;
  pair.distance_m = mean_distance_m(a.runs[most->run], b.runs[most->run], most->parted);
  if (most->parted != kNever) pair.parted_s = static_cast<double>(most->parted) * kPeriod_s;
  return pair;
}

void check_runs(const std::vector<ProgramDrives>& programs, std::size_t runs) {
  for (const ProgramDrives& drives : programs) {
    if (drives.size() == runs) continue;
    throw std::invalid_argument("expected " + std::to_string(runs) +
                                " runs of each program, found " + std::to_string(drives.size()));
  }
}

}  // namespace

double LikenessLimits::least_in(std::size_t worlds) const noexcept {
  if (worlds >= enough_worlds) return least_likeness;
  const double missing = static_cast<double>(enough_worlds) / static_cast<double>(worlds);
  return std::min(one_world_likeness, least_likeness * missing);
}

std::vector<Likeness> find_alike(const std::vector<std::string>& worlds,
                                 const std::vector<ProgramDrives>& programs,
                                 const std::vector<ProgramDrives>& baselines,
                                 const LikenessLimits& limits) {
  check_runs(programs, worlds.size());
  check_runs(baselines, worlds.size());
  std::vector<std::vector<Samples>> known;
  for (const ProgramDrives& drives : baselines) known.push_back(samples_of(drives));
  std::vector<Program> prepared;
  prepared.reserve(programs.size());
  for (const ProgramDrives& drives : programs) {
    prepared.push_back(program_of(worlds, drives, known, limits.apart_m));
  }
  std::vector<Likeness> found;
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    for (std::size_t j = i + 1; j < prepared.size(); ++j) {
      std::optional<Likeness> pair = likeness_of(worlds, prepared[i], prepared[j], limits);
      if (!pair) continue;
      pair->first = i;
      pair->second = j;
      found.push_back(*pair);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Likeness& a, const Likeness& b) {
    return a.likeness / a.threshold > b.likeness / b.threshold;
  });
  return found;
}

}  // namespace playpen::course
