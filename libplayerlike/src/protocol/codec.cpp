// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// All messages except readings and commands, which are in field_codec.cpp.
#include "protocol/codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "protocol/cbor_items.h"
#include "sim/core/base64.h"

namespace playerlike::protocol {
namespace {

// Arrays of numbers are little-endian on the wire and are copied by memcpy.
static_assert(std::endian::native == std::endian::little,
              "bytes must be swapped where this file uses memcpy");

constexpr std::int64_t kLeastInt = std::numeric_limits<int>::min();
constexpr std::int64_t kMostInt = std::numeric_limits<int>::max();

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string out = "\"";
  out += text.substr(0, kMost);
  out += text.size() > kMost ? "...\"" : "\"";
  return out;
}

std::string described(const json& value) {
  switch (value.type()) {
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "a list of " + std::to_string(value.size());
    case json::value_t::binary:
      return std::to_string(value.get_binary().size()) + " bytes";
    case json::value_t::string:
      return in_quotes(value.get_ref<const std::string&>());
    default:
      return value.dump();
  }
}

/// The whole number in an integer or a float; nullopt for anything else.
std::optional<std::int64_t> whole_number(const json& value) {
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (std::cmp_greater(number, std::numeric_limits<std::int64_t>::max())) return std::nullopt;
    return static_cast<std::int64_t>(number);
  }
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number_float()) {
    constexpr double kMostExact = 9007199254740992.0;  // 2^53
    const double number = value.get<double>();
    if (std::abs(number) <= kMostExact && std::trunc(number) == number) {
      return static_cast<std::int64_t>(number);
    }
  }
  return std::nullopt;
}

/// The bytes of a value. @param key  names the value in errors.
std::vector<std::uint8_t> bytes_of(const json& value, const char* key, Encoding encoding) {
  if (encoding == Encoding::kCbor) {
    if (value.is_binary() && !value.get_binary().has_subtype()) return value.get_binary();
    refuse_value(key, "a byte string", value);
  }
  if (const auto* text = value.get_ptr<const std::string*>()) {
    if (auto decoded = sim::from_base64(*text)) return std::move(*decoded);
  }
  refuse_value(key, "bytes as a text in base64", value);
}

/// Calls use(span) with the bytes of a value; in CBOR without a copy.
template <typename Use>
auto with_bytes(const json& value, const char* key, Encoding encoding, Use use) {
  if (encoding == Encoding::kCbor && value.is_binary() && !value.get_binary().has_subtype()) {
    return use(std::span<const std::uint8_t>(value.get_binary()));
  }
  const std::vector<std::uint8_t> copy = bytes_of(value, key, encoding);
  return use(std::span<const std::uint8_t>(copy));
}

/// The bytes of numbers in memory order.
template <typename Number>
std::vector<std::uint8_t> memory_of(std::span<const Number> numbers) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(numbers.data());
  return {begin, begin + numbers.size_bytes()};
}

template <typename Number>
void copy_numbers(std::span<const std::uint8_t> bytes, std::vector<Number>& into) {
  into.resize(bytes.size() / sizeof(Number));
  if (!into.empty()) std::memcpy(into.data(), bytes.data(), into.size() * sizeof(Number));
}

template <typename Number>
std::vector<Number> numbers_in(std::span<const std::uint8_t> bytes) {
  std::vector<Number> numbers;
  copy_numbers(bytes, numbers);
  return numbers;
}

// --- drawings

using DrawKind = sim::DrawOperation::Kind;

/// A drawing in CBOR: fields of 32 bits.
struct WireDrawing {
  std::int32_t kind;
  std::int32_t layer;
  std::int32_t x0, y0;
  std::int32_t x1, y1;
  std::uint32_t value;
};
static_assert(sizeof(WireDrawing) == 28);

constexpr std::string_view kDrawKinds[] = {"pixel", "line", "fill"};

json encode_drawing(const sim::DrawOperation& drawing) {
  json list = json::array({kDrawKinds[static_cast<std::size_t>(drawing.kind)], drawing.layer});
  if (drawing.kind != DrawKind::kFill) {
    list.push_back(drawing.x0);
    list.push_back(drawing.y0);
  }
  if (drawing.kind == DrawKind::kLine) {
    list.push_back(drawing.x1);
    list.push_back(drawing.y1);
  }
  list.push_back(drawing.value.bits);
  return list;
}

constexpr const char* kDrawingForms =
    R"(drawings like ["pixel", layer, x, y, value], ["line", layer, x0, y0, x1, y1, value] or )"
    R"(["fill", layer, value], in whole numbers)";

