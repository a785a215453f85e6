// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/client_files.h"
#include "host/idle_calls.h"
#include "host/kept_writer.h"
#include "host/outputs.h"
#include "host/recorder.h"
#include "host/run_log.h"
#include "host/view_controls.h"
#include "host/viewer_link.h"
#include "playerlike/host/event_client.h"
#include "playerlike/host/host.h"
#include "playerlike/session/draw_queue.h"
#include "playerlike/session/layer_book.h"
#include "sim/world/occupancy_map.h"
#include "virtual_time/turns.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

using WallClock = std::chrono::steady_clock;

/// What the host knows of one session. Guarded by Core's mutex, but for what says otherwise.
struct Client {
  struct Subscription {
    DeviceId device{-1, -1};
    int count = 0;
    bool replace = true;
    bool fresh = false;  ///< replace: the device's newest reading was not taken yet
    std::vector<sim::SharedReading> queue;  ///< not replace: readings not taken yet
  };

  int number = 0;  ///< in order of connection; fixes the order of commands
  int port = 0;
  bool follower = false;  ///< see Session::open_follower()
  /// Of a server, which sees itself to what its clients may read.
  bool served = false;
  ThinkerId creator = 0;                    ///< who connected it
  std::vector<Subscription> subscriptions;  ///< in order of device
  bool replace_by_default = true;
  std::uint32_t overflow = 0;
  bool has_data = false;
  sim::SimTime empty_round_ns = 0;  ///< without subscriptions: when the next round is over
  int looks = 0;                    ///< peek(0) calls in a row

  ThinkerId owner = 0;      ///< who last waited; 0: nobody
  bool joined = false;      ///< takes part in the lockstep
  bool silent = false;      ///< thought for too long: does not count until it waits again
  bool waiting = false;     ///< its owner waits, and nothing has ended that yet
  bool wants_data = false;  ///< data ends the wait
  std::optional<sim::SimTime> wake_ns;  ///< the wait ends then, if set

  /// Of an EventClient: told when its wait is over. Empty: a thread waits in a call.
  std::function<void()> notify;
  std::atomic<bool> closed{false};
  std::atomic<WallClock::rep> last_seen{0};

  /// Whether it is a client of this process's program: neither a driver's nor a server's.
  [[nodiscard]] bool is_programs() const noexcept { return !follower && !notify; }

  std::mutex input_mutex;  ///< guards the commands and idle; taken after Core's mutex
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  IdleCalls idle;
  DrawQueue drawings;  ///< any thread may push; the rest under Core's mutex
};

/// The body of a Host. See DESIGN section 3 and docs/architecture.md for the rules of time.
///
/// One mutex guards simulation and clients. Commands go through each client's own input mutex and
/// drawings through its own queue, so that senders do not wait for a step.
class Host::Core : private ViewedRun, private TurnClock {
 public:
  using Lock = std::unique_lock<std::mutex>;

  Core(sim::WorldDescription world, RunSettings settings, sim::LogHook log);
  ~Core() override;

  void start_pacer_if_needed();
  void stop_pacer();
  /// Connects the run with its window, if the settings name one.
  void start_viewer_if_needed();
  /// Closes the window. Not to be called with the lock held.
  void stop_viewer();

  std::shared_ptr<Client> add_client(int port, bool follower = false,
                                     std::function<void()> notify = {});
  void remove_client(Client& client) noexcept;
  void thinker_ended(ThinkerId thinker) noexcept;

  /// What a client asks for; in requests.cpp.
  Answer answer(Client& client, const Request& request);
  void subscribe(Client& client, DeviceId device);
  void unsubscribe(Client& client, DeviceId device);
  void set_replace(Client& client, std::optional<DeviceId> device, bool replace);

  void wait(Client& client);
  int take(Client& client, ReadingSink& sink);
  bool peek(Client& client, std::chrono::milliseconds timeout);
  void sleep(Client& client, double seconds);

