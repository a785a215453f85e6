// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Player's messages: the first byte selects the size of the pieces in which the stream arrives.
#include "messages.h"
#include "protocol/player_xdr.h"

namespace {

using namespace playerlike;  // NOLINT(google-build-using-namespace): a small program

// What can be decoded can be encoded, and decoded to the same again.
void take_message(std::string_view bytes) {
  protocol::fuzz::attempt([&] {
    const player::Message message = player::parse_message(bytes);
    player::visit_payload(
        message.header.addr.interf, message.header.type, message.header.subtype,
        [&]<typename Payload>() {
          const std::string once = player::encode(player::decode<Payload>(message.payload));
          protocol::fuzz::require_true(once.size() == message.payload.size());
          protocol::fuzz::require_true(player::encode(player::decode<Payload>(once)) == once);
        });
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);
  protocol::fuzz::split(stream, data[0] % 64U, protocol::Framing::kPlayer, take_message);
  return 0;
}
