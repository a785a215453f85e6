// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/native_work.h"

#include <algorithm>
#include <variant>

#include "server/worker_thread.h"
#include "sim/simulation/simulation.h"

namespace playerlike::server {
namespace {

std::size_t cells_of(std::int64_t width, std::int64_t height) {
  return static_cast<std::size_t>(std::max<std::int64_t>(width, 0) *
                                  std::max<std::int64_t>(height, 0));
}

struct WorkCells {
  Session& session;
  Host& host;

  std::size_t operator()(const CellsRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const CanvasImageRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const SaveMapRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const CreateLayerRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const RemoveLayerRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const SaveStateRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const RestoreStateRequest&) const { return canvas_cells(session); }
  std::size_t operator()(const ResizeCanvasRequest& what) const {
    return canvas_cells(session) + cells_of(what.width, what.height);
  }
  std::size_t operator()(const SaveImageRequest& what) const {
    const auto scale = static_cast<std::size_t>(std::clamp(what.scale, 1, 1 << 10));
    return canvas_cells(session) * scale * scale;
  }
  std::size_t operator()(const WorldMapRequest& what) const {
    double cells = (native_arena_m(host) / std::max(what.cell_size_m, 1e-9)).prod();
    if (what.tile)
      cells = std::min(cells, static_cast<double>(what.tile->width) * what.tile->height);
    return static_cast<std::size_t>(std::clamp(cells, 0.0, kMaxMapCells));
  }
  // A new log may have to read an existing, long file first.
  std::size_t operator()(const LogRequest& what) const {
    return what.running ? kInlineCells + 1 : 0;
  }
  template <typename One>
  std::size_t operator()(const One&) const {
    return 0;
  }
};

}  // namespace

sim::Vec2 native_arena_m(Host& host) {
  return host.with_simulation(
      [](const sim::Simulation& simulation) { return simulation.world().arena.size; });
}

std::size_t native_work_cells(const Request& request, Session& session, Host& host) {
  return std::visit(WorkCells{session, host}, request);
}

std::size_t native_answer_bytes(const Request& request, Session& session,
                                protocol::Encoding encoding) {
  if (!std::holds_alternative<CellsRequest>(request) &&
      !std::holds_alternative<CanvasImageRequest>(request)) {
    return 0;
  }
  const std::size_t bytes = sizeof(sim::CellValue) * canvas_cells(session);
  return encoding == protocol::Encoding::kCbor ? bytes : bytes / 3 * 4;
}

}  // namespace playerlike::server
