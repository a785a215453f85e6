// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause

// Compiled with AVX2 if the processor family supports it. See scan_kernel_impl.h for the
// restrictions on this file.

#include "scan/scan_kernel_impl.h"

#ifdef PLAYPEN_SCAN_AVX2

#include <immintrin.h>

namespace sim::scan::detail {
namespace {

/// A vector of eight lanes; doubles are two halves of four lanes.
struct Avx2 {
  static constexpr int kLanes = 8;
  static constexpr int kHalves = 2;
  using Float = __m256;
  using Mask = __m256;
  using Double = __m256d;
  using DoubleMask = __m256d;

  static Float broadcast(float value) { return _mm256_set1_ps(value); }
  static Double broadcast(double value) { return _mm256_set1_pd(value); }
  static Float load(const float* from) { return _mm256_loadu_ps(from); }
  static Float load_aligned(const float* from) { return _mm256_load_ps(from); }
  static void store(float* to, Float value) { _mm256_storeu_ps(to, value); }
  static void store_integers(std::int32_t* to, Float value) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(value));
  }
  static void choose_integers(std::int32_t* to, Mask mask, const std::int32_t* yes,
                              const std::int32_t* no) {
    const Float chosen = select(mask, _mm256_loadu_ps(reinterpret_cast<const float*>(yes)),
                                _mm256_loadu_ps(reinterpret_cast<const float*>(no)));
    _mm256_storeu_ps(reinterpret_cast<float*>(to), chosen);
  }
  static void store_ranges(double* to, Float value, double greatest) {
    const Double limit = broadcast(greatest);
    _mm256_storeu_pd(to, _mm256_min_pd(widen(value, 0), limit));
    _mm256_storeu_pd(to + 4, _mm256_min_pd(widen(value, 1), limit));
  }
  static void store_ranges(float* to, Float value, float greatest) {
    _mm256_storeu_ps(to, _mm256_min_ps(value, broadcast(greatest)));
  }

  static Float abs(Float value) { return _mm256_andnot_ps(broadcast(-0.0F), value); }
  static Float copy_sign(Float magnitude, Float sign) {
    return _mm256_or_ps(magnitude, _mm256_and_ps(broadcast(-0.0F), sign));
  }
  static Float min(Float a, Float b) { return _mm256_min_ps(a, b); }
  static Float max(Float a, Float b) { return _mm256_max_ps(a, b); }
  static Float sqrt(Float value) { return _mm256_sqrt_ps(value); }
  static Float minima(const float* from) {
    const Float r04 = least_quarters(from, from + 32);
    const Float r15 = least_quarters(from + 8, from + 40);
    const Float r26 = least_quarters(from + 16, from + 48);
    const Float r37 = least_quarters(from + 24, from + 56);
    const Float r0145 = min(_mm256_unpacklo_ps(r04, r15), _mm256_unpackhi_ps(r04, r15));
    const Float r2367 = min(_mm256_unpacklo_ps(r26, r37), _mm256_unpackhi_ps(r26, r37));
    return min(_mm256_shuffle_ps(r0145, r2367, 0x44), _mm256_shuffle_ps(r0145, r2367, 0xEE));
  }
  static Float truncate(Float value) { return _mm256_cvtepi32_ps(_mm256_cvttps_epi32(value)); }

  static Mask less(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  static DoubleMask less(Double a, Double b) { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
  static DoubleMask less_equal(Double a, Double b) { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
  static unsigned bits(Mask mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask)); }
  static Float select(Mask mask, Float yes, Float no) { return _mm256_blendv_ps(no, yes, mask); }
  static Double select(DoubleMask mask, Double yes, Double no) {
    return _mm256_blendv_pd(no, yes, mask);
  }
  static Float drop(Mask mask, Float value) { return _mm256_andnot_ps(mask, value); }
  /// Lanes [first, last] as a window: the offset of a lane from `first` is compared with `last` -
  /// `first`. Both are less than 2^31, so one comparison excludes lanes before and after.
  struct Window {
    __m256i beyond_first;
    __m256i length;
  };
  static Window make_window(std::int32_t first, std::int32_t last) {
    const __m256i lane =
        _mm256_setr_epi32(INT32_MIN, INT32_MIN + 1, INT32_MIN + 2, INT32_MIN + 3, INT32_MIN + 4,
                          INT32_MIN + 5, INT32_MIN + 6, INT32_MIN + 7);
    return {_mm256_sub_epi32(lane, _mm256_set1_epi32(first)),
            _mm256_set1_epi32(INT32_MIN + (last - first))};
  }
  static Mask outside(const Window& window, std::int32_t offset) {
    const __m256i lane = _mm256_add_epi32(window.beyond_first, _mm256_set1_epi32(offset));
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(lane, window.length));
  }