  // The same for event clients; see EventClient and Host.
  EventClient::Outcome begin_wait(Client& client, ThinkerId thinker);
  EventClient::Outcome begin_peek(Client& client, ThinkerId thinker,
                                  std::chrono::milliseconds timeout);
  EventClient::Outcome begin_sleep(Client& client, ThinkerId thinker, double seconds);
  EventClient::Outcome outcome_of(const Client& client) const;
  void cancel_wait(Client& client);
  bool advance_for(std::chrono::microseconds slice);
  void check_silence();
  AlarmId set_alarm(Alarm alarm);
  bool cancel_alarm(AlarmId alarm);
  void with_simulation(const std::function<void(sim::Simulation&)>& action);
  void set_step_credit(std::optional<std::uint64_t> steps);
  void add_step_credit(std::uint64_t steps);
  std::optional<std::string> set_time_factor(double factor);

  void send(Client& client, DeviceId device, const sim::Command& command);
  /// See NoteLooksRequest.
  void note_looks(Client& client, int count, bool has_data);
  void watch_program();
  void note_program_ends(int status);
  void note_end_request(int signal);
  /// Does something with the layers, after what the client has drawn so far: calls
  /// action(layers, book) under the mutex.
  template <typename Action>
  auto with_layers(Client& client, Action action) {
    const Lock lock = lock_soon();
    require_open(client);
    carry_out_drawings(client);
    return action(simulation_.layers(), layer_book_);
  }
  // In canvas_work.cpp: what may take long on a large canvas, in pieces, between which others use
  // the simulation.
  /// See EventClient::draw_some().
  bool draw_some(Client& client, DrawWork& work, std::size_t cells);
  /// All cells of a layer.
  std::vector<sim::CellValue> cells(Client& client, sim::LayerId layer);
  /// One layer's picture, or that of all, and size and place of the canvas then.
  std::vector<std::uint8_t> picture(Client& client, std::optional<sim::LayerId> layer,
                                    sim::CanvasDescription& canvas);
  void resize_canvas(Client& client, int width, int height);
  void join(Client& client, ThinkerId thinker);

  /// As the clock of those who take turns.
  [[nodiscard]] TurnClock& clock() noexcept { return *this; }

  void prefer_real_time(const std::string& reason);
  TimeStatistics time() const;
  void finish() noexcept;
  bool finished() const;
  sim::RobotStatistics statistics(int robot) const;
  std::uint64_t state_hash() const;

  [[nodiscard]] bool is_sensor(DeviceId device) const;
  /// Throws SessionError kNotAvailable if the world keeps something private from this client.
  /// @param robot  whose sensors are to be read; -1: what is nobody's, objects and the map.
  void require_readable(const Client& client, int robot) const;
  [[nodiscard]] bool own_sensors_only() const noexcept {
    return simulation_.world().simulation.own_sensors_only;  // does not change
  }
  const std::vector<RobotInfo>& robots() const noexcept { return robots_; }
  std::uint64_t canvas_generation() const noexcept {
    return canvas_generation_.load(std::memory_order_acquire);
  }

 private:
  struct RequestHandler;

  /// A lock for calls that must not starve behind a thread that steps without pause.
  [[nodiscard]] Lock lock_soon() const;
  void adopt(Client& client, ThinkerId thinker);
  void touch(Client& client) const;
  static void require_open(const Client& client);
  [[nodiscard]] bool over() const;

