// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/host/grading.h"
#include "sim/core/log.h"
#include "sim/world/description.h"

namespace playerlike {

/// Which device answers under an interface and index, instead of what the world says.
struct InterfaceChoice {
  std::string robot;      ///< name; "": each robot that has the device
  std::string interface;  ///< e.g. "ranger"
  int index = 0;          ///< on the robot's own port, from 0
  std::string device;     ///< e.g. "laser"

  /// "ranger:0=laser" or "r1.ranger:0=laser".
  [[nodiscard]] std::string text() const;
};

/// How a world is run: what overrides the world file, and where results go.
struct RunSettings {
  std::optional<std::uint64_t> seed;
  std::optional<double> duration_s;  ///< > 0
  std::optional<sim::TimeMode> time_mode;
  double time_factor = 1.0;                 ///< with kPaced: simulated seconds a wall second
  std::string output_folder;                ///< "": nothing is written
  std::string film;                         ///< .mp4, .avi, or a folder that gets PNGs; "": no film
  double film_fps = 25.0;                   ///< frames a second of the film, 1..240
  double film_speed = 1.0;                  ///< simulated seconds a second of the film, 0.01..1000
  std::optional<double> snapshot_period_s;  ///< simulated time between pictures in the output
                                            ///< folder's snapshots/, 0.001..1e9
  std::optional<int> clients;  ///< of the start gate, 1..1000: time waits until as many have joined
  std::optional<sim::ViewMode> view_mode;   ///< at the start, instead of the world's
  std::vector<InterfaceChoice> interfaces;  ///< instead of the world's order of devices
  /// Descriptor of a socket to a process that shows the run's window (playerlike/view/protocol.h).
  std::optional<int> view_socket;
  bool start_at_once = false;  ///< paced time does not wait for the first client (unless the
                               ///< world's start gate asks for more than one)
  bool progress = false;       ///< a progress line on stderr, if that is a terminal
  bool virtual_time = false;   ///< sleeps of the program move lockstep time (docs/virtual_time.md)
  bool quiet_end = false;      ///< an uncaught end-of-run error ends the program with status 0
  /// Bytes of the output folder that the pictures, maps and logs of one client may fill, and those
  /// of all; bytes of the film.
  std::uint64_t client_files_limit = std::uint64_t{256} << 20U;
  std::uint64_t all_files_limit = std::uint64_t{1} << 30U;
  std::uint64_t film_limit = std::uint64_t{4} << 30U;
  /// File of a KeptRun, into which the host writes what the process that started the program needs
  /// when the program has died; "": none.
  std::string kept_run;
  /// Wall time after which a thinking client stops counting, and processor time after which a
  /// program that has let no simulated time pass is told so [s].
  double silence_limit_s = 5.0;

  /// Whom the report must satisfy: PLAYPEN_GRADE gives the nonce, and who loads the world the rest.
  Grading grading;

  /// From the environment: PLAYPEN_SEED, PLAYPEN_DURATION, PLAYPEN_TIME (lockstep, real or a
  /// factor), PLAYPEN_OUT, PLAYPEN_RECORD, PLAYPEN_RECORD_FPS, PLAYPEN_RECORD_SPEED,
  /// PLAYPEN_SNAPSHOT_EVERY, PLAYPEN_CLIENTS, PLAYPEN_VIEW_MODE (ground, mini-map or full-screen),
  /// PLAYPEN_VIEW (a descriptor's number), PLAYPEN_PROGRESS, PLAYPEN_RUN, PLAYPEN_VIRTUAL_TIME,
  /// PLAYPEN_SILENCE_LIMIT, PLAYPEN_GRADE, PLAYPEN_INTERFACES (choices, separated by commas).
  /// @throws sim::ConfigError naming the variable, what it should be and what it is.
  [[nodiscard]] static RunSettings from_environment();

  /// Puts seed, duration, time mode, clients, view mode and interfaces into the world.
  /// @throws sim::ConfigError run/view_mode_locked if the world locks another view mode;
  ///         run/interface for each choice of an interface that the world's robots cannot follow.
  void apply_to(sim::WorldDescription& world) const;
};

/// Reads "lockstep", "real" or a factor > 0 (e.g. "10") into mode and factor.
/// @return whether the text is one of these.
[[nodiscard]] bool parse_time_mode(const std::string& text, sim::TimeMode& mode, double& factor);

/// Reads a number of clients, 1..1000. @return whether the text is such a number.
[[nodiscard]] bool parse_clients(const std::string& text, int& clients);

/// Reads "[ROBOT.]INTERFACE:INDEX=DEVICE". @return whether the text has this form.
[[nodiscard]] bool parse_interface_choice(const std::string& text, InterfaceChoice& choice);

/// Gives devices the indices that choices name; the other devices of the interface keep their
/// order. A choice without a robot holds for each robot that has the device.
/// @throws sim::ConfigError run/interface for each unknown robot, interface or device, an index
///         that the robot does not have, and an index or device that is chosen twice.
void apply_interface_choices(sim::WorldDescription& world,
                             const std::vector<InterfaceChoice>& choices);

/// Reads frames a second of a film, 1..240. @return whether the text is such a number.
[[nodiscard]] bool parse_film_fps(const std::string& text, double& frames_per_second);
/// Reads simulated seconds a second of a film, 0.01..1000. @return whether the text is such a
/// number.
[[nodiscard]] bool parse_film_speed(const std::string& text, double& speed);
/// Reads simulated seconds between pictures, 0.001..1e9. @return whether the text is such a number.
[[nodiscard]] bool parse_snapshot_period(const std::string& text, double& period_s);

/// What parse_clients() takes, in words for messages.
inline constexpr const char* kClientsExpected = "a whole number from 1 to 1000";
/// What parse_interface_choice() takes, in words for messages.
inline constexpr const char* kInterfaceChoiceExpected =
    "[ROBOT.]INTERFACE:INDEX=DEVICE, such as ranger:0=laser or r1.ranger:0=laser";
/// What parse_film_fps() takes, in words for messages.
inline constexpr const char* kFilmFpsExpected = "a number of frames a second from 1 to 240";
/// What parse_film_speed() takes, in words for messages.
inline constexpr const char* kFilmSpeedExpected = "a number from 0.01 to 1000";
/// What parse_snapshot_period() takes, in words for messages.
inline constexpr const char* kSnapshotPeriodExpected = "a number of seconds from 0.001 to 1e9";
/// What names a film, in words for messages; see sim::render::FilmWriter.
inline constexpr const char* kFilmExpected =
    "a file ending in .mp4 or .avi, or a folder: a name without an ending, or with a slash at its "
    "end";
/// What sim::parse_view_mode() takes, in words for messages.
inline constexpr const char* kViewModeExpected = "ground, mini-map or full-screen";

}  // namespace playerlike
