// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/run_replay.h"

#include "playerlike/replay/replay_builder.h"
#include "replay/printed_lines.h"

namespace playpen::replay {

using playerlike::replay::GoalNote;
using playerlike::replay::ReplayBuilder;
using playerlike::replay::ReplayOptions;
using playerlike::replay::ReplayRun;

ReplayRun replay_of(playerlike::Rerun& rerun, const std::string& folder, const std::string& name,
                    const std::vector<GoalNote>& goals) {
  const sim::Simulation& run = rerun.simulation();
  ReplayOptions options;
  options.name = name;
  ReplayBuilder builder(run, std::move(options));
  builder.watch_layers(rerun.layers());
  for (const GoalNote& goal : goals) builder.note_goal(goal);
  PrintedLines printed(rerun.program_log().empty() ? folder + '/' + playerlike::kProgramLog
                                                   : rerun.program_log());
  builder.observe(run);
  for (;;) {
    const sim::SimTime before_ns = run.now_ns();
    if (!rerun.step()) break;
    for (const playerlike::RecordedCommand& command : rerun.commands()) {
      builder.note_command(before_ns, command.device, command.command);
    }
    builder.note_output(run.now_ns(), printed.until(rerun.printed_bytes()), /*is_error=*/false);
    builder.observe(run);
  }
  builder.note_output(run.now_ns(), printed.rest(), /*is_error=*/false);
  return builder.finish(run);
}

}  // namespace playpen::replay
