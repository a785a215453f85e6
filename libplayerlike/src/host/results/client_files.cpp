// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/client_files.h"

#include <filesystem>
#include <system_error>

#include "playerlike/messages/messages.h"

namespace playerlike {
namespace {

std::string size_text(std::uint64_t bytes) {
  constexpr std::uint64_t kMebibyte = 1U << 20U;
  return bytes % kMebibyte == 0 ? std::to_string(bytes / kMebibyte) + " MiB"
                                : std::to_string(bytes) + " bytes";
}

}  // namespace

void ClientFiles::require_room(int client) const {
  const std::lock_guard lock(mutex_);
  const auto own = sizes_.find(client);
  std::string who;
  std::uint64_t limit = 0;
  if (own != sizes_.end() && own->second >= session_limit_) {
    who = "this client has";
    limit = session_limit_;
  } else if (total_ >= total_limit_) {
    who = "the clients of this run have together";
    limit = total_limit_;
  } else {
    return;
  }
  throw SessionError(SessionError::Code::kNotAvailable,
                     who + " filled " + size_text(limit) +
                         " of the output folder with files, and no more is allowed: save fewer or "
                         "smaller ones, or under names that were used before");
}

void ClientFiles::note(int client, const std::string& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!error) note(client, file, size);
}

void ClientFiles::note(int client, const std::string& file, std::uint64_t size) {
  const std::lock_guard lock(mutex_);
  File& entry = files_[file];
  sizes_[entry.client] -= entry.size;
  total_ -= entry.size;
  entry = {client, size};
  sizes_[client] += size;
  total_ += size;
}

bool ClientFiles::may_grow(std::uint64_t size) const {
  const std::lock_guard lock(mutex_);
  return size < session_limit_ && total_ < total_limit_;
}

}  // namespace playerlike
