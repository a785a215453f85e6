// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "libplayerc++/mutex.h"
#include "libplayerc++/readsignal.h"

/// Boost.Asio's placeholders, such as boost::asio::placeholders::error, are of this type, or
/// functions that return it.
namespace boost {
template <int I>
struct arg;
}  // namespace boost

namespace std {
/// @cond
template <int I>
struct is_placeholder<boost::arg<I>> : integral_constant<int, I> {};
template <int I>
struct is_placeholder<boost::arg<I> (*)()> : integral_constant<int, I> {};
/// @endcond
}  // namespace std

namespace PlayerCc {

/// Boost names that programs use without including Boost, because Player's headers included it:
/// boost::bind, ref, cref, function, shared_ptr, mutex, thread, and signals::connection. Here they
/// refer to the standard library and to this library.
///
/// If a program includes a Boost header itself, it gets Boost's own declarations from that header
/// and these names for the rest: name lookup prefers declarations in namespace boost to names from
/// its using-directive. Boost's own boost::mutex::scoped_lock can also lock PlayerClient::mMutex.
namespace boost_names {

using std::bind;
using std::cref;
using std::function;
using std::ref;
using std::shared_ptr;

/// Of overloaded member functions, Boost's bind takes the one with as many parameters as there are
/// arguments: boost::bind(&boost::asio::io_service::run, &service).
template <typename R, typename T, typename O>
auto bind(R (T::*aF)(), O aO) -> decltype(std::bind(aF, aO)) {
  return std::bind(aF, aO);
}
template <typename R, typename T, typename O>
auto bind(R (T::*aF)() const, O aO) -> decltype(std::bind(aF, aO)) {
  return std::bind(aF, aO);
}
/// @cond
template <typename R, typename T, typename P, typename O, typename A>
auto bind(R (T::*aF)(P), O aO, A aA) -> decltype(std::bind(aF, aO, aA)) {
  return std::bind(aF, aO, aA);
}
template <typename R, typename T, typename P, typename O, typename A>
auto bind(R (T::*aF)(P) const, O aO, A aA) -> decltype(std::bind(aF, aO, aA)) {
  return std::bind(aF, aO, aA);
}
template <typename R, typename T, typename P, typename Q, typename O, typename A, typename B>
auto bind(R (T::*aF)(P, Q), O aO, A aA, B aB) -> decltype(std::bind(aF, aO, aA, aB)) {
  return std::bind(aF, aO, aA, aB);
}
template <typename R, typename T, typename P, typename Q, typename O, typename A, typename B>
auto bind(R (T::*aF)(P, Q) const, O aO, A aA, B aB) -> decltype(std::bind(aF, aO, aA, aB)) {
  return std::bind(aF, aO, aA, aB);
}
/// @endcond

/// The type of PlayerClient::mMutex.
typedef PlayerCc::mutex_t mutex;

/// A thread that is detached if this object is destroyed while it is running, like Boost's.
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

/// Names of Boost.Signals, which Player used.
namespace signals {
/// Return type of ClientProxy::ConnectReadSignal().
typedef PlayerCc::read_connection_t connection;
}  // namespace signals

}  // namespace boost_names
}  // namespace PlayerCc

/// Boost's namespace, extended by PlayerCc::boost_names for names that Boost does not declare.
namespace boost {
using namespace ::PlayerCc::boost_names;  // NOLINT(google-build-using-namespace): see boost_names
}  // namespace boost
