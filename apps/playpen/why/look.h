// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "why/story.h"

namespace playpen::why {

/// What a scan says of a place.
struct Look {
  bool in_view = false;      ///< a beam or transducer looks there
  bool shown = false;        ///< its range is that of the place
  std::size_t beam = 0;      ///< or transducer: the one that shows it, or looks there
  double range_m = 0.0;      ///< of that one
  double bearing_rad = 0.0;  ///< of the place from the laser's axis; of a transducer its direction
};

/// What a scan of a story says of a place in W.
///
/// A beam of a laser shows the place if its range, or that of a beam beside it, is the place's
/// distance within 8 cm. A cone shows a place in it if the echo came from the nearest point of
/// Story::surface in the cone, within 8 cm, and not from behind the place. A ray of a transducer
/// shows it if it ends on the surface within 15 cm of the place. If the surface is not known,
/// the range must be the distance of the place within 15 cm.
[[nodiscard]] Look look_at(const Story& story, const Scan& scan, const sim::Vec2& place);

/// Since when scans have shown the place of a contact.
struct SightOfContact {
  bool in_view = false;                ///< of the last scan
  std::optional<Scan> since;           ///< first scan that showed it without an interruption
  std::optional<double> last_shown_s;  ///< time of the last scan that showed it
  Look first;                          ///< in `since`
};

/// Since when a story's scans before a time have shown a place. At most two scans without it in
/// succession are no interruption. Near a robot a place is mostly between the cones of its
/// transducers, so those may have shown it last up to 2 s before.
[[nodiscard]] SightOfContact sight_before(const Story& story, const sim::Vec2& place,
                                          double time_s);

/// A sight in words: "Beam 365 of its laser (10 degrees to the left) had shown it for 4.1 s, at
/// first 1.62 m away."
/// @param place  in B at the time of the contact.
[[nodiscard]] std::string sight_sentence(const Story& story, const SightOfContact& sight,
                                         const sim::Vec2& place, double time_s);

}  // namespace playpen::why
