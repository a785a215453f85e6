// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/scan/scan_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scan/scan_kernel_impl.h"
#include "sim/core/assert.h"
#include "sim/core/math.h"

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

namespace sim::scan {

namespace detail {
namespace {

/// A vector of one lane in plain C++.
struct Scalar {
  static constexpr int kLanes = 1;
  static constexpr int kHalves = 1;
  using Float = float;
  using Mask = bool;
  using Double = double;
  using DoubleMask = bool;

  static float broadcast(float value) { return value; }
  static double broadcast(double value) { return value; }
  static float load(const float* from) { return *from; }
  static float load_aligned(const float* from) { return *from; }
  static void store(float* to, float value) { *to = value; }
  static void store_integers(std::int32_t* to, float value) {
    *to = static_cast<std::int32_t>(value);
  }
  static void choose_integers(std::int32_t* to, bool mask, const std::int32_t* yes,
                              const std::int32_t* no) {
    *to = mask ? *yes : *no;
  }
  static void store_ranges(double* to, float value, double greatest) {
    *to = std::min(static_cast<double>(value), greatest);
  }
  static void store_ranges(float* to, float value, float greatest) {
    *to = std::min(value, greatest);
  }

  static float abs(float value) { return std::fabs(value); }
  static float copy_sign(float magnitude, float sign) { return std::copysign(magnitude, sign); }
  // Same semantics as the vector instructions: the second operand if either is NaN.
  static float min(float a, float b) { return a < b ? a : b; }
  static float max(float a, float b) { return a > b ? a : b; }
  static float sqrt(float value) { return std::sqrt(value); }
  /// Minimum of each of kLanes blocks of eight that begin at a multiple of 32 bytes.
  static float minima(const float* from) {
    float least = from[0];
    for (int i = 1; i < kBlockBeams; ++i) least = min(from[i], least);
    return least;
  }
  static float truncate(float value) { return static_cast<float>(static_cast<int>(value)); }

  static bool less(float a, float b) { return a < b; }
  static bool less_equal(float a, float b) { return a <= b; }
  static bool less(double a, double b) { return a < b; }
  static bool less_equal(double a, double b) { return a <= b; }
  static unsigned bits(bool mask) { return mask ? 1U : 0U; }
  static float select(bool mask, float yes, float no) { return mask ? yes : no; }
  static double select(bool mask, double yes, double no) { return mask ? yes : no; }
  static float drop(bool mask, float value) { return mask ? 0.0F : value; }
  struct Window {
    std::int32_t first;
    std::int32_t last;
  };
  static Window make_window(std::int32_t first, std::int32_t last) { return {first, last}; }
  static bool outside(const Window& window, std::int32_t offset) {
    return offset < window.first || offset > window.last;
  }

  static double widen(float value, int /*half*/) { return static_cast<double>(value); }
  static float narrow(const double (&halves)[1]) { return static_cast<float>(halves[0]); }
  static bool narrow_mask(const bool (&halves)[1]) { return halves[0]; }

  static void load_edges(const Edge* edges, float& x0, float& y0, float& x1, float& y1) {
    x0 = edges->x0_m;
    y0 = edges->y0_m;
    x1 = edges->x1_m;
    y1 = edges->y1_m;
  }
  static void gather_edges(const Edge* edges, const std::int32_t* index, float& x0, float& y0,
                           float& x1, float& y1) {
    load_edges(edges + *index, x0, y0, x1, y1);
  }
  static void gather_beams(const double* beams, const std::int32_t* index, double& x, double& y) {
    x = beams[2 * *index];
    y = beams[2 * *index + 1];
  }
};

#if defined(__x86_64__)

/// A vector of four lanes; doubles are two halves of two lanes.
struct Sse2 {
  static constexpr int kLanes = 4;
  static constexpr int kHalves = 2;
  using Float = __m128;
  using Mask = __m128;
  using Double = __m128d;
  using DoubleMask = __m128d;

