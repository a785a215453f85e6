// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "playerlike/messages/requests.h"
#include "protocol/framing.h"

/// Encodes requests and their answers from their lists of fields.
namespace playerlike::protocol {

/// The index of a request's name in the types of Request; nullopt if there is none.
[[nodiscard]] std::optional<std::size_t> find_request(std::string_view name) noexcept;

/// Encodes a request as a client sends it, without `id`. @pre it has a name.
[[nodiscard]] nlohmann::json encode_request(const Request& request, Encoding encoding);
/// @param type  from find_request(). @throws ProtocolError protocol/bad-value, also for unknown
///              keys.
/// @param spare  gives its memory to the cells of a SetCellsRequest; may be null.
[[nodiscard]] Request decode_request(std::size_t type, const nlohmann::json& message,
                                     Encoding encoding, Spare<sim::CellValue>* spare = nullptr);

/// Encodes the answer to a request, without `id`.
[[nodiscard]] nlohmann::json encode_answer(const Request& request, const Answer& answer,
                                           Encoding encoding);
/// Ignores unknown keys. @throws ProtocolError protocol/bad-value.
[[nodiscard]] Answer decode_answer(const Request& request, const nlohmann::json& answer,
                                   Encoding encoding);

}  // namespace playerlike::protocol
