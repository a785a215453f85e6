// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program's own header for the command line. It checks with Player's playerconfig.h what the
// system provides, and uses Player's replacements for the rest, like an example of Player 3.
#ifndef OWN_ARGS_H
#define OWN_ARGS_H

#include <libplayerc++/playerc++.h>
#if !HAVE_GETOPT || !HAVE_USLEEP
#error "playerconfig.h does not tell that this system has getopt() and usleep()"
#endif
#include <replace.h>
#include <replace/replace.h>

#include <cstdlib>
#include <iostream>

std::string gHostname(PlayerCc::PLAYER_HOSTNAME);
uint32_t gPort(PlayerCc::PLAYER_PORTNUM);
uint gRounds(5);

int parse_args(int argc, char** argv) {
  int option;
  while ((option = getopt(argc, argv, "h:p:r:")) != -1) {
    if (option == 'h') gHostname = optarg;
    if (option == 'p') gPort = atoi(optarg);
    if (option == 'r') gRounds = atoi(optarg);
  }
  usleep(1);
  return 0;
}

#endif
