// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "libplayerc++/mutex.h"
#include "libplayerc++/readsignal.h"

namespace PlayerCc {

/// Names of Boost that programs use without including Boost, since Player's headers brought them:
/// boost::bind, ref, cref, function, shared_ptr, mutex, thread, and signals::connection. Here they
/// are the standard library's and our own.
///
/// A program that includes a Boost header itself gets Boost's names of that header and these for
/// the rest: what namespace boost declares itself is found before what it only uses. Its
/// boost::mutex::scoped_lock can lock PlayerClient::mMutex, too.
namespace boost_names {

using std::bind;
using std::cref;
using std::function;
using std::ref;
using std::shared_ptr;

/// The type of PlayerClient::mMutex.
typedef PlayerCc::mutex_t mutex;

/// A thread that goes on by itself when this object is destroyed before it has ended, as Boost's
/// does.
class thread : public std::thread {
 public:
  thread() = default;
  /// Starts a thread that calls a function with arguments.
  template <typename F, typename... Args>
  explicit thread(F aFunction, Args... aArgs)
      : std::thread(std::move(aFunction), std::move(aArgs)...) {}
  thread(thread&&) noexcept = default;
  thread& operator=(thread&& aOther) noexcept {
    if (joinable()) detach();
    std::thread::operator=(std::move(aOther));
    return *this;
  }
  ~thread() {
    if (joinable()) detach();
  }
};

/// Of Boost.Signals, which Player used.
namespace signals {
/// What ClientProxy::ConnectReadSignal() returns.
typedef PlayerCc::read_connection_t connection;
}  // namespace signals

}  // namespace boost_names
}  // namespace PlayerCc

/// Boost's, with PlayerCc::boost_names for what Boost does not declare.
namespace boost {
using namespace ::PlayerCc::boost_names;  // NOLINT(google-build-using-namespace): see there
}  // namespace boost
