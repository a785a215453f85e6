// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// CBOR (RFC 8949) from and to trees of values. Our own, because nlohmann's parser reads single
// bytes, recurses without limit, and accepts NaN and duplicate keys, and its writer takes a call
// for each byte.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "protocol/cbor_items.h"
#include "protocol/formats.h"
#include "protocol/framing.h"
#include "sim/core/utf8.h"

namespace playerlike::protocol {
namespace {

using nlohmann::json;

bool is_utf8(std::string_view text) noexcept {
  return sim::find_invalid_utf8(text) == std::string_view::npos;
}

std::string with_valid_utf8(const std::string& text) {
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace))
      .get<std::string>();
}

/// Appends a text; invalid UTF-8 is replaced by U+FFFD.
void append_text(const std::string& text, CborWriter& out) {
  is_utf8(text) ? out.text(text) : out.text(with_valid_utf8(text));
}

void append_binary(const json::binary_t& binary, CborWriter& out) {
  if (!binary.has_subtype()) return out.bytes(binary);
  if (binary.subtype() == kEncodedItemTag) {
    return out.raw({reinterpret_cast<const char*>(binary.data()), binary.size()});
  }
  out.head(CborMajor::kTag, binary.subtype());
  out.bytes(binary);
}

void append_value(const json& value, CborWriter& out) {
  switch (value.type()) {
    case json::value_t::object: {
      const auto& object = value.get_ref<const json::object_t&>();
      out.object(object.size());
      for (const auto& [key, member] : object) {
        append_text(key, out);
        append_value(member, out);
      }
      return;
    }
    case json::value_t::array: {
      const auto& list = value.get_ref<const json::array_t&>();
      out.list(list.size());
      for (const json& element : list) append_value(element, out);
      return;
    }
    case json::value_t::string:
      return append_text(value.get_ref<const std::string&>(), out);
    case json::value_t::boolean:
      return out.boolean(value.get<bool>());
    case json::value_t::number_integer:
      return out.integer(value.get<std::int64_t>());
    case json::value_t::number_unsigned:
      return out.unsigned_integer(value.get<std::uint64_t>());
    case json::value_t::number_float:
      return out.number(value.get<double>());
    case json::value_t::binary:
      return append_binary(value.get_binary(), out);
    case json::value_t::null:
    case json::value_t::discarded:
      break;
  }
  out.null();
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
  CborReader(std::string_view bytes, Spare<std::uint8_t>* spare, std::string_view encoded)
      : rest_(bytes), spare_(spare), encoded_(encoded) {}

  json read() {
    json value = read_value(0);
    if (!rest_.empty()) refuse_cbor("bytes follow the message's end");
    return value;
  }

 private:
  std::vector<std::uint8_t> read_bytes(std::uint64_t size) {
    constexpr std::size_t kLarge = std::size_t{16} << 10U;
    const std::string_view taken = take_cbor(rest_, size);
    std::vector<std::uint8_t> bytes;
    if (spare_ != nullptr && taken.size() >= kLarge) bytes = spare_->take();
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(taken.data());
    bytes.assign(begin, begin + taken.size());
    return bytes;
  }

  std::string read_text(std::uint64_t size) {
    const std::string_view text = take_cbor(rest_, size);
    if (!is_utf8(text)) refuse_cbor("a text that is not UTF-8");
    return std::string(text);
  }

  json read_value(int depth) {
    const CborHead head = read_cbor_head(rest_);
    switch (head.major) {
      case CborMajor::kUnsigned:
        return head.argument;
      case CborMajor::kNegative:
        if (head.argument > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) {
          throw ProtocolError("protocol/number", "a whole number is less than -2^63");
        }
        return -1 - static_cast<std::int64_t>(head.argument);
      case CborMajor::kBytes:
        return json::binary(read_bytes(head.argument));
      case CborMajor::kText:
        return read_text(head.argument);
      case CborMajor::kList:
        return read_list(head.argument, depth + 1);
      case CborMajor::kObject:
        return read_object(head.argument, depth + 1);
      case CborMajor::kTag:
        return read_doubles(head.argument);
      case CborMajor::kSimple:
        break;
    }
    return read_simple(head);
  }

  // The count may be false. Each element takes at least one byte, so the end of the message bounds
  // the loop.
  json read_list(std::uint64_t count, int depth) {
    require_cbor_depth(depth);
    json::array_t list;
    for (; count > 0; --count) list.push_back(read_value(depth));
    return list;
  }

  json read_object(std::uint64_t count, int depth) {
    require_cbor_depth(depth);
    json::object_t object;
    for (; count > 0; --count) {
      const CborHead head = read_cbor_head(rest_);
      if (head.major != CborMajor::kText) refuse_cbor("a key that is no text");
      const auto [at, is_new] = object.emplace(read_text(head.argument), nullptr);
      if (!is_new) {
        throw ProtocolError("protocol/duplicate-key",
                            "duplicate key in an object: " + at->first.substr(0, 200));
      }
      if (depth == 1 && !encoded_.empty() && at->first == encoded_) {
        const std::string_view item = take_cbor_item(rest_, depth);
        at->second = json::binary({item.begin(), item.end()}, kEncodedItemTag);
      } else {
        at->second = read_value(depth);
      }
    }
    return object;
  }

  json read_doubles(std::uint64_t tag) {
    if (tag != kDoublesTag) refuse_cbor(("the tag " + std::to_string(tag)).c_str());
    const CborHead head = read_cbor_head(rest_);
    if (head.major != CborMajor::kBytes || head.argument % sizeof(double) != 0) {
      refuse_cbor("a typed array that is no byte string of whole doubles");
    }
    std::vector<std::uint8_t> bytes = read_bytes(head.argument);
    if (!all_finite_doubles({reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
      refuse_number();
    }
    return json::binary(std::move(bytes), kDoublesTag);
  }

  [[noreturn]] static void refuse_number() {
    throw ProtocolError("protocol/number", "a number is not finite");
  }

  static json read_simple(const CborHead& head) {
    double value = 0.0;
    switch (head.info) {
      case CborSimple::kFalse:
        return false;
      case CborSimple::kTrue:
        return true;
      case CborSimple::kNull:
        return nullptr;
      case CborSimple::kHalf:
        value = half(head.argument);
        break;
      case CborSimple::kFloat:
        value = std::bit_cast<float>(static_cast<std::uint32_t>(head.argument));
        break;
      case CborSimple::kDouble:
        value = std::bit_cast<double>(head.argument);
        break;
      default:
        refuse_cbor("a simple value that is not true, false or null");
    }
    if (!std::isfinite(value)) refuse_number();
    return value;
  }

  std::string_view rest_;
  Spare<std::uint8_t>* spare_;  // may be null
  std::string_view encoded_;    // see decode()
};

}  // namespace

void append_cbor(const json& value, std::string& out) {
  CborWriter writer(out);
  append_value(value, writer);
}

json parse_cbor(std::string_view bytes, Spare<std::uint8_t>* spare, std::string_view encoded) {
  return CborReader(bytes, spare, encoded).read();
}

}  // namespace playerlike::protocol
