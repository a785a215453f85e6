// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Runs a program beside a simulation with a Player server, and watches its robots by
// SimulationProxy:
//   watch_program PORT SECONDS REPORT START... -- PROGRAM [ARGUMENT...]
// START is NAME,X,Y,YAW_DEGREES: the robot is put there first, and its odometry is set to zero. The
// first robot is on that port of this machine, the next ones on the following ports. After so many
// seconds the program is told to end. The report is a line "exit CODE", "signal NUMBER" or
// "running", and a line "NAME PATH_M" for each robot.
#include <libplayerc++/playerc++.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

const char* const kHost = "player://127.0.0.1";

struct Robot {
  std::string name;
  double start[3];
  double x = 0.0;
  double y = 0.0;
  double path_m = 0.0;
};

Robot parse_start(const char* text) {
  Robot robot;
  std::istringstream in(text);
  char comma = 0;
  double degrees = 0.0;
  std::getline(in, robot.name, ',');
  in >> robot.start[0] >> comma >> robot.start[1] >> comma >> degrees;
  robot.start[2] = degrees * M_PI / 180.0;
  return robot;
}

/// Waits for the end of a process. @return its status as a text; empty if it has not ended in time.
std::string wait_for(pid_t child, Clock::time_point deadline, int* status) {
  while (Clock::now() < deadline) {
    if (waitpid(child, status, WNOHANG) == child) {
      return WIFSIGNALED(*status) ? "signal " + std::to_string(WTERMSIG(*status))
                                  : "exit " + std::to_string(WEXITSTATUS(*status));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return "";
}

}  // namespace

int main(int argc, char** argv) {
  int dashes = 4;
  while (dashes < argc && std::strcmp(argv[dashes], "--") != 0) ++dashes;
  if (dashes >= argc - 1) {
    std::cerr << "usage: watch_program PORT SECONDS REPORT NAME,X,Y,DEGREES... -- PROGRAM...\n";
    return 2;
  }
  std::vector<Robot> robots;
  for (int i = 4; i < dashes; ++i) robots.push_back(parse_start(argv[i]));
  try {
    const int port = std::atoi(argv[1]);
    PlayerCc::PlayerClient client(kHost, port);
    PlayerCc::SimulationProxy simulation(&client, 0);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      Robot& robot = robots[i];
      PlayerCc::PlayerClient own(kHost, port + static_cast<int>(i));
      PlayerCc::Position2dProxy motors(&own, 0);
      motors.SetSpeed(0.0, 0.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(i == 0 ? 1500 : 0));  // it slows down
      motors.SetOdometry(0.0, 0.0, 0.0);
      simulation.SetPose2d(&robot.name[0], robot.start[0], robot.start[1], robot.start[2]);
      double yaw = 0.0;
      simulation.GetPose2d(&robot.name[0], robot.x, robot.y, yaw);
    }
    const pid_t child = fork();
    if (child == 0) {
      execv(argv[dashes + 1], argv + dashes + 1);
      _exit(127);
    }
    const Clock::time_point deadline = Clock::now() + std::chrono::seconds(std::atoi(argv[2]));
    Clock::time_point last = Clock::now();
    int status = 0;
    std::string ended;
    while (ended.empty() && Clock::now() < deadline) {
      ended = wait_for(child, Clock::now() + std::chrono::milliseconds(100), &status);
      const Clock::time_point now = Clock::now();
      // Longer steps are not driven: the program puts robots elsewhere.
      const double longest_m = 0.1 + std::chrono::duration<double>(now - last).count();
      last = now;
      for (Robot& robot : robots) {
        double x = robot.x, y = robot.y, yaw = 0.0;
        simulation.GetPose2d(&robot.name[0], x, y, yaw);
        const double step = std::hypot(x - robot.x, y - robot.y);
        if (step < longest_m) robot.path_m += step;
        robot.x = x;
        robot.y = y;
      }
    }
    if (ended.empty()) {
      ended = "running";
      kill(child, SIGTERM);
      if (wait_for(child, Clock::now() + std::chrono::seconds(2), &status).empty()) {
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
      }
    }
    std::ofstream report(argv[3]);
    report << ended << '\n';
    for (const Robot& robot : robots) report << robot.name << ' ' << robot.path_m << '\n';
  } catch (const PlayerCc::PlayerError& error) {
    std::cerr << "watch_program: " << error << '\n';
    return 1;
  }
}
