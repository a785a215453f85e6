// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdlib>
#include <memory>
#include <mutex>

namespace imr {
namespace concurrent {

/// A non-recursive mutex.
typedef std::mutex Mutex;

/// Locks a Mutex from its construction to the end of its scope: `ScopedLock lk(mtx);`. It can be
/// unlocked earlier, and a Condition can wait with it.
typedef std::unique_lock<std::mutex> ScopedLock;

/// A condition variable. A thread that holds a ScopedLock waits on it until another thread notifies
/// it.
typedef std::condition_variable Condition;

/// Base class of objects that run their threadBody() in a separate thread.
///
/// A derived class implements threadBody(). Its destructor must ask the body to end and then call
/// join(), before its members are destroyed:
///
///   class CRobot : public imr::concurrent::CThread {
///    public:
///     ~CRobot() { stop(); join(); }
///    protected:
///     void threadBody() { ... }
///   };
///
/// Exceptions. The C++ runtime terminates the whole process (std::terminate) when an exception
/// leaves a thread's function. Here an exception that leaves threadBody() ends only that thread: it
/// is logged as ERROR with its type and what(), the process continues, and join() returns normally.
/// PlayerError (also named MorseError) with code kRunIsOver or kDisconnected is logged as INFO,
/// because Read() throws it at the regular end of a run. Thread cancellation and pthread_exit()
/// work as usual on the platform.
///
/// Threads: execute() and join() may be called from any thread, even concurrently. Objects cannot
/// be copied or moved.
class CThread {
 public:
  typedef imr::concurrent::Mutex Mutex;            ///< Short name for derived classes.
  typedef imr::concurrent::ScopedLock ScopedLock;  ///< Short name for derived classes.
  typedef imr::concurrent::Condition Condition;    ///< Short name for derived classes.

  CThread();

  /// Waits for the body if it is still running, after logging a WARN line. A running body is an
  /// error of the derived class: the derived part, which the body uses, is already destroyed. If
  /// the object's own thread destroys it (exit() in the body does so for a static object), the
  /// destructor does not wait.
  virtual ~CThread();

  CThread(const CThread&) = delete;
  CThread& operator=(const CThread&) = delete;

  /// Starts threadBody() in a new thread and returns immediately. Once the body has ended, it may
  /// be executed again, whether or not it was joined. Do not call it in a constructor: the derived
  /// object does not exist yet.
  ///
  /// @throws imr::exception if the body is running, or if the system cannot start a thread.
  void execute();

  /// Waits until the body has ended. Everything that the body wrote is then visible to the caller.
  /// Returns immediately if the body was never executed or has been joined. If the body's own
  /// thread calls it, it logs a WARN line and returns, because waiting would be a deadlock.
  void join();

  /// Returns whether the body is running.
  bool isRunning() const;
  /// Returns whether the body has ended since the last execute().
  bool isFinished() const;
  /// Yields the processor to other threads.
  void yield();

 protected:
  /// The code of the thread. The thread ends when this function returns.
  virtual void threadBody() = 0;

 private:
  struct State;

  static void run(CThread* self, std::shared_ptr<State> state);

  // Shared with the running thread, so that the thread can outlive an object that it destroys
  // itself.
  std::shared_ptr<State> state_;
};

}  // namespace concurrent
}  // namespace imr
