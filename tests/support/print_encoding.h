// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "protocol/codec.h"

namespace playerlike::protocol {

/// How GoogleTest names an encoding in its output.
inline void PrintTo(Encoding encoding, std::ostream* os) { *os << to_string(encoding); }

}  // namespace playerlike::protocol
