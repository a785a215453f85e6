// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace sim {
namespace {

/// Closes a descriptor at the end of a scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  [[nodiscard]] int get() const noexcept { return number_; }

 private:
  int number_;
};

FileError error_of(int code) {
  switch (code) {
    case ENOENT:
    case ENOTDIR:
      return {FileFault::kMissing, "no file of that name"};
    case EACCES:
    case EPERM:
      return {FileFault::kNoPermission, "no permission to open it"};
    case ELOOP:
      return {FileFault::kLinkLoop, "symbolic links that lead round in a circle"};
    case EISDIR:
      return {FileFault::kFolder, "a folder"};
    default:
      return {FileFault::kOther, std::generic_category().message(code)};
  }
}

/// The error for a file of that type, whatever its content.
std::optional<FileError> fault_of_kind(mode_t mode, const FileLimits& limits) {
  if (S_ISREG(mode)) return std::nullopt;
  if (S_ISDIR(mode)) return FileError{FileFault::kFolder, "a folder"};
  if (S_ISFIFO(mode)) {
    if (limits.pipes) return std::nullopt;
    return FileError{FileFault::kNotRegular, "a pipe"};
  }
  return FileError{FileFault::kNotRegular, S_ISSOCK(mode) ? "a socket" : "a device"};
}

std::string size_text(std::size_t bytes) {
  constexpr std::size_t kMiB = std::size_t{1} << 20;
  return bytes >= kMiB ? std::to_string(bytes / kMiB) + " MiB" : std::to_string(bytes) + " bytes";
}

FileError too_large(const FileLimits& limits) {
  return {FileFault::kTooLarge, "more than " + size_text(limits.most_bytes)};
}

/// Waits until a pipe has data or has ended. A pipe that nobody has opened for writing counts as
/// one without data.
std::optional<FileError> wait_for_pipe(int descriptor, const FileLimits& limits) {
  pollfd waited{descriptor, POLLIN, 0};
  for (;;) {
    const int ready = poll(&waited, 1, limits.silence_ms);
    if (ready > 0) return std::nullopt;
    if (ready == 0) {
      return FileError{FileFault::kSilent, "a pipe that has given nothing for " +
                                               std::to_string(limits.silence_ms / 1000) + " s"};
    }
    if (errno != EINTR) return error_of(errno);
  }
}

}  // namespace

std::optional<FileError> read_whole_file(const std::string& path, const FileLimits& limits,
                                         std::string& content) {
  content.clear();
  // Opening some devices has side effects, so the type is checked before opening and again after.
  struct stat status = {};
  if (stat(path.c_str(), &status) != 0) return error_of(errno);
  if (auto fault = fault_of_kind(status.st_mode, limits)) return fault;
  const Descriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0) return error_of(errno);
  if (fstat(file.get(), &status) != 0) return error_of(errno);
  if (auto fault = fault_of_kind(status.st_mode, limits)) return fault;
  const bool is_pipe = S_ISFIFO(status.st_mode);
  const auto size = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
  if (!is_pipe && size > limits.most_bytes) return too_large(limits);

  constexpr std::size_t kPiece = std::size_t{64} << 10;
  std::string bytes;
  // Some files report size 0 but have content; others grow while they are read.
  std::size_t room = is_pipe ? kPiece : size + 1;
  for (;;) {
    if (is_pipe) {
      if (auto fault = wait_for_pipe(file.get(), limits)) return fault;
    }
    const std::size_t begin = bytes.size();
    bytes.resize(begin + room);
    const ssize_t count = read(file.get(), bytes.data() + begin, room);
    const int code = errno;
    bytes.resize(begin + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0) break;
    if (count < 0 && code != EINTR && code != EAGAIN) return error_of(code);
    if (bytes.size() > limits.most_bytes) return too_large(limits);
    room = kPiece;
  }
  content = std::move(bytes);
  return std::nullopt;
}

}  // namespace sim
