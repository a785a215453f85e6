// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/replay_page.h"

#include <zlib.h>

#include <new>
#include <stdexcept>

#include "grade/text.h"
#include "playerlike/replay/replay_encoder.h"
#include "replay/viewer_files.h"
#include "sim/core/base64.h"
#include "sim/core/number_text.h"
#include "sim/core/utf8.h"

namespace playpen::replay {

using playerlike::replay::encoded;
using playerlike::replay::ReplayRun;
using playerlike::replay::Thinning;
using playerlike::replay::thinning_steps;

std::vector<std::uint8_t> deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> packed(size);
  const int result = compress2(packed.data(), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                               static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  if (result != Z_OK) throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

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
