// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Client programs with threads, selected by name on the command line, for a world with two robots.
// Each prints what its threads see and when, so that any difference between two runs shows.
#include <fcntl.h>
#include <imr-h/thread.h>
#include <libplayerc++/playerc++.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <barrier>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <future>
#include <latch>
#include <map>
#include <mutex>
#include <semaphore>
#include <shared_mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace PlayerCc;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const Clock::time_point kStart = Clock::now();

// Prints a result and its time. (The evaluation order of a call's arguments is not fixed.)
void note(const char* what, long result);

double now_s() { return std::chrono::duration<double>(Clock::now() - kStart).count(); }

void note(const char* what, long result) {
  std::printf("%s: %ld at %.4f\n", what, result, now_s());
}

void drive(uint32_t port, double turn, int rounds) {
  PlayerClient robot("localhost", port);
  Position2dProxy position(&robot, 0);
  LaserProxy laser(&robot, 0);
  for (int i = 0; i < rounds; ++i) {
    robot.Read();
    position.SetSpeed(0.1, turn * (laser.GetMinLeft() - laser.GetMinRight()));
    std::printf("%u %.9f %.3f\n", port, position.GetXPos(), laser.GetDataTime());
  }
}

// --- Clients in several threads

void have_a_client_in_main_and_one_in_a_thread() {
  std::thread other(drive, 6666, 0.3, 40);
  drive(6665, 0.2, 30);
  other.join();
}

void have_a_client_in_a_thread_only() {
  std::thread other(drive, 6666, 0.3, 40);
  other.join();
}

void have_a_late_second_client() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  for (int i = 0; i < 5; ++i) robot.Read();
  std::thread other(drive, 6666, 0.3, 20);
  for (int i = 0; i < 20; ++i) {
    robot.Read();
    position.SetSpeed(0.1, 0.1);
    std::printf("main %.9f\n", position.GetXPos());
  }
  other.join();
}

void have_clients_in_detached_threads() {
  std::atomic<int> left{2};
  for (const uint32_t port : {6665U, 6666U}) {
    std::thread([port, &left] {
      drive(port, 0.2, 25);
      --left;
    }).detach();
  }
  while (left > 0) usleep(30000);
  std::printf("%.3f\n", now_s());
}

// Computes for a while before it creates its client, longer each time than the other thread needs.
void have_a_slow_second_client() {
  std::thread other([] {
    volatile double sum = 0.0;
    for (int i = 0; i < 3000000; ++i) sum = sum + 1.0 / (1.0 + i);
    drive(6666, 0.3, 10);
  });
  drive(6665, 0.2, 10);
  other.join();
}

struct StartedEarly {
  std::thread thread{drive, 6666, 0.2, 15};
};

void have_a_thread_from_before_main() {
  static StartedEarly early;  // like an object at namespace scope, but only in this program
  drive(6665, 0.2, 15);
  early.thread.join();
}

// Sleeps and waits of several threads that begin before there is a simulation and end during it.
void begin_before_the_clients() {
  std::mutex mutex;
  std::condition_variable changed;
  bool ready = false;
  std::vector<std::thread> threads;
  for (const uint32_t port : {6665U, 6666U}) {
    threads.emplace_back([&, port] {
      usleep(port == 6665 ? 30000 : 20000);
      {
        std::unique_lock<std::mutex> lock(mutex);
        const bool came = changed.wait_for(lock, 25ms, [&] { return ready; });
        std::printf("%u came %d at %.4f\n", port, came ? 1 : 0, now_s());
        ready = true;
        changed.notify_all();
      }
      drive(port, 0.2, 10);
    });
  }
  usleep(10000);
  for (std::thread& thread : threads) thread.join();
  std::printf("%.4f\n", now_s());
}

// The first thread initialises, and takes its time.
void initialise_once() {
  PlayerClient robot("localhost", 6665);
  static std::once_flag once;
  const auto shared = [](char name) -> const std::string& {
    static const std::string value = [&] {
      usleep(30000);
      return std::string("made by ") + name;
    }();
    return value;
  };
  std::mutex mutex;
  std::string seen;
  const auto work = [&](char name) {
    const std::string& value = shared(name);
    const std::lock_guard<std::mutex> lock(mutex);
    seen += name + (": " + value) + '\n';
  };
  std::thread first(work, 'a');
  std::thread second(work, 'b');
  work('m');
  first.join();
  second.join();
  std::printf("%s%.4f\n", seen.c_str(), now_s());
}

class Worker : public imr::concurrent::CThread {
 public:
  Worker(uint32_t port, std::atomic<int>& left) : port_(port), left_(left) {}
  ~Worker() override { join(); }

