// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A client program that drives in a circle, draws its position, and ends in the given way:
//   ends_program WHAT [READS]
// After this number of reads (default 50) it prints "ready" and then does WHAT.
#include <libplayerc++/playerc++.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

volatile std::sig_atomic_t own_signals = 0;
extern "C" void on_own_signal(int /*signal*/) { own_signals = own_signals + 1; }

void ready() { std::cout << "ready " << getpid() << std::endl; }

[[noreturn]] void compute() {
  for (volatile unsigned long i = 0;; i = i + 1) {
  }
}

void end_badly(const std::string& what) {
  if (what == "segv") raise(SIGSEGV);
  if (what == "null") {
    volatile int* nowhere = nullptr;
    *nowhere = 1;
  }
  if (what == "abort") std::abort();
  if (what == "throw") throw std::runtime_error("thrown by the program");
  if (what == "leave") _exit(3);
  if (what == "kill") raise(SIGKILL);
  if (what == "stop") raise(SIGSTOP);
  if (what == "compute") compute();
  if (what == "child") {  // a child that leaves the group, ignores signals, and continues
    if (fork() == 0) {
      setsid();
      if (fork() != 0) _exit(0);
      for (const int signal : {SIGTERM, SIGINT, SIGHUP}) std::signal(signal, SIG_IGN);
      for (;;) pause();
    }
    std::exit(0);
  }
  if (what == "killer") {  // a program that kills its parent
    kill(-getpgid(getppid()), SIGKILL);
    compute();
  }
  if (what == "flood") {
    const std::string line(1023, 'x');
    for (int i = 0; i < 12 * 1024; ++i) std::cout << line << '\n';
    std::cout.flush();
  }
  if (what == "fill") {  // its output folder is filled
    const char* const folder = std::getenv("PLAYPEN_OUT");
    std::ofstream file(std::string(folder == nullptr ? "." : folder) + "/big");
    const std::vector<char> bytes(1 << 20, 'x');
    for (int i = 0; i < 64; ++i) file.write(bytes.data(), 1 << 20);
    file.close();
    compute();
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "drive";
  const long reads = argc > 2 ? std::atol(argv[2]) : 50;
  if (what == "handler") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, on_own_signal);
  }
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::Position2dProxy position(&robot, 0);
  PlayerCc::LaserProxy laser(&robot, 0);
  PlayerCc::Graphics2dProxy graphics(&robot, 0);
  if (what == "start") {
    ready();
    for (;;) pause();
  }
  std::vector<player_point_2d_t> trail;
  for (long i = 0;; ++i) {
    robot.Read();
    position.SetSpeed(0.2, 0.5);
    player_point_2d_t here;
    here.px = position.GetXPos();
    here.py = position.GetYPos();
    trail.push_back(here);
    if (trail.size() == 2) {
      graphics.Color(255, 0, 0, 0);
      graphics.DrawPolyline(trail.data(), 2);
      trail.erase(trail.begin());
    }
    if (i == reads) {
      ready();
      end_badly(what);
    }
    if (own_signals > 0) {
      // Leaves time for a second signal.
      usleep(1'000'000);
      std::cout << "signals " << own_signals << std::endl;
      return 0;
    }
  }
}
