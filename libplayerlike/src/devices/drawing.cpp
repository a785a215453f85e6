// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "libCCMorse/Drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/client_core.h"
#include "devices/errors.h"
#include "libCCMorse/GridMapLayer.h"
#include "sim/core/colour.h"

namespace CCMorse {

using PlayerCc::PlayerError;
using playerlike::translated;

namespace detail {

std::uint8_t channel_of_share(double share) {
  playerlike::require_finite("Drawing", {{"a colour's channel", share}});
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0));
}

ImageColour_t colour_of_text(const std::string& text) {
  const auto c = sim::parse_colour(text);
  if (!c) {
    throw PlayerError("Drawing",
                      "\"" + text +
                          "\" is no colour; colours are written \"#34AAFF\", \"#3AF\" or, "
                          "with alpha, \"#34AAFF80\"",
                      PlayerError::kBadArgument);
  }
  return {c->r, c->g, c->b, c->a};
}

std::string text_of_colour(const ImageColour_t& c) {
  return sim::to_string(sim::Colour{c.r, c.g, c.b, c.a});
}

}  // namespace detail

namespace {

// As sim::Canvas does, so that far away positions stay far away.
constexpr double kFar = 1 << 30;

int cell_number(double cells) {
  return static_cast<int>(std::clamp(std::floor(cells), -kFar, kFar));
}

sim::Colour sim_colour(const ImageColour_t& c) { return {c.r, c.g, c.b, c.a}; }

}  // namespace

Drawing::Drawing(std::shared_ptr<playerlike::ClientCore> aCore, const char* aName)
    : mCore(std::move(aCore)), mName(aName) {
  const playerlike::CanvasInfo canvas = translated(aName, [&] {
    mCore->require_usable();
    return mCore->session().canvas_info();
  });
  mWidth = canvas.width;
  mHeight = canvas.height;
  mCellSize = canvas.cell_size_m;
  mOriginX = canvas.origin_x_m;
  mOriginY = canvas.origin_y_m;
}

Drawing::~Drawing() = default;

int Drawing::GetWidth() const { return mWidth; }
int Drawing::GetHeight() const { return mHeight; }
double Drawing::GetCellSize() const { return mCellSize; }

int Drawing::GetX(double aX) const {
  playerlike::require_finite(mName, {{"x", aX}});
  return cell_number((aX - mOriginX) / mCellSize);
}

int Drawing::GetY(double aY) const {
  playerlike::require_finite(mName, {{"y", aY}});
  return mHeight - 1 - cell_number((aY - mOriginY) / mCellSize);
}

bool Drawing::Shade(ImageColour_t& aColour) const {
  static_cast<void>(aColour);
  return true;
}

void Drawing::DrawPixel(int aX, int aY, ImageColour_t aColour) {
  translated(mName, [&] {
    mCore->require_usable();
    if (!Shade(aColour)) return;
    sim::CanvasOperation operation;
    operation.kind = sim::CanvasOperation::Kind::kPixel;
    operation.x0 = aX;
    operation.y0 = aY;
    operation.colour = sim_colour(aColour);
    mCore->session().draw({&operation, 1});
  });
}

void Drawing::DrawLine(int aX0, int aY0, int aX1, int aY1, ImageColour_t aColour) {
  translated(mName, [&] {
    mCore->require_usable();
    if (!Shade(aColour)) return;
    sim::CanvasOperation operation;
    operation.kind = sim::CanvasOperation::Kind::kLine;
    operation.x0 = aX0;
    operation.y0 = aY0;
    operation.x1 = aX1;
    operation.y1 = aY1;
    operation.colour = sim_colour(aColour);
    mCore->session().draw({&operation, 1});
  });
}

void Drawing::Fill(const ImageColour_t& aColour) {
  translated(mName, [&] {
    mCore->require_usable();
    sim::CanvasOperation operation;
    operation.kind = sim::CanvasOperation::Kind::kClear;
    operation.colour = sim_colour(aColour);
    mCore->session().draw({&operation, 1});
  });
}

ImageColour_t Drawing::GetPixel(int aX, int aY) const {
  const std::optional<sim::Colour> c = translated(mName, [&] {
    mCore->require_usable();
    return mCore->session().pixel(aX, aY);
  });
  if (!c) {
    throw PlayerError(mName,
                      "there is no cell (" + std::to_string(aX) + ", " + std::to_string(aY) +
                          "): the grid-map has " + std::to_string(mWidth) + " x " +
                          std::to_string(mHeight) + ", counted from 0",
                      PlayerError::kBadArgument);
  }
  return {c->r, c->g, c->b, c->a};
}

// --- GridMapLayer

GridMapLayer::GridMapLayer(std::shared_ptr<playerlike::ClientCore> aCore)
    : Drawing(std::move(aCore), "GridMapLayer"),
      mLayerName("canvas"),
      mTransparency(0.0),
      mHasTransparentColour(false),
      mPriority(0) {}

GridMapLayer::~GridMapLayer() = default;

std::string GridMapLayer::GetName() const {
  const std::lock_guard lock(mMutex);
  return mLayerName;
}

void GridMapLayer::SetName(const std::string& aName) {
  const std::lock_guard lock(mMutex);
  mLayerName = aName;
}

ImageColour_t GridMapLayer::GetColour() const {
  const std::lock_guard lock(mMutex);
  return mColour;
}

void GridMapLayer::SetOwnColour(const ImageColour_t& aColour) {
  const std::lock_guard lock(mMutex);
  mColour = aColour;
}

void GridMapLayer::SetTransparency(double aTransparency) {
  playerlike::require_finite("GridMapLayer::SetTransparency",
                             {{"the transparency", aTransparency}});
  const std::lock_guard lock(mMutex);
  mTransparency = std::clamp(aTransparency, 0.0, 1.0);
}

double GridMapLayer::GetTransparency() const {
  const std::lock_guard lock(mMutex);
  return mTransparency;
}

void GridMapLayer::SetSeeThrough(bool aOn, const ImageColour_t& aColour) {
  const std::lock_guard lock(mMutex);
  mHasTransparentColour = aOn;
  mTransparentColour = aColour;
}

void GridMapLayer::ResetTransparentColour() { SetSeeThrough(false, ImageColour_t()); }

bool GridMapLayer::HasTransparentColour() const {
  const std::lock_guard lock(mMutex);
  return mHasTransparentColour;
}

ImageColour_t GridMapLayer::GetTransparentColour() const {
  const std::lock_guard lock(mMutex);
  return mTransparentColour;
}

void GridMapLayer::SetPriority(int aPriority) {
  const std::lock_guard lock(mMutex);
  mPriority = aPriority;
}

int GridMapLayer::GetPriority() const {
  const std::lock_guard lock(mMutex);
  return mPriority;
}

bool GridMapLayer::Shade(ImageColour_t& aColour) const {
  const std::lock_guard lock(mMutex);
  const ImageColour_t& hole = mTransparentColour;
  if (mHasTransparentColour && aColour.r == hole.r && aColour.g == hole.g && aColour.b == hole.b) {
    return false;
  }
  if (mTransparency > 0.0) {
    aColour.a = static_cast<std::uint8_t>(std::lround(aColour.a * (1.0 - mTransparency)));
  }
  return aColour.a > 0;
}

}  // namespace CCMorse
