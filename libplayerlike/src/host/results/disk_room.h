// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace playerlike {

/// Room on a disk that other files cannot take, for a file that must still fit when the disk is
/// full.
///
/// A file without a name holds the room, so nothing is left of it, however the process ends. A
/// process that completes the results of another finds the room free once that process has ended.
class DiskRoom {
 public:
  /// @param folder  on the disk in question; must exist.
  explicit DiskRoom(std::string folder) : folder_(std::move(folder)) {}
  DiskRoom(const DiskRoom&) = delete;
  DiskRoom& operator=(const DiskRoom&) = delete;
  ~DiskRoom() { release(); }

  /// Extends the room to a size, unless it is larger already.
  /// @return whether the room is there; not if the disk is full or the file system cannot do it.
  bool hold(std::uint64_t bytes) noexcept;
  /// Makes the room free for other files.
  void release() noexcept;

 private:
  const std::string folder_;
  int descriptor_ = -1;
  std::uint64_t bytes_ = 0;
};

}  // namespace playerlike
