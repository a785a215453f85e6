// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/rerun.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "host/results/recording_format.h"
#include "playerlike/host/run_settings.h"
#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/core/state_archive.h"
#include "sim/devices/builtin.h"
#include "sim/world/realism.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFile = kMostRecording + (std::size_t{4} << 20U);

[[noreturn]] void refuse(const std::string& file, const std::string& expected,
                         const std::string& found) {
  throw RecordingError(file + ": expected " + expected + ", found " + found);
}

std::string content_of(const std::string& file) {
  std::string content;
  if (const auto error = sim::read_whole_file(file, {.most_bytes = kMostFile}, content)) {
    refuse(file, "the recording of a run", error->found);
  }
  return content;
}

RecordingHead checked_head(const std::string& file, const std::string& text) {
  RecordingHead head;
  try {
    head = head_from(text);
  } catch (const std::exception& e) {
    refuse(file, "the head of a recording in its first line", e.what());
  }
  if (head.format != kRecordingFormat || head.version != PLAYPEN_VERSION) {
    refuse(file, std::string("a recording of Playpen ") + PLAYPEN_VERSION,
           "one of " + head.version + "; a run can be made again by the version that made it");
  }
  return head;
}

/// The world of a recording, with the settings of its run, which are written into `settings`.
sim::WorldDescription world_of(const std::string& file, const RecordingHead& head,
                               RunSettings& settings) {
  sim::WorldDescription world;
  try {
    world = head.world_text ? sim::load_world_text(*head.world_text, head.world_file)
                            : sim::load_world(head.world_file);
    settings.seed = head.seed;
    settings.duration_s = head.duration_s;
    settings.realism = sim::parse_realism(head.realism);
    settings.view_mode = sim::parse_view_mode(head.view_mode);
    for (const std::string& text : head.interfaces) {
      if (!parse_interface_choice(text, settings.interfaces.emplace_back())) {
        throw std::runtime_error("\"interfaces\" contains \"" + text + '"');
      }
    }
    settings.robot_port = head.robot_port;
    settings.clients = head.clients;  // snapshots tell worlds apart by it
    settings.apply_to(world);
  } catch (const std::exception& e) {
    refuse(file, "a recording of a world that can be read", e.what());
  }
  return world;
}

void check_world(const std::string& file, const RecordingHead& head,
                 const sim::WorldDescription& world) {
  const std::string hash = hash_of_world(world);
  if (hash == head.world_hash) return;
  refuse(file, "the world of the run, whose hash is " + head.world_hash,
         (head.world_file.empty() ? "the default world" : head.world_file) + " with " + hash +
             ": it or a file that it names has changed since");
}

}  // namespace

struct Rerun::Impl {
  explicit Impl(const std::string& folder)
      : file((fs::path(folder) / kRecordingFile).string()), content(content_of(file)) {
    const std::size_t line = std::min(content.find('\n'), content.size());
    head = checked_head(file, content.substr(0, line));
    items.emplace(std::span(reinterpret_cast<const std::uint8_t*>(content.data()), content.size())
                      .subspan(std::min(line + 1, content.size())));
    simulation.emplace(world_of(file, head, settings));
    check_world(file, head, simulation->world());
    layers.emplace(simulation->layers().description());
    if (head.has_program_log) program_log = (fs::path(folder) / kProgramLog).string();
  }

  /// Calls action(), which reads items; what they lack is an error of the file.
  template <typename Action>
  auto reading(const Action& action) {
    try {
      return action();
    } catch (const sim::SnapshotError& e) {
      fail(e.what());
    } catch (const RecordingError&) {
      throw;
    } catch (const std::exception& e) {
      fail(e.what());
    }
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw RecordingError(file + ", byte " + std::to_string(content.size() - items->left()) + ": " +
                         what);
  }

  /// Reads the kind of the next item unless it is known; nullopt: there is none.
  std::optional<RecordedItem> next() {
    if (!kind && items->left() > 0 && !ended) {
      RecordedItem read{};
      archive_kind(*items, read);
      kind = read;
    }
    return kind;
  }

