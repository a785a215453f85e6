// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "playerlike/host/run_settings.h"

namespace playerlike {

struct KeptHeader;

/// How much of a run's program.log this process has printed. Not thread-safe.
///
/// The output goes into that file, or into the pipe of a supervisor that copies it there. In the
/// pipe's case, the count is what the supervisor has taken from it and what is still in it. So it
/// does not depend on when the supervisor runs.
class PrintedBytes {
 public:
  explicit PrintedBytes(const RunSettings& settings);
  PrintedBytes(const PrintedBytes&) = delete;
  PrintedBytes& operator=(const PrintedBytes&) = delete;
  ~PrintedBytes();

  /// Whether the output goes into program.log.
  [[nodiscard]] bool known() const noexcept { return way_ != Way::kElsewhere; }
  /// Flushes the standard output, unless another thread is printing, and counts what was printed
  /// so far, at most what the supervisor's limit leaves in the file [bytes].
  /// @return nullopt if it is not known, or the standard output has been redirected.
  [[nodiscard]] std::optional<std::uint64_t> count() const;

 private:
  enum class Way { kElsewhere, kFile, kPipe };

  [[nodiscard]] std::optional<std::uint64_t> count_in_pipe() const;

  Way way_ = Way::kElsewhere;
  const KeptHeader* kept_ = nullptr;  ///< mapped for reading; null unless the way is kPipe
};

}  // namespace playerlike
