// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libplayerc++/elements.h"
#include "libplayerc++/mutex.h"
#include "messages/spare.h"
#include "playerlike/session/session.h"
#include "session/reading_as.h"

namespace playerlike {

/// Receives the readings of one device; proxies and MorseSensors implement it.
class ReadingListener {
 public:
  virtual ~ReadingListener() = default;
  /// Takes a new reading. The core's mutex is held, and begin_change() was called.
  virtual void on_reading(const sim::SharedReading& reading) = 0;
  /// Called after a round that had readings for this listener. The mutex is held.
  virtual void on_round() {}
  /// Called in each round for listeners of ClientCore::add_poller(): requests new data from the
  /// session. The mutex is held, and begin_change() was called. @return whether there are any.
  virtual bool on_poll() { return false; }
  /// The function to call after the round without the mutex; empty: none. The mutex is held.
  virtual std::function<void()> notification() { return {}; }
  /// The client is closed. The mutex is held.
  virtual void on_close() {}
};

/// State that a client and its devices share, so it outlives both: the session, the mutex that
/// guards all data, and the listeners of each device.
///
/// Lock order: this mutex first, then the session's mutexes. Waiting happens without the mutex.
class ClientCore final : private ReadingSink {
 public:
  explicit ClientCore(std::unique_ptr<Session> session);
  ~ClientCore() override;

  [[nodiscard]] PlayerCc::mutex_t& mutex() noexcept { return mutex_; }
  [[nodiscard]] Session& session() noexcept { return *session_; }
  [[nodiscard]] const std::vector<RobotInfo>& robots() const noexcept { return session_->robots(); }
  /// Sends a command to a device. The first speed beyond a robot's limits, which will be clamped,
  /// is reported on standard error. The caller holds the mutex.
  /// @throws PlayerCc::PlayerError in the name of `fun`.
  void send(const char* fun, DeviceId device, const sim::Command& command);

  /// Subscribes a listener to a device. The caller holds the mutex.
  /// @param replace  see ReplaceRequest; nullopt: the session's default.
  void add(DeviceId device, ReadingListener& listener, std::optional<bool> replace = std::nullopt);
  /// Adds a listener without a device. Its on_poll() is called in each round. The caller holds the
  /// mutex.
  void add_poller(ReadingListener& listener);
  /// Whether a listener is registered. The caller holds the mutex.
  [[nodiscard]] bool listens(const ReadingListener& listener) const noexcept;
  /// Undoes add() and add_poller(); does nothing for an unknown listener. Locks the mutex; never
  /// throws.
  void remove(ReadingListener& listener) noexcept;

  /// Waits for a round, delivers its readings to the listeners, then calls their notifications.
  /// @param stop  if it is true after the wait, nothing is delivered.
  void read(const std::atomic<bool>* stop = nullptr);
  /// Delivers the readings that have arrived, without waiting and without letting simulated time
  /// advance. @return whether there were any.
  bool read_pending();
  [[nodiscard]] bool peek(std::chrono::milliseconds timeout) { return session_->peek(timeout); }

  /// Ends the session. Listeners stay registered, but get no more readings. Locks the mutex.
  void close() noexcept;
  [[nodiscard]] bool closed() const noexcept { return closed_; }

  /// Whether a background thread has reached the end of the run; the program's own threads would
  /// not notice it otherwise.
  [[nodiscard]] bool run_is_over() const noexcept { return run_is_over_; }
  /// Locks the mutex.
  void set_run_is_over(bool over);

  /// Lets the thread that has changed the exposed data last, the holder, read elements without the
  /// mutex, while the client is usable. Locks the mutex.
  void bind(PlayerCc::detail::Elements& elements);
  /// Undoes bind(). Locks the mutex.
  void unbind(PlayerCc::detail::Elements& elements) noexcept;
  /// Must be called before any change of data that devices expose. The caller holds the mutex.
  void begin_change() noexcept;

  /// Whether require_usable() would return without an error. Cheap.
  [[nodiscard]] bool usable() const noexcept {
    return !closed_.load(std::memory_order_acquire) &&
           !run_is_over_.load(std::memory_order_acquire);
  }
  /// Throws SessionError if the client is closed or a background thread has reached the end of the
  /// run.
  void require_usable() const;

  /// Counts the program's accesses to a sensor's data; see NoteLooksRequest. The caller holds the
  /// mutex.
  void count_data_reads(int count, bool has_data) {
    constexpr int kAtOnce = 1024;
    looks_ += count;
    if (looks_ < kAtOnce) return;
    session_->request(NoteLooksRequest{std::exchange(looks_, 0), has_data});
  }

  /// The last known pose of a robot, for devices that report it too. Poses of the arena's
  /// localisation take precedence over odometry. The caller holds the mutex.
  void note_pose(int robot, const sim::Pose& pose, bool absolute);
  [[nodiscard]] std::optional<sim::Pose> last_pose(int robot) const;

