// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sim::scan {

/// One straight piece of an outline, from (x0, y0) to (x1, y1), with the solid on its left, so its
/// outer face is on its right; a sensor on the left of it, or in line with it, does not see it.
/// Coordinates are relative to the sensor's position, but W-aligned (not turned) [m].
///
/// Outlines are closed for beams where two edges hold the same bits for the corner they share.
struct alignas(16) Edge {
  float x0_m;
  float y0_m;
  float x1_m;
  float y1_m;
};

/// The edges that a scan may meet. Filled by physics, read by ScanKernel, reused from scan to
/// scan: clear() keeps the memory, so that none is taken in steady state.
class EdgeBuffer {
 public:
  bool inside = false;  ///< the sensor's origin lies inside a solid: every beam reads 0

  /// Forgets all edges and `inside`; keeps the memory.
  void clear() noexcept {
    size_ = 0;
    inside = false;
  }

  /// Adds one edge; see Edge for the meaning.
  void add(float x0_m, float y0_m, float x1_m, float y1_m) {
    *append(1) = Edge{x0_m, y0_m, x1_m, y1_m};
  }

  /// Adds `count` edges at once and returns where to write them: the caller must write all of
  /// them. The pointer holds until the next append(), add() or destruction. To add at most
  /// `count` edges, append that many, write some and give the rest back with truncate().
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

  /// Edges after the last that may be read, though they mean nothing: the kernel reads in groups.
  static constexpr std::size_t kPadding = 8;

 private:
  void grow();

  std::vector<Edge> storage_ = std::vector<Edge>(kPadding);  ///< at least size_ + kPadding
  std::size_t size_ = 0;
};

/// Discs that hold solids, a robot each for instance: what a scan asks about before it takes their
/// edges. clear() keeps the memory.
class DiscBuffer {
 public:
  /// Forgets all discs; keeps the memory.
  void clear() noexcept { size_ = group_count_ = 0; }
  /// Adds a disc round (x, y), in W [m].
  void add(float x_m, float y_m, float radius_m) {
    if (size_ + kPadding >= x_.size()) grow();
    x_[size_] = x_m;
    y_[size_] = y_m;
    radius_[size_] = radius_m;
    ++size_;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Lets a scan pass over many discs at once: finds a circle round the first kGroupSize of them,
  /// round the next, and so on. Call it after the last add(); worth it where discs that follow one
  /// another are near each other.
  void group();
  static constexpr std::int32_t kGroupSize = 8;
  /// How many groups there are; 0 if group() has not been called since clear().
  [[nodiscard]] std::size_t group_count() const noexcept { return group_count_; }

  /// Coordinates and radii, an array each; kPadding more may be read, though they mean nothing [m].
  [[nodiscard]] const float* x_m() const noexcept { return x_.data(); }
  [[nodiscard]] const float* y_m() const noexcept { return y_.data(); }
  [[nodiscard]] const float* radius_m() const noexcept { return radius_.data(); }
  /// The same of the groups' circles.
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

/// Directions of a scanner's beams: `beam_count` of them, `resolution_rad` apart, symmetric
/// about forward; beam 0 is the rightmost (least angle).
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

/// Instructions that a kernel may use. All give the same bits.
enum class InstructionSet {
  kScalar,  ///< plain C++, on every processor
  kSse2,    ///< every x86-64 processor
  kAvx2,    ///< x86-64 processors since about 2013
};

/// Least distance to any edge, for every beam of a scanner at once.
///
/// Edges that face the sensor are swept into the interval of beams they span; each beam keeps
/// the nearest. Work grows with edges + beams covered, not with their product.
///
/// Result: range in [0, range_max]; range_max where nothing is met. Against exact geometry the
/// error is below 1e-6 of the range. Which beams an edge spans, its ends included, is decided to
/// the last bits of double precision, so nothing is seen through the joint of two edges that share
/// a corner. The same bits on every x86-64 processor: the wider instruction paths, chosen at run
/// time, do the same operations in the same order.
/// Not thread-safe (scratch memory); one kernel a sensor. A copy shares the tables of its beams
/// with the original: equal sensors should be copies of one kernel, to leave more of the cache.
class ScanKernel {
 public:
  /// Uses the widest instructions that this processor has.
  /// @param geometry  valid as ScanGeometry says.
  explicit ScanKernel(const ScanGeometry& geometry);

  /// @param instructions  the instructions to use; they must be available().
  ScanKernel(const ScanGeometry& geometry, InstructionSet instructions);

  ScanKernel(const ScanKernel& other);
  ScanKernel& operator=(const ScanKernel& other);
  ScanKernel(ScanKernel&& other) noexcept;
  ScanKernel& operator=(ScanKernel&& other) noexcept;
  ~ScanKernel();

  /// Whether this processor and this build of the library have the instructions.
  [[nodiscard]] static bool available(InstructionSet instructions) noexcept;

  /// @param edges    edges near the sensor, relative to its position, W-aligned [m].
  /// @param yaw_rad  the sensor's heading in W [rad].
  /// @param ranges_m beam_count values out, beam 0 the rightmost [m].
  void scan(const EdgeBuffer& edges, double yaw_rad, std::span<double> ranges_m);

  /// The same in parts: begin(), add() for some edges after the other, finish(). So what is nearest
  /// may come first, and what visible() then does not list need not be added at all: the
  /// ranges are the same to the last bit.
  /// @param yaw_rad  as for scan().
  void begin(double yaw_rad);
  /// Adds edges to the scan that was begun. If the sensor is inside a solid, so says `edges`.
  void add(const EdgeBuffer& edges);

  /// Discs whose middles are nearer than this are better added at once than asked about [m].
  static constexpr float kNear_m = 2.0F;
  /// Finds where discs stand, as seen by the scan that was begun. (x, y) is the sensor's place in
  /// W [m]; errors of single precision are allowed for. The discs must not change before the last
  /// visible().
  void locate(const DiscBuffer& discs, float x_m, float y_m);
  /// Indices of the near ones of which a part may be in view. Errs on the side of listing. Holds
  /// until the next locate().
  [[nodiscard]] std::span<const std::int32_t> near() const;
  /// Indices of those that are not near, but that some beam may meet before any edge that was
  /// added; the others are hidden. Errs on the side of listing. Holds until the next call.
  [[nodiscard]] std::span<const std::int32_t> visible();
  /// @param ranges_m  as for scan().
  void finish(std::span<double> ranges_m);

  [[nodiscard]] const ScanGeometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] InstructionSet instructions() const noexcept { return instructions_; }

 private:
  struct Scratch;

  ScanGeometry geometry_;
  InstructionSet instructions_;
  const detail::ScanSteps* steps_;  ///< by these instructions
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace sim::scan
