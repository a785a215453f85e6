// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/file_search.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "io/document.h"
#include "sim/core/utf8.h"

namespace sim::io::stage {
namespace {

namespace fs = std::filesystem;

/// A text in ISO 8859-1; nullopt if it is ASCII, or has a character that ISO 8859-1 lacks.
std::optional<std::string> latin1_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    const auto lead = static_cast<unsigned char>(text[i]);
    if (length == 1) {
      result += text[i];
    } else if (length == 2 && lead <= 0xc3) {  // U+0080 to U+00FF
      result += static_cast<char>(((lead & 0x03U) << 6U) |
                                  (static_cast<unsigned char>(text[i + 1]) & 0x3fU));
    } else {
      return std::nullopt;
    }
    i += length;
  }
  return result == text ? std::nullopt : std::optional(result);
}

}  // namespace

std::vector<fs::path> stage_folders() {
  std::vector<fs::path> folders;
  if (const char* path = std::getenv("STAGEPATH")) {
    std::string_view rest(path);
    while (!rest.empty()) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      if (colon > 0) folders.emplace_back(rest.substr(0, colon));
      rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
  }
  for (const char* installed : {"/usr/share/stage/worlds", "/usr/local/share/stage/worlds",
                                "/usr/share/stage", "/usr/local/share/stage"}) {
    folders.emplace_back(installed);
  }
  return folders;
}

std::string utf8_text(std::string_view text) {
  if (find_invalid_utf8(text) == std::string_view::npos) return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0U | (byte >> 6U));
      result += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return result;
}

std::optional<FoundFile> find_file(const std::string& name, const std::vector<fs::path>& folders) {
  std::vector<fs::path> spellings{name};
  if (auto latin1 = latin1_text(name)) spellings.emplace_back(*std::move(latin1));
  for (const bool by_base_name : {false, true}) {
    for (const fs::path& folder : folders) {
      for (const fs::path& spelling : spellings) {
        const fs::path path = folder / (by_base_name ? spelling.filename() : spelling);
        std::error_code ignored;
        const fs::file_status status = fs::status(path, ignored);
        if (!fs::exists(status) || fs::is_directory(status)) continue;
        return FoundFile{path.string(), by_base_name};
      }
    }
  }
  return std::nullopt;
}

void note_other_path(const std::string& name, const std::string& path, const Place& place,
                     Report& report) {
  report.note("path of " + name, place,
              "there is no file " + in_quotes(name) + "; " + in_quotes(utf8_text(path)) +
                  " takes its place");
}

}  // namespace sim::io::stage
