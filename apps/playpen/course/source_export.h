// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace playpen::course {

/// Sources of a submission.
struct SourceFolder {
  std::string id;                ///< name of its folder in the export; no '/', neither "." nor ".."
  std::filesystem::path folder;  ///< what was handed in
};

/// Limits of what export_sources() copies from one submission. The rest is left out.
struct ExportLimits {
  std::size_t most_files = 500;
  std::size_t most_bytes = 1'000'000;  ///< of one file; generated tables are no one's own work
  int most_depth = 12;                 ///< folders below the submission's
};

/// What export_sources() did with one submission.
struct ExportedSources {
  std::string id;
  std::size_t files = 0;     ///< number of copied files
  std::size_t left_out = 0;  ///< sources that exceeded a limit or could not be copied
};

/// Copies the C and C++ sources of each submission into TARGET/ID, with their folders, for tools
/// that compare sources, such as copydetect and compare50.
///
/// Copied are regular files whose names end in .c, .cc, .cpp, .cxx, .h or .hpp, in upper or lower
/// case. Symbolic links are never followed, so that the export holds no file from outside of the
/// submission. Hidden folders and CMake's build folders are left out. Equal submissions give equal
/// exports.
///
/// TARGET/ID is replaced if it exists. Submissions must be quiet: no program may change them
/// meanwhile.
/// @return one entry per submission, in their order. A folder that can't be read has no files.
/// @throws std::invalid_argument for an id that can't be the name of a folder.
/// @throws std::filesystem::filesystem_error if TARGET/ID can't be written.
std::vector<ExportedSources> export_sources(const std::vector<SourceFolder>& submissions,
                                            const std::filesystem::path& target,
                                            const ExportLimits& limits = {});

}  // namespace playpen::course
