// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/picture_thread.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "host/results/picture_sizes.h"
#include "virtual_time/program_threads.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

// Limits of the queue, which evens out fast and slow scenes: jobs and memory.
constexpr std::size_t kMostJobs = 8;
constexpr std::size_t kMostBytes = 64 << 20;

std::size_t most_jobs(const sim::SceneSnapshot& scene) {
  return std::clamp<std::size_t>(kMostBytes / (scene.canvas.size() + 1), 1, kMostJobs);
}

}  // namespace

PictureThread::PictureThread(std::unique_ptr<sim::render::FilmWriter> film,
                             std::uint64_t film_limit, const sim::render::RenderOptions& options)
    : film_limit_(film_limit),
      film_(std::move(film)),
      film_renderer_(options),
      picture_renderer_(scene_options(options)),
      thread_([this] {
        const StartsOwnThreads starts;
        return std::thread([this] { work(); });
      }()) {}

PictureThread::~PictureThread() { end_thread(); }

void PictureThread::add(Job job) {
  std::unique_lock lock(mutex_);
  const std::size_t most = most_jobs(job.scene);
  changed_.wait(lock, [&] { return jobs_.size() < most || failure_; });
  if (failure_) return;
  jobs_.push_back(std::move(job));
  changed_.notify_all();
}

void PictureThread::finish() {
  end_thread();
  const std::unique_ptr<sim::render::FilmWriter> film = std::move(film_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (film) film->finish();
  if (film_is_full_) {
    throw std::runtime_error("the film ends where it has reached " + std::to_string(film_limit_) +
                             " bytes; a lower rate (--record-fps) or a higher speed "
                             "(--record-speed) makes it shorter");
  }
}

void PictureThread::end_thread() {
  {
    const std::lock_guard lock(mutex_);
    last_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void PictureThread::work() {
  const virtual_time::Inside inside;
  const virtual_time::StartsForLibraries starts;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !jobs_.empty() || last_; });
    if (jobs_.empty()) return;
    const Job job = std::move(jobs_.front());
    std::exception_ptr failure;
    lock.unlock();
    try {
      draw(job);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    // The job is removed only now, so that its memory counts while it is drawn.
    jobs_.pop_front();
    if (failure) {
      failure_ = failure;
      jobs_.clear();
    }
    changed_.notify_all();
    if (failure) return;
  }
}

void PictureThread::draw(const Job& job) {
  if (job.film_frames > 0 && !film_is_full_) {
    const sim::render::Image& frame = film_renderer_.draw(job.scene);
    for (int i = 0; i < job.film_frames && !film_is_full_; ++i) {
      film_->add(frame);
      film_is_full_ = film_->size() >= film_limit_;
    }
  }
  if (!job.picture.empty()) {
    sim::render::write_png(picture_renderer_.draw(job.scene), job.picture);
  }
}

}  // namespace playerlike
