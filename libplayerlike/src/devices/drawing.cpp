// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libCCMorse/Drawing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/client_core.h"
#include "core/errors.h"
#include "session/canvas_cells.h"
#include "sim/canvas/layers.h"
#include "sim/core/colour.h"
#include "sim/core/number_text.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::translated;

namespace detail {

std::uint8_t channel_of_unusual_share(double share) {
  playerlike::require_finite("Drawing", {{"a colour's channel", share}});
  return share > 0.5 ? 255 : 0;
}

ImageColour_t colour_of_text(const std::string& text) {
  const auto c = sim::parse_colour(text);
  if (!c) {
    playerlike::refuse("Drawing",
                       "\"" + text +
                           "\" is no colour; colours are written \"#34AAFF\", \"#3AF\" or, "
                           "with alpha, \"#34AAFF80\"");
  }
  return {c->r, c->g, c->b, c->a};
}

std::string text_of_colour(const ImageColour_t& c) {
  return sim::to_string(sim::Colour{c.r, c.g, c.b, c.a});
}

}  // namespace detail

namespace {

constexpr std::pair<ViewMode, sim::ViewMode> kModes[] = {
    {GROUND, sim::ViewMode::kGround},
    {MINI_MAP, sim::ViewMode::kMiniMap},
    {FULL_SCREEN, sim::ViewMode::kFullScreen},
};

static_assert(sizeof(ImageColour_t) == sizeof(sim::CellValue), "colours are copied as cells");
static_assert(std::bit_cast<std::uint32_t>(sim::Colour{1, 2, 3, 4}) == 0x04030201U,
              "Drawing::ValueOf() puts the red channel into the lowest byte");

std::uint32_t bits_of_colour(const ImageColour_t& c) {
  return sim::CellValue::of(sim::Colour{c.r, c.g, c.b, c.a}).bits;
}

ImageColour_t colour_of_bits(std::uint32_t bits) {
  const sim::Colour c = sim::CellValue{bits}.colour();
  return {c.r, c.g, c.b, c.a};
}

// Drops the alpha channel of RGBA bytes if three channels are wanted.
std::vector<std::uint8_t> with_channels(const char* fun, std::vector<std::uint8_t> rgba,
                                        int channels) {
  if (channels == 4) return rgba;
  if (channels != 3) {
    playerlike::refuse(fun, "a picture has 3 (RGB) or 4 (RGBA) channels, but " +
                                std::to_string(channels) + " were asked for");
  }
  const std::size_t cells = rgba.size() / 4;
  for (std::size_t i = 0; i < cells; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba[3 * i + c] = rgba[4 * i + c];
  }
  rgba.resize(3 * cells);
  return rgba;
}

void require_points(const std::string& fun, const player_point_2d_t* points, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    playerlike::require_finite(fun.c_str(),
                               {{"a point's x", points[i].px}, {"a point's y", points[i].py}});
  }
}

}  // namespace

Drawing::Drawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName, int aLayer,
                 CellKind aKind)
    : mCore(std::move(aCore)),
      mQueue(&mCore->session().draw_queue()),
      mName(aName),
      mLayer(aLayer),
      mKind(aKind),
      mRetired(false),
      mMarkColour(0xff000000U),
      mGeneration(0),
      mWidth(0),
      mHeight(0),
      mCellSize(0.0),
      mOriginX(0.0),
      mOriginY(0.0) {
  translated(aName, [&] {
    mCore->require_usable();
    // Reads the generation first: if another client resizes in between, the next Refresh() sees a
    // newer one.
    mGeneration = mCore->session().canvas_generation();
    const playerlike::CanvasInfo canvas = mCore->session().request(playerlike::CanvasInfoRequest{});
    mWidth = canvas.width;
    mHeight = canvas.height;
    mCellSize = canvas.cell_size_m;
    mOriginX = canvas.origin_x_m;
    mOriginY = canvas.origin_y_m;
  });
}

Drawing::~Drawing() = default;

std::string Drawing::Fun(const char* aFunction) const {
  return std::string(mName) + "::" + aFunction;
}

void Drawing::RequireUsable(const char* aFunction) const {
  if (Retired()) {
    throw PlayerError(Fun(aFunction), "this layer was removed", PlayerError::kNotAvailable);
  }
  translated(mName, [&] { mCore->require_usable(); });
}

