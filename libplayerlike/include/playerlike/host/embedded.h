// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "playerlike/host/host.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// Opens the session that a client's host name means (DESIGN section 4): "localhost" and
/// "127.0.0.1" are the embedded simulation of this process, of the world file named by
/// PLAYPEN_WORLD, else of the default world; "sim:FILE" is an embedded simulation of that file.
/// All clients that name the same world share one simulation, which lives until the program ends.
/// @throws SessionError, sim::ConfigError.
[[nodiscard]] std::unique_ptr<Session> open_session(const std::string& host, int port);

/// Ends all embedded simulations and forgets them, so that the next client starts afresh.
/// For tests and for programs that run one world after another.
void close_embedded_hosts();

}  // namespace playerlike
