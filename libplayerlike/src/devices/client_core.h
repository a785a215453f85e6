// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "libplayerc++/elements.h"
#include "libplayerc++/mutex.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// Whoever wants the readings of one device: a proxy, a MorseSensor.
class ReadingListener {
 public:
  virtual ~ReadingListener() = default;
  /// A new reading. The core's mutex is held, and begin_change() was called.
  virtual void on_reading(const sim::SharedReading& reading) = 0;
  /// All readings of a round were handled, and some were this listener's. The mutex is held.
  virtual void on_round() {}
  /// What to call after the round, without the mutex; empty if nothing. The mutex is held.
  virtual std::function<void()> notification() { return {}; }
  /// The client is gone. The mutex is held.
  virtual void on_close() {}
};

/// What a client and its devices share, and so what outlives whichever goes first: the session,
/// the mutex over all data, and who listens to which device.
///
/// Lock order: the mutex first, then whatever the session locks. Waiting is done without the mutex.
class ClientCore final : private ReadingSink {
 public:
  explicit ClientCore(std::unique_ptr<Session> session);
  ~ClientCore() override;

  [[nodiscard]] PlayerCc::mutex_t& mutex() noexcept { return mutex_; }
  [[nodiscard]] Session& session() noexcept { return *session_; }
  [[nodiscard]] const std::vector<RobotInfo>& robots() const noexcept { return session_->robots(); }
  /// Gives a device a command. @throws PlayerCc::PlayerError in the name of `fun`.
  void send(const char* fun, DeviceId device, const sim::Command& command);

  /// Subscribes a listener to a device. The mutex is held by the caller.
  /// @param replace  see ReplaceRequest; nullopt: whatever the session does by itself.
  void add(DeviceId device, ReadingListener& listener, std::optional<bool> replace = std::nullopt);
  /// Whether a listener was added. The mutex is held by the caller.
  [[nodiscard]] bool listens(const ReadingListener& listener) const noexcept;
  /// The reverse of add(); harmless when it was not added. Takes the mutex; never throws.
  void remove(ReadingListener& listener) noexcept;

  /// Waits for a round and hands its readings to the listeners, then calls their notifications.
  /// @param stop  if it is true after the wait, nothing is handed out.
  void read(const std::atomic<bool>* stop = nullptr);
  /// The same for what has arrived, without waiting, and without letting simulated time go on.
  /// @return whether there was anything.
  bool read_what_waits();
  [[nodiscard]] bool peek(std::chrono::milliseconds timeout) { return session_->peek(timeout); }

  /// Ends the session; listeners stay listed, for nothing more to come. Takes the mutex.
  void close() noexcept;
  [[nodiscard]] bool closed() const noexcept { return closed_; }

  /// Whether a thread in the background has met the end of the run, which the program's own
  /// threads cannot notice otherwise.
  [[nodiscard]] bool run_is_over() const noexcept { return run_is_over_; }
  /// Takes the mutex.
  void set_run_is_over(bool over);

  /// The thread that has changed what the devices show, if it is the only one so far and the client
  /// is usable, as PlayerCc::detail::thread_number: it may look at its own snapshots without the
  /// mutex, see PlayerCc::detail::Elements.
  [[nodiscard]] const std::atomic<std::uint64_t>& sole_user() const noexcept { return sole_user_; }
  /// To be called before anything changes that devices show. The mutex is held by the caller.
  void begin_change() noexcept;

  /// Whether require_usable() would not throw. Cheap.
  [[nodiscard]] bool usable() const noexcept {
    return !closed_.load(std::memory_order_acquire) &&
           !run_is_over_.load(std::memory_order_acquire);
  }
  /// Throws SessionError if the client is gone, or the run over in the background.
  void require_usable() const;

