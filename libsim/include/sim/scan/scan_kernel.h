// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/scan/circle.h"

namespace sim::scan {

/// One straight piece of an outline, from (x0, y0) to (x1, y1), with the solid on its left. Its
/// outer face is on its right; a sensor on its left, or in line with it, does not see it.
/// Coordinates are relative to the sensor's position, with the axes of W (not rotated) [m].
///
/// No beam passes between two edges whose shared corner has identical bits in both.
struct alignas(16) Edge {
  float x0_m;
  float y0_m;
  float x1_m;
  float y1_m;
};

/// The edges and circles that a scan may meet. Physics fills it and ScanKernel reads it. It is
/// reused from scan to scan: clear() keeps the memory, so nothing is allocated in steady state.
class EdgeBuffer {
 public:
  bool inside = false;  ///< the sensor's origin is inside a solid, so every beam reads 0

  /// Forgets all edges and circles and `inside`; keeps the memory.
  void clear() noexcept {
    size_ = 0;
    circles_.clear();
    inside = false;
  }

  /// Adds one edge.
  void add(float x0_m, float y0_m, float x1_m, float y1_m) {
    *append(1) = Edge{x0_m, y0_m, x1_m, y1_m};
  }

  /// Adds one circle.
  void add(const Circle& circle) { circles_.push_back(circle); }

  /// Adds `count` edges at once and returns a pointer for the caller to write all of them. The
  /// pointer is valid until the next append(), add() or destruction. To add at most `count` edges,
  /// append that many, write some and remove the rest with truncate().
  [[nodiscard]] Edge* append(std::size_t count) {
    const std::size_t begin = size_;
    size_ += count;
    if (size_ + kPadding > storage_.size()) grow();
    return storage_.data() + begin;
  }

  /// Keeps the first `size` edges. @param size  at most size().
  void truncate(std::size_t size) noexcept { size_ = size < size_ ? size : size_; }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::span<const Edge> edges() const noexcept { return {storage_.data(), size_}; }
  [[nodiscard]] std::span<const Circle> circles() const noexcept { return circles_; }

  /// Number of readable but meaningless edges after the last one, since the kernel reads in groups.
  static constexpr std::size_t kPadding = 8;

 private:
  void grow();

  std::vector<Edge> storage_ = std::vector<Edge>(kPadding);  ///< at least size_ + kPadding
  std::size_t size_ = 0;
  std::vector<Circle> circles_;
};

/// Discs that enclose solids, e.g. one per robot. A scan tests them before it gathers the edges of
/// the solids. clear() keeps the memory.
class DiscBuffer {
 public:
  /// Forgets all discs; keeps the memory.
  void clear() noexcept { size_ = group_count_ = 0; }
  /// Adds a disc around (x, y), in W [m].
  void add(float x_m, float y_m, float radius_m) {
    if (size_ + kPadding >= x_.size()) grow();
    x_[size_] = x_m;
    y_[size_] = y_m;
    radius_[size_] = radius_m;
    ++size_;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Enables a scan to skip several discs at once: computes a circle around each group of
  /// kGroupSize consecutive discs. Call it after the last add(). It pays off if consecutive discs
  /// are near each other.
  void group();
  static constexpr std::int32_t kGroupSize = 8;
  /// Number of groups; 0 if group() has not been called since clear().
  [[nodiscard]] std::size_t group_count() const noexcept { return group_count_; }

  /// Coordinates and radii, one array each [m]; kPadding further elements are readable but
  /// meaningless.
  [[nodiscard]] const float* x_m() const noexcept { return x_.data(); }
  [[nodiscard]] const float* y_m() const noexcept { return y_.data(); }
  [[nodiscard]] const float* radius_m() const noexcept { return radius_.data(); }
  /// Coordinates and radii of the groups' circles [m].
  [[nodiscard]] const float* group_x_m() const noexcept { return group_x_.data(); }
  [[nodiscard]] const float* group_y_m() const noexcept { return group_y_.data(); }
  [[nodiscard]] const float* group_radius_m() const noexcept { return group_radius_.data(); }
  static constexpr std::size_t kPadding = 8;

 private:
  void grow();

  std::vector<float> x_ = std::vector<float>(kPadding);
  std::vector<float> y_ = std::vector<float>(kPadding);
  std::vector<float> radius_ = std::vector<float>(kPadding);
  std::size_t size_ = 0;
  std::vector<float> group_x_ = std::vector<float>(kPadding);
  std::vector<float> group_y_ = std::vector<float>(kPadding);
  std::vector<float> group_radius_ = std::vector<float>(kPadding);
  std::size_t group_count_ = 0;
};

namespace detail {
struct ScanSteps;
}  // namespace detail

/// Directions of a scanner's beams: `beam_count` beams, `resolution_rad` apart, symmetric about the
/// forward direction. Beam 0 is the rightmost (least angle).
struct ScanGeometry {
  int beam_count = 682;         ///< 1 to 1 000 000
  double resolution_rad = 0.0;  ///< > 0; (beam_count - 1) * resolution <= 2 pi
  double range_max_m = 5.0;     ///< > 0

