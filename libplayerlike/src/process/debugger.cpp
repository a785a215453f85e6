// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/debugger.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string_view>

namespace playerlike {

pid_t tracer_of(pid_t process) noexcept {
  const int error = errno;
  std::array<char, 32> path{};
  constexpr std::string_view kFolder = "/proc/";
  constexpr std::string_view kFile = "/status";
  char* end = path.data() + kFolder.copy(path.data(), kFolder.size());
  if (process == 0) {
    end += std::string_view("self").copy(end, 4);
  } else {
    end = std::to_chars(end, path.data() + path.size() - kFile.size() - 1, process).ptr;
  }
  kFile.copy(end, kFile.size());
  pid_t tracer = 0;
  const int file = open(path.data(), O_RDONLY | O_CLOEXEC);
  if (file >= 0) {
    // The line is among the first ten.
    std::array<char, 1024> text{};
    const ssize_t size = read(file, text.data(), text.size());
    close(file);
    const std::string_view lines(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    constexpr std::string_view kKey = "\nTracerPid:\t";
    if (const std::size_t at = lines.find(kKey); at != lines.npos) {
      std::from_chars(lines.data() + at + kKey.size(), lines.data() + lines.size(), tracer);
    }
  }
  errno = error;
  return tracer;
}

}  // namespace playerlike
