// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playpen {

/// A filter of system calls (seccomp(2)) for isolated programs, in the form that bubblewrap's
/// --seccomp takes: an array of `struct sock_filter`.
///
/// It refuses, with EPERM, what a robot's program does not need and what reaches far into the
/// kernel or keeps memory that limits do not see: namespaces, mounts, modules, BPF, io_uring, keys,
/// memory files and shared memory of System V, and characters that are put into a terminal. clone3
/// is "not implemented", because its flags cannot be filtered; C libraries then use clone.
/// Everything else is allowed: the sandbox's namespaces limit it.
[[nodiscard]] std::string syscall_filter();

}  // namespace playpen