 protected:
  void threadBody() override {
    drive(port_, 0.2, 10);
    --left_;
  }

 private:
  uint32_t port_;
  std::atomic<int>& left_;
};

// --- Threads that wait for one another

void have_threads_of_imr() {
  std::atomic<int> left{2};
  Worker first(6665, left);
  Worker second(6666, left);
  first.execute();
  second.execute();
  while (left > 0) usleep(25000);
  second.join();
  first.join();
  std::printf("%.4f\n", now_s());
}

void consume_with_a_limit() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<int> queue;
  bool done = false;
  std::thread producer([&] {
    for (int i = 0; i < 60; ++i) {
      usleep(static_cast<useconds_t>(3000 + 700 * (i % 7)));
      const std::lock_guard<std::mutex> lock(mutex);
      queue.push_back(i);
      changed.notify_one();
    }
    const std::lock_guard<std::mutex> lock(mutex);
    done = true;
    changed.notify_all();
  });
  int timeouts = 0;
  while (true) {
    std::unique_lock<std::mutex> lock(mutex);
    if (!changed.wait_for(lock, 2ms, [&] { return !queue.empty() || done; })) {
      ++timeouts;
      continue;
    }
    if (queue.empty()) break;
    const int item = queue.front();
    queue.pop_front();
    lock.unlock();
    position.SetSpeed(0.01 * item, 0.0);
    std::printf("%d after %d at %.4f\n", item, timeouts, now_s());
  }
  producer.join();
  robot.Read();
  std::printf("%.9f %.4f\n", position.GetXPos(), now_s());
}

void hold_a_mutex_while_sleeping() {
  PlayerClient robot("localhost", 6665);
  std::mutex mutex;
  std::string order;
  const auto work = [&](char name, int pause_us) {
    for (int i = 0; i < 15; ++i) {
      const std::lock_guard<std::mutex> lock(mutex);
      order += name;
      usleep(static_cast<useconds_t>(pause_us));
    }
  };
  std::thread first(work, 'a', 20000);
  std::thread second(work, 'b', 30000);
  work('m', 10000);
  first.join();
  second.join();
  std::printf("%s %.3f\n", order.c_str(), now_s());
}

// Workers that wait for jobs without a deadline.
void have_a_pool() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<int> jobs;
  std::vector<std::string> done;
  bool stop = false;
  std::vector<std::thread> pool;
  for (int worker = 0; worker < 4; ++worker) {
    pool.emplace_back([&, worker] {
      while (true) {
        std::unique_lock<std::mutex> lock(mutex);
        changed.wait(lock, [&] { return stop || !jobs.empty(); });
        if (jobs.empty()) return;
        const int job = jobs.front();
        jobs.pop_front();
        lock.unlock();
        volatile double sum = 0.0;
        for (int i = 0; i < 1000 * (job % 5); ++i) sum = sum + i;
        if (job % 3 == 0) usleep(15000);
        lock.lock();
        done.push_back(std::to_string(job) + " by " + std::to_string(worker));
      }
    });
  }
  for (int i = 0; i < 40; ++i) {
    robot.Read();
    position.SetSpeed(0.05, 0.0);
    const std::lock_guard<std::mutex> lock(mutex);
    jobs.push_back(2 * i);
    jobs.push_back(2 * i + 1);
    changed.notify_all();
  }
  usleep(100000);
  {
    const std::lock_guard<std::mutex> lock(mutex);
    stop = true;
  }
  changed.notify_all();
  for (std::thread& worker : pool) worker.join();
  for (const std::string& line : done) std::printf("%s\n", line.c_str());
}

void use_semaphores() {
  PlayerClient robot("localhost", 6665);
  sem_t items;
  sem_init(&items, 0, 0);
  std::counting_semaphore<8> slots(2);
  std::thread producer([&] {
    for (int i = 0; i < 20; ++i) {
      slots.acquire();
      usleep(7000);
      sem_post(&items);
    }
  });
  for (int i = 0; i < 20; ++i) {
    timespec until;
    int missed = 0;
    do {
      clock_gettime(CLOCK_REALTIME, &until);
      until.tv_nsec += 5000000;
      if (until.tv_nsec >= 1000000000) ++until.tv_sec, until.tv_nsec -= 1000000000;
    } while (sem_timedwait(&items, &until) != 0 && ++missed < 1000);
    std::printf("%d missed %d at %.4f\n", i, missed, now_s());
    slots.release();
  }
  producer.join();
  for (int i = 0; i < 3; ++i) {
    const bool acquired = slots.try_acquire_for(50ms);
    note("acquired", acquired ? 1 : 0);
  }
}

