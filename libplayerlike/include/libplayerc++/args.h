// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The command line of Player's example programs. Many programs include this header without
/// shipping it. It defines variables, so only one source file of a program may include it. Names,
/// options and defaults are those of examples/libplayerc++/args.h in Player 2 and 3.

#include <getopt.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "libplayerc++/playerc++.h"

// NOLINTBEGIN(misc-definitions-in-headers,cert-err58-cpp): programs expect these definitions
std::string gHostname(PlayerCc::PLAYER_HOSTNAME);  ///< -h
uint32_t gPort(PlayerCc::PLAYER_PORTNUM);          ///< -p
uint32_t gIndex(0);                                ///< -i: index of the devices
uint32_t gDebug(0);                                ///< -d: free for use by the program
uint32_t gFrequency(10);                           ///< -u: free for use by the program [Hz]
uint32_t gDataMode(PLAYER_DATAMODE_PUSH);          ///< -m, PLAYER_DATAMODE_PUSH or _PULL
bool gUseLaser(false);                             ///< -l: use the laser instead of the sonars
// NOLINTEND(misc-definitions-in-headers,cert-err58-cpp)

/// Prints the list of options to standard error.
inline void print_usage(int argc, char** argv) {
  std::cerr << "Usage: " << (argc > 0 ? argv[0] : "program") << " [options]\n"
            << "  -h <host>   name of the host [" << PlayerCc::PLAYER_HOSTNAME << "]\n"
            << "  -p <port>   port of the robot [" << PlayerCc::PLAYER_PORTNUM << "]\n"
            << "  -i <index>  index of the devices [0]\n"
            << "  -d <level>  how much the program tells [0]\n"
            << "  -u <rate>   how often it wants data [10 Hz]\n"
            << "  -l          use the laser, if the program can do with or without\n"
            << "  -m <mode>   how data are sent: " << PLAYER_DATAMODE_PUSH << " push, "
            << PLAYER_DATAMODE_PULL << " pull\n";
}

/// Sets the variables from a command line. For an unknown option, it prints the usage and exits
/// with -1.
/// @return 0.
inline int parse_args(int argc, char** argv) {
  const auto number = [] { return static_cast<uint32_t>(std::strtoul(optarg, nullptr, 10)); };
  for (int option = 0; (option = getopt(argc, argv, "h:p:i:d:u:lm:")) != -1;) {
    switch (option) {
      case 'h':
        gHostname = optarg;
        break;
      case 'p':
        gPort = number();
        break;
      case 'i':
        gIndex = number();
        break;
      case 'd':
        gDebug = number();
        break;
      case 'u':
        gFrequency = number();
        break;
      case 'l':
        gUseLaser = true;
        break;
      case 'm':
        gDataMode = number();
        break;
      default:
        print_usage(argc, argv);
        std::exit(-1);
    }
  }
  return 0;
}
