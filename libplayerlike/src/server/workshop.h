// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "playerlike/session/session.h"

namespace playerlike::server {

/// Cells of canvases or maps that one request may write or make in the server's thread; what is
/// more is for the workshop.
inline constexpr std::size_t kLightCells = std::size_t{1} << 16U;
/// Cells that the workshop draws for a client before it is another one's turn.
inline constexpr std::size_t kPieceCells = std::size_t{1} << 20U;

/// Cells of a canvas.
[[nodiscard]] std::size_t canvas_cells(Session& session);

/// A job for a Workshop.
struct Job {
  /// Does a piece of the job, some ms of work. Called again and again, by one thread at a time.
  /// @return whether more is left. What it throws ends the job.
  std::function<bool()> piece;
  /// Called once after the last piece, with what that has thrown. Not called if the workshop is
  /// closed before.
  std::function<void(std::exception_ptr)> done;

  /// Does a piece, and after the last one calls `done`. @return whether more is left.
  bool work();
};

/// Does what would keep a server's thread for too long: draws on large canvases, makes large
/// answers and pictures.
///
/// One thread of its own, started with the first job. Jobs take turns: a piece of the oldest one,
/// then a piece of the next. So a job with many pieces delays others by a piece each, and never
/// those who give none.
class Workshop {
 public:
  Workshop() = default;
  ~Workshop() { close(); }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  /// Takes a job. From any thread; job.done is called by the workshop's.
  void add(Job job);
  /// Drops all jobs, waits for the end of the piece that is being done, and takes no more.
  void close() noexcept;

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool closed_ = false;
  std::thread thread_;
};

}  // namespace playerlike::server
