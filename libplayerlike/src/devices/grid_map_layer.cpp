// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/client_core.h"
#include "core/errors.h"
#include "libCCMorse/GridMapLayer.h"
#include "sim/canvas/layers.h"
#include "sim/core/error.h"
#include "sim/io/map_file.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::translated;

namespace {

sim::Colour sim_colour(const ImageColour_t& c) { return {c.r, c.g, c.b, c.a}; }
ImageColour_t image_colour(const sim::Colour& c) { return {c.r, c.g, c.b, c.a}; }

// Converts a cell's number: bytes are divided by 255, doubles are fractions already.
double share_of(std::uint8_t number) { return number / 255.0; }
double share_of(double number) { return number; }

std::uint8_t byte_of(std::uint8_t number) { return number; }
std::uint8_t byte_of(double number) {
  return static_cast<std::uint8_t>(std::floor(std::clamp(number, 0.0, 1.0) * 255.0 + 0.5));
}

template <typename T>
T number_of_byte(std::uint8_t byte) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(byte / 255.0);
  } else {
    return byte;
  }
}

template <typename T>
T number_of_share(float share) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(share);
  } else {
    return byte_of(static_cast<double>(share));
  }
}

sim::CellValue occupancy(double share) {
  return sim::CellValue::of(static_cast<float>(std::clamp(share, 0.0, 1.0)));
}

template <typename T>
void require_numbers(const std::string& fun, const T* cells, std::size_t count) {
  if constexpr (std::is_floating_point_v<T>) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isnan(cells[i])) continue;
      playerlike::refuse(fun, "number " + std::to_string(i) + " of the list is NaN");
    }
  }
}

// Converts numbers to the cells of a layer; colours take 3 or 4 numbers per cell, others take 1.
template <typename T>
void convert(GridMapLayer::Kind kind, const T* numbers, std::size_t channels,
             std::vector<sim::CellValue>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const T* const cell = numbers + channels * i;
    switch (kind) {
      case GridMapLayer::BINARY:
        values[i] = sim::CellValue::of(cell[0] != T{});
        break;
      case GridMapLayer::GREY:
        values[i] = occupancy(share_of(cell[0]));
        break;
      case GridMapLayer::RGBA:
        values[i] =
            sim::CellValue::of(sim::Colour{byte_of(cell[0]), byte_of(cell[1]), byte_of(cell[2]),
                                           channels == 4 ? byte_of(cell[3]) : std::uint8_t{255}});
        break;
    }
  }
}

template <typename T>
void numbers_of(GridMapLayer::Kind kind, const std::vector<sim::CellValue>& values,
                std::vector<T>& numbers) {
  numbers.clear();
  numbers.reserve(values.size() * (kind == GridMapLayer::RGBA ? 4 : 1));
  for (const sim::CellValue& value : values) {
    switch (kind) {
      case GridMapLayer::BINARY:
        numbers.push_back(value.set() ? T{1} : T{0});
        break;
      case GridMapLayer::GREY:
        numbers.push_back(number_of_share<T>(value.occupancy()));
        break;
      case GridMapLayer::RGBA: {
        const sim::Colour c = value.colour();
        for (const std::uint8_t byte : {c.r, c.g, c.b, c.a}) {
          numbers.push_back(number_of_byte<T>(byte));
        }
        break;
      }
    }
  }
}

}  // namespace

struct GridMapLayer::Style {
  sim::LayerStyle value;
};

GridMapLayer::GridMapLayer(std::shared_ptr<playerlike::ClientCore> aCore, int aLayer, Kind aKind)
    : Drawing(std::move(aCore), "GridMapLayer", aLayer, static_cast<CellKind>(aKind)) {
  static_assert(static_cast<int>(RGBA) == static_cast<int>(COLOUR_CELLS) &&
                static_cast<int>(BINARY) == static_cast<int>(BINARY_CELLS) &&
                static_cast<int>(GREY) == static_cast<int>(GREY_CELLS));
  const Style style = GetStyle("GridMapLayer");
  mLastName = style.value.name;
  SetMarkColour(image_colour(style.value.colour));
}

GridMapLayer::~GridMapLayer() = default;

// --- Settings

GridMapLayer::Style GridMapLayer::GetStyle(const char* aFunction) const {
  RequireUsable(aFunction);
  const std::string fun = Fun(aFunction);
  const auto layers = translated(
      fun.c_str(), [&] { return Core()->session().request(playerlike::LayersRequest{}); });
  const auto it = std::find_if(layers.begin(), layers.end(),
                               [&](const sim::LayerInfo& l) { return l.id == LayerNumber(); });
  if (it == layers.end()) {  // another thread has removed it
    throw PlayerError(fun, "this layer was removed", PlayerError::kNotAvailable);
  }
  return {it->style};
}

