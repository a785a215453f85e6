// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "playerlike/host/host.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// Opens the session for a client's host name:
/// - "localhost" and "127.0.0.1": the embedded simulation of this process. PLAYPEN_WORLD names its
///   world file; without it, the default world is used. If PLAYPEN_WORLD is "tcp://HOST[:PORT]",
///   "unix:PATH" or "player://HOST[:PORT]", that server is used instead. A Player server there has
///   the robot on port 6665 at PORT, and others at the same distance to it;
/// - "test:N": a run of a test, see name_host(). A test can also make "localhost" its name;
/// - "sim:FILE": an embedded simulation of that file;
/// - "tcp://HOST[:PORT]" or "HOST:PORT": a Playpen server (`playpen serve`). Its default TCP
///   port is 4000. An IPv6 address is written in brackets. PLAYPEN_TOKEN contains the client's
///   tokens, separated by commas; PLAYPEN_ENCODING is "cbor" (default) or "json";
/// - "unix:PATH": the Playpen server at that Unix socket; "unix:fd=N": the one to which the
///   descriptor N of this process is connected, for one session;
/// - "player://HOST[:PORT]": a Player server: a real robot, or `playpen serve --player-port`.
///   Without a PORT, it is the client's `port` (6665 for MORSE's port 4000);
/// - any other "HOST": the server there, of Player on the client's `port` if one greets there,
///   otherwise of Playpen on port 4000; with MORSE's port, only the latter. If PLAYPEN_WORLD is
///   set, it means "localhost" instead, with a warning: this supports programs that name a real
///   robot's host.
///
/// All clients with the same world file share one simulation. That of "localhost" exists until the
/// program ends, as on a Player server. That of "sim:FILE" ends with its last client: the next one
/// starts a new simulation.
/// @param port  Player port: a robot's port, or 4000 for all robots. Not the TCP port of a Playpen
///              server, but that of a Player server.
/// @throws SessionError, sim::ConfigError.
[[nodiscard]] std::unique_ptr<Session> open_session(const std::string& host, int port);

/// The simulation that clients of "localhost" share, without a session: for a process that serves
/// it to a program (`playpen run --isolated`). It is made if there is none yet.
/// @throws sim::ConfigError; SessionError kBadArgument if PLAYPEN_WORLD names a server.
[[nodiscard]] std::shared_ptr<Host> open_host_of_run();

/// Opens a session with a real robot, for RunSettings::open_real_robot: with the server that
/// "player://HOST[:PORT]" or "tcp://HOST[:PORT]" names. RealRobotPlace::port is also the default
/// port of a Player server.
/// @throws SessionError.
[[nodiscard]] std::unique_ptr<Session> open_real_robot(const RealRobotPlace& place);

/// Ends and removes all embedded simulations, so that the next client starts a new one. For tests
/// and for programs that run several worlds in sequence.
void close_embedded_hosts();

}  // namespace playerlike
