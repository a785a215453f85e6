// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/replay_page.h"

#include <cstdint>
#include <stdexcept>

#include "grade/text.h"
#include "replay/columns.h"
#include "replay/replay_encoder.h"
#include "replay/viewer_files.h"
#include "sim/core/base64.h"
#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace playpen::replay {
std::string html(const std::vector<ReplayRun>& runs, const PageOptions& options) {
  if (runs.empty()) throw std::invalid_argument("a replay needs at least one run");
  std::string title;
  for (const ReplayRun& run : runs) title += (title.empty() ? "" : " and ") + run.name;
  const std::string head =
      viewer_head(grade::markup_escaped(sim::escape_invalid_utf8(title)), viewer_policy()) +
      "<script type=\"application/octet-stream\" id=\"replay-data\">";
  const std::string tail = "</script>\n" + viewer_tail();
  const auto page = [&](const Thinning& thinning, const std::string& note) {
    return head + sim::to_base64(deflated(encoded(runs, thinning, note))) + tail;
  };
  for (const Thinning& thinning : thinning_steps()) {
    std::string made = page(thinning, "");
    if (made.size() <= options.most_bytes) return made;
  }
  constexpr double kMegabyte = 1e6;
  return page(thinning_steps().back(),
              "Nothing more can be left out, so it is still larger than the limit of " +
                  sim::rounded_text(static_cast<double>(options.most_bytes) / kMegabyte, 3) +
                  " MB.");
}

}  // namespace playpen::replay
