// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A C++ program that does nothing: the baseline of bench_start.
#include <iostream>

int main() { std::cout.flush(); }
