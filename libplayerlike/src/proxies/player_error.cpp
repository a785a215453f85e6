// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/playererror.h"
#include "sim/core/utf8.h"

namespace PlayerCc {

PlayerError::PlayerError(const std::string aFun, const std::string aStr, const int aCode)
    : mFun(aFun), mStr(sim::escape_invalid_utf8(aStr)), mCode(aCode) {}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::PlayerError& e) {
  if (!e.GetErrorFun().empty()) os << e.GetErrorFun() << ": ";
  return os << e.GetErrorStr() << " (error " << e.GetErrorCode() << ')';
}

}  // namespace std
