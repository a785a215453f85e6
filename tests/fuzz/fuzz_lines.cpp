// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Lines of JSON, in pieces: the first byte is the size of the pieces.
#include "messages.h"

namespace {

using namespace playerlike::protocol;  // NOLINT(google-build-using-namespace): a small program

void take_line(std::string_view line) {
  fuzz::attempt([&] { fuzz::take_message(decode(line, Encoding::kJson), Encoding::kJson); });
  fuzz::attempt([&] {
    // Any value, also after the words of a MORSE request; a value must survive writing and reading.
    const json value = decode_json_value(line);
    std::string text = encode(value, Encoding::kJson);
    text.pop_back();
    fuzz::require_true(decode_json_value(text) == value);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);
  fuzz::split(stream, data[0] % 16U, Framing::kLines, take_line);
  return 0;
}
