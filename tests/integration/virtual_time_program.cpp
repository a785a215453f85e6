// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Client programs written for real time, selected by name on the command line. Their output comes
// from the simulation and from the clocks, so it is the same in every run.
#include <libplayerc++/playerc++.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "libCCMorse/MorseTime.h"

namespace {

using namespace PlayerCc;
using std::chrono::milliseconds;

const double kStart_s = [] {  // before main(), as some programs have it
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}();

// Clock time since the program's start. Reads the clock at most twice.
double clock_s() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - kStart_s;
}

long real_time() {
  timespec now;
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
  return now.tv_sec;
}

void drive_by_sleeping() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  position.SetSpeed(0.1, 0.0);
  usleep(3000000);
  position.SetSpeed(0.0, 0.0);
  usleep(500000);
}

void sleep_in_all_ways() {
  PlayerClient robot("localhost", 6665);
  const CCMorse::MorseTime simulation(robot);
  const timespec half = {0, 500000000};
  const auto later = [](clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    ++time.tv_sec;
    return time;
  };
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
  sem_t semaphore;
  sem_init(&semaphore, 0, 0);
  const std::vector<std::pair<const char*, std::function<void()>>> ways = {
      {"sleep", [] { sleep(1); }},
      {"usleep", [] { usleep(500000); }},
      {"nanosleep", [&] { nanosleep(&half, nullptr); }},
      {"clock_nanosleep", [&] { clock_nanosleep(CLOCK_MONOTONIC, 0, &half, nullptr); }},
      {"clock_nanosleep until",
       [&] {
         const timespec time = later(CLOCK_REALTIME);
         clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &time, nullptr);
       }},
      {"select",
       [] {
         timeval timeout = {0, 500000};
         select(0, nullptr, nullptr, nullptr, &timeout);
       }},
      {"select of none",
       [] {
         fd_set none;
         FD_ZERO(&none);
         timeval timeout = {0, 500000};
         select(8, &none, nullptr, nullptr, &timeout);
       }},
      {"pselect", [&] { pselect(0, nullptr, nullptr, nullptr, &half, nullptr); }},
      {"poll", [] { poll(nullptr, 0, 500); }},
      {"ppoll", [&] { ppoll(nullptr, 0, &half, nullptr); }},
      {"sleep_for", [] { std::this_thread::sleep_for(milliseconds(500)); }},
      {"sleep_until",
       [] { std::this_thread::sleep_until(std::chrono::steady_clock::now() + milliseconds(500)); }},
      {"sleep_until of the day",
       [] { std::this_thread::sleep_until(std::chrono::system_clock::now() + milliseconds(500)); }},
      {"wait_for",
       [] {
         std::mutex own;
         std::condition_variable never;
         std::unique_lock<std::mutex> lock(own);
         never.wait_for(lock, milliseconds(500));
       }},
      {"pthread_cond_timedwait",
       [&] {
         const timespec time = later(CLOCK_REALTIME);
         pthread_mutex_lock(&mutex);
         pthread_cond_timedwait(&condition, &mutex, &time);
         pthread_mutex_unlock(&mutex);
       }},
      {"sem_timedwait",
       [&] {
         const timespec time = later(CLOCK_REALTIME);
         sem_timedwait(&semaphore, &time);
       }},
      {"select of a key",
       [] {
         fd_set keys;
         FD_ZERO(&keys);
         FD_SET(STDIN_FILENO, &keys);
         timeval timeout = {0, 500000};
         if (select(1, &keys, nullptr, nullptr, &timeout) != 0) std::printf("a key\n");
         if (FD_ISSET(STDIN_FILENO, &keys) || timeout.tv_usec != 0) std::printf("not empty\n");
       }},
      {"poll of a key",
       [] {
         pollfd key = {STDIN_FILENO, POLLIN, 0};
         if (poll(&key, 1, 500) != 0 || key.revents != 0) std::printf("a key\n");
       }},
      {"ppoll of a key",
       [&] {
         pollfd key = {STDIN_FILENO, POLLIN, 0};
         if (ppoll(&key, 1, &half, nullptr) != 0) std::printf("a key\n");
       }},
      {"epoll of nothing",
       [] {
         epoll_event event;
         const int none = epoll_create1(0);
         if (epoll_wait(none, &event, 1, 500) != 0) std::printf("an event\n");
         close(none);
       }},
      {"waiting for a signal",
       [&] {
         sigset_t set;
         sigemptyset(&set);
         sigaddset(&set, SIGUSR2);
         if (sigtimedwait(&set, nullptr, &half) >= 0) std::printf("a signal\n");
       }},
      {"nanosleep by syscall", [&] { syscall(SYS_nanosleep, &half, nullptr); }},
      {"small ones",
       [] {
         for (int i = 0; i < 100000; ++i) usleep(1);
         for (int i = 0; i < 100; ++i) usleep(1500);
       }},
      {"clock",
       [] {
         const std::clock_t end = std::clock() + CLOCKS_PER_SEC / 2;
         while (std::clock() < end) {
         }
       }},
  };
  for (const auto& way : ways) {
    const double before_s = simulation.Now();
    const double clock_before_s = clock_s();
    way.second();
    std::printf("%s: %.2f %.2f\n", way.first, simulation.Now() - before_s,
                clock_s() - clock_before_s);
  }
}

