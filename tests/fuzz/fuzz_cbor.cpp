// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// CBOR: the first byte selects a single message or a stream of frames, and the size of its pieces.
#include "messages.h"

namespace {

using namespace playerlike::protocol;  // NOLINT(google-build-using-namespace): a small program

void take_frame(std::string_view frame) {
  fuzz::attempt([&] { fuzz::take_message(decode(frame, Encoding::kCbor), Encoding::kCbor); });
  fuzz::take_cbor_reading_bytes(frame);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr unsigned kFrames = 0x80;
  if (data[0] < kFrames) {
    take_frame(stream);
  } else {
    fuzz::split(stream, data[0] % 16U, Framing::kFrames, take_frame);
  }
  return 0;
}
