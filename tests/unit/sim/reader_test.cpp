// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "io/document.h"

namespace sim::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// A parsed text and a reader of its root.
class ReaderTest : public testing::Test {
 protected:
  Reader parse(std::string_view text) {
    document_.file = "t.json";
    EXPECT_TRUE(parse_document(text, document_)) << text;
    return Reader(document_, document_.root, "");
  }

  [[nodiscard]] std::string only_issue() const {
    EXPECT_THAT(document_.issues, SizeIs(1));
    return document_.issues.empty() ? "" : document_.issues.front().message();
  }

  Reader::Document document_;
};

TEST_F(ReaderTest, EachKindOfValue_Read) {
  Reader root = parse(R"({
    "n": 2.5, "i": -3, "u": 18446744073709551615, "b": true, "s": "täxt", "c": "#fff",
    "v": [1, -2.5], "p": [3, 4], "a_deg": 90, "pose": {"x": 1, "y": 2, "yaw_deg": 270},
    "list": [1, "two"], "null": null, "choice": "b"
  })");
  EXPECT_EQ(root.number("n", 0.0), 2.5);
  EXPECT_EQ(root.integer("i", 0, -10, 10), -3);
  EXPECT_EQ(root.unsigned_integer("u", 0), 18446744073709551615ULL);
  EXPECT_TRUE(root.boolean("b", false));
  EXPECT_EQ(root.string("s", ""), "täxt");
  EXPECT_EQ(root.colour("c", {}), (Colour{255, 255, 255, 255}));
  EXPECT_EQ(root.vec2("v", {0, 0}), Vec2(1, -2.5));
  EXPECT_THAT(root.integer_pair("p", {0, 0}, 1, 10), ElementsAre(3, 4));
  EXPECT_EQ(root.angle_deg("a_deg", 0.0), std::numbers::pi / 2);
  // 270 degrees become -90, which is in (-pi, pi].
  const Pose pose = root.pose("pose", {});
  EXPECT_EQ(pose.x_m, 1.0);
  EXPECT_EQ(pose.y_m, 2.0);
  EXPECT_DOUBLE_EQ(pose.yaw_rad, -std::numbers::pi / 2);
  EXPECT_THAT(root.array("list"), SizeIs(2));
  EXPECT_EQ(root.array("list")[1].scalar_text(), "two");
  EXPECT_TRUE(root.child("null")->is_null());
  EXPECT_EQ(root.choice("choice", "a", {"a", "b"}), "b");
  root.finish();
  EXPECT_THAT(document_.issues, SizeIs(0));
}

TEST_F(ReaderTest, MissingMembers_FallbackWithoutIssue) {
  Reader root = parse("{}");
  EXPECT_EQ(root.number("n", 1.5, {2.0, 3.0}), 1.5);
  EXPECT_EQ(root.integer("i", 7, 0, 1), 7);
  EXPECT_EQ(root.unsigned_integer("u", 9), 9U);
  EXPECT_EQ(root.string("s", "x"), "x");
  EXPECT_EQ(root.name("name", ""), "");
  EXPECT_FALSE(root.object("o").has_value());
  EXPECT_FALSE(root.child("o").has_value());
  EXPECT_FALSE(root.has("o"));
  EXPECT_EQ(root.pose("p", {1, 2, 3}), (Pose{1, 2, 3}));
  root.finish();
  EXPECT_THAT(document_.issues, SizeIs(0));
}

TEST_F(ReaderTest, MissingRequiredMembers_Reported) {
  Reader root = parse(R"({"there": null})");
  EXPECT_TRUE(root.require("there", "anything"));
  EXPECT_THAT(document_.issues, SizeIs(0));
  EXPECT_FALSE(root.require("size", "[x, y], in m"));
  EXPECT_THAT(only_issue(), AllOf(HasSubstr("the key \"size\": [x, y], in m"), HasSubstr("none")));
}

TEST_F(ReaderTest, LongList_FirstElementsAndIssue) {
  Reader root = parse(R"({"list": ["a", "b", "c"]})");
  EXPECT_THAT(root.array("list", 3), SizeIs(3));
  EXPECT_THAT(document_.issues, SizeIs(0));
  const std::vector<Reader> two = root.array("list", 2);
  ASSERT_THAT(two, SizeIs(2));
  EXPECT_EQ(two[1].scalar_text(), "b");
  EXPECT_THAT(only_issue(), AllOf(HasSubstr("at most 2"), HasSubstr("3")));
}

