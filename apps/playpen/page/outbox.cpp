// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "outbox.h"

#include <algorithm>
#include <utility>

namespace playpen::page {

void Outbox::watch() {
  if (state_ == State::kStranger) state_ = State::kWaiting;
}

void Outbox::drop_parts() {
  if (items_.size() < 2) return;
  // The first message may be half sent.
  const auto kept = std::remove_if(items_.begin() + 1, items_.end(),
                                   [](const Item& item) { return !item.is_text; });
  items_.erase(kept, items_.end());
  waiting_bytes_ = 0;
  for (auto item = items_.begin() + 1; item != items_.end(); ++item) {
    waiting_bytes_ += item->bytes->size();
  }
}

void Outbox::add_whole(const Bytes& whole, bool for_all) {
  if (state_ == State::kStranger || (state_ != State::kWaiting && !for_all)) return;
  drop_parts();
  if (!items_.empty()) waiting_bytes_ += whole->size();
  items_.push_back({whole, false, false, {}});
  state_ = State::kCurrent;
}

void Outbox::add_part(const Bytes& part, Clock::time_point now) {
  if (state_ != State::kCurrent) return;
  const auto oldest = items_.empty() ? items_.end()
                                     : std::find_if(items_.begin() + 1, items_.end(),
                                                    [](const Item& item) { return item.is_part; });
  const bool is_late =
      most_time_.count() > 0 && oldest != items_.end() && now - oldest->since > most_time_;
  if (is_late || (!items_.empty() && waiting_bytes_ + part->size() > most_bytes_)) {
    drop_parts();
    state_ = State::kBehind;
    return;
  }
  if (!items_.empty()) waiting_bytes_ += part->size();
  items_.push_back({part, false, true, now});
}

bool Outbox::add_text(std::string text) {
  if (!items_.empty() && waiting_bytes_ + text.size() > most_bytes_) return false;
  if (!items_.empty()) waiting_bytes_ += text.size();
  items_.push_back({std::make_shared<const std::string>(std::move(text)), true, false, {}});
  return true;
}

void Outbox::pop() {
  items_.pop_front();
  if (!items_.empty()) waiting_bytes_ -= items_.front().bytes->size();
  if (items_.empty() && state_ == State::kBehind) state_ = State::kWaiting;
}

void Outbox::end_watching() {
  drop_parts();
  state_ = State::kStranger;
}

}  // namespace playpen::page
