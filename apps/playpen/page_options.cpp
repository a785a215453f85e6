// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "page_options.h"

#include <algorithm>
#include <string>

#include "run_options.h"

namespace playpen {
namespace {

/// Whether a text can be the name of a machine (RFC 1123), without a port.
bool is_machine_name(const std::string& text) {
  constexpr std::size_t kMostLetters = 253;
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.';
  };
  return !text.empty() && text.size() <= kMostLetters &&
         std::all_of(text.begin(), text.end(), is_letter);
}

}  // namespace

void add_page(CommandLine& line, CLI::App& command, PageRequest& page) {
  CLI::Option* const wanted =
      command.add_flag("--page", page.wanted,
                       "Offer a page to browsers, which watch and steer, in real time unless "
                       "--time says otherwise");
  add_port(command, "--page-port",
           "TCP port of the page; 0: any free one [8080, or the next free one]", page.port)
      ->needs(wanted);
  command
      .add_option("--page-bind", page.bind,
                  "Address to which browsers connect, or a name of this machine [127.0.0.1]")
      ->type_name("ADDRESS")
      ->needs(wanted);
  command.add_flag("--page-open", page.open, "Let other machines watch the page without a token")
      ->needs(wanted);
  add_parsed(command, "--page-name",
             "A further name by which browsers may call this machine; can be repeated", "NAME",
             "a name of letters, digits, '-' and '.'",
             [&page](const std::string& text) {
               page.names.push_back(text);
               return is_machine_name(text);
             })
      ->expected(1)
      ->take_all()
      ->trigger_on_parse()
      ->needs(wanted);
  CLI::Option* const tokens = command.add_option("--page-token-file", page.token_file,
                                                 "File with the tokens of the page [random ones]");
  line.takes(tokens->type_name("FILE")->needs(wanted), ValueKind::Kind::kFile);
}

}  // namespace playpen
