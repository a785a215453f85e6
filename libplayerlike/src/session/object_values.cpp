// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/object_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

#include "sim/core/colour.h"

namespace playerlike {
namespace {

using Numbers = std::vector<double>;

[[noreturn]] void refuse_length(const std::string& property, const std::string& forms,
                                std::size_t length) {
  throw SessionError(SessionError::Code::kBadArgument, "the property \"" + property + "\" is " +
                                                           forms + ", but value_len is " +
                                                           std::to_string(length));
}

template <typename T>
void put(const Numbers& numbers, void* bytes) {
  auto* out = static_cast<unsigned char*>(bytes);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const T number = static_cast<T>(numbers[i]);
    std::memcpy(out + i * sizeof(T), &number, sizeof(T));
  }
}

template <typename T>
Numbers get(const void* bytes, std::size_t count) {
  const auto* in = static_cast<const unsigned char*>(bytes);
  Numbers numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    T number;
    std::memcpy(&number, in + i * sizeof(T), sizeof(T));
    numbers[i] = static_cast<double>(number);
  }
  return numbers;
}

// Reads a text up to a NUL or the end of the bytes.
std::string get_text(const void* bytes, std::size_t length) {
  const auto* in = static_cast<const char*>(bytes);
  return {in, std::find(in, in + length, '\0')};
}

void put_text(const std::string& property, const std::string& text, void* bytes,
              std::size_t length) {
  if (length <= text.size()) {
    refuse_length(property, "a text that needs " + std::to_string(text.size() + 1) + " bytes now",
                  length);
  }
  std::memset(bytes, 0, length);
  std::memcpy(bytes, text.data(), text.size());
}

// --- Colours: 4 bytes 0xAARRGGBB, four floats or doubles in 0..1 (red, green, blue, alpha), or a
// text

constexpr std::size_t kFloats = 4 * sizeof(float);
constexpr std::size_t kDoubles = 4 * sizeof(double);

void put_colour(const std::string& property, const std::string& text, void* bytes,
                std::size_t length) {
  const sim::Colour colour = sim::parse_colour(text).value_or(sim::Colour{});
  const Numbers shares = {colour.r / 255.0, colour.g / 255.0, colour.b / 255.0, colour.a / 255.0};
  if (length == sizeof(std::uint32_t)) {
    const std::uint32_t packed = static_cast<std::uint32_t>(colour.a) << 24U |
                                 static_cast<std::uint32_t>(colour.r) << 16U |
                                 static_cast<std::uint32_t>(colour.g) << 8U | colour.b;
    std::memcpy(bytes, &packed, sizeof packed);
  } else if (length == kFloats) {
    put<float>(shares, bytes);
  } else if (length == kDoubles) {
    put<double>(shares, bytes);
  } else {
    put_text(property, text, bytes, length);
  }
}

std::string get_colour(const void* bytes, std::size_t length) {
  if (length == sizeof(std::uint32_t)) {
    std::uint32_t packed = 0;
    std::memcpy(&packed, bytes, sizeof packed);
    const auto channel = [&](unsigned shift) {
      return static_cast<std::uint8_t>((packed >> shift) & 0xffU);
    };
    // Programs omit the alpha: they write 0xFF00 for green.
    return sim::to_string(sim::Colour{channel(16), channel(8), channel(0), 255});
  }
  if (length != kFloats && length != kDoubles) return get_text(bytes, length);
  const Numbers shares = length == kFloats ? get<float>(bytes, 4) : get<double>(bytes, 4);
  const auto channel = [&](std::size_t i) {
    const double share = std::isfinite(shares[i]) ? std::clamp(shares[i], 0.0, 1.0) : 0.0;
    return static_cast<std::uint8_t>(std::lround(255.0 * share));
  };
  return sim::to_string(sim::Colour{channel(0), channel(1), channel(2), 255});
}

// --- Words for off and on

struct Switch {
  std::string_view property;
  std::string_view off;
  std::string_view on;
};
constexpr Switch kSwitches[] = {{"state", "retracted", "extended"}};

const Switch* switch_of(const std::string& property) {
  const auto* it = std::find_if(std::begin(kSwitches), std::end(kSwitches),
                                [&](const Switch& s) { return s.property == property; });
  return it == std::end(kSwitches) ? nullptr : it;
}

// Whether the bytes have the length of a whole number.
bool is_whole(std::size_t length) { return length == 1 || length == sizeof(std::int32_t); }

