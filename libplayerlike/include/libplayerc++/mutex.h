// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>

namespace PlayerCc {

/// The lock that protects a client's data, as Player's programs know it: not recursive, with a
/// nested scoped_lock that holds it until the end of a scope and can unlock earlier.
///
///   PlayerClient::mutex_t::scoped_lock lock(client.mMutex);
///
/// Proxies lock it in every call, so a program that holds it must not call them.
class mutex_t : public std::mutex {
 public:
  typedef std::unique_lock<mutex_t> scoped_lock;
};

}  // namespace PlayerCc
