// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/scan/scan_kernel.h"

namespace sim::scan::detail {

/// Number of beams that the tables and the scratch memory have in addition on either side.
inline constexpr int kBeamPadding = 40;

/// Maximum lengths of spans, counted from a multiple of the vector's width, that are swept without
/// a loop of variable length. Such a loop would cost more than a few idle lanes. Most spans are
/// short.
inline constexpr int kNarrowBeams = 16;
inline constexpr int kMediumBeams = 32;

/// Block size of the occlusion test of discs [beams].
inline constexpr int kBlockBeams = 8;

/// Input and output of a scan. Every array has room for processing in groups of 8.
struct ScanJob {
  const Edge* edges;  ///< with the axes of W
  std::int32_t edge_count;
  double cos_yaw;
  double sin_yaw;

  std::int32_t beam_count;
  double range_max_m;
  double resolution_rad;
  const double* beams;     ///< (x, y) of each beam in the sensor's frame, including beams -1 and
                           ///< beam_count
  const float* cos_table;  ///< cos(k q), for k from -(beam_count + padding) on
  const float* sin_table;  ///< sin(k q), for the same k
  float beams_per_rad;     ///< 1 / q
  float beam_offset;       ///< beam coordinate of the forward direction, plus 1
  float doubt_beams;       ///< error bound of a beam coordinate
  float fan_cos;           ///< cosine of half the angle from beam -1 to beam_count, plus a margin;
                           ///< -1 beyond a full turn
  float fan_sin;           ///< sine of that angle; 0 beyond a full turn
  float behind_beams;      ///< a quarter turn; an edge that crosses the cut behind the sensor has a
                           ///< more negative span

  // Scratch. A candidate is an edge with a span of beams that may meet it.
  std::int32_t* candidate_edge;   ///< index of its edge
  std::int32_t* candidate_first;  ///< its first beam
  std::int32_t* candidate_last;   ///< its last beam; the span is empty if this is less than the
                                  ///< first
  float* candidate_low;           ///< beam coordinate of its corner further clockwise
  float* candidate_high;          ///< beam coordinate of the other corner
  std::int32_t* narrow;           ///< candidates with a narrow span
  std::int32_t* medium;           ///< candidates with a medium span
  std::int32_t* wide;             ///< candidates with a wider span
  // Scratch. The spans to sweep, in the order of a list of candidates.
  std::int32_t* first;    ///< first beam
  std::int32_t* last;     ///< last beam
  std::int32_t* anchor;   ///< beam around which 1/r is expanded
  float* a;               ///< coefficient A [1/m]
  float* b;               ///< coefficient B [1/m]
  float* inverse_ranges;  ///< largest 1/r of each beam so far, aligned to 32 bytes [1/m]
  float* minima;          ///< minimum of inverse_ranges in each block of kBlockBeams beams

  double* ranges_m;        ///< output of finish(), beam_count values
  float* single_ranges_m;  ///< output of finish_single(), beam_count values

  // Discs to test for visibility.
  const float* disc_x;       ///< in W, like the sensor's position
  const float* disc_y;       ///< in W
  const float* disc_radius;  ///< with padding
  std::int32_t disc_count;
  const float* group_x;  ///< circles around groups of kGroupSize discs
  const float* group_y;
  const float* group_radius;
  std::int32_t group_count;  ///< 0: discs are not grouped
  float sensor_x;
  float sensor_y;
  // Scratch, by disc: the beams that it may span, and an upper bound of 1/r of its nearest point.
  std::int32_t* disc_first;
  std::int32_t* disc_last;
  float* disc_inverse;
  std::int32_t* group_first;  ///< first beam of each group's circle
  std::int32_t* group_last;
  float* group_inverse;
  std::int32_t* groups;   ///< groups in view
  std::int32_t* some;     ///< groups whose discs must be tested
  std::int32_t* near;     ///< output: near discs in view
  std::int32_t* visible;  ///< output: other discs that may be visible
};

/// Numbers of located discs and groups.
struct Located {
  std::int32_t near = 0;    ///< length of ScanJob::near
  std::int32_t groups = 0;  ///< length of ScanJob::groups
};

/// The steps of a scan, implemented with one instruction set.
struct ScanSteps {
  void (*clear)(const ScanJob&);
  void (*sweep)(const ScanJob&);
  Located (*locate)(const ScanJob&);
  std::int32_t (*find_visible)(const ScanJob&, std::int32_t groups);  ///< returns their number
  void (*finish)(const ScanJob&);
  void (*finish_single)(const ScanJob&);
};

/// Lowers the ranges of the beams that meet a circle. Computed in double precision, and the same
/// for all instruction sets. A circle that contains the sensor is not seen.
/// @param ranges_m  of all beams.
void scan_circle(const ScanJob& job, const Circle& circle, double* ranges_m);
/// The same with ranges that are rounded to single precision.
void scan_circle(const ScanJob& job, const Circle& circle, float* ranges_m);

}  // namespace sim::scan::detail
