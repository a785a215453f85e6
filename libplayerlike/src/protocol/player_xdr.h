// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "protocol/framing.h"
#include "protocol/player_structs.h"

/// Encoding of Player's messages: XDR (RFC 4506) as Player 3.1 uses it. All numbers are big-endian.
/// Integers of up to 32 bits, also characters, take 4 bytes. An array is preceded by the number of
/// its elements twice: once as a field of the message, and once by XDR. Bytes in arrays take one
/// byte each, with zeros up to a multiple of 4.
namespace playerlike::player {

inline constexpr std::size_t kBannerBytes = PLAYER_IDENT_STRLEN;
inline constexpr std::size_t kHeaderBytes = protocol::kPlayerHeader;
/// Maximum length of a payload, as in Player.
inline constexpr std::size_t kMaxPayload = PLAYER_MAX_MESSAGE_SIZE - kHeaderBytes;

/// What a server sends first: its name and version, filled up with zeros.
[[nodiscard]] std::string banner();

namespace xdr {

template <typename T>
concept ByteSized = std::integral<T> && sizeof(T) == 1;

/// Encodes fields; a visitor for visit_fields().
class Writer {
 public:
  /// @param out  to which the bytes are appended.
  explicit Writer(std::string& out) : out_(out) {}

  template <typename T>
  void value(const char* name, const T& field) {
    if constexpr (std::is_arithmetic_v<T>) {
      write_number(field, grow(kNumberBytes<T>));
    } else if constexpr (requires { std::tuple_size<T>::value; }) {
      fixed(name, field);
    } else {
      T::visit_fields(field, *this);
    }
  }
  template <typename Array>
  void count(const char* name, const Array& array) {
    value(name, static_cast<std::uint32_t>(array.size()));
  }
  template <typename Array>
  void elements(const char* name, const Array& array, std::size_t /*limit*/) {
    count(name, array);
    using T = typename Array::value_type;
    if constexpr (ByteSized<T>) {
      bytes(array.data(), array.size());
    } else if constexpr (std::is_arithmetic_v<T>) {
      char* to = grow(array.size() * kNumberBytes<T>);
      for (const T number : array) to = write_number(number, to);
    } else {
      for (const T& element : array) value(name, element);
    }
  }

  /// Bytes of a number in a message.
  template <typename T>
  static constexpr std::size_t kNumberBytes = sizeof(T) == 8 ? 8 : 4;

 private:
  template <typename T, std::size_t kCount>
  void fixed(const char* name, const std::array<T, kCount>& array) {
    if constexpr (ByteSized<T>) {
      bytes(array.data(), kCount);
    } else {
      for (const T& element : array) value(name, element);
    }
  }

  void bytes(const void* from, std::size_t size) {
    const std::size_t padded = (size + 3) / 4 * 4;
    char* to = grow(padded);
    if (size > 0) std::memcpy(to, from, size);
    std::memset(to + size, 0, padded - size);
  }

  template <typename T>
  static char* write_number(T number, char* to) {
    if constexpr (sizeof(T) == 8) {
      return write_bits(std::bit_cast<std::uint64_t>(number), to);
    } else if constexpr (std::is_floating_point_v<T>) {
      return write_bits(std::bit_cast<std::uint32_t>(number), to);
    } else {
      return write_bits(static_cast<std::uint32_t>(number), to);
    }
  }

  template <typename Bits>
  static char* write_bits(Bits bits, char* to) {
    for (std::size_t i = sizeof(Bits); i-- > 0;) {
      *to++ = static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
    }
    return to;
  }

  /// Appends bytes. @return their beginning.
  char* grow(std::size_t size) {
    const std::size_t begin = out_.size();
    out_.resize(begin + size);
    return out_.data() + begin;
  }

  std::string& out_;
};

/// Decodes fields; a visitor for visit_fields(). Throws ProtocolError player/payload.
class Reader {
 public:
  explicit Reader(std::string_view payload) : rest_(payload) {}

  template <typename T>
  void value(const char* name, T& field) {
    if constexpr (std::is_arithmetic_v<T>) {
      field = number<T>(name);
    } else if constexpr (requires { std::tuple_size<T>::value; }) {
      fixed(name, field);
    } else {
      T::visit_fields(field, *this);
    }
  }
  template <typename Array>
  void count(const char* name, const Array& /*array*/) {
    announced_ = number<std::uint32_t>(name);
  }
  template <typename Array>
  void elements(const char* name, Array& array, std::size_t limit) {
    const std::size_t size = array_size(name, limit);
    using T = typename Array::value_type;
    if constexpr (ByteSized<T>) {
      const std::string_view from = take(name, (size + 3) / 4 * 4).substr(0, size);
      array.assign(from.begin(), from.end());
    } else if constexpr (std::is_arithmetic_v<T>) {
      std::string_view from = take(name, size * Writer::kNumberBytes<T>);
      array.resize(size);
      for (T& element : array) {
        element = read_number<T>(from);
        from.remove_prefix(Writer::kNumberBytes<T>);
      }
    } else {
      // Grows with the elements that are really there: the number itself is not to be trusted.
      array.clear();
      for (std::size_t i = 0; i < size; ++i) value(name, array.emplace_back());
    }
  }
  /// Refuses bytes after the last field.
  void finish() const;

