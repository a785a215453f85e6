// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause

// Macros with the same names, as other headers and -DDEBUG define them; logging.h replaces them.
#define DEBUG 1
#define ERROR 0

#include "imr-h/logging.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "temporary_folder.h"

// An operator<< that argument-dependent lookup does not find, as in course programs.
std::ostream& operator<<(std::ostream& out, const std::vector<int>& values);
std::ostream& operator<<(std::ostream& out, const std::vector<int>& values) {
  return out << "vector of " << values.size();
}

namespace {

using imr::logging::Level;
using testing::AllOf;
using testing::HasSubstr;

class Logging : public testing::Test {
 protected:
  void SetUp() override { imr::logging::set_level(Level::kDebug); }
  void TearDown() override {
    unsetenv("IMR_LOG_LEVEL");
    imr::logging::set_level_from_environment();
  }

  template <typename Function>
  static std::string stderr_of(const Function& function) {
    testing::internal::CaptureStderr();
    function();
    return testing::internal::GetCapturedStderr();
  }
};

TEST_F(Logging, Macros_WriteLineWithLevel) {
  const std::string text = stderr_of([] {
    DEBUG("a " << 1);
    INFO("b " << 2.5);
    WARN("c " << 'x');
    ERROR("d " << std::string("text") << " " << true);
  });
  EXPECT_EQ(text, "[DEBUG] a 1\n[INFO] b 2.5\n[WARN] c x\n[ERROR] d text 1\n");
}

TEST_F(Logging, Macros_AcceptSpacesCommasManipulatorsAndLocalOperators) {
  const std::vector<int> values = {1, 2};
  const std::string text = stderr_of([&] {
    // clang-format off
    DEBUG ("spaced");
    // clang-format on
    INFO(std::setw(4) << 7 << std::hex << " " << 255);
    INFO(values << ", " << std::map<int, int>{{1, 2}, {3, 4}}.size());
  });
  EXPECT_EQ(text, "[DEBUG] spaced\n[INFO]    7 ff\n[INFO] vector of 2, 2\n");
}

TEST_F(Logging, TrailingLineEnds_Dropped) {
  EXPECT_EQ(stderr_of([] {
              INFO("one" << std::endl);
              INFO("two\r\n\n");
              INFO("");
            }),
            "[INFO] one\n[INFO] two\n[INFO] \n");
}

TEST_F(Logging, DisabledLevel_NeitherPrintedNorEvaluated) {
  imr::logging::set_level(Level::kWarn);
  int evaluated = 0;
  const std::string text = stderr_of([&] {
    DEBUG("no " << ++evaluated);
    INFO("no " << ++evaluated);
    WARN("yes " << ++evaluated);
    ERROR("yes " << ++evaluated);
  });
  EXPECT_EQ(text, "[WARN] yes 1\n[ERROR] yes 2\n");
}

TEST_F(Logging, Off_SilencesErrors) {
  imr::logging::set_level(Level::kOff);
  int evaluated = 0;
  EXPECT_EQ(stderr_of([&] { ERROR(++evaluated); }), "");
  EXPECT_EQ(evaluated, 0);
  EXPECT_FALSE(imr::logging::enabled(Level::kOff));
}

TEST_F(Logging, ThrowingText_NotPrinted) {
  const auto fail = []() -> int { throw std::runtime_error("inside"); };
  EXPECT_EQ(stderr_of([&] { EXPECT_THROW(INFO("half " << fail()), std::runtime_error); }), "");
}

TEST_F(Logging, IsOneStatement) {
  const std::string text = stderr_of([] {
    const bool is_late = false;
    if (is_late)
      ERROR("late");
    else
      INFO("in time");
  });
  EXPECT_EQ(text, "[INFO] in time\n");
}

TEST_F(Logging, DefaultLevel_IsInfo) {
  unsetenv("IMR_LOG_LEVEL");
  imr::logging::set_level_from_environment();
  EXPECT_EQ(imr::logging::current_level(), Level::kInfo);
  setenv("IMR_LOG_LEVEL", "", 1);
  imr::logging::set_level_from_environment();
  EXPECT_EQ(imr::logging::current_level(), Level::kInfo);
}

TEST_F(Logging, EnvironmentLevel_OverriddenByFunction) {
  setenv("IMR_LOG_LEVEL", "Error", 1);
  imr::logging::set_level_from_environment();
  EXPECT_EQ(imr::logging::current_level(), Level::kError);
  imr::logging::set_level(Level::kDebug);
  EXPECT_EQ(imr::logging::current_level(), Level::kDebug);
}

TEST_F(Logging, UnknownEnvironmentLevel_Reported) {
  setenv("IMR_LOG_LEVEL", "loud", 1);
  const std::string text = stderr_of([] { imr::logging::set_level_from_environment(); });
  EXPECT_THAT(text, HasSubstr("[WARN] IMR_LOG_LEVEL is 'loud'"));
  EXPECT_EQ(imr::logging::current_level(), Level::kInfo);
}

TEST_F(Logging, ParseLevel_KnownWordsOnly) {
  const std::map<std::string, Level> known = {{"debug", Level::kDebug}, {"INFO", Level::kInfo},
                                              {"warn", Level::kWarn},   {"Warning", Level::kWarn},
                                              {"error", Level::kError}, {"off", Level::kOff},
                                              {"none", Level::kOff}};
  for (const auto& entry : known) {
    Level level = entry.second == Level::kDebug ? Level::kOff : Level::kDebug;
    EXPECT_TRUE(imr::logging::parse_level(entry.first, level)) << entry.first;
    EXPECT_EQ(level, entry.second) << entry.first;
  }
  for (const char* unknown : {"", "inf", "info ", "0", "errors"}) {
    Level level = Level::kWarn;
    EXPECT_FALSE(imr::logging::parse_level(unknown, level)) << unknown;
    EXPECT_EQ(level, Level::kWarn) << unknown;
  }
}

TEST_F(Logging, LinesOfThreads_DoNotMix) {
  constexpr int kThreads = 4;
  constexpr int kLines = 200;
  const std::string filler(100, '.');
  const std::string text = stderr_of([&] {
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) {
      threads.emplace_back([i, &filler] {
        for (int j = 0; j < kLines; ++j) {
          INFO(i << " " << j << " " << filler);
          imr::logging::set_level(Level::kDebug);
        }
      });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
  });
  // Each thread's lines arrive complete and in order.
  std::vector<int> next(kThreads, 0);
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string tag;
    std::string rest;
    int thread = -1;
    int number = -1;
    words >> tag >> thread >> number >> rest;
    ASSERT_TRUE(thread >= 0 && thread < kThreads) << line;
    EXPECT_EQ(number, next[static_cast<std::size_t>(thread)]++) << line;
    EXPECT_EQ(line,
              "[INFO] " + std::to_string(thread) + " " + std::to_string(number) + " " + filler);
  }
  EXPECT_EQ(next, std::vector<int>(kThreads, kLines));
}

