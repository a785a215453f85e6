// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace playpen::page {

/// The Content-Security-Policy of the live page: no script and no style but its own, no connection
/// but to the server that it comes from.
/// @param host  the value of the request's field Host. @pre is_own_host(host, ...).
[[nodiscard]] std::string live_policy(std::string_view host);

/// The live page: that of a replay (replay/viewer) without data, whose script then connects to
/// /live.
/// @param title_markup  as HTML. @param host  see live_policy().
[[nodiscard]] std::string live_page(std::string_view title_markup, std::string_view host);

}  // namespace playpen::page
