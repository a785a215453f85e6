// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/process/thinker.h"

#include <atomic>

namespace playerlike {
namespace {

constinit thread_local ThinkerId own_thinker = 0;

}  // namespace

ThinkerId new_thinker() noexcept {
  static std::atomic<ThinkerId> last{0};
  return ++last;
}

ThinkerId this_thinker() noexcept {
  if (own_thinker == 0) own_thinker = new_thinker();
  return own_thinker;
}

bool is_thinker() noexcept { return own_thinker != 0; }

void set_this_thinker(ThinkerId thinker) noexcept { own_thinker = thinker; }

}  // namespace playerlike