  /// Notes that the program has looked so often at data of a sensor; see NoteLooksRequest. The
  /// mutex is held by the caller.
  void note_looks(int count, bool has_data) {
    constexpr int kAtOnce = 1024;
    looks_ += count;
    if (looks_ < kAtOnce) return;
    session_->request(NoteLooksRequest{std::exchange(looks_, 0), has_data});
  }

  /// Where a robot's localisation last said that it is, for devices that report it too; under
  /// the mutex. Poses of the arena's localisation win over odometry.
  void note_pose(int robot, const sim::Pose& pose, bool absolute);
  [[nodiscard]] std::optional<sim::Pose> last_pose(int robot) const;

  /// The position goals that MorseRobot has set, by robot, in W; under the mutex.
  std::map<int, sim::Pose>& position_goals() noexcept { return position_goals_; }

  /// A layer of the session for a Graphics2dProxy: one that an earlier proxy has given back, or a
  /// new one, under the first of the names "graphics2d", "graphics2d_1", ... that no proxy uses and
  /// no other layer has. The mutex is held by the caller.
  [[nodiscard]] sim::LayerId take_sheet();
  /// The reverse; the layer stays as it is. Takes the mutex; never throws.
  void give_back_sheet(sim::LayerId layer) noexcept;

  /// Replace rules for interfaces whose devices are subscribed to later; under the mutex.
  std::map<int, bool>& replace_rules() noexcept { return replace_rules_; }

  [[nodiscard]] const RobotInfo& robot_of(DeviceId device) const;
  [[nodiscard]] const DeviceInfo& info_of(DeviceId device) const;
  /// Calls visit(device) for every device that is listened to; under the mutex.
  template <typename Visit>
  void for_each_device(Visit visit) const {
    for (const Entry& entry : entries_) visit(entry.device);
  }

 private:
  struct Entry {
    DeviceId device;
    ReadingListener* listener;
    bool updated;
  };
  struct KnownPose {
    sim::Pose pose;
    bool absolute;
  };

  using Notifications = std::vector<std::function<void()>>;

  void on_reading(DeviceId device, const sim::SharedReading& reading) override;
  /// Hands out what has arrived; the mutex is held. @return how many readings.
  int hand_out(Notifications& notifications);

  PlayerCc::mutex_t mutex_;
  const std::unique_ptr<Session> session_;
  std::list<Entry> entries_;                              // in the order of their addition
  std::multimap<std::pair<int, int>, Entry*> by_device_;  // robot and device -> entries
  std::map<int, KnownPose> poses_;
  std::map<int, sim::Pose> position_goals_;
  std::map<int, bool> replace_rules_;
  std::map<sim::LayerId, bool> sheets_;  // layers of graphics proxies -> in use
  int looks_ = 0;                        // not told to the session yet
  std::atomic<bool> closed_{false};
  std::atomic<bool> run_is_over_{false};
  std::uint64_t first_user_ = 0;  // the first thread that changed anything
  std::atomic<std::uint64_t> sole_user_{PlayerCc::detail::Elements::kNobody};
};

/// The newest reading of a device, for whoever shows it; under the mutex.
struct Newest {
  /// The reading, or one as it is made if there is none of that type yet.
  template <typename R>
  [[nodiscard]] const R& as() const {
    static const R none;
    const R* const found = find<R>();
    return found == nullptr ? none : *found;
  }
  /// The reading; null if there is none of that type.
  template <typename R>
  [[nodiscard]] const R* find() const noexcept {
    const sim::Reading* const any = reading.get();
    return any != nullptr && typeid(*any) == typeid(R) ? static_cast<const R*>(any) : nullptr;
  }

  sim::SharedReading reading;
  bool valid = false;
};

/// The newest reading is shown element by element, too, if it is one of a rangefinder. The mutex is
/// held, and begin_change() was called.
void show_elements(PlayerCc::detail::Elements& elements, const Newest& newest);

/// Wraps a session, which must not be null.
[[nodiscard]] std::shared_ptr<ClientCore> make_core(std::unique_ptr<Session> session);

}  // namespace playerlike
