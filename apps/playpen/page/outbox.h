// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>

namespace playpen::page {

/// The bytes of a message, shared by all clients that get it.
using Bytes = std::shared_ptr<const std::string>;

/// The messages that wait for one client, and how far it has followed the run.
///
/// A client gets a whole, and then every part. If it takes them too slowly, the parts that wait are
/// thrown away and it gets no more of them. Once it has taken the rest, it waits for a new whole.
class Outbox {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param most_bytes  that may wait, beside the first message.
  /// @param most_time  that a part may wait behind other messages; 0: no limit.
  Outbox(std::size_t most_bytes, std::chrono::milliseconds most_time)
      : most_bytes_(most_bytes), most_time_(most_time) {}

  /// A message that waits.
  struct Item {
    Bytes bytes;
    bool is_text = false;
    bool is_part = false;
    Clock::time_point since{};
  };

  /// Lets the client watch: it waits for a whole from now on.
  void watch();
  /// Whether the client waits for a whole.
  [[nodiscard]] bool waits() const noexcept { return state_ == State::kWaiting; }

  /// A whole. It replaces the waiting parts, since it contains them.
  /// @param for_all  also for a client that does not wait for one.
  void add_whole(const Bytes& whole, bool for_all);
  /// A part, for a client that has had a whole.
  void add_part(const Bytes& part, Clock::time_point now);
  /// A text, for any client.
  /// @return whether there is room for it; if not, it is not added.
  [[nodiscard]] bool add_text(std::string text);

  [[nodiscard]] bool empty() const noexcept { return items_.empty(); }
  /// The message to be sent next. It stays first until pop(). @pre !empty().
  [[nodiscard]] const Item& front() const { return items_.front(); }
  /// Removes the first message, which has been sent. @pre !empty().
  void pop();
  /// Ends the watching: throws away the wholes and parts that wait, but for the first message.
  void end_watching();

 private:
  enum class State { kStranger, kWaiting, kCurrent, kBehind };

  void drop_parts();

  std::size_t most_bytes_;
  std::chrono::milliseconds most_time_;
  State state_ = State::kStranger;
  std::deque<Item> items_;
  std::size_t waiting_bytes_ = 0;  ///< of all items but the first
};

}  // namespace playpen::page
