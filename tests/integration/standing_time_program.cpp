// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Client programs, selected by name on the command line. Some do not advance simulated time, others
// only seem not to.
#include <libplayerc++/playerc++.h>
#include <libplayerc/playerc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>

namespace {

using namespace PlayerCc;

struct Robot {
  PlayerClient client{"localhost", 6665};
  Position2dProxy position{&client, 0};
};

void compute(double cpu_s) {
  const auto used_s = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  };
  const double end_s = used_s() + cpu_s;
  while (used_s() < end_s) {
  }
}

// --- Programs that do not advance time

int command_once() {
  Robot robot;
  robot.position.SetSpeed(0.2, 0.0);
  return 0;
}

int command_for_ever() {
  Robot robot;
  while (true) robot.position.SetSpeed(0.2, 0.0);
}

int look_for_ever() {
  Robot robot;
  while (!robot.position.IsFresh()) {
  }
  return 0;
}

int read_once() {
  Robot robot;
  robot.client.Read();
  while (true) robot.position.GetXPos();
}

int command_and_sleep() {
  Robot robot;
  for (int i = 0; i < 25; ++i) {
    robot.position.SetSpeed(0.2, 0.0);
    usleep(1000);
  }
  return 0;
}

int command_and_compute() {
  Robot robot;
  for (int i = 0; i < 2000; ++i) robot.position.SetSpeed(0.2, 0.0);
  compute(0.5);
  return 0;
}

/// Whether a thread of this process sleeps, according to its state in proc(5).
bool sleeps(pid_t thread) {
  std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t end_of_name = text.rfind(") ");
  return end_of_name != std::string::npos && text.compare(end_of_name + 2, 1, "S") == 0;
}

int command_in_a_thread() {
  Robot robot;
  std::atomic<bool> joins{false};
  std::thread commands([&] {
    // Wait until main() is inside join(); before that it might be about to read. It may sleep for
    // a moment elsewhere, too.
    while (!joins || !sleeps(getpid())) std::this_thread::yield();
    for (int i = 0; i < 100000; ++i) robot.position.SetSpeed(0.2, 0.0);
  });
  joins = true;
  commands.join();
  return 0;
}

int compute_for_ever() {  // very long, compared with its test
  Robot robot;
  robot.position.SetSpeed(0.2, 0.0);
  compute(0.5);
  return 0;
}

int give_up() {
  const Robot robot;
  return 3;
}

// --- Programs in C

playerc_position2d_t* drive(playerc_client_t* client) {
  playerc_client_connect(client);
  playerc_position2d_t* position = playerc_position2d_create(client, 0);
  playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE);
  return position;
}

int c_command_once() {
  playerc_position2d_t* position = drive(playerc_client_create(nullptr, "localhost", 6665));
  return playerc_position2d_set_cmd_vel(position, 0.2, 0.0, 0.0, 1);
}

int c_command_for_ever() {
  playerc_position2d_t* position = drive(playerc_client_create(nullptr, "localhost", 6665));
  while (true) playerc_position2d_set_cmd_vel(position, 0.2, 0.0, 0.0, 1);
}

int c_no_such_device() {
  playerc_client_t* client = playerc_client_create(nullptr, "localhost", 6665);
  if (playerc_client_connect(client) != 0) return -1;
  playerc_laser_t* laser = playerc_laser_create(client, 7);
  for (int i = 0; i < 3; ++i) {
    if (playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE) == 0) return 0;
  }
  return -1;
}

int c_no_such_port() {
  return playerc_client_connect(playerc_client_create(nullptr, "localhost", 7000));
}

// Asks which devices exist, and does without them.
int c_asks() {
  playerc_client_t* client = playerc_client_create(nullptr, "localhost", 6665);
  playerc_position2d_t* position = drive(client);
  char name[] = "colour";
  bool found = false;
  if (playerc_device_get_boolprop(&position->info, name, reinterpret_cast<BOOL*>(&found)) == 0 ||
      playerc_device_hascapability(&position->info, 99, 99) != 0) {
    return 1;
  }
  while (playerc_client_read(client) != nullptr) {
  }
  return 0;
}

// --- Correct programs

int peek() {
  Robot robot;
  while (robot.position.GetXPos() < 0.55) {
    robot.client.ReadIfWaiting();
    robot.position.SetSpeed(0.2, 0.0);
  }
  return 0;
}

int command_each_beam() {
  Robot robot;
  for (int i = 0; i < 500; ++i) robot.position.SetSpeed(0.1, 0.0);
  for (int round = 0; round < 3; ++round) {
    robot.client.Read();
    for (int i = 0; i < 5000; ++i) robot.position.SetSpeed(0.1, 0.0);
    for (int i = 0; i < 500000; ++i) robot.position.GetXPos();
  }
  return 0;
}

int background() {
  Robot robot;
  robot.client.StartThread();
  while (robot.position.GetXPos() < 0.55) {
    robot.position.SetSpeed(0.2, 0.0);
    usleep(10000);
  }
  robot.client.StopThread();
  return 0;
}

int sleep_only() {
  Robot robot;
  for (int i = 0; i < 100; ++i) {
    robot.position.SetSpeed(0.2, 0.0);
    usleep(20000);
  }
  return 0;
}

// The thread that reads is slow, but awake.
int read_in_a_thread() {
  Robot robot;
  std::atomic<bool> started{false};
  std::thread reader([&] {
    started = true;
    compute(0.2);
    robot.client.Read();
  });
  while (!started) std::this_thread::yield();
  while (!robot.position.IsFresh()) robot.position.SetSpeed(0.2, 0.0);
  reader.join();
  return 0;
}

int look_at_the_map() {
  PlayerClient client("localhost", 6665);
  MapProxy map(&client, 0);
  map.RequestMap();
  int walls = 0;
  for (int turn = 0; turn < 100; ++turn) {
    for (unsigned i = 0; i < map.GetWidth() * map.GetHeight(); ++i) {
      walls += map.GetCell(static_cast<int>(i % map.GetWidth()),
                           static_cast<int>(i / map.GetWidth())) > 0;
    }
  }
  std::printf("%d\n", walls);
  return 0;
}

}  // namespace

int main(int /*argc*/, char** argv) {
  const std::map<std::string, std::function<int()>> programs = {
      {"command_once", command_once},
      {"command_for_ever", command_for_ever},
      {"look_for_ever", look_for_ever},
      {"read_once", read_once},
      {"command_and_sleep", command_and_sleep},
      {"command_and_compute", command_and_compute},
      {"command_in_a_thread", command_in_a_thread},
      {"compute_for_ever", compute_for_ever},
      {"give_up", give_up},
      {"c_command_once", c_command_once},
      {"c_command_for_ever", c_command_for_ever},
      {"c_no_such_device", c_no_such_device},
      {"c_no_such_port", c_no_such_port},
      {"c_asks", c_asks},
      {"peek", peek},
      {"command_each_beam", command_each_beam},
      {"background", background},
      {"sleep_only", sleep_only},
      {"read_in_a_thread", read_in_a_thread},
      {"look_at_the_map", look_at_the_map},
  };
  return programs.at(argv[1])();
}