  sim::Simulation::DeviceId read_device() {
    sim::Simulation::DeviceId device{0, 0};
    archive_device(*items, device);
    items->expect(device.robot < simulation->robot_count() &&
                      device.device < simulation->device_count(device.robot),
                  "a device that there is");
    return device;
  }

  void read_command() {
    const bool same = kind == RecordedItem::kSameCommand;
    const sim::Simulation::DeviceId device = read_device();
    const auto known = last_commands.find({device.robot, device.device});
    if (same) {
      items->expect(known != last_commands.end(), "a device that has had a command");
      commands.push_back({device, known->second});
    } else {
      std::uint8_t number = 0;
      items->index(number, sim::command_kinds().size());
      const sim::AlternativeKind<sim::Command>& made = sim::command_kinds()[number];
      sim::Command command = made.make();
      items->table(made.fields(), sim::object_in(command));
      last_commands.insert_or_assign({device.robot, device.device}, command);
      commands.push_back({device, std::move(command)});
    }
    static_cast<void>(simulation->apply(device, commands.back().command));
  }

  void read_read() {
    std::uint16_t port = 0;
    std::uint32_t age_ms = 0;
    (*items)(port, age_ms);
    constexpr sim::SimTime kMillisecond_ns = 1'000'000;
    next_reads.push_back({port, kMillisecond_ns * age_ms});
  }

  void read_layers() {
    int width = 0;
    int height = 0;
    std::string text;
    (*items)(width, height, text);
    items->expect(
        width >= 1 && height >= 1 && width <= sim::kMaxCanvasSide && height <= sim::kMaxCanvasSide,
        "the size of a canvas");
    const std::vector<sim::LayerInfo> all = layers_from(text);
    items->expect(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * all.size() <=
                      kMostRecordedCells,
                  "layers that are recorded");
    layers->set(width, height, all);
    ++layer_changes;
  }

  void read_cells() {
    CellChanges changes;
    (*items)(changes);
    const auto layer = layers->find(changes.layer);
    items->expect(layer.has_value(), "a layer that there is");
    changes.apply(layers->stack(), *layer);
    ++layer_changes;
  }

  /// A recording notes steps at least as often as it is written.
  [[nodiscard]] std::uint32_t most_steps() const {
    const sim::SimTime step_ns = simulation->world().simulation.step_ns;
    return static_cast<std::uint32_t>(kRecordingPeriod_ns / step_ns) + 2;
  }

  void read_hash() {
    std::uint64_t hash = 0;
    (*items)(hash);
    if (simulation->state_parts().hash_without_canvas() == hash) return;
    throw RecordingError(
        file + ": expected the recorded run, found another one by " +
        sim::fixed_text(sim::to_seconds(simulation->now_ns()), 2) +
        " s: this build or machine calculates otherwise than that of the recording");
  }

  void read_state() {
    sim::Snapshot snapshot;
    (*items)(snapshot);
    simulation->restore(snapshot);
  }

  /// Reads the state in which the run began, if it was not the beginning of its world.
  void read_start() {
    while (next() == RecordedItem::kState) {
      read_state();
      kind.reset();
    }
  }

  sim::Snapshot state() const {
    const sim::LayerStack& recorded = layers->stack();
    // Large layers are not recorded, but the simulation has the trails of pens.
    const bool own =
        layer_changes == 0 && simulation->layers().cell_count() == recorded.cell_count();
    const sim::LayerStack& from = own ? simulation->layers() : recorded;
    sim::LayerStack base(from.description());
    base.set_cells(sim::kBaseLayer, {0, 0, from.width(), from.height()},
                   from.cells(sim::kBaseLayer));
    base.set_style(sim::kBaseLayer, from.style(sim::kBaseLayer));
    return simulation->state_parts().snapshot(base);
  }

