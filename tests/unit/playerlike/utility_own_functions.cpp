// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program with its own functions at global scope, like two existing programs.
#include "libplayerc++/playerc++.h"

using namespace std;
using namespace PlayerCc;

double normalize(double) { return 42.0; }
double limit(double, double, double) { return 43.0; }

// Calls of the program's own functions: none of these names is defined by the library's headers.
SimulationProxy* sim = nullptr;
LaserProxy* laser = nullptr;
int protocol = 0;
int host = 0;
int test = 0;

double normalize_in_a_program_with_its_own(double angle_rad);
double limit_in_a_program_with_its_own(double value);

double normalize_in_a_program_with_its_own(double angle_rad) { return normalize(angle_rad); }
double limit_in_a_program_with_its_own(double value) { return limit(value, 2.0, 3.0); }
