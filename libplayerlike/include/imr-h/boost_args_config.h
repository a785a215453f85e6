// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <string>

#include "imr-h/imr_config.h"

/// @file
/// The options of a configuration as options of Boost.Program_options, for programs whose main()
/// reads its arguments that way. Needs Boost, which nothing else of Playpen does: the package
/// libboost-program-options-dev, and -lboost_program_options. Names and signature: J. Faigl,
/// github.com/comrob/gsoa, crl/src/boost_args_config.h.

/// As course programs call it.
namespace po = boost::program_options;

namespace imr {

/// Adds an option for each of a configuration's. When boost::program_options::notify() is called,
/// the values that were found, or the default ones, are set in the configuration.
///
///   po::options_description options("Robot");
///   imr::boost_args_add_options(CRobot::getConfig(config), "robot-", options);
///   po::store(po::parse_command_line(argc, argv, options), variables);
///   po::notify(variables);
///
/// @param config  must live as long as the values are notified.
/// @param prefix  comes before each name: "robot-" makes --robot-port of the option "port".
/// @param desc    receives the options.
/// @return desc.
/// @throws imr::exception from notify(), for a text that is no value of an option's type.
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