void read_and_sleep() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  LaserProxy laser(&robot, 0);
  for (int i = 0; i < 600; ++i) {
    robot.Read();
    position.SetSpeed(0.1, 0.3 * (laser.GetMinLeft() - laser.GetMinRight()));
    usleep(100000);
  }
}

void read_in_background() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  LaserProxy laser(&robot, 0);
  robot.StartThread();
  sleep(1);
  for (int i = 0; i < 200; ++i) {
    const double left = laser.GetMinLeft();
    position.SetSpeed(0.1, 0.3 * (left - laser.GetMinRight()));
    std::printf("%.9f %.9f\n", position.GetXPos(), left);
    usleep(70000);
  }
  robot.StopThread();
  std::printf("%.2f\n", clock_s());
}

// The same program with its own thread, and one thread that only counts.
void read_in_own_thread() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  robot.Read();
  bool stop = false;
  int count = 0;
  std::mutex mutex;
  const auto stopped = [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return stop;
  };
  std::thread reader([&] {
    while (!stopped()) robot.Read();
  });
  std::thread counter([&] {
    while (!stopped()) {
      std::this_thread::sleep_for(milliseconds(30));
      const std::lock_guard<std::mutex> lock(mutex);
      ++count;
    }
  });
  double last = position.GetXPos();
  int last_count = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    last_count = count;
  }
  position.SetSpeed(0.1, 0.0);
  for (int i = 0; i < 100; ++i) {
    usleep(50000);
    const double x = position.GetXPos();
    const std::lock_guard<std::mutex> lock(mutex);
    std::printf("%.9f %d\n", x - last, count - last_count);
    last = x;
    last_count = count;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    stop = true;
  }
  reader.join();
  counter.join();
}

// Threads that start before there is a simulation, each with its own client.
void have_threads_with_clients() {
  std::mutex mutex;
  const auto work = [&mutex](int number, unsigned pause_us) {
    PlayerClient robot("localhost", 6665);
    Position2dProxy position(&robot, 0);
    for (int i = 0; i < 40; ++i) {
      robot.Read();
      position.SetSpeed(0.1, number == 0 ? 0.2 : -0.1);
      {
        const std::lock_guard<std::mutex> lock(mutex);
        std::printf("%d %.9f\n", number, position.GetXPos());
      }
      usleep(pause_us);
    }
  };
  std::thread first(work, 0, 70000);
  std::thread second(work, 1, 50000);
  first.join();
  second.join();
}

void wait_for_the_clock() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  position.SetSpeed(0.1, 0.0);
  const time_t begin = time(nullptr);
  int asked = 0;
  while (time(nullptr) < begin + 3) {
    position.SetSpeed(0.1, 0.0);
    ++asked;
  }
  position.SetSpeed(0.0, 0.0);
  std::printf("asked %d times\n", asked);
}

// One clock read per iteration does not advance time.
void take_speeds_from_a_thread() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  std::atomic<bool> stop{false};
  std::atomic<int> count{0};
  std::thread counter([&] {
    while (!stop) {
      std::this_thread::sleep_for(milliseconds(1));
      ++count;
    }
  });
  for (int i = 0; i < 20; ++i) {
    robot.Read();
    position.SetSpeed(1e-3 * (count % 100), 0.0);
  }
  stop = true;
  counter.join();
}

