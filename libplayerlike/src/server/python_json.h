// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace playerlike::server {

/// A value as Python's json.dumps() writes it, as MORSE does: a blank after each comma and colon,
/// characters outside of ASCII as \\u escapes, and Infinity, -Infinity and NaN for such numbers.
/// Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string python_json(const nlohmann::json& value);

}  // namespace playerlike::server