  static Float broadcast(float value) { return _mm_set1_ps(value); }
  static Double broadcast(double value) { return _mm_set1_pd(value); }
  static Float load(const float* from) { return _mm_loadu_ps(from); }
  static Float load_aligned(const float* from) { return _mm_load_ps(from); }
  static void store(float* to, Float value) { _mm_storeu_ps(to, value); }
  static void store_integers(std::int32_t* to, Float value) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_cvttps_epi32(value));
  }
  static void choose_integers(std::int32_t* to, Mask mask, const std::int32_t* yes,
                              const std::int32_t* no) {
    const Float chosen = select(mask, _mm_loadu_ps(reinterpret_cast<const float*>(yes)),
                                _mm_loadu_ps(reinterpret_cast<const float*>(no)));
    _mm_storeu_ps(reinterpret_cast<float*>(to), chosen);
  }
  static void store_ranges(double* to, Float value, double greatest) {
    const Double limit = broadcast(greatest);
    _mm_storeu_pd(to, _mm_min_pd(widen(value, 0), limit));
    _mm_storeu_pd(to + 2, _mm_min_pd(widen(value, 1), limit));
  }
  static void store_ranges(float* to, Float value, float greatest) {
    _mm_storeu_ps(to, _mm_min_ps(value, broadcast(greatest)));
  }

  static Float abs(Float value) { return _mm_andnot_ps(broadcast(-0.0F), value); }
  static Float copy_sign(Float magnitude, Float sign) {
    return _mm_or_ps(magnitude, _mm_and_ps(broadcast(-0.0F), sign));
  }
  static Float min(Float a, Float b) { return _mm_min_ps(a, b); }
  static Float max(Float a, Float b) { return _mm_max_ps(a, b); }
  static Float sqrt(Float value) { return _mm_sqrt_ps(value); }
  static Float minima(const float* from) {
    const Float r0 = min(_mm_load_ps(from), _mm_load_ps(from + 4));
    const Float r1 = min(_mm_load_ps(from + 8), _mm_load_ps(from + 12));
    const Float r2 = min(_mm_load_ps(from + 16), _mm_load_ps(from + 20));
    const Float r3 = min(_mm_load_ps(from + 24), _mm_load_ps(from + 28));
    const Float r01 = min(_mm_unpacklo_ps(r0, r1), _mm_unpackhi_ps(r0, r1));
    const Float r23 = min(_mm_unpacklo_ps(r2, r3), _mm_unpackhi_ps(r2, r3));
    return min(_mm_movelh_ps(r01, r23), _mm_movehl_ps(r23, r01));
  }
  static Float truncate(Float value) { return _mm_cvtepi32_ps(_mm_cvttps_epi32(value)); }

