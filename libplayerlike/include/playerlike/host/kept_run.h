// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace playerlike {

struct KeptHeader;
struct PrintedCount;

/// Memory shared between a process and the host in the program that it starts. The host keeps the
/// data current. The data survives any end of the program, including a crash.
///
/// The program gets the file name from RunSettings::kept_run and does not inherit the memory. The
/// program writes the data, so readers must validate it.
class KeptRun {
 public:
  /// Progress of a run.
  enum class Phase : std::uint32_t {
    kNone,      ///< no host was created
    kRunning,   ///< the host exists and its run has not ended
    kEnded,     ///< the run has ended; no result is complete
    kReported,  ///< report and trajectory are complete
    kDone,      ///< all possible results are complete
  };
  /// @name What a phase means
  /// @{
  /// Whether the host is writing results, which may take any time.
  [[nodiscard]] static constexpr bool writes_results(Phase phase) noexcept {
    return phase == Phase::kEnded || phase == Phase::kReported;
  }
  /// Whether no report is written any more: it is complete, or cannot be.
  [[nodiscard]] static constexpr bool has_reported(Phase phase) noexcept {
    return phase >= Phase::kReported;
  }
  /// Whether there was a run, some of whose results are missing if its host is gone.
  [[nodiscard]] static constexpr bool lacks_results(Phase phase) noexcept {
    return phase != Phase::kNone && phase != Phase::kDone;
  }
  /// @}

  static constexpr std::size_t kSize = std::size_t{128} << 20U;  ///< [bytes]
  /// @param size  of the memory; the system allocates only what is used. Layers of the canvas that
  ///     do not fit are not kept [bytes].
  /// @throws std::runtime_error if the system cannot provide the memory.
  explicit KeptRun(std::size_t size = kSize);
  KeptRun(const KeptRun&) = delete;
  KeptRun& operator=(const KeptRun&) = delete;
  ~KeptRun();

  /// File name for RunSettings::kept_run; valid as long as this process exists.
  [[nodiscard]] std::string file() const;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  [[nodiscard]] Phase phase() const noexcept;
  /// The first signal that the host has noted as a request to end its run; 0: none.
  [[nodiscard]] int interrupt_noted() const noexcept;
  /// How far the run is.
  struct Progress {
    int process = 0;          ///< process id of the host; 0: none yet
    std::uint64_t steps = 0;  ///< made so far
    std::int64_t now_ns = 0;  ///< simulated time
    friend bool operator==(const Progress&, const Progress&) = default;
  };
  [[nodiscard]] Progress progress() const noexcept;
  /// Tells the host that another program of the run has requested its world and was refused.
  void note_conflict() const noexcept;
  /// Where the program's supervisor counts what the program prints.
  [[nodiscard]] PrintedCount& printed() const noexcept;

 private:
  int descriptor_ = -1;
  KeptHeader* header_ = nullptr;
};

}  // namespace playerlike
