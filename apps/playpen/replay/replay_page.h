// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/replay/replay_run.h"

namespace playpen::replay {

/// A replay as a page of its own.
struct PageOptions {
  std::size_t most_bytes = 5'000'000;  ///< of the page
};

/// The runs as one HTML page that needs no other file and no network, see docs/replay.md. Texts of
/// the runs are data for its script, never markup, and a Content-Security-Policy allows no script
/// but the page's own. Several runs are shown side by side or over each other.
///
/// If the page would have more than `most_bytes`, parts of the run are left out in the steps of
/// thinning_steps(), and the page says which. If even the last step is too large, its page is
/// returned, and says that too.
/// @throws std::invalid_argument if there is no run.
[[nodiscard]] std::string html(const std::vector<playerlike::replay::ReplayRun>& runs,
                               const PageOptions& options = {});

/// The bytes in zlib's format (RFC 1950), compressed at zlib's default level.
/// @throws std::bad_alloc if there is no memory.
[[nodiscard]] std::vector<std::uint8_t> deflated(std::string_view bytes);

}  // namespace playpen::replay