template <typename Change>
void GridMapLayer::ChangeStyle(const char* aFunction, Change aChange) {
  const std::lock_guard lock(mStyleMutex);
  Style style = GetStyle(aFunction);
  aChange(style.value);
  translated(Fun(aFunction).c_str(), [&] {
    Core()->session().request(playerlike::SetLayerStyleRequest{LayerNumber(), style.value});
  });
  mLastName = style.value.name;
}

std::string GridMapLayer::GetName() const {
  const std::lock_guard lock(mStyleMutex);
  return mLastName;
}

void GridMapLayer::SetName(const std::string& aName) {
  ChangeStyle("SetName", [&](sim::LayerStyle& style) { style.name = aName; });
}

ImageColour_t GridMapLayer::GetColour() const { return MarkColour(); }

void GridMapLayer::SetOwnColour(const ImageColour_t& aColour) {
  ChangeStyle("SetColour", [&](sim::LayerStyle& style) { style.colour = sim_colour(aColour); });
  SetMarkColour(aColour);
}

void GridMapLayer::SetTransparency(double aTransparency) {
  if (std::isnan(aTransparency)) {
    playerlike::refuse(Fun("SetTransparency"), "the transparency is NaN");
  }
  ChangeStyle("SetTransparency", [&](sim::LayerStyle& style) {
    style.transparency = std::clamp(aTransparency, 0.0, 1.0);
  });
}

double GridMapLayer::GetTransparency() const {
  return GetStyle("GetTransparency").value.transparency;
}

void GridMapLayer::SetSeeThrough(bool aOn, const ImageColour_t& aColour) {
  ChangeStyle(aOn ? "SetTransparentColour" : "ResetTransparentColour", [&](sim::LayerStyle& style) {
    style.transparent_colour.reset();
    if (aOn) style.transparent_colour = sim_colour(aColour);
  });
}

void GridMapLayer::ResetTransparentColour() { SetSeeThrough(false, ImageColour_t()); }

bool GridMapLayer::HasTransparentColour() const {
  return GetStyle("HasTransparentColour").value.transparent_colour.has_value();
}

ImageColour_t GridMapLayer::GetTransparentColour() const {
  return image_colour(
      GetStyle("GetTransparentColour").value.transparent_colour.value_or(sim::Colour{}));
}

void GridMapLayer::SetPriority(int aPriority) {
  ChangeStyle("SetPriority", [&](sim::LayerStyle& style) { style.priority = aPriority; });
}

int GridMapLayer::GetPriority() const { return GetStyle("GetPriority").value.priority; }

void GridMapLayer::Show() {
  ChangeStyle("Show", [](sim::LayerStyle& style) { style.visible = true; });
}

void GridMapLayer::Hide() {
  ChangeStyle("Hide", [](sim::LayerStyle& style) { style.visible = false; });
}

bool GridMapLayer::IsVisible() const { return GetStyle("IsVisible").value.visible; }

// --- Cells

std::uint32_t GridMapLayer::OwnValue() const {
  return Cells() == GREY_CELLS     ? sim::CellValue::of(1.0F).bits
         : Cells() == BINARY_CELLS ? sim::CellValue::of(true).bits
                                   : ValueOf(MarkColour());
}

void GridMapLayer::RequireNumbers(const char* aFunction, const char* aInstead) const {
  if (GetKind() != RGBA) return;
  throw PlayerError(
      Fun(aFunction),
      std::string("the cells of this layer are colours, not numbers: use ") + aInstead,
      PlayerError::kNotAvailable);
}

void GridMapLayer::PutCell(int aX, int aY, double aValue) {
  RequireNumbers("SetCell", "SetPixel()");
  if (std::isnan(aValue)) require_numbers(Fun("SetCell"), &aValue, 1);
  PutPixel(aX, aY,
           (GetKind() == BINARY ? sim::CellValue::of(aValue != 0.0) : occupancy(aValue)).bits);
}

double GridMapLayer::GetCell(int aX, int aY) const {
  RequireNumbers("GetCell", "GetPixel()");
  const sim::CellValue value{CellAt(aX, aY, "GetCell")};
  return GetKind() == GREY ? static_cast<double>(value.occupancy()) : value.set() ? 1.0 : 0.0;
}

template <typename T>
void GridMapLayer::PutAll(const T* aCells, std::size_t aCount) {
  RequireUsable("SetCells");
  const std::string fun = Fun("SetCells");
  const int width = GetWidth();
  const int height = GetHeight();
  const std::size_t cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const bool fits =
      GetKind() == RGBA ? aCount == 3 * cells || aCount == 4 * cells : aCount == cells;
  if (aCells == nullptr || !fits) {
    playerlike::refuse(fun, "the grid-map has " + std::to_string(width) + " x " +
                                std::to_string(height) + " = " + std::to_string(cells) + " cells" +
                                (GetKind() == RGBA ? " of 3 (RGB) or 4 (RGBA) numbers each" : "") +
                                ", but " +
                                (aCells == nullptr ? std::string("a null pointer was")
                                                   : std::to_string(aCount) + " numbers were") +
                                " given");
  }
  require_numbers(fun, aCells, aCount);
  std::vector<sim::CellValue> values = Core()->list_of_cells(cells);
  convert(GetKind(), aCells, aCount / cells, values);
  translated(fun.c_str(), [&] {
    Core()->set_cells(LayerNumber(), {0, 0, width, height}, std::move(values));
  });
}