  /// Waits until the client has data (if wants_data), simulated time wake_ns has come (if set) or
  /// the run is over.
  void wait_until(Lock& lock, Client& client, bool wants_data, std::optional<sim::SimTime> wake_ns);
  /// The same in virtual time, where threads take turns. Returns as well when they no longer do.
  void wait_for_turn(Lock& lock, Client& client);
  [[nodiscard]] bool in_turns() const noexcept {
    return turns_ && !paced_ && Turns::instance().active();
  }
  /// Makes ready those threads whose wait is over, in their order.
  void make_ready();
  // As the clock of those who take turns.
  [[nodiscard]] sim::SimTime now_ns() const noexcept final {
    return now_ns_.load(std::memory_order_acquire);
  }
  [[nodiscard]] sim::SimTime step_ns() const noexcept final { return step_ns_; }
  void begin_turns(sim::SimTime before_ns) override;
  void end_turns(sim::SimTime before_ns) override;
  std::optional<sim::SimTime> pass_time(sim::SimTime target_ns, bool& interrupted) override;
  void note_timed_wait(Lock& lock, sim::SimTime left_ns) override;
  bool step(Lock& lock) override;
  [[nodiscard]] bool has_come(sim::SimTime wake_ns) const override;
  void look_at_start() override;
  [[nodiscard]] WallClock::time_point last_seen(const TurnThread& thread) const override;
  [[nodiscard]] WallClock::duration silence_limit() const override;
  void on_silent(const TurnThread& thread) override;
  bool on_blocked(const TurnThread& thread) override;
  void sleep_after_end(Lock& lock, ThinkerId thinker);
  void start_pacing(const std::string& warning);
  /// Whether what the client waits for is there.
  [[nodiscard]] bool wait_is_over(const Client& client) const;
  [[nodiscard]] bool gate_open();
  [[nodiscard]] int joined_programs() const;
  [[nodiscard]] bool program_takes_part() const;
  [[nodiscard]] bool all_wait() const;
  [[nodiscard]] bool thinker_waits(ThinkerId thinker) const;
  /// Whether lockstep time may go on by a step now.
  /// @param all_wait_still  all_wait() is known to be true.
  [[nodiscard]] bool may_advance(bool all_wait_still = false);
  void wait_for_others(Lock& lock, const Client& client);
  [[nodiscard]] WallClock::time_point silence_deadline() const;
  void note_silence();
  void warn_of_silence(const Client& client) const;
  /// With the client's input mutex held. @return whether warn_if_nobody_reads() is to be called.
  [[nodiscard]] bool note_command(Client& client);
  void warn_if_nobody_reads(Client& client);
  [[nodiscard]] bool others_take_turns(ThinkerId thinker) const;
  [[nodiscard]] std::string cure_for_standing_time() const;
  void start_busy_alarm(const Lock& held);
  [[nodiscard]] EventClient::Outcome outcome(const Client& client) const;
  EventClient::Outcome begin(Client& client, ThinkerId thinker, bool wants_data,
                             std::optional<sim::SimTime> wake_ns);
  /// Makes a step. @return release_waiters()
  bool advance();
  void apply_inputs(Client& client);
  void carry_out_drawings(Client& client);
  /// Keeps those drawings that are on the shared canvas or on one of the client's layers.
  void keep_own_drawings(const Client& client, std::vector<sim::DrawOperation>& operations) const;
  template <typename Copy>
  sim::CanvasDescription copy_in_pieces(Client& client, const Copy& copy);
  void let_others_in() const;
  void distribute();
  void distribute(const sim::SharedReading& reading, Client::Subscription& subscription,
                  Client& client);
  [[nodiscard]] const sim::Sensor& sensor(DeviceId device) const;
  [[nodiscard]] std::vector<Client*>& subscribers(DeviceId device);
  /// @return null if the client has none for that device.
  [[nodiscard]] static Client::Subscription* find_subscription(Client& client, DeviceId device);
  void forget_subscriber(const Client& client, DeviceId device) noexcept;
  /// @return whether somebody who waited may no longer do so.
  bool release_waiters();
  void ring_alarms();
  void end_run();
  void write_results();
  /// Lets what is left when the program dies follow the run.
  void keep_results(WallClock::time_point now);
  /// The report's file, at most once a second of wall time.
  void keep_report(WallClock::time_point now);
  [[nodiscard]] RunEnd reason_of_end() const;
  void set_phase(KeptRun::Phase phase) noexcept;
  /// Why another run may differ.
  [[nodiscard]] std::vector<std::string> unrepeatable() const;
  void show_progress(bool last);
  void pace();
  [[nodiscard]] sim::SimTime end_of_peek(std::chrono::milliseconds timeout) const;
  /// Holds the pacer while no step may be made.
  void wait_for_step_credit(Lock& lock);
  /// Holds the pacer while the user has paused the run.
  void wait_while_paused(Lock& lock);

  // The window, as ViewedRun; called by the link's thread.
  ViewScene view_scene() override;
  std::string on_key(std::uint32_t keysym, bool pressed, bool control) override;
  void on_keys_released() override;
  void on_saved(const std::string& file, const std::string& problem) override;
  void on_closed() override;
  void on_lost(const std::string& reason) override;
  /// Carries out a pressed key that drives no robot.
  void act(ViewAction action);
  void change_view_mode(int by);
  void change_speed(bool faster);
  void change_pause();
  [[nodiscard]] std::string next_picture_file();
  /// Puts a passing message into the window.
  void tell(const std::string& text);
  [[nodiscard]] TimeStatistics time_locked() const;
  void warn(const std::string& text) const;

