// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/fingerprint.h"

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "sim/core/file.h"
#include "sim/core/hash.h"
#include "sim/core/number_text.h"

namespace playpen::grade {

using nlohmann::json;

std::string fingerprint_of_texts(const std::vector<std::string>& texts) {
  sim::StateHash hash;
  for (const std::string& text : texts) hash.add(std::string_view(text));
  return sim::hexadecimal_text(hash.value(), 16);
}

std::string fingerprint_of(const Task& task) {
  std::string text;
  static_cast<void>(sim::read_whole_file(task.file, {}, text));  // leaves it empty after an error
  json document = json::parse(text, nullptr, /*allow_exceptions=*/false, /*ignore_comments=*/true);
  if (document.is_object()) {
    for (const char* name : {"rubric", "description", "$schema"}) document.erase(name);
  }
  return fingerprint_of_texts({document.dump(-1, ' ', false, json::error_handler_t::replace)});
}

std::string fingerprint_of_command(const std::vector<std::string>& command) {
  std::vector<std::string> texts;
  for (const std::string& word : command) {
    texts.push_back(word);
    std::error_code error;
    if (!std::filesystem::is_regular_file(word, error)) continue;
    sim::FileLimits limits;
    limits.most_bytes = std::size_t{1} << 30;
    std::string content;
    if (sim::read_whole_file(word, limits, content)) content = "unreadable";
    texts.push_back(std::move(content));
  }
  return fingerprint_of_texts(texts);
}

}  // namespace playpen::grade
