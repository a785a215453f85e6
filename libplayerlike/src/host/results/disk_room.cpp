// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/disk_room.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>

#include "host/results/file_limit_errors.h"

namespace playerlike {
namespace {

/// Opens a file that has no name any more. @return < 0 on failure.
int open_nameless(const std::string& folder) noexcept {
  try {
    std::string name = folder + "/.room.XXXXXX";
    const int descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor >= 0) unlink(name.c_str());
    return descriptor;
  } catch (...) {
    return -1;
  }
}

}  // namespace

bool DiskRoom::hold(std::uint64_t bytes) noexcept {
  if (bytes <= bytes_) return true;
  const FileLimitErrors limit_errors;
  if (descriptor_ < 0) descriptor_ = open_nameless(folder_);
  if (descriptor_ < 0 || posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes)) != 0) {
    return false;
  }
  bytes_ = bytes;
  return true;
}

void DiskRoom::release() noexcept {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  bytes_ = 0;
}

}  // namespace playerlike