TEST_F(ReaderTest, OrderOfKeysAndNumberTexts_Kept) {
  Reader root = parse(R"({"z": 1.50, "a": 1e2, "m": false})");
  EXPECT_THAT(root.keys(), ElementsAre("z", "a", "m"));
  EXPECT_EQ(root.child("z")->scalar_text(), "1.50");
  EXPECT_EQ(root.child("a")->scalar_text(), "1e2");
  EXPECT_EQ(root.child("m")->scalar_text(), "false");
}

TEST_F(ReaderTest, BothKindsOfComments_Skipped) {
  Reader root = parse("// one\n{ /* two\n */ \"a\": 1 // three\n}\n");
  EXPECT_EQ(root.integer("a", 0, 0, 9), 1);
  EXPECT_EQ(document_.line_of("/a"), 3);
}

TEST_F(ReaderTest, WholeNumbers_MayHavePoint) {
  Reader root = parse(R"({"a": 3.0, "b": 3.5, "c": 1e30})");
  EXPECT_EQ(root.integer("a", 0, 0, 9), 3);
  EXPECT_EQ(root.integer("b", 1, 0, 9), 1);
  EXPECT_EQ(root.integer("c", 2, 0, 9), 2);
  ASSERT_THAT(document_.issues, SizeIs(2));
  EXPECT_EQ(document_.issues[0].id, "world/wrong-type");
  EXPECT_EQ(document_.issues[1].id, "world/out-of-range");
}

TEST_F(ReaderTest, Bounds_InclusiveUnlessStated) {
  Reader root = parse(R"({"a": 0, "b": 5})");
  EXPECT_EQ(root.number("a", 1.0, {0.0, 5.0, false, "m"}), 0.0);
  EXPECT_EQ(root.number("b", 1.0, {0.0, 5.0, false, "m"}), 5.0);
  EXPECT_THAT(document_.issues, SizeIs(0));
  EXPECT_EQ(root.number("a", 1.0, {0.0, 5.0, true, "m"}), 1.0);
  EXPECT_EQ(only_issue(),
            "t.json:1: /a: expected a number greater than 0 and at most 5 m, found 0 "
            "[world/out-of-range]");
}

TEST_F(ReaderTest, WrongTypes_NameExpectedType) {
  Reader root = parse(R"({"a": "2", "b": 1, "c": [], "d": {}, "e": null, "f": [1, 2, 3]})");
  EXPECT_EQ(root.number("a", 7.0), 7.0);
  EXPECT_FALSE(root.boolean("b", false));
  EXPECT_EQ(root.string("c", "x"), "x");
  EXPECT_THAT(root.array("d"), SizeIs(0));
  EXPECT_FALSE(root.object("e").has_value());
  EXPECT_EQ(root.vec2("f", {1, 2}), Vec2(1, 2));
  std::vector<std::string> found;
  for (const ConfigIssue& issue : document_.issues) {
    EXPECT_EQ(issue.id, "world/wrong-type");
    found.push_back(issue.pointer + " " + issue.expected + " / " + issue.found);
  }
  EXPECT_THAT(found, ElementsAre("/a a number / the text \"2\"", "/b true or false / 1",
                                 "/c a text in double quotes / an empty list",
                                 "/d a list [...] / an object {...}", "/e an object {...} / null",
                                 "/f a list of two numbers [x, y] / a list of 3"));
}

TEST_F(ReaderTest, Finish_NamesUnknownKeysOnce) {
  Reader root = parse("{\n\"frequncy\": 1,\n\"noise\": 2}");
  static_cast<void>(root.number("frequency", 1.0));
  static_cast<void>(root.number("noise", 1.0));
  root.finish();
  root.finish();
  EXPECT_EQ(only_issue(),
            "t.json:2: /frequncy: expected one of the keys frequency or noise, found the unknown "
            "key \"frequncy\" (did you mean \"frequency\"?) [world/unknown-key]");
}

TEST_F(ReaderTest, Pointers_EscapeSlashAndTilde) {
  Reader root = parse(R"({"a/b~c": 1})");
  root.finish();
  // RFC 6901: ~ becomes ~0 and / becomes ~1.
  EXPECT_EQ(document_.issues.at(0).pointer, "/a~1b~0c");
}

TEST_F(ReaderTest, DuplicateKey_FirstCountsAndSecondReported) {
  Reader root = parse("{\"a\": 1,\n\"a\": 2}");
  EXPECT_EQ(root.integer("a", 0, 0, 9), 1);
  EXPECT_THAT(root.keys(), ElementsAre("a"));
  root.finish();
  EXPECT_THAT(only_issue(), HasSubstr("t.json:2: /a: expected each key once"));
}

