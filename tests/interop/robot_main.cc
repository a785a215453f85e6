// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The main program for robot.cc of the SyRoTek course, compiled for the real robot (without
// -D_MORSE).
#include <exception>

#include "imr-h/imr_config.h"
#include "imr-h/logging.h"
#include "robot.h"

int main(int argc, char** argv) {
  try {
    imr::CConfig config;
    imr::robot::CRobot::getConfig(config);
    if (!config.parse_command_line(argc, argv)) return 0;
    imr::robot::CRobot robot(config);
    robot.execute();
    robot.join();
    return 0;
  } catch (const std::exception& e) {
    ERROR(e.what());
  }
  return 1;
}
