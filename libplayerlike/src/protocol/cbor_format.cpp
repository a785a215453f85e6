// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// CBOR (RFC 8949). nlohmann's library writes it. The parser is our own, because nlohmann's reads
// single bytes, recurses without limit, and accepts NaN and duplicate keys.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "protocol/formats.h"
#include "protocol/framing.h"
#include "sim/core/utf8.h"

namespace playerlike::protocol {
namespace {

using nlohmann::json;

bool is_utf8(std::string_view text) noexcept {
  return sim::find_invalid_utf8(text) == std::string_view::npos;
}

/// Whether all texts of a value are valid UTF-8.
bool is_valid_utf8(const json& value) {
  if (const auto* text = value.get_ptr<const std::string*>()) return is_utf8(*text);
  if (const auto* object = value.get_ptr<const json::object_t*>()) {
    for (const auto& [key, member] : *object) {
      if (!is_utf8(key) || !is_valid_utf8(member)) return false;
    }
  } else if (const auto* list = value.get_ptr<const json::array_t*>()) {
    for (const json& element : *list) {
      if (!is_valid_utf8(element)) return false;
    }
  }
  return true;
}

std::string with_valid_utf8(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
      .get<std::string>();
}

/// Replaces invalid UTF-8 in a value's texts by U+FFFD.
json with_valid_utf8(const json& value) {
  if (const auto* text = value.get_ptr<const std::string*>()) return with_valid_utf8(*text);
  if (const auto* object = value.get_ptr<const json::object_t*>()) {
    json copy = json::object();
    for (const auto& [key, member] : *object) copy[with_valid_utf8(key)] = with_valid_utf8(member);
    return copy;
  }
  if (const auto* list = value.get_ptr<const json::array_t*>()) {
    json copy = json::array();
    for (const json& element : *list) copy.push_back(with_valid_utf8(element));
    return copy;
  }
  return value;
}

/// Decodes a finite half-precision number (IEEE 754 binary16), as in RFC 8949, appendix D.
double half(std::uint64_t bits) {
  const int exponent = static_cast<int>(bits >> 10U & 0x1fU);
  const double mantissa = static_cast<double>(bits & 0x3ffU);
  const double value = exponent == 0    ? std::ldexp(mantissa, -24)
                       : exponent != 31 ? std::ldexp(mantissa + 1024.0, exponent - 25)
                                        : std::numeric_limits<double>::infinity();
  return (bits & 0x8000U) != 0 ? -value : value;
}

/// Parses one message. It recurses once per level; the number of levels is limited.
class CborReader {
 public:
  CborReader(std::string_view bytes, Spare<std::uint8_t>* spare) : rest_(bytes), spare_(spare) {}

  json read() {
    json value = read_value(0);
    if (!rest_.empty()) refuse("bytes follow the message's end");
    return value;
  }

 private:
  enum Major : std::uint8_t {
    kUnsigned,
    kNegative,
    kBytes,
    kText,
    kList,
    kObject,
    kTag,
    kSimple,
  };
  /// The head of an item (RFC 8949, section 3).
  struct Head {
    Major major;
    std::uint8_t info;       ///< low five bits of the first byte
    std::uint64_t argument;  ///< a value, a length or a count
  };

  [[noreturn]] static void refuse(const std::string& what) {
    throw ProtocolError("protocol/syntax",
                        "invalid CBOR message ('playpen doc protocol' has the format): " + what);
  }

  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) refuse("the message ends too early");
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(size));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  Head read_head() {
    const auto first = static_cast<std::uint8_t>(take(1).front());
    Head head{static_cast<Major>(first >> 5U), static_cast<std::uint8_t>(first & 0x1fU), 0};
    if (head.info < 24) {
      head.argument = head.info;
    } else if (head.info < 28) {
      for (const char byte : take(std::uint64_t{1} << (head.info - 24U))) {
        head.argument = head.argument << 8U | static_cast<std::uint8_t>(byte);
      }
    } else {
      refuse(head.info == 31 ? "an indefinite length" : "a reserved kind of item");
    }
    return head;
  }

