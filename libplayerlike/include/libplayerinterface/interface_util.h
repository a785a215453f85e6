/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Names and codes of Player's interfaces and message types. For C and C++. Returned texts belong
/// to the library: they remain valid and must not be modified. All functions may be called from any
/// thread at any time.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// An interface.
typedef struct {
  uint16_t interf;  ///< interface code, PLAYER_..._CODE
  char* name;       ///< interface name, e.g. "laser"
} player_interface_t;

/// Does nothing, because the table is part of the library.
/// @return 0.
int itable_init(void);
/// Does nothing; it exists for programs that call it.
void itable_destroy(void);

/// Looks up an interface by its name.
/// @param interf  receives the interface if it exists.
/// @return 0, or -1 if there is no such interface or a pointer is null.
int lookup_interface(const char* name, player_interface_t* interf);
/// Looks up an interface by its code, like lookup_interface().
int lookup_interface_code(int code, player_interface_t* interf);
/// Name of an interface by its code.
/// @param startpos  interfaces with a lower code are ignored.
/// @return the name, or null if there is no such interface.
const char* lookup_interface_name(unsigned int startpos, int code);
/// Name of an interface by its code; "unknown" for an unknown code.
const char* interf_to_str(uint16_t code);
/// Code of an interface by its name; 0xFFFF for an unknown name.
uint16_t str_to_interf(const char* name);

/// Name of a message type (PLAYER_MSGTYPE_...); "unknown" for an unknown code.
const char* msgtype_to_str(uint8_t code);
/// Code of a message type by its name; 0xFF for an unknown name.
uint8_t str_to_msgtype(const char* name);

#ifdef __cplusplus
}
#endif
