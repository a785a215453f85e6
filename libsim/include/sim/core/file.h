// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace sim {

/// Why the content of a file cannot be had.
enum class FileFault : std::uint8_t {
  kMissing,       ///< no file of that name
  kFolder,        ///< the name is a folder's
  kNotRegular,    ///< a device or a socket, or a pipe where none is allowed
  kNoPermission,  ///< the system does not let this user read it
  kLinkLoop,      ///< symbolic links that lead back to themselves
  kTooLarge,      ///< more bytes than the limit
  kSilent,        ///< a pipe that has given nothing for the limit of silence
  kOther,         ///< an error of the system
};

/// What went wrong, and the same in words that go on from "found": "a folder".
struct FileError {
  FileFault fault;
  std::string found;
};

/// How much is read, and from what.
struct FileLimits {
  std::size_t most_bytes = std::size_t{16} << 20;
  /// Whether a pipe is read as well: only for files that the user has named, as in
  /// `playpen run <(generator)`. A file that another file names must be a regular one.
  bool pipes = false;
  /// A pipe that gives nothing for so long is an error [ms]. Each byte starts the time anew.
  int silence_ms = 30'000;
};

/// Reads a file to its end. Everything that reads files of users goes through this function: it
/// never blocks on a device or on a pipe without a writer, and takes at most limits.most_bytes of
/// memory.
/// @param content  gets the bytes; empty after an error.
/// @return the error; nullopt if there was none.
[[nodiscard]] std::optional<FileError> read_whole_file(const std::string& path,
                                                       const FileLimits& limits,
                                                       std::string& content);

}  // namespace sim
