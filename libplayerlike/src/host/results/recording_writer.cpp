// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/recording_writer.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <variant>

#include "sim/core/file.h"
#include "sim/core/number_text.h"
#include "sim/devices/builtin.h"
#include "sim/world/realism.h"
#include "sim/world/view_mode.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;

constexpr sim::SimTime kHashPeriod_ns = 10 * sim::kNanosecondsPerSecond;
constexpr std::size_t kMostWorldText = std::size_t{1} << 20U;
constexpr std::size_t kCellsPerLayersPeriod = std::size_t{1} << 18U;

/// Whether a command may change more than the robot that gets it.
bool concerns_other_robots(const sim::Command& command) {
  return std::holds_alternative<sim::PlaceCommand>(command) ||
         std::holds_alternative<sim::GripCommand>(command) ||
         std::holds_alternative<sim::SayCommand>(command);
}

/// A canvas of the same kind that takes no memory.
sim::CanvasDescription without_cells(sim::CanvasDescription canvas) {
  canvas.width = canvas.height = 1;
  return canvas;
}

/// The world of a run at its beginning. A restored state may have changed its obstacles.
sim::WorldDescription start_world(const RunSettings& settings, const sim::Simulation& simulation) {
  if (settings.start_state.empty()) return simulation.world();
  sim::WorldDescription world = sim::load_world(simulation.world().file);
  settings.apply_to(world);
  return world;
}

RecordingHead head_of(const RunSettings& settings, const sim::Simulation& simulation,
                      bool has_program_log) {
  const sim::WorldDescription& world = simulation.world();
  RecordingHead head;
  head.format = kRecordingFormat;
  head.version = PLAYPEN_VERSION;
  head.world = world.name;
  std::error_code error;
  const fs::path path = fs::absolute(world.file, error);
  if (!world.file.empty() && !error && fs::is_regular_file(path, error)) {
    head.world_file = path.string();
    std::string text;
    if (path.extension() == ".json" &&
        !sim::read_whole_file(head.world_file, {.most_bytes = kMostWorldText}, text)) {
      head.world_text = std::move(text);
    }
  }
  head.world_hash = hash_of_world(start_world(settings, simulation));
  head.seed = world.simulation.seed;
  head.realism = sim::to_string(world.simulation.realism);
  head.view_mode = sim::to_string(world.canvas.view_mode);
  if (world.simulation.duration_ns)
    head.duration_s = sim::to_seconds(*world.simulation.duration_ns);
  for (const InterfaceChoice& choice : settings.interfaces) {
    head.interfaces.push_back(choice.text());
  }
  head.robot_port = settings.robot_port;
  head.clients = settings.clients;
  head.has_program_log = has_program_log;
  return head;
}

}  // namespace

RecordingWriter::RecordingWriter(const RunSettings& settings, sim::Simulation& simulation)
    : simulation_(simulation),
      file_((fs::path(settings.output_folder) / kRecordingFile).string()),
      printed_bytes_(settings),
      interventions_(simulation.interventions()),
      layers_(without_cells(simulation.layers().description())) {
  out_.open(file_, std::ios::trunc | std::ios::binary);
  const std::string head =
      text_of_head(head_of(settings, simulation, printed_bytes_.known())) + '\n';
  out_ << head << std::flush;
  if (!out_) throw std::runtime_error("cannot write " + file_);
  written_ = head.size();
  next_look_ns_ = next_layers_ns_ = simulation.now_ns();
  next_hash_ns_ = simulation.now_ns() + kHashPeriod_ns;
  if (!settings.start_state.empty()) note_state();
  simulation_.watch_commands([this](sim::Simulation::DeviceId device, const sim::Command& command) {
    note_command(device, command);
  });
}

RecordingWriter::~RecordingWriter() { simulation_.watch_commands({}); }

void RecordingWriter::begin_item(RecordedItem item) {
  note_steps();
  archive_kind(items_, item);
}

void RecordingWriter::note_steps() {
  if (new_steps_ == 0) return;
  RecordedItem item = RecordedItem::kSteps;
  archive_kind(items_, item);
  items_(new_steps_);
  new_steps_ = 0;
}

void RecordingWriter::note_command(sim::Simulation::DeviceId device, const sim::Command& command) {
  sim::StateArchive archive;
  auto kind = static_cast<std::uint8_t>(command.index());
  archive(kind);
  archive.table(sim::command_kinds()[command.index()].fields(),
                const_cast<void*>(sim::object_in(command)));
  robots_alone_ = robots_alone_ && !concerns_other_robots(command);
  const auto bytes = archive.written();
  new_commands_.push_back({device, {bytes.begin(), bytes.end()}});
}

// Between two steps, programs command in any order. If no command concerns other robots, the order
// of the robots makes no difference, and should not tell recordings apart.
void RecordingWriter::note_commands() {
  if (std::exchange(robots_alone_, true)) {
    std::stable_sort(new_commands_.begin(), new_commands_.end(),
                     [](const auto& a, const auto& b) { return a.device.robot < b.device.robot; });
  }
  for (auto& [device, bytes] : new_commands_) {
    std::vector<std::uint8_t>& last = commands_[{device.robot, device.device}];
    const bool same = last == bytes;
    begin_item(same ? RecordedItem::kSameCommand : RecordedItem::kCommand);
    archive_device(items_, device);
    if (same) continue;
    items_.raw(bytes.data(), bytes.size());
    last = std::move(bytes);
  }
  new_commands_.clear();
}

