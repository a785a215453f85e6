// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sweep of edges into beams, written once over a vector type V and compiled once for every
// instruction set. Every lane does the same IEEE operations for every V, so the results are
// bit-identical.
//
// A file compiled for newer instructions must not emit functions that the linker could choose for
// the whole program. Therefore V is local to its file, everything here is a template over V, and
// functions of the standard library are called only through ScanJob's pointers.
//
// Geometry. An edge lies on the line through p0 with direction d. The beam with direction b meets
// it at the range r = c / (d x b), where c = d x p0 > 0 for an edge that faces the sensor at the
// origin. So 1/r = (d x b) / c is linear in b: the sweep keeps the largest 1/r of every beam and
// divides once at the end. In single precision, this formula loses digits if the beam is nearly
// parallel to the edge. Instead it is expanded around an anchor beam a, which lies k beams before
// b:
//     1/r = A cos(k q) + B sin(k q),   A = (d x b_a) / c,   B = (d . b_a) / c,
// where q is the angle between beams, and A and B are computed in double precision. If the anchor
// is at that end of the span where 1/r is least, |A cos| <= 1/r and |B sin| <= 2/r. Then there is
// no cancellation, and the relative error is at most 10 roundings, 6e-7.

#include <cstddef>
#include <cstdint>

#include "scan/scan_job.h"

