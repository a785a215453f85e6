// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The layers of a replay: watched frame by frame.
#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "playerlike/replay/replay_builder.h"

namespace playerlike::replay {

std::vector<CellRun> cell_runs(const std::vector<std::uint8_t>& before,
                               const std::vector<std::uint8_t>& now) {
  std::vector<CellRun> runs;
  const auto colour_at = [](const std::vector<std::uint8_t>& cells, std::size_t i) {
    return cells[i + 3] == 0 ? sim::Colour{0, 0, 0, 0}
                             : sim::Colour{cells[i], cells[i + 1], cells[i + 2], cells[i + 3]};
  };
  for (std::size_t i = 0; i + 3 < now.size(); i += 4) {
    if (std::memcmp(&now[i], &before[i], 4) == 0) continue;
    const sim::Colour colour = colour_at(now, i);
    if (colour == colour_at(before, i)) continue;
    const auto cell = static_cast<std::uint32_t>(i / 4);
    if (!runs.empty() && runs.back().first + runs.back().count == cell &&
        runs.back().colour == colour) {
      ++runs.back().count;
    } else {
      runs.push_back({cell, 1, colour});
    }
  }
  return runs;
}

void ReplayBuilder::add_layers(const sim::LayerStack& layers) {
  // Comparing a huge canvas takes long; of such a one, a picture per second must do.
  constexpr std::size_t kHugeCells = 4'000'000;
  const sim::SimTime now_ns = *last_frame_ns_;
  if (layers.cell_count() > kHugeCells && layers_ns_ &&
      now_ns < *layers_ns_ + sim::kNanosecondsPerSecond) {
    return;
  }
  layers_ns_ = now_ns;
  const bool same_styles = layers.revision() == layers_revision_;
  layers_revision_ = layers.revision();
  const sim::CanvasDescription size = layers.description();
  if (size.width != canvas_.width || size.height != canvas_.height) {
    begin_layers(size);
    if (layers_ended_) return;
  }
  const std::vector<sim::LayerInfo> infos = layers.layers();
  const std::vector<std::uint8_t> blank(4 * layers.cell_count(), 0);
  for (const sim::LayerInfo& info : infos) {
    if (std::ranges::find(layer_ids_, info.id) != layer_ids_.end()) continue;
    layer_ids_.push_back(info.id);
    cells_.push_back(blank);
    raw_cells_.emplace_back();
    run_.layers.push_back({.name = info.style.name,
                           .colour = info.style.colour,
                           .visible = info.style.visible,
                           .priority = info.style.priority,
                           .is_grey = info.kind == sim::LayerKind::kGrey,
                           .width = size.width,
                           .height = size.height,
                           .changes = {}});
  }
  for (std::size_t i = 0; i < layer_ids_.size(); ++i) {
    // A layer that was removed is blank from now on.
    const bool exists = layers.contains(layer_ids_[i]);
    if (exists) {
      const std::span<const std::uint8_t> raw = layers.bytes(layer_ids_[i]);
      if (same_styles && std::ranges::equal(raw, raw_cells_[i])) continue;
      raw_cells_[i].assign(raw.begin(), raw.end());
    }
    std::vector<std::uint8_t> now = exists ? layers.picture(layer_ids_[i]) : blank;
    std::vector<CellRun> runs = cell_runs(cells_[i], now);
    if (runs.empty()) continue;
    run_.layers[first_layer_ + i].changes.push_back({now_ns, std::move(runs)});
    cells_[i] = std::move(now);
  }
}

// Cells keep their index in pictures of one size only, so each size has layers of its own.
void ReplayBuilder::begin_layers(const sim::CanvasDescription& canvas) {
  constexpr int kMostChanges = 16;
  for (std::size_t i = 0; i < layer_ids_.size(); ++i) {
    std::vector<CellRun> runs =
        cell_runs(cells_[i], std::vector<std::uint8_t>(cells_[i].size(), 0));
    if (runs.empty()) continue;
    run_.layers[first_layer_ + i].changes.push_back({*last_frame_ns_, std::move(runs)});
  }
  layer_ids_.clear();
  cells_.clear();
  raw_cells_.clear();
  first_layer_ = run_.layers.size();
  canvas_ = canvas;
  if (++canvas_changes_ <= kMostChanges) return;
  run_.notes.push_back("The canvas changed its size more than " + std::to_string(kMostChanges) +
                       " times; drawings after that are left out.");
  layers_ended_ = true;
}

}  // namespace playerlike::replay