void use_futures() {
  PlayerClient robot("localhost", 6665);
  const auto timed_out = [](std::future_status status) {
    note("timed out", status == std::future_status::timeout ? 1 : 0);
  };
  std::promise<int> promise;
  std::future<int> future = promise.get_future();
  timed_out(future.wait_for(300ms));
  timed_out(future.wait_until(std::chrono::system_clock::now() + 1s));
  std::thread setter([&] {
    usleep(250000);
    promise.set_value(7);
  });
  int polls = 0;
  while (future.wait_for(20ms) != std::future_status::ready) ++polls;
  note("polls", polls);
  note("value", future.get());
  setter.join();
  auto task = std::async(std::launch::async, [] {
    usleep(400000);
    return 3;
  });
  timed_out(task.wait_for(100ms));
  const int value = task.get();
  note("value", value);
}

void use_barriers_and_latches() {
  PlayerClient robot("localhost", 6665);
  std::barrier<> together(3);
  std::latch all(3);
  pthread_barrier_t old;
  pthread_barrier_init(&old, nullptr, 3);
  std::mutex mutex;
  std::string order;
  const auto work = [&](char name, int pause_us) {
    for (int i = 0; i < 8; ++i) {
      usleep(static_cast<useconds_t>(pause_us));
      together.arrive_and_wait();
      {
        const std::lock_guard<std::mutex> lock(mutex);
        order += name;
      }
      if (pthread_barrier_wait(&old) == PTHREAD_BARRIER_SERIAL_THREAD) order += '!';
    }
    all.arrive_and_wait();
  };
  std::thread first(work, 'a', 11000);
  std::thread second(work, 'b', 23000);
  work('m', 17000);
  first.join();
  second.join();
  std::printf("%s %.3f\n", order.c_str(), now_s());
}

void wait_for_an_atomic() {
  PlayerClient robot("localhost", 6665);
  std::atomic<int> value{0};
  std::thread other([&] {
    for (int i = 1; i <= 10; ++i) {
      usleep(12000);
      value = i;
      value.notify_all();
    }
  });
  int seen = 0;
  while (seen < 10) {
    value.wait(seen);
    seen = value;
    std::printf("%d %.4f\n", seen, now_s());
  }
  other.join();
  std::atomic<bool> flag{false};
  std::thread late([&] {
    usleep(30000);
    flag = true;
  });
  while (!flag) std::this_thread::yield();
  std::printf("%.4f\n", now_s());
  late.join();
}

void read_and_write_locked() {
  PlayerClient robot("localhost", 6665);
  std::shared_timed_mutex lock;
  std::mutex mutex;
  std::string order;
  const auto append = [&](char what) {
    const std::lock_guard<std::mutex> guard(mutex);
    order += what;
  };
  std::thread writer([&] {
    for (int i = 0; i < 10; ++i) {
      {
        const std::lock_guard<std::shared_timed_mutex> guard(lock);
        append('w');
        usleep(20000);
      }
      usleep(5000);
    }
  });
  const auto read = [&](char name) {
    for (int i = 0; i < 20; ++i) {
      if (lock.try_lock_shared_for(15ms)) {
        append(name);
        usleep(3000);
        lock.unlock_shared();
      } else {
        append('-');
      }
      usleep(4000);
    }
  };
  std::thread first(read, 'a');
  read('m');
  first.join();
  writer.join();
  std::printf("%s %.3f\n", order.c_str(), now_s());
}

void join_with_a_limit() {
  PlayerClient robot("localhost", 6665);
  pthread_t thread;
  pthread_create(
      &thread, nullptr,
      [](void*) -> void* {
        usleep(500000);
        return nullptr;
      },
      nullptr);
  timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += 200000000;
  int error = pthread_timedjoin_np(thread, nullptr, &until);
  note("timed out", error == ETIMEDOUT ? 1 : 0);
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_sec += 2;
  error = pthread_clockjoin_np(thread, nullptr, CLOCK_MONOTONIC, &until);
  note("joined", error);
}

