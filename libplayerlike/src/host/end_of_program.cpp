// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/end_of_program.h"

#include <signal.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "playerlike/messages/messages.h"

namespace playerlike {
namespace {

std::array<std::atomic<EndOfRunTest>, 4> tests{};
std::atomic<std::terminate_handler> previous{nullptr};

volatile sig_atomic_t interrupt_came = 0;

extern "C" void on_interrupt(int /*signal*/) { interrupt_came = 1; }

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

void note_interrupts() noexcept {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction present = {};
    if (sigaction(signal, nullptr, &present) != 0 || present.sa_handler != SIG_DFL) continue;
    struct sigaction action = {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

bool interrupted() noexcept { return interrupt_came != 0; }

void add_end_of_run_test(EndOfRunTest test) noexcept {
  for (auto& slot : tests) {
    EndOfRunTest present = nullptr;
    if (slot.load() == test || slot.compare_exchange_strong(present, test)) return;
  }
}

}  // namespace playerlike