void look_at_the_clock() {
  PlayerClient robot("localhost", 6665);
  LaserProxy laser(&robot, 0);
  for (int i = 0; i < 20; ++i) {
    robot.Read();
    timeval now;
    gettimeofday(&now, nullptr);
    std::printf("%.3f %.3f\n", laser.GetDataTime(),
                static_cast<double>(now.tv_sec % 1000) + 1e-6 * static_cast<double>(now.tv_usec));
  }
}

void drive_for_ever() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  std::printf("drives\n");
  while (true) {
    position.SetSpeed(0.01, 0.0);
    sleep(1);
  }
}

void drive_for_ever_in_background() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  robot.StartThread();
  while (true) {
    try {
      position.SetSpeed(0.01, 0.0);
      static_cast<void>(position.GetXPos());
    } catch (const PlayerError&) {
    }
    usleep(100000);
  }
}

void command_for_ever() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  while (true) {
    position.SetSpeed(position.GetXPos() < 1e6 ? 0.01 : 0.0, 0.0);
  }
}

void take_the_end_for_an_error() {
  PlayerClient robot("localhost", 6665);
  try {
    while (true) robot.Read();
  } catch (const PlayerError&) {
    std::exit(-1);
  }
}

void tidy_up_after_the_end() {
  PlayerClient robot("localhost", 6665);
  try {
    while (true) {
      robot.Read();
      usleep(1000);
    }
  } catch (const PlayerError& e) {
    std::printf("over: %d\n", e.GetErrorCode() == PlayerError::kRunIsOver);
  }
  sleep(2);
  std::printf("tidied up\n");
  std::exit(7);
}

void wait_in_background_for_a_place() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  robot.StartThread();
  while (!position.IsFresh()) {
  }
  const double start = position.GetXPos();
  position.SetSpeed(0.1, 0.0);
  while (position.GetXPos() < start + 0.2) {
  }
  std::printf("there\n");
}

void steer_by_hand() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  robot.StartThread();
  position.SetSpeed(0.1, 0.0);
  int keyboard[2];  // input that the simulation does not control
  if (pipe(keyboard) != 0) std::exit(8);
  pollfd key = {keyboard[0], POLLIN, 0};
  poll(&key, 1, 600);
  usleep(50000);
  std::printf("steered\n");
}

void join_threads() {
  PlayerClient main_client("localhost", 6665);
  main_client.Read();
  for (int round = 0; round < 3; ++round) {
    std::thread worker([] {
      PlayerClient robot("localhost", 6665);
      Position2dProxy position(&robot, 0);
      for (int i = 0; i < 20; ++i) {
        robot.Read();
        position.SetSpeed(0.1, 0.1);
        usleep(100000);
      }
    });
    worker.join();
    std::printf("%.2f\n", clock_s());
    usleep(20000);
  }
}

void wait_for_each_other() {
  PlayerClient robot("localhost", 6665);
  std::mutex mutex;
  std::condition_variable changed;
  int turn = 0;
  std::thread other([&] {
    usleep(200000);
    std::unique_lock<std::mutex> lock(mutex);
    turn = 1;
    changed.notify_all();
    const bool answered =
        changed.wait_for(lock, std::chrono::seconds(5), [&] { return turn == 2; });
    std::printf("answered %d\n", answered ? 1 : 0);
  });
  {
    std::unique_lock<std::mutex> lock(mutex);
    const bool came = changed.wait_for(lock, std::chrono::seconds(5), [&] { return turn == 1; });
    std::printf("came %d\n", came ? 1 : 0);
    turn = 2;
    changed.notify_all();
  }
  other.join();
  std::printf("%d\n", clock_s() < 1.0 ? 1 : 0);
}

// One thread reads; the other one steers, whenever it is notified of data.
void steer_when_told() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  LaserProxy laser(&robot, 0);
  std::mutex mutex;
  std::condition_variable changed;
  int rounds = 0;
  bool stop = false;
  robot.Read();
  std::thread reader([&] {
    while (true) {
      robot.Read();
      const std::lock_guard<std::mutex> lock(mutex);
      if (stop) return;
      ++rounds;
      changed.notify_one();
    }
  });
  for (int i = 1; i <= 200; ++i) {
    {
      std::unique_lock<std::mutex> lock(mutex);
      changed.wait(lock, [&] { return rounds >= i; });
    }
    position.SetSpeed(0.1, 0.3 * (laser.GetMinLeft() - laser.GetMinRight()));
    std::printf("%.9f\n", laser.GetDataTime());
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    stop = true;
  }
  reader.join();
}

