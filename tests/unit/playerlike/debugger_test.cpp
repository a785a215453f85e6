// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/debugger.h"

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <string>

namespace playerlike {
namespace {

/// The tracer of this process, if the test itself is debugged.
int own_tracer() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "TracerPid:") {
  }
  int tracer = -1;
  status >> tracer;
  return tracer;
}

TEST(TracerOf, ThisProcess_ByNumberAndByZero) {
  EXPECT_EQ(tracer_of(0), own_tracer());
  EXPECT_EQ(tracer_of(getpid()), own_tracer());
}

TEST(TracerOf, TracedChild_HasThisTracer) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(77);
    raise(SIGSTOP);
    _exit(0);
  }
  int state = 0;
  ASSERT_EQ(waitpid(child, &state, WUNTRACED), child);
  if (WIFEXITED(state)) GTEST_SKIP() << "tracing is not allowed here";
  EXPECT_EQ(tracer_of(child), getpid());
  ptrace(PTRACE_DETACH, child, nullptr, nullptr);
  ASSERT_EQ(waitpid(child, &state, 0), child);
  EXPECT_EQ(tracer_of(child), 0) << "the process has ended";
}

}  // namespace
}  // namespace playerlike
