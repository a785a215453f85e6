// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Who commands which robot, and which robots stop when those are gone. Times are given, so nothing
// waits.
#include "host/stepping/commanders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "patient_host.h"
#include "playerlike/host/event_client.h"
#include "playerlike/host/host.h"

namespace playerlike {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using testing::SizeIs;
using testing::ThrowsMessage;
using Kind = Commanders::Kind;

/// Two robots on a floor of 4 m x 4 m. @param real  keys of the first one, with a comma in front.
std::string two_robots(const std::string& real = "") {
  return R"({"arena": {"size": [4, 4]}, "robots": [
    {"name": "r1", "pose": {"x": 1, "y": 1})" +
         real + R"(}, {"name": "r2", "pose": {"x": 1, "y": 3}}]})";
}

class CommandersTest : public testing::Test {
 protected:
  explicit CommandersTest(const std::string& world = two_robots())
      : simulation_(sim::load_world_text(world)),
        robots_(describe_robots(simulation_)),
        commanders_(simulation_, robots_) {}

  [[nodiscard]] DeviceId device(int robot, const std::string& name) const {
    return {robot, *simulation_.find_device(robot, name)};
  }
  void open(Client& client, int robot) {
    Client::Subscription subscription;
    subscription.device = device(robot, "pose");
    client.subscriptions.push_back(subscription);
    commanders_.note_opened(client, subscription.device);
  }
  [[nodiscard]] std::vector<int> close(Client& client, int robot) {
    client.subscriptions.clear();
    return commanders_.note_closed(client, device(robot, "pose"));
  }
  void drive(Commanders::Who who, int robot, Kind kind = Kind::kClient) {
    EXPECT_EQ(commanders_.note(who, device(robot, "motion"), kind), std::nullopt);
  }
  [[nodiscard]] TakeChargeRequest charge(double watchdog_s, const std::string& name = "m",
                                         bool take_over = false) const {
    return {device(0, "motion"), watchdog_s, take_over, name};
  }

