// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <mutex>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "libCCMorse/Drawing.h"
#include "libplayerc++/graphics2dproxy.h"
#include "playerlike/session/device_graphics.h"
#include "proxies/link.h"

namespace PlayerCc {

namespace {

CCMorse::ImageColour_t image_colour(const player_color_t& c) {
  return {c.red, c.green, c.blue, c.alpha == 0 ? std::uint8_t{255} : c.alpha};
}

}  // namespace

/// What a proxy draws on.
class Graphics2dProxy::Sheet {
 public:
  using Points = std::vector<player_point_2d_t>;

  Sheet() = default;
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  virtual ~Sheet() = default;

  virtual void set_colour(const player_color_t& colour) = 0;
  virtual void clear() = 0;
  virtual void draw_points(const Points& all) = 0;
  virtual void draw_polyline(const Points& all) = 0;
  virtual void draw_multiline(const Points& all) = 0;
  virtual void draw_polygon(const Points& all, bool filled, const player_color_t& fill) = 0;

  /// Checks an array of points and copies it.
  Points checked(const char* function, const player_point_2d_t* points, int count) const {
    require_usable(function);
    const std::string fun = std::string("Graphics2dProxy::") + function;
    if (count < 0 || (points == nullptr && count > 0)) {
      playerlike::refuse(fun, count < 0 ? "the number of points is " + std::to_string(count)
                                        : std::to_string(count) +
                                              " points are to be drawn, but the "
                                              "array is a null pointer");
    }
    Points all;
    if (count > 0) all.assign(points, points + count);
    for (const player_point_2d_t& p : all) {
      playerlike::require_finite(fun.c_str(), {{"a point's x", p.px}, {"a point's y", p.py}});
    }
    return all;
  }

 protected:
  /// @throws PlayerError if the client is gone.
  virtual void require_usable(const char* function) const = 0;
};

namespace {

/// A layer of the grid-map.
class Layer final : public Graphics2dProxy::Sheet, private CCMorse::Drawing {
 public:
  Layer(const std::shared_ptr<playerlike::ClientCore>& core, sim::LayerId layer)
      : Drawing(core, "Graphics2dProxy", layer) {}
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;
  ~Layer() override { Core()->release_layer(LayerNumber()); }

  void set_colour(const player_color_t& colour) override { SetMarkColour(image_colour(colour)); }
  void clear() override { Clear(); }
  void draw_points(const Points& all) override {
    for (const player_point_2d_t& p : all) DrawPixel(GetX(p.px), GetY(p.py), MarkColour());
  }
  void draw_polyline(const Points& all) override {
    DrawPolyline(all.data(), all.size(), MarkColour());
  }
  void draw_multiline(const Points& all) override {
    for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
      DrawLine(GetX(all[i].px), GetY(all[i].py), GetX(all[i + 1].px), GetY(all[i + 1].py),
               MarkColour());
    }
  }
  void draw_polygon(const Points& all, bool filled, const player_color_t& fill) override {
    if (all.empty()) return;
    if (filled) FillPolygon(all.data(), all.size(), image_colour(fill));
    Points outline = all;
    if (all.size() > 1) outline.push_back(all.front());
    draw_polyline(outline);
  }

 private:
  void require_usable(const char* function) const override { RequireUsable(function); }
};

/// A device of a server that draws by itself.
class RemoteSheet final : public Graphics2dProxy::Sheet {
 public:
  RemoteSheet(std::shared_ptr<playerlike::ClientCore> core, playerlike::DeviceGraphics& device,
              unsigned index)
      : core_(std::move(core)), device_(device), index_(index) {}

  void set_colour(const player_color_t& colour) override {
    const std::lock_guard lock(mutex_);
    colour_ = colour;
  }
  void clear() override { send("Clear", Kind::kClear, {}); }
  void draw_points(const Points& all) override { send("DrawPoints", Kind::kPoints, all); }
  void draw_polyline(const Points& all) override { send("DrawPolyline", Kind::kPolyline, all); }
  void draw_multiline(const Points& all) override { send("DrawMultiline", Kind::kMultiline, all); }
  void draw_polygon(const Points& all, bool filled, const player_color_t& fill) override {
    send("DrawPolygon", Kind::kPolygon, all, filled, fill);
  }