  static Mask less(Float a, Float b) { return _mm_cmplt_ps(a, b); }
  static Mask less_equal(Float a, Float b) { return _mm_cmple_ps(a, b); }
  static DoubleMask less(Double a, Double b) { return _mm_cmplt_pd(a, b); }
  static DoubleMask less_equal(Double a, Double b) { return _mm_cmple_pd(a, b); }
  static unsigned bits(Mask mask) { return static_cast<unsigned>(_mm_movemask_ps(mask)); }
  static Float select(Mask mask, Float yes, Float no) {
    return _mm_or_ps(_mm_and_ps(mask, yes), _mm_andnot_ps(mask, no));
  }
  static Double select(DoubleMask mask, Double yes, Double no) {
    return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no));
  }
  static Float drop(Mask mask, Float value) { return _mm_andnot_ps(mask, value); }
  /// Lanes [first, last] as a window: the offset of a lane from `first` is compared with `last` -
  /// `first`. Both are less than 2^31, so one comparison excludes lanes before and after.
  struct Window {
    __m128i beyond_first;
    __m128i length;
  };
  static Window make_window(std::int32_t first, std::int32_t last) {
    const __m128i lane = _mm_setr_epi32(INT32_MIN, INT32_MIN + 1, INT32_MIN + 2, INT32_MIN + 3);
    return {_mm_sub_epi32(lane, _mm_set1_epi32(first)), _mm_set1_epi32(INT32_MIN + (last - first))};
  }
  static Mask outside(const Window& window, std::int32_t offset) {
    const __m128i lane = _mm_add_epi32(window.beyond_first, _mm_set1_epi32(offset));
    return _mm_castsi128_ps(_mm_cmpgt_epi32(lane, window.length));
  }

  static Double widen(Float value, int half) {
    return _mm_cvtps_pd(half == 0 ? value : _mm_movehl_ps(value, value));
  }
  static Float narrow(const Double (&halves)[kHalves]) {
    return _mm_movelh_ps(_mm_cvtpd_ps(halves[0]), _mm_cvtpd_ps(halves[1]));
  }
  static Mask narrow_mask(const DoubleMask (&halves)[kHalves]) {
    return _mm_shuffle_ps(_mm_castpd_ps(halves[0]), _mm_castpd_ps(halves[1]), 0x88);
  }

  static void load_edges(const Edge* edges, Float& x0, Float& y0, Float& x1, Float& y1) {
    transpose(edges, edges + 1, edges + 2, edges + 3, x0, y0, x1, y1);
  }
  static void gather_edges(const Edge* edges, const std::int32_t* index, Float& x0, Float& y0,
                           Float& x1, Float& y1) {
    transpose(edges + index[0], edges + index[1], edges + index[2], edges + index[3], x0, y0, x1,
              y1);
  }
  static void gather_beams(const double* beams, const std::int32_t* index, Double& x, Double& y) {
    const Double even = _mm_loadu_pd(beams + 2 * index[0]);
    const Double odd = _mm_loadu_pd(beams + 2 * index[1]);
    x = _mm_unpacklo_pd(even, odd);
    y = _mm_unpackhi_pd(even, odd);
  }

 private:
  static void transpose(const Edge* e0, const Edge* e1, const Edge* e2, const Edge* e3, Float& x0,
                        Float& y0, Float& x1, Float& y1) {
    x0 = _mm_load_ps(&e0->x0_m);
    y0 = _mm_load_ps(&e1->x0_m);
    x1 = _mm_load_ps(&e2->x0_m);
    y1 = _mm_load_ps(&e3->x0_m);
    _MM_TRANSPOSE4_PS(x0, y0, x1, y1);
  }
};

#endif  // __x86_64__

/// A point in the plane, relative to the sensor.
struct Point {
  double x;
  double y;
};

/// Rotates a point from the axes of W into the sensor's frame.
Point turned(const ScanJob& job, float x_m, float y_m) {
  const auto x = static_cast<double>(x_m);
  const auto y = static_cast<double>(y_m);
  return {job.cos_yaw * x + job.sin_yaw * y, job.cos_yaw * y - job.sin_yaw * x};
}

/// Positive if `beam` points to the left (counter-clockwise) of the direction of `point`.
double left_of(const ScanJob& job, const Point& point, std::int32_t beam) {
  const double* const direction = job.beams + 2 * static_cast<std::ptrdiff_t>(beam);
  return point.x * direction[1] - point.y * direction[0];
}

}  // namespace

