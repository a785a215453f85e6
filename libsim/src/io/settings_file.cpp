// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/settings_file.h"

#include "io/document.h"

namespace sim::io {
namespace {

void parse_into(std::string_view text, Reader::Document& document, const SettingsParser& parse) {
  if (text.size() > kMaxFileBytes) {
    document.add({"file/too-large", document.file, "", "at most 16 MiB", "more", ""});
  } else if (parse_document(text, document)) {
    Reader root(document, document.root, "");
    parse(root);
  }
  throw_issues(document);
}

}  // namespace

void read_settings(const std::string& path, const std::string& what, const SettingsParser& parse) {
  Reader::Document document;
  document.file = path;
  document.what = what;
  std::string text;
  const std::string a_file = "a " + what + " file";
  if (!read_file(path, text, document, a_file.c_str())) throw_issues(document);
  parse_into(text, document, parse);
}

void read_settings_text(std::string_view text, const std::string& file, const std::string& what,
                        const SettingsParser& parse) {
  Reader::Document document;
  document.file = file;
  document.what = what;
  parse_into(text, document, parse);
}

}  // namespace sim::io
