// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A robot wanders about the arena and draws what its laser tells into layers of the canvas: a map,
// its trail and the last scan. It draws the pictures of the view modes (see make_pictures.sh).
#include <libCCMorse/CCMorse.h>
#include <libplayerc++/playerc++.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

// Occupancies of the cells: each beam makes those it passes freer and the one it ends in fuller.
class Map {
 public:
  explicit Map(CCMorse::WindowProxy& window)
      : window_(window),
        cells_(static_cast<std::size_t>(window.GetWidth() * window.GetHeight()), 0.5F) {}

  void add_beam(double from_x, double from_y, double angle, double range, bool hit) {
    const double step = 0.01;  // half a cell
    for (double r = 0.1; r < range - 0.02; r += step) change(from_x, from_y, angle, r, -0.04F);
    if (hit) change(from_x, from_y, angle, range + 0.005, 0.3F);
  }
  const std::vector<float>& cells() const { return cells_; }

 private:
  void change(double x, double y, double angle, double range, float by) {
    const int column = window_.GetX(x + range * std::cos(angle));
    const int row = window_.GetY(y + range * std::sin(angle));
    if (column < 0 || row < 0 || column >= window_.GetWidth() || row >= window_.GetHeight()) return;
    float& cell = cells_[static_cast<std::size_t>(row * window_.GetWidth() + column)];
    cell = std::min(1.0F, std::max(0.0F, cell + by));
  }

  CCMorse::WindowProxy& window_;
  std::vector<float> cells_;
};

}  // namespace

int main() {
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy position(&client, 0);
  PlayerCc::LaserProxy laser(&client, 0);
  CCMorse::WindowProxy& window = CCMorse::WindowProxy::GetInstance(&client, 172, 186);
  CCMorse::GridMapLayer& occupancy =
      window.CreateLayer("occupancy", CCMorse::GridMapLayer::GREY, 1);
  CCMorse::GridMapLayer& scan = window.CreateLayer("scan", CCMorse::GridMapLayer::BINARY, 2);
  CCMorse::GridMapLayer& trail = window.CreateLayer("trail", CCMorse::GridMapLayer::BINARY, 3);
  scan.SetColour("#00a000");
  trail.SetColour("#e00000");
  Map map(window);
  double turning = 0.0;
  try {
    client.Read();
    double last_x = position.GetXPos();
    double last_y = position.GetYPos();
    while (true) {
      client.Read();
      const double x = position.GetXPos();
      const double y = position.GetYPos();
      const double laser_x = x + 0.035 * std::cos(position.GetYaw());
      const double laser_y = y + 0.035 * std::sin(position.GetYaw());
      double left = 0.0;
      double right = 0.0;
      double ahead = laser.GetMaxRange();
      scan.Clear();
      for (unsigned i = 0; i < laser.GetCount(); ++i) {
        const double bearing = laser.GetBearing(i);
        const double range = laser.GetRange(i);
        const bool hit = range < laser.GetMaxRange() - 0.01;
        const double angle = position.GetYaw() + bearing;
        map.add_beam(laser_x, laser_y, angle, range, hit);
        if (hit) {
          scan.SetCell(window.GetX(laser_x + range * std::cos(angle)),
                       window.GetY(laser_y + range * std::sin(angle)), true);
        }
        if (std::fabs(bearing) < 0.45 && range < ahead) ahead = range;
        if (std::fabs(bearing) < 1.4) (bearing > 0.0 ? left : right) += std::min(range, 0.8);
      }
      occupancy.SetCells(map.cells());
      trail.SetLineMetres(last_x, last_y, x, y);
      last_x = x;
      last_y = y;
      if (ahead < 0.22) {
        if (turning == 0.0) turning = left > right ? 1.2 : -1.2;
        position.SetSpeed(0.0, turning);
      } else {
        turning = 0.0;
        position.SetSpeed(ahead < 0.5 ? 0.1 : 0.25, 0.02 * (left - right));
      }
    }
  } catch (const PlayerCc::PlayerError&) {
    return 0;  // the run is over
  }
}
