// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <sys/stat.h>

#include <algorithm>
#include <random>

#include "playerlike/server/server_settings.h"
#include "sim/core/number_text.h"
#include "sim/io/settings_file.h"

namespace playerlike {
namespace {

constexpr const char* kTokenExpected = "16 to 256 English letters, digits or signs, without blanks";

/// The token of a key, "" if there is none or it is not valid.
std::string read_token(sim::io::Reader& object, const std::string& key) {
  const auto child = object.child(key);
  if (!child) return "";
  if (!child->is_string()) {
    object.issue("access/token", kTokenExpected, "no text", "", key);
    return "";
  }
  std::string token = child->scalar_text().value_or("");
  // The error does not show the token, since errors end up in logs.
  const bool printable =
      std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (token.size() >= kMinToken && token.size() <= kMaxToken && printable) return token;
  object.issue("access/token", kTokenExpected,
               printable ? std::to_string(token.size()) + " characters" : "other characters",
               "`playpen token` makes one", key);
  return "";
}

void warn_of_short_token(const std::string& file, const std::string& whose,
                         const std::string& token, const sim::LogHook& log) {
  if (!log || token.empty() || token.size() >= kGoodToken) return;
  log(sim::LogLevel::kWarning,
      file + ": the token of " + whose + " has " + std::to_string(token.size()) +
          " characters; less than " + std::to_string(kGoodToken) +
          " can be guessed, and the next release will refuse them. `playpen token` makes a good "
          "one");
}

void warn_if_shared(const std::string& file, const sim::LogHook& log) {
  struct stat info {};
  if (!log || stat(file.c_str(), &info) != 0 || (info.st_mode & S_IROTH) == 0) return;
  log(sim::LogLevel::kWarning, "every user of this machine may read the tokens in " + file +
                                   "; chmod 600 makes it yours alone");
}

}  // namespace

std::string make_token() {
  std::random_device device;
  std::string text;
  for (int i = 0; i < 4; ++i) text += sim::hexadecimal_text(device(), 8);
  return text;
}

AccessSettings read_token_file(const std::string& file, const sim::LogHook& log) {
  AccessSettings settings;
  settings.file = file;
  sim::io::read_settings(file, "token", [&settings](sim::io::Reader& root) {
    if (!root.expect_object()) return;
    settings.server_token = read_token(root, "server");
    if (auto robots = root.object("robots")) {
      for (const std::string& name : robots->keys()) {
        settings.robot_tokens[name] = read_token(*robots, name);
      }
      robots->finish();
    }
    settings.open_watching = root.boolean("open_watching", false);
    root.finish();
  });
  warn_if_shared(file, log);
  warn_of_short_token(file, "the server", settings.server_token, log);
  for (const auto& [robot, token] : settings.robot_tokens) {
    warn_of_short_token(file, "the robot " + robot, token, log);
  }
  return settings;
}

PageTokens read_page_tokens(const std::string& file, const sim::LogHook& log) {
  PageTokens tokens;
  sim::io::read_settings(file, "token", [&tokens](sim::io::Reader& root) {
    if (!root.expect_object()) return;
    tokens.command = read_token(root, "command");
    tokens.watch = read_token(root, "watch");
    if (!tokens.watch.empty() && tokens.watch == tokens.command) {
      root.issue("access/token", "another token than that for commands", "the same",
                 "who may watch could command", "watch");
    }
    root.finish();
  });
  warn_if_shared(file, log);
  warn_of_short_token(file, "the page's commands", tokens.command, log);
  warn_of_short_token(file, "the page's watching", tokens.watch, log);
  return tokens;
}

}  // namespace playerlike
