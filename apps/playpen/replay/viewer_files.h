// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

/// The files of the folder viewer/, compiled in (viewer_files.cpp.in).
namespace playpen::replay {

/// The scripts, which form one script in this order.
extern const std::span<const std::string_view> kViewerScripts;
extern const std::string_view kViewerStyle;
/// The elements of the page.
extern const std::string_view kViewerBody;
/// SHA-256 of the joined scripts and of the style, in base64, for the Content-Security-Policy.
extern const std::string_view kViewerScriptSha256;
extern const std::string_view kViewerStyleSha256;

}  // namespace playpen::replay
