// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "proxies/planner.h"

namespace playerlike {

/// The planner of a Player server, for share_planner(); it belongs to the caller alone.
/// @throws SessionError kNotAvailable if the session's server has no planners.
[[nodiscard]] std::shared_ptr<Planner> make_server_planner(Session& session,
                                                           const InterfaceBinding& binding);

}  // namespace playerlike
