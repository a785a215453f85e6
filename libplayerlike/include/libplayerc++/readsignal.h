// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace PlayerCc {

/// One subscriber of a read signal, as ClientProxy::ConnectReadSignal() returns it. Copies stand
/// for the same subscriber; one made without arguments stands for none.
class read_connection_t {
 public:
  read_connection_t() = default;

  /// Whether the subscriber is still called.
  bool connected() const;
  /// From now on the subscriber is not called. Waits for a call that is running in another thread.
  void disconnect();

 private:
  friend class read_signal_t;
  struct Slot;
  explicit read_connection_t(std::weak_ptr<Slot> slot) : mSlot(std::move(slot)) {}
  std::weak_ptr<Slot> mSlot;
};

/// A list of functions that are called when a proxy has new data.
///
/// Safe from many threads: one call of the list runs at a time, and a subscriber may connect and
/// disconnect subscribers (itself too) while it is called.
class read_signal_t {
 public:
  typedef read_connection_t connection_t;

  read_signal_t();
  read_signal_t(const read_signal_t&) = delete;
  read_signal_t& operator=(const read_signal_t&) = delete;
  /// Disconnects all. Waits for a call that is running in another thread.
  ~read_signal_t();

  /// Adds a subscriber; they are called in the order in which they came.
  read_connection_t connect(std::function<void()> aSubscriber);
  /// Removes a subscriber; nothing happens if it was removed before, or is another signal's.
  void disconnect(read_connection_t aConnection);
  void disconnect_all_slots();
  /// Whether there is no subscriber; never waits.
  bool empty() const;
  /// How many there are; never waits.
  std::size_t num_slots() const;

  /// Calls every subscriber. What one throws goes to the caller, and those after it are left out.
  void operator()() const;
  /// A function that does the same, also once the signal is gone: then it calls nobody.
  std::function<void()> call() const;

 private:
  friend class read_connection_t;
  struct State;
  std::shared_ptr<State> mState;
};

}  // namespace PlayerCc
