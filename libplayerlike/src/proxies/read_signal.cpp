// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

#include "libplayerc++/readsignal.h"

namespace PlayerCc {

struct read_signal_t::State {
  // Recursive, since a subscriber may connect, disconnect and even call the signal.
  mutable std::recursive_mutex mutex;
  std::vector<std::shared_ptr<read_connection_t::Slot>> slots;
  // Number of slots, readable while a subscriber runs and holds the mutex.
  std::atomic<std::size_t> count{0};
};

struct read_connection_t::Slot {
  std::weak_ptr<read_signal_t::State> owner;
  std::function<void()> call;
  bool connected = true;  // guarded by the owner's mutex
};

bool read_connection_t::connected() const {
  const auto slot = mSlot.lock();
  if (!slot) return false;
  const auto owner = slot->owner.lock();
  if (!owner) return false;
  const std::lock_guard lock(owner->mutex);
  return slot->connected;
}

void read_connection_t::disconnect() {
  const auto slot = mSlot.lock();
  if (!slot) return;
  const auto owner = slot->owner.lock();
  if (!owner) return;
  const std::lock_guard lock(owner->mutex);
  slot->connected = false;
  std::erase(owner->slots, slot);
  owner->count = owner->slots.size();
}

read_signal_t::read_signal_t() : mState(std::make_shared<State>()) {}

read_signal_t::~read_signal_t() { disconnect_all_slots(); }

read_connection_t read_signal_t::connect(std::function<void()> aSubscriber) {
  auto slot = std::make_shared<read_connection_t::Slot>();
  slot->owner = mState;
  slot->call = std::move(aSubscriber);
  const std::lock_guard lock(mState->mutex);
  mState->slots.push_back(slot);
  mState->count = mState->slots.size();
  return read_connection_t(slot);
}

void read_signal_t::disconnect(read_connection_t aConnection) {
  const auto slot = aConnection.mSlot.lock();
  if (slot && slot->owner.lock() == mState) aConnection.disconnect();
}

void read_signal_t::disconnect_all_slots() {
  const std::lock_guard lock(mState->mutex);
  for (const auto& slot : mState->slots) slot->connected = false;
  mState->slots.clear();
  mState->count = 0;
}

bool read_signal_t::empty() const { return num_slots() == 0; }

std::size_t read_signal_t::num_slots() const { return mState->count; }

std::function<void()> read_signal_t::call() const {
  // Captures the state, so that the signal may be destroyed before this function is called.
  return [state = mState] {
    const std::lock_guard lock(state->mutex);
    const auto slots = state->slots;  // a copy, since subscribers may change the list
    for (const auto& slot : slots) {
      if (slot->connected) slot->call();
    }
  };
}

void read_signal_t::operator()() const { call()(); }

}  // namespace PlayerCc
