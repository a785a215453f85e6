// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "shared_map.h"

namespace {

// Two devices report the same number for one moment; the tolerance is for robots whose clocks are
// not ideal [s].
const double SAME_TIME = 1e-3;

}  // namespace

void CSharedMap::publish(const par::OccupancyGrid& newMap, const Observation& observation) {
  {
    const ScopedLock lk(mtx);
    map = newMap;
    newest = observation;
  }
  changed.notify_all();
}

void CSharedMap::close() {
  {
    const ScopedLock lk(mtx);
    isClosed = true;
  }
  changed.notify_all();
}

bool CSharedMap::waitFor(double time, Observation& observation) {
  ScopedLock lk(mtx);
  changed.wait(lk, [&] { return isClosed || newest.time > time - SAME_TIME; });
  observation = newest;
  // The map of this time counts if it came before close(), whichever thread was faster.
  return newest.time > time - SAME_TIME;
}

par::OccupancyGrid CSharedMap::copy() const {
  const ScopedLock lk(mtx);
  return map;
}

void CSharedMap::forget(const Area& area) {
  const ScopedLock lk(mtx);
  forgotten.push_back(area);
}

std::vector<Area> CSharedMap::takeForgotten() {
  const ScopedLock lk(mtx);
  std::vector<Area> areas;
  areas.swap(forgotten);
  return areas;
}

bool CSharedMap::closed() const {
  const ScopedLock lk(mtx);
  return isClosed;
}
