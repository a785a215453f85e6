// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>

#include <mutex>
#include <type_traits>

namespace PlayerCc {

namespace detail {
/// Whether a type consists of a pthread mutex only, like std::mutex and boost::mutex.
template <typename T, typename = void>
struct IsPlainMutex : std::false_type {};
template <typename T>
struct IsPlainMutex<T, typename std::enable_if<std::is_same<typename T::native_handle_type,
                                                            pthread_mutex_t*>::value>::type>
    : std::integral_constant<bool, std::is_standard_layout<T>::value &&
                                       sizeof(T) == sizeof(pthread_mutex_t)> {};
}  // namespace detail

/// The mutex that guards a client's data, with Player's interface. It is not recursive. The nested
/// scoped_lock holds it until the end of a scope and can unlock it earlier.
///
///   PlayerClient::mutex_t::scoped_lock lock(client.mMutex);
///
/// Every member of a proxy locks it, so a program that holds it must not call proxies.
class mutex_t : public std::mutex {
 public:
  typedef std::unique_lock<mutex_t> scoped_lock;

  /// Converts to another mutex type that consists of a pthread mutex only. Player's type was
  /// boost::mutex, so programs that include Boost write boost::mutex::scoped_lock
  /// lock(client.mMutex).
  template <typename T, typename = typename std::enable_if<!std::is_base_of<T, mutex_t>::value &&
                                                           detail::IsPlainMutex<T>::value>::type>
  operator T&() {
    return *reinterpret_cast<T*>(native_handle());
  }
};

}  // namespace PlayerCc
