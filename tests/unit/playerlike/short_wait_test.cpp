// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/short_wait.h"

#include <gtest/gtest.h>

namespace {

using playerlike::ShortWait;

/// Looks in vain. @return how often it has looked.
int looks_in_vain(ShortWait& wait) {
  int looks = 0;
  EXPECT_FALSE(wait.look([&] {
    ++looks;
    return false;
  }));
  return looks;
}

/// How many waits in a row do not look at all.
int waits_left_out(ShortWait& wait) {
  int waits = 0;
  while (looks_in_vain(wait) == 0) ++waits;
  return waits;
}

TEST(ShortWaits, LookUntilItIsThere) {
  ShortWait wait;
  for (int i = 0; i < 3; ++i) {
    bool looked = false;
    EXPECT_TRUE(wait.look([&] {
      looked = true;
      return true;
    }));
    EXPECT_TRUE(looked);
  }
}

TEST(ShortWaits, InVain_LeaveOutMoreAndMore) {
  ShortWait wait;
  EXPECT_GT(looks_in_vain(wait), 0);
  EXPECT_EQ(waits_left_out(wait), 4);
  EXPECT_EQ(waits_left_out(wait), 8);
  for (int i = 0; i < 10; ++i) static_cast<void>(waits_left_out(wait));
  EXPECT_EQ(waits_left_out(wait), 256);
}

TEST(ShortWaits, SuccessAfterFailures_LooksAgainEachTime) {
  ShortWait wait;
  for (int i = 0; i < 5; ++i) static_cast<void>(waits_left_out(wait));
  while (!wait.look([] { return true; })) {
  }
  EXPECT_TRUE(wait.look([] { return true; }));
  EXPECT_GT(looks_in_vain(wait), 0);
  EXPECT_EQ(waits_left_out(wait), 4);
}

}  // namespace
