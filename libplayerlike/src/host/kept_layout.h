// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "playerlike/host/kept_run.h"

namespace playerlike {

/// The beginning of a KeptRun's memory.
struct KeptHeader {
  std::uint64_t magic = 0;               ///< kKeptMagic
  std::atomic<std::uint32_t> phase{0};   ///< a KeptRun::Phase
  std::atomic<std::uint32_t> noted{0};   ///< the first signal that asks for the end; 0: none
  std::atomic<std::int32_t> process{0};  ///< the host's
};

inline constexpr std::uint64_t kKeptMagic = 0x706c617970656e31;  // "playpen1"
inline constexpr std::size_t kKeptHeaderSize = 4096;
static_assert(sizeof(KeptHeader) <= kKeptHeaderSize);
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// A host's side of a KeptRun.
class KeptWriter {
 public:
  /// @param file  RunSettings::kept_run.
  /// @return null if there is none, or if it belongs to the host of another living process.
  [[nodiscard]] static std::unique_ptr<KeptWriter> open(const std::string& file);
  KeptWriter(const KeptWriter&) = delete;
  KeptWriter& operator=(const KeptWriter&) = delete;
  ~KeptWriter();

  void set_phase(KeptRun::Phase phase) noexcept;
  /// Where a signal's handler writes its number. Stays there as long as the process lives.
  [[nodiscard]] std::atomic<std::uint32_t>& noted() const noexcept { return header_->noted; }

 private:
  KeptWriter(int descriptor, KeptHeader* header) : descriptor_(descriptor), header_(header) {}

  int descriptor_;
  KeptHeader* header_;
};

}  // namespace playerlike
