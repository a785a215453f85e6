// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The debug information of the classes that client programs use, and of nothing else.
//
// A compiler describes a class with virtual functions only where the class's virtual table lies: in
// this library, which has no debug information. So a debugger would know LaserProxy in a program as
// an "incomplete type" and could not call its getters. This source is compiled with complete debug
// information in every build (libplayerlike/CMakeLists.txt).
#include "core/debug_types.h"

#include "libCCMorse/CCMorse.h"

namespace playerlike {
namespace {

// Getters of the headers that are inline: a debugger can call only functions that exist.
using LaserProxy = PlayerCc::LaserProxy;
using Position = PlayerCc::Position2dProxy;
[[gnu::used]] constexpr double (LaserProxy::*kLaserGetters[])(uint32_t) const = {
    &LaserProxy::GetRange, &LaserProxy::operator[], &LaserProxy::GetBearing};
[[gnu::used]] constexpr auto kLaserCount = &LaserProxy::GetCount;
[[gnu::used]] constexpr double (Position::*kPositionGetters[])() const = {
    &Position::GetXPos,   &Position::GetYPos,   &Position::GetYaw,
    &Position::GetXSpeed, &Position::GetYSpeed, &Position::GetYawSpeed};
[[gnu::used]] constexpr auto kStall = &Position::GetStall;
[[gnu::used]] constexpr auto kRangerGetter = &PlayerCc::RangerProxy::GetRange;
[[gnu::used]] constexpr auto kMorseGetter = &CCMorse::MorseLaser::GetRange;

}  // namespace

void keep_debug_types() noexcept {}

}  // namespace playerlike
