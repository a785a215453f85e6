// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/results/recording_format.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "protocol/codec.h"
#include "protocol/field_codec.h"
#include "protocol/message_table.h"
#include "sim/core/number_text.h"
#include "sim/simulation/world_hash.h"

namespace sim {

MESSAGE(playerlike::RecordingHead, field<&T::format>("playpen_recording"),
        field<&T::version>("version"), field<&T::world>("world"),
        field<&T::world_file>("world_file"), field<&T::world_text>("world_text"),
        field<&T::world_hash>("world_hash"), field<&T::seed>("seed"), field<&T::realism>("realism"),
        field<&T::view_mode>("view_mode"), field<&T::duration_s>("duration", "s"),
        field<&T::interfaces>("interfaces"), field<&T::robot_port>("port"),
        field<&T::clients>("clients"), field<&T::has_program_log>("program_log"))

}  // namespace sim

namespace playerlike {
namespace {

using nlohmann::json;

constexpr std::size_t kByteIndices = 256;
constexpr std::size_t kCellBytes = sizeof(std::uint32_t);

void append_number(std::uint64_t number, std::vector<std::uint8_t>& to) {
  for (; number >= 0x80U; number >>= 7U) to.push_back(static_cast<std::uint8_t>(number | 0x80U));
  to.push_back(static_cast<std::uint8_t>(number));
}

/// Reads the bytes of CellChanges::runs.
class RunReader {
 public:
  explicit RunReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  [[nodiscard]] bool done() const { return left_.empty(); }
  [[nodiscard]] std::uint64_t number() {
    constexpr unsigned kMostShift = 35;
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift <= kMostShift; shift += 7) {
      const std::uint64_t part = byte();
      number |= (part & 0x7fU) << shift;
      if (part < 0x80U) return number;
    }
    throw sim::SnapshotError("a number of at most 42 bits", "more");
  }
  [[nodiscard]] std::uint64_t index(bool in_one_byte) {
    std::uint64_t index = 0;
    for (unsigned shift = 0; shift < (in_one_byte ? 8U : 32U); shift += 8) {
      index |= static_cast<std::uint64_t>(byte()) << shift;
    }
    return index;
  }

 private:
  [[nodiscard]] std::uint8_t byte() {
    if (left_.empty()) throw sim::SnapshotError("a complete run of cells", "its end");
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }

  std::span<const std::uint8_t> left_;
};

std::uint32_t cell_at(std::span<const std::uint8_t> cells, std::size_t index) {
  std::uint32_t value = 0;
  std::memcpy(&value, cells.data() + index * kCellBytes, kCellBytes);
  return value;
}

}  // namespace

void archive_kind(sim::StateArchive& archive, RecordedItem& item) {
  auto number = static_cast<std::uint8_t>(item);
  archive.index(number, static_cast<std::size_t>(RecordedItem::kEnd) + 1);
  item = static_cast<RecordedItem>(number);
}

void archive_device(sim::StateArchive& archive, sim::Simulation::DeviceId& device) {
  for (int* number : {&device.robot, &device.device}) {
    auto small = static_cast<std::uint16_t>(*number);  // a world has fewer robots and devices
    archive(small);
    *number = small;
  }
}

