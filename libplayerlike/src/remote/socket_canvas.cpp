// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The canvas of a socket session, and requests whose cells do not fit one message.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "playerlike/session/layer_registry.h"
#include "protocol/request_codec.h"
#include "remote/message_sender.h"
#include "remote/socket_session.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

// Room in a message for everything except the cells [bytes].
constexpr std::size_t kMessageOverhead = 512;
// Maximum side of a rectangle in a message [cells].
constexpr std::size_t kMaxMapSide = 8192;
// Sides of the tiles in which maps are fetched [cells]; a tile takes 4 MiB.
constexpr int kTileSide = 1024;

}  // namespace

DrawQueue& SocketSession::draw_queue() noexcept { return sender_->drawings(); }

std::uint64_t SocketSession::canvas_generation() const noexcept {
  return canvas_generation_.load(std::memory_order_acquire);
}

void SocketSession::set_cells(const SetCellsRequest& what) const {
  const sim::CellRect& rect = what.rect;
  require_cells(rect, what.cells.size());
  const std::shared_ptr<Connection> connection = sender_->connection();
  const protocol::Encoding encoding = connection->encoding();
  // Pieces must fit a message: whole rows if possible, otherwise parts of rows.
  const std::size_t most =
      std::max<std::size_t>((connection->message_limit() - kMessageOverhead) /
                                (encoding == protocol::Encoding::kCbor ? 4 : 6),
                            1);
  const auto width = static_cast<std::size_t>(rect.width);
  const std::size_t most_columns = std::min({width, most, kMaxMapSide});
  const auto columns = static_cast<int>(most_columns);
  const auto rows =
      static_cast<int>(std::min({most / std::max<std::size_t>(most_columns, 1), kMaxMapSide,
                                 static_cast<std::size_t>(rect.height)}));
  const std::span<const sim::CellValue> values = what.cells;
  if (values.empty()) return set_cells(what.layer, rect, values);  // it may be refused
  std::vector<sim::CellValue> cells;
  for (int row = 0; row < rect.height; row += rows) {
    for (int column = 0; column < rect.width; column += columns) {
      const sim::CellRect part{rect.column + column, rect.row + row,
                               std::min(columns, rect.width - column),
                               std::min(rows, rect.height - row)};
      const auto lines = values.subspan(static_cast<std::size_t>(row) * width);
      if (part.width == rect.width) {
        set_cells(what.layer, part, lines.first(static_cast<std::size_t>(part.height) * width));
        continue;
      }
      cells.clear();
      for (int i = 0; i < part.height; ++i) {
        const auto line =
            lines.subspan(static_cast<std::size_t>(i) * width + static_cast<std::size_t>(column),
                          static_cast<std::size_t>(part.width));
        cells.insert(cells.end(), line.begin(), line.end());
      }
      set_cells(what.layer, part, cells);
    }
  }
}

void SocketSession::set_cells(sim::LayerId layer, const sim::CellRect& rect,
                              std::span<const sim::CellValue> cells) const {
  if (accepts_cells(layer)) {
    with_connection([&] {
      sender_->tell([&](protocol::Encoding encoding, std::string& out) {
        protocol::append_set_cells_request(layer, rect, cells, encoding, out);
      });
    });
    return throw_async_error();
  }
  const std::shared_ptr<Connection> connection = sender_->connection();
  const protocol::Encoding encoding = connection->encoding();
  static_cast<void>(ask(protocol::encode_request(
      SetCellsRequest{layer, rect, {cells.begin(), cells.end()}}, encoding)));
  const Lock lock(mutex_);
  if (sender_->connection() != connection) return;  // the answer may be that of another server
  if (layers_of_ != connection) layers_.clear();
  layers_of_ = connection;
  layers_.insert(layer);
}

bool SocketSession::accepts_cells(sim::LayerId layer) const {
  const std::shared_ptr<const Connection> connection = sender_->connection();
  const Lock lock(mutex_);
  return layers_of_ == connection && layers_.contains(layer);
}

void SocketSession::forget_layers() const {
  const Lock lock(mutex_);
  layers_.clear();
}

WorldMap SocketSession::world_map(double cell_size_m) const {
  if (!(cell_size_m > 0.0 && std::isfinite(cell_size_m))) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "the cell size of a map is a positive number [m], but is " +
                           sim::rounded_text(cell_size_m, 6));
  }
  const auto fetch = [&](int column, int row) {
    auto tile = std::get<WorldMap>(
        ask_for(WorldMapRequest{cell_size_m, sim::CellRect{column, row, kTileSide, kTileSide}}));
    if (tile.width && tile.height && tile.origin) return tile;
    throw misunderstood("map: not a tile");
  };
  WorldMap tile = fetch(0, 0);
  const int width = *tile.width;
  const int height = *tile.height;
  if (tile.map.width == width && tile.map.height == height)
    return {std::move(tile.map), {}, {}, {}};
  sim::OccupancyMap map;
  map.width = width;
  map.height = height;
  map.cell_size_m = tile.map.cell_size_m;
  map.origin = tile.origin->position();
  map.cells.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; row += kTileSide) {
    for (int column = 0; column < width; column += kTileSide) {
      if (row > 0 || column > 0) tile = fetch(column, row);
      const sim::OccupancyMap& part = tile.map;
      if (part.width != std::min(kTileSide, width - column) ||
          part.height != std::min(kTileSide, height - row)) {
        throw misunderstood("map: not the tile asked for");
      }
      for (int y = 0; y < part.height; ++y) {
        std::copy_n(part.cells.begin() + static_cast<std::ptrdiff_t>(y) * part.width, part.width,
                    map.cells.begin() + static_cast<std::ptrdiff_t>(row + y) * width + column);
      }
    }
  }
  return {std::move(map), {}, {}, {}};
}

}  // namespace playerlike