// Updates the size after a resize.
void Drawing::Refresh() const {
  playerlike::Session& session = mCore->session();
  if (session.canvas_generation() == mGeneration.load(std::memory_order_acquire)) return;
  translated(mName, [&] {
    const std::lock_guard lock(mSizeMutex);
    const std::uint64_t generation = session.canvas_generation();
    const playerlike::CanvasInfo canvas = session.request(playerlike::CanvasInfoRequest{});
    mWidth = canvas.width;
    mHeight = canvas.height;
    mGeneration.store(generation, std::memory_order_release);
  });
}

int Drawing::GetWidth() const {
  Refresh();
  return mWidth;
}

int Drawing::GetHeight() const {
  Refresh();
  return mHeight;
}

double Drawing::GetCellSize() const { return mCellSize; }

playerlike::CanvasInfo Drawing::Canvas() const {
  return {mWidth, mHeight, mCellSize, mOriginX, mOriginY};
}

int Drawing::GetX(double aX) const {
  if (!std::isfinite(aX)) playerlike::require_finite(mName, {{"x", aX}});
  return playerlike::column_of(Canvas(), aX);
}

int Drawing::GetY(double aY) const {
  if (!std::isfinite(aY)) playerlike::require_finite(mName, {{"y", aY}});
  Refresh();
  return playerlike::row_of(Canvas(), aY);
}

// --- Values of cells

ImageColour_t Drawing::MarkColour() const {
  return colour_of_bits(mMarkColour.load(std::memory_order_relaxed));
}

void Drawing::SetMarkColour(const ImageColour_t& aColour) {
  mMarkColour.store(bits_of_colour(aColour), std::memory_order_relaxed);
}

std::uint32_t Drawing::MarkOf(const ImageColour_t& aColour) const {
  if (mKind == BINARY_CELLS) return sim::CellValue::of(aColour.a != 0).bits;
  if (aColour.a == 0) return sim::CellValue::of(0.5F).bits;
  const int light = aColour.r + aColour.g + aColour.b;
  return sim::CellValue::of(static_cast<float>(765 - light) / 765.0F).bits;
}

ImageColour_t Drawing::ColourOf(std::uint32_t aValue) const {
  switch (mKind) {
    case COLOUR_CELLS:
      return colour_of_bits(aValue);
    case BINARY_CELLS:
      return aValue != 0 ? MarkColour() : ImageColour_t(0, 0, 0, 0);
    case GREY_CELLS:
      break;
  }
  const double occupancy =
      std::clamp(static_cast<double>(sim::CellValue{aValue}.occupancy()), 0.0, 1.0);
  const auto light = static_cast<std::uint8_t>(std::floor(255.0 * (1.0 - occupancy) + 0.5));
  return {light, light, light};
}

// --- Drawing

// Hot path of every cell: the only lock is the queue's own, and errors are handled elsewhere.
template <typename Write>
void Drawing::Put(Write aWrite) {
  if (Retired() || !mCore->usable()) RequireUsable("SetPixel");
  while (!mQueue->push_by(aWrite)) MakeRoom();
}

void Drawing::MakeRoom() {
  translated(mName, [&] { mCore->session().request(playerlike::FlushDrawingsRequest{}); });
}

void Drawing::PutPixel(int aX, int aY, std::uint32_t aValue) {
  Put([=, this](sim::DrawOperation& operation) {
    operation.kind = sim::DrawOperation::Kind::kPixel;
    operation.layer = mLayer;
    operation.x0 = aX;
    operation.y0 = aY;
    operation.value = {aValue};
  });
}

void Drawing::PutLine(int aX0, int aY0, int aX1, int aY1, std::uint32_t aValue) {
  Put([=, this](sim::DrawOperation& operation) {
    operation.kind = sim::DrawOperation::Kind::kLine;
    operation.layer = mLayer;
    operation.x0 = aX0;
    operation.y0 = aY0;
    operation.x1 = aX1;
    operation.y1 = aY1;
    operation.value = {aValue};
  });
}

void Drawing::Fill(const ImageColour_t& aColour) {
  const std::uint32_t value = ValueOf(aColour);
  Put([=, this](sim::DrawOperation& operation) {
    operation.kind = sim::DrawOperation::Kind::kFill;
    operation.layer = mLayer;
    operation.value = {value};
  });
}

