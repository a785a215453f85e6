// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/error.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

TEST(ConfigIssue, Message_NamesPlaceExpectedFoundHintAndId) {
  const ConfigIssue issue{"world/unknown-key",
                          "a.json",
                          "/robots/0/pse",
                          "one of the keys pose",
                          "\"pse\"",
                          "did you mean \"pose\"?",
                          7,
                          3};
  EXPECT_EQ(issue.message(),
            "a.json:7:3: /robots/0/pse: expected one of the keys pose, found \"pse\" "
            "(did you mean \"pose\"?) [world/unknown-key]");
}

TEST(ConfigIssue, Message_LeavesOutUnknownParts) {
  const ConfigIssue issue{"file/missing", "a.json", "", "a file", "none"};
  EXPECT_EQ(issue.message(), "a.json: expected a file, found none [file/missing]");
}

TEST(ConfigIssue, Message_StaysOnOneLine) {
  const ConfigIssue issue{"x/y", "a\nb", "/\x1b[31m", "c", "d\te\x7f"};
  EXPECT_EQ(issue.message(), "a?b: /?[31m: expected c, found d?e? [x/y]");
}

TEST(ConfigError, What_OneLinePerIssue) {
  const ConfigError error(
      std::vector<ConfigIssue>{{"a/b", "f", "", "1", "2"}, {"c/d", "f", "", "3", "4"}});
  EXPECT_STREQ(error.what(), "f: expected 1, found 2 [a/b]\nf: expected 3, found 4 [c/d]");
  EXPECT_EQ(error.issues().size(), 2U);
}

TEST(NearestWord, Distance_CountsInsertionDeletionSubstitutionAndSwap) {
  const std::vector<std::string> known{"frequency", "noise", "range_max"};
  EXPECT_EQ(nearest_word("frequncy", known), "frequency");
  EXPECT_EQ(nearest_word("nosie", known), "noise");
  EXPECT_EQ(nearest_word("noize", known), "noise");
  EXPECT_EQ(nearest_word("rangemax", known), "range_max");
}

TEST(NearestWord, Limit_ThirdOfLengthButAtLeastTwo) {
  // "abcd": two edits are accepted, three are not.
  EXPECT_EQ(nearest_word("abcd", {"abxy"}), "abxy");
  EXPECT_EQ(nearest_word("abcd", {"axyz"}), "");
  // Nine letters: three edits are accepted, four are not.
  EXPECT_EQ(nearest_word("abcdefghi", {"abcdefxyz"}), "abcdefxyz");
  EXPECT_EQ(nearest_word("abcdefghi", {"abcdewxyz"}), "");
}

TEST(NearestWord, PrefersNearerThenFirst) {
  EXPECT_EQ(nearest_word("nois", {"nose", "noise"}), "noise");  // 2 (or a swap) against 1
  EXPECT_EQ(nearest_word("size", {"sizes", "sized"}), "sizes");
}

TEST(NearestWords, OrderedByDistanceAndLimited) {
  const std::vector<std::string> known{"par_planning", "par_introd", "par_intro", "cave"};
  // "par_intr" differs by one letter from par_intro and by two from par_introd; its limit is 8 / 3
  // = 2.
  EXPECT_EQ(nearest_words("par_intr", known, 3),
            (std::vector<std::string>{"par_intro", "par_introd"}));
  EXPECT_EQ(nearest_words("par_intr", known, 1), std::vector<std::string>{"par_intro"});
  EXPECT_TRUE(nearest_words("office", known, 3).empty());
  // No word is similar: the words that begin with it.
  EXPECT_EQ(nearest_words("par", known, 2),
            (std::vector<std::string>{"par_planning", "par_introd"}));
}

TEST(NearestWord, Abbreviations_FoundButNotSingleLetters) {
  EXPECT_EQ(nearest_word("yaw", {"x", "y", "yaw_deg"}), "yaw_deg");
  EXPECT_EQ(nearest_word("z", {"x", "y"}), "");
  EXPECT_EQ(nearest_word("", {"x", "name"}), "");
}

}  // namespace
}  // namespace sim
