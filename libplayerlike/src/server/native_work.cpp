// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/native_work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host/object_properties.h"
#include "protocol/codec.h"
#include "server/workshop.h"
#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"

namespace playerlike::server {
namespace {

using protocol::json;

constexpr int kMaxSide = 1 << 14;  // of a rectangle; canvases have no more than 8192
// Cells of a map at most.
constexpr double kMaxMapCells = 1 << 22;

int scale_of(const json& request) {
  if (!request.contains("scale")) return 1;
  return static_cast<int>(protocol::require_integer(request, "scale", -kMaxCell, kMaxCell));
}

// The arena never changes; a copy is worked on without the simulation.
sim::ArenaDescription arena_of(Host& host) {
  sim::ArenaDescription arena;
  host.with_simulation([&](sim::Simulation& simulation) { arena = simulation.world().arena; });
  return arena;
}

json cells(const NativeSubject& subject, const json& request) {
  const std::vector<sim::CellValue> cells = subject.session.cells(require_layer(request));
  return {{"cells", protocol::encode_cells(cells, subject.encoding)}};
}

json canvas_image(const NativeSubject& subject, const json& /*request*/) {
  json answer = {{"image", protocol::bytes(subject.session.canvas_image(), subject.encoding)}};
  answer["canvas"] = protocol::encode_canvas(subject.session.canvas_info());
  return answer;
}

json resize_canvas(const NativeSubject& subject, const json& request) {
  const auto side = [&](const char* key) {
    return static_cast<int>(protocol::require_integer(request, key, -kMaxCell, kMaxCell));
  };
  subject.session.resize_canvas(side("width"), side("height"));
  return {{"canvas", protocol::encode_canvas(subject.session.canvas_info())}};
}

json save_image(const NativeSubject& subject, const json& request) {
  const auto scale = scale_of(request);
  std::optional<sim::LayerId> layer;
  if (request.contains("layer")) layer = require_layer(request);
  subject.session.save_image(protocol::require_text(request, "name"), scale, layer);
  return json::object();
}

json save_map(const NativeSubject& subject, const json& request) {
  sim::io::MapMode mode = sim::io::MapMode::kTrinary;
  if (request.contains("mode")) {
    const auto named = sim::io::parse_map_mode(protocol::require_text(request, "mode"));
    if (!named) protocol::refuse_value("mode", "trinary or scale", request["mode"]);
    mode = *named;
  }
  subject.session.save_map(require_layer(request), protocol::require_text(request, "name"), mode);
  return json::object();
}

json map_tile(const NativeSubject& subject, double cell_size_m, const sim::CellRect& tile) {
  const sim::ArenaDescription arena = arena_of(subject.host);
  const sim::CanvasDescription grid = map_grid(arena, cell_size_m);
  const int right = std::clamp(tile.column + tile.width, 0, grid.width);
  const int bottom = std::clamp(tile.row + tile.height, 0, grid.height);
  const int left = std::clamp(tile.column, 0, right);
  const int top = std::clamp(tile.row, 0, bottom);
  sim::CanvasDescription part = grid;
  part.width = right - left;
  part.height = bottom - top;
  part.origin += cell_size_m * sim::Vec2(left, grid.height - bottom);
  sim::OccupancyMap map;
  if (part.width > 0 && part.height > 0) map = sim::true_map(arena, part);
  if (map.cells.empty()) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "the map has no such tile: it has " + std::to_string(grid.width) + " x " +
                           std::to_string(grid.height) + " cells");
  }
  return {{"map", protocol::encode_map(map, subject.encoding)},
          {"width", grid.width},
          {"height", grid.height},
          {"origin", protocol::encode_pose({grid.origin.x(), grid.origin.y(), 0.0})}};
}

json world_map(const NativeSubject& subject, const json& request) {
  const double cell_size_m = protocol::require_number(request, "cell_size");
  if (request.contains("tile")) {
    const sim::CellRect tile = require_rect(request, "tile");
    if (static_cast<double>(tile.width) * tile.height > kMaxMapCells) {
      protocol::refuse_value("tile", "at most 4194304 cells", request["tile"]);
    }
    return map_tile(subject, cell_size_m, tile);
  }
  const sim::Vec2 arena_m = arena_of(subject.host).size;
  if (cell_size_m > 0.0 && (arena_m / cell_size_m).prod() > kMaxMapCells) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a server makes maps of up to 4194304 cells: a cell of this arena must be " +
                           sim::rounded_text(std::sqrt(arena_m.prod() / kMaxMapCells), 6) +
                           " m long at least, unless the map is asked for in tiles");
  }
  return {{"map", protocol::encode_map(subject.session.world_map(cell_size_m), subject.encoding)}};
}

