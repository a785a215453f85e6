// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's C++ client library: the one header that client programs include.

#include "libplayerc++/bumperproxy.h"
#include "libplayerc++/clientproxy.h"
#include "libplayerc++/fiducialproxy.h"
#include "libplayerc++/gpsproxy.h"
#include "libplayerc++/graphics2dproxy.h"
#include "libplayerc++/imuproxy.h"
#include "libplayerc++/irproxy.h"
#include "libplayerc++/laserproxy.h"
#include "libplayerc++/mapproxy.h"
#include "libplayerc++/mutex.h"
#include "libplayerc++/playerbase.h"
#include "libplayerc++/playerclient.h"
#include "libplayerc++/playerconstants.h"
#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "libplayerc++/position2dproxy.h"
#include "libplayerc++/powerproxy.h"
#include "libplayerc++/rangerproxy.h"
#include "libplayerc++/readsignal.h"
#include "libplayerc++/sonarproxy.h"
#include "libplayerc++/utility.h"
#include "libplayerc++/wifiproxy.h"
