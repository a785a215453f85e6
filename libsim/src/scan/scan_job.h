// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/scan/scan_kernel.h"

namespace sim::scan::detail {

/// Beams that the tables and the scratch memory exceed the scanner's by, on either side.
inline constexpr int kBeamPadding = 40;

/// Spans of at most so many beams, counted from a multiple of the vector's width, are swept without
/// a loop of unforeseeable length, which would cost more than a few idle lanes. Most spans are so.
inline constexpr int kNarrowBeams = 16;
inline constexpr int kMediumBeams = 32;

/// What discs may be hidden behind is known for blocks of so many beams.
inline constexpr int kBlockBeams = 8;

/// What a scan reads and writes. Every array is big enough to be handled in groups of 8.
struct ScanJob {
  const Edge* edges;  ///< W-aligned
  std::int32_t edge_count;
  double cos_yaw;
  double sin_yaw;

  std::int32_t beam_count;
  double range_max_m;
  double resolution_rad;
  const double* beams;     ///< (x, y) of each beam in the sensor's frame; also of -1 and beam_count
  const float* cos_table;  ///< cos(k q), for k from -(beam_count + padding) on
  const float* sin_table;  ///< sin(k q), likewise
  float beams_per_rad;     ///< 1 / q
  float beam_offset;       ///< beam coordinate of straight ahead, plus 1
  float doubt_beams;       ///< error bound of a beam coordinate
  float fan_cos;           ///< of half the angle from the beam before the first to that after the
  float fan_sin;           ///< last, and a little; -1 and 0 for all that is more than a turn
  float behind_beams;      ///< a quarter turn: an edge across the cut behind spans "minus" more

  // Scratch. A candidate is an edge with the span of beams it may be seen by.
  std::int32_t* candidate_edge;   ///< index of its edge
  std::int32_t* candidate_first;  ///< its first beam
  std::int32_t* candidate_last;   ///< its last beam; the span is empty if that is before the first
  float* candidate_low;           ///< beam coordinate of its corner further clockwise
  float* candidate_high;          ///< beam coordinate of the other corner
  std::int32_t* narrow;           ///< candidates with a narrow span
  std::int32_t* medium;           ///< candidates with a medium span
  std::int32_t* wide;             ///< candidates with a wider span
  // Scratch. Spans to sweep, in the order of a list of candidates.
  std::int32_t* first;    ///< first beam
  std::int32_t* last;     ///< last beam
  std::int32_t* anchor;   ///< beam about which 1/r is expanded
  float* a;               ///< coefficient A [1/m]
  float* b;               ///< coefficient B [1/m]
  float* inverse_ranges;  ///< greatest 1/r so far of every beam, at a multiple of 32 bytes [1/m]
  float* minima;          ///< the least of them in each block of kBlockBeams beams

  double* ranges_m;  ///< out, beam_count

  // Discs to look for.
  const float* disc_x;       ///< in W, as the sensor's place
  const float* disc_y;       ///< likewise
  const float* disc_radius;  ///< and room to read some more
  std::int32_t disc_count;
  const float* group_x;       ///< circles round kGroupSize of them each
  const float* group_y;       ///< likewise
  const float* group_radius;  ///< likewise
  std::int32_t group_count;   ///< 0: discs are not grouped
  float sensor_x;
  float sensor_y;
  // Scratch, by disc: the beams that it may span, and 1/r of its nearest point at most.
  std::int32_t* disc_first;
  std::int32_t* disc_last;
  float* disc_inverse;
  std::int32_t* group_first;  ///< the same by group
  std::int32_t* group_last;
  float* group_inverse;
  std::int32_t* groups;   ///< those in view
  std::int32_t* some;     ///< some of them, to look at their discs
  std::int32_t* near;     ///< out: near discs in view
  std::int32_t* visible;  ///< out: other discs that may be seen
};

/// How many discs were located.
struct Located {
  std::int32_t near = 0;    ///< in ScanJob::near
  std::int32_t groups = 0;  ///< in ScanJob::groups
};

/// What a scan consists of, by one kind of instructions.
struct ScanSteps {
  void (*clear)(const ScanJob&);
  void (*sweep)(const ScanJob&);
  Located (*locate)(const ScanJob&);
  std::int32_t (*find_visible)(const ScanJob&, std::int32_t groups);  ///< returns how many are
  void (*finish)(const ScanJob&);
};

}  // namespace sim::scan::detail
