// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/replay/happenings.h"
#include "playerlike/replay/replay_run.h"
#include "sim/canvas/layers.h"
#include "sim/devices/device.h"
#include "sim/simulation/simulation.h"

namespace playerlike::replay {

/// What a ReplayBuilder records.
struct ReplayOptions {
  std::string name = {};                    ///< of the run, for people; "": the world's
  std::size_t most_commands = 50000;        ///< further ones are left out, and a note says so
  std::size_t most_output_bytes = 1 << 20;  ///< of printed text; further text is left out
  /// Whether a run is shown while it goes on: observe() is called now and then instead of after
  /// each step, each call records a frame, and take() returns what is new.
  bool live = false;
};

/// Records a run for a replay.
///
/// The simulation is observed from outside: call observe() for the initial state and after each
/// step. Between steps, note what the simulation does not keep. Not thread-safe.
class ReplayBuilder {
 public:
  /// Records the world, the robots and the devices as they are now, but no frame yet.
  explicit ReplayBuilder(const sim::Simulation& simulation, ReplayOptions options = {});

  /// Records what has changed since the last call: the readings of the last step, contacts, events
  /// and texts in any case; poses, obstacles and layers when a frame is due.
  /// @param simulation  the one of the constructor, or a continuation with the same world.
  /// @throws std::invalid_argument if its time is before the last call's, or if it has other
  /// robots.
  void observe(const sim::Simulation& simulation);

  /// Notes a command to a device that exists. Equal commands to a device, one after the other, are
  /// one note.
  void note_command(sim::SimTime time_ns, sim::Simulation::DeviceId device,
                    const sim::Command& command);
  /// Notes what a program printed: a line, or several with line ends between them.
  void note_output(sim::SimTime time_ns, std::string_view text, bool is_error);
  /// Notes a goal that no waypoint device has.
  void note_goal(const GoalNote& goal);
  /// Records these layers instead of the simulation's own, whenever a frame is due.
  /// @param layers  must outlive this object, and have the size of the simulation's at first.
  void watch_layers(const sim::LayerStack& layers) noexcept { layers_ = &layers; }

  /// @name While the run goes on
  /// For a builder with ReplayOptions::live.
  /// @{

  /// Time of the last observation [ns].
  [[nodiscard]] sim::SimTime observed_ns() const noexcept { return last_ns_; }
  /// What was observed and noted since the last call, for viewers that have all before it: what
  /// grows over time, without the description of the world. Goals and texts that may still change
  /// come again.
  [[nodiscard]] ReplayRun take();
  /// The run up to the last take(), for new viewers: the world, a thinned history of poses, all
  /// that happened (of very many, the newest), and otherwise the present state.
  [[nodiscard]] ReplayRun whole() const;
  /// @}

  /// Ends the recording with the present state as the last frame. The builder is empty then.
  /// @throws std::invalid_argument as observe().
  [[nodiscard]] ReplayRun finish(const sim::Simulation& simulation);

 private:
  void add_frame(const sim::Simulation& simulation);
  void add_poses(const sim::Simulation& simulation);
  void add_obstacles(const sim::Simulation& simulation);
  void add_controller(const sim::Simulation& simulation);
  void add_layers(const sim::LayerStack& layers);
  void begin_layers(const sim::CanvasDescription& canvas);
  void add_reading(const sim::Simulation& simulation, sim::Simulation::DeviceId id);
  void add_happenings(const sim::Simulation& simulation);
  void add_goals(const sim::Simulation& simulation);
  void remember_frames(const ReplayRun& part);
  void forget_happenings();

  ReplayOptions options_;
  const sim::LayerStack* layers_ = nullptr;  ///< that are watched; null: the simulation's
  ReplayRun run_;
  std::vector<std::size_t> first_device_;    ///< of each robot: index in ReplayRun::devices
  std::vector<sim::Vec2> goal_of_;           ///< of each robot: its newest goal, if it has one
  std::vector<std::ptrdiff_t> newest_goal_;  ///< of each robot; -1: none
  std::vector<double> tolerance_m_;          ///< of that goal
  std::map<std::string, std::size_t> text_index_;  ///< of ReplayRun::command_texts
  std::map<std::size_t, std::string> last_text_;   ///< of each device: its newest command
  std::size_t command_count_ = 0;
  std::size_t output_bytes_ = 0;
  HappeningsWatch happenings_;
  sim::CanvasDescription canvas_;  ///< as it is now
  int canvas_changes_ = 0;         ///< how often its size has changed
  bool layers_ended_ = false;      ///< because of too many changes
  std::size_t first_layer_ = 0;    ///< index in ReplayRun::layers of those of the present size
  std::vector<sim::LayerId> layer_ids_;               ///< of these layers
  std::vector<std::vector<std::uint8_t>> cells_;      ///< their pictures at the last frame
  std::vector<std::vector<std::uint8_t>> raw_cells_;  ///< and their cells
  std::uint64_t layers_revision_ = 0;
  std::optional<sim::SimTime> layers_ns_;  ///< when they were looked at last
  bool observed_ = false;
  sim::SimTime last_ns_ = 0;
  std::optional<sim::SimTime> last_frame_ns_;
  std::vector<std::uint64_t> newest_reading_;  ///< of each device: its sequence number
  // For take() and whole():
  std::vector<sim::Pose> places_;            ///< of the robots, in the last frame
  std::vector<std::size_t> taken_readings_;  ///< of each device: 0, or 1 that is kept
  struct Known {
    std::size_t series = 0;
    std::size_t lists = 0;
  };
  std::vector<Known> known_;  ///< of each device: how many take() has returned
  /// Elements of the lists of run_ that take() has returned, up to the first one that may change.
  struct Taken {
    std::size_t collisions = 0;
    std::size_t events = 0;
    std::size_t spoken = 0;
    std::size_t goals = 0;
    std::size_t texts = 0;
    std::size_t notes = 0;
  };
  Taken taken_;
  std::vector<sim::SimTime> history_ns_;  ///< thinned, and the newest frame
  std::vector<RobotLog> history_;         ///< of each robot: motion at these times
  sim::SimTime history_period_ns_ = sim::kNanosecondsPerSecond / 5;
};

/// Whether a part of a run, see ReplayBuilder::take(), has anything in it.
[[nodiscard]] bool has_news(const ReplayRun& part);

/// The runs of cells in which two RGBA pictures of equal size differ, with the colours of `now`.
/// Cells with alpha 0 are equal whatever their colour. O(cells).
[[nodiscard]] std::vector<CellRun> cell_runs(const std::vector<std::uint8_t>& before,
                                             const std::vector<std::uint8_t>& now);

}  // namespace playerlike::replay
