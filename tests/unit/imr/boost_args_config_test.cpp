// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A main() in the style of course programs: options by Boost, a log, a robot's configuration.
#include "imr-h/boost_args_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "imr-h/imr_exceptions.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;

imr::CConfig& get_config(imr::CConfig& config) {
  config.add<std::string>("host", "server", "localhost");
  config.add<int>("port", "of the server", 4000);
  config.add<bool>("coords", "set the place", false);
  config.add<double>("x", "in m");
  return config;
}

// Reads a command line and a configuration file, as a program's parseArgs() does.
void parse(imr::CConfig& config, const std::string& prefix, std::vector<const char*> arguments,
           const std::string& file = "") {
  po::options_description options("Robot");
  EXPECT_EQ(&imr::boost_args_add_options(config, prefix, options), &options);
  arguments.insert(arguments.begin(), "robot");
  po::variables_map variables;
  po::store(po::parse_command_line(static_cast<int>(arguments.size()), arguments.data(), options),
            variables);
  po::notify(variables);
  std::istringstream in(file);
  po::store(po::parse_config_file(in, options), variables);
  po::notify(variables);
}

TEST(BoostArgs, FillConfiguration) {
  imr::CConfig config;
  parse(get_config(config), "", {"--port", "6665", "--x=-1.5", "--coords", "true"});
  EXPECT_EQ(config.get<std::string>("host"), "localhost");
  EXPECT_EQ(config.get<int>("port"), 6665);
  EXPECT_TRUE(config.get<bool>("coords"));
  EXPECT_EQ(config.get<double>("x"), -1.5);
}

TEST(BoostArgs, OverrideFileAndDefaults) {
  imr::CConfig config;
  parse(get_config(config), "", {"--port", "6665"}, "port = 7000\nhost = arena\n");
  EXPECT_EQ(config.get<int>("port"), 6665);
  EXPECT_EQ(config.get<std::string>("host"), "arena");
  EXPECT_THROW(config.get<double>("x"), imr::exception) << "nobody has given it a value";
}

TEST(BoostArgs, Prefix_Accepted) {
  imr::CConfig config;
  parse(get_config(config), "robot-", {"--robot-port", "6666"});
  EXPECT_EQ(config.get<int>("port"), 6666);
}

TEST(BoostArgs, Help_ShowsDefaults) {
  imr::CConfig config;
  po::options_description options("Robot");
  std::ostringstream help;
  help << imr::boost_args_add_options(get_config(config), "", options);
  EXPECT_THAT(help.str(), AllOf(HasSubstr("--port arg (=4000)"), HasSubstr("of the server")));
}

TEST(BoostArgs, WrongType_Refused) {
  imr::CConfig config;
  get_config(config);
  try {
    parse(config, "", {"--port", "many"});
    FAIL();
  } catch (const imr::exception& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("port"), HasSubstr("many")));
  }
}

}  // namespace
