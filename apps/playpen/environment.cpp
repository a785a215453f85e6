// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "environment.h"

namespace playpen {

const std::vector<EnvironmentVariable>& environment_variables() {
  static const auto* const variables = new std::vector<EnvironmentVariable>{
      {"IMR_LOG_LEVEL", "The least level of the lines that imr-h's log shows: debug, info, ...",
       false},
      {"NO_COLOR", "If it is set, the command prints no colours.", false},
      {"PLAYPEN_CLIENTS", "How many clients must have joined before simulated time begins.", true},
      {"PLAYPEN_DESK", "Where the programs of a run ask for its world.", true},
      {"PLAYPEN_DURATION", "Simulated seconds after which a run ends.", true},
      {"PLAYPEN_ENCODING", "How a program talks to a server: cbor or json.", false},
      {"PLAYPEN_GRADE", "The number by which a grader knows the report of a run.", true},
      {"PLAYPEN_INTERFACES", "Which device answers as which interface and index.", true},
      {"PLAYPEN_LIBRARIES",
       "The folder of the modules that draw letters and encode films, where they do not lie beside "
       "Playpen's own libraries.",
       false},
      {"PLAYPEN_OUT", "The folder for results.", true},
      {"PLAYPEN_PLAYER_PORT",
       "The first port of Player's protocol, by which other programs look on at the run.", true},
      {"PLAYPEN_PORT", "The Player port of the first robot; others keep their distance to it.",
       true},
      {"PLAYPEN_PREPARED",
       "The number of the descriptor over which copies of the program are started.", true},
      {"PLAYPEN_PROGRESS", "If it is 1, a line on the terminal shows the progress.", true},
      {"PLAYPEN_REAL", "The real robots that robots of the world mirror.", true},
      {"PLAYPEN_REALISM", "The level of realism: ideal, course or real.", true},
      {"PLAYPEN_RECORD", "The film to record.", true},
      {"PLAYPEN_RECORD_FPS", "Frames per second of the film.", true},
      {"PLAYPEN_RECORD_FROM", "Simulated time at which the film begins [s].", true},
      {"PLAYPEN_RECORD_SPEED", "Simulated seconds per second of the film.", true},
      {"PLAYPEN_RECORD_SIZE", "Size of the film in pixels, such as 640x480.", true},
      {"PLAYPEN_FOLLOW", "The robot that pictures follow.", true},
      {"PLAYPEN_CROP", "The part of the world that pictures show.", true},
      {"PLAYPEN_HIDE", "What pictures leave out.", true},
      {"PLAYPEN_COLOUR_BY", "Where pictures take the robots' colours from.", true},
      {"PLAYPEN_RESULTS", "If it is figures, a run writes no pictures and no recording.", true},
      {"PLAYPEN_RUN", "If it is 1, a program that the end of the run ends has status 0.", true},
      {"PLAYPEN_SEED", "The seed of all noise.", true},
      {"PLAYPEN_SILENCE_LIMIT",
       "Wall-clock seconds after which a client that does not read no longer holds up the others.",
       false},
      {"PLAYPEN_SNAPSHOT_EVERY", "Simulated seconds between pictures.", true},
      {"PLAYPEN_START", "The file with the state in which the run's world begins.", true},
      {"PLAYPEN_STATE",
       "The file in which a run leaves what playpen run needs if the program dies.", true},
      {"PLAYPEN_TAKE_OVER",
       "If it is 1, real robots are taken over from other clients that are in charge of them.",
       true},
      {"PLAYPEN_TASK", "What the task of a graded run lets the program use.", true},
      {"PLAYPEN_THEN", "What happens at the time of PLAYPEN_UNTIL: debug or view.", true},
      {"PLAYPEN_TIME", "lockstep, real, or a factor of real time.", true},
      {"PLAYPEN_TOKEN", "The token that a program presents to a server.", false},
      {"PLAYPEN_UNTIL", "Simulated time at which the run stops for a debugger or viewer [s].",
       true},
      {"PLAYPEN_PAGE", "The number of the descriptor that leads to the live page's process.", true},
      {"PLAYPEN_VIEW", "The number of the descriptor that leads to the live window.", true},
      {"PLAYPEN_VIEW_MODE", "How the canvas is shown: ground, mini-map or full-screen.", true},
      {"PLAYPEN_VIRTUAL_TIME", "If it is 1, sleeps of the program are simulated time.", true},
      {"PLAYPEN_WORLD",
       "The world that \"localhost\" means: a file, tcp://HOST[:PORT], unix:PATH or "
       "player://HOST[:PORT].",
       true},
  };
  return *variables;
}

}  // namespace playpen