void put_whole(int number, void* bytes, std::size_t length) {
  if (length == 1) {
    put<std::int8_t>({static_cast<double>(number)}, bytes);
  } else {
    put<std::int32_t>({static_cast<double>(number)}, bytes);
  }
}

int get_whole(const void* bytes, std::size_t length) {
  const double number =
      length == 1 ? get<std::int8_t>(bytes, 1).front() : get<std::int32_t>(bytes, 1).front();
  return static_cast<int>(number);
}

// Whether a property is a number with decimals, which only a double can hold.
bool has_decimals(const std::string& property) { return property == "height"; }

// --- Poses: x, y, yaw; or x, y, z, yaw (Stage); or x, y, z, roll, pitch, yaw (Player)

Numbers spread_pose(const Numbers& pose, std::size_t count) {
  if (count == 4) return {pose[0], pose[1], 0.0, pose[2]};
  if (count == 6) return {pose[0], pose[1], 0.0, 0.0, 0.0, pose[2]};
  return pose;
}

std::string forms_of(const std::string& property, std::size_t count) {
  const auto bytes = [](std::size_t n) { return std::to_string(n * sizeof(double)) + " bytes"; };
  if (property == "pose") {
    return "3 doubles x, y, yaw (" + bytes(3) + "), 4 doubles x, y, z, yaw (" + bytes(4) +
           ") or 6 doubles x, y, z, roll, pitch, yaw (" + bytes(6) + ')';
  }
  if (property == "size") {
    return "2 doubles, along its own x and y (" + bytes(2) + "), or 3, with its height (" +
           bytes(3) + ')';
  }
  if (has_decimals(property)) return "a double (" + bytes(1) + ')';
  if (count == 1) return "a bool, a 32-bit integer or a double (1, 4 or 8 bytes)";
  return std::to_string(count) + " doubles (" + bytes(count) + ')';
}

bool has_count(const std::string& property, std::size_t count, std::size_t length) {
  if (length % sizeof(double) != 0) return false;
  const std::size_t given = length / sizeof(double);
  if (property == "pose") return given == 3 || given == 4 || given == 6;
  if (property == "size") return given == 2 || given == 3;
  return given == count;
}

}  // namespace

std::string property_name(const std::string& name) {
  std::string own = name;
  constexpr std::string_view kStage = "_mp_";
  if (own.starts_with(kStage)) own.erase(0, kStage.size());
  return own == "color" ? "colour" : own;
}

void write_property(const std::string& property, const PropertyValue& value, void* bytes,
                    std::size_t length) {
  if (const auto* text = std::get_if<std::string>(&value)) {
    const Switch* words = switch_of(property);
    if (property == "colour") return put_colour(property, *text, bytes, length);
    if (words != nullptr && is_whole(length)) {
      return put_whole(*text == words->on ? 1 : 0, bytes, length);
    }
    return put_text(property, *text, bytes, length);
  }
  const auto& numbers = std::get<Numbers>(value);
  if (numbers.size() == 1 && is_whole(length) && !has_decimals(property)) {
    if (length == 1 && std::abs(numbers.front()) > std::numeric_limits<std::int8_t>::max()) {
      refuse_length(property, "a number that needs 4 or 8 bytes now", length);
    }
    return put_whole(static_cast<int>(numbers.front()), bytes, length);
  }
  if (!has_count(property, numbers.size(), length)) {
    refuse_length(property, forms_of(property, numbers.size()), length);
  }
  Numbers given = property == "pose" ? spread_pose(numbers, length / sizeof(double)) : numbers;
  given.resize(length / sizeof(double));
  put<double>(given, bytes);
}

PropertyValue read_property(const std::string& property, const PropertyValue& now,
                            const void* bytes, std::size_t length) {
  if (std::holds_alternative<std::string>(now)) {
    const Switch* words = switch_of(property);
    if (property == "colour") return get_colour(bytes, length);
    if (words != nullptr && is_whole(length)) {
      return std::string(get_whole(bytes, length) != 0 ? words->on : words->off);
    }
    return get_text(bytes, length);
  }
  const std::size_t count = std::get<Numbers>(now).size();
  if (count == 1 && is_whole(length)) {
    return Numbers{static_cast<double>(get_whole(bytes, length))};
  }
  if (!has_count(property, count, length))
    refuse_length(property, forms_of(property, count), length);
  Numbers given = get<double>(bytes, length / sizeof(double));
  if (property == "pose") given = {given[0], given[1], given.back()};
  return given;
}

}  // namespace playerlike
