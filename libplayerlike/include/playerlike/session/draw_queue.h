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

/// Drawings of a client on their way to the simulation: a buffer of fixed size that any thread may
/// push to, guarded by a spin lock that is never held for longer than it takes to copy a drawing.
///
/// Two buffers take turns. Whoever empties the queue swaps them under the spin lock and then
/// carries the drawings out of the one without it, so that pushing goes on meanwhile. Lock order:
/// what serialises drain(), then the spin lock. Takes no memory before reserve().
class DrawQueue {
 public:
  /// Drawings that wait at most.
  static constexpr std::size_t kCapacity = 8192;

  DrawQueue() = default;
  DrawQueue(const DrawQueue&) = delete;
  DrawQueue& operator=(const DrawQueue&) = delete;

  /// @return false if there is no room: the queue is full, closed, or reserve() was never called.
  [[nodiscard]] bool push(const sim::DrawOperation& operation) noexcept {
    return push_by([&](sim::DrawOperation& place) { place = operation; });
  }

  /// As push(), but fill(sim::DrawOperation&) writes the drawing where it is to wait, which saves a
  /// copy. What its kind does not use may be left as it is. It must be quick and must not throw.
  template <typename Fill>
  [[nodiscard]] bool push_by(Fill fill) noexcept {
    const Guard guard(locked_);
    const std::size_t size = size_.load(std::memory_order_relaxed);
    if (size == limit_) return false;
    fill(front_[size]);
    size_.store(size + 1, std::memory_order_relaxed);
    return true;
  }

  /// Whether nothing waits, as far as the calling thread can know.
  [[nodiscard]] bool empty() const noexcept { return size_.load(std::memory_order_relaxed) == 0; }

  /// Makes room, if there is none yet. Calls of this, drain() and close() must be serialised.
  void reserve() {
    if (back_ != nullptr || closed_) return;
    auto front = std::make_unique_for_overwrite<sim::DrawOperation[]>(kCapacity);
    back_ = std::make_unique_for_overwrite<sim::DrawOperation[]>(kCapacity);
    const Guard guard(locked_);
    front_ = std::move(front);
    limit_ = kCapacity;
  }

  /// Empties the queue: calls apply(std::span<const sim::DrawOperation>), unless it is empty.
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

  /// Forgets what waits; from now on no push succeeds.
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
    // The holder may have lost the processor in the middle of its few instructions.
    void wait() const noexcept {
      for (int i = 0; i < 64; ++i) {
        if (!locked_.load(std::memory_order_relaxed)) return;
      }
      std::this_thread::yield();
    }
    std::atomic<bool>& locked_;
  };

  std::atomic<bool> locked_{false};
  // Under the spin lock; the size may be looked at without it.
  std::atomic<std::size_t> size_{0};
  std::size_t limit_ = 0;
  std::unique_ptr<sim::DrawOperation[]> front_;
  // Of whoever may call drain().
  std::unique_ptr<sim::DrawOperation[]> back_;
  bool closed_ = false;
};

}  // namespace playerlike
