// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "messages/spare.h"

/// The two encodings of messages; framing.h documents them.
namespace playerlike::protocol {

void append_json(const nlohmann::json& value, std::string& out);
void append_cbor(const nlohmann::json& value, std::string& out);

/// @param splice_lists  whether long lists of numbers become typed arrays.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, bool splice_lists);
/// @param spare    see decode(); may be null.
/// @param encoded  see decode(); may be empty.
[[nodiscard]] nlohmann::json parse_cbor(std::string_view bytes, Spare<std::uint8_t>* spare,
                                        std::string_view encoded);

}  // namespace playerlike::protocol
