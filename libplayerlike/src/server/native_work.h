// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "playerlike/host/host.h"
#include "playerlike/messages/requests.h"
#include "protocol/framing.h"

/// Requests of Playpen's own protocol whose work grows with the canvas or the arena, so that it is
/// done by the server's workshop (workshop.h) when there is much of it.
namespace playerlike::server {

/// Cells that a server's map has at most.
inline constexpr double kMaxMapCells = 1 << 22;

/// Length and width of the arena.
[[nodiscard]] sim::Vec2 native_arena_m(Host& host);

/// How much work a request is, in cells that it looks at or makes.
[[nodiscard]] std::size_t native_work_cells(const Request& request, Session& session, Host& host);

/// The most bytes that the answer to a request has, if they are many; else 0.
[[nodiscard]] std::size_t native_answer_bytes(const Request& request, Session& session,
                                              protocol::Encoding encoding);

}  // namespace playerlike::server
