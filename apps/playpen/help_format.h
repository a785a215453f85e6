// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

namespace playpen {

struct CommandLine;

/// CLI11's help, wrapped to the terminal's width, with the client program in the usage.
class HelpFormatter : public CLI::Formatter {
 public:
  /// @param line  must outlive this object.
  explicit HelpFormatter(const CommandLine& line);

  [[nodiscard]] std::string make_usage(const CLI::App* app, std::string name) const override;
  [[nodiscard]] std::string make_subcommand(const CLI::App* command) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;

 private:
  [[nodiscard]] std::string in_lines(const std::string& text) const;

  const CommandLine& line_;
  std::size_t columns_;
};

}  // namespace playpen
