// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/host/grading.h"
#include "sim/core/log.h"
#include "sim/render/render.h"
#include "sim/world/description.h"

namespace playerlike {

class Session;
struct HostState;

/// Where a real robot is.
struct RealRobotPlace {
  std::string server;       ///< "player://..." or "tcp://..."
  int port = 0;             ///< Player port of the robot at a Playpen server
  double timeout_s = 10.0;  ///< of connecting [s]
};
/// Connects to a real robot: opens a session with its server. It throws SessionError if that fails.
using OpenRealRobot = std::function<std::unique_ptr<Session>(const RealRobotPlace& place)>;

/// Binds a robot of the world to a real one. It overrides the server in the world.
struct RealRobotChoice {
  std::string robot;   ///< name
  std::string server;  ///< as sim::RealRobotDescription::server

  /// Returns the choice as text: "r1=player://host:6665".
  [[nodiscard]] std::string text() const { return robot + '=' + server; }
};

/// Selects the device with an interface and index. It overrides the world's order.
struct InterfaceChoice {
  std::string robot;      ///< name; "": each robot that has the device
  std::string interface;  ///< e.g. "ranger"
  int index = 0;          ///< on the robot's own port, from 0
  std::string device;     ///< e.g. "laser"

  /// Returns the choice as text: "ranger:0=laser" or "r1.ranger:0=laser".
  [[nodiscard]] std::string text() const;
};

/// Returns the default of RunSettings::pictures: a film's longer side has 800 pixels.
[[nodiscard]] inline sim::render::RenderOptions default_pictures() {
  sim::render::RenderOptions options;
  options.size_px = 800;
  return options;
}

/// What happens at a simulated time of a run in lockstep, before the step that follows.
struct RunStop {
  enum class Then {
    kDebug,  ///< the program stops in its debugger, if it has one
    kView,   ///< the window pauses the run; until then the run has full speed
  };
  double time_s = 0.0;  ///< 0..1e9; the first step at or after it counts
  Then then = Then::kDebug;
};

/// Settings of a run: overrides of the world file, and the destination of the results.
struct RunSettings {
  std::optional<std::uint64_t> seed;
  std::optional<double> duration_s;  ///< > 0
  std::optional<sim::TimeMode> time_mode;
  double time_factor = 1.0;   ///< with kPaced: simulated seconds per wall second
  std::string output_folder;  ///< "": nothing is written
  std::string film;           ///< .mp4 or .avi file, or folder for PNGs; "": no film
  double film_fps = 25.0;     ///< frames per second of the film, 1..240
  double film_speed = 1.0;    ///< simulated seconds per second of film, 0.01..1000
  /// Simulated time at which the film begins, and at which a run in lockstep that is shown in a
  /// window slows down for its viewers [s], 0..1e9.
  double film_from_s = 0.0;
  /// Contents of pictures and films. size_px, width_px and height_px are the size of the film; the
  /// default of its longer side is 800.
  sim::render::RenderOptions pictures = default_pictures();
  std::optional<double> snapshot_period_s;  ///< simulated time between pictures in the output
                                            ///< folder's snapshots/ [s], 0.001..1e9
  std::optional<int> clients;  ///< start gate, 1..1000: time starts when this number of clients has
                               ///< joined
  std::optional<sim::ViewMode> view_mode;  ///< initial view mode; overrides the world's
  std::optional<sim::Realism> realism;     ///< level of realism; overrides the world's
  std::optional<int> robot_port;  ///< the lowest Player port of a robot, see parse_robot_port();
                                  ///< the others keep their distance to it
  std::vector<InterfaceChoice> interfaces;   ///< override the world's order of devices
  std::vector<RealRobotChoice> real_robots;  ///< override the world's "real"
  bool take_over = false;  ///< real robots from other clients that are in charge of them
  /// Connects to the real robots of the world; empty: a world with real robots is refused.
  OpenRealRobot open_real_robot;
  /// The results are report.json and trajectory.csv only, for searches over very many runs.
  bool figures_only = false;
  /// Descriptor of a socket to a process that shows the run's window (playerlike/view/protocol.h).
  std::optional<int> view_socket;
  /// Descriptor of a socket to a process that offers the run's page (playerlike/page/protocol.h).
  std::optional<int> page_socket;
  /// First port of Player's protocol, by which other programs look on (docs/player_wire.md); 0: any
  /// free ports; nullopt: none. Hosts ignore it; see host/stepping/onlookers.h.
  std::optional<int> player_port;
  bool start_at_once = false;  ///< paced time does not wait for the first client (unless the
                               ///< world's start gate is larger than 1)
  bool progress = false;       ///< prints a progress line on stderr, if stderr is a terminal
  bool virtual_time = false;   ///< sleeps advance lockstep time (docs/virtual_time.md)
  bool quiet_end = false;      ///< an uncaught end-of-run error ends the program with status 0
  /// Maximum size of one client's pictures, maps and logs in the output folder, of all clients'
  /// together, and of the film [bytes].
  std::uint64_t client_files_limit = std::uint64_t{256} << 20U;
  std::uint64_t all_files_limit = std::uint64_t{1} << 30U;
  std::uint64_t film_limit = std::uint64_t{4} << 30U;
  /// File of a KeptRun; "": none. The host writes data there that the starting process needs if the
  /// program dies.
  std::string kept_run;
  /// File with a snapshot of the world (sim::Snapshot) in which the run begins, with the snapshot's
  /// clock; "": the run begins at the beginning.
  std::string start_state;
  /// State in which the run begins, as for start_state but from Host::save() of a run of the same
  /// world and seed; null: none. Its commands are executed before the first step.
  std::shared_ptr<const HostState> start;
  std::optional<RunStop> stop;
  /// Wall time after which the lockstep no longer waits for a silent client, and processor time
  /// after which a program gets a warning that it lets no simulated time pass [s].
  double silence_limit_s = 5.0;

