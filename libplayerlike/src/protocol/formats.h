// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// The two encodings of messages; framing.h documents them.
namespace playerlike::protocol {

void append_json(const nlohmann::json& value, std::string& out);
void append_cbor(const nlohmann::json& value, std::string& out);

/// @param splice_lists  whether long lists of numbers become typed arrays.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, bool splice_lists);
[[nodiscard]] nlohmann::json parse_cbor(std::string_view bytes);

}  // namespace playerlike::protocol