  /// The position goals that MorseRobot has set, by robot, in W; guarded by the mutex.
  std::map<int, sim::Pose>& position_goals() noexcept { return position_goals_; }

  /// A layer for a Graphics2dProxy: one that an earlier proxy gave back, or a new one. A new layer
  /// takes the first of the names "graphics2d", "graphics2d_1", ... that neither a proxy nor
  /// another layer uses. The caller holds the mutex.
  [[nodiscard]] sim::LayerId acquire_layer();
  /// Gives a layer of acquire_layer() back; its contents stay. Locks the mutex; never throws.
  void release_layer(sim::LayerId layer) noexcept;

  /// A list of so many cells for set_cells(), with any content. Any thread may call it.
  [[nodiscard]] std::vector<sim::CellValue> list_of_cells(std::size_t size);
  /// Sets cells of a layer, see SetCellsRequest. Keeps the memory of the list for the next one.
  /// Any thread may call it.
  void set_cells(sim::LayerId layer, const sim::CellRect& rect, std::vector<sim::CellValue> cells);

  /// Replace rules for interfaces whose devices are subscribed to later. The caller holds the
  /// mutex.
  std::map<int, bool>& replace_rules() noexcept { return replace_rules_; }

  /// Greatest speeds of a robot; 0: unknown.
  struct SpeedLimits {
    double speed_mps = 0.0;
    double turn_rate_radps = 0.0;
  };
  /// Those of a robot with a motor device: the robot's, or the device's if they are lower.
  [[nodiscard]] SpeedLimits speed_limits(DeviceId motors) const;

  [[nodiscard]] const RobotInfo& robot_of(DeviceId device) const;
  [[nodiscard]] const DeviceInfo& info_of(DeviceId device) const;
  /// Calls visit(device) for every device with a listener. The caller holds the mutex.
  template <typename Visit>
  void for_each_device(Visit visit) const {
    for (const Entry& entry : entries_) {
      if (!entry.polls()) visit(entry.device);
    }
  }

 private:
  struct Entry {
    DeviceId device;
    ReadingListener* listener;
    bool updated;

    [[nodiscard]] bool polls() const { return device.robot < 0; }
  };
  struct KnownPose {
    sim::Pose pose;
    bool absolute;
  };

  using Notifications = std::vector<std::function<void()>>;

  void on_reading(DeviceId device, const sim::SharedReading& reading) override;
  void warn_of_clamped_speed(const char* fun, DeviceId device, const sim::Command& command);
  /// From now on all threads read under the mutex, which is held, until the holder's next change.
  void withdraw_views() noexcept;
  /// Whether no listener has a device.
  [[nodiscard]] bool listens_to_nothing() const noexcept;
  /// Delivers the readings that have arrived. The mutex is held. @return the number of readings.
  int hand_out(Notifications& notifications);

  PlayerCc::mutex_t mutex_;
  const std::unique_ptr<Session> session_;
  std::list<Entry> entries_;                              // in order of registration
  std::multimap<std::pair<int, int>, Entry*> by_device_;  // robot and device -> entries
  std::map<int, KnownPose> poses_;
  std::map<int, sim::Pose> position_goals_;
  std::map<int, bool> replace_rules_;
  std::map<sim::LayerId, bool> sheets_;  // layers of graphics proxies -> in use
  std::map<std::pair<int, int>, SpeedLimits> watched_speeds_;  // of motors, until the warning
  std::mutex spare_mutex_;
  Spare<sim::CellValue> spare_cells_;  // guarded by spare_mutex_
  int looks_ = 0;                      // not reported to the session yet
  std::atomic<bool> closed_{false};
  std::atomic<bool> run_is_over_{false};
  std::array<std::uint64_t, PlayerCc::detail::Elements::kViews> viewers_{};  // have a view; 0: free
  PlayerCc::detail::Elements::Holder holder_;
  std::vector<PlayerCc::detail::Elements*> bound_;
};

/// The newest reading of a device, which its proxies and sensors expose. The core's mutex guards
/// it.
struct Newest {
  /// The reading, or a default-constructed one if there is none of that type yet.
  template <typename R>
  [[nodiscard]] const R& as() const {
    static const R none;
    const R* const found = find<R>();
    return found == nullptr ? none : *found;
  }
  /// The reading; null if there is none of that type.
  template <typename R>
  [[nodiscard]] const R* find() const noexcept {
    return reading != nullptr ? reading_as<R>(*reading) : nullptr;
  }

  sim::SharedReading reading;
  bool valid = false;
};

/// Publishes a rangefinder's newest reading to Elements, which gives access to its elements;
/// ignores readings of other devices. The mutex is held, and begin_change() was called.
void show_elements(PlayerCc::detail::Elements& elements, const Newest& newest);

/// Wraps a session, which must not be null.
[[nodiscard]] std::shared_ptr<ClientCore> make_core(std::unique_ptr<Session> session);

}  // namespace playerlike
