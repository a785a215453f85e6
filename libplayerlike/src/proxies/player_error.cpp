// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/playererror.h"

namespace PlayerCc {

PlayerError::PlayerError(const std::string aFun, const std::string aStr, const int aCode)
    : mFun(aFun), mStr(aStr), mWhat(aFun.empty() ? aStr : aFun + ": " + aStr), mCode(aCode) {}

// Out of line, so that the class has its type information in one place only.
PlayerError::~PlayerError() = default;

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::PlayerError& e) {
  return os << e.what() << " (error " << e.GetErrorCode() << ')';
}

}  // namespace std
