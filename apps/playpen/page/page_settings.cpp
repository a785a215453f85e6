// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "page_settings.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace playpen::page {

std::string to_line(const PageSettings& settings) {
  const nlohmann::json line = {{"bind", settings.bind},
                               {"port", settings.port},
                               {"ports", settings.ports},
                               {"names", settings.names},
                               {"open", settings.open},
                               {"command_token", settings.command_token},
                               {"watch_token", settings.watch_token},
                               {"title_markup", settings.title_markup}};
  return line.dump() + '\n';
}

PageSettings settings_of_line(std::string_view line) {
  try {
    const nlohmann::json json = nlohmann::json::parse(line);
    PageSettings settings;
    json.at("bind").get_to(settings.bind);
    json.at("port").get_to(settings.port);
    json.at("ports").get_to(settings.ports);
    json.at("names").get_to(settings.names);
    json.at("open").get_to(settings.open);
    json.at("command_token").get_to(settings.command_token);
    json.at("watch_token").get_to(settings.watch_token);
    json.at("title_markup").get_to(settings.title_markup);
    return settings;
  } catch (const nlohmann::json::exception&) {
    // Its message might show a token.
    throw std::runtime_error("the settings are not those that playpen sends");
  }
}

}  // namespace playpen::page
