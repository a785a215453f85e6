// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <thread>
#include <utility>

#include "sim/canvas/layers.h"

namespace playerlike {

/// A queue of drawings from a client to the simulation. It is a buffer of fixed size to which any
/// thread may push. A spin lock guards it and is held no longer than it takes to copy a drawing.
///
/// The queue is double-buffered. drain() swaps the buffers under the spin lock and then executes
/// the drawings without it, so that other threads can push meanwhile. Lock order: first the lock
/// that serialises drain(), then the spin lock. No memory is allocated before reserve().
class DrawQueue {
 public:
  /// Maximum number of queued drawings.
  static constexpr std::size_t kCapacity = 8192;

  DrawQueue() = default;
  DrawQueue(const DrawQueue&) = delete;
  DrawQueue& operator=(const DrawQueue&) = delete;

  /// @return false if there is no room: the queue is full, closed, or reserve() was never called.
  [[nodiscard]] bool push(const sim::DrawOperation& operation) noexcept {
    return push_by([&](sim::DrawOperation& place) { place = operation; });
  }

  /// Like push(), but fill(sim::DrawOperation&) writes the drawing directly into the buffer, which
  /// saves a copy. It need not set members that the kind of drawing does not use. It must be fast
  /// and must not throw.
  template <typename Fill>
  [[nodiscard]] bool push_by(Fill fill) noexcept {
    const Guard guard(locked_);
    const std::size_t size = size_.load(std::memory_order_relaxed);
    if (size == limit_) return false;
    fill(front_[size]);
    size_.store(size + 1, std::memory_order_relaxed);
    return true;
  }

  /// Whether the queue is empty, as visible to the calling thread.
  [[nodiscard]] bool empty() const noexcept { return size_.load(std::memory_order_relaxed) == 0; }

  /// Allocates the buffers if this has not been done. Calls of reserve(), drain() and close() must
  /// be serialised.
  void reserve() {
    if (back_ != nullptr || closed_) return;
    auto front = std::make_unique_for_overwrite<sim::DrawOperation[]>(kCapacity);
    back_ = std::make_unique_for_overwrite<sim::DrawOperation[]>(kCapacity);
    const Guard guard(locked_);
    front_ = std::move(front);
    limit_ = kCapacity;
  }

  /// Empties the queue: calls apply(std::span<const sim::DrawOperation>) unless the queue is empty.
  template <typename Apply>
  void drain(Apply apply) {
    if (size_.load(std::memory_order_relaxed) == 0) return;
    std::size_t size = 0;
    {
      const Guard guard(locked_);
      std::swap(front_, back_);
      size = size_.exchange(0, std::memory_order_relaxed);
    }
    apply(std::span<const sim::DrawOperation>(back_.get(), size));
  }

  /// Discards all queued drawings. Every later push fails.
  void close() noexcept {
    closed_ = true;
    const Guard guard(locked_);
    size_.store(0, std::memory_order_relaxed);
    limit_ = 0;
  }

 private:
  class Guard {
   public:
    explicit Guard(std::atomic<bool>& locked) noexcept : locked_(locked) {
      while (locked_.exchange(true, std::memory_order_acquire)) wait();
    }
    ~Guard() { locked_.store(false, std::memory_order_release); }
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

   private:
    // Yields because the holder may have been preempted inside its short critical section.
    void wait() const noexcept {
      for (int i = 0; i < 64; ++i) {
        if (!locked_.load(std::memory_order_relaxed)) return;
      }
      std::this_thread::yield();
    }
    std::atomic<bool>& locked_;
  };

  std::atomic<bool> locked_{false};
  // Guarded by the spin lock; the size may be read without it.
  std::atomic<std::size_t> size_{0};
  std::size_t limit_ = 0;
  std::unique_ptr<sim::DrawOperation[]> front_;
  // Used only by the thread that may call drain().
  std::unique_ptr<sim::DrawOperation[]> back_;
  bool closed_ = false;
};

}  // namespace playerlike
