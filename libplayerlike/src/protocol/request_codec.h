// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "playerlike/messages/requests.h"
#include "protocol/framing.h"

/// Requests and their answers as messages, by the fields that they list.
namespace playerlike::protocol {

/// The request of that name, as an index into the types of Request; nullopt if there is none.
[[nodiscard]] std::optional<std::size_t> find_request(std::string_view name) noexcept;

/// A request as a client sends it, but for its `id`.
/// @pre it has a name.
[[nodiscard]] nlohmann::json encode_request(const Request& request, Encoding encoding);
/// @param type  as find_request() gives it.
/// @throws ProtocolError protocol/bad-value, also for keys that the request has not.
[[nodiscard]] Request decode_request(std::size_t type, const nlohmann::json& message,
                                     Encoding encoding);

/// What a request is answered with, but for the `id`.
[[nodiscard]] nlohmann::json encode_answer(const Request& request, const Answer& answer,
                                           Encoding encoding);
/// @throws ProtocolError protocol/bad-value. Keys that are not known are passed over.
[[nodiscard]] Answer decode_answer(const Request& request, const nlohmann::json& answer,
                                   Encoding encoding);

}  // namespace playerlike::protocol
