// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drives a robot and prints how far the other one has moved as this robot sees it; for the tests of
// several programs in one run.
// Usage: sharing_program PORT OBJECT SECONDS [fork|hold]; "hold" reads a line at the end
#include <libplayerc++/playerc++.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

int drive(int port, const std::string& other, double duration_s, bool hold = false) {
  PlayerCc::PlayerClient robot("localhost", static_cast<unsigned>(port));
  PlayerCc::Position2dProxy position(&robot, 0);
  PlayerCc::SimulationProxy simulation(&robot, 0);
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  simulation.GetPose2d(const_cast<char*>(other.c_str()), x, y, yaw);
  const double begin = x;
  position.SetSpeed(0.2, 0.0);
  robot.Read();
  const double own_begin = position.GetXPos();
  // The robot stops when this client ends, and the other program waits until it has moved, too. On
  // a busy machine this program may begin late.
  do {
    robot.Read();
    simulation.GetPose2d(const_cast<char*>(other.c_str()), x, y, yaw);
  } while (position.GetDataTime() < duration_s || std::abs(x - begin) < 0.05 ||
           position.GetXPos() - own_begin < 0.07);
  std::cout << other << " has moved, as port " << port << " sees it" << std::endl;
  std::string line;
  if (hold) std::getline(std::cin, line);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const int port = std::atoi(argv[1]);
  const double duration_s = std::atof(argv[3]);
  const std::string option = argc == 5 ? argv[4] : "";
  if (option != "fork") return drive(port, argv[2], duration_s, option == "hold");
  // The child drives the other robot.
  const pid_t child = fork();
  if (child == 0) return drive(port + 1, "r1", duration_s);
  const int status = drive(port, "r2", duration_s);
  int child_status = 0;
  waitpid(child, &child_status, 0);
  return status + child_status;
}
