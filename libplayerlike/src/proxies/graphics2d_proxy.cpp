// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <ostream>
#include <vector>

#include "devices/errors.h"
#include "libCCMorse/Drawing.h"
#include "libplayerc++/graphics2dproxy.h"
#include "proxies/link.h"

namespace PlayerCc {

namespace {

CCMorse::ImageColour_t image_colour(const player_color_t& c) {
  return {c.red, c.green, c.blue, c.alpha == 0 ? std::uint8_t{255} : c.alpha};
}

}  // namespace

class Graphics2dProxy::Sheet final : public CCMorse::Drawing {
 public:
  Sheet(const std::shared_ptr<playerlike::ClientCore>& core, sim::LayerId layer)
      : Drawing(core, "Graphics2dProxy", layer) {}
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  ~Sheet() override { Core()->release_layer(LayerNumber()); }

  using Drawing::MarkColour;
  using Drawing::SetMarkColour;

  void points(const std::vector<player_point_2d_t>& all) {
    for (const player_point_2d_t& p : all) DrawPixel(GetX(p.px), GetY(p.py), MarkColour());
  }
  void line(const player_point_2d_t& from, const player_point_2d_t& to) {
    DrawLine(GetX(from.px), GetY(from.py), GetX(to.px), GetY(to.py), MarkColour());
  }
  void polyline(const std::vector<player_point_2d_t>& all) {
    DrawPolyline(all.data(), all.size(), MarkColour());
  }
  void polygon(const std::vector<player_point_2d_t>& all, const CCMorse::ImageColour_t& colour) {
    FillPolygon(all.data(), all.size(), colour);
  }

  /// Checks an array of points and copies it.
  std::vector<player_point_2d_t> checked(const char* function, const player_point_2d_t* points,
                                         int count) const {
    RequireUsable(function);
    const std::string fun = Fun(function);
    if (count < 0 || (points == nullptr && count > 0)) {
      playerlike::refuse(fun, count < 0 ? "the number of points is " + std::to_string(count)
                                        : std::to_string(count) +
                                              " points are to be drawn, but the "
                                              "array is a null pointer");
    }
    std::vector<player_point_2d_t> all;
    if (count > 0) all.assign(points, points + count);
    for (const player_point_2d_t& p : all) {
      playerlike::require_finite(fun.c_str(), {{"a point's x", p.px}, {"a point's y", p.py}});
    }
    return all;
  }
};

Graphics2dProxy::Graphics2dProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Graphics2dProxy::Subscribe(aIndex);
}

Graphics2dProxy::~Graphics2dProxy() { Graphics2dProxy::Unsubscribe(); }

void Graphics2dProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "Graphics2dProxy::Graphics2dProxy";
  Attach(PLAYER_GRAPHICS2D_CODE, aIndex, fun, /*aHasReadings=*/false);
  const std::shared_ptr<playerlike::ClientCore>& core = mLink->core;
  const sim::LayerId layer = playerlike::translated(fun, [&] {
    const scoped_lock_t lock(core->mutex());
    return core->acquire_layer();
  });
  try {
    mSheet = std::make_unique<Sheet>(core, layer);
  } catch (...) {
    core->release_layer(layer);
    throw;
  }
}

void Graphics2dProxy::Unsubscribe() {
  mSheet.reset();
  ClientProxy::Unsubscribe();
}

void Graphics2dProxy::Color(player_color_t col) { mSheet->SetMarkColour(image_colour(col)); }

void Graphics2dProxy::Color(uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha) {
  player_color_t col;
  col.alpha = alpha;
  col.red = red;
  col.green = green;
  col.blue = blue;
  Color(col);
}

void Graphics2dProxy::Clear() { mSheet->Clear(); }

void Graphics2dProxy::DrawPoints(player_point_2d_t pts[], int count) {
  mSheet->points(mSheet->checked("DrawPoints", pts, count));
}

void Graphics2dProxy::DrawPolygon(player_point_2d_t pts[], int count, bool filled,
                                  player_color_t fill_color) {
  std::vector<player_point_2d_t> points = mSheet->checked("DrawPolygon", pts, count);
  if (points.empty()) return;
  if (filled) mSheet->polygon(points, image_colour(fill_color));
  const player_point_2d_t first = points.front();
  if (points.size() > 1) points.push_back(first);
  mSheet->polyline(points);
}

void Graphics2dProxy::DrawPolyline(player_point_2d_t pts[], int count) {
  mSheet->polyline(mSheet->checked("DrawPolyline", pts, count));
}

void Graphics2dProxy::DrawMultiline(player_point_2d_t pts[], int count) {
  const std::vector<player_point_2d_t> points = mSheet->checked("DrawMultiline", pts, count);
  for (std::size_t i = 0; i + 1 < points.size(); i += 2) mSheet->line(points[i], points[i + 1]);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::Graphics2dProxy& c) {
  return os << static_cast<const PlayerCc::ClientProxy&>(c);
}

}  // namespace std
