// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <type_traits>

#include "libCCMorse/MorseError.h"
#include "libplayerc++/playererror.h"

namespace {

using PlayerCc::PlayerError;

TEST(PlayerError, FunctionTextAndCode_Kept) {
  const PlayerError error("f", "went wrong", 7);
  EXPECT_EQ(error.GetErrorFun(), "f");
  EXPECT_EQ(error.GetErrorStr(), "went wrong");
  EXPECT_EQ(error.GetErrorCode(), 7);
}

TEST(PlayerError, Default_Empty) {
  const PlayerError error;
  EXPECT_EQ(error.GetErrorFun(), "");
  EXPECT_EQ(error.GetErrorStr(), "");
  EXPECT_EQ(error.GetErrorCode(), -1);
}

TEST(PlayerError, CaughtByValueAndAsMorseError) {
  try {
    throw PlayerError("f", "went wrong");
  } catch (CCMorse::MorseError error) {
    EXPECT_EQ(error.GetErrorStr(), "went wrong");
  }
  // Compilers warn about classes with virtual functions that are caught by value.
  EXPECT_FALSE(std::is_polymorphic<PlayerError>::value);
}

TEST(PlayerError, Prints) {
  std::ostringstream out;
  out << PlayerError("LaserProxy::GetRange", "there is no beam 9", PlayerError::kBadArgument);
  EXPECT_EQ(out.str(), "LaserProxy::GetRange: there is no beam 9 (error -6)");
}

}  // namespace
