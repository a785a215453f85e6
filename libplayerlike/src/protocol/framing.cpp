// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/framing.h"

#include <algorithm>
#include <cstring>

#include "protocol/formats.h"
#include "sim/core/assert.h"

namespace playerlike::protocol {
namespace {

using nlohmann::json;

/// Number of bytes that hold a frame's length.
constexpr std::size_t kHead = 4;

std::size_t frame_length(const char* head) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < kHead; ++i) {
    length = length << 8U | static_cast<unsigned char>(head[i]);
  }
  return length;
}

void write_frame_length(std::size_t length, char* head) {
  SIM_ASSERT(length <= 0xffffffffU);
  for (std::size_t i = kHead; i-- > 0; length >>= 8U) head[i] = static_cast<char>(length & 0xffU);
}

[[noreturn]] void refuse_length(std::size_t limit) {
  throw ProtocolError("protocol/too-long",
                      "a message is longer than " + std::to_string(limit) + " bytes");
}

}  // namespace

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
  return encoding_ == Encoding::kJson ? next_line() : next_frame();
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

std::optional<std::string_view> MessageSplitter::next_frame() {
  if (end_ - begin_ < kHead) return std::nullopt;
  const std::size_t length = frame_length(buffer_.data() + begin_);
  if (length > limit_) refuse_length(limit_);
  if (end_ - begin_ - kHead < length) return std::nullopt;
  const std::string_view frame(buffer_.data() + begin_ + kHead, length);
  begin_ += kHead + length;
  return frame;
}

bool MessageSplitter::partial() const noexcept { return begin_ != end_; }

std::string encode(const json& message, Encoding encoding) {
  std::string bytes;
  if (encoding == Encoding::kJson) {
    append_json(message, bytes);
    bytes += '\n';
  } else {
    bytes.resize(kHead);
    append_cbor(message, bytes);
    write_frame_length(bytes.size() - kHead, bytes.data());
  }
  return bytes;
}

json decode(std::string_view bytes, Encoding encoding) {
  json message = encoding == Encoding::kJson ? parse_json(bytes, true) : parse_cbor(bytes);
  if (!message.is_object()) {
    throw ProtocolError("protocol/not-an-object",
                        std::string("a message is an object, found ") + message.type_name());
  }
  return message;
}

json decode_json_value(std::string_view text) { return parse_json(text, false); }

}  // namespace playerlike::protocol
