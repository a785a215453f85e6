// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "sim/render/render.h"
#include "sim/simulation/scene_snapshot.h"

namespace playerlike {

/// Draws a run's film and pictures on its own thread, so that the simulation does not wait. The
/// files depend on the scenes only, not on timing.
class PictureThread {
 public:
  /// A scene and what to draw of it.
  struct Job {
    sim::SceneSnapshot scene;
    int film_frames = 0;  ///< number of film frames that show it
    std::string picture;  ///< file name of a PNG; "": none
  };

  /// @param film  takes the frames; may be null if no job has any.
  /// @param film_limit  bytes at which the film ends; finish() reports it.
  /// @param options  contents of the pictures, and size of the film.
  PictureThread(std::unique_ptr<sim::render::FilmWriter> film, std::uint64_t film_limit,
                const sim::render::RenderOptions& options);
  /// Completes the queued jobs.
  ~PictureThread();
  PictureThread(const PictureThread&) = delete;
  PictureThread& operator=(const PictureThread&) = delete;

  /// Adds a job; waits while the queue is full. After a failure jobs are dropped.
  void add(Job job);
  /// Completes the queued jobs and the film. @throws std::runtime_error for the first failure, with
  /// the file and the reason.
  void finish();

 private:
  void work();
  void draw(const Job& job);
  void end_thread();

  const std::uint64_t film_limit_;
  bool film_is_full_ = false;
  std::unique_ptr<sim::render::FilmWriter> film_;  // used by the thread only, like the renderers
  sim::render::SceneRenderer film_renderer_;
  sim::render::SceneRenderer picture_renderer_;

  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::deque<Job> jobs_;  // the first one may be in progress
  std::exception_ptr failure_;
  bool last_ = false;  // no more jobs will be added

  std::thread thread_;
};

}  // namespace playerlike