sim::DrawOperation decode_drawing(const json& drawing) {
  const json::array_t& list = require_list(drawing, "drawings", kDrawingForms);
  const auto* word = list.empty() ? nullptr : list.front().get_ptr<const std::string*>();
  const auto* const kind = word == nullptr
                               ? std::end(kDrawKinds)
                               : std::find(std::begin(kDrawKinds), std::end(kDrawKinds), *word);
  if (kind == std::end(kDrawKinds)) refuse_value("drawings", kDrawingForms, drawing);
  std::size_t next = 1;
  const auto number = [&](std::int64_t least, std::int64_t most) {
    const std::optional<std::int64_t> value =
        next < list.size() ? whole_number(list[next]) : std::nullopt;
    if (!value || *value < least || *value > most) {
      refuse_value("drawings", kDrawingForms, drawing);
    }
    ++next;
    return *value;
  };
  const auto coordinate = [&] { return static_cast<int>(number(kLeastInt, kMostInt)); };
  sim::DrawOperation decoded;
  decoded.kind = static_cast<DrawKind>(kind - std::begin(kDrawKinds));
  decoded.layer = coordinate();
  if (decoded.kind != DrawKind::kFill) {
    decoded.x0 = coordinate();
    decoded.y0 = coordinate();
  }
  if (decoded.kind == DrawKind::kLine) {
    decoded.x1 = coordinate();
    decoded.y1 = coordinate();
  }
  decoded.value.bits =
      static_cast<std::uint32_t>(number(0, std::numeric_limits<std::uint32_t>::max()));
  if (next != list.size()) refuse_value("drawings", kDrawingForms, drawing);
  return decoded;
}

WireDrawing to_wire(const sim::DrawOperation& drawing) {
  const bool has_place = drawing.kind != DrawKind::kFill;
  const bool has_end = drawing.kind == DrawKind::kLine;
  return {static_cast<std::int32_t>(drawing.kind),
          drawing.layer,
          has_place ? drawing.x0 : 0,
          has_place ? drawing.y0 : 0,
          has_end ? drawing.x1 : 0,
          has_end ? drawing.y1 : 0,
          drawing.value.bits};
}

sim::DrawOperation from_wire(const WireDrawing& wire) {
  if (wire.kind < 0 || wire.kind > static_cast<std::int32_t>(DrawKind::kFill)) {
    refuse_value("drawings", "a kind of drawing from 0 to 2", wire.kind);
  }
  const sim::DrawOperation drawing{static_cast<DrawKind>(wire.kind),
                                   wire.layer,
                                   wire.x0,
                                   wire.y0,
                                   wire.x1,
                                   wire.y1,
                                   {wire.value}};
  const WireDrawing used = to_wire(drawing);
  return {drawing.kind, used.layer, used.x0, used.y0, used.x1, used.y1, drawing.value};
}

// --- words

struct ErrorName {
  SessionError::Code code;
  std::string_view id;
};
constexpr ErrorName kErrorNames[] = {
    {SessionError::Code::kFinished, "session/finished"},
    {SessionError::Code::kDisconnected, "session/disconnected"},
    {SessionError::Code::kNoSuchDevice, "session/no-such-device"},
    {SessionError::Code::kNotAvailable, "session/not-available"},
    {SessionError::Code::kBadArgument, "session/bad-argument"},
};

}  // namespace

void refuse_value(std::string_view key, std::string_view expected, const json& found) {
  std::string message(key);
  message += ": expected ";
  message += expected;
  message += ", found ";
  message += described(found);
  throw ProtocolError("protocol/bad-value", message);
}

const json& require(const json& object, const char* key) {
  if (!object.is_object()) {
    refuse_value(std::string("what holds ") + in_quotes(key), "an object", object);
  }
  const auto member = object.find(key);
  if (member == object.end()) {
    throw ProtocolError("protocol/bad-value",
                        std::string("the key ") + in_quotes(key) + " is missing");
  }
  return *member;
}

double require_number(const json& object, const char* key) {
  const json& value = require(object, key);
  if (!value.is_number()) refuse_value(key, "a number", value);
  const auto number = value.get<double>();
  if (!std::isfinite(number)) refuse_value(key, "a finite number", value);
  return number;
}

std::int64_t require_integer(const json& object, const char* key, std::int64_t least,
                             std::int64_t most) {
  const json& value = require(object, key);
  const std::optional<std::int64_t> number = whole_number(value);
  if (!number || *number < least || *number > most) {
    refuse_value(
        key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most), value);
  }
  return *number;
}

bool require_bool(const json& object, const char* key) {
  const json& value = require(object, key);
  if (!value.is_boolean()) refuse_value(key, "true or false", value);
  return value.get<bool>();
}

