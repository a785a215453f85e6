// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "imr-h/thread.h"

#include <cxxabi.h>

#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <typeinfo>
#include <utility>

#include "imr-h/imr_exceptions.h"
#define IMR_LOGGING_NO_SHORT_NAMES
#include "imr-h/logging.h"
#include "libplayerc++/playererror.h"
#include "type_name.h"
#include "virtual_time/virtual_time.h"

namespace imr::concurrent {

struct CThread::State {
  std::mutex mutex;
  std::condition_variable ended;  // Announces that running became false.
  bool running = false;
  bool finished = false;
  std::thread thread;
};

namespace {

// Logs the exception that is being handled, with its text if it has one.
void log_escaped_exception(const char* what) {
  const std::type_info* type = abi::__cxa_current_exception_type();
  const std::string name = type != nullptr ? detail::type_name(*type) : "an unknown type";
  const std::string detail_text = what != nullptr ? std::string(": ") + what : std::string();
  IMR_LOG_ERROR("thread ended by an exception of type " << name << detail_text);
}

// At the end of a run Read() throws this library's PlayerError, which is no fault.
void log_player_error(const PlayerCc::PlayerError& error) {
  const int code = error.GetErrorCode();
  if (code == PlayerCc::PlayerError::kRunIsOver || code == PlayerCc::PlayerError::kDisconnected) {
    IMR_LOG_INFO("thread ended: its client's session is over (" << error.GetErrorStr() << ")");
  } else {
    log_escaped_exception((error.GetErrorFun() + ": " + error.GetErrorStr()).c_str());
  }
}

}  // namespace

CThread::CThread() : state_(std::make_shared<State>()) {}

CThread::~CThread() {
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    if (state_->thread.get_id() == std::this_thread::get_id()) {
      state_->thread.detach();
      return;
    }
    if (state_->running) {
      IMR_LOG_WARN("CThread destroyed while its body runs; join() in the derived destructor");
    }
  }
  join();
}

void CThread::execute() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (state_->running) {
    throw exception("CThread::execute(): the thread is running already");
  }
  if (state_->thread.joinable()) {
    // The body of an earlier run has ended and needs the mutex no more.
    state_->thread.join();
  }
  state_->running = true;
  state_->finished = false;
  try {
    const playerlike::virtual_time::StartsForProgram scope;
    state_->thread = std::thread(&CThread::run, this, state_);
  } catch (const std::system_error& error) {
    state_->running = false;
    throw exception(std::string("CThread::execute(): can't start a thread: ") + error.what());
  }
}

void CThread::join() {
  // A copy, because exit() in the body may destroy this object while another thread waits here.
  const std::shared_ptr<State> state = state_;
  // The thread is moved out and joined without the mutex, so that two threads may call join() at
  // once.
  std::thread ended;
  {
    std::unique_lock<std::mutex> lock(state->mutex);
    if (state->thread.get_id() == std::this_thread::get_id()) {
      IMR_LOG_WARN("CThread::join() called by the thread itself does not wait");
      return;
    }
    state->ended.wait(lock, [&state] { return !state->running; });
    ended = std::move(state->thread);
  }
  if (ended.joinable()) {
    ended.join();
  }
}

bool CThread::isRunning() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->running;
}

bool CThread::isFinished() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->finished;
}

void CThread::yield() { std::this_thread::yield(); }

void CThread::run(CThread* self, std::shared_ptr<State> state) {
  // Announces the end on every way out, including cancellation of the thread.
  struct EndAnnouncer {
    State& state;
    ~EndAnnouncer() {
      const std::lock_guard<std::mutex> lock(state.mutex);
      state.running = false;
      state.finished = true;
      state.ended.notify_all();
    }
  };
  const EndAnnouncer announcer{*state};
  try {
    self->threadBody();
  } catch (const PlayerCc::PlayerError& error) {
    log_player_error(error);
  } catch (const std::exception& error) {
    log_escaped_exception(error.what());
  } catch (...) {
    if (std::current_exception() == nullptr) {
      // Not a C++ exception: pthread_exit() or pthread_cancel() unwinds the stack. The C library
      // requires that it is rethrown.
      throw;
    }
    log_escaped_exception(nullptr);
  }
}

}  // namespace imr::concurrent