namespace sim::scan::detail {

/// Determines the spans of an edge in double precision, for edges with a corner so close to a beam
/// that single precision cannot decide on which side. Adds the nonempty spans (none, one or two) as
/// candidates at `index` and after. Returns the next free index.
std::int32_t append_exact_spans(const ScanJob& job, std::int32_t edge, std::int32_t index);

/// The steps for AVX2; only for processors that support it.
[[nodiscard]] const ScanSteps& avx2_steps();

/// For each set of 4 lanes (as a bit mask): the indices of the set lanes first, and their number.
struct LaneList {
  std::int32_t lanes[4];
  std::int32_t count;
};
inline constexpr LaneList kLaneLists[16] = {
    {{0, 0, 0, 0}, 0}, {{0, 0, 0, 0}, 1}, {{1, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 2},
    {{2, 0, 0, 0}, 1}, {{0, 2, 0, 0}, 2}, {{1, 2, 0, 0}, 2}, {{0, 1, 2, 0}, 3},
    {{3, 0, 0, 0}, 1}, {{0, 3, 0, 0}, 2}, {{1, 3, 0, 0}, 2}, {{0, 1, 3, 0}, 3},
    {{2, 3, 0, 0}, 2}, {{0, 2, 3, 0}, 3}, {{1, 2, 3, 0}, 3}, {{0, 1, 2, 3}, 4}};

/// Appends base + lane to `list` for every lane in `bits`, without branches. Writes up to 4 values
/// more than it appends. Returns the new length.
template <class V>
std::int32_t append_lanes(unsigned bits, std::int32_t base, std::int32_t* list,
                          std::int32_t length) {
  for (int group = 0; group < V::kLanes; group += 4) {
    const LaneList& set = kLaneLists[(bits >> group) & 15U];
    for (int i = 0; i < 4; ++i) list[length + i] = base + group + set.lanes[i];
    length += set.count;
  }
  return length;
}

/// Bit mask of the lanes below `count`.
template <class V>
unsigned lanes_below(std::int32_t count) {
  const std::int32_t some = count < 0 ? 0 : count < V::kLanes ? count : V::kLanes;
  return (1U << some) - 1U;
}

/// Makes candidates of the edges that face the sensor, and of a few that are nearly edge-on.
template <class V>
std::int32_t find_facing(const ScanJob& job) {
  using Float = typename V::Float;
  // Twice the bound of the relative rounding error of a product.
  const Float tolerance = V::broadcast(2.4e-7F);
  std::int32_t count = 0;
  for (std::int32_t base = 0; base < job.edge_count; base += V::kLanes) {
    Float x0, y0, x1, y1;
    V::load_edges(job.edges + base, x0, y0, x1, y1);
    const Float left = y0 * x1;
    const Float right = x0 * y1;
    const Float doubt = tolerance * (V::abs(left) + V::abs(right));
    const unsigned bits =
        V::bits(V::less(right - left, doubt)) & lanes_below<V>(job.edge_count - base);
    count = append_lanes<V>(bits, base, job.candidate_edge, count);
  }
  return count;
}

/// Angle of a point in beams, plus 1: beam i has the coordinate i + 1. The error is below
/// job.doubt_beams. The arctangent is a minimax polynomial with an error of at most 2.5e-7 rad.
template <class V>
typename V::Float beam_coordinate(const ScanJob& job, typename V::Float x, typename V::Float y) {
  using Float = typename V::Float;
  const Float ax = V::abs(x);
  const Float ay = V::abs(y);
  const Float t = V::min(ax, ay) / V::max(ax, ay);
  const Float s = t * t;
  // Evaluated in pairs: a chain of dependent products would stall the processor.
  const Float s2 = s * s;
  const Float p0 = V::broadcast(0.9999961F) + V::broadcast(-0.3331737F) * s;
  const Float p2 = V::broadcast(0.1980782F) + V::broadcast(-0.1323334F) * s;
  const Float p4 = V::broadcast(0.07962370F) + V::broadcast(-0.03360424F) * s;
  const Float p46 = p4 + V::broadcast(0.006811800F) * s2;
  Float p = t * ((p0 + p2 * s2) + p46 * (s2 * s2));
  p = V::select(V::less(ax, ay), V::broadcast(1.57079633F) - p, p);
  p = V::select(V::less(x, V::broadcast(0.0F)), V::broadcast(3.14159265F) - p, p);
  p = V::copy_sign(p, y);
  return p * V::broadcast(job.beams_per_rad) + V::broadcast(job.beam_offset);
}

/// Computes the beam coordinates of the candidates' corners. A separate loop lets the processor
/// overlap the long dependency chains of several groups.
template <class V>
void find_corners(const ScanJob& job, std::int32_t candidate_count) {
  using Float = typename V::Float;
  const Float cos_yaw = V::broadcast(static_cast<float>(job.cos_yaw));
  const Float sin_yaw = V::broadcast(static_cast<float>(job.sin_yaw));
  for (std::int32_t i = candidate_count; (i & (V::kLanes - 1)) != 0; ++i) job.candidate_edge[i] = 0;
  for (std::int32_t base = 0; base < candidate_count; base += V::kLanes) {
    Float x0, y0, x1, y1;
    V::gather_edges(job.edges, job.candidate_edge + base, x0, y0, x1, y1);
    // The first corner of an edge that faces the sensor is the one farther counter-clockwise.
    V::store(job.candidate_low + base,
             beam_coordinate<V>(job, cos_yaw * x1 + sin_yaw * y1, cos_yaw * y1 - sin_yaw * x1));
    V::store(job.candidate_high + base,
             beam_coordinate<V>(job, cos_yaw * x0 + sin_yaw * y0, cos_yaw * y0 - sin_yaw * x0));
  }
}

/// Lengths of job.narrow, job.medium and job.wide.
struct SpanCounts {
  std::int32_t narrow = 0;
  std::int32_t medium = 0;
  std::int32_t wide = 0;
};

/// Computes the spans of the candidates and lists the nonempty ones.
template <class V>
SpanCounts find_spans(const ScanJob& job, std::int32_t candidate_count) {
  using Float = typename V::Float;
  const Float low = V::broadcast(0.5F);
  const Float high = V::broadcast(static_cast<float>(job.beam_count) + 0.5F);
  const Float half = V::broadcast(0.5F);
  const Float sure = V::broadcast(0.5F - job.doubt_beams);
  const Float behind = V::broadcast(job.behind_beams);
  const Float one = V::broadcast(1.0F);
  const Float width = V::broadcast(static_cast<float>(V::kLanes));
  const Float inverse_width = V::broadcast(1.0F / static_cast<float>(V::kLanes));
  const Float narrow_beams = V::broadcast(static_cast<float>(kNarrowBeams));
  const Float medium_beams = V::broadcast(static_cast<float>(kMediumBeams));

  // The candidates so far are in groups; those from append_exact_spans() are added after them.
  const std::int32_t groups_end = (candidate_count + V::kLanes - 1) & -V::kLanes;
  std::int32_t free_index = groups_end;

  SpanCounts counts;
  for (std::int32_t base = 0; base < candidate_count; base += V::kLanes) {
    const Float v_low = V::load(job.candidate_low + base);
    const Float v_high = V::load(job.candidate_high + base);
    // An edge in view spans less than half a turn. If the difference is more negative than that,
    // the edge crosses the cut behind the sensor, and spans all beams after v_low and all up to
    // v_high.
    const auto cut = V::less(behind, v_low - v_high);

    // The span: beams i with v_low <= i + 1 <= v_high. NaN becomes `low`.
    const Float low_clamped = V::min(V::max(v_low, low), high);
    const Float high_clamped = V::min(V::max(v_high, low), high);
    const Float first = V::truncate(low_clamped);
    const Float high_end = V::truncate(high_clamped);
    const Float end = V::select(cut, high - half, high_end);
    V::store_integers(job.candidate_first + base, first);
    V::store_integers(job.candidate_last + base, end - one);

    const unsigned lanes = lanes_below<V>(candidate_count - base);
    const unsigned unsure = (V::bits(V::less(sure, V::abs(low_clamped - first - half))) |
                             V::bits(V::less(sure, V::abs(high_clamped - high_end - half)))) &
                            lanes;
    const Float block = V::truncate(first * inverse_width) * width;
    const unsigned not_narrow = V::bits(V::less(narrow_beams, end - block));
    const unsigned wide = V::bits(V::less(medium_beams, end - block));
    const unsigned good = V::bits(V::less(first, end)) & lanes & ~unsure;
    counts.narrow = append_lanes<V>(good & ~not_narrow, base, job.narrow, counts.narrow);
    counts.medium = append_lanes<V>(good & not_narrow & ~wide, base, job.medium, counts.medium);
    counts.wide = append_lanes<V>(good & wide, base, job.wide, counts.wide);

    const unsigned twofold = V::bits(cut) & V::bits(V::less(half, high_end)) & lanes & ~unsure;
    if ((unsure | twofold) != 0) {
      const std::int32_t* const edges = job.candidate_edge + base;
      std::int32_t high_ends[V::kLanes];
      V::store_integers(high_ends, high_end);
      for (int lane = 0; lane < V::kLanes; ++lane) {
        if (((unsure >> lane) & 1U) != 0) {
          free_index = append_exact_spans(job, edges[lane], free_index);
        } else if (((twofold >> lane) & 1U) != 0) {
          job.candidate_edge[free_index] = edges[lane];
          job.candidate_first[free_index] = 0;
          job.candidate_last[free_index] = high_ends[lane] - 1;
          ++free_index;
        }
      }
    }
  }
  for (std::int32_t i = groups_end; i < free_index; ++i) {
    const std::int32_t beams = job.candidate_last[i] + 1 - (job.candidate_first[i] & -V::kLanes);
    if (beams <= kNarrowBeams) {
      job.narrow[counts.narrow++] = i;
    } else if (beams <= kMediumBeams) {
      job.medium[counts.medium++] = i;
    } else {
      job.wide[counts.wide++] = i;
    }
  }
  return counts;
}

/// Converts a list of candidates to spans for the sweep. Pads the list with copies of its first
/// element.
template <class V>
void expand_spans(const ScanJob& job, std::int32_t* list, std::int32_t count) {
  using Float = typename V::Float;
  using Double = typename V::Double;
  const Double cos_yaw = V::broadcast(job.cos_yaw);
  const Double sin_yaw = V::broadcast(job.sin_yaw);
  const Double one = V::broadcast(1.0);
  const Double zero = V::broadcast(0.0);
  for (std::int32_t i = count; (i & (V::kLanes - 1)) != 0; ++i) list[i] = list[0];

  for (std::int32_t base = 0; base < count; base += V::kLanes) {
    std::int32_t* const firsts = job.first + base;
    std::int32_t* const lasts = job.last + base;
    std::int32_t edges[V::kLanes];
    for (int lane = 0; lane < V::kLanes; ++lane) {
      const std::int32_t candidate = list[base + lane];
      edges[lane] = job.candidate_edge[candidate];
      firsts[lane] = job.candidate_first[candidate];
      lasts[lane] = job.candidate_last[candidate];
    }
    Float x0, y0, x1, y1;
    V::gather_edges(job.edges, edges, x0, y0, x1, y1);

    Double a[V::kHalves], b[V::kHalves];
    typename V::DoubleMask use_first[V::kHalves], hidden[V::kHalves];
    for (int half = 0; half < V::kHalves; ++half) {
      const Double px = V::widen(x0, half);
      const Double py = V::widen(y0, half);
      const Double dx = V::widen(x1, half) - px;
      const Double dy = V::widen(y1, half) - py;
      const Double c = dx * py - dy * px;
      const Double tx = cos_yaw * dx + sin_yaw * dy;
      const Double ty = cos_yaw * dy - sin_yaw * dx;
      const int lane = half * (V::kLanes / V::kHalves);
      Double first_x, first_y, last_x, last_y;
      V::gather_beams(job.beams, firsts + lane, first_x, first_y);
      V::gather_beams(job.beams, lasts + lane, last_x, last_y);
      const Double at_first = tx * first_y - ty * first_x;
      const Double at_last = tx * last_y - ty * last_x;
      const auto choice = V::less_equal(at_first, at_last);
      const Double anchor_x = V::select(choice, first_x, last_x);
      const Double anchor_y = V::select(choice, first_y, last_y);
      const Double scale = one / c;
      a[half] = V::select(choice, at_first, at_last) * scale;
      b[half] = (tx * anchor_x + ty * anchor_y) * scale;
      use_first[half] = choice;
      hidden[half] = V::less_equal(c, zero);
    }
    V::store(job.a + base, V::narrow(a));
    V::store(job.b + base, V::narrow(b));
    V::choose_integers(job.anchor + base, V::narrow_mask(use_first), firsts, lasts);
    const unsigned drop = V::bits(V::narrow_mask(hidden));
    if (drop != 0) {
      for (int lane = 0; lane < V::kLanes; ++lane) {
        if (((drop >> lane) & 1U) != 0) job.a[base + lane] = job.b[base + lane] = 0.0F;
      }
    }
  }
}

/// The state of one span during its sweep over the beams.
template <class V>
struct Sweep {
  Sweep(const ScanJob& job, std::int32_t span)
      : block(job.first[span] & -V::kLanes),
        inverse_ranges(job.inverse_ranges + block),
        cosines(job.cos_table + block - job.anchor[span]),
        sines(job.sin_table + block - job.anchor[span]),
        a(V::broadcast(job.a[span])),
        b(V::broadcast(job.b[span])),
        window(V::make_window(job.first[span] - block, job.last[span] - block)) {}

  /// 1/r of the beams [block + offset, block + offset + kLanes).
  [[nodiscard]] typename V::Float value(std::int32_t offset) const {
    return a * V::load(cosines + offset) + b * V::load(sines + offset);
  }
  /// Raises the inverse ranges of those beams to those of the span.
  void raise(std::int32_t offset) const { raise_to(offset, value(offset)); }
  /// Raises only the beams within the span.
  void raise_partly(std::int32_t offset) const {
    raise_to(offset, V::drop(V::outside(window, offset), value(offset)));
  }
  void raise_to(std::int32_t offset, typename V::Float least) const {
    // NaN changes nothing.
    V::store(inverse_ranges + offset, V::max(least, V::load_aligned(inverse_ranges + offset)));
  }

  std::int32_t block;  ///< the span's first beam, rounded down to a multiple of the vector's width
  float* inverse_ranges;
  const float* cosines;
  const float* sines;
  typename V::Float a;
  typename V::Float b;
  typename V::Window window;
};

/// Sweeps `count` spans of at most kBeams beams, counted from a multiple of the vector's width.
template <class V, int kBeams>
void sweep_short(const ScanJob& job, std::int32_t count) {
  for (std::int32_t i = 0; i < count; ++i) {
    const Sweep<V> sweep(job, i);
    for (int offset = 0; offset < kBeams; offset += V::kLanes) sweep.raise_partly(offset);
  }
}

/// Sweeps `count` spans of any width.
template <class V>
void sweep_wide(const ScanJob& job, std::int32_t count) {
  for (std::int32_t i = 0; i < count; ++i) {
    const Sweep<V> sweep(job, i);
    const std::int32_t last = job.last[i] - sweep.block;
    sweep.raise_partly(0);
    std::int32_t offset = V::kLanes;
    for (; offset + V::kLanes <= last; offset += V::kLanes) sweep.raise(offset);
    sweep.raise_partly(offset);
  }
}

/// 1/r for an obstacle that is so near that nothing can be nearer [1/m].
inline constexpr float kNothingNearer = 1e30F;

/// Initialises all beams to meet nothing.
template <class V>
void clear(const ScanJob& job) {
  // Slightly less than 1 / range_max, so that the range of beams that meet nothing is clamped to
  // exactly range_max.
  const auto least_inverse = V::broadcast(static_cast<float>(0.999999 / job.range_max_m));
  for (std::int32_t beam = 0; beam < job.beam_count; beam += V::kLanes) {
    V::store(job.inverse_ranges + beam, least_inverse);
  }
  // The beams of the last block beyond the last beam see nothing.
  for (std::int32_t beam = job.beam_count; (beam & (kBlockBeams - 1)) != 0; ++beam) {
    job.inverse_ranges[beam] = kNothingNearer;
  }
}

/// Sweeps all edges into the beams.
template <class V>
void sweep(const ScanJob& job) {
  const std::int32_t candidate_count = find_facing<V>(job);
  find_corners<V>(job, candidate_count);
  const SpanCounts counts = find_spans<V>(job, candidate_count);
  expand_spans<V>(job, job.narrow, counts.narrow);
  sweep_short<V, kNarrowBeams>(job, counts.narrow);
  expand_spans<V>(job, job.medium, counts.medium);
  sweep_short<V, kMediumBeams>(job, counts.medium);
  expand_spans<V>(job, job.wide, counts.wide);
  sweep_wide<V>(job, counts.wide);
}

/// Computes job.minima.
template <class V>
void find_minima(const ScanJob& job) {
  const std::int32_t blocks = (job.beam_count + kBlockBeams - 1) / kBlockBeams;
  for (std::int32_t block = 0; block < blocks; block += V::kLanes) {
    V::store(job.minima + block, V::minima(job.inverse_ranges + block * kBlockBeams));
  }
}

/// Whether some beam from first to last, or a few beams before or after, sees farther than 1 /
/// nearest. Uses the minima of blocks, which must have been computed before.
template <class V>
bool is_open(const ScanJob& job, std::int32_t first, std::int32_t last, float nearest) {
  const auto least = V::broadcast(nearest);
  const std::int32_t end = last / kBlockBeams + 1;
  unsigned any = 0;
  for (std::int32_t block = first / kBlockBeams; block < end; block += V::kLanes) {
    any |= V::bits(V::less(V::load(job.minima + block), least)) & lanes_below<V>(end - block);
  }
  return any != 0;
}

/// Like is_open(), but tests the beams themselves. Most spans fit three vectors, which are tested
/// without an unpredictable branch.
template <class V>
bool is_open_to_a_beam(const ScanJob& job, std::int32_t first, std::int32_t last, float nearest) {
  const auto least = V::broadcast(nearest);
  const auto open = [&](std::int32_t beam) {
    return V::bits(V::less(V::load(job.inverse_ranges + beam), least)) &
           lanes_below<V>(last - beam + 1);
  };
  unsigned any = open(first) | open(first + V::kLanes) | open(first + 2 * V::kLanes);
  for (std::int32_t beam = first + 3 * V::kLanes; beam <= last && any == 0; beam += V::kLanes) {
    any |= open(beam);
  }
  return any != 0;
}

/// Discs as seen by a scan, one per lane. A disc spans the beams within asin(radius / distance) of
/// its centre, where asin(t) <= t + (pi / 2 - 1) t^3. No beam meets it nearer than distance -
/// radius.
template <class V>
struct DiscView {
  typename V::Float first;    ///< first beam that it may span
  typename V::Float last;     ///< last beam that it may span
  typename V::Float inverse;  ///< upper bound of 1/r of its nearest point
  unsigned near;              ///< bit mask of discs with a near centre
  unsigned shown;             ///< bit mask of discs that may be partly in view
};

/// Bit mask of the lanes whose squared distance is less than the square of `limit`, or NaN.
template <class V>
unsigned lanes_within(typename V::Float limit, typename V::Float squared) {
  return ~V::bits(V::less_equal(limit * limit, squared));
}

template <class V>
class DiscLocator {
 public:
  using Float = typename V::Float;

  explicit DiscLocator(const ScanJob& job)
      : job_(job),
        cos_yaw_(V::broadcast(static_cast<float>(job.cos_yaw))),
        sin_yaw_(V::broadcast(static_cast<float>(job.sin_yaw))),
        doubt_(V::broadcast(0.01F + 2.0F * job.doubt_beams)),
        half_fan_(V::broadcast(0.5F * static_cast<float>(job.beam_count + 1))),
        range_max_(V::broadcast(static_cast<float>(job.range_max_m))),
        last_beam_(V::broadcast(static_cast<float>(job.beam_count - 1))) {}

  /// Tests the lanes' discs from `base` on; the list has `count` discs.
  [[nodiscard]] DiscView<V> locate_discs(const float* disc_x, const float* disc_y,
                                         const float* disc_radius, std::int32_t base,
                                         std::int32_t count) const {
    // These margins cover the rounding of the positions of sensor, discs and edges.
    const Float slack = V::broadcast(1e-4F);
    const Float relative_slack = V::broadcast(2e-5F);
    const Float zero = V::broadcast(0.0F);
    const Float one = V::broadcast(1.0F);

    const Float dx = V::load(disc_x + base) - V::broadcast(job_.sensor_x);
    const Float dy = V::load(disc_y + base) - V::broadcast(job_.sensor_y);
    const Float radius = V::load(disc_radius + base) + slack;
    const Float x = cos_yaw_ * dx + sin_yaw_ * dy;
    const Float y = cos_yaw_ * dy - sin_yaw_ * dx;
    const Float squared = x * x + y * y;
    const Float distance = V::sqrt(squared);
    const Float t = radius / distance;
    const Float spread =
        (t + V::broadcast(0.5708F) * t * t * t) * V::broadcast(job_.beams_per_rad) + doubt_;
    const Float middle = beam_coordinate<V>(job_, x, y);
    const Float aside = V::abs(middle - V::broadcast(job_.beam_offset));
    const Float nearest = distance - radius - relative_slack * distance;

    // Set if the sensor is certainly outside of the disc; not set for NaN.
    const unsigned outside = V::bits(V::less(zero, nearest));
    const unsigned in_view =
        V::bits(V::less(aside - spread, half_fan_)) & V::bits(V::less(nearest, range_max_));
    // A disc around the sensor, or across the cut behind it, is treated as if it spanned all beams
    // and nothing could hide it.
    const Float farthest =
        V::select(V::less(zero, nearest), aside + spread, V::broadcast(kNothingNearer));
    const auto part = V::less(farthest, V::broadcast(2.0F * job_.behind_beams));
    // Beam i has the coordinate i + 1. The span is extended by one beam on either side.
    return {V::select(part, V::min(V::max(middle - spread - one, zero), last_beam_), zero),
            V::select(part, V::min(V::max(middle + spread - one, zero), last_beam_), last_beam_),
            V::select(part, one / nearest, V::broadcast(kNothingNearer)),
            lanes_within<V>(V::broadcast(ScanKernel::kNear_m), squared),
            (in_view | ~outside) & lanes_below<V>(count - base)};
  }

 private:
  const ScanJob& job_;
  Float cos_yaw_;
  Float sin_yaw_;
  Float doubt_;
  Float half_fan_;
  Float range_max_;
  Float last_beam_;
};

/// A test of discs without their bearings, coarser and faster than DiscLocator::locate_discs().
template <class V>
struct CoarseDiscView {
  typename V::Float squared;  ///< square of the distance of its centre
  typename V::Float radius;
  unsigned in_view;  ///< bit mask of discs that may be partly in view
};

/// Tests the lanes' discs from `base` on; the list has `count` discs.
template <class V>
CoarseDiscView<V> locate_discs_coarsely(const ScanJob& job, const float* disc_x,
                                        const float* disc_y, const float* disc_radius,
                                        std::int32_t base, std::int32_t count) {
  using Float = typename V::Float;
  const Float cos_yaw = V::broadcast(static_cast<float>(job.cos_yaw));
  const Float sin_yaw = V::broadcast(static_cast<float>(job.sin_yaw));
  const Float dx = V::load(disc_x + base) - V::broadcast(job.sensor_x);
  const Float dy = V::load(disc_y + base) - V::broadcast(job.sensor_y);
  const Float x = cos_yaw * dx + sin_yaw * dy;
  const Float y = cos_yaw * dy - sin_yaw * dx;
  const Float squared = x * x + y * y;
  // This margin covers the rounding errors of everything in range.
  const Float radius = V::load(disc_radius + base) + V::broadcast(1e-3F);
  const Float reach = radius + V::broadcast(static_cast<float>(job.range_max_m));
  const unsigned too_far = V::bits(V::less(reach * reach, squared));
  // A disc is out of view if it is beyond the sides of the fan by more than its radius: beyond
  // either side, or beyond both if the fan is wider than half a turn.
  const Float ahead = V::broadcast(job.fan_sin) * x;
  const Float aside = V::broadcast(job.fan_cos) * y;
  const unsigned left = V::bits(V::less(radius, aside - ahead));
  const unsigned right = V::bits(V::less(radius, V::broadcast(0.0F) - aside - ahead));
  const unsigned outside = job.fan_cos < 0.0F ? left & right : left | right;
  return {squared, radius, ~(too_far | outside) & lanes_below<V>(count - base)};
}

/// Lists the groups of discs that may be in view, and their near discs.
template <class V>
Located locate(const ScanJob& job) {
  const auto near_m = V::broadcast(ScanKernel::kNear_m);
  const std::int32_t group_count =
      (job.disc_count + DiscBuffer::kGroupSize - 1) / DiscBuffer::kGroupSize;
  Located located;
  std::int32_t near_groups = 0;
  for (std::int32_t base = 0; base < group_count; base += V::kLanes) {
    unsigned in_view = lanes_below<V>(group_count - base);
    unsigned near = in_view;
    if (job.group_count != 0) {
      const CoarseDiscView<V> seen = locate_discs_coarsely<V>(job, job.group_x, job.group_y,
                                                              job.group_radius, base, group_count);
      in_view = seen.in_view;
      near = in_view & lanes_within<V>(near_m + seen.radius, seen.squared);
    }
    located.groups = append_lanes<V>(in_view, base, job.groups, located.groups);
    near_groups = append_lanes<V>(near, base, job.some, near_groups);
  }
  for (std::int32_t i = 0; i < near_groups; ++i) {
    const std::int32_t begin = job.some[i] * DiscBuffer::kGroupSize;
    for (std::int32_t base = begin; base < begin + DiscBuffer::kGroupSize; base += V::kLanes) {
      const CoarseDiscView<V> seen = locate_discs_coarsely<V>(
          job, job.disc_x, job.disc_y, job.disc_radius, base, job.disc_count);
      const unsigned near = seen.in_view & lanes_within<V>(near_m, seen.squared);
      located.near = append_lanes<V>(near, base, job.near, located.near);
    }
  }
  return located;
}

/// Lists the groups in view that a beam may meet before all swept edges, or all if the discs are
/// not grouped. Returns their number.
template <class V>
std::int32_t find_open_groups(const ScanJob& job, const DiscLocator<V>& locator,
                              std::int32_t groups) {
  if (job.group_count == 0) {
    for (std::int32_t i = 0; i < groups; ++i) job.some[i] = job.groups[i];
    return groups;
  }
  for (std::int32_t base = 0; base < job.group_count; base += V::kLanes) {
    const DiscView<V> seen =
        locator.locate_discs(job.group_x, job.group_y, job.group_radius, base, job.group_count);
    V::store_integers(job.group_first + base, seen.first);
    V::store_integers(job.group_last + base, seen.last);
    V::store(job.group_inverse + base, seen.inverse);
  }
  std::int32_t open = 0;
  for (std::int32_t i = 0; i < groups; ++i) {
    const std::int32_t k = job.groups[i];
    job.some[open] = k;
    open += is_open<V>(job, job.group_first[k], job.group_last[k], job.group_inverse[k]) ? 1 : 0;
  }
  return open;
}

/// Lists the discs that are not near and that a beam may meet before all swept edges. Returns their
/// number.
template <class V>
std::int32_t find_visible(const ScanJob& job, std::int32_t groups) {
  if (groups == 0) return 0;
  find_minima<V>(job);
  const DiscLocator<V> locator(job);
  const std::int32_t open = find_open_groups<V>(job, locator, groups);
  std::int32_t in_view = 0;
  for (std::int32_t i = 0; i < open; ++i) {
    const std::int32_t begin = job.some[i] * DiscBuffer::kGroupSize;
    for (std::int32_t base = begin; base < begin + DiscBuffer::kGroupSize; base += V::kLanes) {
      const DiscView<V> seen =
          locator.locate_discs(job.disc_x, job.disc_y, job.disc_radius, base, job.disc_count);
      V::store_integers(job.disc_first + base, seen.first);
      V::store_integers(job.disc_last + base, seen.last);
      V::store(job.disc_inverse + base, seen.inverse);
      in_view = append_lanes<V>(seen.shown & ~seen.near, base, job.visible, in_view);
    }
  }
  std::int32_t count = 0;
  for (std::int32_t i = 0; i < in_view; ++i) {
    const std::int32_t k = job.visible[i];
    job.visible[count] = k;
    count += is_open<V>(job, job.disc_first[k], job.disc_last[k], job.disc_inverse[k]) ? 1 : 0;
  }
  std::int32_t seen = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t k = job.visible[i];
    job.visible[seen] = k;
    seen +=
        is_open_to_a_beam<V>(job, job.disc_first[k], job.disc_last[k], job.disc_inverse[k]) ? 1 : 0;
  }
  return seen;
}

/// Converts the inverse ranges to ranges, in the precision of `Range`.
template <class V, typename Range>
void finish_to(const ScanJob& job, Range* ranges_m) {
  const auto range_max_m = static_cast<Range>(job.range_max_m);
  const std::int32_t whole = job.beam_count & ~(V::kLanes - 1);
  const auto one = V::broadcast(1.0F);
  for (std::int32_t beam = 0; beam < whole; beam += V::kLanes) {
    V::store_ranges(ranges_m + beam, one / V::load_aligned(job.inverse_ranges + beam), range_max_m);
  }
  for (std::int32_t beam = whole; beam < job.beam_count; ++beam) {
    const auto range_m = static_cast<Range>(1.0F / job.inverse_ranges[beam]);
    ranges_m[beam] = range_m < range_max_m ? range_m : range_max_m;
  }
}

template <class V>
void finish(const ScanJob& job) {
  finish_to<V>(job, job.ranges_m);
}

/// Rounding does not change the order of two numbers, so each range is that of finish(), rounded.
template <class V>
void finish_single(const ScanJob& job) {
  finish_to<V>(job, job.single_ranges_m);
}

/// The steps implemented with the instructions of V.
template <class V>
inline constexpr ScanSteps kSteps{clear<V>,        sweep<V>,  locate<V>,
                                  find_visible<V>, finish<V>, finish_single<V>};

}  // namespace sim::scan::detail