std::int32_t append_exact_spans(const ScanJob& job, std::int32_t edge, std::int32_t index) {
  const Edge& corners = job.edges[edge];
  const Point high = turned(job, corners.x0_m, corners.y0_m);
  const Point low = turned(job, corners.x1_m, corners.y1_m);
  const double angle_high = math::atan2(high.y, high.x);
  const double angle_low = math::atan2(low.y, low.x);

  // Angles determine the beam unless a beam is closer than their rounding; then the sign of the
  // cross product decides. Two edges that share a corner get the same answer, and the beam is in
  // both spans.
  const double centre = 0.5 * static_cast<double>(job.beam_count - 1);
  const double doubt = 1e-14 / job.resolution_rad + 1e-15 * static_cast<double>(job.beam_count);
  const auto count = static_cast<double>(job.beam_count);
  const double beam_low = angle_low / job.resolution_rad + centre;
  auto first = static_cast<std::int32_t>(std::clamp(std::ceil(beam_low - doubt), 0.0, count));
  while (first < job.beam_count && static_cast<double>(first) <= beam_low + doubt &&
         left_of(job, low, first) < 0.0) {
    ++first;
  }
  const double beam_high = angle_high / job.resolution_rad + centre;
  auto end = static_cast<std::int32_t>(std::clamp(std::floor(beam_high + doubt) + 1.0, 0.0, count));
  while (end > 0 && static_cast<double>(end - 1) >= beam_high - doubt &&
         left_of(job, high, end - 1) > 0.0) {
    --end;
  }

  const auto append = [&job, edge, &index](std::int32_t from, std::int32_t to) {
    if (from >= to) return;
    job.candidate_edge[index] = edge;
    job.candidate_first[index] = from;
    job.candidate_last[index] = to - 1;
    ++index;
  };
  // As in find_spans(): an edge spans less than half a turn, or crosses the cut behind the sensor.
  if (angle_low - angle_high > 0.5 * std::numbers::pi) {
    append(first, job.beam_count);
    append(0, end);
  } else {
    append(first, end);
  }
  return index;
}

}  // namespace detail

namespace {

/// Length of a scratch array for so many edges: whole groups, with padding. An edge may need three
/// places: one for its candidate, and two more for append_exact_spans().
std::size_t places(std::size_t edge_count) { return 3 * edge_count + 4 * EdgeBuffer::kPadding; }

/// Length of a scratch array for so many discs.
std::size_t disc_places(std::size_t disc_count) { return disc_count + 2 * DiscBuffer::kPadding; }

const detail::ScanSteps& steps_by(InstructionSet instructions) {
  SIM_ASSERT(ScanKernel::available(instructions));
  switch (instructions) {
    case InstructionSet::kAvx2:
#ifdef PLAYPEN_SCAN_AVX2
      return detail::avx2_steps();
#else
      break;
#endif
    case InstructionSet::kSse2:
#if defined(__x86_64__)
      return detail::kSteps<detail::Sse2>;
#else
      break;
#endif
    case InstructionSet::kScalar:
      break;
  }
  return detail::kSteps<detail::Scalar>;
}

}  // namespace

void EdgeBuffer::grow() { storage_.resize(std::max(2 * storage_.size(), size_ + kPadding)); }

void DiscBuffer::group() {
  group_count_ = (size_ + kGroupSize - 1) / kGroupSize;
  for (std::vector<float>* v : {&group_x_, &group_y_, &group_radius_}) {
    if (v->size() < group_count_ + kPadding) v->resize(group_count_ + kPadding);
  }
  for (std::size_t group = 0; group < group_count_; ++group) {
    const std::size_t first = group * kGroupSize;
    const std::size_t last = std::min(first + kGroupSize, size_);
    const auto middle = [&](const std::vector<float>& values) {
      float low = values[first];
      float high = values[first];
      for (std::size_t i = first + 1; i < last; ++i) {
        low = std::min(low, values[i]);
        high = std::max(high, values[i]);
      }
      return 0.5F * (low + high);
    };
    const float x = middle(x_);
    const float y = middle(y_);
    float radius = 0.0F;
    bool numbers = true;
    for (std::size_t i = first; i < last; ++i) {
      const float dx = x_[i] - x;
      const float dy = y_[i] - y;
      const float reach = std::sqrt(dx * dx + dy * dy) + radius_[i];
      radius = std::max(radius, reach);
      numbers = numbers && !std::isnan(reach);
    }
    group_x_[group] = x;
    group_y_[group] = y;
    group_radius_[group] = numbers ? radius : std::numeric_limits<float>::quiet_NaN();
  }
}

