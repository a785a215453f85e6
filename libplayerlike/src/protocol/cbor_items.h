// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// The items of CBOR (RFC 8949), read from bytes and written to them, without a tree of values.
namespace playerlike::protocol {

/// The kind of an item.
enum class CborMajor : std::uint8_t {
  kUnsigned,
  kNegative,
  kBytes,
  kText,
  kList,
  kObject,
  kTag,
  kSimple,
};

/// What CborHead::info says of a simple value.
struct CborSimple {
  static constexpr std::uint8_t kFalse = 20;
  static constexpr std::uint8_t kTrue = 21;
  static constexpr std::uint8_t kNull = 22;
  static constexpr std::uint8_t kHalf = 25;  ///< a number in two bytes
  static constexpr std::uint8_t kFloat = 26;
  static constexpr std::uint8_t kDouble = 27;
};

/// The head of an item (RFC 8949, section 3).
struct CborHead {
  CborMajor major;
  std::uint8_t info;       ///< low five bits of the first byte
  std::uint64_t argument;  ///< a value, a length or a count
};

/// Throws ProtocolError protocol/syntax. @param what  is wrong.
[[noreturn]] void refuse_cbor(const char* what);

/// @name Reading; each removes what it reads from the front of `rest`
/// @throws ProtocolError protocol/syntax if the message ends too early.
/// @{
[[nodiscard]] inline std::string_view take_cbor(std::string_view& rest, std::uint64_t size) {
  if (size > rest.size()) refuse_cbor("the message ends too early");
  const std::string_view taken = rest.substr(0, static_cast<std::size_t>(size));
  rest.remove_prefix(taken.size());
  return taken;
}
/// @throws ProtocolError protocol/syntax also for indefinite lengths.
[[nodiscard]] inline CborHead read_cbor_head(std::string_view& rest) {
  constexpr std::uint8_t kOneByte = 24;  // from here on, bytes with the argument follow
  constexpr std::uint8_t kReserved = 28;
  constexpr std::uint8_t kIndefinite = 31;
  const auto first = static_cast<std::uint8_t>(take_cbor(rest, 1).front());
  CborHead head{static_cast<CborMajor>(first >> 5U), static_cast<std::uint8_t>(first & 0x1fU), 0};
  if (head.info < kOneByte) {
    head.argument = head.info;
  } else if (head.info < kReserved) {
    for (const char byte : take_cbor(rest, std::uint64_t{1} << (head.info - kOneByte))) {
      head.argument = head.argument << 8U | static_cast<std::uint8_t>(byte);
    }
  } else {
    refuse_cbor(head.info == kIndefinite ? "an indefinite length" : "a reserved kind of item");
  }
  return head;
}
/// Removes an item and returns its bytes. Checks its structure only, not its values.
/// @param depth  number of lists and objects around it.
/// @throws ProtocolError protocol/syntax; protocol/too-deep.
[[nodiscard]] std::string_view take_cbor_item(std::string_view& rest, int depth);
/// @}

/// @throws ProtocolError protocol/too-deep beyond kMaxDepth.
void require_cbor_depth(int depth);
/// Whether all doubles of a typed array (kDoublesTag) are finite. @pre whole doubles.
[[nodiscard]] bool all_finite_doubles(std::string_view bytes) noexcept;

/// Appends items to a text. Heads have their shortest form.
class CborWriter {
 public:
  explicit CborWriter(std::string& out) : out_(out) {}

  void head(CborMajor major, std::uint64_t argument);
  void object(std::size_t members) { head(CborMajor::kObject, members); }
  void list(std::size_t elements) { head(CborMajor::kList, elements); }
  void integer(std::int64_t value);
  void unsigned_integer(std::uint64_t value) { head(CborMajor::kUnsigned, value); }
  void number(double value);  ///< in four bytes if they suffice, else in eight
  void boolean(bool value);
  void null();
  void text(std::string_view value);  ///< @pre valid UTF-8
  void bytes(std::span<const std::uint8_t> value);
  void doubles(std::span<const double> values);  ///< a typed array, see kDoublesTag
  /// Appends the bytes of an item, or of a part of one.
  void raw(std::string_view item) { out_.append(item); }

 private:
  std::string& out_;
};

}  // namespace playerlike::protocol
