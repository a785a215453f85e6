// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "playerlike/host/host.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// Opens the session that a client's host name means:
/// - "localhost" and "127.0.0.1": the embedded simulation of this process, of the world file named
///   by PLAYPEN_WORLD, else of the default world; or, if PLAYPEN_WORLD is "tcp://HOST[:PORT]", the
///   server there;
/// - "sim:FILE": an embedded simulation of that file;
/// - "tcp://HOST[:PORT]" or "HOST:PORT": the server there (`playpen serve`), on TCP port 4000
///   unless told otherwise. An IPv6 address is in brackets. PLAYPEN_TOKEN holds the tokens to be
///   presented, separated by commas; PLAYPEN_ENCODING is "cbor" (default) or "json";
/// - any other "HOST": the server there; but as "localhost", with a warning, where PLAYPEN_WORLD is
///   set, for programs that name a real robot's host.
///
/// All clients that name the same world file share one simulation, which lives until the program
/// ends.
/// @param port  Player port: of a robot, or 4000 for all. Not the server's TCP port.
/// @throws SessionError, sim::ConfigError.
[[nodiscard]] std::unique_ptr<Session> open_session(const std::string& host, int port);

/// Ends all embedded simulations and forgets them, so that the next client starts afresh.
/// For tests and for programs that run one world after another.
void close_embedded_hosts();

}  // namespace playerlike
