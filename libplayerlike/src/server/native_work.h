// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "playerlike/host/event_client.h"
#include "playerlike/host/host.h"
#include "protocol/framing.h"

/// Requests of Playpen's own protocol whose work grows with the canvas or the arena, so that it is
/// done by the server's workshop (workshop.h) when there is much of it.
namespace playerlike::server {

/// What such a request works on, whichever thread does.
struct NativeSubject {
  Session& session;
  Host& host;
  protocol::Encoding encoding;
};

/// Makes the answer to a request, or throws as a handler's requests do.
using NativeWork = nlohmann::json (*)(const NativeSubject& subject, const nlohmann::json& request);

/// The one that makes the answers to requests of that name; nullptr for other names.
[[nodiscard]] NativeWork find_native_work(std::string_view name) noexcept;

/// How much work a request is, in cells that it looks at or makes. Throws as the request does if
/// that cannot be told.
[[nodiscard]] std::size_t native_work_cells(const NativeSubject& subject,
                                            const nlohmann::json& request, std::string_view name);

/// The most bytes that the answer to a request has, if they are many; else 0.
[[nodiscard]] std::size_t native_answer_bytes(const NativeSubject& subject, std::string_view name);

/// Columns and rows in requests lie between this and its negative.
inline constexpr int kMaxCell = 1 << 30;

/// @name Values of requests
/// @{
[[nodiscard]] sim::LayerId require_layer(const nlohmann::json& request);
[[nodiscard]] sim::CellRect require_rect(const nlohmann::json& request, const char* key = "rect");
/// @}

}  // namespace playerlike::server
