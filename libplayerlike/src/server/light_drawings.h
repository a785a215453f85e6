// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "server/worker_thread.h"
#include "sim/canvas/layers.h"

namespace playerlike::server {

/// Light drawings of a session wait in its draw queue for the next step or the next access to the
/// canvas, like those of embedded programs. Each session has a share of what all of them may write
/// in a step, so that the sum stays small. The worker thread executes the others.
class LightDrawings {
 public:
  /// Queues drawings, without those that a later fill covers, if they are light.
  /// @param sessions  number of sessions that may draw.
  /// @return false: they are not. The caller must have them executed by EventClient::draw_some(),
  ///     which also empties the queue.
  bool queue(Session& session, std::vector<sim::DrawOperation>& drawings, std::size_t sessions) {
    if (drawings.empty()) return true;
    const CanvasInfo canvas = session.request(CanvasInfoRequest{});
    sim::drop_covered(drawings);
    std::size_t cells = 0;
    for (const sim::DrawOperation& drawing : drawings) {
      cells += sim::cells_written(drawing, canvas.width, canvas.height);
    }
    const std::size_t share = kStepCells / std::max<std::size_t>(sessions, 1);
    if (queued_cells_ + cells > std::min(share, 4 * kInlineCells)) {
      queued_cells_ = 0;
      return false;
    }
    queued_cells_ += cells;
    session.draw(drawings);
    return true;
  }
  /// A step has executed the queued drawings.
  void note_step() noexcept { queued_cells_ = 0; }

 private:
  /// Cells that the drawings of all sessions may write in a step, without the worker thread's.
  static constexpr std::size_t kStepCells = std::size_t{1} << 20U;

  std::size_t queued_cells_ = 0;
};

}  // namespace playerlike::server
