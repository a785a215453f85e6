// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "playerlike/host/host.h"
#include "playerlike/messages/requests.h"
#include "protocol/framing.h"

/// Cost estimates of requests in Playpen's own protocol whose work grows with the canvas or the
/// arena. The server's worker thread (worker_thread.h) executes expensive ones.
namespace playerlike::server {

/// A larger answer needs a claim on the server's limit of queued bytes, see Hub::claim_room()
/// [bytes].
inline constexpr std::size_t kSmallAnswer = std::size_t{1} << 20U;

/// Maximum number of cells of a server's map.
inline constexpr double kMaxMapCells = 1 << 22;

/// Length and width of the arena.
[[nodiscard]] sim::Vec2 native_arena_m(Host& host);

/// The work of a request, as the number of cells that it reads or makes.
[[nodiscard]] std::size_t native_work_cells(const Request& request, Session& session, Host& host);

/// An upper bound of the bytes of the answer to a request, if they are many; otherwise 0.
[[nodiscard]] std::size_t native_answer_bytes(const Request& request, Session& session,
                                              protocol::Encoding encoding);

}  // namespace playerlike::server
