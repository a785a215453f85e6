// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <sstream>
#include <string>

#include "sim/core/error.h"

namespace test_support {

/// The keys that a file reader knows in each object, by the object's pointer. They come from the
/// reader's errors about unknown keys.
/// @param read  reads a text with an unknown key in each object; throws ConfigError for them.
template <typename Read>
std::map<std::string, std::set<std::string>> known_keys(Read read) {
  std::map<std::string, std::set<std::string>> known;
  try {
    read();
  } catch (const sim::ConfigError& error) {
    for (const sim::ConfigIssue& issue : error.issues()) {
      if (issue.id != "world/unknown-key") continue;
      // "one of the keys a, b or c", or "no key but a"
      const std::string one = "no key but ";
      const bool is_one = issue.expected.starts_with(one);
      std::string list =
          issue.expected.substr(is_one ? one.size() : std::string("one of the keys ").size());
      for (char& c : list) c = c == ',' ? ' ' : c;
      std::istringstream words(list);
      std::set<std::string>& keys = known[issue.pointer.substr(0, issue.pointer.rfind('/'))];
      for (std::string word; words >> word;) {
        if (word != "or") keys.insert(word);
      }
    }
  }
  return known;
}

}  // namespace test_support
