/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Addresses of hosts as device addresses hold them (player_devaddr_t::host): IPv4, in network
/// order. For C and C++.

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Writes an address as text, "127.0.0.1" for instance. @param dest  room for `len` bytes; what
/// does not fit is cut off.
void packedaddr_to_dottedip(char* dest, size_t len, uint32_t addr);
/// Looks up a host by its name, or takes dotted text as it is. May wait for a name server.
/// @param dest  is written if the host is known. @return 0, or -1 if it is not.
int hostname_to_packedaddr(uint32_t* dest, const char* hostname);

#ifdef __cplusplus
}
#endif
