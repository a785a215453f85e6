// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "playerlike/host/kept_run.h"
#include "playerlike/host/run_settings.h"

namespace playerlike {

/// Stops the motors of the real robots of a run whose program has died before it could: connects to
/// their servers, all at the same time, for about a second at most. Does nothing after the end of
/// the run, at which the program has stopped them.
/// @param tell  receives a text for the user for each robot that could not be stopped.
/// @pre The program has ended.
void stop_real_robots(const KeptRun& kept, const OpenRealRobot& open,
                      const std::function<void(const std::string&)>& tell);

}  // namespace playerlike
