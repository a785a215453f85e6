// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
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

/// The Content-Security-Policy of pages with the viewer: no script and no style but its own.
/// @param further  further directives, each after "; ".
[[nodiscard]] std::string viewer_policy(std::string_view further = {});

/// A page with the viewer, up to the place after its elements, where data or viewer_tail() follow.
/// @param title_markup  the title as HTML.
/// @param policy  see viewer_policy().
[[nodiscard]] std::string viewer_head(std::string_view title_markup, std::string_view policy);

/// The rest of a page: the viewer's script, and the end.
[[nodiscard]] std::string viewer_tail();

}  // namespace playpen::replay
