// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/kept_run.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>

#include "host/kept_layout.h"

namespace playerlike {
namespace {

KeptHeader* map_header(int descriptor) {
  void* const memory =
      mmap(nullptr, kKeptHeaderSize, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<KeptHeader*>(memory);
}

}  // namespace

KeptRun::KeptRun() : descriptor_(memfd_create("playpen-run", MFD_CLOEXEC)) {
  if (descriptor_ >= 0 && ftruncate(descriptor_, kKeptHeaderSize) == 0) {
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

bool KeptRun::interrupt_noted() const noexcept { return header_->noted != 0; }

std::unique_ptr<KeptWriter> KeptWriter::open(const std::string& file) {
  if (file.empty()) return nullptr;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  struct stat info {};
  KeptHeader* header = nullptr;
  if (fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) &&
      info.st_size >= static_cast<off_t>(kKeptHeaderSize)) {
    header = map_header(descriptor);
  }
  if (header == nullptr || header->magic != kKeptMagic) {
    close(descriptor);
    return nullptr;
  }
  // Programs may start others that simulate, too: the run is that of one of them at a time.
  std::int32_t owner = header->process;
  const bool done = header->phase == static_cast<std::uint32_t>(KeptRun::Phase::kDone);
  const bool is_free = owner == 0 || done || (kill(owner, 0) != 0 && errno == ESRCH);
  if (!is_free || !header->process.compare_exchange_strong(owner, getpid())) {
    munmap(header, kKeptHeaderSize);
    close(descriptor);
    return nullptr;
  }
  header->noted = 0;
  header->phase = static_cast<std::uint32_t>(KeptRun::Phase::kRunning);
  return std::unique_ptr<KeptWriter>(new KeptWriter(descriptor, header));
}

// The header stays: a signal's handler may write to it at any time.
KeptWriter::~KeptWriter() { close(descriptor_); }

void KeptWriter::set_phase(KeptRun::Phase phase) noexcept {
  header_->phase = static_cast<std::uint32_t>(phase);
}

}  // namespace playerlike