std::string require_text(const json& object, const char* key) {
  const json& value = require(object, key);
  if (!value.is_string()) refuse_value(key, "a text", value);
  return value.get<std::string>();
}

const json::array_t& require_list(const json& value, const char* key, const char* expected) {
  const auto* list = value.get_ptr<const json::array_t*>();
  if (list == nullptr) refuse_value(key, expected, value);
  return *list;
}

void refuse_unknown_keys(const json& object, std::span<const std::string_view> known,
                         std::string_view what) {
  const auto* members = object.get_ptr<const json::object_t*>();
  if (members == nullptr) refuse_value(what, "an object", object);
  for (const auto& [key, member] : *members) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const std::string_view name : known) {
      list += list.empty() ? "" : ", ";
      list += name;
    }
    throw ProtocolError("protocol/bad-value", std::string(what) + " has the unknown key " +
                                                  in_quotes(key) + "; it may have: " + list);
  }
}

json bytes(std::vector<std::uint8_t> value, Encoding encoding) {
  if (encoding == Encoding::kCbor) return json::binary(std::move(value));
  return sim::to_base64(value);
}

std::vector<std::uint8_t> require_bytes(const json& object, const char* key, Encoding encoding) {
  return bytes_of(require(object, key), key, encoding);
}

json doubles(std::span<const double> values, Encoding encoding) {
  if (encoding == Encoding::kCbor) return json::binary(memory_of(values), kDoublesTag);
  return json::array_t(values.begin(), values.end());
}

std::vector<double> require_doubles(const json& object, const char* key, Encoding) {
  const json& value = require(object, key);
  std::vector<double> numbers;
  if (value.is_binary() && value.get_binary().has_subtype() &&
      value.get_binary().subtype() == kDoublesTag) {
    numbers = numbers_in<double>(value.get_binary());
  } else {
    const json::array_t& list = require_list(value, key, "a list of numbers");
    numbers.reserve(list.size());
    for (const json& element : list) {
      if (!element.is_number()) refuse_value(key, "a list of numbers", element);
      numbers.push_back(element.get<double>());
    }
  }
  // decode() makes finite numbers only, but the value may come from elsewhere.
  const auto is_finite = [](double number) { return std::isfinite(number); };
  if (!std::all_of(numbers.begin(), numbers.end(), is_finite)) {
    refuse_value(key, "a list of finite numbers", value);
  }
  return numbers;
}

json encode_device_id(DeviceId device) { return json::array({device.robot, device.device}); }

DeviceId require_device_id(const json& object, const char* key) {
  constexpr const char* kExpected = "[robot, device], two indices from 0";
  const json& value = require(object, key);
  const json::array_t& list = require_list(value, key, kExpected);
  int indices[2] = {};
  if (list.size() != std::size(indices)) refuse_value(key, kExpected, value);
  for (std::size_t i = 0; i < std::size(indices); ++i) {
    const std::optional<std::int64_t> index = whole_number(list[i]);
    if (!index || *index < 0 || *index > kMostInt) refuse_value(key, kExpected, list[i]);
    indices[i] = static_cast<int>(*index);
  }
  return {indices[0], indices[1]};
}

json encode_pose(const sim::Pose& pose) {
  return {{"x", pose.x_m}, {"y", pose.y_m}, {"yaw", pose.yaw_rad}};
}

sim::Pose decode_pose(const json& pose) {
  return {require_number(pose, "x"), require_number(pose, "y"), require_number(pose, "yaw")};
}

json encode_property(const PropertyValue& value) {
  return std::visit([](const auto& what) { return json(what); }, value);
}

PropertyValue require_property(const json& object, const char* key) {
  const json& value = require(object, key);
  if (value.is_string()) return value.get<std::string>();
  constexpr std::size_t kMost = 64;
  const bool numbers =
      value.is_array() && value.size() <= kMost &&
      std::all_of(value.begin(), value.end(), [](const json& x) { return x.is_number(); });
  if (!numbers) refuse_value(key, "a text or a list of at most 64 numbers", value);
  return value.get<std::vector<double>>();
}

json encode_drawings(std::span<const sim::DrawOperation> drawings, Encoding encoding) {
  if (encoding == Encoding::kJson) {
    json list = json::array();
    for (const sim::DrawOperation& drawing : drawings) list.push_back(encode_drawing(drawing));
    return list;
  }
  std::vector<std::uint8_t> out(drawings.size() * sizeof(WireDrawing));
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    const WireDrawing wire = to_wire(drawings[i]);
    std::memcpy(out.data() + i * sizeof wire, &wire, sizeof wire);
  }
  return bytes(std::move(out), encoding);
}

