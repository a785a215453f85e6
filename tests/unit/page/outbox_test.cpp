// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "outbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace playpen::page {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;

constexpr Outbox::Clock::time_point kStart{};

Bytes bytes(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

std::vector<std::string> taken(Outbox& outbox) {
  std::vector<std::string> all;
  while (!outbox.empty()) {
    all.push_back(*outbox.front().bytes);
    outbox.pop();
  }
  return all;
}

class OutboxTest : public testing::Test {
 protected:
  void join() {
    outbox.watch();
    outbox.add_whole(bytes("whole"), false);
  }
  Outbox outbox{10, milliseconds(2000)};
};

TEST_F(OutboxTest, BeforeWatching_TextsOnly) {
  outbox.add_whole(bytes("whole"), true);
  outbox.add_part(bytes("part"), kStart);
  EXPECT_TRUE(outbox.add_text("text"));
  EXPECT_THAT(taken(outbox), ElementsAre("text"));
  EXPECT_FALSE(outbox.waits());
}

TEST_F(OutboxTest, PartsBeforeWhole_NotSent) {
  outbox.watch();
  EXPECT_TRUE(outbox.waits());
  outbox.add_part(bytes("p1"), kStart);
  outbox.add_whole(bytes("whole"), false);
  EXPECT_FALSE(outbox.waits());
  outbox.add_part(bytes("p2"), kStart);
  EXPECT_THAT(taken(outbox), ElementsAre("whole", "p2"));
}

TEST_F(OutboxTest, WholeForOthers_NotSentTwice) {
  join();
  outbox.add_whole(bytes("another"), false);
  EXPECT_THAT(taken(outbox), ElementsAre("whole"));
}

TEST_F(OutboxTest, WholeForAll_ReplacesWaitingParts) {
  join();
  outbox.add_part(bytes("p1"), kStart);
  ASSERT_TRUE(outbox.add_text("text"));
  outbox.add_whole(bytes("anew"), true);
  outbox.add_part(bytes("p2"), kStart);
  EXPECT_THAT(taken(outbox), ElementsAre("whole", "text", "anew", "p2"));
}

// The whole is being sent, so 10 bytes may wait behind it.
TEST_F(OutboxTest, TooManyBytes_PartsDroppedUntilNewWhole) {
  join();
  outbox.add_part(bytes("12345"), kStart);
  outbox.add_part(bytes("67890"), kStart);
  EXPECT_TRUE(outbox.add_text(""));
  outbox.add_part(bytes("x"), kStart);
  outbox.add_part(bytes("y"), kStart);
  EXPECT_FALSE(outbox.waits());  // the rest is not taken yet
  EXPECT_THAT(taken(outbox), ElementsAre("whole", ""));
  EXPECT_TRUE(outbox.waits());
  outbox.add_whole(bytes("second"), false);
  outbox.add_part(bytes("z"), kStart);
  EXPECT_THAT(taken(outbox), ElementsAre("second", "z"));
}

TEST_F(OutboxTest, LargeMessages_NoLimitForTheOneThatIsSent) {
  outbox.watch();
  outbox.add_whole(bytes(std::string(100, 'w')), false);
  EXPECT_EQ(taken(outbox).size(), 1U);
  outbox.add_part(bytes(std::string(100, 'p')), kStart);
  EXPECT_EQ(taken(outbox).size(), 1U);
  EXPECT_FALSE(outbox.waits());
}

TEST_F(OutboxTest, PartWaitsTooLong_Behind) {
  join();
  outbox.add_part(bytes("1"), kStart);
  outbox.add_part(bytes("2"), kStart + milliseconds(2000));
  outbox.add_part(bytes("3"), kStart + milliseconds(2001));
  EXPECT_THAT(taken(outbox), ElementsAre("whole"));
  EXPECT_TRUE(outbox.waits());
}

TEST_F(OutboxTest, TooManyTexts_Refused) {
  EXPECT_TRUE(outbox.add_text("first"));
  EXPECT_TRUE(outbox.add_text("1234567890"));
  EXPECT_FALSE(outbox.add_text("x"));
  EXPECT_THAT(taken(outbox), ElementsAre("first", "1234567890"));
}

TEST_F(OutboxTest, EndOfWatching_KeepsTextsAndFirstMessage) {
  join();
  outbox.add_part(bytes("p"), kStart);
  ASSERT_TRUE(outbox.add_text("t"));
  outbox.end_watching();
  outbox.add_part(bytes("q"), kStart);
  outbox.add_whole(bytes("w"), true);
  EXPECT_THAT(taken(outbox), ElementsAre("whole", "t"));
}

}  // namespace
}  // namespace playpen::page
