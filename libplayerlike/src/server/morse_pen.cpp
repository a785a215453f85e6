// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests of MORSE's protocol to a pen, about the canvas.
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "server/morse_services.h"
#include "sim/world/view_mode.h"

namespace playerlike::server {
namespace {

using nlohmann::json;
using Right = MorseService::Right;

constexpr int kLeastCell = std::numeric_limits<int>::min();
constexpr int kMostCell = std::numeric_limits<int>::max();

std::uint8_t channel(const MorseArguments& arguments, std::size_t index,
                     std::optional<int> otherwise = {}) {
  return static_cast<std::uint8_t>(arguments.integer(index, 0, 255, otherwise));
}

// Red, green, blue and optionally alpha, from the argument `first` on.
sim::CellValue colour_from(const MorseArguments& arguments, std::size_t first) {
  return sim::CellValue::of(sim::Colour{channel(arguments, first), channel(arguments, first + 1),
                                        channel(arguments, first + 2),
                                        channel(arguments, first + 3, 255)});
}

// Maximum number of cells that get_image_data lists.
constexpr std::size_t kMostListedCells = std::size_t{1} << 22U;

template <json (*kPen)(const PenCall&)>
json here(MorseCall& call) {
  return kPen({*call.state.client(), call.arguments});
}

json draw(EventClient& client, std::vector<sim::DrawOperation> operations) {
  DrawWork work{std::move(operations), {}};
  while (!client.draw_some(work, kSliceCells)) {
  }
  return nullptr;
}

json set_pixel(MorseCall& call) {
  sim::DrawOperation pixel;
  pixel.x0 = call.arguments.integer(0, kLeastCell, kMostCell);
  pixel.y0 = call.arguments.integer(1, kLeastCell, kMostCell);
  pixel.value = colour_from(call.arguments, 2);
  return draw(*call.state.client(), {pixel});
}

json set_line(MorseCall& call) {
  sim::DrawOperation line;
  line.kind = sim::DrawOperation::Kind::kLine;
  line.x0 = call.arguments.integer(0, kLeastCell, kMostCell);
  line.y0 = call.arguments.integer(1, kLeastCell, kMostCell);
  line.x1 = call.arguments.integer(2, kLeastCell, kMostCell);
  line.y1 = call.arguments.integer(3, kLeastCell, kMostCell);
  line.value = colour_from(call.arguments, 4);
  return draw(*call.state.client(), {line});
}

json clear(const PenCall& call) {
  sim::DrawOperation fill;
  fill.kind = sim::DrawOperation::Kind::kFill;
  return draw(call.client, {fill});
}

json get_pixel(MorseCall& call) {
  const int column = call.arguments.integer(0, kLeastCell, kMostCell);
  const int row = call.arguments.integer(1, kLeastCell, kMostCell);
  const auto cell = call.state.session().request(CellRequest{sim::kBaseLayer, column, row});
  if (!cell) return nullptr;
  const sim::Colour c = cell->colour();
  return json::array({c.r, c.g, c.b, c.a});
}

json get_image_data(const PenCall& call) {
  const int channels = call.arguments.integer(0, 3, 4, 3);
  if (canvas_cells(call.client.session()) > kMostListedCells) {
    throw MorseRefusal("the canvas has more than " + std::to_string(kMostListedCells) +
                       " cells, too many for a list of numbers: get_pixel has single cells, "
                       "save_image_copy the picture, and so has Playpen's own protocol");
  }
  json::array_t data;
  const auto cells = call.client.session().request(CellsRequest{sim::kBaseLayer});
  data.reserve(cells.size() * static_cast<std::size_t>(channels));
  for (const sim::CellValue& cell : cells) {
    const sim::Colour c = cell.colour();
    data.insert(data.end(), {c.r, c.g, c.b});
    if (channels == 4) data.emplace_back(c.a);
  }
  return data;
}

// Red, green, blue and optionally alpha, from the list element `first` on.
sim::CellValue colour_in(const MorseArguments& arguments, const json& list, std::size_t first,
                         bool has_alpha) {
  const auto channel = [&](std::size_t i) {
    const json& value = list[first + i];
    if (!value.is_number_integer() || value < 0 || value > 255) {
      arguments.refuse(0, "whole numbers from 0 to 255 as colours, but there is " + shown(value));
    }
    return value.get<std::uint8_t>();
  };
  sim::Colour c{channel(0), channel(1), channel(2)};
  if (has_alpha) c.a = channel(3);
  return sim::CellValue::of(c);
}

json set_image_data(MorseCall& call) {
  const json& data = call.arguments.list(0);
  Session& session = call.state.session();
  const CanvasInfo canvas = session.request(CanvasInfoRequest{});
  const auto count =
      static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
  if (data.size() != 3 * count && data.size() != 4 * count) {
    call.arguments.refuse(0, "a list of 3 or 4 numbers for each of the canvas's " +
                                 std::to_string(canvas.width) + " x " +
                                 std::to_string(canvas.height) + " cells, but it has " +
                                 std::to_string(data.size()));
  }
  const std::size_t channels = data.size() / count;
  std::vector<sim::CellValue> cells(count);
  for (std::size_t i = 0; i < count; ++i) {
    cells[i] = colour_in(call.arguments, data, channels * i, channels == 4);
  }
  session.request(
      SetCellsRequest{sim::kBaseLayer, {0, 0, canvas.width, canvas.height}, std::move(cells)});
  return nullptr;
}

json update_image_data(MorseCall& call) {
  std::vector<sim::DrawOperation> pixels;
  for (const json& entry : call.arguments.list(0)) {
    const bool sound =
        entry.is_array() && (entry.size() == 5 || entry.size() == 6) &&
        std::all_of(entry.begin(), entry.end(), [](const json& number) {
          return number.is_number_integer() && number >= kLeastCell && number <= kMostCell;
        });
    if (!sound) {
      call.arguments.refuse(
          0, "a list of [x, y, r, g, b] or [x, y, r, g, b, a], but there is " + shown(entry));
    }
    sim::DrawOperation& pixel = pixels.emplace_back();
    pixel.x0 = entry[0].get<int>();
    pixel.y0 = entry[1].get<int>();
    pixel.value = colour_in(call.arguments, entry, 2, entry.size() == 6);
  }
  return draw(*call.state.client(), std::move(pixels));
}

json size_of_canvas(const PenCall& call) {
  const CanvasInfo canvas = call.client.session().request(CanvasInfoRequest{});
  return json::array({canvas.width, canvas.height});
}

json resize_canvas(const PenCall& call) {
  call.client.session().request(
      ResizeCanvasRequest{call.arguments.integer(0, 1, 8192), call.arguments.integer(1, 1, 8192)});
  return size_of_canvas(call);
}

json get_cell_size(MorseCall& call) {
  return call.state.session().request(CanvasInfoRequest{}).cell_size_m;
}

json save_image_copy(const PenCall& call) {
  call.client.session().request(SaveImageRequest{call.arguments.text(0)});
  return nullptr;
}

json get_view_mode(MorseCall& call) {
  return std::string(sim::to_string(call.state.session().request(ViewModeRequest{})));
}

json set_view_mode(MorseCall& call) {
  const auto chosen = sim::parse_view_mode(call.arguments.text(0));
  if (!chosen) call.arguments.refuse(0, "ground, mini-map or full-screen");
  call.state.session().request(SetViewModeRequest{*chosen});
  return nullptr;
}

constexpr MorseService kPen[] = {
    {"set_pixel", "x, y, r, g, b, a=255", Right::kRobot, set_pixel},
    {"get_pixel", "x, y", Right::kConnect, get_pixel},
    {"set_line", "x0, y0, x1, y1, r, g, b, a=255", Right::kRobot, set_line},
    {"get_image_data", "channels=3", Right::kConnect, here<get_image_data>, get_image_data},
    {"set_image_data", "data", Right::kRobot, set_image_data},
    {"update_image_data", "pixels", Right::kRobot, update_image_data},
    {"clear", "", Right::kRobot, here<clear>, clear},
    {"get_canvas_size", "", Right::kConnect, here<size_of_canvas>},
    {"resize_canvas", "width, height", Right::kRobot, here<resize_canvas>, resize_canvas, false,
     true},
    {"get_cell_size", "", Right::kConnect, get_cell_size},
    {"save_image_copy", "name", Right::kRobot, here<save_image_copy>, save_image_copy},
    {"get_view_mode", "", Right::kConnect, get_view_mode},
    {"set_view_mode", "mode", Right::kRobot, set_view_mode},
};

}  // namespace

std::span<const MorseService> pen_services() { return kPen; }

}  // namespace playerlike::server
