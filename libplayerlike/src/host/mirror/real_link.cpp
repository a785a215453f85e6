// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/mirror/real_link.h"

#include <exception>

#include "host/stepping/inputs.h"
#include "process/system_threads.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {
namespace {

// Readings that nobody takes, e.g. because the run is paused: the oldest are dropped.
constexpr std::size_t kArrivalLimit = 1000;
constexpr std::size_t kQueuedCommandLimit = 1000;
constexpr std::chrono::seconds kStoppingTime(1);

}  // namespace

RealLink::RealLink(std::unique_ptr<Session> session, std::optional<DeviceId> motors,
                   TakeChargeRequest charge)
    : session_(std::move(session)), motors_(motors), charge_(std::move(charge)) {
  session_->request(AnswerTimeoutRequest{2.0 * charge_.watchdog_s});
  watched_ = session_->request(charge_).watched;
  charge_.take_over = false;
  receiver_ = std::thread([this] { receive(); });
  sender_ = std::thread([this] { transmit(); });
  if (watched_) keeper_ = std::thread([this] { keep_charge(); });
}

RealLink::~RealLink() { stop(); }

void RealLink::send(DeviceId device, const sim::Command& command) {
  const std::lock_guard lock(mutex_);
  if (lost_ || stopping_) return;
  if (replaces_last(commands_, device, command)) return;
  // The connection cannot take more: the newest commands matter.
  if (commands_.size() == kQueuedCommandLimit) commands_.erase(commands_.begin());
  commands_.emplace_back(device, command);
  changed_.notify_all();
}

std::vector<RealLink::Arrival> RealLink::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(arrived_, {});
}

bool RealLink::take_stopped() {
  const std::lock_guard lock(mutex_);
  return std::exchange(stopped_, false);
}

std::optional<std::string> RealLink::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void RealLink::stop() noexcept {
  {
    std::unique_lock lock(mutex_);
    if (!stopping_) {
      stopping_ = true;
      commands_.clear();
      if (motors_ && !lost_) commands_.emplace_back(*motors_, sim::TwistCommand{});
      changed_.notify_all();
    }
    changed_.wait_for(lock, kStoppingTime, [this] { return all_sent_; });
  }
  session_->close();
  for (std::thread* const thread : {&receiver_, &sender_, &keeper_}) {
    if (thread->joinable()) thread->join();
  }
}

void RealLink::on_reading(DeviceId device, const sim::SharedReading& reading) {
  const std::lock_guard lock(mutex_);
  if (arrived_.size() == kArrivalLimit) arrived_.erase(arrived_.begin());
  arrived_.push_back({device, reading, WallClock::now()});
}

void RealLink::receive() noexcept {
  leave_signals_to_program();
  const virtual_time::Inside inside;
  try {
    for (;;) {
      session_->wait();
      session_->take(*this);
    }
  } catch (const std::exception& error) {
    note_loss(error.what());
  }
}

void RealLink::transmit() noexcept {
  leave_signals_to_program();
  const virtual_time::Inside inside;
  std::unique_lock lock(mutex_);
  try {
    for (;;) {
      changed_.wait(lock, [this] { return stopping_ || lost_ || !commands_.empty(); });
      if (lost_ || commands_.empty()) break;
      const auto commands = std::exchange(commands_, {});
      lock.unlock();
      for (const auto& [device, command] : commands) session_->send(device, command);
      lock.lock();
    }
  } catch (const std::exception& error) {
    // A session throws without the mutex.
    note_loss(error.what());
    lock.lock();
  }
  all_sent_ = true;
  changed_.notify_all();
}

void RealLink::keep_charge() noexcept {
  leave_signals_to_program();
  const virtual_time::Inside inside;
  // Three of four messages may be late.
  const auto period = wall(charge_.watchdog_s / 4.0);
  std::unique_lock lock(mutex_);
  try {
    while (!changed_.wait_for(lock, period, [this] { return stopping_ || lost_; })) {
      lock.unlock();
      const Charge charge = session_->request(charge_);
      lock.lock();
      stopped_ = stopped_ || charge.stopped;
    }
  } catch (const std::exception& error) {
    note_loss(error.what());  // a session throws without the mutex
  }
}

void RealLink::note_loss(const std::string& reason) noexcept {
  {
    const std::lock_guard lock(mutex_);
    if (lost_ || stopping_) return;
    lost_ = reason;
    commands_.clear();
    changed_.notify_all();
  }
  session_->close();
}

}  // namespace playerlike