void DiscBuffer::grow() {
  const std::size_t size = 2 * x_.size() + kPadding;
  for (std::vector<float>* values : {&x_, &y_, &radius_}) values->resize(size);
}

namespace {

/// Tables that depend only on the geometry; copies of a kernel share them.
struct Tables {
  explicit Tables(const ScanGeometry& geometry)
      // A single beam has no neighbour, so any positive resolution will do.
      : resolution_rad(geometry.beam_count == 1 ? 1.0 : geometry.resolution_rad),
        reach(geometry.beam_count + detail::kBeamPadding) {
    const int count = geometry.beam_count;
    beams.reserve(2 * static_cast<std::size_t>(count + 2));
    for (int beam = -1; beam <= count; ++beam) {
      const auto [s, c] = math::sin_cos(geometry.angle_rad(beam));
      beams.push_back(c);
      beams.push_back(s);
    }
    for (int k = -reach; k <= reach; ++k) {
      const auto [s, c] = math::sin_cos(resolution_rad * static_cast<double>(k));
      cosines.push_back(static_cast<float>(c));
      sines.push_back(static_cast<float>(s));
    }
    const double half_fan_rad =
        std::min(0.5 * (count + 1) * resolution_rad + 1e-3, std::numbers::pi);
    fan_cos = static_cast<float>(math::cos(half_fan_rad));
    fan_sin = static_cast<float>(math::sin(half_fan_rad));
  }

  double resolution_rad;
  int reach;                   ///< the largest k in the tables of cos(k q) and sin(k q)
  std::vector<double> beams;   ///< (x, y) of the beams -1 to beam_count, in the sensor's frame
  std::vector<float> cosines;  ///< cos(k q) for k from -reach to reach
  std::vector<float> sines;    ///< sin(k q) for the same k
  float fan_cos = 0.0F;        ///< see detail::ScanJob
  float fan_sin = 0.0F;        ///< see detail::ScanJob
};

}  // namespace

/// Scratch memory, and the job whose pointers refer to it.
struct ScanKernel::Scratch {
  Scratch(const ScanGeometry& geometry, std::shared_ptr<const Tables> its_tables)
      : tables(std::move(its_tables)),
        inverse_ranges(static_cast<std::size_t>(geometry.beam_count + 2 * detail::kBeamPadding)) {
    const double beams_per_rad = 1.0 / tables->resolution_rad;
    const auto beam_count = static_cast<double>(geometry.beam_count);
    job.beam_count = geometry.beam_count;
    job.range_max_m = geometry.range_max_m;
    job.resolution_rad = tables->resolution_rad;
    job.beams = tables->beams.data() + 2;
    job.cos_table = tables->cosines.data() + tables->reach;
    job.sin_table = tables->sines.data() + tables->reach;
    job.beams_per_rad = static_cast<float>(beams_per_rad);
    job.beam_offset = static_cast<float>(0.5 * (beam_count - 1.0) + 1.0);
    // Error bound, with a relative rounding error of 6e-8 per operation: the rotation gives 2.5e-7
    // rad, the arctangent with its polynomial 8e-7 rad, the scaling 4e-7 rad; plus half as much for
    // safety. Adding the offset causes two roundings of values up to beam_count + 1.
    job.doubt_beams = static_cast<float>(2.2e-6 * beams_per_rad + 2.0e-7 * (beam_count + 2.0));
    job.fan_cos = tables->fan_cos;
    job.fan_sin = tables->fan_sin;
    job.behind_beams = static_cast<float>(0.5 * std::numbers::pi * beams_per_rad);

    // Blocks of beams are aligned, so that none crosses a cache line.
    constexpr std::size_t kAlignment = 32;
    void* aligned = inverse_ranges.data();
    std::size_t space = inverse_ranges.size() * sizeof(float);
    std::align(kAlignment, space - kAlignment, aligned, space);
    job.inverse_ranges = static_cast<float*>(aligned);

    minima.resize(places(static_cast<std::size_t>(geometry.beam_count / detail::kBlockBeams)));
    job.minima = minima.data();
    reserve_edges(1);
    reserve_discs(1);
  }

