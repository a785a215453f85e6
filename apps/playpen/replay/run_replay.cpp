// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/run_replay.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "replay/replay_builder.h"
#include "sim/core/file.h"

namespace playpen::replay {
namespace {

/// What a program printed, which becomes known with the steps.
class PrintedLines {
 public:
  explicit PrintedLines(const std::string& file) {
    // Without the file, the replay has no lines.
    if (!file.empty()) static_cast<void>(sim::read_whole_file(file, {}, text_));
  }

  /// Notes the lines that were complete when the program had printed so many bytes.
  void note_until(std::uint64_t bytes, sim::SimTime time_ns, ReplayBuilder& builder) {
    const std::size_t printed = std::min<std::size_t>(bytes, text_.size());
    if (printed <= noted_) return;
    const std::size_t line_end = text_.rfind('\n', printed - 1);
    if (line_end == std::string::npos || line_end < noted_) return;
    const std::string_view lines(text_.data() + noted_, line_end - noted_);
    builder.note_output(time_ns, lines, /*is_error=*/false);
    noted_ = line_end + 1;
  }
  /// Notes the rest.
  void note_rest(sim::SimTime time_ns, ReplayBuilder& builder) {
    if (noted_ < text_.size()) {
      builder.note_output(time_ns, std::string_view(text_).substr(noted_), /*is_error=*/false);
    }
    noted_ = text_.size();
  }

 private:
  std::string text_;
  std::size_t noted_ = 0;  ///< bytes, up to the end of a line
};

}  // namespace

ReplayRun replay_of(playerlike::Rerun& rerun, const std::string& folder, const std::string& name,
                    const std::vector<GoalNote>& goals) {
  const sim::Simulation& run = rerun.simulation();
  ReplayOptions options;
  options.name = name;
  ReplayBuilder builder(run, std::move(options));
  builder.watch_layers(rerun.layers());
  for (const GoalNote& goal : goals) builder.note_goal(goal);
  PrintedLines printed(rerun.program_log().empty() ? folder + "/program.log" : rerun.program_log());
  builder.observe(run);
  for (;;) {
    const sim::SimTime before_ns = run.now_ns();
    if (!rerun.step()) break;
    for (const playerlike::RecordedCommand& command : rerun.commands()) {
      builder.note_command(before_ns, command.device, command.command);
    }
    printed.note_until(rerun.printed_bytes(), run.now_ns(), builder);
    builder.observe(run);
  }
  printed.note_rest(run.now_ns(), builder);
  return builder.finish(run);
}

}  // namespace playpen::replay
