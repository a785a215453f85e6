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

/// Maximum number of cells that a request may write or make on the server's thread; larger requests
/// go to the worker thread.
inline constexpr std::size_t kInlineCells = std::size_t{1} << 16U;
/// Cells that the worker thread draws for a client before the next client's turn.
inline constexpr std::size_t kSliceCells = std::size_t{1} << 20U;

/// Number of cells of a canvas.
[[nodiscard]] std::size_t canvas_cells(Session& session);

/// A job for a WorkerThread.
struct Job {
  /// Does a slice of the job, some ms of work. Called repeatedly, by one thread at a time. @return
  /// whether slices are left. An exception ends the job.
  std::function<bool()> run_slice;
  /// Called once after the last slice, with its exception. Not called if the worker thread is
  /// closed before.
  std::function<void(std::exception_ptr)> done;

  /// Does one slice, and calls `done` after the last one. @return whether slices are left.
  bool work();
};

/// Does work that would block a server's thread for too long: drawing on large canvases, large
/// answers, pictures.
///
/// It has one thread, which starts with the first job. Jobs take turns slice by slice (round
/// robin), so a job with many slices delays every other job by only one slice per turn.
class WorkerThread {
 public:
  WorkerThread() = default;
  ~WorkerThread() { close(); }
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

  /// Adds a job. May be called from any thread; the worker thread calls job.done.
  void add(Job job);
  /// Drops all jobs, waits for the end of the current slice, and accepts no more jobs.
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
