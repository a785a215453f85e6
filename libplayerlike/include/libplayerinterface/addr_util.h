/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Conversion of host addresses in device addresses (player_devaddr_t::host): IPv4 in network byte
/// order. For C and C++.

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Writes an address as text, for example "127.0.0.1".
/// @param dest  buffer of `len` bytes; the text is truncated if it does not fit.
void packedaddr_to_dottedip(char* dest, size_t len, uint32_t addr);
/// Resolves a host name or parses an address in dotted notation. May wait for a name server.
/// @param dest  receives the address; unchanged if the host is unknown.
/// @return 0, or -1 if the host is unknown.
int hostname_to_packedaddr(uint32_t* dest, const char* hostname);

#ifdef __cplusplus
}
#endif
