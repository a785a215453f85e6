// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace playerlike {

/// Keeps book of what clients let a host write into its output folder: the bytes that files hold
/// now, so that overwriting a file costs only what it grows by. Threads may share one.
class ClientFiles {
 public:
  /// @param session_limit  bytes for the files of one client.
  /// @param total_limit    bytes for the files of all clients.
  ClientFiles(std::uint64_t session_limit, std::uint64_t total_limit)
      : session_limit_(session_limit), total_limit_(total_limit) {}

  /// Called before a client's file is written.
  /// @param client  its number.
  /// @throws SessionError kNotAvailable, saying what is used up, if nothing more may be written.
  void require_room(int client) const;
  /// Called when a client's file was written: from now on it is the client's, and as large as it
  /// is.
  void note(int client, const std::string& file);
  /// The same for one whose size is known.
  void note(int client, const std::string& file, std::uint64_t size);
  /// Whether a file of this size may go on growing, whatever else its client has written.
  [[nodiscard]] bool may_grow(std::uint64_t size) const;

 private:
  struct File {
    int client = 0;
    std::uint64_t size = 0;
  };

  const std::uint64_t session_limit_;
  const std::uint64_t total_limit_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::map<std::string, File> files_;
  std::map<int, std::uint64_t> sizes_;  ///< by client
  std::uint64_t total_ = 0;
};

}  // namespace playerlike
