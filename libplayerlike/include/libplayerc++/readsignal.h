// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace PlayerCc {

/// A handle to a subscriber of a read signal; ClientProxy::ConnectReadSignal() returns it. Copies
/// refer to the same subscriber. A default-constructed handle refers to none.
class read_connection_t {
 public:
  read_connection_t() = default;

  /// Whether the subscriber is still called.
  bool connected() const;
  /// Removes the subscriber. Waits for a call that is running in another thread.
  void disconnect();

 private:
  friend class read_signal_t;
  struct Slot;
  explicit read_connection_t(std::weak_ptr<Slot> slot) : mSlot(std::move(slot)) {}
  std::weak_ptr<Slot> mSlot;
};

/// A list of functions that are called when a proxy has new data.
///
/// Threads: all members may be called from any thread. Only one call of the list runs at a time. A
/// subscriber may connect and disconnect subscribers, including itself, while it is called.
class read_signal_t {
 public:
  typedef read_connection_t connection_t;

  read_signal_t();
  read_signal_t(const read_signal_t&) = delete;
  read_signal_t& operator=(const read_signal_t&) = delete;
  /// Removes all subscribers. Waits for a call that is running in another thread.
  ~read_signal_t();

  /// Adds a subscriber. Subscribers are called in the order in which they were added.
  read_connection_t connect(std::function<void()> aSubscriber);
  /// Removes a subscriber. Does nothing if it was already removed or belongs to another signal.
  void disconnect(read_connection_t aConnection);
  void disconnect_all_slots();
  /// Returns whether there are no subscribers. Never waits.
  bool empty() const;
  /// Returns the number of subscribers. Never waits.
  std::size_t num_slots() const;

  /// Calls every subscriber. An exception of a subscriber is passed to the caller, and the
  /// remaining subscribers are not called.
  void operator()() const;
  /// Returns a function that calls every subscriber. After the signal is destroyed, the function
  /// does nothing.
  std::function<void()> call() const;

 private:
  friend class read_connection_t;
  struct State;
  std::shared_ptr<State> mState;
};

}  // namespace PlayerCc
