// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>

#include <mutex>
#include <type_traits>

namespace PlayerCc {

namespace detail {
/// Whether a type is nothing but the system's mutex, as std::mutex and boost::mutex are.
template <typename T, typename = void>
struct IsPlainMutex : std::false_type {};
template <typename T>
struct IsPlainMutex<T, typename std::enable_if<std::is_same<typename T::native_handle_type,
                                                            pthread_mutex_t*>::value>::type>
    : std::integral_constant<bool, std::is_standard_layout<T>::value &&
                                       sizeof(T) == sizeof(pthread_mutex_t)> {};
}  // namespace detail

/// The lock that protects a client's data, as Player's programs know it: not recursive, with a
/// nested scoped_lock that holds it until the end of a scope and can unlock earlier.
///
///   PlayerClient::mutex_t::scoped_lock lock(client.mMutex);
///
/// Proxies lock it in every call, so a program that holds it must not call them.
class mutex_t : public std::mutex {
 public:
  typedef std::unique_lock<mutex_t> scoped_lock;

  /// The same mutex as a program's own kind: Player's was boost::mutex, so programs that include
  /// Boost say boost::mutex::scoped_lock lock(client.mMutex).
  template <typename T, typename = typename std::enable_if<!std::is_base_of<T, mutex_t>::value &&
                                                           detail::IsPlainMutex<T>::value>::type>
  operator T&() {
    return *reinterpret_cast<T*>(native_handle());
  }
};

}  // namespace PlayerCc
