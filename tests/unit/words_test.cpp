// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Sources and documentation do not use words that were replaced by plainer ones. CHANGELOG.md may
// use them, because it describes old versions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using testing::ElementsAre;
using testing::IsEmpty;

const fs::path kRoot(PLAYPEN_SOURCE_DIR);

struct BannedWord {
  std::string text;  // in lower case; its words may be on different lines of a comment
  bool is_whole;     // only as a whole word, not as a part of one
  std::string instead;
};

/// A word from two parts, so that this file does not contain it.
std::string joined(const std::string& begin, const std::string& end) { return begin + end; }

const std::vector<BannedWord>& banned_words() {
  static const std::vector<BannedWord> words = {
      {joined("think", "er"), false, "thread id"},
      {joined("gone", "_m"), false, "cumulative_max_travel_m"},
      {joined("lock", "_soon"), false, "lock_with_priority"},
      {joined("kdisappoint", "ment"), false, "what decays, and in which unit"},
      {joined("st", "irs"), true, "is_moving"},
      {joined("is_", "sound"), false, "is_valid"},
      {joined("men", "ded"), true, "repaired"},
      {joined("carry", "_out"), false, "execute"},
      {joined("carried", " out"), true, "executed"},
  };
  return words;
}

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Whether a character may stand between two words of a text: blanks, line ends, comment marks.
bool is_between_words(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '*' || c == '#';
}

/// The end of a banned word that begins at a position of a text in lower case; npos if none does.
std::size_t end_of_word_at(std::size_t at, std::string_view text, const BannedWord& word) {
  if (word.is_whole && at > 0 && is_letter_or_digit(text[at - 1])) return std::string_view::npos;
  for (const char c : word.text) {
    if (c == ' ') {
      const std::size_t begin = at;
      while (at < text.size() && is_between_words(text[at])) ++at;
      if (at == begin) return std::string_view::npos;
    } else if (at == text.size() || text[at++] != c) {
      return std::string_view::npos;
    }
  }
  const bool goes_on = at < text.size() && is_letter_or_digit(text[at]);
  return word.is_whole && goes_on ? std::string_view::npos : at;
}

/// The words that occur in a text, as "FILE:LINE: 'WORD': write REPLACEMENT".
std::vector<std::string> banned_in(const std::string& file, std::string text,
                                   const std::vector<BannedWord>& words) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::vector<std::string> found;
  for (const BannedWord& word : words) {
    for (std::size_t at = text.find(word.text[0]); at != std::string::npos;
         at = text.find(word.text[0], at + 1)) {
      if (end_of_word_at(at, text, word) == std::string_view::npos) continue;
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
      found.push_back(file + ':' + std::to_string(line) + ": '" + word.text + "': write " +
                      word.instead);
    }
  }
  return found;
}

/// The files of the repository: without build folders and output folders, which are in its root.
std::vector<fs::path> files() {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(kRoot)) {
    if (entry.is_regular_file() && entry.path().filename() != "CHANGELOG.md") {
      found.push_back(entry.path());
    }
  }
  for (const char* folder : {".ci", "apps", "docs", "libplayerlike", "libsim", "tests", "worlds"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.is_regular_file()) found.push_back(entry.path());
    }
  }
  return found;
}

TEST(Words, BannedOnesAreInNoFile) {
  const std::vector<fs::path> all = files();
  ASSERT_GT(all.size(), 500U);
  for (const fs::path& path : all) {
    const std::string name = fs::relative(path, kRoot).generic_string();
    const std::string text = read_bytes(path);
    EXPECT_THAT(banned_in(name, name, banned_words()), IsEmpty()) << "in the file's name";
    if (text.find('\0') != std::string::npos) continue;  // pictures and other binary files
    EXPECT_THAT(banned_in(name, text, banned_words()), IsEmpty());
  }
}

// Tests of the rule itself: one that accepts everything must fail here.
const std::vector<BannedWord> kWords = {
    {"quux", false, "x"}, {"frob", true, "y"}, {"foo bar", true, "z"}};

TEST(WordsRule, FindsWordsInAnyCaseAndOverLineBreaks) {
  EXPECT_THAT(banned_in("a.h", "class QuuxId;\n\n  // the foo\n  // bar, 2 foo  bars\n", kWords),
              ElementsAre("a.h:1: 'quux': write x", "a.h:3: 'foo bar': write z"));
  EXPECT_THAT(banned_in("b", "old_quux_\nfrob(), x.frob", kWords),
              ElementsAre("b:1: 'quux': write x", "b:2: 'frob': write y", "b:2: 'frob': write y"));
}

TEST(WordsRule, AcceptsLongerWordsThatContainAWholeOne) {
  EXPECT_THAT(banned_in("a", "frobs, afrob, foo barn, foobar, foo, bar, quu", kWords), IsEmpty());
}

}  // namespace
