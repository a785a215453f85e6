// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "protocol/codec.h"

namespace playerlike::protocol {

/// Prints an encoding in GoogleTest's output.
inline void PrintTo(Encoding encoding, std::ostream* os) { *os << to_string(encoding); }

}  // namespace playerlike::protocol