void RecordingWriter::note_read(int port, sim::SimTime oldest_ns) {
  if (!out_.is_open()) return;
  constexpr sim::SimTime kMillisecond_ns = 1'000'000;
  constexpr sim::SimTime kMost_ms = std::numeric_limits<std::uint32_t>::max();
  const sim::SimTime age_ms = (simulation_.now_ns() - oldest_ns) / kMillisecond_ns;
  reads_.emplace_back(static_cast<std::uint16_t>(port),
                      static_cast<std::uint32_t>(std::clamp<sim::SimTime>(age_ms, 0, kMost_ms)));
}

// Between two steps, clients read in any order.
void RecordingWriter::note_reads() {
  std::sort(reads_.begin(), reads_.end());
  for (auto& [port, age_ms] : reads_) {
    begin_item(RecordedItem::kRead);
    items_(port, age_ms);
  }
  reads_.clear();
}

void RecordingWriter::note_state() {
  interventions_ = simulation_.interventions();
  begin_item(RecordedItem::kState);
  // The layers are recorded otherwise.
  sim::LayerStack layers(without_cells(simulation_.layers().description()));
  sim::Snapshot snapshot = simulation_.state_parts().snapshot(layers);
  items_(snapshot);
}

void RecordingWriter::note_printed() {
  const std::optional<std::uint64_t> printed = printed_bytes_.count();
  if (!printed || *printed == printed_) return;
  printed_ = *printed;
  begin_item(RecordedItem::kPrinted);
  items_(printed_);
}

void RecordingWriter::note_layers() {
  sim::LayerStack& layers = simulation_.layers();
  std::vector<sim::LayerInfo> all = layers.layers();
  const std::size_t cells = layers.cell_count() * all.size();
  if (cells > kMostRecordedCells) return;
  next_layers_ns_ += static_cast<sim::SimTime>(cells / kCellsPerLayersPeriod) * kLayersPeriod_ns;
  if (layers_revision_ != layers.revision()) {
    layers_revision_ = layers.revision();
    layers_.set(layers.width(), layers.height(), all);
    begin_item(RecordedItem::kLayers);
    int width = layers.width();
    int height = layers.height();
    std::string text = text_of_layers(all);
    items_(width, height, text);
  }
  for (const sim::LayerInfo& layer : all) {
    const sim::LayerId mine = layers_.find(layer.id).value();
    CellChanges changes =
        CellChanges::between(layers_.stack().bytes(mine), layers.bytes(layer.id), layers.width());
    if (changes.runs.empty()) continue;
    changes.layer = layer.id;
    changes.apply(layers_.stack(), mine);
    begin_item(RecordedItem::kCells);
    items_(changes);
  }
}

std::optional<std::string> RecordingWriter::observe() {
  if (!out_.is_open()) return std::nullopt;
  note_commands();
  note_reads();
  ++new_steps_;
  if (interventions_ != simulation_.interventions()) note_state();
  const sim::SimTime now_ns = simulation_.now_ns();
  if (now_ns < next_look_ns_) return std::nullopt;
  next_look_ns_ += kRecordingPeriod_ns;
  note_printed();
  if (now_ns >= next_layers_ns_) {
    next_layers_ns_ += kLayersPeriod_ns;
    note_layers();
  }
  if (now_ns >= next_hash_ns_) {
    next_hash_ns_ += kHashPeriod_ns;
    begin_item(RecordedItem::kHash);
    std::uint64_t hash = simulation_.state_parts().hash_without_canvas();
    items_(hash);
  }
  return write();
}

std::optional<std::string> RecordingWriter::write() {
  note_steps();
  std::vector<std::uint8_t> bytes = items_.take();
  const bool full = written_ + bytes.size() > kMostRecording;
  if (full) {
    begin_item(RecordedItem::kFull);
    bytes = items_.take();
  }
  errno = 0;
  out_.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  out_.flush();  // the program may be killed at any time
  written_ += bytes.size();
  if (out_ && !full) return std::nullopt;
  const std::string time = sim::fixed_text(sim::to_seconds(simulation_.now_ns()), 2) + " s";
  const std::string why = full         ? "it has " + std::to_string(kMostRecording >> 20U) + " MiB"
                          : errno != 0 ? std::strerror(errno)
                                       : "it cannot be written";
  out_.close();
  simulation_.watch_commands({});
  return "the recording " + file_ + " ends at " + time + ": " + why;
}

std::optional<std::string> RecordingWriter::close() {
  if (!out_.is_open()) return std::nullopt;
  note_printed();
  note_layers();
  begin_item(RecordedItem::kEnd);
  auto problem = write();
  simulation_.watch_commands({});
  out_.close();
  return problem;
}

}  // namespace playerlike
