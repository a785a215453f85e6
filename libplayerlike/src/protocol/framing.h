// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "messages/spare.h"

/// Playpen's protocol (docs/protocol.md) as bytes; the server and socket sessions share it.
namespace playerlike::protocol {

/// The version that `hello` negotiates.
inline constexpr int kVersion = 1;
/// The server's default TCP port, equal to MORSE's.
inline constexpr int kDefaultTcpPort = 4000;
/// Maximum length of the path of a Unix socket, on Linux [bytes].
inline constexpr std::size_t kMaxUnixPath = 107;
/// Maximum nesting depth of lists and objects in a message.
inline constexpr int kMaxDepth = 32;
/// CBOR tag of a typed array of little-endian doubles (RFC 8746). As a json value, such an array is
/// a binary value with this subtype.
inline constexpr std::uint8_t kDoublesTag = 86;

/// CBOR tag of an encoded item (RFC 8949, section 3.4.5.1). As a json value, a binary value with
/// this subtype is a part of a message that is encoded already, or not decoded yet; it is never on
/// the wire.
inline constexpr std::uint8_t kEncodedItemTag = 24;

/// Encodings of messages on the wire.
enum class Encoding {
  kJson,  ///< one JSON object per line, ended by \n (a preceding \r is ignored)
  kCbor,  ///< four bytes with the length of the rest (big-endian), then one CBOR object
};
[[nodiscard]] std::string_view to_string(Encoding encoding) noexcept;
[[nodiscard]] std::optional<Encoding> parse_encoding(std::string_view text) noexcept;

/// How messages follow one another in a stream of bytes.
enum class Framing {
  kLines,   ///< a line each, ended by \n (a preceding \r is ignored)
  kFrames,  ///< four bytes with the length of the rest (big-endian), then the message
  kPlayer,  ///< Player's: a header of kPlayerHeader bytes, whose last four are the length of the
            ///< rest (big-endian). The header is part of the message.
};
[[nodiscard]] constexpr Framing framing_of(Encoding encoding) noexcept {
  return encoding == Encoding::kJson ? Framing::kLines : Framing::kFrames;
}

/// Length of the header of Player's messages [bytes].
inline constexpr std::size_t kPlayerHeader = 40;

/// Writes four bytes, most significant first. @pre number < 2^32.
void write_big_endian(std::size_t number, char* to);

/// A message that cannot be understood.
class ProtocolError : public std::runtime_error {
 public:
  /// @param id  stable, listed in docs/protocol.md, e.g. "protocol/too-long".
  ProtocolError(std::string id, const std::string& message)
      : std::runtime_error(message), id_(std::move(id)) {}
  [[nodiscard]] const std::string& id() const noexcept { return id_; }

 private:
  std::string id_;
};

/// Splits a byte stream into messages; the chunks may be cut anywhere.
class MessageSplitter {
 public:
  /// @param limit  maximum bytes of a message, without its length, line end or header.
  MessageSplitter(Framing framing, std::size_t limit) : framing_(framing), limit_(limit) {}
  MessageSplitter(Encoding encoding, std::size_t limit)
      : MessageSplitter(framing_of(encoding), limit) {}

  /// A buffer of `size` bytes for the next input, valid until the next call.
  [[nodiscard]] std::span<char> room(std::size_t size);
  /// Takes the first `size` bytes that were written to room().
  void added(std::size_t size);
  /// Adds bytes from another buffer.
  void add(std::string_view bytes);

  /// The next complete message (without length or line end), valid until the next call of any other
  /// member; nullopt if there is none yet. @throws ProtocolError protocol/too-long as soon as the
  /// length is known; nothing more can be read then.
  [[nodiscard]] std::optional<std::string_view> next();

  /// Whether an incomplete message is buffered.
  [[nodiscard]] bool partial() const noexcept;
  /// Sets the framing of the following messages. Bytes already added are kept.
  void set_framing(Framing framing) noexcept { framing_ = framing; }
  void set_encoding(Encoding encoding) noexcept { set_framing(framing_of(encoding)); }
  void set_limit(std::size_t limit) noexcept { limit_ = limit; }

 private:
  [[nodiscard]] std::optional<std::string_view> next_line();
  /// @param head  bytes of a frame's head, whose last four are the length of the rest.
  /// @param kept  whether the head is part of the message.
  [[nodiscard]] std::optional<std::string_view> next_frame(std::size_t head, bool kept);

  Framing framing_;
  std::size_t limit_;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< start of the bytes that next() has not returned yet
  std::size_t end_ = 0;      ///< end of the bytes added
  std::size_t scanned_ = 0;  ///< there is no line end before this position
};

/// Encodes a message, with its length or line end. Invalid UTF-8 in texts is replaced by U+FFFD.
/// decode() restores numbers exactly. @pre numbers are finite: JSON cannot represent others (null
/// is written), and decode() refuses them.
[[nodiscard]] std::string encode(const nlohmann::json& message, Encoding encoding);
/// Appends a frame: calls write(), which appends the message in CBOR, and puts its length before
/// it.
template <typename Write>
void append_frame(std::string& out, Write write) {
  constexpr std::size_t kLengthBytes = 4;
  const std::size_t begin = out.size();
  out.resize(begin + kLengthBytes);
  write();
  write_big_endian(out.size() - begin - kLengthBytes, out.data() + begin);
}
/// Appends what encode() returns.
void append_encoded(const nlohmann::json& message, Encoding encoding, std::string& out);

/// Decodes the bytes of one message (from MessageSplitter), which must be an object.
///
/// CBOR accepts integers, finite floats, texts, byte strings, lists, objects with texts as keys,
/// true, false, null, and byte strings with kDoublesTag whose doubles are finite. Lengths must be
/// definite; other tags and values are refused. No memory is allocated for claimed lengths that
/// exceed the message. In JSON a list of at least kLongList elements, all numbers, becomes a typed
/// array of doubles, see kDoublesTag; require_doubles() accepts both forms.
/// @throws ProtocolError protocol/syntax, protocol/too-deep (more than kMaxDepth levels),
/// protocol/duplicate-key, protocol/not-an-object, protocol/number (not finite, or too large).
/// @param spare    gives its memory to a large byte string in CBOR; see keep_bytes(). May be null.
/// @param encoded  in CBOR, the member of this name is not decoded, see kEncodedItemTag. Only its
///                 structure is checked.
[[nodiscard]] nlohmann::json decode(std::string_view bytes, Encoding encoding,
                                    Spare<std::uint8_t>* spare = nullptr,
                                    std::string_view encoded = {});
/// Gives the memory of a message's byte strings to `spare`. Their content is undefined afterwards.
void keep_bytes(nlohmann::json& message, Spare<std::uint8_t>& spare);
/// Minimum length of a list that decode() converts to a typed array.
inline constexpr std::size_t kLongList = 16;

/// Like decode(), but accepts any JSON value (MORSE's argument lists) and keeps long lists as
/// lists.
[[nodiscard]] nlohmann::json decode_json_value(std::string_view text);

}  // namespace playerlike::protocol
