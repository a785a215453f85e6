// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/codec.h"
#include "protocol/request_codec.h"

/// What the protocol's fuzzers do with messages. Any exception but a ProtocolError ends them.
namespace playerlike::protocol::fuzz {

/// Reports a bug: libFuzzer keeps the input.
inline void require_true(bool condition) {
  if (!condition) std::abort();
}

/// Calls a function that may refuse its input.
template <typename Call>
void attempt(Call call) {
  try {
    call();
  } catch (const ProtocolError& e) {
    require_true(!e.id().empty());
  }
}

/// The message after encoding and decoding, in any encoding that can represent it.
inline json sent_on(const json& message, Encoding encoding) {
  MessageSplitter splitter(encoding, std::size_t{1} << 26U);
  splitter.add(encode(message, encoding));
  const auto bytes = splitter.next();
  require_true(bytes.has_value());
  return decode(*bytes, encoding);
}

/// Reads bytes as the only reading of a message, as a tree and without one: the results are the
/// same.
inline void take_cbor_reading_bytes(std::string_view bytes) {
  const std::string message =
      encode({{"readings", encoded_list(1, bytes)}}, Encoding::kCbor).substr(4);
  std::vector<DecodedReading> expected;
  std::string type;
  attempt([&] {
    const json tree = decode(message, Encoding::kCbor);
    const json& only = require_list(require(tree, "readings"), "readings").at(0);
    DecodedReading decoded = decode_reading(only, Encoding::kCbor);
    type = require_text(only, "type");
    expected.push_back(std::move(decoded));
  });
  std::vector<DecodedReading> read;
  attempt([&] {
    const json kept = decode(message, Encoding::kCbor, nullptr, "readings");
    const auto& list = kept.at("readings").get_binary();
    read = decode_cbor_readings({reinterpret_cast<const char*>(list.data()), list.size()});
  });
  require_true(read.size() == expected.size());
  if (read.empty()) return;
  const auto encoded = [&](const DecodedReading& decoded) {
    return encode_reading(decoded.device, type, *decoded.reading, Encoding::kCbor);
  };
  require_true(encoded(read[0]) == encoded(expected[0]));
  std::string written;
  append_cbor_reading(read[0].device, type, *read[0].reading, written);
  require_true(decode(written, Encoding::kCbor) == encoded(read[0]));
}

/// Reads a value as every type that it could represent.
inline void take_value(const json& value, Encoding encoding) {
  attempt([&] {
    const sim::Command command = decode_command(value);
    const json again = encode_command(command);
    require_true(encode_command(decode_command(again)) == again);
  });
  attempt([&] {
    const DecodedReading decoded = decode_reading(value, encoding);
    const json again =
        encode_reading(decoded.device, require_text(value, "type"), *decoded.reading, encoding);
    static_cast<void>(decode_reading(again, encoding));
  });
  attempt([&] {
    const auto drawings = decode_drawings(value, encoding);
    const json again = encode_drawings(drawings, encoding);
    require_true(encode_drawings(decode_drawings(again, encoding), encoding) == again);
  });
  attempt([&] {
    const auto cells = decode_cells(value, encoding);
    require_true(encode_cells(cells, encoding) == value);
  });
  attempt([&] {
    const sim::LayerStyle style = decode_style(value);
    require_true(decode_style(encode_style(style)) == style);
  });
  attempt([&] { static_cast<void>(encode_robots(decode_robots(value))); });
  attempt([&] { static_cast<void>(encode_canvas(decode_canvas(value))); });
  attempt([&] { static_cast<void>(encode_time(decode_time(value))); });
  attempt([&] { static_cast<void>(encode_layers(decode_layers(value))); });
  attempt([&] { static_cast<void>(encode_map(decode_map(value, encoding), encoding)); });
}

/// Processes a message like a server or a client.
inline void take_message(const json& message, Encoding encoding) {
  require_true(message.is_object());
  require_true(sent_on(message, Encoding::kCbor) == message);
  take_value(message, encoding);
  attempt([&] { refuse_unknown_keys(message, {"id", "do"}, "a request"); });
  attempt([&] {
    const auto type = find_request(require_text(message, "do"));
    if (!type) return;
    const json again = encode_request(decode_request(*type, message, encoding), encoding);
    require_true(encode_request(decode_request(*type, again, encoding), encoding) == again);
  });
  for (const auto& [key, value] : message.items()) {
    take_value(value, encoding);
    const char* name = key.c_str();
    attempt([&] { static_cast<void>(require_number(message, name)); });
    attempt([&] { static_cast<void>(require_integer(message, name, -5, 5)); });
    attempt([&] { static_cast<void>(require_bool(message, name)); });
    attempt([&] { static_cast<void>(require_text(message, name)); });
    attempt([&] { static_cast<void>(require_device_id(message, name)); });
    attempt([&] { static_cast<void>(require_doubles(message, name, encoding)); });
    attempt([&] {
      const auto data = require_bytes(message, name, encoding);
      require_true(bytes(data, encoding) == message.at(name));
    });
  }
}

/// Feeds a stream in pieces to a splitter and passes on the splitter's output.
/// @param piece  size of a piece [bytes]; 0: all at once.
template <typename Take>
void split(std::string_view stream, std::size_t piece, Framing framing, Take take) {
  MessageSplitter splitter(framing, 4096);
  attempt([&] {
    while (!stream.empty()) {
      const std::string_view some = stream.substr(0, piece == 0 ? stream.size() : piece);
      splitter.add(some);
      stream.remove_prefix(some.size());
      while (const auto message = splitter.next()) take(*message);
    }
  });
}

}  // namespace playerlike::protocol::fuzz
