// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/fields.h"
#include "sim/io/reader.h"

namespace sim::io {

/// Reads the fields of a struct from an object of a world file. Keys that are left out keep what
/// `object` has; what is wrong is recorded with its place, as by Reader's getters.
void read_fields(Reader& settings, const FieldTable& table, void* object);

}  // namespace sim::io