TEST_F(ReaderTest, LongTexts_ShortenedBetweenCharacters) {
  // 39 bytes followed by two-byte letters: a cut at byte 40 would split the first of them.
  Reader root = parse("{\"a\": \"" + std::string(39, 'x') + "ääää\"}");
  static_cast<void>(root.boolean("a", false));
  EXPECT_EQ(document_.issues.at(0).found, "the text \"" + std::string(39, 'x') + "...\"");
}

TEST_F(ReaderTest, Names_LettersDigitsUnderscoreAndHyphen) {
  EXPECT_TRUE(is_valid_name("r1_A-z"));
  EXPECT_TRUE(is_valid_name(std::string(64, 'a')));
  EXPECT_FALSE(is_valid_name(std::string(65, 'a')));
  for (const char* bad : {"", "a b", "a/b", "ä", "a.b", "../a"}) {
    EXPECT_FALSE(is_valid_name(bad)) << bad;
  }
}

TEST_F(ReaderTest, NonObject_GivesFallbacks) {
  Reader root = parse("[1]");
  EXPECT_EQ(root.number("a", 2.0), 2.0);
  EXPECT_THAT(root.keys(), SizeIs(0));
  root.finish();
  EXPECT_THAT(document_.issues, SizeIs(0));
  EXPECT_FALSE(root.expect_object());
  EXPECT_EQ(only_issue(),
            "t.json:1: expected an object {...}, found a list of 1 [world/wrong-type]");
}

TEST_F(ReaderTest, NumberAtEndOfLine_HasItsLine) {
  // The parser must read the line break to know that the number has ended.
  parse("{\"a\":\n[1\n,2\n]\n}");
  EXPECT_EQ(document_.line_of("/a"), 2);
  EXPECT_EQ(document_.line_of("/a/0"), 2);
  EXPECT_EQ(document_.line_of("/a/1"), 3);
  EXPECT_EQ(document_.line_of("/a/7"), 2);
}

TEST(ParseDocument, Nesting_AtMost32Levels) {
  Reader::Document fine;
  EXPECT_TRUE(parse_document(std::string(32, '[') + std::string(32, ']'), fine));
  Reader::Document deep;
  EXPECT_FALSE(parse_document(std::string(33, '[') + std::string(33, ']'), deep));
  ASSERT_THAT(deep.issues, SizeIs(1));
  EXPECT_EQ(deep.issues[0].id, "json/too-deep");
}

TEST(ParseDocument, MillionBrackets_RefusedAtOnce) {
  Reader::Document document;
  EXPECT_FALSE(parse_document(std::string(1'000'000, '['), document));
  EXPECT_EQ(document.issues.at(0).id, "json/too-deep");
}

TEST(ParseDocument, InvalidUtf8_Refused) {
  // An overlong slash, a surrogate, above U+10FFFF, a truncated sequence, a lone continuation byte.
  for (const char* bad : {"\"\xc0\xaf\"", "\"\xed\xa0\x80\"", "\"\xf4\x90\x80\x80\"", "\"\xe2\x82",
                          "\"\x80\"", "// \xff\n{}"}) {
    Reader::Document document;
    EXPECT_FALSE(parse_document(bad, document));
    EXPECT_EQ(document.issues.at(0).id, "json/invalid-utf8");
  }
  Reader::Document document;
  EXPECT_TRUE(parse_document("\xef\xbb\xbf\"\xf0\x9f\xa4\x96 \xe2\x82\xac \xc3\xa4\"", document));
}

TEST(ParseDocument, Truncation_ErrorWithReason) {
  const std::string text =
      R"({"name": "x", /* c */ "a": [1.5e3, true, null, {"b": "\u00e4"}], "c": -7})";
  for (std::size_t length = 0; length < text.size(); ++length) {
    Reader::Document document;
    EXPECT_FALSE(parse_document(text.substr(0, length), document)) << length;
    ASSERT_THAT(document.issues, SizeIs(1)) << length;
    EXPECT_FALSE(document.issues[0].message().empty());
  }
}

TEST(ParseDocument, ChangedByte_AcceptedOrExplained) {
  const std::string text = R"({"name": "x", "a": [1.5e3, true, null, {"b": "c"}], "d": -7})";
  int refused = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string changed = text;
      changed[i] = static_cast<char>(byte);
      Reader::Document document;
      if (parse_document(changed, document)) continue;
      ++refused;
      ASSERT_THAT(document.issues, SizeIs(testing::Ge(1U)));
      EXPECT_FALSE(document.issues[0].found.empty());
    }
  }
  // Most bytes are invalid at their random position.
  EXPECT_GT(refused, static_cast<int>(text.size()) * 128);
}

}  // namespace
}  // namespace sim::io