// Draws the columns first .. last of a row, clipped to the canvas; an empty range draws nothing.
void Drawing::PutSpan(double aFirst, double aLast, int aY, std::uint32_t aValue) {
  const int first = static_cast<int>(std::clamp(aFirst, 0.0, static_cast<double>(mWidth)));
  const int last = static_cast<int>(std::clamp(aLast, -1.0, static_cast<double>(mWidth - 1)));
  if (first < last) {
    PutLine(first, aY, last, aY, aValue);
  } else if (first == last) {
    PutPixel(first, aY, aValue);
  }
}

void Drawing::DrawPolyline(const player_point_2d_t* aPoints, std::size_t aCount,
                           const ImageColour_t& aColour) {
  require_points(Fun("SetPolylineMetres"), aPoints, aCount);
  if (aCount == 0) return;
  ImagePoint_t from = GetPoint(aPoints[0].px, aPoints[0].py);
  if (aCount == 1) DrawPixel(from.x, from.y, aColour);
  for (std::size_t i = 1; i < aCount; ++i) {
    const ImagePoint_t to = GetPoint(aPoints[i].px, aPoints[i].py);
    DrawLine(from.x, from.y, to.x, to.y, aColour);
    from = to;
  }
}

void Drawing::FillPolygon(const player_point_2d_t* aPoints, std::size_t aCount,
                          const ImageColour_t& aColour) {
  require_points(Fun("SetPolygonMetres"), aPoints, aCount);
  RequireUsable("SetPolygonMetres");
  if (aCount == 0) return;
  Refresh();
  std::vector<sim::Vec2> corners(aCount);
  for (std::size_t i = 0; i < aCount; ++i) corners[i] = {aPoints[i].px, aPoints[i].py};
  const std::uint32_t value = ValueOf(aColour);
  for (const playerlike::CellSpan& span : playerlike::polygon_spans(Canvas(), corners)) {
    PutSpan(span.first, span.last, span.row, value);
  }
}

void Drawing::FillDisc(double aX, double aY, double aRadius, const ImageColour_t& aColour) {
  const std::string fun = Fun("SetDiscMetres");
  playerlike::require_finite(fun.c_str(), {{"x", aX}, {"y", aY}, {"the radius", aRadius}});
  if (aRadius < 0.0) {
    playerlike::refuse(fun,
                       "the radius must not be negative, but is " + sim::rounded_text(aRadius, 6));
  }
  RequireUsable("SetDiscMetres");
  const int height = GetHeight();
  const double centre_column = (aX - mOriginX) / mCellSize;
  const double centre_row = height - (aY - mOriginY) / mCellSize;
  const double radius = aRadius / mCellSize;
  const ImagePoint_t own = GetPoint(aX, aY);
  const int first_row = static_cast<int>(
      std::clamp(std::min(std::ceil(centre_row - radius - 0.5), static_cast<double>(own.y)), 0.0,
                 static_cast<double>(height)));
  const int last_row = static_cast<int>(
      std::clamp(std::max(std::floor(centre_row + radius - 0.5), static_cast<double>(own.y)), -1.0,
                 static_cast<double>(height - 1)));
  const std::uint32_t value = ValueOf(aColour);
  for (int row = first_row; row <= last_row; ++row) {
    const double dy = row + 0.5 - centre_row;
    double first = 1.0, last = 0.0;
    if (std::abs(dy) <= radius) {
      const double dx = std::sqrt(radius * radius - dy * dy);
      first = std::ceil(centre_column - dx - 0.5);
      last = std::floor(centre_column + dx - 0.5);
    }
    if (first > last) {
      if (row != own.y) continue;
      first = last = own.x;
    }
    PutSpan(first, last, row, value);
  }
}

// --- Whole images

void Drawing::SetImage(const std::uint8_t* aImage, std::size_t aBytes) {
  RequireUsable("SetImage");
  const int width = GetWidth();
  const int height = GetHeight();
  const std::size_t cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (aImage == nullptr || (aBytes != 3 * cells && aBytes != 4 * cells)) {
    playerlike::refuse(Fun("SetImage"),
                       "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                           " cells has " + std::to_string(3 * cells) + " (RGB) or " +
                           std::to_string(4 * cells) + " (RGBA) bytes, but " +
                           (aImage == nullptr ? "a null pointer" : std::to_string(aBytes)) +
                           " was given");
  }
  std::vector<sim::CellValue> values = mCore->list_of_cells(cells);
  const std::size_t channels = aBytes / cells;
  if (mKind == COLOUR_CELLS && channels == 4) {
    std::memcpy(values.data(), aImage, aBytes);
  } else if (mKind == COLOUR_CELLS) {
    for (std::size_t i = 0; i < cells; ++i) {
      const std::uint8_t* const c = aImage + 3 * i;
      values[i] = {bits_of_colour(ImageColour_t(c[0], c[1], c[2]))};
    }
  } else {
    for (std::size_t i = 0; i < cells; ++i) {
      const std::uint8_t* const c = aImage + channels * i;
      values[i] = {MarkOf(ImageColour_t(c[0], c[1], c[2], channels == 4 ? c[3] : 255))};
    }
  }
  translated(mName, [&] { mCore->set_cells(mLayer, {0, 0, width, height}, std::move(values)); });
}