  /// Reads the items before the next steps. @return whether there are any steps.
  bool read_before_step() {
    commands.clear();
    while (next()) {
      if (kind == RecordedItem::kCommand || kind == RecordedItem::kSameCommand) {
        read_command();
      } else if (kind == RecordedItem::kSteps) {
        (*items)(steps_left);
        items->expect(steps_left > 0 && steps_left <= most_steps(),
                      "the steps of a tenth of a second");
        kind.reset();
        return true;
      } else if (!read_after_step()) {
        return false;
      }
      kind.reset();
    }
    return false;
  }

  /// Reads the next item if it says what was after a step. @return whether it did.
  bool read_after_step() {
    switch (*kind) {
      case RecordedItem::kState:
        read_state();
        return true;
      case RecordedItem::kPrinted:
        (*items)(printed);
        return true;
      case RecordedItem::kLayers:
        read_layers();
        return true;
      case RecordedItem::kCells:
        read_cells();
        return true;
      case RecordedItem::kRead:
        read_read();
        return true;
      case RecordedItem::kHash:
        read_hash();
        return true;
      case RecordedItem::kEnd:
        complete = true;
        ended = true;
        return false;
      case RecordedItem::kFull:
        ended = true;
        return false;
      case RecordedItem::kSteps:
      case RecordedItem::kCommand:
      case RecordedItem::kSameCommand:
        return false;
    }
    return false;
  }

  bool step() {
    if (steps_left == 0) {
      if (!read_before_step()) return false;
    } else {
      commands.clear();
    }
    reads = std::exchange(next_reads, {});
    simulation->step();
    if (--steps_left > 0) return true;
    while (next() && read_after_step()) kind.reset();
    return true;
  }

  const std::string file;
  const std::string content;
  RecordingHead head;
  RunSettings settings;
  std::optional<sim::StateArchive> items;
  std::optional<sim::Simulation> simulation;
  std::optional<RecordedLayers> layers;
  std::string program_log;
  std::optional<RecordedItem> kind;  ///< of the next item, if it was read
  std::uint32_t steps_left = 0;
  std::vector<RecordedCommand> commands;
  std::map<std::pair<int, int>, sim::Command> last_commands;
  std::vector<RecordedRead> reads;
  std::vector<RecordedRead> next_reads;  ///< since the present step
  std::uint64_t layer_changes = 0;
  std::uint64_t printed = 0;
  bool ended = false;
  bool complete = false;
};

Rerun::Rerun(const std::string& folder) : impl_(std::make_unique<Impl>(folder)) {
  impl_->reading([this] { impl_->read_start(); });
}
Rerun::Rerun(Rerun&&) noexcept = default;
Rerun& Rerun::operator=(Rerun&&) noexcept = default;
Rerun::~Rerun() = default;

const sim::Simulation& Rerun::simulation() const noexcept { return *impl_->simulation; }

bool Rerun::step() {
  return impl_->reading([this] { return impl_->step(); });
}

bool Rerun::advance_to(sim::SimTime time_ns) {
  while (impl_->simulation->now_ns() < time_ns) {
    if (!step()) return false;
  }
  return true;
}

std::span<const RecordedCommand> Rerun::commands() const noexcept { return impl_->commands; }
std::span<const RecordedRead> Rerun::reads() const noexcept { return impl_->reads; }
const sim::LayerStack& Rerun::layers() const noexcept { return impl_->layers->stack(); }
std::uint64_t Rerun::layer_changes() const noexcept { return impl_->layer_changes; }
std::uint64_t Rerun::printed_bytes() const noexcept { return impl_->printed; }
const std::string& Rerun::program_log() const noexcept { return impl_->program_log; }
const std::string& Rerun::world_file() const noexcept { return impl_->head.world_file; }
const RunSettings& Rerun::settings() const noexcept { return impl_->settings; }
sim::Snapshot Rerun::state() const { return impl_->state(); }
bool Rerun::complete() const noexcept { return impl_->complete; }

}  // namespace playerlike