void use_a_message_queue() {
  PlayerClient robot("localhost", 6665);
  const std::string name = "/playpen_test_" + std::to_string(getpid());
  mq_attr settings{};
  settings.mq_maxmsg = 1;
  settings.mq_msgsize = 8;
  const mqd_t queue = mq_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600, &settings);
  if (queue < 0) {
    std::printf("no queues here\n");
    return;
  }
  mq_unlink(name.c_str());
  const auto in = [](long ms) {
    timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += ms * 1000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    return until;
  };
  char text[8];
  timespec until = in(300);
  long result = mq_timedreceive(queue, text, 8, nullptr, &until);
  note("timed out", result < 0 && errno == ETIMEDOUT ? 1 : 0);
  mq_send(queue, "1", 1, 0);
  until = in(200);
  result = mq_timedsend(queue, "2", 1, 0, &until);
  note("timed out", result < 0 && errno == ETIMEDOUT ? 1 : 0);
  std::thread taker([&] {
    usleep(100000);
    mq_receive(queue, text, 8, nullptr);
  });
  until = in(700);
  result = mq_timedsend(queue, "2", 1, 0, &until);
  note("sent", result);
  taker.join();
  mq_close(queue);
}

void cancel_a_thread() {
  PlayerClient robot("localhost", 6665);
  for (int way = 0; way < 2; ++way) {
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    static pthread_cond_t never = PTHREAD_COND_INITIALIZER;
    pthread_t thread;
    pthread_create(
        &thread, nullptr,
        [](void* by_condition) -> void* {
          if (by_condition == nullptr) {
            while (true) usleep(1000000);
          }
          pthread_mutex_lock(&mutex);
          pthread_cleanup_push([](void*) { pthread_mutex_unlock(&mutex); }, nullptr);
          while (true) pthread_cond_wait(&never, &mutex);
          pthread_cleanup_pop(0);
          return nullptr;
        },
        way == 0 ? nullptr : &thread);
    usleep(50000);
    pthread_cancel(thread);
    void* result = nullptr;
    pthread_join(thread, &result);
    std::printf("%d %d %.3f\n", way, result == PTHREAD_CANCELED, now_s());
  }
}

// Its threads continue while it returns from main().
void end_with_threads() {
  for (const uint32_t port : {6665U, 6666U}) std::thread(drive, port, 0.2, 1000).detach();
  usleep(50000);
  PlayerClient robot("localhost", 6665);
  for (int i = 0; i < 10; ++i) robot.Read();
  std::printf("%.3f\n", now_s());
}

// The run ends before its threads do.
void be_ended_with_threads() {
  std::vector<std::thread> threads;
  for (const uint32_t port : {6665U, 6666U}) {
    threads.emplace_back([port] {
      try {
        drive(port, 0.2, 1000000);
      } catch (const PlayerError& e) {
        std::printf("%u: over %d\n", port, e.GetErrorCode() == PlayerError::kRunIsOver);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::printf("joined\n");
}

void read_in_background_beside_a_thread() {
  PlayerClient robot("localhost", 6665);
  Position2dProxy position(&robot, 0);
  LaserProxy laser(&robot, 0);
  robot.StartThread();
  std::thread other(drive, 6666, 0.3, 30);
  for (int i = 0; i < 60; ++i) {
    usleep(25000);
    position.SetSpeed(0.1, 0.2 * (laser.GetMinLeft() - laser.GetMinRight()));
    std::printf("main %.9f %.9f\n", position.GetXPos(), laser.GetMinLeft());
  }
  other.join();
  robot.StopThread();
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, void (*)()> programs = {
#define PROGRAM(name) {#name, name}
      PROGRAM(have_a_client_in_main_and_one_in_a_thread),
      PROGRAM(have_a_client_in_a_thread_only),
      PROGRAM(have_a_late_second_client),
      PROGRAM(have_clients_in_detached_threads),
      PROGRAM(have_a_slow_second_client),
      PROGRAM(have_a_thread_from_before_main),
      PROGRAM(begin_before_the_clients),
      PROGRAM(initialise_once),
      PROGRAM(have_threads_of_imr),
      PROGRAM(consume_with_a_limit),
      PROGRAM(hold_a_mutex_while_sleeping),
      PROGRAM(have_a_pool),
      PROGRAM(use_semaphores),
      PROGRAM(use_futures),
      PROGRAM(use_barriers_and_latches),
      PROGRAM(wait_for_an_atomic),
      PROGRAM(read_and_write_locked),
      PROGRAM(join_with_a_limit),
      PROGRAM(use_a_message_queue),
      PROGRAM(cancel_a_thread),
      PROGRAM(end_with_threads),
      PROGRAM(be_ended_with_threads),
      PROGRAM(read_in_background_beside_a_thread),
#undef PROGRAM
  };
  if (argc < 2) {
    for (const auto& program : programs) std::printf("%s\n", program.first.c_str());
    return 0;
  }
  const auto program = programs.find(argv[1]);
  if (program == programs.end()) return 9;
  program->second();
  return 0;
}