  static Double widen(Float value, int half) {
    return _mm256_cvtps_pd(half == 0 ? _mm256_castps256_ps128(value)
                                     : _mm256_extractf128_ps(value, 1));
  }
  static Float narrow(const Double (&halves)[kHalves]) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(halves[0])),
                                _mm256_cvtpd_ps(halves[1]), 1);
  }
  static Mask narrow_mask(const DoubleMask (&halves)[kHalves]) {
    const __m256 mixed =
        _mm256_shuffle_ps(_mm256_castpd_ps(halves[0]), _mm256_castpd_ps(halves[1]), 0x88);
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(mixed), 0xD8));
  }

  static void load_edges(const Edge* edges, Float& x0, Float& y0, Float& x1, Float& y1) {
    transpose(edges, edges + 1, edges + 2, edges + 3, edges + 4, edges + 5, edges + 6, edges + 7,
              x0, y0, x1, y1);
  }
  static void gather_edges(const Edge* edges, const std::int32_t* index, Float& x0, Float& y0,
                           Float& x1, Float& y1) {
    transpose(edges + index[0], edges + index[1], edges + index[2], edges + index[3],
              edges + index[4], edges + index[5], edges + index[6], edges + index[7], x0, y0, x1,
              y1);
  }
  static void gather_beams(const double* beams, const std::int32_t* index, Double& x, Double& y) {
    const Double even = pair(beams + 2 * index[0], beams + 2 * index[2]);
    const Double odd = pair(beams + 2 * index[1], beams + 2 * index[3]);
    x = _mm256_unpacklo_pd(even, odd);
    y = _mm256_unpackhi_pd(even, odd);
  }

 private:
  /// For two blocks of eight values, one in each half: minimum of the values four places apart.
  static Float least_quarters(const float* low, const float* high) {
    const Float a = _mm256_load_ps(low);
    const Float b = _mm256_load_ps(high);
    return min(_mm256_permute2f128_ps(a, b, 0x20), _mm256_permute2f128_ps(a, b, 0x31));
  }
  static Double pair(const double* low, const double* high) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
  }
  static Float pair(const Edge* low, const Edge* high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&low->x0_m)),
                                _mm_load_ps(&high->x0_m), 1);
  }
  static void transpose(const Edge* e0, const Edge* e1, const Edge* e2, const Edge* e3,
                        const Edge* e4, const Edge* e5, const Edge* e6, const Edge* e7, Float& x0,
                        Float& y0, Float& x1, Float& y1) {
    const Float r0 = pair(e0, e4);
    const Float r1 = pair(e1, e5);
    const Float r2 = pair(e2, e6);
    const Float r3 = pair(e3, e7);
    const Float start01 = _mm256_unpacklo_ps(r0, r1);
    const Float start23 = _mm256_unpacklo_ps(r2, r3);
    const Float stop01 = _mm256_unpackhi_ps(r0, r1);
    const Float stop23 = _mm256_unpackhi_ps(r2, r3);
    x0 = _mm256_shuffle_ps(start01, start23, 0x44);
    y0 = _mm256_shuffle_ps(start01, start23, 0xEE);
    x1 = _mm256_shuffle_ps(stop01, stop23, 0x44);
    y1 = _mm256_shuffle_ps(stop01, stop23, 0xEE);
  }
};

}  // namespace

const ScanSteps& avx2_steps() { return kSteps<Avx2>; }

}  // namespace sim::scan::detail

#endif  // PLAYPEN_SCAN_AVX2
