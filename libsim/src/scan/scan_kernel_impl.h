// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sweep of edges into beams, written once over a vector type V and compiled once for every
// instruction set. Every lane does the same IEEE operations whatever V is, so the bits agree.
//
// A file compiled for newer instructions must not emit functions that the linker could pick for
// all the program: so V is local to its file, everything here is a template over V, and nothing
// from the standard library's headers is called but through ScanJob's pointers.
//
// Geometry. An edge on the line through p0 with direction d is met by the beam of direction b at
// the range r = c / (d x b), where c = d x p0 > 0 for an edge that faces the sensor at the origin.
// So 1/r = (d x b) / c is linear in b: the sweep keeps the greatest 1/r of every beam and divides
// once at the end. Taken literally in single precision this loses digits where the beam runs nearly
// along the edge. Instead it is expanded about an anchor beam a, which lies k beams before b:
//     1/r = A cos(k q) + B sin(k q),   A = (d x b_a) / c,   B = (d . b_a) / c,
// with q the angle between beams, and A and B computed in double precision. With the anchor at that
// end of the span where 1/r is least, |A cos| <= 1/r and so |B sin| <= 2/r: no cancellation, and a
// relative error of at most 10 roundings, 6e-7.

#include <cstddef>
#include <cstdint>

#include "sim/scan/scan_kernel.h"

namespace sim::scan::detail {

/// Beams that the tables and the scratch memory exceed the scanner's by, on either side.
inline constexpr int kBeamPadding = 32;

/// Spans of at most this many beams, counted from a multiple of the vector's width, are swept
/// without a loop: most are, and a loop of unforeseeable length costs more than idle lanes.
inline constexpr int kNarrowBeams = 16;

/// What a scan reads and writes. Every array is big enough to be handled in groups of 8.
struct ScanJob {
  const Edge* edges;  ///< W-aligned
  std::int32_t edge_count;
  double cos_yaw;
  double sin_yaw;

  std::int32_t beam_count;
  double range_max_m;
  double resolution_rad;
  const double* beams;      ///< (x, y) of each beam in the sensor's frame; also of -1 and beam_count
  const float* cos_table;   ///< cos(k q), for k from -(beam_count + padding) on
  const float* sin_table;   ///< sin(k q), likewise
  float beams_per_rad;      ///< 1 / q
  float beam_offset;        ///< beam coordinate of straight ahead, plus 1
  float doubt_beams;        ///< error bound of a beam coordinate
  float behind_beams;       ///< a quarter turn: an edge across the cut behind spans "minus" more

