// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <typeinfo>

namespace imr::detail {

/// Name of a type as a person writes it, such as "PlayerCc::PlayerError"; the compiler's internal
/// name if it can't be translated.
std::string type_name(const std::type_info& type);

}  // namespace imr::detail