  friend bool operator==(const ScanGeometry&, const ScanGeometry&) = default;

  [[nodiscard]] double angle_min_rad() const {
    return -0.5 * resolution_rad * static_cast<double>(beam_count - 1);
  }
  /// Angle of a beam from the sensor's x axis, counter-clockwise [rad].
  [[nodiscard]] double angle_rad(int beam) const {
    return angle_min_rad() + resolution_rad * static_cast<double>(beam);
  }
};

/// Instruction set of a kernel. All give bit-identical results.
enum class InstructionSet {
  kScalar,  ///< plain C++, for every processor
  kSse2,    ///< for every x86-64 processor
  kAvx2,    ///< for x86-64 processors since about 2013
};

/// Computes the least distance to any edge for every beam of a scanner at once.
///
/// Each edge that faces the sensor is mapped to the interval of beams that it spans; each beam
/// keeps the nearest edge. The cost grows with the number of edges plus the number of beams that
/// they cover, not with the product of edges and beams.
///
/// A range is in [0, range_max], and range_max where nothing is met. Its error against exact
/// geometry is below 1e-6 of the range; the range of a circle is exact except for rounding in
/// double precision. Which beams an edge spans, including its ends, is decided to the last bits of
/// double precision, so no beam passes through the joint of two edges that share a corner. The
/// results are bit-identical on every x86-64 processor: the wider instruction paths, chosen at run
/// time, do the same operations in the same order. Not thread-safe (scratch memory); use one kernel
/// per sensor. A copy shares the beam tables with the original: sensors of equal geometry should
/// use copies of one kernel, which leaves more of the cache free.
class ScanKernel {
 public:
  /// Uses the widest instruction set of this processor.
  /// @param geometry  within the limits of ScanGeometry.
  explicit ScanKernel(const ScanGeometry& geometry);

  /// @param instructions  must be available().
  ScanKernel(const ScanGeometry& geometry, InstructionSet instructions);

  ScanKernel(const ScanKernel& other);
  ScanKernel& operator=(const ScanKernel& other);
  ScanKernel(ScanKernel&& other) noexcept;
  ScanKernel& operator=(ScanKernel&& other) noexcept;
  ~ScanKernel();

  /// Whether this processor and this build of the library support the instruction set.
  [[nodiscard]] static bool available(InstructionSet instructions) noexcept;

  /// Computes the ranges of all beams.
  /// @param edges    edges near the sensor, relative to its position, with the axes of W [m].
  /// @param yaw_rad  the sensor's heading in W [rad].
  /// @param ranges_m receives beam_count values, beam 0 the rightmost [m].
  void scan(const EdgeBuffer& edges, double yaw_rad, std::span<double> ranges_m);

  /// Starts a scan in parts: begin(), any number of add(), finish(). The caller can add near edges
  /// first and then skip the edges of discs that visible() does not list; the ranges are
  /// bit-identical to those of scan().
  /// @param yaw_rad  as for scan().
  void begin(double yaw_rad);
  /// Adds edges to the current scan. `edges.inside` says whether the sensor is inside a solid.
  void add(const EdgeBuffer& edges);

  /// Discs whose centres are nearer than this should be added without a visibility test [m].
  static constexpr float kNear_m = 2.0F;
  /// Locates discs relative to the current scan. (x, y) is the sensor's position in W [m]; the
  /// method allows for single-precision errors. The discs must not change before the last
  /// visible().
  void locate(const DiscBuffer& discs, float x_m, float y_m);
  /// Indices of the near discs that may be partly in view. Conservative: may list too many. Valid
  /// until the next locate().
  [[nodiscard]] std::span<const std::int32_t> near() const;
  /// Indices of the discs that are not near and that some beam may meet before any added edge; all
  /// other distant discs are hidden. Conservative: may list too many. Valid until the next call.
  [[nodiscard]] std::span<const std::int32_t> visible();
  /// Ends the current scan.
  /// @param ranges_m  as for scan().
  void finish(std::span<double> ranges_m);
  /// The same with ranges that are rounded to single precision.
  void finish(std::span<float> ranges_m);

  [[nodiscard]] const ScanGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] InstructionSet instructions() const noexcept { return instructions_; }

 private:
  struct Scratch;

  ScanGeometry geometry_;
  InstructionSet instructions_;
  const detail::ScanSteps* steps_;  ///< implementation for `instructions_`
  std::unique_ptr<Scratch> scratch_;
};

/// Kernels and memory that scans reuse. Sensors of several simulations may share one, scan after
/// scan: its tables then stay in the cache. Not thread-safe; each thread needs its own.
class ScanWorkspace {
 public:
  /// The kernel of this geometry. It is made at the first call, with its tables.
  /// @param geometry  within the limits of ScanGeometry.
  [[nodiscard]] ScanKernel& kernel_of(const ScanGeometry& geometry);
  /// A buffer with any contents.
  [[nodiscard]] EdgeBuffer& edges() noexcept { return edges_; }

 private:
  std::vector<ScanKernel> kernels_;
  EdgeBuffer edges_;
};

}  // namespace sim::scan
