// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/stage/report.h"

namespace sim::io::stage {

/// The folders of STAGEPATH, and then those where Stage's packages install its worlds.
[[nodiscard]] std::vector<std::filesystem::path> stage_folders();

/// A text as UTF-8. Files of Stage's time that are not UTF-8 are in ISO 8859-1, whose characters
/// have the numbers of their bytes.
[[nodiscard]] std::string utf8_text(std::string_view text);

/// A file that a world or a configuration file names.
struct FoundFile {
  std::string path;
  bool by_base_name = false;  ///< not at the named path: only its last part is the same
};

/// Looks for a file in folders: for the named path in each of them, then for its last part, since
/// the path may be that of another computer. The name of the file on disk may be in UTF-8 or in ISO
/// 8859-1.
/// @param name  in UTF-8. An absolute path is looked for as it is, too.
[[nodiscard]] std::optional<FoundFile> find_file(const std::string& name,
                                                 const std::vector<std::filesystem::path>& folders);

/// Notes that a file of another folder is used in place of the named one.
void note_other_path(const std::string& name, const std::string& path, const Place& place,
                     Report& report);

}  // namespace sim::io::stage
