// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <exception>

#include "imr-h/imr_config.h"
#include "imr-h/logging.h"
#include "libCCMorse/CCMorse.h"
#include "robot.h"

int main(int argc, char** argv) {
  try {
    imr::CConfig config;
    CRobot::getConfig(config);
    if (!config.parse_command_line(argc, argv)) return 0;  // the user asked for --help

    CRobot robot(config);
    robot.execute();  // starts the robot's thread
    robot.join();     // waits until it ends
    return 0;
  } catch (const CCMorse::MorseError& e) {
    ERROR("No robot: " << e.GetErrorStr() << " (in " << e.GetErrorFun() << ")");
  } catch (const std::exception& e) {
    ERROR(e.what());
  }
  return 1;
}
