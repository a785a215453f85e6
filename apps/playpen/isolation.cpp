// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "isolation.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "sandbox.h"

namespace playpen {

namespace {

namespace fs = std::filesystem;

void add_path(std::vector<std::string>& words, const char* option, const std::string& path) {
  words.insert(words.end(), {option, fs::absolute(path).lexically_normal().string()});
}

}  // namespace

IsolatedPrograms::IsolatedPrograms(const IsolationSettings& settings) {
  if (settings.level == Isolation::kOff) return;
  const IsolationAbility ability = try_isolation();
  if (!ability.obstacle.empty()) {
    if (settings.level == Isolation::kRequired) {
      throw std::runtime_error("the program cannot be isolated: " + ability.obstacle);
    }
    std::cerr << "playpen: programs are not isolated: " << ability.obstacle << '\n';
    return;
  }
  launcher_ = {fs::read_symlink("/proc/self/exe").string(), "contain"};
  if (!ability.sized) launcher_.emplace_back("--unsized");
  for (const std::string& path : settings.readable) {
    if (!fs::exists(path)) {
      throw std::runtime_error("--readable names '" + path + "', which does not exist");
    }
    add_path(launcher_, "--readable", path);
  }
}

std::vector<std::string> IsolatedPrograms::launcher(
    const std::string& preloaded, const std::vector<std::string>& hidden,
    const std::vector<std::string>& readable) const {
  std::vector<std::string> words = launcher_;
  if (words.empty()) return words;
  for (const std::string& path : readable) add_path(words, "--readable", path);
  for (const std::string& path : hidden) {
    if (!path.empty()) add_path(words, "--hidden", path);
  }
  if (!preloaded.empty()) words.insert(words.end(), {"--preload", preloaded});
  words.emplace_back("--");
  return words;
}

std::vector<std::string> IsolatedPrograms::build_launcher(
    const std::vector<std::string>& readable) const {
  std::vector<std::string> words = launcher_;
  if (words.empty()) return words;
  words.emplace_back("--build");
  for (const std::string& path : readable) add_path(words, "--readable", path);
  words.emplace_back("--");
  return words;
}

}  // namespace playpen
