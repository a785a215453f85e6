// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/worker_thread.h"

#include <utility>

#include "process/system_threads.h"

namespace playerlike::server {

std::size_t canvas_cells(Session& session) {
  const CanvasInfo canvas = session.request(CanvasInfoRequest{});
  return static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
}

bool Job::work() {
  std::exception_ptr error;
  try {
    if (run_slice()) return true;
  } catch (...) {
    error = std::current_exception();
  }
  run_slice = nullptr;  // releases its captures before `done` is called
  std::exchange(done, nullptr)(error);
  return false;
}

void WorkerThread::add(Job job) {
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  jobs_.push_back(std::move(job));
  if (!thread_.joinable()) {
    thread_ = std::thread([this] { work(); });
  }
  changed_.notify_one();
}

void WorkerThread::close() noexcept {
  std::deque<Job> dropped;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    dropped.swap(jobs_);
    changed_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void WorkerThread::work() {
  leave_signals_to_program();
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closed_ || !jobs_.empty(); });
    if (closed_) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    const bool more = job.work();
    lock.lock();
    if (more && !closed_) jobs_.push_back(std::move(job));
  }
}

}  // namespace playerlike::server
