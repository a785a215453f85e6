// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Feature macros that old programs test before they use threads and read signals. Both work here,
/// without Boost.

/// PlayerClient::StartThread(), StopThread() and a working mutex are available.
#ifndef HAVE_BOOST_THREAD
#define HAVE_BOOST_THREAD 1
#endif
/// ClientProxy::ConnectReadSignal() and DisconnectReadSignal() are available.
#ifndef HAVE_BOOST_SIGNALS
#define HAVE_BOOST_SIGNALS 1
#endif
