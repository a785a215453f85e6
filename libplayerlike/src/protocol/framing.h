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

/// Playpen's protocol (docs/protocol.md) as bytes: shared by the server and by socket sessions.
namespace playerlike::protocol {

/// The version that `hello` negotiates.
inline constexpr int kVersion = 1;
/// The server's TCP port unless told otherwise; MORSE's.
inline constexpr int kDefaultTcpPort = 4000;
/// Levels of lists and objects that a message may have.
inline constexpr int kMaxDepth = 32;
/// Tag of a typed array of little-endian doubles in CBOR (RFC 8746). In a message that is a json
/// value, such an array is a binary value of this subtype.
inline constexpr std::uint8_t kDoublesTag = 86;

/// How messages look on the wire.
enum class Encoding {
  kJson,  ///< one JSON object a line, ended by \n (an \r before it is ignored)
  kCbor,  ///< four bytes length (big-endian, of what follows), then one CBOR object
};
[[nodiscard]] std::string_view to_string(Encoding encoding) noexcept;
[[nodiscard]] std::optional<Encoding> parse_encoding(std::string_view text) noexcept;

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

/// Cuts a stream of bytes into messages, whatever the pieces in which it comes.
class MessageSplitter {
 public:
  /// @param limit  of one message's bytes, without its length or line end.
  MessageSplitter(Encoding encoding, std::size_t limit) : encoding_(encoding), limit_(limit) {}

  /// Where the next bytes are to be written: `size` bytes of room, valid until the next call.
  [[nodiscard]] std::span<char> room(std::size_t size);
  /// So many of them have been.
  void added(std::size_t size);
  /// For those who have the bytes elsewhere.
  void add(std::string_view bytes);

  /// The next whole message (without length or line end), valid until the next call of any other
  /// member; nullopt if there is none yet.
  /// @throws ProtocolError protocol/too-long, as soon as it is known; nothing more can be read.
  [[nodiscard]] std::optional<std::string_view> next();

  /// Whether part of a message waits for its rest.
  [[nodiscard]] bool partial() const noexcept;
  /// What follows is encoded so. Bytes that were added already are kept.
  void set_encoding(Encoding encoding) noexcept { encoding_ = encoding; }
  void set_limit(std::size_t limit) noexcept { limit_ = limit; }

 private:
  [[nodiscard]] std::optional<std::string_view> next_line();
  [[nodiscard]] std::optional<std::string_view> next_frame();

  Encoding encoding_;
  std::size_t limit_;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< of what next() has not given yet
  std::size_t end_ = 0;      ///< of what was added
  std::size_t scanned_ = 0;  ///< no line end before here
};

/// A message as bytes, with its length or line end. Texts that are no UTF-8 come out with U+FFFD in
/// place of what is wrong. Numbers are written so that decode() gives them back to the bit.
/// @pre numbers are finite: JSON has no others (null is written), and decode() refuses them.
[[nodiscard]] std::string encode(const nlohmann::json& message, Encoding encoding);

/// The message that bytes (from MessageSplitter) hold: an object.
///
/// CBOR: integers, finite floats, texts, byte strings, lists, objects with texts as keys, true,
/// false, null, and byte strings with kDoublesTag whose doubles are finite; lengths must be
/// definite, other tags and values are refused. Nothing is set aside for a length that is claimed
/// but not there.
/// JSON: a list of kLongList or more numbers and nothing else comes out as a typed array of
/// doubles, see kDoublesTag; require_doubles() takes both.
/// @throws ProtocolError protocol/syntax, protocol/too-deep (more than kMaxDepth levels),
///         protocol/duplicate-key, protocol/not-an-object, protocol/number (not finite, or too
///         large).
[[nodiscard]] nlohmann::json decode(std::string_view bytes, Encoding encoding);
/// See decode().
inline constexpr std::size_t kLongList = 16;

/// As decode(), for any JSON value of a line (MORSE's lists of arguments); long lists stay lists.
[[nodiscard]] nlohmann::json decode_json_value(std::string_view text);

}  // namespace playerlike::protocol
