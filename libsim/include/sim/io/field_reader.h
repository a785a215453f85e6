// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/fields.h"
#include "sim/io/reader.h"

namespace sim::io {

/// Reads the fields of a struct from an object of a world file. Missing keys leave the values in
/// `object` unchanged. Errors are recorded with their place, as Reader's getters do.
void read_fields(Reader& settings, const FieldTable& table, void* object);

}  // namespace sim::io