 private:
  template <typename T, std::size_t kCount>
  void fixed(const char* name, std::array<T, kCount>& array) {
    if constexpr (ByteSized<T>) {
      std::memcpy(array.data(), take(name, (kCount + 3) / 4 * 4).data(), kCount);
    } else {
      for (T& element : array) value(name, element);
    }
  }
  template <typename T>
  [[nodiscard]] T number(const char* name) {
    return read_number<T>(take(name, Writer::kNumberBytes<T>));
  }
  template <typename T>
  [[nodiscard]] static T read_number(std::string_view from) {
    if constexpr (sizeof(T) == 8) {
      return std::bit_cast<T>(read_bits<std::uint64_t>(from));
    } else if constexpr (std::is_floating_point_v<T>) {
      return std::bit_cast<T>(read_bits<std::uint32_t>(from));
    } else {
      return static_cast<T>(read_bits<std::uint32_t>(from));
    }
  }
  template <typename Bits>
  [[nodiscard]] static Bits read_bits(std::string_view from) {
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      bits = static_cast<Bits>(bits << 8U | static_cast<unsigned char>(from[i]));
    }
    return bits;
  }
  /// XDR's number of elements, equal to the one that has been announced.
  [[nodiscard]] std::size_t array_size(const char* name, std::size_t limit);
  [[nodiscard]] std::string_view take(const char* name, std::size_t size);

  std::string_view rest_;
  std::uint32_t announced_ = 0;  ///< number of elements of the next array
};

}  // namespace xdr

/// Appends a payload's bytes. @pre strings and vectors are not longer than their limits.
template <typename Payload>
void append(std::string& bytes, const Payload& payload) {
  xdr::Writer writer(bytes);
  Payload::visit_fields(payload, writer);
}

template <typename Payload>
[[nodiscard]] std::string encode(const Payload& payload) {
  std::string bytes;
  append(bytes, payload);
  return bytes;
}

/// Decodes a payload into an existing struct, whose memory is used again.
/// @throws protocol::ProtocolError player/payload if the bytes are too few or too many, if the two
/// numbers of an array's elements differ, or if an array is longer than its limit. The struct is
/// valid then, but its values are unspecified.
template <typename Payload>
void decode_into(Payload& payload, std::string_view bytes) {
  xdr::Reader reader(bytes);
  Payload::visit_fields(payload, reader);
  reader.finish();
}

/// As decode_into(), for a new struct.
template <typename Payload>
[[nodiscard]] Payload decode(std::string_view bytes) {
  Payload payload;
  decode_into(payload, bytes);
  return payload;
}

/// A message: its header, and its payload's bytes.
struct Message {
  Msghdr header;
  std::string_view payload;
};

/// Appends a message. @param header  its size is set to that of the payload.
void append_message(std::string& bytes, Msghdr header, std::string_view payload);

/// Encodes a message in place: appends the header, and the payload after it.
template <typename Payload>
void append_message(std::string& bytes, Msghdr header, const Payload& payload) {
  const std::size_t begin = bytes.size();
  append(bytes, header);
  const std::size_t payload_begin = bytes.size();
  append(bytes, payload);
  protocol::write_big_endian(bytes.size() - payload_begin, bytes.data() + begin + kHeaderBytes - 4);
}

/// Takes a whole message apart, as protocol::MessageSplitter returns it for Framing::kPlayer. The
/// payload refers to `bytes`.
/// @throws protocol::ProtocolError player/header if the bytes are not a header and as many bytes as
/// it announces.
[[nodiscard]] Message parse_message(std::string_view bytes);

/// Calls visitor.template operator()<Payload>() for the payload of a message's interface, type and
/// subtype. @return whether Player has such a message; others do not call it.
template <typename Visitor>
bool visit_payload(unsigned interface, unsigned type, unsigned subtype, Visitor&& visitor) {
  // Requests that every interface has have the interface code 0 in the table.
#define PLAYER_MESSAGE(code, row_type, row_subtype, Payload)                                    \
  if ((interface == (code) || (code) == 0) && type == (row_type) && subtype == (row_subtype)) { \
    visitor.template operator()<Payload>();                                                     \
    return true;                                                                                \
  }
#include "protocol/player_messages.inc"
#undef PLAYER_MESSAGE
  return false;
}

}  // namespace playerlike::player
