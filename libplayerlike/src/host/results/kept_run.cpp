// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/kept_run.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>

#include "host/results/file_limit_errors.h"
#include "host/results/kept_layout.h"

namespace playerlike {
namespace {

KeptHeader* map_header(int descriptor) {
  void* const memory =
      mmap(nullptr, kKeptHeaderSize, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<KeptHeader*>(memory);
}

}  // namespace

KeptRun::KeptRun(std::size_t size) : descriptor_(memfd_create("playpen-run", MFD_CLOEXEC)) {
  // If the limit of file sizes (ulimit -f) is too low, only the header is kept.
  const FileLimitErrors limit_errors;
  if (descriptor_ >= 0 && (ftruncate(descriptor_, static_cast<off_t>(size)) == 0 ||
                           ftruncate(descriptor_, kKeptHeaderSize) == 0)) {
    header_ = map_header(descriptor_);
  }
  if (header_ == nullptr) {
    const std::string reason = std::strerror(errno);
    if (descriptor_ >= 0) close(descriptor_);
    throw std::runtime_error("no memory for the state of the run: " + reason);
  }
  new (header_) KeptHeader;
  header_->magic = kKeptMagic;
}

KeptRun::~KeptRun() {
  munmap(header_, kKeptHeaderSize);
  close(descriptor_);
}

std::string KeptRun::file() const {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_);
}

KeptRun::Phase KeptRun::phase() const noexcept {
  const std::uint32_t phase = header_->phase;
  return phase <= static_cast<std::uint32_t>(Phase::kDone) ? static_cast<Phase>(phase)
                                                           : Phase::kNone;
}

KeptRun::Progress KeptRun::progress() const noexcept {
  return {header_->process, header_->made_steps, header_->now_ns};
}

void KeptRun::note_conflict() const noexcept { header_->conflict = 1; }

PrintedCount& KeptRun::printed() const noexcept { return header_->printed; }

int KeptRun::interrupt_noted() const noexcept {
  const std::uint32_t signal = header_->noted;
  return signal < NSIG ? static_cast<int>(signal) : 0;
}

}  // namespace playerlike
