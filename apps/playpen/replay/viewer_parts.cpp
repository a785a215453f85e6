// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "replay/viewer_files.h"

namespace playpen::replay {

std::string viewer_policy(std::string_view further) {
  return "default-src 'none'; script-src 'sha256-" + std::string(kViewerScriptSha256) +
         "'; style-src 'sha256-" + std::string(kViewerStyleSha256) +
         "'; img-src data:; base-uri 'none'; form-action 'none'" + std::string(further);
}

std::string viewer_head(std::string_view title_markup, std::string_view policy) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         std::string(policy) +
         "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         std::string(title_markup) + "</title>\n<style>" + std::string(kViewerStyle) +
         "</style>\n</head>\n<body>\n" + std::string(kViewerBody);
}

std::string viewer_tail() {
  std::string tail = "<script>";
  for (const std::string_view script : kViewerScripts) tail += script;
  return tail + "</script>\n</body>\n</html>\n";
}

}  // namespace playpen::replay