  /// Data for the grader. PLAYPEN_GRADE sets the nonce and PLAYPEN_TASK the rules; the code that
  /// loads the world sets the rest.
  Grading grading;

  /// Reads the settings from the environment: PLAYPEN_SEED, PLAYPEN_DURATION, PLAYPEN_TIME
  /// (lockstep, real or a factor), PLAYPEN_OUT, PLAYPEN_RECORD, PLAYPEN_RECORD_FPS,
  /// PLAYPEN_RECORD_SPEED, PLAYPEN_RECORD_FROM, PLAYPEN_RECORD_SIZE, PLAYPEN_FOLLOW, PLAYPEN_CROP,
  /// PLAYPEN_HIDE, PLAYPEN_COLOUR_BY, PLAYPEN_SNAPSHOT_EVERY, PLAYPEN_CLIENTS, PLAYPEN_VIEW_MODE
  /// (ground, mini-map or full-screen), PLAYPEN_REALISM (ideal, course or real), PLAYPEN_VIEW
  /// and PLAYPEN_PAGE (descriptors' numbers), PLAYPEN_PROGRESS, PLAYPEN_RESULTS (figures),
  /// PLAYPEN_RUN, PLAYPEN_VIRTUAL_TIME, PLAYPEN_SILENCE_LIMIT, PLAYPEN_PORT, PLAYPEN_PLAYER_PORT,
  /// PLAYPEN_GRADE, PLAYPEN_TASK, PLAYPEN_START (a snapshot's file), PLAYPEN_UNTIL (seconds) with
  /// PLAYPEN_THEN (debug or view), PLAYPEN_TAKE_OVER, PLAYPEN_INTERFACES and PLAYPEN_REAL (choices,
  /// separated by commas).
  /// @throws sim::ConfigError naming the variable, the expected value and the actual value.
  [[nodiscard]] static RunSettings from_environment();