  RunSettings settings_;
  sim::LogHook log_;
  sim::Simulation simulation_;
  std::vector<RobotInfo> robots_;
  LayerBook layer_book_;
  std::atomic<std::uint64_t> canvas_generation_{0};
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<KeptWriter> kept_;                ///< none unless the settings name one
  WallClock::time_point last_looks_{};              ///< when kept_ last got what rarely changes
  std::optional<WallClock::time_point> last_kept_;  ///< when the report was last written
  bool keeping_told_ = false;                       ///< that they cannot be written
  int end_request_ = 0;                             ///< the signal that asked for the end
  bool window_closed_ = false;
  std::optional<int> program_status_;
  std::vector<std::vector<std::vector<Client*>>> subscribers_;  ///< by robot and device
  ClientFiles client_files_;
  std::map<int, RunLog> logs_;  ///< by port; those that somebody has asked for

  const bool turns_;  ///< virtual time: threads go on one by one, in a fixed order
  mutable std::mutex own_mutex_;
  std::mutex& mutex_;                     ///< its own, or that of those who take turns
  mutable std::atomic<int> knocking_{0};  ///< threads in lock_soon()
  std::condition_variable changed_;
  std::vector<std::shared_ptr<Client>> clients_;  ///< followers first, each kind in order of number
  int next_number_ = 0;
  bool gate_opened_ = false;
  WallClock::time_point gate_told_ = WallClock::now();  ///< when it was last said who is missing
  std::vector<std::pair<AlarmId, Alarm>> alarms_;       ///< in order of number
  AlarmId next_alarm_ = 1;
  std::optional<std::uint64_t> step_credit_;  ///< steps that may still be made, if limited
  bool ended_ = false;
  int reads_after_end_ = 0;
  const sim::SimTime step_ns_;
  std::atomic<sim::SimTime> now_ns_{0};     ///< the simulation's, for those without the lock
  std::size_t unsubscribed_ = 0;            ///< clients without subscriptions
  bool somebody_draws_ = false;             ///< some client has had a queue for drawings
  std::atomic<bool> commands_wait_{false};  ///< some client has sent some since the last step
  mutable std::vector<ThinkerId> waiting_;  ///< of all_wait()
  std::atomic<bool> wants_time_{false};  ///< the program has subscribed to something or commanded
  bool watches_program_ = false;         ///< see Host::watch_program()
  bool nobody_reads_told_ = false;
  bool end_told_ = false;  ///< a session has thrown because the run is over
  bool ended_by_program_ = false;
  int sleeps_after_end_ = 0;
  std::optional<WallClock::time_point> first_step_;
  std::optional<WallClock::time_point> last_step_;
  WallClock::time_point last_progress_;
  bool progress_shown_ = false;
  bool mode_chosen_ = false;
  bool silence_noted_ = false;   ///< the others have gone on without a client
  bool driven_by_hand_ = false;  ///< at the window
  ThinkerId first_owner_ = 0;    ///< who waited first, and ...
  bool several_owners_ = false;  ///< ... whether another one has

  std::thread pacer_;
  bool paced_ = false;  ///< the pacer steps, not the clients
  bool stop_pacing_ = false;
  double time_factor_ = 1.0;  ///< simulated seconds a wall second, when paced
  bool paused_ = false;       ///< by the user at the window
  int pace_changes_ = 0;      ///< counts changes of the two above and of step_credit_

  std::optional<HandDrive> hand_;  ///< of a run with a window
  bool help_ = true;               ///< shown in the window
  std::string message_;            ///< shown in the window until then
  WallClock::time_point message_end_{};
  int pictures_ = 0;  ///< number of the newest picture that the user saved
  std::unique_ptr<ViewerLink> viewer_;
};

/// A call of a host's body by a thread of a program: what that does with clocks and locks is real.
class InsideCore {
 public:
  explicit InsideCore(Host::Core& core) noexcept : core_(core) {}
  Host::Core* operator->() const noexcept { return &core_; }

 private:
  virtual_time::Inside inside_;
  Host::Core& core_;
};

}  // namespace playerlike
