// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace playerlike {

struct KeptHeader;

/// Memory that a process shares with the host of a run in the program that it starts. The host
/// keeps it up to date; what is in it outlives the program, however that ends.
///
/// The program learns of it by RunSettings::kept_run and does not inherit it. What it holds was
/// written by the program and may be anything: readers check it.
class KeptRun {
 public:
  /// How far a run is.
  enum class Phase : std::uint32_t {
    kNone,      ///< no host was made
    kRunning,   ///< there is a host, and its run has not ended
    kEnded,     ///< the run has ended; nothing of its results is complete
    kReported,  ///< report and trajectory are complete
    kDone,      ///< all results that could be written are complete
  };

  /// @throws std::runtime_error if the system gives no such memory.
  KeptRun();
  KeptRun(const KeptRun&) = delete;
  KeptRun& operator=(const KeptRun&) = delete;
  ~KeptRun();

  /// For RunSettings::kept_run, as long as this process lives.
  [[nodiscard]] std::string file() const;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  [[nodiscard]] Phase phase() const noexcept;
  /// The first signal that the host has noted as one that asks for the end of its run; 0: none.
  [[nodiscard]] int interrupt_noted() const noexcept;

 private:
  int descriptor_ = -1;
  KeptHeader* header_ = nullptr;
};

}  // namespace playerlike
