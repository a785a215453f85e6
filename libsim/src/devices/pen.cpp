// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/pen.h"

#include "devices/device_kind.h"

namespace sim {

Pen::Pen(std::string name, const PenParams& params)
    : Actuator(std::move(name), "pen"), params_(params) {}

void Pen::mark_trail(const Pose& X_WB, Canvas& canvas) {
  if (!params_.trail || !active()) return;
  const int column = canvas.column(X_WB.x_m);
  const int row = canvas.row(X_WB.y_m);
  if (has_last_ && column == last_column_ && row == last_row_) return;
  if (has_last_) {
    canvas.draw_line(last_column_, last_row_, column, row, params_.colour);
  } else {
    canvas.set_pixel(column, row, params_.colour);
  }
  has_last_ = true;
  last_column_ = column;
  last_row_ = row;
}

void Pen::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive(has_last_, last_column_, last_row_);
}

constexpr Field kPenSettings[] = {
    field<&PenParams::colour>("colour", "", "of the trail: `#RGB`, `#RRGGBB` or `#RRGGBBAA`"),
    field<&PenParams::trail>("trail", "", "whether the robot's path is drawn automatically"),
};
SIM_FIELDS(PenParams, kPenSettings)

DeviceKind pen_kind() { return device_kind<Pen, PenParams, void>("pen", {{"graphics2d"}}); }

}  // namespace sim
