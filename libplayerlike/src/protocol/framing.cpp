// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/framing.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "protocol/formats.h"
#include "sim/core/assert.h"

namespace playerlike::protocol {
namespace {

using nlohmann::json;

/// Number of bytes that hold a frame's length.
constexpr std::size_t kLengthBytes = 4;

std::size_t read_big_endian(const char* from) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    number = number << 8U | static_cast<unsigned char>(from[i]);
  }
  return number;
}

[[noreturn]] void refuse_length(std::size_t limit) {
  throw ProtocolError("protocol/too-long",
                      "a message is longer than " + std::to_string(limit) + " bytes");
}

}  // namespace

void write_big_endian(std::size_t number, char* to) {
  SIM_ASSERT(number <= 0xffffffffU);
  for (std::size_t i = kLengthBytes; i-- > 0; number >>= 8U) {
    to[i] = static_cast<char>(number & 0xffU);
  }
}

std::string_view to_string(Encoding encoding) noexcept {
  return encoding == Encoding::kJson ? "json" : "cbor";
}

std::optional<Encoding> parse_encoding(std::string_view text) noexcept {
  for (const Encoding encoding : {Encoding::kJson, Encoding::kCbor}) {
    if (text == to_string(encoding)) return encoding;
  }
  return std::nullopt;
}

std::span<char> MessageSplitter::room(std::size_t size) {
  if (buffer_.size() - end_ < size && begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    scanned_ -= std::min(scanned_, begin_);
    begin_ = 0;
  }
  if (buffer_.size() - end_ < size) buffer_.resize(end_ + size);
  return {buffer_.data() + end_, size};
}

void MessageSplitter::added(std::size_t size) {
  SIM_ASSERT(size <= buffer_.size() - end_);
  end_ += size;
}

void MessageSplitter::add(std::string_view bytes) {
  if (bytes.empty()) return;
  std::memcpy(room(bytes.size()).data(), bytes.data(), bytes.size());
  added(bytes.size());
}

std::optional<std::string_view> MessageSplitter::next() {
  switch (framing_) {
    case Framing::kLines:
      return next_line();
    case Framing::kFrames:
      return next_frame(kLengthBytes, false);
    case Framing::kPlayer:
      break;
  }
  return next_frame(kPlayerHeader, true);
}

std::optional<std::string_view> MessageSplitter::next_line() {
  const auto without_return = [&](std::size_t end) {
    return end > begin_ && buffer_[end - 1] == '\r' ? end - 1 : end;
  };
  scanned_ = std::max(scanned_, begin_);
  const void* found =
      scanned_ == end_ ? nullptr : std::memchr(buffer_.data() + scanned_, '\n', end_ - scanned_);
  const std::size_t end =
      found == nullptr ? end_
                       : static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data());
  const std::size_t length = without_return(end) - begin_;
  if (length > limit_) refuse_length(limit_);
  scanned_ = end;
  if (found == nullptr) return std::nullopt;
  const std::string_view line(buffer_.data() + begin_, length);
  begin_ = end + 1;
  return line;
}

std::optional<std::string_view> MessageSplitter::next_frame(std::size_t head, bool kept) {
  if (end_ - begin_ < head) return std::nullopt;
  const std::size_t length = read_big_endian(buffer_.data() + begin_ + head - kLengthBytes);
  if (length > limit_) refuse_length(limit_);
  if (end_ - begin_ - head < length) return std::nullopt;
  const std::string_view whole(buffer_.data() + begin_, head + length);
  begin_ += head + length;
  return kept ? whole : whole.substr(head);
}

bool MessageSplitter::partial() const noexcept { return begin_ != end_; }

void append_encoded(const json& message, Encoding encoding, std::string& out) {
  if (encoding == Encoding::kJson) {
    append_json(message, out);
    out += '\n';
    return;
  }
  append_frame(out, [&] { append_cbor(message, out); });
}

std::string encode(const json& message, Encoding encoding) {
  std::string bytes;
  append_encoded(message, encoding, bytes);
  return bytes;
}

void keep_bytes(json& message, Spare<std::uint8_t>& spare) {
  for (json& member : message) {
    if (member.is_binary()) spare.keep(std::move(member.get_binary()));
  }
}

json decode(std::string_view bytes, Encoding encoding, Spare<std::uint8_t>* spare,
            std::string_view encoded) {
  json message =
      encoding == Encoding::kJson ? parse_json(bytes, true) : parse_cbor(bytes, spare, encoded);
  if (!message.is_object()) {
    throw ProtocolError("protocol/not-an-object",
                        std::string("a message is an object, found ") + message.type_name());
  }
  return message;
}

json decode_json_value(std::string_view text) { return parse_json(text, false); }

}  // namespace playerlike::protocol
