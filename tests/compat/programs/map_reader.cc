// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Fetches the map and prints it coarsely.
#include <libplayerc++/playerc++.h>
using namespace PlayerCc;
using namespace std;

int main()
{
  PlayerClient robot("localhost");
  MapProxy map(&robot, 0);
  map.RequestMap();
  int w = map.GetWidth(), h = map.GetHeight(), occupied = 0, free = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (map.GetCell(x, y) > 0) occupied++;
      if (map.GetCell(x, y) < 0) free++;
    }
  int step = MAX(1, h / 30);
  for (int y = h - 1; y >= 0; y -= step) {
    for (int x = 0; x < w; x += step) cout << (map.GetCell(x, y) > 0 ? '#' : map.GetCell(x, y) < 0 ? '.' : ' ');
    cout << '\n';
  }
  cout << w << " x " << h << " cells of " << map.GetResolution() << " m, " << occupied << " occupied, " << free
       << " free" << endl;
  return occupied > 0 && free > occupied ? 0 : 1;
}
