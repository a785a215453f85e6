// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "live_page.h"

#include "replay/viewer_files.h"

namespace playpen::page {

// Some browsers do not count a WebSocket among 'self'.
std::string live_policy(std::string_view host) {
  const std::string name(host);
  return replay::viewer_policy("; connect-src 'self' ws://" + name + " wss://" + name);
}

std::string live_page(std::string_view title_markup, std::string_view host) {
  return replay::viewer_head(title_markup, live_policy(host)) + replay::viewer_tail();
}

}  // namespace playpen::page