  /// Applies seed, duration, time mode, clients, view mode, realism, interfaces, real robots and
  /// port to the world. A world with real robots gets real time.
  /// @throws sim::ConfigError run/view_mode_locked if the world locks another view mode; run/follow
  ///         if the world does not contain the robot to follow; run/crop if the part to show does
  ///         not overlap the floor; run/interface for each choice of an interface that does not
  ///         match the world's robots;
  ///         run/port if a robot's port would be above 65535 or kMorsePort;
  ///         run/real for each choice of a real robot that does not; run/real-time if a world with
  ///         real robots is to run in another time than real time.
  void apply_to(sim::WorldDescription& world) const;
};

/// Parses "lockstep", "real" or a factor > 0 (e.g. "10") into mode and factor.
/// @return whether the text is valid.
[[nodiscard]] bool parse_time_mode(const std::string& text, sim::TimeMode& mode, double& factor);

/// Parses a number of clients, 1..1000.
/// @return whether the text is valid.
[[nodiscard]] bool parse_clients(const std::string& text, int& clients);

/// Parses a TCP port, 0..65535. @return whether the text is valid.
[[nodiscard]] bool parse_tcp_port(const std::string& text, int& port);

/// Parses the Player port of a robot, 1..65535 except for kMorsePort.
/// @return whether the text is valid.
[[nodiscard]] bool parse_robot_port(const std::string& text, int& port);

/// Parses "[ROBOT.]INTERFACE:INDEX=DEVICE". @return whether the text has this form.
[[nodiscard]] bool parse_interface_choice(const std::string& text, InterfaceChoice& choice);

/// Parses "ROBOT=SERVER". @return whether the text has this form.
[[nodiscard]] bool parse_real_robot(const std::string& text, RealRobotChoice& choice);

/// Assigns the chosen indices to devices. The other devices of the interface keep their order. A
/// choice without a robot applies to each robot that has the device.
/// @throws sim::ConfigError run/interface for each unknown robot, interface or device, each index
///         that the robot does not have, and each index or device that is chosen twice.
void apply_interface_choices(sim::WorldDescription& world,
                             const std::vector<InterfaceChoice>& choices);

/// The value of PLAYPEN_SILENCE_LIMIT, or the default of RunSettings::silence_limit_s if it has no
/// valid one.
[[nodiscard]] double silence_limit_s_of_environment();

/// Parses the frames per second of a film, 1..240.
/// @return whether the text is valid.
[[nodiscard]] bool parse_film_fps(const std::string& text, double& frames_per_second);
/// Parses the simulated seconds per second of film, 0.01..1000.
/// @return whether the text is valid.
[[nodiscard]] bool parse_film_speed(const std::string& text, double& speed);
/// Parses the simulated time at which a film begins, 0..1e9. @return whether the text is valid.
[[nodiscard]] bool parse_film_start(const std::string& text, double& from_s);
/// Parses the simulated time of a RunStop, 0..1e9. @return whether the text is valid.
[[nodiscard]] bool parse_stop_time(const std::string& text, double& time_s);
/// Parses the size of a film: "640x480", or the longer side, "640". Each side is 64..4096 pixels.
/// @return whether the text is valid.
[[nodiscard]] bool parse_film_size(const std::string& text, sim::render::RenderOptions& options);
/// Parses a part of the world, "X,Y,W,H": bottom left corner and size [m].
/// @return whether the text is valid.
[[nodiscard]] bool parse_crop(const std::string& text, sim::render::RenderOptions& options);
/// Parses a robot's name and optionally the width of the part to show [m]: "r1" or "r1,2.5".
/// @return whether the text is valid.
[[nodiscard]] bool parse_follow(const std::string& text, sim::render::RenderOptions& options);
/// Parses the parts that pictures omit, e.g. "fans,labels". @return whether all words are valid.
[[nodiscard]] bool parse_hide(const std::string& text, sim::render::RenderOptions& options);
/// Parses the source of colours: "world", "robot" or "none". @return whether the text is valid.
[[nodiscard]] bool parse_colour_by(const std::string& text, sim::render::RenderOptions& options);
/// Inverse functions of the parsers above: return the text, or "" for the default.
[[nodiscard]] std::string film_size_text(const sim::render::RenderOptions& options);
[[nodiscard]] std::string crop_text(const sim::render::RenderOptions& options);       ///< as above
[[nodiscard]] std::string follow_text(const sim::render::RenderOptions& options);     ///< as above
[[nodiscard]] std::string hide_text(const sim::render::RenderOptions& options);       ///< as above
[[nodiscard]] std::string colour_by_text(const sim::render::RenderOptions& options);  ///< as above
/// Parses the simulated seconds between pictures, 0.001..1e9. @return whether the text is valid.
[[nodiscard]] bool parse_snapshot_period(const std::string& text, double& period_s);

/// Description of the values that parse_clients() accepts, for messages.
inline constexpr const char* kClientsExpected = "a whole number from 1 to 1000";
/// Description of the values that parse_tcp_port() accepts, for messages.
inline constexpr const char* kTcpPortExpected = "a whole number from 0 to 65535";
/// Description of the values that parse_robot_port() accepts, for messages.
inline constexpr const char* kRobotPortExpected =
    "a whole number from 1 to 65535 except for 4000, the port of all robots";
/// Description of the values that parse_interface_choice() accepts, for messages.
inline constexpr const char* kInterfaceChoiceExpected =
    "[ROBOT.]INTERFACE:INDEX=DEVICE, such as ranger:0=laser or r1.ranger:0=laser";
/// Description of the values that parse_real_robot() accepts, for messages.
inline constexpr const char* kRealRobotChoiceExpected =
    "ROBOT=SERVER, such as r1=player://robot.example.org:6665 or r1=tcp://localhost:4000";
/// Description of the values that parse_film_fps() accepts, for messages.
inline constexpr const char* kFilmFpsExpected = "a number of frames a second from 1 to 240";
/// Description of the values that parse_film_speed() accepts, for messages.
inline constexpr const char* kFilmSpeedExpected = "a number from 0.01 to 1000";
/// Description of the values that parse_film_start() accepts, for messages.
inline constexpr const char* kFilmStartExpected = "a number of seconds from 0 to 1e9";
/// Description of the values that parse_stop_time() accepts, for messages.
inline constexpr const char* kStopTimeExpected = "a number of seconds from 0 to 1e9";
/// Description of the values that parse_film_size() accepts, for messages.
inline constexpr const char* kFilmSizeExpected =
    "WIDTHxHEIGHT or the longer side, in pixels from 64 to 4096, such as 640x480";
/// Description of the values that parse_crop() accepts, for messages.
inline constexpr const char* kCropExpected =
    "X,Y,W,H in metres: the bottom left corner, and a width and height above 0, such as 0,0,1.5,1";
/// Description of the values that parse_follow() accepts, for messages.
inline constexpr const char* kFollowExpected =
    "the name of a robot, and maybe the width to show in metres, such as r1 or r1,2.5";
/// Description of the values that parse_hide() accepts, for messages.
inline constexpr const char* kHideExpected =
    "some of fans, trails, labels, goals, collisions, legend, canvas, traps, timers, texts and "
    "scores, with commas between them";
/// Description of the values that parse_colour_by() accepts, for messages.
inline constexpr const char* kColourByExpected = "world, robot or none";
/// Description of the values that parse_snapshot_period() accepts, for messages.
inline constexpr const char* kSnapshotPeriodExpected = "a number of seconds from 0.001 to 1e9";
/// Description of valid film names, for messages; see sim::render::FilmWriter.
inline constexpr const char* kFilmExpected =
    "a file ending in .mp4 or .avi, or a folder: a name without an ending, or with a slash at its "
    "end";
/// Description of the values that sim::parse_realism() accepts, for messages.
inline constexpr const char* kRealismExpected = "ideal, course or real";
/// Description of the values that sim::parse_view_mode() accepts, for messages.
inline constexpr const char* kViewModeExpected = "ground, mini-map or full-screen";

}  // namespace playerlike
