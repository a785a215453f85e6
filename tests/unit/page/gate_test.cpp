// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace playpen::page {
namespace {

using testing::HasSubstr;
using testing::Optional;

constexpr const char* kCommandToken = "aaaaaaaaaaaaaaaa";
constexpr const char* kWatchToken = "bbbbbbbbbbbbbbbb";

TEST(Greeting, TokenOrNothing) {
  EXPECT_THAT(token_of_greeting(R"({"token": "abc"})"), Optional(std::string("abc")));
  EXPECT_THAT(token_of_greeting("{}"), Optional(std::string()));
}

TEST(Greeting, OtherTexts_None) {
  for (const char* text : {"", "x", "[]", "\"abc\"", R"({"token": 1})", R"({"key": "abc"})",
                           R"({"token": "abc", "more": 1})", R"({"token": "abc")"}) {
    EXPECT_EQ(token_of_greeting(text), std::nullopt) << text;
  }
}

class GateTest : public testing::Test {
 protected:
  Gate gate(bool open) {
    PageSettings settings;
    settings.command_token = kCommandToken;
    settings.watch_token = kWatchToken;
    return {settings, open, [this](const std::string& text) { told += text + '\n'; }};
  }
  std::string told;
  Gate::Clock::time_point now = Gate::Clock::now();
};

TEST_F(GateTest, Tokens_GiveTheirRights) {
  Gate closed = gate(false);
  const Rights commands = closed.admit("192.0.2.7:1", kCommandToken, now);
  EXPECT_TRUE(commands.watch && commands.command);
  const Rights watches = closed.admit("192.0.2.7:1", kWatchToken, now);
  EXPECT_TRUE(watches.watch && !watches.command);
  EXPECT_EQ(watches.delay.count(), 0);
}

TEST_F(GateTest, NoToken_WatchesIfOpen) {
  const Rights open = gate(true).admit("192.0.2.7:1", "", now);
  EXPECT_TRUE(open.watch && !open.command);
  const Rights closed = gate(false).admit("192.0.2.7:1", "", now);
  EXPECT_FALSE(closed.watch || closed.command);
  EXPECT_THAT(closed.reason, HasSubstr("watching needs a token"));
}

TEST_F(GateTest, WrongTokens_RefusedMoreAndMoreSlowly) {
  Gate open = gate(true);
  const Rights first = open.admit("192.0.2.7:1", "aaaaaaaaaaaaaaab", now);
  EXPECT_FALSE(first.watch || first.command);
  EXPECT_EQ(first.reason, "the token is wrong");
  const Rights second = open.admit("192.0.2.7:2", "", now);
  EXPECT_TRUE(second.watch);  // no token is none that is wrong
  const Rights third = open.admit("192.0.2.7:3", "aaaaaaaaaaaaaaaaa", now);
  EXPECT_EQ(third.delay, 2 * first.delay);
  EXPECT_GT(first.delay.count(), 0);
  EXPECT_THAT(told, HasSubstr("192.0.2.7:3: a wrong token"));
  EXPECT_THAT(told, testing::Not(HasSubstr("aaaa")));
}

TEST_F(GateTest, EmptyTokensOfSettings_GiveNoRights) {
  Gate none(PageSettings{}, false, {});
  EXPECT_FALSE(none.admit("192.0.2.7:1", "", now).watch);
  EXPECT_FALSE(none.admit("192.0.2.7:1", "x", now).watch);
}

TEST(PageSettings, Line_RoundTrip) {
  PageSettings settings;
  settings.bind = "::1";
  settings.port = 0;
  settings.ports = 7;
  settings.names = {"a", "b"};
  settings.open = true;
  settings.command_token = kCommandToken;
  settings.watch_token = kWatchToken;
  settings.title_markup = "a &lt; \n\"b\"";
  const std::string line = to_line(settings);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const PageSettings read = settings_of_line(line);
  EXPECT_EQ(to_line(read), line);
  EXPECT_EQ(read.title_markup, settings.title_markup);
  EXPECT_EQ(read.names, settings.names);
}

TEST(PageSettings, OtherLine_ErrorWithoutItsText) {
  try {
    static_cast<void>(settings_of_line(R"({"command_token": "secret"})"));
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("secret")));
  }
}

}  // namespace
}  // namespace playpen::page
