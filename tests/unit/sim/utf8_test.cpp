// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/utf8.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace sim {
namespace {

// The bytes of a code point, even if it is not a valid character.
std::string encoded(unsigned point, std::size_t length) {
  if (length == 1) return {static_cast<char>(point)};
  std::string text;
  const unsigned lead = length == 2 ? 0xc0U : length == 3 ? 0xe0U : 0xf0U;
  text += static_cast<char>(lead | point >> 6U * static_cast<unsigned>(length - 1));
  for (std::size_t i = length - 1; i-- > 0;) {
    text += static_cast<char>(0x80U | (point >> 6U * static_cast<unsigned>(i) & 0x3fU));
  }
  return text;
}

TEST(Utf8, EveryCharacter_ShortestFormOnly) {
  for (unsigned point = 0; point <= 0x1fffff; ++point) {
    const std::size_t shortest = point < 0x80 ? 1 : point < 0x800 ? 2 : point < 0x10000 ? 3 : 4;
    const bool is_character = point <= 0x10ffff && (point < 0xd800 || point > 0xdfff);
    for (std::size_t length = shortest; length <= 4; ++length) {
      const std::size_t expected = is_character && length == shortest ? length : 0;
      ASSERT_EQ(utf8_length(encoded(point, length)), expected) << point << " in " << length;
    }
  }
}

TEST(Utf8, FirstInvalidByte_Found) {
  constexpr std::size_t kNone = std::string_view::npos;
  EXPECT_EQ(utf8_length(""), 0U);
  EXPECT_EQ(find_invalid_utf8(""), kNone);
  EXPECT_EQ(find_invalid_utf8("gr\xc3\xbcn, \xe2\x82\xac, \xf0\x9f\xa4\x96"), kNone);
  EXPECT_EQ(find_invalid_utf8("gr\xfcn"), 2U);
  EXPECT_EQ(find_invalid_utf8("ab\x80"), 2U);
  EXPECT_EQ(find_invalid_utf8("a\xc3"), 1U) << "cut off";
  EXPECT_EQ(find_invalid_utf8("\xe2\x82"), 0U);
  EXPECT_EQ(find_invalid_utf8("\xf0\x9f\xa4"), 0U);
  EXPECT_EQ(find_invalid_utf8("\xc3\xbc\xff"), 2U);
}

TEST(Utf8, InvalidBytes_Escaped) {
  EXPECT_EQ(escape_invalid_utf8(""), "");
  EXPECT_EQ(escape_invalid_utf8("gr\xc3\xbcn\n"), "gr\xc3\xbcn\n");
  EXPECT_EQ(escape_invalid_utf8("gr\xfcn\x0f\x80"), "gr\\xfcn\x0f\\x80");
  EXPECT_EQ(escape_invalid_utf8("\xe2\x82"), "\\xe2\\x82");
}

}  // namespace
}  // namespace sim
