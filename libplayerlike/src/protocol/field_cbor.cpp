// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Readings, commands and drawings in CBOR by their tables of fields, without a tree of values. A
// robot's program that reads and commands at each step sends and receives little else.
//
// The common types of fields are written and read here. A field of another type goes through a tree
// of its own, and a reading that is unusual in any way (unknown or missing members, other forms of
// numbers, wrong values) is decoded as a tree, whose errors say what is wrong with it.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "protocol/cbor_items.h"
#include "protocol/codec.h"
#include "protocol/field_codec.h"
#include "protocol/formats.h"
#include "sim/core/utf8.h"

namespace playerlike::protocol {
namespace {

using sim::Field;
using sim::FieldType;

// Larger whole numbers are not read here.
constexpr std::uint64_t kMostUnsigned = std::numeric_limits<std::int64_t>::max();

bool is_utf8_text(std::string_view text) noexcept {
  return sim::find_invalid_utf8(text) == std::string_view::npos;
}

template <typename T>
const T& value_as(const void* value) {
  return *static_cast<const T*>(value);
}

// --- Writing

/// The number of members that a struct has as an object.
std::size_t count_members(const sim::FieldTable& table, const void* object) {
  std::size_t members = 0;
  sim::for_each_field(table, object, [&](const Field& field, const void* owner) {
    if (field.get(owner) == nullptr) {
      members += field.null_if_empty ? 1 : 0;
    } else if (is_in_place(field)) {
      members += field.type == FieldType::kPose ? 3 : 2;
    } else {
      ++members;
    }
  });
  return members;
}

template <typename Property>
bool any_field(const sim::FieldTable& table, Property has_it) {
  bool found = false;
  sim::for_each_field(table, static_cast<const void*>(nullptr),
                      [&](const Field& field, const void*) { found |= has_it(field); });
  return found;
}

/// Whether fields share an object of the message, like "own.ip" and "own.mask".
bool has_dots(const sim::FieldTable& table) {
  return any_field(table, [](const Field& field) { return dot_in(field) != nullptr; });
}

/// Whether all fields are numbers or bools, which are the same in all encodings.
bool has_numbers_only(const sim::FieldTable& table) {
  return !any_field(table, [](const Field& field) {
    return field.type != FieldType::kNumber && field.type != FieldType::kInt &&
           field.type != FieldType::kBool;
  });
}

void append_member(CborWriter& out, std::string_view key, double value) {
  out.text(key);
  out.number(value);
}

void append_pose(CborWriter& out, const sim::Pose& pose) {
  append_member(out, "x", pose.x_m);
  append_member(out, "y", pose.y_m);
  append_member(out, "yaw", pose.yaw_rad);
}

void append_value(const Field& field, const void* value, CborWriter& out) {
  switch (field.type) {
    case FieldType::kNumber:
      return out.number(value_as<double>(value));
    case FieldType::kInt:
    case FieldType::kInt64:
      return out.integer(sim::integer_at(field, value));
    case FieldType::kUint32:
    case FieldType::kUint64:
      return out.unsigned_integer(static_cast<std::uint64_t>(sim::integer_at(field, value)));
    case FieldType::kBool:
      return out.boolean(value_as<bool>(value));
    case FieldType::kNumbers:
      return out.doubles(value_as<std::vector<double>>(value));
    case FieldType::kPose:
      out.object(3);
      return append_pose(out, value_as<sim::Pose>(value));
    default:
      break;
  }
  std::string item;
  append_cbor(encode_field(field, value, Encoding::kCbor), item);
  out.raw(item);
}

void append_members(const sim::FieldTable& table, const void* object, CborWriter& out) {
  sim::for_each_field(table, object, [&](const Field& field, const void* owner) {
    const void* const value = field.get(owner);
    if (value == nullptr) {
      if (!field.null_if_empty) return;
      out.text(field.name);
      return out.null();
    }
    if (!is_in_place(field)) {
      out.text(field.name);
      return append_value(field, value, out);
    }
    if (field.type == FieldType::kPose) return append_pose(out, value_as<sim::Pose>(value));
    const std::string prefix = field.name;
    append_member(out, prefix + 'x', value_as<sim::Vec2>(value).x());
    append_member(out, prefix + 'y', value_as<sim::Vec2>(value).y());
  });
}

void append_device_id(DeviceId device, CborWriter& out) {
  out.text("device");
  out.list(2);
  out.integer(device.robot);
  out.integer(device.device);
}

// --- Reading

/// The members of an object, whose values are not decoded.
class CborMembers {
 public:
  /// Removes an item from the front of `rest`. @return nullopt: it is not an object of up to kMost
  /// members.
  static std::optional<CborMembers> take_from(std::string_view& rest, int depth) {
    const CborHead head = read_cbor_head(rest);
    if (head.major != CborMajor::kObject || head.argument > kMost) return std::nullopt;
    require_cbor_depth(depth + 1);
    CborMembers members;
    members.count_ = static_cast<std::size_t>(head.argument);
    for (std::size_t i = 0; i < members.count_; ++i) {
      const CborHead key = read_cbor_head(rest);
      if (key.major != CborMajor::kText) return std::nullopt;
      members.keys_[i] = take_cbor(rest, key.argument);
      members.values_[i] = take_cbor_item(rest, depth + 1);
    }
    return members;
  }

