// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/render/render.h"

#include "commands.h"
#include "sim/simulation/simulation.h"

namespace playpen {

int render(const std::string& world, const std::string& file, int size_px) {
  const sim::Simulation simulation(sim::load_world(find_world(world)));
  sim::render::RenderOptions options;
  options.size_px = size_px;
  sim::render::write_png(sim::render::draw_scene(simulation.snapshot(), options), file);
  return kOk;
}

}  // namespace playpen
