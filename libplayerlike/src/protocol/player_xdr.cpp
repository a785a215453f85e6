// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "protocol/player_xdr.h"

namespace playerlike::player {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw protocol::ProtocolError("player/payload", text);
}

}  // namespace

namespace xdr {

std::size_t Reader::array_size(const char* name, std::size_t limit) {
  const auto size = number<std::uint32_t>(name);
  if (size != announced_) {
    refuse(std::string(name) + "_count is " + std::to_string(announced_) + ", but the array has " +
           std::to_string(size) + " elements");
  }
  if (size > limit) {
    refuse(std::string(name) + ": expected at most " + std::to_string(limit) + " elements, found " +
           std::to_string(size));
  }
  return size;
}

std::string_view Reader::take(const char* name, std::size_t size) {
  if (size > rest_.size()) {
    refuse(std::string("the payload ends in ") + name + ": expected " + std::to_string(size) +
           " more bytes, found " + std::to_string(rest_.size()));
  }
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

void Reader::finish() const {
  if (rest_.empty()) return;
  refuse("expected the end of the payload, found " + std::to_string(rest_.size()) + " more bytes");
}

}  // namespace xdr

std::string banner() {
  std::string bytes = PLAYER_IDENT_STRING "3.1.0";
  bytes.resize(kBannerBytes);
  return bytes;
}

void append_message(std::string& bytes, Msghdr header, std::string_view payload) {
  header.size = static_cast<std::uint32_t>(payload.size());
  append(bytes, header);
  bytes += payload;
}

Message parse_message(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes) {
    throw protocol::ProtocolError(
        "player/header", "expected a header of " + std::to_string(kHeaderBytes) + " bytes, found " +
                             std::to_string(bytes.size()) + " bytes");
  }
  const auto header = decode<Msghdr>(bytes.substr(0, kHeaderBytes));
  bytes.remove_prefix(kHeaderBytes);
  if (bytes.size() != header.size) {
    throw protocol::ProtocolError(
        "player/header", "the header announces " + std::to_string(header.size) + " bytes, found " +
                             std::to_string(bytes.size()) + " bytes");
  }
  return {header, bytes};
}

}  // namespace playerlike::player