  /// The value of a key; nullopt if there is none. Must be called once for each key.
  [[nodiscard]] std::optional<std::string_view> take(std::string_view key) {
    // Mostly in the order in which they were written.
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t at = next_ + i < count_ ? next_ + i : next_ + i - count_;
      if (keys_[at] != key) continue;
      next_ = at + 1 < count_ ? at + 1 : 0;
      ++taken_;
      return values_[at];
    }
    return std::nullopt;
  }
  /// Whether all members were taken, so that none is unknown or double.
  [[nodiscard]] bool all_taken() const noexcept { return taken_ == count_; }

 private:
  static constexpr std::size_t kMost = 32;
  std::array<std::string_view, kMost> keys_;
  std::array<std::string_view, kMost> values_;
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  std::size_t taken_ = 0;
};

/// The results are empty for a missing or unusual item.
std::optional<double> number_in(std::optional<std::string_view> item) {
  if (!item) return std::nullopt;
  const CborHead head = read_cbor_head(*item);
  if (head.major != CborMajor::kSimple) return std::nullopt;
  double number = std::numeric_limits<double>::quiet_NaN();
  if (head.info == CborSimple::kFloat) {
    number = std::bit_cast<float>(static_cast<std::uint32_t>(head.argument));
  } else if (head.info == CborSimple::kDouble) {
    number = std::bit_cast<double>(head.argument);
  }
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<std::int64_t> integer_in(std::optional<std::string_view> item) {
  if (!item) return std::nullopt;
  const CborHead head = read_cbor_head(*item);
  if (head.argument > kMostUnsigned) return std::nullopt;
  const auto number = static_cast<std::int64_t>(head.argument);
  if (head.major == CborMajor::kUnsigned) return number;
  return head.major == CborMajor::kNegative ? std::optional(-1 - number) : std::nullopt;
}

std::optional<bool> bool_in(std::string_view item) {
  const CborHead head = read_cbor_head(item);
  if (head.major != CborMajor::kSimple ||
      (head.info != CborSimple::kFalse && head.info != CborSimple::kTrue)) {
    return std::nullopt;
  }
  return head.info == CborSimple::kTrue;
}

bool is_null(std::string_view item) {
  const CborHead head = read_cbor_head(item);
  return head.major == CborMajor::kSimple && head.info == CborSimple::kNull;
}

std::optional<std::string_view> text_in(std::optional<std::string_view> item) {
  if (!item) return std::nullopt;
  const CborHead head = read_cbor_head(*item);
  return head.major == CborMajor::kText && is_utf8_text(*item) ? item : std::nullopt;
}

bool read_doubles(std::string_view item, std::vector<double>& into) {
  const CborHead tag = read_cbor_head(item);
  if (tag.major != CborMajor::kTag || tag.argument != kDoublesTag) return false;
  const CborHead head = read_cbor_head(item);
  if (head.major != CborMajor::kBytes || item.size() % sizeof(double) != 0) return false;
  if (!all_finite_doubles(item)) return false;
  into.resize(item.size() / sizeof(double));
  if (!into.empty()) std::memcpy(into.data(), item.data(), item.size());
  return true;
}

/// Stores a value that is there.
template <typename T>
bool store(const std::optional<T>& value, T& into) {
  if (value) into = *value;
  return value.has_value();
}

bool read_pose(CborMembers& members, sim::Pose& pose) {
  return store(number_in(members.take("x")), pose.x_m) &&
         store(number_in(members.take("y")), pose.y_m) &&
         store(number_in(members.take("yaw")), pose.yaw_rad);
}

bool read_in_place(const Field& field, CborMembers& members, void* value) {
  if (field.type == FieldType::kPose) return read_pose(members, *static_cast<sim::Pose*>(value));
  const std::string prefix = field.name;
  auto& vector = *static_cast<sim::Vec2*>(value);
  return store(number_in(members.take(prefix + 'x')), vector.x()) &&
         store(number_in(members.take(prefix + 'y')), vector.y());
}

bool read_value(const Field& field, std::string_view item, int depth, void* value) {
  switch (field.type) {
    case FieldType::kNumber:
      return store(number_in(item), *static_cast<double*>(value));
    case FieldType::kInt:
    case FieldType::kInt64:
    case FieldType::kUint32:
    case FieldType::kUint64: {
      const std::optional<std::int64_t> number = integer_in(item);
      if (!number || *number < field.least || *number > field.greatest) return false;
      sim::set_integer(field, value, *number);
      return true;
    }
    case FieldType::kBool:
      return store(bool_in(item), *static_cast<bool*>(value));
    case FieldType::kNumbers:
      return read_doubles(item, *static_cast<std::vector<double>*>(value));
    case FieldType::kPose: {
      auto members = CborMembers::take_from(item, depth);
      return members && read_pose(*members, *static_cast<sim::Pose*>(value)) &&
             members->all_taken();
    }
    default:
      break;
  }
  json tree = json::object();
  tree[field.name] = parse_cbor(item, nullptr, {});
  decode_field(field, tree, Encoding::kCbor, value);
  return true;
}

/// Reads the fields of a struct. @return false: something is unusual.
bool read_members(const sim::FieldTable& table, CborMembers& members, int depth, void* object) {
  bool usual = true;
  sim::for_each_field(table, object, [&](const Field& field, void* owner) {
    if (!usual) return;
    if (is_in_place(field)) {
      usual = field.drop == nullptr && read_in_place(field, members, field.set(owner));
      return;
    }
    const std::optional<std::string_view> item = members.take(field.name);
    if (!item) {
      usual = field.drop != nullptr && !field.null_if_empty;
      if (usual) field.drop(owner);
    } else if (field.null_if_empty && is_null(*item)) {
      field.drop(owner);
    } else {
      usual = dot_in(field) == nullptr && read_value(field, *item, depth, field.set(owner));
    }
  });
  return usual && members.all_taken() && (table.check == nullptr || !table.check(object));
}

// Lists and objects around a reading: it is in the list of a message.
constexpr int kDepth = 2;

/// Removes a reading from the front of `rest`.
/// @return nullopt: something is unusual, or wrong.
std::optional<DecodedReading> take_usual_reading(std::string_view& rest) {
  std::optional<CborMembers> members = CborMembers::take_from(rest, kDepth);
  if (!members) return std::nullopt;
  const std::optional<std::string_view> device = members->take("device");
  const std::optional<std::int64_t> sequence = integer_in(members->take("seq"));
  const std::optional<std::int64_t> time_ns = integer_in(members->take("t"));
  const std::optional<std::string_view> type = text_in(members->take("type"));
  if (!device || sequence.value_or(-1) < 0 || time_ns.value_or(-1) < 0 || !type) {
    return std::nullopt;
  }
  std::string_view indices = *device;
  if (const CborHead head = read_cbor_head(indices);
      head.major != CborMajor::kList || head.argument != 2) {
    return std::nullopt;
  }
  DecodedReading decoded;
  for (int* const index : {&decoded.device.robot, &decoded.device.device}) {
    const std::int64_t number = integer_in(take_cbor_item(indices, kDepth + 1)).value_or(-1);
    if (number < 0 || number > std::numeric_limits<int>::max()) return std::nullopt;
    *index = static_cast<int>(number);
  }
  const sim::ReadingKind& kind = reading_kind(*type);
  decoded.reading = kind.make();
  decoded.reading->sequence = static_cast<std::uint64_t>(*sequence);
  decoded.reading->time_ns = *time_ns;
  if (!read_members(*kind.fields, *members, kDepth + 1, kind.object(*decoded.reading))) {
    return std::nullopt;
  }
  return decoded;
}

}  // namespace

void append_cbor_reading(DeviceId device, std::string_view type, const sim::Reading& reading,
                         std::string& out) {
  const sim::ReadingKind& kind = reading_kind(type);
  if (has_dots(*kind.fields)) {
    return append_cbor(encode_reading(device, type, reading, Encoding::kCbor), out);
  }
  const void* const object = kind.object(reading);
  CborWriter writer(out);
  writer.object(4 + count_members(*kind.fields, object));
  append_device_id(device, writer);
  writer.text("seq");
  writer.unsigned_integer(reading.sequence);
  writer.text("t");
  writer.integer(reading.time_ns);
  writer.text("type");
  writer.text(type);
  append_members(*kind.fields, object, writer);
}

DecodedReading take_cbor_reading(std::string_view& rest) {
  const std::string_view all = rest;
  try {
    if (std::optional<DecodedReading> decoded = take_usual_reading(rest)) {
      return std::move(*decoded);
    }
  } catch (const ProtocolError&) {
    // The tree's error says what is wrong.
  }
  rest = all;
  const std::string_view item = take_cbor_item(rest, kDepth);
  return decode_reading(parse_cbor(item, nullptr, {}), Encoding::kCbor);
}

json encoded_list(std::size_t count, std::string_view items) {
  std::string list;
  CborWriter writer(list);
  writer.list(count);
  writer.raw(items);
  return json::binary({list.begin(), list.end()}, kEncodedItemTag);
}

std::vector<DecodedReading> decode_cbor_readings(std::string_view list) {
  const CborHead head = read_cbor_head(list);
  if (head.major != CborMajor::kList) {
    refuse_value("readings", "a list", "an item of another kind");
  }
  std::vector<DecodedReading> readings;
  for (std::uint64_t i = 0; i < head.argument; ++i) readings.push_back(take_cbor_reading(list));
  if (!list.empty()) refuse_cbor("bytes follow the list of readings");
  return readings;
}

void append_command_request(DeviceId device, const sim::Command& command, Encoding encoding,
                            std::string& out) {
  const sim::AlternativeKind<sim::Command>& kind = sim::command_kinds()[command.index()];
  if (encoding != Encoding::kCbor || !has_numbers_only(kind.fields())) {
    return append_encoded({{"do", "command"},
                           {"device", encode_device_id(device)},
                           {"command", encode_command(command)}},
                          encoding, out);
  }
  append_frame(out, [&] {
    CborWriter writer(out);
    writer.object(3);
    writer.text("do");
    writer.text("command");
    append_device_id(device, writer);
    writer.text("command");
    const void* const object = sim::object_in(command);
    writer.object(1 + count_members(kind.fields(), object));
    writer.text("kind");
    writer.text(kind.name);
    append_members(kind.fields(), object, writer);
  });
}

}  // namespace playerlike::protocol
