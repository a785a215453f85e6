// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/source_export.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace playpen::course {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions = {".c",   ".cc", ".cpp",
                                                           ".cxx", ".h",  ".hpp"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

// CMake's own folders contain sources that it made.
bool is_skipped_folder(const fs::path& folder) {
  std::error_code error;
  const std::string name = folder.filename().string();
  return name.starts_with('.') || name == "CMakeFiles" ||
         fs::exists(folder / "CMakeCache.txt", error);
}

// The sources below a folder, relative to it, in the order of their names.
std::vector<fs::path> sources_in(const fs::path& folder, int most_depth) {
  std::vector<fs::path> found;
  std::error_code error;
  if (fs::symlink_status(folder, error).type() != fs::file_type::directory) return found;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                         error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const fs::file_type type = entry->symlink_status(ignored).type();
    if (type == fs::file_type::directory &&
        (entry.depth() >= most_depth || is_skipped_folder(entry->path()))) {
      entry.disable_recursion_pending();
    } else if (type == fs::file_type::regular && is_source(entry->path())) {
      found.push_back(entry->path().lexically_relative(folder));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

ExportedSources export_one(const SourceFolder& submission, const fs::path& target,
                           const ExportLimits& limits) {
  ExportedSources exported;
  exported.id = submission.id;
  fs::remove_all(target);
  fs::create_directories(target);
  for (const fs::path& source : sources_in(submission.folder, limits.most_depth)) {
    std::error_code error;
    const fs::path from = submission.folder / source;
    const std::uintmax_t bytes = fs::file_size(from, error);
    if (error || bytes > limits.most_bytes || exported.files == limits.most_files) {
      ++exported.left_out;
      continue;
    }
    fs::create_directories((target / source).parent_path());
    if (fs::copy_file(from, target / source, error)) {
      ++exported.files;
    } else {
      ++exported.left_out;
    }
  }
  return exported;
}

}  // namespace

std::vector<ExportedSources> export_sources(const std::vector<SourceFolder>& submissions,
                                            const fs::path& target, const ExportLimits& limits) {
  for (const SourceFolder& submission : submissions) {
    const std::string& id = submission.id;
    if (id.empty() || id == "." || id == ".." || id.find('/') != std::string::npos ||
        id.find('\0') != std::string::npos) {
      throw std::invalid_argument("expected the name of a folder as id of a submission, found '" +
                                  id + "'");
    }
  }
  std::vector<ExportedSources> all;
  all.reserve(submissions.size());
  for (const SourceFolder& submission : submissions) {
    all.push_back(export_one(submission, target / submission.id, limits));
  }
  return all;
}

}  // namespace playpen::course
