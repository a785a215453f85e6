// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "playerlike/connect/named_hosts.h"

namespace playerlike {

/// The host that has this name, see name_host() and name_host_localhost(); null if the name is no
/// host's.
/// @throws SessionError kBadArgument for "test:" names of hosts that do not exist any more.
[[nodiscard]] std::shared_ptr<Host> named_host(const std::string& name);

}  // namespace playerlike
