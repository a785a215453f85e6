// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/session/session.h"

namespace playerlike {

void Session::draw(std::span<const sim::DrawOperation> operations) {
  DrawQueue& queue = draw_queue();
  for (const sim::DrawOperation& operation : operations) {
    while (!queue.push(operation)) request(FlushDrawingsRequest{});
  }
}

}  // namespace playerlike