json log(const NativeSubject& subject, const json& request) {
  LogControl changes;
  if (request.contains("file")) changes.file = protocol::require_text(request, "file");
  if (request.contains("replay")) changes.replay = protocol::require_bool(request, "replay");
  if (request.contains("rewind")) changes.rewind = protocol::require_bool(request, "rewind");
  if (request.contains("running")) changes.running = protocol::require_bool(request, "running");
  return {{"log", protocol::encode_log(subject.session.control_log(changes))}};
}

struct Row {
  std::string_view name;
  NativeWork work;
};
constexpr std::array kRows{Row{"cells", cells},
                           Row{"canvas_image", canvas_image},
                           Row{"resize_canvas", resize_canvas},
                           Row{"save_image", save_image},
                           Row{"save_map", save_map},
                           Row{"world_map", world_map},
                           Row{"log", log}};

}  // namespace

sim::LayerId require_layer(const json& request) {
  return static_cast<sim::LayerId>(protocol::require_integer(request, "layer", 0, kMaxCell));
}

sim::CellRect require_rect(const json& request, const char* key) {
  const json& rect = protocol::require(request, key);
  if (!rect.is_array() || rect.size() != 4) {
    protocol::refuse_value(key, "[column, row, width, height]", rect);
  }
  const auto number = [&](std::size_t i, std::int64_t least, std::int64_t most) {
    return static_cast<int>(protocol::require_integer({{key, rect[i]}}, key, least, most));
  };
  return {number(0, -kMaxCell, kMaxCell), number(1, -kMaxCell, kMaxCell), number(2, 0, kMaxSide),
          number(3, 0, kMaxSide)};
}

NativeWork find_native_work(std::string_view name) noexcept {
  const auto* const row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.name == name; });
  return row == kRows.end() ? nullptr : row->work;
}

std::size_t native_work_cells(const NativeSubject& subject, const json& request,
                              std::string_view name) {
  if (name == "world_map") {
    const sim::Vec2 arena_m = arena_of(subject.host).size;
    const double cell_size_m = protocol::require_number(request, "cell_size");
    double cells = (arena_m / std::max(cell_size_m, 1e-9)).prod();
    if (request.contains("tile")) {
      const sim::CellRect tile = require_rect(request, "tile");
      cells = std::min(cells, static_cast<double>(tile.width) * tile.height);
    }
    return static_cast<std::size_t>(std::clamp(cells, 0.0, kMaxMapCells));
  }
  // A log that begins may have to be read first, and be long.
  if (name == "log") return request.contains("running") ? kLightCells + 1 : 0;
  const auto cells_of = [](std::int64_t width, std::int64_t height) {
    return static_cast<std::size_t>(std::max<std::int64_t>(width, 0) *
                                    std::max<std::int64_t>(height, 0));
  };
  const CanvasInfo canvas = subject.session.canvas_info();
  const std::size_t now = cells_of(canvas.width, canvas.height);
  if (name == "resize_canvas") {
    return now + cells_of(protocol::require_integer(request, "width", -kMaxCell, kMaxCell),
                          protocol::require_integer(request, "height", -kMaxCell, kMaxCell));
  }
  if (name != "save_image") return now;
  const auto scale = static_cast<std::size_t>(std::clamp(scale_of(request), 1, 1 << 10));
  return now * scale * scale;
}

std::size_t native_answer_bytes(const NativeSubject& subject, std::string_view name) {
  if (name != "cells" && name != "canvas_image") return 0;
  const CanvasInfo canvas = subject.session.canvas_info();
  const std::size_t bytes = sizeof(sim::CellValue) * static_cast<std::size_t>(canvas.width) *
                            static_cast<std::size_t>(canvas.height);
  return subject.encoding == protocol::Encoding::kCbor ? bytes : bytes / 3 * 4;
}

}  // namespace playerlike::server