  // Writes the ranges by the last step of a scan, whose output belongs to the job.
  template <typename Range>
  void finish(std::span<Range> ranges_m, Range*& output,
              void (*last_step)(const detail::ScanJob&)) {
    SIM_ASSERT(ranges_m.size() == static_cast<std::size_t>(job.beam_count));
    if (inside) {
      std::fill(ranges_m.begin(), ranges_m.end(), Range(0));
      return;
    }
    output = ranges_m.data();
    last_step(job);
    for (const Circle& circle : circles) detail::scan_circle(job, circle, output);
  }

  void reserve_edges(std::size_t count) {
    if (count <= edge_capacity) return;
    edge_capacity = std::max(count, 2 * edge_capacity);
    const std::size_t step = places(edge_capacity);
    std::array integers{
        &job.candidate_edge, &job.candidate_first, &job.candidate_last, &job.narrow, &job.medium,
        &job.wide,           &job.first,           &job.last,           &job.anchor};
    std::array floats{&job.candidate_low, &job.candidate_high, &job.a, &job.b};
    share(edge_integers, integers, step);
    share(edge_floats, floats, step);
  }

  void reserve_discs(std::size_t count) {
    if (count <= disc_capacity) return;
    disc_capacity = std::max(count, 2 * disc_capacity);
    const std::size_t step = disc_places(disc_capacity);
    std::array integers{&job.disc_first, &job.disc_last, &job.group_first, &job.group_last,
                        &job.groups,     &job.some,      &job.near,        &job.visible};
    std::array floats{&job.disc_inverse, &job.group_inverse};
    share(disc_integers, integers, step);
    share(disc_floats, floats, step);
  }

  std::shared_ptr<const Tables> tables;
  detail::ScanJob job{};
  detail::Located located;      ///< located discs of the current scan
  bool inside = false;          ///< the current scan starts inside a solid
  std::vector<Circle> circles;  ///< of the current scan
  std::vector<float> inverse_ranges;
  std::vector<float> minima;
  std::vector<std::int32_t> edge_integers;
  std::vector<float> edge_floats;
  std::size_t edge_capacity = 0;
  std::vector<std::int32_t> disc_integers;
  std::vector<float> disc_floats;
  std::size_t disc_capacity = 0;

 private:
  /// Makes all of these pointers refer to arrays of `step` values in `memory`.
  template <typename T, std::size_t kCount>
  static void share(std::vector<T>& memory, const std::array<T**, kCount>& among,
                    std::size_t step) {
    memory.resize(kCount * step);
    for (std::size_t i = 0; i < kCount; ++i) *among[i] = memory.data() + i * step;
  }
};

ScanKernel::ScanKernel(const ScanGeometry& geometry)
    : ScanKernel(geometry, available(InstructionSet::kAvx2)   ? InstructionSet::kAvx2
                           : available(InstructionSet::kSse2) ? InstructionSet::kSse2
                                                              : InstructionSet::kScalar) {}

ScanKernel::ScanKernel(const ScanGeometry& geometry, InstructionSet instructions)
    : geometry_(geometry), instructions_(instructions), steps_(&steps_by(instructions)) {
  SIM_ASSERT(geometry.beam_count >= 1 && geometry.beam_count <= 1'000'000);
  SIM_ASSERT(geometry.beam_count == 1 || geometry.resolution_rad > 0.0);
  SIM_ASSERT(geometry.range_max_m > 0.0);
  scratch_ = std::make_unique<Scratch>(geometry, std::make_shared<const Tables>(geometry));
}

