// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <string>

#include "imr-h/imr_config.h"

/// @file
/// Offers the options of a configuration through Boost.Program_options, for programs whose main()
/// parses its arguments with that library. This is the only header of Playpen that needs Boost:
/// install the package libboost-program-options-dev and link with -lboost_program_options. Names
/// and signature: J. Faigl, github.com/comrob/gsoa, crl/src/boost_args_config.h.

/// The alias that course programs use.
namespace po = boost::program_options;

namespace imr {

/// Adds one Boost option for each option of a configuration. boost::program_options::notify() then
/// writes the parsed values, or the defaults, into the configuration.
///
///   po::options_description options("Robot");
///   imr::boost_args_add_options(CRobot::getConfig(config), "robot-", options);
///   po::store(po::parse_command_line(argc, argv, options), variables);
///   po::notify(variables);
///
/// @param config  receives the values; must outlive the last call of notify().
/// @param prefix  is put before each name: with "robot-" the option "port" becomes --robot-port.
/// @param desc    receives the options.
/// @return desc.
/// @throws imr::exception from notify(), if a text cannot be parsed as the option's type.
inline boost::program_options::options_description& boost_args_add_options(
    CConfig& config, const std::string& prefix, boost::program_options::options_description& desc) {
  for (const CConfig::OptionInfo& option : config.options()) {
    auto* const value = boost::program_options::value<std::string>();
    if (option.has_default) value->default_value(option.default_text);
    const std::string name = option.name;
    value->notifier([&config, name](const std::string& text) { config.set(name, text); });
    desc.add_options()((prefix + name).c_str(), value, option.description.c_str());
  }
  return desc;
}

}  // namespace imr
