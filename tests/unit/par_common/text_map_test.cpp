// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/text_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "grids.h"
#include "temporary_folder.h"

namespace par {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Mask read(const std::string& text) {
  std::istringstream in(text);
  return read_text_map(in, "map.txt", 0.1);
}

std::string error_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const MapError& e) {
    return e.what();
  }
  return "no error";
}

TEST(TextMap, HeightAndRows_Parsed) {
  const Mask map = read("2\n..#\n#..\n");
  EXPECT_EQ(map.values(), test::mask({"..#", "#.."}).values());
  EXPECT_EQ(map.width(), 3);
  EXPECT_EQ(map.height(), 2);
  EXPECT_EQ(map.frame().cell_size_m, 0.1);
}

TEST(TextMap, BlanksCarriageReturnsAndMissingLineEnd_Accepted) {
  EXPECT_EQ(read(" 2 \r\n..#\r\n#..  ").values(), test::mask({"..#", "#.."}).values());
  EXPECT_EQ(read("1\n.\n\n  \n").values(), test::mask({"."}).values());
}

TEST(TextMap, RoundTrips) {
  std::mt19937 random(1);
  const Mask map = test::random_mask(test::frame(31, 17, 0.1), 40, random);
  EXPECT_EQ(read(to_text_map(map)).values(), map.values());
}

TEST(TextMap, Errors_NameFileLineAndText) {
  EXPECT_EQ(error_of(""), "map.txt:1: expected the number of rows, found an empty file");
  EXPECT_EQ(error_of("..#\n"),
            "map.txt:1: expected the number of rows, a whole number from 1 to 8192, found "
            "\"..#\"");
  EXPECT_EQ(error_of("3\n...\n...\n"), "map.txt:4: expected row 3 of 3, found the end of the file");
  EXPECT_EQ(error_of("2\n...\n..\n"), "map.txt:3: expected 3 cells as in the first row, found 2");
  EXPECT_EQ(error_of("2\n...\n.x.\n"), "map.txt:3: expected . or # in column 2, found \"x\"");
  EXPECT_EQ(error_of("1\n...\n###\n"),
            "map.txt:3: expected nothing after the 1 rows that line 1 announces, found \"###\"");
  EXPECT_EQ(error_of("1\n\n...\n"), "map.txt:2: expected a row of . and #, found an empty line");
}

TEST(TextMap, InvalidHeight_Refused) {
  for (const char* height :
       {"0", "-1", "8193", "99999999999999999999", "2.5", "0x2", "2 3", "+2"}) {
    EXPECT_THAT(error_of(std::string(height) + "\n.\n.\n"),
                AllOf(HasSubstr("map.txt:1: "), HasSubstr(height)));
  }
}

TEST(TextMap, LongRows_Refused) {
  EXPECT_THAT(error_of("1\n" + std::string(8193, '.') + "\n"), HasSubstr("found 8193"));
  EXPECT_EQ(read("1\n" + std::string(8192, '.') + "\n").width(), 8192);
}

TEST(TextMap, Errors_EscapeControlCharacters) {
  const std::string error = error_of("\x1b[2J\x07\n");
  for (const char c : error) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(TextMap, LoadsFile) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.write("a.txt", "1\n.#\n");
  EXPECT_EQ(load_text_map(file).values(), test::mask({".#"}).values());
  EXPECT_EQ(load_text_map(file).frame().cell_size_m, 0.02);
  try {
    static_cast<void>(load_text_map(folder / "none.txt"));
    ADD_FAILURE();
  } catch (const MapError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("none.txt"), HasSubstr("cannot be read")));
  }
  EXPECT_THROW(static_cast<void>(load_text_map(folder.path())), MapError) << "a folder";
}

}  // namespace
}  // namespace par