  sim::Simulation simulation_;
  std::vector<RobotInfo> robots_;
  Commanders commanders_;
  Client a_;
  Client b_;
  const WallClock::time_point begin_ = WallClock::now();
};

TEST_F(CommandersTest, LastCommanderOrReaderLeaves_RobotStops) {
  drive(&a_, 0);
  open(b_, 0);
  open(a_, 0);
  EXPECT_THAT(commanders_.note_gone(&a_), IsEmpty()) << "as at a Player server";
  EXPECT_THAT(commanders_.note_gone(&b_), ElementsAre(0));
  EXPECT_THAT(commanders_.stop(0), SizeIs(1)) << "the motors";
  EXPECT_THAT(commanders_.note_gone(&b_), IsEmpty()) << "it stands already";
}

TEST_F(CommandersTest, ClosedPosition2d_CountsAsLeaving) {
  open(a_, 1);
  drive(&a_, 1);
  EXPECT_THAT(close(a_, 1), ElementsAre(1));
}

TEST_F(CommandersTest, UncommandedRobot_NotStopped) {
  open(a_, 0);
  EXPECT_THAT(close(a_, 0), IsEmpty());
  EXPECT_EQ(commanders_.note(&a_, device(0, "pen"), Kind::kClient), std::nullopt);
  EXPECT_THAT(commanders_.note_gone(&a_), IsEmpty()) << "a pen moves nothing";
  EXPECT_THAT(commanders_.note_closed(a_, {7, 0}), IsEmpty()) << "there is no such robot";
}

TEST_F(CommandersTest, Watchers_KeepNoRobotDriving) {
  b_.onlooker = true;
  open(b_, 0);
  drive(&a_, 0);
  EXPECT_THAT(commanders_.note_gone(&a_), ElementsAre(0));
}

TEST_F(CommandersTest, MorseRobots_DriveOn) {
  drive(&a_, 0, Kind::kMorse);
  EXPECT_THAT(commanders_.note_gone(&a_), IsEmpty());
}

class MirroredCommanders : public CommandersTest {
 protected:
  MirroredCommanders() : CommandersTest(two_robots(R"(, "real": {"server": "tcp://robot"})")) {}
};

TEST_F(MirroredCommanders, CommanderLeaves_RealRobotStopsDespiteReaders) {
  for (const Kind kind : {Kind::kClient, Kind::kFollower, Kind::kMorse}) {
    open(b_, 0);
    drive(&a_, 0, kind);
    EXPECT_THAT(commanders_.note_gone(&a_), ElementsAre(0));
    static_cast<void>(commanders_.stop(0));
  }
  drive(&a_, 0);
  drive(&b_, 0);
  EXPECT_THAT(commanders_.note_gone(&a_), IsEmpty()) << "the other one commanded it later";
}

TEST_F(CommandersTest, Commander_MustSendHeartbeat) {
  open(b_, 0);
  EXPECT_FALSE(commanders_.take_charge(&a_, charge(0.5), begin_));
  EXPECT_THAT(commanders_.overdue(begin_ + wall(9.0)), IsEmpty()) << "nothing moves";
  drive(&a_, 0);
  EXPECT_FALSE(commanders_.take_charge(&a_, charge(0.5), begin_ + wall(1.0)));
  EXPECT_THAT(commanders_.overdue(begin_ + wall(1.5)), IsEmpty());
  EXPECT_THAT(commanders_.overdue(begin_ + wall(1.51)), ElementsAre(0));
  static_cast<void>(commanders_.stop(0));
  EXPECT_THAT(commanders_.overdue(begin_ + wall(1.6)), IsEmpty()) << "once";
  EXPECT_TRUE(commanders_.take_stopped(0));
  EXPECT_FALSE(commanders_.take_stopped(0));
  EXPECT_TRUE(commanders_.has_stopped());
  drive(&b_, 0);
  EXPECT_THAT(commanders_.overdue(begin_ + wall(9.0)), IsEmpty())
      << "another client that is there drives it";
}

TEST_F(CommandersTest, DebuggedCommander_MayBeSilent) {
  open(b_, 0);
  EXPECT_FALSE(commanders_.take_charge(&a_, charge(0.5), begin_));
  drive(&a_, 0);
  EXPECT_THAT(commanders_.overdue(begin_ + wall(600.0), [] { return true; }), IsEmpty());
  EXPECT_FALSE(commanders_.has_stopped());
  EXPECT_THAT(commanders_.overdue(begin_ + wall(600.5)), IsEmpty()) << "the time begins anew";
  EXPECT_THAT(commanders_.overdue(begin_ + wall(600.6), [] { return false; }), ElementsAre(0));
}

TEST_F(CommandersTest, CommanderLost_RobotStops) {
  open(b_, 0);
  EXPECT_FALSE(commanders_.take_charge(&a_, charge(0.5), begin_));
  drive(&a_, 0);
  EXPECT_THAT(commanders_.note_gone(&a_), ElementsAre(0)) << "although another one reads it";
  EXPECT_FALSE(commanders_.take_charge(&b_, charge(0.5), begin_)) << "the charge is free";
}

TEST_F(CommandersTest, OneCommander_UntilTakenOver) {
  EXPECT_FALSE(commanders_.take_charge(&a_, charge(0.5, "the mirror on host A"), begin_));
  EXPECT_THAT(
      [&] { static_cast<void>(commanders_.take_charge(&b_, charge(0.5, "B"), begin_)); },
      ThrowsMessage<SessionError>(HasSubstr("the mirror on host A is in charge of robot r1")));
  EXPECT_TRUE(commanders_.take_charge(&b_, charge(0.5, "B", true), begin_));
  EXPECT_THAT(commanders_.note(&a_, device(0, "motion"), Kind::kClient),
              Optional(HasSubstr("another client")));
  EXPECT_THAT([&] { static_cast<void>(commanders_.take_charge(&a_, charge(0.5), begin_)); },
              ThrowsMessage<SessionError>(HasSubstr("B has taken over robot r1")));
  EXPECT_TRUE(commanders_.take_charge(&a_, charge(0.5, "A", true), begin_)) << "back again";
  drive(&a_, 0);
}

// --- In a run

class HostCommanders : public testing::Test {
 protected:
  [[nodiscard]] double speed() const {
    return host_->with_simulation(
        [](const sim::Simulation& simulation) { return simulation.body(0).twist.v_mps; });
  }
  /// Lets some steps pass by a client of the other robot.
  void step() {
    for (int i = 0; i < 3; ++i) other_->request(SleepRequest{0.1});
  }

  std::shared_ptr<Host> host_ = test::patient_host(sim::load_world_text(two_robots()));
  const InterfaceBinding position_ = find_interface(host_->robots(), 6665, "position2d", 0);
  std::unique_ptr<Session> other_ = host_->connect(6666);
};

TEST_F(HostCommanders, LeavingClient_CommandsExecutedBeforeStop) {
  auto session = host_->connect(6665);
  session->request(SubscribeRequest{position_.reading});
  session->send(*position_.motion, sim::TwistCommand{{.v_mps = 0.2}});
  step();
  EXPECT_GT(speed(), 0.0);
  session->send(*position_.motion, sim::TwistCommand{{.v_mps = 0.3}});
  session.reset();
  step();
  EXPECT_EQ(speed(), 0.0);
}

TEST_F(HostCommanders, ClosedPosition2d_RobotStops) {
  const auto session = host_->connect(6665);
  session->request(SubscribeRequest{position_.reading});
  session->send(*position_.motion, sim::TwistCommand{{.v_mps = 0.2}});
  session->request(UnsubscribeRequest{position_.reading});
  session->request(SleepRequest{0.5});
  EXPECT_EQ(speed(), 0.0);
}

TEST_F(HostCommanders, Commander_CommandsAtOnceAndLeavesRobotDriving) {
  auto commander = std::make_unique<Commander>(host_);
  EXPECT_EQ(commander->command(*position_.motion, sim::TwistCommand{{.v_mps = 0.2}}), std::nullopt);
  EXPECT_THAT(commander->command(*position_.motion, sim::GripCommand{}),
              Optional(HasSubstr("takes no such command")));
  step();
  commander.reset();
  step();
  EXPECT_GT(speed(), 0.0);
  host_->finish();
  EXPECT_THAT(Commander(host_).command(*position_.motion, sim::TwistCommand{}),
              Optional(HasSubstr("the run is over")));
}

TEST_F(HostCommanders, Charges_Checked) {
  const auto session = host_->connect(6665);
  const auto refusal = [&](const TakeChargeRequest& what) {
    try {
      session->request(what);
    } catch (const SessionError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal({position_.reading, 0.0}), HasSubstr("in [0.05, 600]"));
  EXPECT_THAT(refusal({position_.reading, std::nan("")}), HasSubstr("in [0.05, 600]"));
  EXPECT_THAT(refusal({position_.reading, 1.0, false, "a\nb"}), HasSubstr("200 printable"));
  EXPECT_THAT(refusal({DeviceId{9, 0}, 1.0}), HasSubstr("no"));
  EXPECT_TRUE(session->request(TakeChargeRequest{position_.reading, 1.0}).watched);
}

}  // namespace
}  // namespace playerlike
