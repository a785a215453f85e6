// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// For sources that define many tables of fields, in namespace sim. They undefine the macros at
// their end.
#include "sim/core/fields.h"

/// Defines fields_of<Struct>() like SIM_FIELDS, but with the fields themselves. They call the
/// struct T.
#define MESSAGE_CHECKED(Struct, check, ...)                \
  template <>                                              \
  const FieldTable& fields_of<Struct>() {                  \
    using T = Struct;                                      \
    static constexpr Field kFields[] = {__VA_ARGS__};      \
    static constexpr FieldTable kTable = {kFields, check}; \
    return kTable;                                         \
  }
#define MESSAGE(Struct, ...) MESSAGE_CHECKED(Struct, nullptr, __VA_ARGS__)
