// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/recorder.h"
#include "playerlike/host/host.h"

namespace playerlike {

using WallClock = std::chrono::steady_clock;

/// What the host knows of one session. Guarded by Core's mutex, but for what says otherwise.
struct Client {
  struct Subscription {
    DeviceId device{-1, -1};
    int count = 0;
    bool replace = true;
    bool fresh = false;  ///< replace: the device's newest reading was not taken yet
    std::vector<std::unique_ptr<sim::Reading>> queue;  ///< not replace: readings not taken yet
  };

  int number = 0;  ///< in order of connection; fixes the order of commands
  int port = 0;
  std::vector<Subscription> subscriptions;  ///< in order of device
  bool replace_by_default = true;
  std::uint32_t overflow = 0;
  bool has_data = false;
  sim::SimTime empty_round_ns = 0;  ///< without subscriptions: when the next round is over
  int looks = 0;                    ///< peek(0) calls in a row

  std::thread::id owner;    ///< the thread that last waited
  bool joined = false;      ///< takes part in the lockstep
  bool silent = false;      ///< thought for too long: does not count until it waits again
  bool waiting = false;     ///< its owner is inside a wait that nothing has ended yet
  bool wants_data = false;  ///< data ends the wait
  std::optional<sim::SimTime> wake_ns;  ///< the wait ends then, if set
  std::atomic<bool> closed{false};
  std::atomic<WallClock::rep> last_seen{0};

  std::mutex input_mutex;  ///< guards what follows; taken after Core's mutex
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  std::vector<sim::CanvasOperation> drawings;
};

/// The body of a Host. See DESIGN section 3 and docs/architecture.md for the rules of time.
///
/// One mutex guards simulation and clients. Commands and drawings go through each client's own
/// input mutex, so that senders do not wait for a step.
class Host::Core {
 public:
  Core(sim::WorldDescription world, RunSettings settings, sim::LogHook log);
  ~Core();

  void start_pacer_if_needed();
  void stop_pacer();

  std::shared_ptr<Client> add_client(int port);
  void remove_client(Client& client) noexcept;
  /// Forgets that a thread takes part; called when it ends.
  void thread_ended(std::thread::id thread) noexcept;

  void subscribe(Client& client, DeviceId device);
  void unsubscribe(Client& client, DeviceId device);
  void set_replace(Client& client, std::optional<DeviceId> device, bool replace);
  std::uint32_t overflow(const Client& client) const;

  void wait(Client& client);
  int take(Client& client, ReadingSink& sink);
  bool peek(Client& client, std::chrono::milliseconds timeout);
  void sleep(Client& client, double seconds);

  void send(Client& client, DeviceId device, const sim::Command& command);
  void draw(Client& client, std::span<const sim::CanvasOperation> operations);
  std::optional<sim::Colour> pixel(Client& client, int column, int row);
  std::vector<std::uint8_t> canvas_image(Client& client);

  void prefer_real_time(const std::string& reason);
  TimeStatistics time() const;
  void finish() noexcept;
  bool finished() const;
  std::uint64_t state_hash() const;

  [[nodiscard]] bool is_sensor(DeviceId device) const;
  const std::vector<RobotInfo>& robots() const noexcept { return robots_; }
  CanvasInfo canvas_info() const noexcept { return canvas_info_; }

 private:
  using Lock = std::unique_lock<std::mutex>;

  /// A lock for calls that must not starve behind a thread that steps without pause.
  [[nodiscard]] Lock lock_soon() const;
  void adopt(Client& client);
  void touch(Client& client) const;
  static void require_open(const Client& client);
  [[nodiscard]] bool over() const;

  /// Waits until the client has data (if wants_data), simulated time wake_ns has come (if set) or
  /// the run is over.
  void wait_until(Lock& lock, Client& client, bool wants_data, std::optional<sim::SimTime> wake_ns);
  /// Whether what the client waits for is there.
  [[nodiscard]] bool wait_is_over(const Client& client) const;
  [[nodiscard]] bool gate_open();
  [[nodiscard]] bool all_wait() const;
  [[nodiscard]] bool thread_waits(std::thread::id thread) const;
  void wait_for_others(Lock& lock);
  void advance();
  void apply_inputs(Client& client);
  void flush_drawings(Client& client);
  void distribute();
  void release_waiters();
  void end_run();
  void write_results();
  void show_progress(bool last);
  void pace();
  [[nodiscard]] TimeStatistics time_locked() const;
  void warn(const std::string& text) const;

  RunSettings settings_;
  sim::LogHook log_;
  sim::Simulation simulation_;
  std::vector<RobotInfo> robots_;
  CanvasInfo canvas_info_;
  std::unique_ptr<Recorder> recorder_;

  mutable std::mutex mutex_;
  mutable std::atomic<int> knocking_{0};  ///< threads in lock_soon()
  std::condition_variable changed_;
  std::vector<std::shared_ptr<Client>> clients_;
  int next_number_ = 0;
  bool gate_opened_ = false;
  bool ended_ = false;
  int reads_after_end_ = 0;
  std::optional<WallClock::time_point> first_step_;
  std::optional<WallClock::time_point> last_step_;
  WallClock::time_point last_progress_;
  bool progress_shown_ = false;
  bool mode_chosen_ = false;

  std::thread pacer_;
  bool paced_ = false;  ///< the pacer steps, not the clients
  bool stop_pacing_ = false;
};

}  // namespace playerlike
