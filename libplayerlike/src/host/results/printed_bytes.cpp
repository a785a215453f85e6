// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/printed_bytes.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "host/results/kept_layout.h"
#include "playerlike/host/rerun.h"
#include "process/printed.h"

namespace playerlike {
namespace {

/// Whether what this process prints goes into the file of a run's output.
bool prints_into_file(const std::string& folder) {
  struct stat output {};
  struct stat file {};
  return fstat(STDOUT_FILENO, &output) == 0 && S_ISREG(output.st_mode) &&
         stat((std::filesystem::path(folder) / kProgramLog).c_str(), &file) == 0 &&
         output.st_dev == file.st_dev && output.st_ino == file.st_ino;
}

bool prints_into_pipe(const PrintedCount& printed) {
  struct stat output {};
  return fstat(STDOUT_FILENO, &output) == 0 && S_ISFIFO(output.st_mode) &&
         output.st_ino == printed.pipe;
}

/// Maps the header of a KeptRun for reading; null: there is none.
const KeptHeader* mapped_header(const std::string& file) {
  if (file.empty()) return nullptr;
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  struct stat info {};
  void* memory = MAP_FAILED;
  if (fstat(descriptor, &info) == 0 && info.st_size >= static_cast<off_t>(kKeptHeaderSize)) {
    memory = mmap(nullptr, kKeptHeaderSize, PROT_READ, MAP_SHARED, descriptor, 0);
  }
  close(descriptor);
  return memory == MAP_FAILED ? nullptr : static_cast<const KeptHeader*>(memory);
}

void unmap(const KeptHeader* header) {
  if (header != nullptr) munmap(const_cast<KeptHeader*>(header), kKeptHeaderSize);
}

}  // namespace

PrintedBytes::PrintedBytes(const RunSettings& settings) {
  if (prints_into_file(settings.output_folder)) {
    way_ = Way::kFile;
    return;
  }
  kept_ = mapped_header(settings.kept_run);
  if (kept_ == nullptr) return;
  if (kept_->magic == kKeptMagic && prints_into_pipe(kept_->printed)) {
    way_ = Way::kPipe;
    return;
  }
  unmap(kept_);
  kept_ = nullptr;
}

PrintedBytes::~PrintedBytes() { unmap(kept_); }

std::optional<std::uint64_t> PrintedBytes::count() const {
  if (!known()) return std::nullopt;
  flush_printed();  // what another thread is printing is noted later
  if (way_ == Way::kPipe) return count_in_pipe();
  struct stat output {};
  if (fstat(STDOUT_FILENO, &output) != 0) return std::nullopt;
  return static_cast<std::uint64_t>(output.st_size);
}

std::optional<std::uint64_t> PrintedBytes::count_in_pipe() const {
  const PrintedCount& printed = kept_->printed;
  if (!prints_into_pipe(printed)) return std::nullopt;
  // The supervisor's reads are short. The limit is for a program that has overwritten the memory.
  constexpr int kMostTries = 1'000'000;
  for (int i = 0; i < kMostTries; ++i) {
    const std::uint32_t reads = printed.reads;
    const std::uint64_t taken = printed.taken;
    int waiting = 0;
    if (ioctl(STDOUT_FILENO, FIONREAD, &waiting) != 0) return std::nullopt;
    if (reads % 2 == 0 && printed.reads == reads) {
      return std::min<std::uint64_t>(taken + static_cast<std::uint64_t>(waiting), printed.limit);
    }
    sched_yield();
  }
  return std::nullopt;
}

}  // namespace playerlike
