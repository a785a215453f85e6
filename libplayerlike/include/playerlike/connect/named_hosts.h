// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "playerlike/host/host.h"

/// Hosts that open_session() finds by a name: for tests, whose code under test connects as usual.
/// Any thread may call.
namespace playerlike {

/// Gives a host a name, "test:N", which no other host of this process has had. The name is valid as
/// long as the host exists.
[[nodiscard]] std::string name_host(const std::shared_ptr<Host>& host);
/// Takes a name away from its host, whose clients remain.
void forget_host(const std::string& name);

/// Makes "localhost" and "127.0.0.1" the name of a host too, as long as it exists, instead of the
/// embedded simulation; null: not any more.
/// @return false if another host has these names now; nothing changes then.
/// @throws SessionError kBadArgument while the program is graded.
[[nodiscard]] bool name_host_localhost(const std::shared_ptr<Host>& host);

}  // namespace playerlike
