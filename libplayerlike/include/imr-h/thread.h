// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>

namespace imr {
namespace concurrent {

/// A plain, not recursive, mutual exclusion lock.
typedef std::mutex Mutex;

/// Holds a Mutex from its construction to the end of its scope: `ScopedLock lk(mtx);`. It may be
/// unlocked earlier, and a Condition can wait with it.
typedef std::unique_lock<std::mutex> ScopedLock;

/// Lets threads wait, under a ScopedLock, for something that another thread announces.
typedef std::condition_variable Condition;

/// Base class of an object that runs its threadBody() in a thread of its own.
///
/// A derived class implements threadBody() and, in its destructor, asks the body to end and calls
/// join(), before its members go away:
///
///   class CRobot : public imr::concurrent::CThread {
///    public:
///     ~CRobot() { stop(); join(); }
///    protected:
///     void threadBody() { ... }
///   };
///
/// Exceptions. The C++ runtime ends the whole process (std::terminate) when an exception leaves a
/// thread's function. Here an exception that leaves threadBody() ends that thread only: it is
/// logged as ERROR with its type and what(), and the process goes on; join() returns as usual.
/// One case is no fault: at the end of a simulated run Read() throws PlayerError (also called
/// MorseError), so an exception of a class of that name, in whatever namespace, is logged as INFO.
/// A thread that is cancelled, or that ends by pthread_exit(), ends as usual on the platform.
///
/// Threads: execute() and join() may be called from any thread, also at the same time. Objects
/// can't be copied or moved.
class CThread {
 public:
  typedef imr::concurrent::Mutex Mutex;            ///< For members of derived classes.
  typedef imr::concurrent::ScopedLock ScopedLock;  ///< For members of derived classes.
  typedef imr::concurrent::Condition Condition;    ///< For members of derived classes.

  CThread();

  /// Waits for the body to end, if it still runs, after a WARN line: the derived part, which the
  /// body uses, is destroyed by then, so this is a fault of the derived class. Destroyed by its
  /// own thread, as exit() in the body does to a static object, it waits for nothing.
  virtual ~CThread();

  CThread(const CThread&) = delete;
  CThread& operator=(const CThread&) = delete;

  /// Starts threadBody() in a new thread and returns at once. A thread whose body has ended may be
  /// executed again, whether it was joined or not. Not for use in a constructor: the derived
  /// object does not exist yet.
  ///
  /// @throws imr::exception if the body is running, or if the system can't start a thread.
  void execute();

  /// Waits until the body has ended; what it wrote is visible to the caller then. Returns at once
  /// if it was never executed or has been joined. Called by the body's own thread, which could
  /// wait forever, it logs a WARN line and returns.
  void join();

  /// Whether the body runs now.
  bool isRunning() const;
  /// Whether the body has run and ended since it was last executed.
  bool isFinished() const;
  /// Lets other threads run first.
  void yield();

 protected:
  /// What the thread does; it ends when this returns.
  virtual void threadBody() = 0;

 private:
  struct State;

  static void run(CThread* self, std::shared_ptr<State> state);

  // Shared with the running thread, which so may outlive an object that it destroys itself.
  std::shared_ptr<State> state_;
};

}  // namespace concurrent
}  // namespace imr
