// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Player's C++ client library: the one header that client programs include.

#include "libplayerc++/aioproxy.h"
#include "libplayerc++/blinkenlightproxy.h"
#include "libplayerc++/clientproxy.h"
#include "libplayerc++/dioproxy.h"
#include "libplayerc++/graphics2dproxy.h"
#include "libplayerc++/laserproxy.h"
#include "libplayerc++/logproxy.h"
#include "libplayerc++/mapproxy.h"
#include "libplayerc++/mutex.h"
#include "libplayerc++/opaqueproxy.h"
#include "libplayerc++/playerbase.h"
#include "libplayerc++/playerclient.h"
#include "libplayerc++/playerconstants.h"
#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "libplayerc++/position2dproxy.h"
#include "libplayerc++/readsignal.h"
#include "libplayerc++/simulationproxy.h"
#include "libplayerc++/speechproxy.h"
#include "libplayerc++/utility.h"
