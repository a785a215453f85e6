// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sim {

/// One error in input from outside, described in words that a student understands at once.
struct ConfigIssue {
  std::string id;         ///< stable, listed in docs/errors.md, e.g. "world/unknown-key"
  std::string file;       ///< path as the user gave it; "<memory>" for text
  std::string pointer;    ///< JSON pointer of the place, e.g. "/robots/0/pose/x"; "" is the root
  std::string expected;   ///< e.g. "a number greater than 0 and at most 100 m"
  std::string found;      ///< e.g. "-3"
  std::string hint = {};  ///< optional: what to do, e.g. "did you mean \"yaw_deg\"?"
  int line = 0;           ///< line of the file, from 1; 0 if not known
  int column = 0;         ///< byte in the line, from 1; 0 if not known

  /// "file:line:column: pointer: expected X, found Y (hint) [id]" on one line. Unknown parts are
  /// left out. Control characters of the input are shown as '?'.
  [[nodiscard]] std::string message() const;
};

/// Bad input from outside: a world file, a map, an argument. Holds every issue found, not just the
/// first; what() joins their messages, one per line.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<ConfigIssue> issues);
  explicit ConfigError(ConfigIssue issue);

  [[nodiscard]] const std::vector<ConfigIssue>& issues() const noexcept { return issues_; }

 private:
  std::vector<ConfigIssue> issues_;
};

/// The word of `known` that is nearest to `word` by edit distance (restricted Damerau-Levenshtein:
/// an adjacent swap counts as one edit). Returns "" if no word is within a third of the length of
/// `word` (at least 2 edits).
///
/// Ties go to the first word. A distance as long as the shorter of the two words does not count as
/// similar, so a single letter never matches another. If no word is near, a word that starts with
/// `word`, or that `word` starts with, is returned; the common beginning must have at least two
/// letters.
[[nodiscard]] std::string nearest_word(const std::string& word,
                                       const std::vector<std::string>& known);

/// Like nearest_word(), but returns all similar words, nearest first, at most `most` of them.
[[nodiscard]] std::vector<std::string> nearest_words(const std::string& word,
                                                     const std::vector<std::string>& known,
                                                     std::size_t most);

}  // namespace sim
