// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/cbor_items.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "protocol/framing.h"

namespace playerlike::protocol {
namespace {

// From this value of CborHead::info on, bytes with the argument follow.
constexpr std::uint8_t kFirstLong = 24;

std::uint8_t first_byte(CborMajor major, std::uint8_t info) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(major) << 5U | info);
}

/// Appends the least significant bytes of a number, most significant first.
void append_big_endian(std::string& out, std::uint64_t number, unsigned bytes) {
  char made[sizeof number];
  for (unsigned i = 0; i < bytes; ++i) {
    made[i] = static_cast<char>(number >> 8U * (bytes - 1 - i) & 0xffU);
  }
  out.append(made, bytes);
}

}  // namespace

void refuse_cbor(const char* what) {
  throw ProtocolError(
      "protocol/syntax",
      "invalid CBOR message ('playpen doc protocol' has the format): " + std::string(what));
}

void require_cbor_depth(int depth) {
  if (depth <= kMaxDepth) return;
  throw ProtocolError("protocol/too-deep", "lists and objects are nested more than " +
                                               std::to_string(kMaxDepth) + " deep");
}

std::string_view take_cbor_item(std::string_view& rest, int depth) {
  const std::string_view all = rest;
  const CborHead head = read_cbor_head(rest);
  switch (head.major) {
    case CborMajor::kUnsigned:
    case CborMajor::kNegative:
    case CborMajor::kSimple:
      break;
    case CborMajor::kBytes:
    case CborMajor::kText:
      static_cast<void>(take_cbor(rest, head.argument));
      break;
    case CborMajor::kList:
    case CborMajor::kObject:
      require_cbor_depth(depth + 1);
      // The count may be false. Each item takes at least one byte, so the end of the message bounds
      // the loop.
      for (std::uint64_t i = 0; i < head.argument; ++i) {
        if (head.major == CborMajor::kObject) static_cast<void>(take_cbor_item(rest, depth + 1));
        static_cast<void>(take_cbor_item(rest, depth + 1));
      }
      break;
    case CborMajor::kTag:  // before byte strings only, so that this needs no depth
      if (const CborHead tagged = read_cbor_head(rest); tagged.major == CborMajor::kBytes) {
        static_cast<void>(take_cbor(rest, tagged.argument));
        break;
      }
      refuse_cbor("a tag before an item that is no byte string");
  }
  return all.substr(0, all.size() - rest.size());
}

bool all_finite_doubles(std::string_view bytes) noexcept {
  // An exponent of all ones means infinity or NaN. Without a branch, so that many are checked at
  // once.
  constexpr std::uint64_t kExponent = 0x7ff0000000000000U;
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i + sizeof(double) <= bytes.size(); i += sizeof(double)) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data() + i, sizeof bits);
    wrong |= (bits & kExponent) == kExponent ? 1U : 0U;
  }
  return wrong == 0;
}

void CborWriter::head(CborMajor major, std::uint64_t argument) {
  if (argument < kFirstLong) {
    out_ += static_cast<char>(first_byte(major, static_cast<std::uint8_t>(argument)));
    return;
  }
  const unsigned size = argument <= 0xffU         ? 0U
                        : argument <= 0xffffU     ? 1U
                        : argument <= 0xffffffffU ? 2U
                                                  : 3U;
  out_ += static_cast<char>(first_byte(major, static_cast<std::uint8_t>(kFirstLong + size)));
  append_big_endian(out_, argument, 1U << size);
}

void CborWriter::integer(std::int64_t value) {
  if (value >= 0) return head(CborMajor::kUnsigned, static_cast<std::uint64_t>(value));
  head(CborMajor::kNegative, static_cast<std::uint64_t>(-1 - value));
}

void CborWriter::number(double value) {
  constexpr double kGreatest = std::numeric_limits<float>::max();
  const float narrow = std::abs(value) <= kGreatest ? static_cast<float>(value) : 0.0F;
  if (static_cast<double>(narrow) == value) {
    out_ += static_cast<char>(first_byte(CborMajor::kSimple, CborSimple::kFloat));
    return append_big_endian(out_, std::bit_cast<std::uint32_t>(narrow), sizeof narrow);
  }
  out_ += static_cast<char>(first_byte(CborMajor::kSimple, CborSimple::kDouble));
  append_big_endian(out_, std::bit_cast<std::uint64_t>(value), sizeof value);
}

void CborWriter::boolean(bool value) {
  head(CborMajor::kSimple, value ? CborSimple::kTrue : CborSimple::kFalse);
}

void CborWriter::null() { head(CborMajor::kSimple, CborSimple::kNull); }

void CborWriter::text(std::string_view value) {
  head(CborMajor::kText, value.size());
  out_.append(value);
}

void CborWriter::bytes(std::span<const std::uint8_t> value) {
  head(CborMajor::kBytes, value.size());
  out_.append(reinterpret_cast<const char*>(value.data()), value.size());
}

void CborWriter::doubles(std::span<const double> values) {
  static_assert(std::endian::native == std::endian::little, "bytes must be swapped");
  head(CborMajor::kTag, kDoublesTag);
  head(CborMajor::kBytes, values.size_bytes());
  out_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

}  // namespace playerlike::protocol
