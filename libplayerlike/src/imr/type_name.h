// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <typeinfo>

namespace imr::detail {

/// The readable name of a type, such as "PlayerCc::PlayerError"; the mangled name if it can't be
/// demangled.
std::string type_name(const std::type_info& type);

}  // namespace imr::detail
