// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "temporary_folder.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Pair;
using testing::ThrowsMessage;
using testing::UnorderedElementsAre;

TEST(RunEnvironment, RemovesWhatIsNotSet) {
  EXPECT_THAT(run_environment("", RunSettings{}),
              UnorderedElementsAre(
                  Pair("PLAYPEN_WORLD", std::nullopt), Pair("PLAYPEN_OUT", std::nullopt),
                  Pair("PLAYPEN_RECORD", std::nullopt), Pair("PLAYPEN_SEED", std::nullopt),
                  Pair("PLAYPEN_DURATION", std::nullopt), Pair("PLAYPEN_TIME", std::nullopt),
                  Pair("PLAYPEN_PROGRESS", std::nullopt), Pair("PLAYPEN_RUN", std::nullopt)));
}

TEST(RunEnvironment, MakesPathsAbsolute) {
  RunSettings settings;
  settings.output_folder = "a/../out";
  settings.film = "/films/./run.mp4";
  const EnvironmentChanges changes = run_environment("world.json", settings);
  EXPECT_EQ(changes.at("PLAYPEN_WORLD"), (fs::current_path() / "world.json").string());
  EXPECT_EQ(changes.at("PLAYPEN_OUT"), (fs::current_path() / "out").string());
  EXPECT_EQ(changes.at("PLAYPEN_RECORD"), "/films/run.mp4");
}

/// Sets variables of this process, and puts them back.
class ScopedEnvironment {
 public:
  explicit ScopedEnvironment(const EnvironmentChanges& changes) {
    for (const auto& [name, value] : changes) {
      const char* old = std::getenv(name.c_str());
      old_[name] = old != nullptr ? std::optional<std::string>(old) : std::nullopt;
      set(name, value);
    }
  }
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;
  ~ScopedEnvironment() {
    for (const auto& [name, value] : old_) set(name, value);
  }

 private:
  static void set(const std::string& name, const std::optional<std::string>& value) {
    if (value) {
      setenv(name.c_str(), value->c_str(), 1);
    } else {
      unsetenv(name.c_str());
    }
  }
  EnvironmentChanges old_;
};

TEST(RunEnvironment, IsReadBackAsTheSameSettings) {
  RunSettings settings;
  settings.seed = 18446744073709551615U;  // 2^64 - 1: a double could not hold it
  settings.duration_s = 0.1;              // no finite binary fraction: must survive the text
  settings.time_mode = sim::TimeMode::kPaced;
  settings.time_factor = 2.5;
  settings.output_folder = "/out";
  settings.film = "/film.mp4";
  settings.progress = true;
  settings.quiet_end = true;
  const ScopedEnvironment environment(run_environment("/world.json", settings));
  const RunSettings read = RunSettings::from_environment();
  EXPECT_EQ(read.seed, settings.seed);
  EXPECT_EQ(read.duration_s, settings.duration_s);
  EXPECT_EQ(read.time_mode, settings.time_mode);
  EXPECT_EQ(read.time_factor, settings.time_factor);
  EXPECT_EQ(read.output_folder, settings.output_folder);
  EXPECT_EQ(read.film, settings.film);
  EXPECT_EQ(read.progress, settings.progress);
  EXPECT_EQ(read.quiet_end, settings.quiet_end);
}

TEST(RunEnvironment, LockstepIsReadBackAsLockstep) {
  RunSettings settings;
  settings.time_mode = sim::TimeMode::kLockstep;
  const ScopedEnvironment environment(run_environment("", settings));
  EXPECT_EQ(RunSettings::from_environment().time_mode, sim::TimeMode::kLockstep);
}

TEST(FindProgram, TakesANameWithASlashAsAPath) {
  EXPECT_EQ(find_program("/bin/sh"), "/bin/sh");
  EXPECT_THAT([] { static_cast<void>(find_program("./no/such/program")); },
              ThrowsMessage<ProgramError>(HasSubstr("there is no program './no/such/program'")));
}

TEST(FindProgram, LooksInTheFoldersOfPathInOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"first/tool", "second/tool"}) {
    fs::permissions(folder.write(name, "#!/bin/sh\n"), fs::perms::owner_all);
  }
  // Not executable, so that it is passed over.
  folder.write("zeroth/tool", "text");
  const ScopedEnvironment environment(
      {{"PATH", folder / "zeroth" + ":" + folder / "first" + ":" + folder / "second"}});
  EXPECT_EQ(find_program("tool"), folder / "first/tool");
  EXPECT_THAT([] { static_cast<void>(find_program("tol")); },
              ThrowsMessage<ProgramError>(HasSubstr("'tol' on the PATH")));
}

TEST(FindProgram, RefusesFoldersAndTheEmptyName) {
  EXPECT_THAT([] { static_cast<void>(find_program("/")); },
              ThrowsMessage<ProgramError>(HasSubstr("is a folder")));
  EXPECT_THAT([] { static_cast<void>(find_program("")); },
              ThrowsMessage<ProgramError>(HasSubstr("empty")));
}

TEST(RunProgram, TellsHowItEnded) {
  const ProgramEnd fine = run_program({"/bin/sh", "-c", "exit 0"}, {});
  EXPECT_TRUE(fine.success());
  const ProgramEnd failed = run_program({"/bin/sh", "-c", "exit 42"}, {});
  EXPECT_FALSE(failed.success());
  EXPECT_EQ(failed.text(), "ended with status 42");
  const ProgramEnd killed = run_program({"/bin/sh", "-c", "kill -TERM $$"}, {});
  EXPECT_FALSE(killed.success());
  EXPECT_EQ(killed.signal, SIGTERM);
  EXPECT_EQ(killed.text(), "was ended by signal 15 (Terminated)");
}

TEST(RunProgram, ChangesTheEnvironmentOfTheProgramAlone) {
  const ScopedEnvironment environment({{"PLAYPEN_TEST_OLD", "old"}, {"PLAYPEN_TEST_GONE", "gone"}});
  const ProgramEnd end =
      run_program({"/bin/sh", "-c",
                   "test \"$PLAYPEN_TEST_OLD$PLAYPEN_TEST_NEW${PLAYPEN_TEST_GONE-none}\""
                   " = oldnewnone"},
                  {{"PLAYPEN_TEST_NEW", "new"}, {"PLAYPEN_TEST_GONE", std::nullopt}});
  EXPECT_TRUE(end.success()) << end.text();
  EXPECT_EQ(std::getenv("PLAYPEN_TEST_NEW"), nullptr);
}

TEST(RunProgram, LeavesTheSignalMaskAsItWas) {
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, nullptr, &before);
  EXPECT_TRUE(run_program({"/bin/sh", "-c", "exit 0"}, {}).success());
  sigset_t after;
  pthread_sigmask(SIG_BLOCK, nullptr, &after);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGCHLD}) {
    EXPECT_EQ(sigismember(&after, signal), sigismember(&before, signal)) << signal;
  }
}

TEST(RunProgram, ThrowsIfTheProgramCannotBeStarted) {
  const TemporaryFolder folder;
  const std::string script = folder.write("script", "#!/no/such/interpreter\n");
  fs::permissions(script, fs::perms::owner_all);
  EXPECT_THAT([&] { static_cast<void>(run_program({script}, {})); },
              ThrowsMessage<ProgramError>(HasSubstr("can't be started")));
}

}  // namespace
}  // namespace playerlike