void append_draw_request(std::span<const sim::DrawOperation> drawings, Encoding encoding,
                         std::string& out) {
  if (encoding == Encoding::kJson) {
    return append_encoded({{"do", "draw"}, {"drawings", encode_drawings(drawings, encoding)}},
                          encoding, out);
  }
  append_frame(out, [&] {
    CborWriter writer(out);
    writer.object(2);
    writer.text("do");
    writer.text("draw");
    writer.text("drawings");
    writer.head(CborMajor::kBytes, drawings.size() * sizeof(WireDrawing));
    for (const sim::DrawOperation& drawing : drawings) {
      const WireDrawing wire = to_wire(drawing);
      writer.raw({reinterpret_cast<const char*>(&wire), sizeof wire});
    }
  });
}

void append_set_cells_request(sim::LayerId layer, const sim::CellRect& rect,
                              std::span<const sim::CellValue> cells, Encoding encoding,
                              std::string& out) {
  if (encoding == Encoding::kJson) {
    return append_encoded({{"do", "set_cells"},
                           {"layer", layer},
                           {"rect", {rect.column, rect.row, rect.width, rect.height}},
                           {"cells", encode_cells(cells, encoding)}},
                          encoding, out);
  }
  append_frame(out, [&] {
    CborWriter writer(out);
    writer.object(4);
    writer.text("do");
    writer.text("set_cells");
    writer.text("layer");
    writer.integer(layer);
    writer.text("rect");
    writer.list(4);
    for (const int number : {rect.column, rect.row, rect.width, rect.height}) {
      writer.integer(number);
    }
    writer.text("cells");
    writer.head(CborMajor::kBytes, cells.size_bytes());
    writer.raw({reinterpret_cast<const char*>(cells.data()), cells.size_bytes()});
  });
}

std::vector<sim::DrawOperation> decode_drawings(const json& drawings, Encoding encoding) {
  std::vector<sim::DrawOperation> decoded;
  if (encoding == Encoding::kJson) {
    const json::array_t& list = require_list(drawings, "drawings", kDrawingForms);
    decoded.reserve(list.size());
    for (const json& drawing : list) decoded.push_back(decode_drawing(drawing));
    return decoded;
  }
  with_bytes(drawings, "drawings", encoding, [&](std::span<const std::uint8_t> bytes) {
    if (bytes.size() % sizeof(WireDrawing) != 0) {
      refuse_value("drawings", "bytes, 28 a drawing", drawings);
    }
    decoded.reserve(bytes.size() / sizeof(WireDrawing));
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(WireDrawing)) {
      WireDrawing wire;
      std::memcpy(&wire, bytes.data() + at, sizeof wire);
      decoded.push_back(from_wire(wire));
    }
  });
  return decoded;
}

json encode_occupancy(std::span<const float> cells, Encoding encoding) {
  return bytes(memory_of(cells), encoding);
}

std::vector<float> decode_occupancy(const json& cells, std::size_t count, Encoding encoding) {
  const std::size_t size = count * sizeof(float);
  auto decoded = with_bytes(cells, "cells", encoding, [&](std::span<const std::uint8_t> bytes) {
    if (bytes.size() != size) {
      refuse_value("cells", std::to_string(size) + " bytes, four a cell", cells);
    }
    return numbers_in<float>(bytes);
  });
  const auto is_occupancy = [](float value) { return value >= 0.0F && value <= 1.0F; };
  if (!std::all_of(decoded.begin(), decoded.end(), is_occupancy)) {
    refuse_value("cells", "numbers in 0..1", cells);
  }
  return decoded;
}

json encode_cells(std::span<const sim::CellValue> cells, Encoding encoding) {
  return bytes(memory_of(cells), encoding);
}

void decode_cells(const json& cells, Encoding encoding, std::vector<sim::CellValue>& into) {
  with_bytes(cells, "cells", encoding, [&](std::span<const std::uint8_t> bytes) {
    if (bytes.size() % sizeof(sim::CellValue) != 0) {
      refuse_value("cells", "bytes, four a cell", cells);
    }
    copy_numbers(bytes, into);
  });
}

std::vector<sim::CellValue> decode_cells(const json& cells, Encoding encoding) {
  std::vector<sim::CellValue> decoded;
  decode_cells(cells, encoding, decoded);
  return decoded;
}

std::string_view error_id(SessionError::Code code) noexcept {
  for (const ErrorName& name : kErrorNames) {
    if (name.code == code) return name.id;
  }
  return "session/bad-argument";  // not reached: all codes are named
}

std::optional<SessionError::Code> session_error_code(std::string_view id) noexcept {
  for (const ErrorName& name : kErrorNames) {
    if (name.id == id) return name.code;
  }
  return std::nullopt;
}

}  // namespace playerlike::protocol
