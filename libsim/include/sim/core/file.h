// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace sim {

/// Why a file cannot be read.
enum class FileFault : std::uint8_t {
  kMissing,       ///< no file has that name
  kFolder,        ///< the name is that of a folder
  kNotRegular,    ///< a device or a socket, or a pipe where none is allowed
  kNoPermission,  ///< this user may not read it
  kLinkLoop,      ///< symbolic links that lead back to themselves
  kTooLarge,      ///< more bytes than the limit
  kSilent,        ///< a pipe that sent nothing within the time limit
  kOther,         ///< another system error
};

/// The kind of error, and a text for messages that follows the word "found", e.g. "a folder".
struct FileError {
  FileFault fault;
  std::string found;
};

/// Limits on how much is read, and from what.
struct FileLimits {
  std::size_t most_bytes = std::size_t{16} << 20;
  /// Whether pipes are read as well. Only for files that the user names directly, as in `playpen
  /// run <(generator)`. A file that another file names must be a regular one.
  bool pipes = false;
  /// A pipe that sends nothing for this long is an error [ms]. Each byte restarts the timer.
  int silence_ms = 30'000;
};

/// Reads a file to its end. All user files are read through this function. It never blocks on a
/// device or on a pipe without a writer, and uses at most limits.most_bytes of memory.
/// @param content  gets the bytes; empty after an error.
/// @return the error; nullopt on success.
[[nodiscard]] std::optional<FileError> read_whole_file(const std::string& path,
                                                       const FileLimits& limits,
                                                       std::string& content);

}  // namespace sim
