// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/end_of_program.h"

#include <signal.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "playerlike/messages/messages.h"

namespace playerlike {
namespace {

std::array<std::atomic<EndOfRunTest>, 4> tests{};
std::atomic<std::terminate_handler> previous{nullptr};

constexpr std::int64_t kOneRequest_ns = 500'000'000;

// State of the signal handler.
constinit std::atomic<int> first_interrupt{0};
constinit std::atomic<std::int64_t> first_time_ns{0};
constinit std::atomic<std::atomic<std::uint32_t>*> place_to_note{nullptr};

/// CLOCK_MONOTONIC by a raw system call: the C library's clock may show simulated time.
std::int64_t machine_time_ns() noexcept {
  timespec time{};
  syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

void on_interrupt(int signal, siginfo_t* info, void* /*context*/) {
  const int error = errno;
  int none = 0;
  if (first_interrupt.compare_exchange_strong(none, signal)) {
    first_time_ns = machine_time_ns();
    if (std::atomic<std::uint32_t>* const place = place_to_note) {
      *place = static_cast<std::uint32_t>(signal);
    }
  } else {
    const bool forwarded = info->si_code == SI_QUEUE && info->si_value.sival_int == kForwarded;
    const bool repeated_sighup = signal == SIGHUP && first_interrupt == SIGHUP;
    const bool copy = machine_time_ns() - first_time_ns < kOneRequest_ns;
    if (!forwarded && !repeated_sighup && !copy) {
      ::signal(signal, SIG_DFL);
      raise(signal);  // delivered when this handler returns
    }
  }
  errno = error;
}

bool says_run_is_over(const std::exception_ptr& error) {
  if (!error) return false;
  try {
    std::rethrow_exception(error);
  } catch (const SessionError& e) {
    return e.code() == SessionError::Code::kFinished;
  } catch (...) {
  }
  for (const auto& slot : tests) {
    const EndOfRunTest test = slot.load();
    if (test != nullptr && test(error)) return true;
  }
  return false;
}

void on_terminate() {
  if (says_run_is_over(std::current_exception())) end_program_quietly();
  const std::terminate_handler handler = previous.load();
  if (handler != nullptr) handler();
  std::abort();
}

}  // namespace

void end_program_quietly() noexcept {
  std::cout.flush();
  std::cerr.flush();
  std::clog.flush();
  std::fflush(nullptr);
  std::_Exit(0);
}

void end_program_quietly_if_uncaught() noexcept {
  if (std::get_terminate() == on_terminate) return;
  previous = std::set_terminate(on_terminate);
}

void note_interrupts(std::atomic<std::uint32_t>* noted) noexcept {
  place_to_note = noted;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present = {};
    if (sigaction(signal, nullptr, &present) != 0) continue;
    if ((present.sa_flags & SA_SIGINFO) != 0 || present.sa_handler != SIG_DFL) continue;
    struct sigaction action = {};
    action.sa_sigaction = on_interrupt;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

int interrupted() noexcept { return first_interrupt; }

void add_end_of_run_test(EndOfRunTest test) noexcept {
  for (auto& slot : tests) {
    EndOfRunTest present = nullptr;
    if (slot.load() == test || slot.compare_exchange_strong(present, test)) return;
  }
}

}  // namespace playerlike