 private:
  using Kind = playerlike::DeviceDrawing::Kind;

  void require_usable(const char* function) const override {
    playerlike::translated((std::string("Graphics2dProxy::") + function).c_str(), [&] {
      const std::lock_guard lock(core_->mutex());
      core_->require_usable();
    });
  }
  void send(const char* function, Kind kind, const Points& all, bool filled = false,
            const player_color_t& fill = {}) {
    const auto colour_of = [](const player_color_t& c) {
      return sim::Colour{c.red, c.green, c.blue, c.alpha};  // the server knows what alpha means
    };
    playerlike::DeviceDrawing drawing;
    drawing.kind = kind;
    for (const player_point_2d_t& point : all) drawing.points.emplace_back(point.px, point.py);
    drawing.filled = filled;
    drawing.fill = colour_of(fill);
    {
      const std::lock_guard lock(mutex_);
      drawing.colour = colour_of(colour_);
    }
    playerlike::translated((std::string("Graphics2dProxy::") + function).c_str(), [&] {
      const std::lock_guard lock(core_->mutex());
      core_->require_usable();
      device_.draw(index_, drawing);
    });
  }

  const std::shared_ptr<playerlike::ClientCore> core_;
  playerlike::DeviceGraphics& device_;  // the core's session
  const unsigned index_;
  std::mutex mutex_;
  player_color_t colour_{};  // guarded by mutex_
};

}  // namespace

Graphics2dProxy::Graphics2dProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Graphics2dProxy::Subscribe(aIndex);
}

Graphics2dProxy::~Graphics2dProxy() { Graphics2dProxy::Unsubscribe(); }

void Graphics2dProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "Graphics2dProxy::Graphics2dProxy";
  Attach(PLAYER_GRAPHICS2D_CODE, aIndex, fun, /*aHasReadings=*/false);
  const std::shared_ptr<playerlike::ClientCore>& core = mLink->core;
  if (auto* device = dynamic_cast<playerlike::DeviceGraphics*>(&core->session())) {
    mSheet = std::make_unique<RemoteSheet>(core, *device, aIndex);
    return;
  }
  const sim::LayerId layer = playerlike::translated(fun, [&] {
    const scoped_lock_t lock(core->mutex());
    return core->acquire_layer();
  });
  try {
    mSheet = std::make_unique<Layer>(core, layer);
  } catch (...) {
    core->release_layer(layer);
    throw;
  }
}

void Graphics2dProxy::Unsubscribe() {
  mSheet.reset();
  ClientProxy::Unsubscribe();
}

void Graphics2dProxy::Color(player_color_t col) { mSheet->set_colour(col); }

void Graphics2dProxy::Color(uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha) {
  player_color_t col;
  col.alpha = alpha;
  col.red = red;
  col.green = green;
  col.blue = blue;
  Color(col);
}

void Graphics2dProxy::Clear() { mSheet->clear(); }

void Graphics2dProxy::DrawPoints(player_point_2d_t pts[], int count) {
  mSheet->draw_points(mSheet->checked("DrawPoints", pts, count));
}

void Graphics2dProxy::DrawPolygon(player_point_2d_t pts[], int count, bool filled,
                                  player_color_t fill_color) {
  mSheet->draw_polygon(mSheet->checked("DrawPolygon", pts, count), filled, fill_color);
}

void Graphics2dProxy::DrawPolyline(player_point_2d_t pts[], int count) {
  mSheet->draw_polyline(mSheet->checked("DrawPolyline", pts, count));
}

void Graphics2dProxy::DrawMultiline(player_point_2d_t pts[], int count) {
  mSheet->draw_multiline(mSheet->checked("DrawMultiline", pts, count));
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::Graphics2dProxy& c) {
  return os << static_cast<const PlayerCc::ClientProxy&>(c);
}

}  // namespace std
