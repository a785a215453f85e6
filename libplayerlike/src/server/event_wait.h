// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "playerlike/host/event_client.h"
#include "server/peer.h"

namespace playerlike::server {

/// An event client of a handler, and the notifications of its waits. Used by the server's thread
/// only, except that the client may be shared with jobs of the worker thread.
class EventWait {
 public:
  using Outcome = EventClient::Outcome;

  /// @param on_end  runs as a task of the hub after a wait may have ended, unless begin() has
  ///                returned its outcome. It must check EventClient::outcome(). It is not called
  ///                after the destruction of this object.
  /// @throws SessionError as Host::connect_events().
  EventWait(Hub& hub, int port, EventRole role, std::function<void()> on_end,
            const CreationOrder& order = {})
      : hub_(hub), on_end_(std::make_shared<const std::function<void()>>(std::move(on_end))) {
    const void* me = on_end_.get();
    client_ = hub.host().connect_events(
        port,
        [&hub, me, weak = std::weak_ptr(on_end_)] {
          if (is_beginning(me)) return;
          hub.post([me, weak] {
            // begin() also runs tasks, and checks the outcome itself afterwards.
            if (is_beginning(me)) return;
            if (const auto action = weak.lock()) (*action)();
          });
        },
        role, order);
  }
  EventWait(const EventWait&) = delete;
  EventWait& operator=(const EventWait&) = delete;
  /// Closes the session; jobs of the worker thread may still hold the client.
  ~EventWait() { client_->session().close(); }

  [[nodiscard]] const std::shared_ptr<EventClient>& client() const noexcept { return client_; }
  [[nodiscard]] Session& session() const noexcept { return client_->session(); }

  /// Begins a wait: calls start(), which begins one and returns its outcome. Usually lockstep time
  /// can advance at once, and the wait ends without another turn of the event loop.
  /// @return the outcome; if it is kWaiting, on_end() follows.
  template <typename Start>
  Outcome begin(Start start) {
    const Beginning scope(on_end_.get());
    const Outcome outcome = start();
    if (outcome != Outcome::kWaiting) return outcome;
    hub_.pump();
    return client_->outcome();
  }

 private:
  /// A call of begin() in this thread. Calls nest: the tasks that one of them runs may begin the
  /// waits of other objects.
  class Beginning {
   public:
    explicit Beginning(const void* object) : who(object), outer(innermost) { innermost = this; }
    ~Beginning() { innermost = outer; }
    Beginning(const Beginning&) = delete;
    Beginning& operator=(const Beginning&) = delete;

    static inline thread_local const Beginning* innermost = nullptr;
    const void* const who;
    const Beginning* const outer;
  };

  /// Whether this thread is in begin() of an object.
  [[nodiscard]] static bool is_beginning(const void* who) noexcept {
    const Beginning* at = Beginning::innermost;
    while (at != nullptr && at->who != who) at = at->outer;
    return at != nullptr;
  }

  Hub& hub_;
  std::shared_ptr<const std::function<void()>> on_end_;  ///< expires with this object
  std::shared_ptr<EventClient> client_;
};

}  // namespace playerlike::server