void begin_before_the_client() {
  std::srand(static_cast<unsigned>(time(nullptr)));
  std::printf("%d\n", std::rand());
  const time_t begin = time(nullptr);
  usleep(20000);
  std::printf("%.2f\n", clock_s());
  PlayerClient robot("localhost", 6665);
  while (time(nullptr) < begin + 10) robot.Read();
  std::printf("%.2f\n", clock_s());
}

// The test sends a signal when it has read the first line.
void be_woken() {
  PlayerClient robot("localhost", 6665);
  struct sigaction action = {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;  // has no effect on sleeps
  sigaction(SIGUSR1, &action, nullptr);
  sigaction(SIGUSR2, &action, nullptr);
  std::printf("%d\n", static_cast<int>(getpid()));
  std::fflush(stdout);
  const unsigned left_s = sleep(100000000);
  signal(SIGUSR1, SIG_IGN);  // the test repeats it until one arrives during the sleep
  std::printf("alone %d\n", left_s > 0 && left_s <= 100000000);
  std::fflush(stdout);
  // The handle of another thread that sleeps while this one waits for its turn.
  const pthread_t sleeper = pthread_self();
  const auto wake = [&] {
    usleep(500000);
    pthread_kill(sleeper, SIGUSR2);
  };
  std::thread first(wake);
  timespec rest = {};
  const timespec day = {86400, 0};
  const int result = nanosleep(&day, &rest);
  std::printf("%d %d %.1f\n", result, errno == EINTR,
              static_cast<double>(rest.tv_sec) + 1e-9 * static_cast<double>(rest.tv_nsec));
  first.join();
}

void set_an_alarm() {
  PlayerClient robot("localhost", 6665);
  alarm(1000);
  alarm(1000);
  robot.Read();
}

void compute_for_long() {
  PlayerClient robot("localhost", 6665);
  robot.Read();
  std::thread other([] {
    PlayerClient second("localhost", 6665);
    second.Read();
  });
  const long end = real_time() + 2;
  while (real_time() < end) {
  }
  other.join();
}

// A child process without a client lives in real time.
void have_a_child() {
  PlayerClient robot("localhost", 6665);
  robot.Read();
  const pid_t child = fork();
  if (child == 0) {
    usleep(1000);
    _exit(std::labs(static_cast<long>(time(nullptr)) - real_time()) <= 1 ? 5 : 1);
  }
  int state = 0;
  waitpid(child, &state, 0);
  std::printf("child %d, own %d\n", WEXITSTATUS(state),
              std::labs(static_cast<long>(time(nullptr)) - real_time()) <= 1 ? 1 : 0);
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, void (*)()> programs = {
      {"drive_by_sleeping", drive_by_sleeping},
      {"sleep_in_all_ways", sleep_in_all_ways},
      {"read_and_sleep", read_and_sleep},
      {"read_in_background", read_in_background},
      {"read_in_own_thread", read_in_own_thread},
      {"have_threads_with_clients", have_threads_with_clients},
      {"wait_for_the_clock", wait_for_the_clock},
      {"look_at_the_clock", look_at_the_clock},
      {"take_speeds_from_a_thread", take_speeds_from_a_thread},
      {"drive_for_ever", drive_for_ever},
      {"drive_for_ever_in_background", drive_for_ever_in_background},
      {"command_for_ever", command_for_ever},
      {"take_the_end_for_an_error", take_the_end_for_an_error},
      {"tidy_up_after_the_end", tidy_up_after_the_end},
      {"wait_in_background_for_a_place", wait_in_background_for_a_place},
      {"steer_by_hand", steer_by_hand},
      {"join_threads", join_threads},
      {"wait_for_each_other", wait_for_each_other},
      {"steer_when_told", steer_when_told},
      {"begin_before_the_client", begin_before_the_client},
      {"have_a_child", have_a_child},
      {"be_woken", be_woken},
      {"set_an_alarm", set_an_alarm},
      {"compute_for_long", compute_for_long},
  };
  const auto program = programs.find(argc > 1 ? argv[1] : "");
  if (program == programs.end()) return 9;
  program->second();
  return 0;
}
