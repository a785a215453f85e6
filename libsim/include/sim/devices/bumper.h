// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"
#include "sim/world/description.h"

namespace sim {

/// One segment of a bumper: a straight line, or an arc that bulges outwards.
///
/// The origin of its frame S is the middle of the segment. x points outwards, away from the robot,
/// and the segment runs along y. This is the convention of Player's player_bumper_define_t.
struct BumperSegment {
  Pose X_BS;              ///< mounting on the body [m, rad]
  double length_m = 0.1;  ///< along the segment [m]
  double radius_m = 0.0;  ///< of the arc, whose centre is on S's negative x axis; 0: straight [m]

  friend bool operator==(const BumperSegment&, const BumperSegment&) = default;
};

/// Settings of a bumper.
struct BumperParams {
  double frequency_hz = 10.0;           ///< [Hz]
  double reach_m = 0.05;                ///< a touch farther than this from all segments presses
                                        ///< none [m]
  std::vector<BumperSegment> segments;  ///< at most 64; empty: one per side of the footprint

  /// Maximum number of segments of a bumper.
  static constexpr int kMaxSegments = 64;
};

/// Which segments were pressed since the previous reading, including the current moment.
struct BumperReading final : Reading {
  std::vector<std::uint8_t> pressed;  ///< one per segment: 1 if it was pressed, else 0
};

/// One straight segment per side of a footprint, counter-clockwise. The first one goes from the
/// first corner to the second.
[[nodiscard]] std::vector<BumperSegment> segments_round(const Polygon& footprint);

/// The segment as a polyline in the body's frame, beginning at its right end [m]. Points of an arc
/// are at most 5 degrees apart.
[[nodiscard]] std::vector<Vec2> line_of(const BumperSegment& segment);

/// Distance of a point to the nearest point of a segment [m].
/// @param p_B  in the body's frame [m].
[[nodiscard]] double distance_to_segment_m(const BumperSegment& segment, const Vec2& p_B);

/// Marks the segments that a touch presses. Each point of the touch presses the nearest segment if
/// it is within `reach_m`, and all segments that are at most 1 mm farther, so that a touch at the
/// joint of two segments presses both. The touch is sampled every 5 mm and at its ends.
/// @param p_BA, p_BC  ends of the touch, in the body's frame [m]; equal for a single point.
/// @param pressed     one per segment; set to 1 where the touch presses, otherwise unchanged.
void press_segments(const std::vector<BumperSegment>& segments, double reach_m, const Vec2& p_BA,
                    const Vec2& p_BC, std::vector<std::uint8_t>& pressed);

/// Bumper segments around the footprint. They are checked in each step, so the second of two
/// readings also reports a touch that begins and ends between them. As in the physics, touching
/// means that the outlines are closer than 2 mm. A flat side against a flat wall touches it along
/// their whole common part.
class Bumper final : public SensorOf<BumperReading> {
 public:
  /// @param footprint  of the robot's model; defines the segments if params has none.
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
