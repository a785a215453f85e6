// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "page_settings.h"

namespace playpen::page {

/// Serves the page of a run to browsers, and connects them to the run's host
/// (playerlike/page/protocol.h). All work is done by the thread that calls run() or poll().
class PageServer {
 public:
  /// Starts to listen, and tells the host.
  /// @param host  descriptor of a connected stream socket to the host. It is closed by this object.
  /// @param tell  receives warnings for the user; they contain no token.
  /// @throws std::runtime_error that says what is wrong with the address or the ports.
  PageServer(const PageSettings& settings, const PageLimits& limits, int host,
             std::function<void(const std::string&)> tell);
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;
  ~PageServer();

  /// The TCP port.
  [[nodiscard]] int port() const noexcept;

  /// Serves until the host has closed its end and the clients have been told, which takes at most
  /// PageLimits::closing_time.
  void run();

  /// Does all that can be done without waiting. @return whether that was anything.
  bool poll();

  /// Serves a browser that is connected by a stream socket of any kind, such as one end of a
  /// socketpair(), as if it had connected by TCP.
  /// @param descriptor  is closed by this object.
  void adopt(int descriptor);

  class Impl;  ///< in the source, where its connections use it

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace playpen::page