  std::vector<std::uint8_t> read_bytes(std::uint64_t size) {
    constexpr std::size_t kLarge = std::size_t{16} << 10U;
    const std::string_view taken = take(size);
    std::vector<std::uint8_t> bytes;
    if (spare_ != nullptr && taken.size() >= kLarge) bytes = spare_->take();
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(taken.data());
    bytes.assign(begin, begin + taken.size());
    return bytes;
  }

  std::string read_text(std::uint64_t size) {
    const std::string_view text = take(size);
    if (!is_utf8(text)) refuse("a text that is not UTF-8");
    return std::string(text);
  }

  json read_value(int depth) {
    const Head head = read_head();
    switch (head.major) {
      case kUnsigned:
        return head.argument;
      case kNegative:
        if (head.argument > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
          throw ProtocolError("protocol/number", "a whole number is less than -2^63");
        }
        return -1 - static_cast<std::int64_t>(head.argument);
      case kBytes:
        return json::binary(read_bytes(head.argument));
      case kText:
        return read_text(head.argument);
      case kList:
        return read_list(head.argument, depth + 1);
      case kObject:
        return read_object(head.argument, depth + 1);
      case kTag:
        return read_doubles(head.argument);
      case kSimple:
        break;
    }
    return read_simple(head);
  }

  // The count may be false. Each element takes at least one byte, so the end of the message bounds
  // the loop.
  json read_list(std::uint64_t count, int depth) {
    require_depth(depth);
    json::array_t list;
    for (; count > 0; --count) list.push_back(read_value(depth));
    return list;
  }

  json read_object(std::uint64_t count, int depth) {
    require_depth(depth);
    json::object_t object;
    for (; count > 0; --count) {
      const Head head = read_head();
      if (head.major != kText) refuse("a key that is no text");
      const auto [at, is_new] = object.emplace(read_text(head.argument), nullptr);
      if (!is_new) {
        throw ProtocolError("protocol/duplicate-key",
                            "duplicate key in an object: " + at->first.substr(0, 200));
      }
      at->second = read_value(depth);
    }
    return object;
  }

  static void require_depth(int depth) {
    if (depth <= kMaxDepth) return;
    throw ProtocolError("protocol/too-deep", "lists and objects are nested more than " +
                                                 std::to_string(kMaxDepth) + " deep");
  }

  json read_doubles(std::uint64_t tag) {
    if (tag != kDoublesTag) refuse("the tag " + std::to_string(tag));
    const Head head = read_head();
    if (head.major != kBytes || head.argument % sizeof(double) != 0) {
      refuse("a typed array that is no byte string of whole doubles");
    }
    std::vector<std::uint8_t> bytes = read_bytes(head.argument);
    // Little-endian: the last two bytes hold sign and exponent. An exponent of all ones means
    // infinity or NaN.
    for (std::size_t i = 6; i < bytes.size(); i += sizeof(double)) {
      if ((bytes[i] & 0xf0U) == 0xf0U && (bytes[i + 1] & 0x7fU) == 0x7fU) refuse_number();
    }
    return json::binary(std::move(bytes), kDoublesTag);
  }

  [[noreturn]] static void refuse_number() {
    throw ProtocolError("protocol/number", "a number is not finite");
  }

  static json read_simple(const Head& head) {
    double value = 0.0;
    switch (head.info) {
      case 20:
        return false;
      case 21:
        return true;
      case 22:
        return nullptr;
      case 25:
        value = half(head.argument);
        break;
      case 26:
        value = std::bit_cast<float>(static_cast<std::uint32_t>(head.argument));
        break;
      case 27:
        value = std::bit_cast<double>(head.argument);
        break;
      default:
        refuse("a simple value that is not true, false or null");
    }
    if (!std::isfinite(value)) refuse_number();
    return value;
  }

  std::string_view rest_;
  Spare<std::uint8_t>* spare_;  // may be null
};

}  // namespace

void append_cbor(const json& value, std::string& out) {
  if (is_valid_utf8(value)) {
    json::to_cbor(value, out);
  } else {
    json::to_cbor(with_valid_utf8(value), out);
  }
}

json parse_cbor(std::string_view bytes, Spare<std::uint8_t>* spare) {
  return CborReader(bytes, spare).read();
}

}  // namespace playerlike::protocol