template <typename T>
void GridMapLayer::TakeAll(std::vector<T>& aCells) const {
  RequireUsable("GetCells");
  numbers_of(GetKind(),
             translated(Fun("GetCells").c_str(),
                        [&] {
                          return Core()->session().request(playerlike::CellsRequest{LayerNumber()});
                        }),
             aCells);
}

void GridMapLayer::PutCells(const std::uint8_t* aCells, std::size_t aCount) {
  PutAll(aCells, aCount);
}
void GridMapLayer::PutCells(const float* aCells, std::size_t aCount) { PutAll(aCells, aCount); }
void GridMapLayer::PutCells(const double* aCells, std::size_t aCount) { PutAll(aCells, aCount); }
void GridMapLayer::TakeCells(std::vector<std::uint8_t>& aCells) const { TakeAll(aCells); }
void GridMapLayer::TakeCells(std::vector<float>& aCells) const { TakeAll(aCells); }
void GridMapLayer::TakeCells(std::vector<double>& aCells) const { TakeAll(aCells); }

// --- Files

void GridMapLayer::SaveImage(const std::string& aName, int aScale) const {
  RequireUsable("SaveImage");
  translated(Fun("SaveImage").c_str(), [&] {
    Core()->session().request(playerlike::SaveImageRequest{aName, aScale, LayerNumber()});
  });
}

void GridMapLayer::RequireGrey(const char* aFunction) const {
  RequireUsable(aFunction);
  if (GetKind() == GREY) return;
  throw PlayerError(Fun(aFunction),
                    "maps are of occupancies, which only layers of the kind GREY hold",
                    PlayerError::kNotAvailable);
}

void GridMapLayer::SaveMap(const std::string& aName, MapMode aMode) const {
  RequireGrey("SaveMap");
  translated(Fun("SaveMap").c_str(), [&] {
    Core()->session().request(playerlike::SaveMapRequest{
        LayerNumber(), aName,
        aMode == SCALE ? sim::io::MapMode::kScale : sim::io::MapMode::kTrinary});
  });
}

int GridMapLayer::LoadMap(const std::string& aFile) {
  RequireGrey("LoadMap");
  const std::string fun = Fun("LoadMap");
  sim::OccupancyMap map;
  try {
    map = sim::io::read_map(aFile);
  } catch (const sim::ConfigError& e) {
    playerlike::refuse(fun, e.what());
  }
  // Maps each column and row of the canvas to one of the map; -1: outside of the map.
  const playerlike::CanvasInfo canvas = Core()->session().request(playerlike::CanvasInfoRequest{});
  const auto places = [&](int cells, double origin, int places_there, double map_origin) {
    std::vector<int> there(static_cast<std::size_t>(cells), -1);
    for (int i = 0; i < cells; ++i) {
      const double middle = origin + (i + 0.5) * canvas.cell_size_m;
      const double place = std::floor((middle - map_origin) / map.cell_size_m);
      if (place >= 0.0 && place < places_there) {
        there[static_cast<std::size_t>(i)] = static_cast<int>(place);
      }
    }
    return there;
  };
  const std::vector<int> columns =
      places(canvas.width, canvas.origin_x_m, map.width, map.origin.x());
  std::vector<int> rows =  // rows counted from the bottom
      places(canvas.height, canvas.origin_y_m, map.height, map.origin.y());
  const auto covered = [](const std::vector<int>& there) {
    const auto is_in = [](int place) { return place >= 0; };
    const auto first = std::find_if(there.begin(), there.end(), is_in);
    const auto end = std::find_if_not(first, there.end(), is_in);
    return std::pair(static_cast<int>(first - there.begin()), static_cast<int>(end - first));
  };
  std::reverse(rows.begin(), rows.end());
  const auto [left, width] = covered(columns);
  const auto [top, height] = covered(rows);
  std::vector<sim::CellValue> values;
  values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = top; row < top + height; ++row) {
    const int map_row = map.height - 1 - rows[static_cast<std::size_t>(row)];
    for (int column = left; column < left + width; ++column) {
      values.push_back(
          sim::CellValue::of(map.at(columns[static_cast<std::size_t>(column)], map_row)));
    }
  }
  const sim::CellRect rect{left, top, width, height};
  translated(fun.c_str(), [&] {
    Core()->session().request(playerlike::SetCellsRequest{LayerNumber(), rect, std::move(values)});
  });
  return width * height;
}

}  // namespace CCMorse
