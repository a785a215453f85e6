// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sim {

/// One thing that is wrong with input from outside, in words a student understands at once.
struct ConfigIssue {
  std::string id;         ///< stable, listed in docs/errors.md, e.g. "world/unknown-key"
  std::string file;       ///< path as the user gave it; "<memory>" for text
  std::string pointer;    ///< JSON pointer of the place, e.g. "/robots/0/pose/x"; "" is the root
  std::string expected;   ///< e.g. "a number greater than 0 and at most 100 m"
  std::string found;      ///< e.g. "-3"
  std::string hint = {};  ///< optional: what to do, e.g. "did you mean \"yaw_deg\"?"
  int line = 0;           ///< of the file, from 1; 0: not known
  int column = 0;         ///< of the line in bytes, from 1; 0: not known

  /// "file:line:column: pointer: expected X, found Y (hint) [id]" on one line; parts that are
  /// not known are left out. Control characters of the input are shown as '?'.
  [[nodiscard]] std::string message() const;
};

/// Bad input from outside: a world file, a map, an argument. Holds every issue found, not just
/// the first; what() is their messages, one a line.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<ConfigIssue> issues);
  explicit ConfigError(ConfigIssue issue);

  [[nodiscard]] const std::vector<ConfigIssue>& issues() const noexcept { return issues_; }

 private:
  std::vector<ConfigIssue> issues_;
};

/// Of `known`, the word nearest to `word` by edit distance (Damerau-Levenshtein, restricted:
/// adjacent swaps count one), or "" when none is within a third of the word's length (at least 2).
///
/// Of equally near words the first one is taken. A distance as long as the shorter of the two
/// words is no likeness, so one letter never stands for another. If no word is near, one that
/// `word` is the beginning of (or the other way round; two letters at least) is given.
[[nodiscard]] std::string nearest_word(const std::string& word,
                                       const std::vector<std::string>& known);

/// As nearest_word(), all words that are near, the nearest first, at most `most` of them.
[[nodiscard]] std::vector<std::string> nearest_words(const std::string& word,
                                                     const std::vector<std::string>& known,
                                                     std::size_t most);

}  // namespace sim
