// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "imr-h/thread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cstdlib>
#include <functional>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "imr-h/imr_exceptions.h"
#include "imr-h/logging.h"
#include "libplayerc++/playererror.h"

namespace course {

// Uses the member types unqualified, as programs in other namespaces do.
class Worker : public imr::concurrent::CThread {
 public:
  explicit Worker(std::function<void(Worker&)> body) : body_(std::move(body)) {}
  ~Worker() override {
    stop();
    join();
  }

  void stop() {
    ScopedLock lk(mtx_);
    quit_ = true;
    changed_.notify_all();
  }

  void wait_for_stop() {
    ScopedLock lk(mtx_);
    changed_.wait(lk, [this] { return quit_; });
  }

 protected:
  void threadBody() override { body_(*this); }

 private:
  std::function<void(Worker&)> body_;
  Mutex mtx_;
  Condition changed_;
  bool quit_ = false;
};

}  // namespace course

namespace {

using course::Worker;
using testing::HasSubstr;

// The log of the function and the threads in it, at the default level, independent of the
// environment.
template <typename Function>
std::string stderr_of(const Function& function) {
  imr::logging::set_level(imr::logging::Level::kInfo);
  testing::internal::CaptureStderr();
  function();
  return testing::internal::GetCapturedStderr();
}

TEST(CThread, RunsBodyInOtherThread) {
  std::thread::id body_thread;
  Worker worker([&](Worker&) { body_thread = std::this_thread::get_id(); });
  worker.execute();
  worker.join();
  EXPECT_NE(body_thread, std::thread::id());
  EXPECT_NE(body_thread, std::this_thread::get_id());
}

TEST(CThread, Execute_ReturnsWhileBodyRuns) {
  bool ended = false;
  Worker worker([&](Worker& self) {
    self.wait_for_stop();
    ended = true;
  });
  worker.execute();
  worker.stop();
  worker.join();
  EXPECT_TRUE(ended);
}

TEST(CThread, Join_AllowedTwiceAndWithoutExecute) {
  int runs = 0;
  Worker worker([&](Worker&) { ++runs; });
  worker.join();
  EXPECT_EQ(runs, 0);
  worker.execute();
  worker.join();
  worker.join();
  EXPECT_EQ(runs, 1);
}

TEST(CThread, Join_AllowedFromSeveralThreads) {
  int value = 0;
  Worker worker([&](Worker& self) {
    self.wait_for_stop();
    value = 7;
  });
  worker.execute();
  std::vector<std::future<int>> joiners;
  for (int i = 0; i < 4; ++i) {
    joiners.push_back(std::async(std::launch::async, [&] {
      worker.join();
      return value;
    }));
  }
  worker.stop();
  for (std::future<int>& joiner : joiners) {
    EXPECT_EQ(joiner.get(), 7);
  }
}

TEST(CThread, JoinFromBody_ReturnsWithWarning) {
  const std::string text = stderr_of([] {
    Worker worker([](Worker& self) { self.join(); });
    worker.execute();
    worker.join();
  });
  EXPECT_THAT(text, HasSubstr("[WARN] CThread::join()"));
}

TEST(CThread, ExecuteWhileRunning_Throws) {
  Worker worker([](Worker& self) { self.wait_for_stop(); });
  worker.execute();
  EXPECT_THROW(worker.execute(), imr::exception);
}

TEST(CThread, ExecuteFromBody_Throws) {
  bool refused = false;
  Worker worker([&](Worker& self) {
    try {
      self.execute();
    } catch (const imr::exception&) {
      refused = true;
    }
  });
  worker.execute();
  worker.join();
  EXPECT_TRUE(refused);
}

TEST(CThread, ExecuteAfterEnd_RunsAgain) {
  int runs = 0;
  Worker worker([&](Worker&) { ++runs; });
  for (int i = 0; i < 3; ++i) {
    worker.execute();
    worker.join();
  }
  EXPECT_EQ(runs, 3);
}

TEST(CThread, StandardException_LoggedAsError) {
  const std::string text = stderr_of([] {
    Worker worker([](Worker&) { throw std::runtime_error("wheel lost"); });
    worker.execute();
    worker.join();
  });
  EXPECT_EQ(text, "[ERROR] thread ended by an exception of type std::runtime_error: wheel lost\n");
}

TEST(CThread, ImrException_LoggedAsError) {
  const std::string text = stderr_of([] {
    Worker worker([](Worker&) { throw imr::exception("no map"); });
    worker.execute();
    worker.join();
  });
  EXPECT_EQ(text, "[ERROR] thread ended by an exception of type imr::exception: no map\n");
}

TEST(CThread, OtherException_LoggedWithType) {
  const std::string text = stderr_of([] {
    Worker worker([](Worker&) { throw 42; });
    worker.execute();
    worker.join();
  });
  EXPECT_EQ(text, "[ERROR] thread ended by an exception of type int\n");
}

TEST(CThread, EndOfRun_EndsThreadWithoutMessage) {
  using PlayerCc::PlayerError;
  for (const int code : {PlayerError::kRunIsOver, PlayerError::kDisconnected}) {
    const std::string text = stderr_of([code] {
      Worker worker([code](Worker&) {
        throw PlayerError("PlayerClient::Read", "the simulated run is over", code);
      });
      worker.execute();
      worker.join();
    });
    EXPECT_EQ(text,
              "[INFO] thread ended: its client's session is over (the simulated run is over)\n");
  }
}

// The test identifies them by their type, not by the name of their class.
TEST(CThread, OtherClientErrors_LoggedAsErrors) {
  const std::string text = stderr_of([] {
    Worker worker([](Worker&) {
      throw PlayerCc::PlayerError("LaserProxy::GetRange", "there is no beam 999",
                                  PlayerCc::PlayerError::kBadArgument);
    });
    worker.execute();
    worker.join();
  });
  EXPECT_EQ(text,
            "[ERROR] thread ended by an exception of type PlayerCc::PlayerError: "
            "LaserProxy::GetRange: there is no beam 999\n");
  struct PlayerError : std::runtime_error {
    PlayerError() : std::runtime_error("of the program's own") {}
  };
  EXPECT_THAT(stderr_of([] {
                Worker worker([](Worker&) { throw PlayerError(); });
                worker.execute();
                worker.join();
              }),
              testing::StartsWith("[ERROR] thread ended by an exception of type"));
}

TEST(CThread, ExecuteAfterException_RunsAgain) {
  int runs = 0;
  const std::string text = stderr_of([&] {
    Worker worker([&](Worker&) {
      if (++runs == 1) {
        throw imr::exception("first time");
      }
    });
    worker.execute();
    worker.join();
    worker.execute();
    worker.join();
  });
  EXPECT_EQ(runs, 2);
  EXPECT_THAT(text, HasSubstr("first time"));
}

TEST(CThread, PthreadExit_EndsThread) {
  const std::string text = stderr_of([] {
    Worker worker([](Worker&) { pthread_exit(nullptr); });
    worker.execute();
    worker.join();
  });
  EXPECT_EQ(text, "");
}

TEST(CThread, DerivedDestructor_MayJoin) {
  bool ended = false;
  {
    Worker worker([&](Worker& self) {
      self.wait_for_stop();
      ended = true;
    });
    worker.execute();
  }
  EXPECT_TRUE(ended);
}

TEST(CThread, DeletedThroughBase_Works) {
  const auto token = std::make_shared<int>(0);
  imr::concurrent::CThread* thread = new Worker([token](Worker&) {});
  EXPECT_EQ(token.use_count(), 2);
  delete thread;
  EXPECT_EQ(token.use_count(), 1);
}

TEST(CThread, DeletedByItsOwnThread_Works) {
  const auto deleted = std::make_shared<std::promise<void>>();
  const std::string text = stderr_of([&] {
    Worker* worker = new Worker([deleted](Worker& self) {
      // A copy, because the deletion destroys the captured pointer.
      const std::shared_ptr<std::promise<void>> announced = deleted;
      delete &self;
      announced->set_value();
    });
    worker->execute();
    deleted->get_future().wait();
  });
  EXPECT_THAT(text, HasSubstr("[WARN] CThread::join()"));
}

// GoogleTest runs suites of this name first, before any thread exists.
TEST(CThreadDeathTest, ExitInBody_EndsProcessWithStatus) {
  EXPECT_EXIT(
      {
        // exit() destroys the static object in its own thread.
        static Worker worker([](Worker&) { std::exit(3); });
        worker.execute();
        std::promise<void> never;
        never.get_future().wait();
      },
      testing::ExitedWithCode(3), "");
}

TEST(CThread, Running_TrueUntilEnd) {
  course::Worker worker([](course::Worker& self) { self.wait_for_stop(); });
  EXPECT_FALSE(worker.isRunning());
  EXPECT_FALSE(worker.isFinished());
  worker.execute();
  worker.yield();
  EXPECT_TRUE(worker.isRunning());
  EXPECT_FALSE(worker.isFinished());
  worker.stop();
  worker.join();
  EXPECT_FALSE(worker.isRunning());
  EXPECT_TRUE(worker.isFinished());
}

}  // namespace