  std::int32_t* facing;     ///< scratch: indices of the edges that may face the sensor
  std::int32_t* narrow;     ///< scratch: indices of narrow spans
  std::int32_t* wide;       ///< scratch: indices of the other spans
  std::int32_t* anchor;     ///< spans: beam about which 1/r is expanded
  std::int32_t* first;      ///< spans: first beam
  std::int32_t* end;        ///< spans: beam after the last
  float* a;                 ///< spans: coefficient A [1/m]
  float* b;                 ///< spans: coefficient B [1/m]
  float* inverse_ranges;    ///< scratch [1/m]
  double* ranges_m;         ///< out, beam_count
};

/// Adds the span of one edge over beams [first, end), if it is not empty and the edge faces the
/// sensor, at `index` of the span arrays. Returns the next free index.
std::int32_t append_span(const ScanJob& job, const Edge& edge, std::int32_t first,
                         std::int32_t end, std::int32_t index);

/// Adds the spans (none, one or two) of an edge with an end so near a beam that single precision
/// cannot tell on which side, or so near the cut behind; decides in double precision.
std::int32_t append_exact_spans(const ScanJob& job, const Edge& edge, std::int32_t index);

/// The sweep for wide instructions; called only on processors that have them.
void scan_avx2(const ScanJob& job);

/// For each set of 4 lanes (a bit mask): the numbers of its lanes in front, and how many.
struct LaneList {
  std::int32_t lanes[4];
  std::int32_t count;
};
inline constexpr LaneList kLaneLists[16] = {
    {{0, 0, 0, 0}, 0}, {{0, 0, 0, 0}, 1}, {{1, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 2},
    {{2, 0, 0, 0}, 1}, {{0, 2, 0, 0}, 2}, {{1, 2, 0, 0}, 2}, {{0, 1, 2, 0}, 3},
    {{3, 0, 0, 0}, 1}, {{0, 3, 0, 0}, 2}, {{1, 3, 0, 0}, 2}, {{0, 1, 3, 0}, 3},
    {{2, 3, 0, 0}, 2}, {{0, 2, 3, 0}, 3}, {{1, 2, 3, 0}, 3}, {{0, 1, 2, 3}, 4}};

/// Appends base + lane to `list` for every lane in `bits`, without branches; writes up to 4 values
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

/// Bits of the lanes below `count`.
template <class V>
unsigned lanes_below(std::int32_t count) {
  return count >= V::kLanes ? (1U << V::kLanes) - 1U : (1U << count) - 1U;
}

/// Lists the edges that may face the sensor and may be within range. Errs on the side of keeping.
template <class V>
std::int32_t find_facing(const ScanJob& job) {
  using Float = typename V::Float;
  // Bounds the relative error of a product's rounding, twice over.
  const Float tolerance = V::broadcast(2.4e-7F);
  const auto reach_m = static_cast<float>(job.range_max_m);
  const Float reach_squared = V::broadcast(reach_m * reach_m * 1.00001F);
  const Float zero = V::broadcast(0.0F);
  std::int32_t count = 0;
  for (std::int32_t base = 0; base < job.edge_count; base += V::kLanes) {
    Float x0, y0, x1, y1;
    V::load_edges(job.edges + base, x0, y0, x1, y1);
    const Float left = y0 * x1;
    const Float right = x0 * y1;
    const Float c = left - right;
    const Float doubt = tolerance * (V::abs(left) + V::abs(right));
    // The line's distance is c / |d|.
    const Float dx = x1 - x0;
    const Float dy = y1 - y0;
    const Float c_least = V::max(c - doubt, zero);
    const auto near = V::less_equal(c_least * c_least, reach_squared * (dx * dx + dy * dy));
    const auto faces = V::less(zero, c + doubt);
    const unsigned bits =
        V::bits(faces) & V::bits(near) & lanes_below<V>(job.edge_count - base);
    count = append_lanes<V>(bits, base, job.facing, count);
  }
  return count;
}

/// Angle of a point in beams, plus 1: beam i has the coordinate i + 1. Error below
/// job.doubt_beams. The arctangent is a minimax polynomial, off by at most 2.5e-7 rad.
template <class V>
typename V::Float beam_coordinate(const ScanJob& job, typename V::Float x, typename V::Float y) {
  using Float = typename V::Float;
  const Float ax = V::abs(x);
  const Float ay = V::abs(y);
  const Float t = V::min(ax, ay) / V::max(ax, ay);
  const Float s = t * t;
  Float p = V::broadcast(0.006811800F);
  p = p * s + V::broadcast(-0.03360424F);
  p = p * s + V::broadcast(0.07962370F);
  p = p * s + V::broadcast(-0.1323334F);
  p = p * s + V::broadcast(0.1980782F);
  p = p * s + V::broadcast(-0.3331737F);
  p = p * s + V::broadcast(0.9999961F);
  p = p * t;
  p = V::select(V::less(ax, ay), V::broadcast(1.57079633F) - p, p);
  p = V::select(V::less(x, V::broadcast(0.0F)), V::broadcast(3.14159265F) - p, p);
  p = V::copy_sign(p, y);
  return p * V::broadcast(job.beams_per_rad) + V::broadcast(job.beam_offset);
}

/// Numbers of spans found: those at the front of job.narrow and job.wide.
struct SpanCounts {
  std::int32_t narrow = 0;
  std::int32_t wide = 0;
};

/// Sorts the spans [begin, end), which one by one were added by append_span(), into the lists.
template <class V>
void list_spans(const ScanJob& job, std::int32_t begin, std::int32_t end, SpanCounts& counts) {
  for (std::int32_t i = begin; i < end; ++i) {
    if (job.end[i] - job.first[i] / V::kLanes * V::kLanes <= kNarrowBeams) {
      job.narrow[counts.narrow++] = i;
    } else {
      job.wide[counts.wide++] = i;
    }
  }
}

/// Finds the span of beams and the coefficients of every facing edge.
template <class V>
SpanCounts find_spans(const ScanJob& job, std::int32_t facing_count) {
  using Float = typename V::Float;
  using Double = typename V::Double;
  const Float cos_yaw = V::broadcast(static_cast<float>(job.cos_yaw));
  const Float sin_yaw = V::broadcast(static_cast<float>(job.sin_yaw));
  const Double cos_yaw_d = V::broadcast(job.cos_yaw);
  const Double sin_yaw_d = V::broadcast(job.sin_yaw);
  const Float low = V::broadcast(0.5F);
  const Float high = V::broadcast(static_cast<float>(job.beam_count) + 0.5F);
  const Float half = V::broadcast(0.5F);
  const Float sure = V::broadcast(0.5F - job.doubt_beams);
  const Float behind = V::broadcast(job.behind_beams);
  const Float one = V::broadcast(1.0F);
  const Float width = V::broadcast(static_cast<float>(V::kLanes));
  const Float inverse_width = V::broadcast(1.0F / static_cast<float>(V::kLanes));
  const Float narrow_beams = V::broadcast(static_cast<float>(kNarrowBeams));

  // Spans of the groups come first; those added one by one follow.
  std::int32_t free_index = (facing_count + V::kLanes - 1) / V::kLanes * V::kLanes;
  const std::int32_t single_begin = free_index;
  for (std::int32_t i = facing_count; i < free_index; ++i) job.facing[i] = 0;

  SpanCounts counts;
  for (std::int32_t base = 0; base < facing_count; base += V::kLanes) {
    Float x0, y0, x1, y1;
    V::gather_edges(job.edges, job.facing + base, x0, y0, x1, y1);

    // The first corner of an edge that faces the sensor is the one further counter-clockwise.
    const Float v_high = beam_coordinate<V>(job, cos_yaw * x0 + sin_yaw * y0,
                                            cos_yaw * y0 - sin_yaw * x0);
    const Float v_low = beam_coordinate<V>(job, cos_yaw * x1 + sin_yaw * y1,
                                           cos_yaw * y1 - sin_yaw * x1);
    // Beams i with v_low <= i + 1 <= v_high. A value that is not a number becomes `low`.
    const Float low_clamped = V::min(V::max(v_low, low), high);
    const Float high_clamped = V::min(V::max(v_high, low), high);
    const Float first = V::truncate(low_clamped);
    const Float end = V::truncate(high_clamped);
    const Float last = end - one;
    const unsigned special = V::bits(V::less(sure, V::abs(low_clamped - first - half))) |
                             V::bits(V::less(sure, V::abs(high_clamped - end - half))) |
                             V::bits(V::less(behind, v_low - v_high));

    alignas(32) std::int32_t first_index[V::kLanes];
    alignas(32) std::int32_t last_index[V::kLanes];
    V::store_integers(first_index, first);
    V::store_integers(last_index, last);

    Double a[V::kHalves], b[V::kHalves];
    typename V::DoubleMask at_first[V::kHalves], faces[V::kHalves];
    for (int h = 0; h < V::kHalves; ++h) {
      const Double px = V::widen(x0, h);
      const Double py = V::widen(y0, h);
      const Double dx = V::widen(x1, h) - px;
      const Double dy = V::widen(y1, h) - py;
      const Double c = dx * py - dy * px;
      const Double tx = cos_yaw_d * dx + sin_yaw_d * dy;
      const Double ty = cos_yaw_d * dy - sin_yaw_d * dx;
      const int lane = h * (V::kLanes / V::kHalves);
      Double first_x, first_y, last_x, last_y;
      V::gather_beams(job.beams, first_index + lane, first_x, first_y);
      V::gather_beams(job.beams, last_index + lane, last_x, last_y);
      const Double at_first_value = tx * first_y - ty * first_x;
      const Double at_last_value = tx * last_y - ty * last_x;
      at_first[h] = V::less_equal(at_first_value, at_last_value);
      faces[h] = V::less(V::broadcast(0.0), c);
      const Double scale = V::broadcast(1.0) / c;
      a[h] = V::select(at_first[h], at_first_value, at_last_value) * scale;
      b[h] = V::select(at_first[h], tx * first_x + ty * first_y, tx * last_x + ty * last_y) * scale;
    }
    V::store(job.a + base, V::narrow(a));
    V::store(job.b + base, V::narrow(b));
    V::store_integers(job.anchor + base, V::select(V::narrow_mask(at_first), first, last));
    V::store_integers(job.first + base, first);
    V::store_integers(job.end + base, end);

    const Float block = V::truncate(first * inverse_width) * width;
    const unsigned wide = V::bits(V::less(narrow_beams, end - block));
    const unsigned lanes = lanes_below<V>(facing_count - base);
    const unsigned good =
        V::bits(V::less(first, end)) & V::bits(V::narrow_mask(faces)) & lanes & ~special;
    counts.narrow = append_lanes<V>(good & ~wide, base, job.narrow, counts.narrow);
    counts.wide = append_lanes<V>(good & wide, base, job.wide, counts.wide);

    unsigned rest = special & lanes;
    for (int lane = 0; rest != 0; ++lane, rest >>= 1) {
      if ((rest & 1U) != 0) {
        free_index = append_exact_spans(job, job.edges[job.facing[base + lane]], free_index);
      }
    }
  }
  list_spans<V>(job, single_begin, free_index, counts);
  return counts;
}

/// Raises the beams' inverse ranges at [beam, beam + kLanes) to those of a span.
template <class V>
void raise_block(float* inverse_ranges, const float* cosines, const float* sines, std::int32_t beam,
                 typename V::Float a, typename V::Float b) {
  const auto value = a * V::load(cosines + beam) + b * V::load(sines + beam);
  V::store(inverse_ranges + beam, V::max(value, V::load_aligned(inverse_ranges + beam)));
}

/// The same for those beams only that lie in [first, end).
template <class V>
void raise_partly(float* inverse_ranges, const float* cosines, const float* sines,
                  std::int32_t beam, typename V::Float a, typename V::Float b, std::int32_t first,
                  std::int32_t end) {
  const auto value = a * V::load(cosines + beam) + b * V::load(sines + beam);
  const auto kept = V::keep(V::lanes_between(beam, first, end), value);
  V::store(inverse_ranges + beam, V::max(kept, V::load_aligned(inverse_ranges + beam)));
}

/// Sweeps the spans over the beams.
template <class V>
void sweep_spans(const ScanJob& job, const SpanCounts& counts) {
  float* const inverse = job.inverse_ranges;
  for (std::int32_t i = 0; i < counts.narrow; ++i) {
    const std::int32_t span = job.narrow[i];
    const auto a = V::broadcast(job.a[span]);
    const auto b = V::broadcast(job.b[span]);
    const std::int32_t first = job.first[span];
    const std::int32_t end = job.end[span];
    const float* const cosines = job.cos_table - job.anchor[span];
    const float* const sines = job.sin_table - job.anchor[span];
    const std::int32_t block = first & ~(V::kLanes - 1);
    for (int offset = 0; offset < kNarrowBeams; offset += V::kLanes) {
      raise_partly<V>(inverse, cosines, sines, block + offset, a, b, first, end);
    }
  }
  for (std::int32_t i = 0; i < counts.wide; ++i) {
    const std::int32_t span = job.wide[i];
    const auto a = V::broadcast(job.a[span]);
    const auto b = V::broadcast(job.b[span]);
    const std::int32_t first = job.first[span];
    const std::int32_t end = job.end[span];
    const float* const cosines = job.cos_table - job.anchor[span];
    const float* const sines = job.sin_table - job.anchor[span];
    std::int32_t block = first & ~(V::kLanes - 1);
    raise_partly<V>(inverse, cosines, sines, block, a, b, first, end);
    for (block += V::kLanes; block + V::kLanes <= end; block += V::kLanes) {
      raise_block<V>(inverse, cosines, sines, block, a, b);
    }
    raise_partly<V>(inverse, cosines, sines, block, a, b, first, end);
  }
}

/// The whole scan.
template <class V>
void run_scan(const ScanJob& job) {
  // A little less than 1 / range_max, so that beams which meet nothing are cut to range_max itself.
  const auto least_inverse = V::broadcast(static_cast<float>(0.999999 / job.range_max_m));
  for (std::int32_t beam = 0; beam < job.beam_count; beam += V::kLanes) {
    V::store(job.inverse_ranges + beam, least_inverse);
  }
  sweep_spans<V>(job, find_spans<V>(job, find_facing<V>(job)));

  const std::int32_t whole = job.beam_count & ~(V::kLanes - 1);
  const auto one = V::broadcast(1.0F);
  for (std::int32_t beam = 0; beam < whole; beam += V::kLanes) {
    V::store_ranges(job.ranges_m + beam, one / V::load_aligned(job.inverse_ranges + beam),
                    job.range_max_m);
  }
  for (std::int32_t beam = whole; beam < job.beam_count; ++beam) {
    const auto range_m = static_cast<double>(1.0F / job.inverse_ranges[beam]);
    job.ranges_m[beam] = range_m < job.range_max_m ? range_m : job.range_max_m;
  }
}

}  // namespace sim::scan::detail