void Drawing::UpdateImage(const std::vector<ImagePixel_t>& aPixels) {
  for (const ImagePixel_t& pixel : aPixels) DrawPixel(pixel.x, pixel.y, pixel.colour);
}

std::vector<std::uint8_t> Drawing::GetImage(int aChannels) const {
  RequireUsable("GetImage");
  const std::vector<sim::CellValue> cells =
      translated(mName, [&] { return mCore->session().request(playerlike::CellsRequest{mLayer}); });
  std::vector<std::uint8_t> image(4 * cells.size());
  if (mKind == COLOUR_CELLS) {
    std::memcpy(image.data(), cells.data(), image.size());
  } else {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const ImageColour_t c = ColourOf(cells[i].bits);
      std::memcpy(image.data() + 4 * i, &c, sizeof c);
    }
  }
  return with_channels(Fun("GetImage").c_str(), std::move(image), aChannels);
}

std::uint32_t Drawing::CellAt(int aX, int aY, const char* aFunction) const {
  RequireUsable(aFunction);
  const auto value = translated(mName, [&] {
    return mCore->session().request(playerlike::CellRequest{mLayer, aX, aY});
  });
  if (!value) {
    playerlike::refuse(Fun(aFunction), "there is no cell (" + std::to_string(aX) + ", " +
                                           std::to_string(aY) + "): the grid-map has " +
                                           std::to_string(GetWidth()) + " x " +
                                           std::to_string(GetHeight()) + ", counted from 0");
  }
  return value->bits;
}

ImageColour_t Drawing::GetPixel(int aX, int aY) const {
  return ColourOf(CellAt(aX, aY, "GetPixel"));
}

// --- CanvasDrawing

CanvasDrawing::CanvasDrawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName)
    : Drawing(std::move(aCore), aName) {}

CanvasDrawing::~CanvasDrawing() = default;

void CanvasDrawing::Resize(int aWidth, int aHeight) {
  RequireUsable("Resize");
  translated(Fun("Resize").c_str(), [&] {
    Core()->session().request(playerlike::ResizeCanvasRequest{aWidth, aHeight});
  });
}

void CanvasDrawing::SaveImage(const std::string& aName, int aScale) const {
  RequireUsable("SaveImage");
  translated(Fun("SaveImage").c_str(), [&] {
    Core()->session().request(playerlike::SaveImageRequest{aName, aScale});
  });
}

std::vector<std::uint8_t> CanvasDrawing::GetComposedImage(int aChannels) const {
  RequireUsable("GetComposedImage");
  const std::string fun = Fun("GetComposedImage");
  return with_channels(
      fun.c_str(),
      translated(fun.c_str(),
                 [&] { return Core()->session().request(playerlike::CanvasImageRequest{}).rgba; }),
      aChannels);
}

void CanvasDrawing::SetViewMode(ViewMode aMode) {
  RequireUsable("SetViewMode");
  const std::string fun = Fun("SetViewMode");
  for (const auto& [mode, sim_mode] : kModes) {
    if (mode != aMode) continue;
    const sim::ViewMode wanted = sim_mode;
    translated(fun.c_str(),
               [&] { Core()->session().request(playerlike::SetViewModeRequest{wanted}); });
    return;
  }
  playerlike::refuse(fun, "there is no view mode " + std::to_string(static_cast<int>(aMode)));
}

ViewMode CanvasDrawing::GetViewMode() const {
  RequireUsable("GetViewMode");
  const sim::ViewMode found = translated(Fun("GetViewMode").c_str(), [&] {
    return Core()->session().request(playerlike::ViewModeRequest{});
  });
  for (const auto& [mode, sim_mode] : kModes) {
    if (sim_mode == found) return mode;
  }
  return GROUND;
}

}  // namespace CCMorse
