// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace playerlike {

/// Accounts for the bytes that clients have written into the host's output folder. It counts the
/// present sizes of the files, so overwriting a file costs only its growth. Thread-safe.
class ClientFiles {
 public:
  /// @param session_limit  bytes of the files of one client.
  /// @param total_limit    bytes of the files of all clients.
  ClientFiles(std::uint64_t session_limit, std::uint64_t total_limit)
      : session_limit_(session_limit), total_limit_(total_limit) {}

  /// Must be called before a client's file is written.
  /// @param client  its number.
  /// @throws SessionError kNotAvailable, naming the limit, if nothing more may be written.
  void require_room(int client) const;
  /// Must be called after a client's file was written: the file now belongs to the client, with its
  /// present size.
  void note(int client, const std::string& file);
  /// As above, for a file whose size is known.
  void note(int client, const std::string& file, std::uint64_t size);
  /// Whether a file of this size may grow further, regardless of its client's other files.
  [[nodiscard]] bool may_grow(std::uint64_t size) const;

 private:
  struct File {
    int client = 0;
    std::uint64_t size = 0;
  };

  const std::uint64_t session_limit_;
  const std::uint64_t total_limit_;
  mutable std::mutex mutex_;  ///< guards the members below
  std::map<std::string, File> files_;
  std::map<int, std::uint64_t> sizes_;  ///< by client
  std::uint64_t total_ = 0;
};

}  // namespace playerlike
