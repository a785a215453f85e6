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

/// Draws a run's film and its pictures on a thread of its own, so that the simulation goes on
/// meanwhile. What is written depends on the scenes given alone, not on how fast it is.
class PictureThread {
 public:
  /// What to do with a scene.
  struct Job {
    sim::SceneSnapshot scene;
    int film_frames = 0;  ///< how many frames of the film show it
    std::string picture;  ///< PNG to write; "": none
  };

  /// @param film  takes the frames; may be null if no job has any.
  /// @param film_limit  bytes at which the film ends; finish() tells.
  /// @param options  what pictures show; its size is that of the film.
  PictureThread(std::unique_ptr<sim::render::FilmWriter> film, std::uint64_t film_limit,
                const sim::render::RenderOptions& options);
  /// Does what is left.
  ~PictureThread();
  PictureThread(const PictureThread&) = delete;
  PictureThread& operator=(const PictureThread&) = delete;

  /// Takes a job; waits while too many are waiting. After a failure jobs are dropped.
  void add(Job job);
  /// Does what is left and completes the film.
  /// @throws std::runtime_error, the first failure, naming the file and the reason.
  void finish();

 private:
  void work();
  void draw(const Job& job);
  void end_thread();

  const std::uint64_t film_limit_;
  bool film_is_full_ = false;
  std::unique_ptr<sim::render::FilmWriter> film_;  // the rest is the thread's, too, until it ends
  sim::render::SceneRenderer film_renderer_;
  sim::render::SceneRenderer picture_renderer_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<Job> jobs_;  // the first one may be in work
  std::exception_ptr failure_;
  bool last_ = false;  // no more jobs come

  std::thread thread_;
};

}  // namespace playerlike
