// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What clients may read and use: private worlds, and the host's side of Permissions.
#include "host/core.h"

namespace playerlike {

void Host::Core::require_readable(const Client& client, int robot) const {
  if (!own_sensors_only() || client.served) return;
  const auto index = static_cast<std::size_t>(robot);
  if (robot >= 0 && (robots_.size() == 1 || robots_[index].port == client.port)) return;
  throw SessionError(
      SessionError::Code::kNotAvailable,
      robot >= 0
          ? "this world lets a program read the sensors of its own robot only (\"privacy\" in "
            "its \"simulation\"): robot " +
                robots_[index].name + " belongs to another port than " + std::to_string(client.port)
          : "this world keeps the poses and properties of its objects and its map private "
            "(\"privacy\" in its \"simulation\"): programs may use only the readings of their "
            "sensors");
}

void Host::Core::require_permission(const std::optional<std::string>& what) {
  if (what) throw SessionError(SessionError::Code::kNotAvailable, note_forbidden(*what));
}

std::string Host::Core::note_forbidden(const std::string& what) {
  results_.note_refusal(what);
  return "the task of this run does not let a program use " + what + " (it may use " +
         permissions_.allowed_text() + ')';
}

}  // namespace playerlike
