// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/replace_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>

namespace sim {
namespace {

int write_all(int descriptor, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int write_to(const char* path, int flags, std::string_view bytes) noexcept {
  const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) return errno;
  int error = write_all(descriptor, bytes);
  if (close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::string part_file_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t dot = path.rfind('.');
  const bool has_ending = dot != std::string::npos && dot > name;
  const std::size_t place = has_ending ? dot : path.size();
  return path.substr(0, place) + ".part" + path.substr(place);
}

int rename_part_file(const std::string& path) noexcept {
  try {
    return std::rename(part_file_name(path).c_str(), path.c_str()) == 0 ? 0 : errno;
  } catch (...) {
    return ENOMEM;
  }
}

int replace_file(const std::string& path, std::string_view bytes) noexcept {
  try {
    struct stat info {};
    if (lstat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) {
      return write_to(path.c_str(), 0, bytes);
    }
    const std::string part = part_file_name(path);
    // It may be left from a process that was killed, or be a link, which must not be followed.
    unlink(part.c_str());
    int error = write_to(part.c_str(), O_EXCL | O_NOFOLLOW, bytes);
    if (error == 0) error = rename_part_file(path);
    if (error != 0) unlink(part.c_str());
    return error;
  } catch (...) {
    return ENOMEM;
  }
}

}  // namespace sim