ScanKernel::ScanKernel(const ScanKernel& other)
    : geometry_(other.geometry_),
      instructions_(other.instructions_),
      steps_(other.steps_),
      scratch_(std::make_unique<Scratch>(other.geometry_, other.scratch_->tables)) {}

ScanKernel& ScanKernel::operator=(const ScanKernel& other) {
  ScanKernel copy(other);
  return *this = std::move(copy);
}

ScanKernel::ScanKernel(ScanKernel&&) noexcept = default;
ScanKernel& ScanKernel::operator=(ScanKernel&&) noexcept = default;
ScanKernel::~ScanKernel() = default;

bool ScanKernel::available(InstructionSet instructions) noexcept {
  switch (instructions) {
    case InstructionSet::kScalar:
      return true;
    case InstructionSet::kSse2:
#if defined(__x86_64__)
      return true;
#else
      return false;
#endif
    case InstructionSet::kAvx2:
#ifdef PLAYPEN_SCAN_AVX2
      return __builtin_cpu_supports("avx2") != 0;
#else
      return false;
#endif
  }
  return false;
}

void ScanKernel::scan(const EdgeBuffer& edges, double yaw_rad, std::span<double> ranges_m) {
  begin(yaw_rad);
  add(edges);
  finish(ranges_m);
}

void ScanKernel::begin(double yaw_rad) {
  const auto [sine, cosine] = math::sin_cos(yaw_rad);
  scratch_->job.cos_yaw = cosine;
  scratch_->job.sin_yaw = sine;
  scratch_->inside = false;
  scratch_->circles.clear();
  steps_->clear(scratch_->job);
}

void ScanKernel::add(const EdgeBuffer& edges) {
  Scratch& scratch = *scratch_;
  if (edges.inside) scratch.inside = true;
  if (scratch.inside) return;
  scratch.circles.insert(scratch.circles.end(), edges.circles().begin(), edges.circles().end());
  scratch.reserve_edges(edges.size());
  scratch.job.edges = edges.edges().data();
  scratch.job.edge_count = static_cast<std::int32_t>(edges.size());
  steps_->sweep(scratch.job);
}

void ScanKernel::locate(const DiscBuffer& discs, float x_m, float y_m) {
  Scratch& scratch = *scratch_;
  scratch.reserve_discs(discs.size());
  detail::ScanJob& job = scratch.job;
  job.disc_x = discs.x_m();
  job.disc_y = discs.y_m();
  job.disc_radius = discs.radius_m();
  job.disc_count = static_cast<std::int32_t>(discs.size());
  job.group_x = discs.group_x_m();
  job.group_y = discs.group_y_m();
  job.group_radius = discs.group_radius_m();
  job.group_count = static_cast<std::int32_t>(discs.group_count());
  job.sensor_x = x_m;
  job.sensor_y = y_m;
  scratch.located = steps_->locate(job);
}

std::span<const std::int32_t> ScanKernel::near() const {
  return {scratch_->job.near, static_cast<std::size_t>(scratch_->located.near)};
}

std::span<const std::int32_t> ScanKernel::visible() {
  const std::int32_t count = steps_->find_visible(scratch_->job, scratch_->located.groups);
  return {scratch_->job.visible, static_cast<std::size_t>(count)};
}

void ScanKernel::finish(std::span<double> ranges_m) {
  scratch_->finish(ranges_m, scratch_->job.ranges_m, steps_->finish);
}

void ScanKernel::finish(std::span<float> ranges_m) {
  scratch_->finish(ranges_m, scratch_->job.single_ranges_m, steps_->finish_single);
}

ScanKernel& ScanWorkspace::kernel_of(const ScanGeometry& geometry) {
  const auto it = std::find_if(kernels_.begin(), kernels_.end(),
                               [&](const ScanKernel& k) { return k.geometry() == geometry; });
  return it != kernels_.end() ? *it : kernels_.emplace_back(geometry);
}

}  // namespace sim::scan
