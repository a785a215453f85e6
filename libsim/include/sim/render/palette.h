// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/colour.h"

namespace sim::render {

/// The colours of pictures of scenes, except those of the robots.
namespace palette {
inline constexpr Colour kPaper{0xf1, 0xef, 0xea};        ///< around the arena
inline constexpr Colour kFloor{0xfc, 0xfb, 0xf8};        ///< of the arena
inline constexpr Colour kGrid{0xe6, 0xe3, 0xdb};         ///< lines on the floor
inline constexpr Colour kShadow{0x2b, 0x26, 0x20};       ///< of all that is solid
inline constexpr Colour kBorder{0x8c, 0x5e, 0x3c};       ///< around the floor, and beside docks
inline constexpr Colour kBorderEdge{0x66, 0x42, 0x28};   ///< their edges
inline constexpr Colour kStatic{0xcd, 0xd1, 0xd6};       ///< obstacles that are always there
inline constexpr Colour kStaticEdge{0x97, 0x9d, 0xa6};   ///< their edges
inline constexpr Colour kDynamic{0xd6, 0x45, 0x41};      ///< obstacles that can be retracted
inline constexpr Colour kDynamicEdge{0x9f, 0x2b, 0x2b};  ///< their edges
inline constexpr Colour kDriven{0x6d, 0x86, 0xb0};       ///< obstacles that move by themselves
inline constexpr Colour kCrate{0xdb, 0xb5, 0x7c};        ///< obstacles that can be pushed
inline constexpr Colour kWall{0x45, 0x4b, 0x54};         ///< walls of maps
inline constexpr Colour kWallEdge{0x2d, 0x31, 0x38};     ///< their edges
inline constexpr Colour kDock{0xd5, 0xea, 0xe4};         ///< areas of docks
inline constexpr Colour kDockInk{0x4f, 0x9a, 0x8b};      ///< signs on docks
inline constexpr Colour kInk{0x35, 0x38, 0x3d};          ///< texts and dark lines
inline constexpr Colour kFaintInk{0x7d, 0x7f, 0x82};     ///< less important texts and lines
inline constexpr Colour kHalo{0xff, 0xff, 0xff};   ///< rims that separate marks from what is below
inline constexpr Colour kWheel{0x2c, 0x2e, 0x33};  ///< wheels and other dark parts of robots
inline constexpr Colour kLight{0xff, 0xff, 0xff};  ///< noses and other light parts of robots
inline constexpr Colour kStalled{0xe0, 0x1e, 0x37};  ///< stalls, collisions, pressed bumpers
inline constexpr Colour kTrap{0x74, 0x42, 0xc8};     ///< traps of the arena controller
inline constexpr Colour kAlert{0xd9, 0x7a, 0x06};    ///< blocks that wait, and refusals
inline constexpr Colour kPassed{0x2b, 0x8f, 0x57};   ///< a passed run
inline constexpr Colour kFailed{0xc4, 0x27, 0x34};   ///< a failed run

/// A colour with its name, for pages that draw scenes themselves.
struct NamedColour {
  const char* name;  ///< the constant's name without the k: "borderEdge"
  Colour colour;
};

/// All colours above.
inline constexpr NamedColour kAll[] = {
    {"paper", kPaper},     {"floor", kFloor},
    {"grid", kGrid},       {"shadow", kShadow},
    {"border", kBorder},   {"borderEdge", kBorderEdge},
    {"static", kStatic},   {"staticEdge", kStaticEdge},
    {"dynamic", kDynamic}, {"dynamicEdge", kDynamicEdge},
    {"driven", kDriven},   {"crate", kCrate},
    {"wall", kWall},       {"wallEdge", kWallEdge},
    {"dock", kDock},       {"dockInk", kDockInk},
    {"ink", kInk},         {"faintInk", kFaintInk},
    {"halo", kHalo},       {"wheel", kWheel},
    {"light", kLight},     {"stalled", kStalled},
    {"trap", kTrap},       {"alert", kAlert},
    {"passed", kPassed},   {"failed", kFailed},
};

}  // namespace palette

}  // namespace sim::render