void RecordedLayers::set(int width, int height, const std::vector<sim::LayerInfo>& layers) {
  if (width != stack_.width() || height != stack_.height()) stack_.resize(width, height);
  std::erase_if(known_, [&](const auto& known) {
    const bool stays = std::any_of(layers.begin(), layers.end(),
                                   [&](const auto& layer) { return layer.id == known.first; });
    if (!stays) static_cast<void>(stack_.remove(known.second.id));
    return !stays;
  });
  // Of layers of equal priority and owner, the older one is below.
  std::vector<sim::LayerInfo> by_age = layers;
  std::sort(by_age.begin(), by_age.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  for (const sim::LayerInfo& layer : by_age) {
    const auto found = known_.find(layer.id);
    if (layer.id == sim::kBaseLayer) {
      stack_.set_style(sim::kBaseLayer, layer.style);
    } else if (found != known_.end()) {
      stack_.set_style(found->second.id, layer.style);
    } else {
      known_[layer.id] = {stack_.add(layer.kind, layer.style, layer.owner), layer.kind};
    }
  }
}

std::optional<sim::LayerId> RecordedLayers::find(sim::LayerId of_run) const {
  if (of_run == sim::kBaseLayer) return sim::kBaseLayer;
  const auto found = known_.find(of_run);
  return found == known_.end() ? std::nullopt : std::optional(found->second.id);
}

CellChanges CellChanges::between(std::span<const std::uint8_t> before,
                                 std::span<const std::uint8_t> after, int width) {
  struct Run {
    std::size_t skipped;
    std::size_t length;
    std::size_t value;
  };
  CellChanges changes;
  std::map<std::uint32_t, std::size_t> indices;
  std::vector<Run> runs;
  std::size_t end = 0;
  const auto columns = static_cast<std::size_t>(width);
  const std::size_t row_bytes = columns * kCellBytes;
  for (std::size_t row = 0; (row + 1) * row_bytes <= after.size(); ++row) {
    if (std::memcmp(before.data() + row * row_bytes, after.data() + row * row_bytes, row_bytes) ==
        0) {
      continue;
    }
    const std::size_t row_end = (row + 1) * columns;
    for (std::size_t i = row * columns; i < row_end;) {
      const std::uint32_t value = cell_at(after, i);
      if (cell_at(before, i) == value) {
        ++i;
        continue;
      }
      std::size_t last = i + 1;
      while (last < row_end && cell_at(after, last) == value && cell_at(before, last) != value) {
        ++last;
      }
      const auto [known, is_new] = indices.emplace(value, indices.size());
      if (is_new) changes.values.push_back(value);
      runs.push_back({i - end, last - i, known->second});
      i = end = last;
    }
  }
  const bool one_byte = changes.values.size() <= kByteIndices;
  for (const Run& run : runs) {
    append_number(run.skipped, changes.runs);
    append_number(run.length, changes.runs);
    for (unsigned shift = 0; shift < (one_byte ? 8U : 32U); shift += 8) {
      changes.runs.push_back(static_cast<std::uint8_t>(run.value >> shift));
    }
  }
  return changes;
}

void CellChanges::apply(sim::LayerStack& stack, sim::LayerId to) const {
  const std::uint64_t columns = static_cast<std::uint64_t>(stack.width());
  const std::uint64_t cells = stack.cell_count();
  std::vector<sim::CellValue> same;
  std::uint64_t end = 0;
  for (RunReader reader(runs); !reader.done();) {
    const std::uint64_t begin = end + reader.number();
    const std::uint64_t length = reader.number();
    const std::uint64_t index = reader.index(values.size() <= kByteIndices);
    if (length == 0 || begin >= cells || length > columns - begin % columns ||
        index >= values.size()) {
      throw sim::SnapshotError("runs of cells in the rows of the canvas", "others");
    }
    end = begin + length;
    same.assign(length, sim::CellValue{values[index]});
    stack.set_cells(to,
                    {static_cast<int>(begin % columns), static_cast<int>(begin / columns),
                     static_cast<int>(length), 1},
                    same);
  }
}

std::string hash_of_world(sim::WorldDescription world) {
  world.simulation.start_gate_clients = 1;
  return sim::hexadecimal_text(sim::world_hash(world), 16);
}

std::string text_of_head(const RecordingHead& head) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  protocol::write_fields(sim::fields_of<RecordingHead>(), &head, out, protocol::Encoding::kJson);
  return out.dump(-1, ' ', false, json::error_handler_t::replace);
}

RecordingHead head_from(const std::string& text) {
  RecordingHead head;
  protocol::read_fields(sim::fields_of<RecordingHead>(), nlohmann::ordered_json::parse(text),
                        protocol::Encoding::kJson, &head);
  return head;
}

std::string text_of_layers(const std::vector<sim::LayerInfo>& layers) {
  return protocol::encode_layers(layers).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::vector<sim::LayerInfo> layers_from(const std::string& text) {
  return protocol::decode_layers(json::parse(text));
}

}  // namespace playerlike
