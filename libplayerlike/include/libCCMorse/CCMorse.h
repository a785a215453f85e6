// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The CCMorse library: the only header that client programs need to include. It includes
/// libplayerc++/playerc++.h, makes Player's classes available in namespace CCMorse too, and defines
/// PI.

#include "libCCMorse/AmclDriver.h"
#include "libCCMorse/ArenaProxy.h"
#include "libCCMorse/ClientProxy.h"
#include "libCCMorse/Drawing.h"
#include "libCCMorse/GridMapLayer.h"
#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/LaserProxy.h"
#include "libCCMorse/LocalDriver.h"
#include "libCCMorse/MapProxy.h"
#include "libCCMorse/MorseActuator.h"
#include "libCCMorse/MorseBattery.h"
#include "libCCMorse/MorseClient.h"
#include "libCCMorse/MorseCollision.h"
#include "libCCMorse/MorseDevice.h"
#include "libCCMorse/MorseError.h"
#include "libCCMorse/MorseGps.h"
#include "libCCMorse/MorseGripper.h"
#include "libCCMorse/MorseImu.h"
#include "libCCMorse/MorseInfrared.h"
#include "libCCMorse/MorseLaser.h"
#include "libCCMorse/MorseLight.h"
#include "libCCMorse/MorseMotionVW.h"
#include "libCCMorse/MorseOdometry.h"
#include "libCCMorse/MorsePen.h"
#include "libCCMorse/MorsePose.h"
#include "libCCMorse/MorseProperties.h"
#include "libCCMorse/MorseProximity.h"
#include "libCCMorse/MorseRobot.h"
#include "libCCMorse/MorseSensor.h"
#include "libCCMorse/MorseSonar.h"
#include "libCCMorse/MorseTeleport.h"
#include "libCCMorse/MorseTime.h"
#include "libCCMorse/MorseWaypoint.h"
#include "libCCMorse/PlayerClient.h"
#include "libCCMorse/Position2dProxy.h"
#include "libCCMorse/SndDriver.h"
#include "libCCMorse/WindowProxy.h"
#include "libplayerc++/playerc++.h"

#ifndef PI
/// The ratio of a circle's circumference to its diameter.
#define PI 3.14159265358979323846
#endif
