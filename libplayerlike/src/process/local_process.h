// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace playerlike {

/// The process on this machine that holds the other end of a TCP connection or of a Unix socket. If
/// several processes share that end, it is the one with the lowest number.
/// @param socket  descriptor of a connected socket, IPv4 or IPv6.
/// @return its number; nullopt if the other end is on another machine, is closed already, or
/// belongs
///         to a process whose files this process may not see (one of another user).
/// @note Reads tables of the system (/proc), about a millisecond.
[[nodiscard]] std::optional<int> peer_process(int socket);
/// The search of peer_process(), for later and for any thread. It does not use the socket, which
/// may be closed by then.
[[nodiscard]] std::function<std::optional<int>()> peer_process_search(int socket);

/// The IPv4 address of this end of a connected socket as it lies in memory, also if it is mapped to
/// IPv6; 0: it has none.
[[nodiscard]] std::uint32_t own_ipv4_of(int socket);

}  // namespace playerlike
