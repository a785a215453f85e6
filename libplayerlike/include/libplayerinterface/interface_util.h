/* Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause */
#pragma once

/// @file
/// Names of Player's interfaces and of kinds of messages, and their codes. For C and C++. Texts
/// that are returned are the library's own: they stay, and must not be altered. May be called by
/// any thread at any time.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// An interface.
typedef struct {
  uint16_t interf;  ///< its code, PLAYER_..._CODE
  char* name;       ///< "laser", for instance
} player_interface_t;

/// There is nothing to prepare: the table is part of the library. @return 0.
int itable_init(void);
/// For programs that tidy up; does nothing.
void itable_destroy(void);

/// Looks for an interface by its name. @param interf  is filled in, if there is such one.
/// @return 0, or -1 if there is none or a pointer is null.
int lookup_interface(const char* name, player_interface_t* interf);
/// Looks for an interface by its code; as lookup_interface().
int lookup_interface_code(int code, player_interface_t* interf);
/// Name of an interface. @param startpos  interfaces with a lesser code are not looked at.
/// @return null if there is none.
const char* lookup_interface_name(unsigned int startpos, int code);
/// Name of an interface by its code; "unknown" if there is none.
const char* interf_to_str(uint16_t code);
/// Code of an interface by its name; 0xFFFF if there is none.
uint16_t str_to_interf(const char* name);

/// Name of a kind of message (PLAYER_MSGTYPE_...); "unknown" if there is none.
const char* msgtype_to_str(uint8_t code);
/// Code of a kind of message by its name; 0xFF if there is none.
uint8_t str_to_msgtype(const char* name);

#ifdef __cplusplus
}
#endif
