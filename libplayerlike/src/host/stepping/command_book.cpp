// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/command_book.h"

namespace playerlike {
namespace {

bool moves_the_robot(const sim::Command& command) {
  return is_one_of<sim::TwistCommand, sim::HeadingCommand, sim::PositionCommand, sim::CarCommand,
                   sim::GotoCommand, sim::ResumeCommand, sim::PlaceCommand, sim::TranslateCommand,
                   sim::RotateCommand, sim::OrientCommand>(command);
}

}  // namespace

void CommandBook::note(int robot, int port, const sim::Command& command, sim::SimTime now_ns) {
  if (!moves_the_robot(command)) return;
  Entry& entry = entries_[static_cast<std::size_t>(robot)];
  if (!entry.first_ns) entry.first_ns = now_ns;
  ++entry.count;
  entry.ports.insert(port);
}

}  // namespace playerlike