class Loggers : public Logging {
 protected:
  void TearDown() override {
    imr::initLogger("root");
    Logging::TearDown();
  }
  // The output of initLogger() with a configuration of this text, and the level afterwards.
  std::pair<std::string, Level> with_configuration(const std::string& text) {
    const std::string file = folder_.write("log.cfg", text);
    const std::string printed = stderr_of([&] { imr::initLogger("robot", file.c_str()); });
    return {printed, imr::logging::current_level()};
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(Loggers, HaveNames) {
  using imr::logger;
  EXPECT_EQ(logger->getName(), "root");
  imr::initLogger("robot");
  EXPECT_EQ(logger->getName(), "robot");
  imr::initLogger(std::string("planner"));
  EXPECT_EQ(logger->getName(), "planner");
  EXPECT_EQ(logger, imr::getLogger("planner"));
  const imr::CLoggerPtr other = imr::getLogger("map");
  EXPECT_EQ(stderr_of([&] {
              INFO("as ever");
              DEBUG_M(other, "a " << 1);
              INFO_M(other, "b");
              WARN_M(logger, "c");
              ERROR_M(other, "d");
            }),
            "[INFO] as ever\n[DEBUG] map: a 1\n[INFO] map: b\n[WARN] planner: c\n[ERROR] map: d\n");
  imr::shutdownLogger();
}

TEST_F(Loggers, TakeLevelFromConfiguration) {
  const auto level = [&](const std::string& text) {
    imr::logging::set_level(Level::kInfo);
    const auto [printed, found] = with_configuration(text);
    EXPECT_EQ(printed, "");
    return found;
  };
  EXPECT_EQ(level("# log4cxx\nlog4j.rootLogger=DEBUG, A1\nlog4j.appender.A1=x\n"), Level::kDebug);
  EXPECT_EQ(level("log4j.appender.A1=x\n  log4j.rootLogger = WARN , A1"), Level::kWarn);
  EXPECT_EQ(level("log4j.rootCategory=FATAL\n"), Level::kError);
  EXPECT_EQ(level("log4j.rootLogger=all\r\n"), Level::kDebug);
  EXPECT_EQ(level("log4j.rootLogger=OFF\n"), Level::kOff);
  EXPECT_EQ(imr::logger->getName(), "robot");
}

TEST_F(Loggers, InvalidConfiguration_KeepsLevel) {
  imr::logging::set_level(Level::kInfo);
  EXPECT_THAT(with_configuration("log4j.rootLogger=LOUD, A1\n").first,
              AllOf(HasSubstr("[WARN]"), HasSubstr("log.cfg"), HasSubstr("'LOUD'")));
  EXPECT_THAT(with_configuration("log4j.appender.A1=x\n").first, HasSubstr("log4j.rootLogger="));
  EXPECT_THAT(stderr_of([] { imr::initLogger("robot", "/nowhere/log.cfg"); }),
              AllOf(HasSubstr("/nowhere/log.cfg"), HasSubstr("read")));
  EXPECT_EQ(stderr_of([] {
              imr::initLogger("robot", "");
              imr::initLogger("robot", nullptr);
            }),
            "");
  EXPECT_EQ(imr::logging::current_level(), Level::kInfo);
}

TEST_F(Loggers, EnvironmentLevel_Kept) {
  setenv("IMR_LOG_LEVEL", "error", 1);
  imr::logging::set_level_from_environment();
  EXPECT_EQ(with_configuration("log4j.rootLogger=DEBUG\n").second, Level::kError);
}

}  // namespace
