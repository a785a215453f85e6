// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/error.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sim {
namespace {

/// Longer words match nothing; this keeps hostile input cheap.
constexpr std::size_t kLongestWord = 64;

std::string joined_messages(const std::vector<ConfigIssue>& issues) {
  std::string text;
  for (const ConfigIssue& issue : issues) {
    if (!text.empty()) text += '\n';
    text += issue.message();
  }
  return text;
}

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of adjacent
/// letters cost one each, and no substring is edited twice.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string ConfigIssue::message() const {
  std::string text = file;
  if (line > 0) {
    text += ':' + std::to_string(line);
    if (column > 0) text += ':' + std::to_string(column);
  }
  if (!text.empty()) text += ": ";
  if (!pointer.empty()) text += pointer + ": ";
  text += "expected " + expected + ", found " + found;
  if (!hint.empty()) text += " (" + hint + ')';
  text += " [" + id + ']';
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return text;
}

ConfigError::ConfigError(std::vector<ConfigIssue> issues)
    : std::runtime_error(joined_messages(issues)), issues_(std::move(issues)) {}

ConfigError::ConfigError(ConfigIssue issue)
    : ConfigError(std::vector<ConfigIssue>{std::move(issue)}) {}

std::vector<std::string> nearest_words(const std::string& word,
                                       const std::vector<std::string>& known, std::size_t most) {
  if (word.empty() || word.size() > kLongestWord) return {};
  const std::size_t limit = std::max<std::size_t>(2, word.size() / 3);
  std::vector<std::pair<std::size_t, std::string>> near;  // with their distances
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongestWord) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance <= limit && distance < std::min(word.size(), candidate.size())) {
      near.emplace_back(distance, candidate);
    }
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> words;
  for (auto& [distance, candidate] : near) {
    if (words.size() == most) return words;
    words.push_back(std::move(candidate));
  }
  if (!words.empty()) return words;
  for (const std::string& candidate : known) {
    if (words.size() == most) break;
    if (word.size() >= 2 && candidate.size() >= 2 &&
        (candidate.starts_with(word) || word.starts_with(candidate))) {
      words.push_back(candidate);
    }
  }
  return words;
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  const std::vector<std::string> nearest = nearest_words(word, known, 1);
  return nearest.empty() ? "" : nearest.front();
}

}  // namespace sim
