// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"
#include "sim/world/description.h"

namespace sim {

/// One segment of a bumper: a straight piece, or an arc that bulges outwards.
///
/// Its frame S lies in the middle of the segment: x points outwards, away from the robot, and the
/// segment runs along y. Described as player_bumper_define_t of Player describes it.
struct BumperSegment {
  Pose X_BS;              ///< on the body [m, rad]
  double length_m = 0.1;  ///< along the segment, > 0 [m]
  double radius_m = 0.0;  ///< of the arc, whose centre lies on S's negative x axis; 0: straight [m]

  friend bool operator==(const BumperSegment&, const BumperSegment&) = default;
};

/// Settings of a bumper.
struct BumperParams {
  double frequency_hz = 10.0;           ///< (0, 1000]
  double reach_m = 0.05;                ///< a touch farther from all segments presses none, > 0 [m]
  std::vector<BumperSegment> segments;  ///< at most 64; none: one for each side of the footprint

  /// The most segments that a bumper may have.
  static constexpr int kMaxSegments = 64;
};

/// Which segments were pressed since the reading before, this moment included.
struct BumperReading final : Reading {
  std::vector<std::uint8_t> pressed;  ///< one a segment: 1 if it was, else 0
};

/// A straight segment for each side of a footprint, counter-clockwise, the first one being that
/// from the first corner to the second.
[[nodiscard]] std::vector<BumperSegment> segments_round(const Polygon& footprint);

/// The segment as a line of points, its right end first, in the body's frame [m]; of an arc one
/// every 5 degrees or closer.
[[nodiscard]] std::vector<Vec2> line_of(const BumperSegment& segment);

/// Distance of a point to the nearest point of a segment [m].
/// @param p_B  in the body's frame [m].
[[nodiscard]] double distance_to_segment_m(const BumperSegment& segment, const Vec2& p_B);

/// Which segments a touch presses: from each point of it the segment nearest to it, if that is not
/// farther than `reach_m`, and each that is at most 1 mm farther than that one, so that a touch at
/// the joint of two presses both. The touch is looked at every 5 mm and at its ends.
/// @param p_BA, p_BC  ends of the touch, in the body's frame [m]; equal for one at a point.
/// @param pressed       one a segment; set to 1 where the touch presses, else left alone.
void press_segments(const std::vector<BumperSegment>& segments, double reach_m, const Vec2& p_BA,
                    const Vec2& p_BC, std::vector<std::uint8_t>& pressed);

/// Segments round the footprint that feel what touches it. They are looked at in each step, so
/// that a touch which begins and ends between two readings is told in the second. Touching is what
/// the physics calls so: outlines closer than 2 mm. A flat side that lies on a flat wall touches it
/// all along the part that both share.
class Bumper final : public SensorOf<BumperReading> {
 public:
  /// @param footprint  of the robot's model: where the segments are, if params has none.
  Bumper(std::string name, const BumperParams& params, const Polygon& footprint);

  void integrate(const StepContext& context) override;
  [[nodiscard]] const std::vector<BumperSegment>& segments() const noexcept {
    return params_.segments;
  }
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  BumperParams params_;
  std::vector<std::uint8_t> pressed_;  ///< since the last reading
};

}  // namespace sim
