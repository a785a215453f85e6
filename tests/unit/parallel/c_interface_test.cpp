// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The C interface: the same results as sim::Batch, and a status and a text for each wrong call.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "batches.h"
#include "playpen_batch.h"

namespace sim {
namespace {

using test::Arrays;
using test::kRoom;
using test::varied_actions;
using testing::HasSubstr;
using testing::StartsWith;

struct Destroy {
  void operator()(playpen_batch* batch) const { playpen_batch_destroy(batch); }
};
using Handle = std::unique_ptr<playpen_batch, Destroy>;

playpen_batch_options options_of(int simulations) {
  playpen_batch_options options;
  playpen_batch_options_init(&options);
  options.simulations = simulations;
  options.threads = 2;
  return options;
}

Handle made(const playpen_batch_options& options) {
  playpen_batch* batch = nullptr;
  EXPECT_EQ(playpen_batch_create_from_text(kRoom, &options, &batch), PLAYPEN_BATCH_OK)
      << playpen_batch_last_error();
  return Handle(batch);
}

template <typename T>
playpen_batch_array array_of(std::vector<T>& values) {
  return {values.data(), values.size(), 0, 0};
}

playpen_batch_observations observations_of(Arrays& arrays) {
  return {sizeof(playpen_batch_observations),
          array_of(arrays.poses),
          array_of(arrays.twists),
          array_of(arrays.scans),
          array_of(arrays.clearances),
          array_of(arrays.collisions),
          array_of(arrays.done),
          array_of(arrays.times)};
}

// "STATUS: TEXT" of a call.
std::string outcome(playpen_batch_status status) {
  return std::to_string(static_cast<int>(status)) + ": " + playpen_batch_last_error();
}

TEST(BatchInC, EqualToBatchInCpp) {
  const Handle batch = made(options_of(3));
  Batch same(load_world_text(kRoom), {.simulations = 3, .threads = 1});
  EXPECT_EQ(playpen_batch_version(), PLAYPEN_BATCH_VERSION);
  EXPECT_EQ(playpen_batch_simulations(batch.get()), 3);
  EXPECT_EQ(playpen_batch_robots(batch.get()), 2);
  EXPECT_EQ(playpen_batch_beams(batch.get()), 40);
  EXPECT_EQ(playpen_batch_threads(batch.get()), 2);
  EXPECT_STREQ(playpen_batch_robot_name(batch.get(), 1), "b");
  Arrays a(same);
  Arrays b(same);
  const playpen_batch_observations out = observations_of(a);
  for (int call = 0; call < 5; ++call) {
    std::vector<double> actions = varied_actions(3, 2, call);
    const playpen_batch_array given = array_of(actions);
    ASSERT_EQ(playpen_batch_step(batch.get(), &given, 10, &out), PLAYPEN_BATCH_OK);
    same.step({actions}, 10, b.out());
    ASSERT_TRUE(a == b) << call;
  }
  const std::vector<std::uint8_t> mask = {1, 0, 1};
  const std::vector<std::uint64_t> seeds = {8, 8, 9};
  std::vector<double> poses(18, 1.0);
  poses[3] = poses[15] = 3.0;
  const playpen_batch_array starts = array_of(poses);
  ASSERT_EQ(playpen_batch_reset(batch.get(), mask.data(), 3, seeds.data(), 3, &starts),
            PLAYPEN_BATCH_OK);
  same.reset({mask, seeds, {poses}});
  ASSERT_EQ(playpen_batch_observe(batch.get(), &out), PLAYPEN_BATCH_OK);
  same.observe(b.out());
  EXPECT_TRUE(a == b);
  std::uint64_t hash = 0;
  ASSERT_EQ(playpen_batch_state_hash(batch.get(), 2, &hash), PLAYPEN_BATCH_OK);
  EXPECT_EQ(hash, same.simulation(2).state_hash());
}

TEST(BatchInC, SaveAndRestore) {
  const Handle batch = made(options_of(2));
  playpen_batch_step(batch.get(), nullptr, 20, nullptr);
  std::size_t size = 0;
  ASSERT_EQ(playpen_batch_save(batch.get(), 0, nullptr, 0, &size), PLAYPEN_BATCH_OK);
  std::vector<char> state(size);
  EXPECT_THAT(outcome(playpen_batch_save(batch.get(), 0, state.data(), size - 1, &size)),
              StartsWith("1: capacity: expected at least "));
  ASSERT_EQ(playpen_batch_save(batch.get(), 0, state.data(), size, &size), PLAYPEN_BATCH_OK);
  const Handle other = made(options_of(2));
  ASSERT_EQ(playpen_batch_restore(other.get(), nullptr, 0, state.data(), size), PLAYPEN_BATCH_OK);
  std::uint64_t a = 0;
  std::uint64_t b = 1;
  playpen_batch_state_hash(batch.get(), 0, &a);
  playpen_batch_state_hash(other.get(), 1, &b);
  EXPECT_EQ(a, b);
  ++state.back();
  EXPECT_THAT(outcome(playpen_batch_restore(other.get(), nullptr, 0, state.data(), size)),
              StartsWith("3: snapshot: "));
}

TEST(BatchInC, Creation_WrongArguments) {
  playpen_batch* batch = reinterpret_cast<playpen_batch*>(8);
  const auto create = [&](const char* text, const playpen_batch_options& options) {
    return outcome(playpen_batch_create_from_text(text, &options, &batch));
  };
  EXPECT_THAT(outcome(playpen_batch_create("no/such.json", nullptr, &batch)),
              testing::AllOf(StartsWith("2: "), HasSubstr("no/such.json")));
  EXPECT_EQ(batch, nullptr);
  EXPECT_THAT(create("{", options_of(1)), StartsWith("2: <memory>"));
  EXPECT_EQ(create(nullptr, options_of(1)), "1: world_text: expected a pointer, found null");
  EXPECT_EQ(outcome(playpen_batch_create("", nullptr, nullptr)),
            "1: batch: expected a pointer, found null");
  EXPECT_THAT(create(kRoom, options_of(0)), StartsWith("1: simulations: "));
  playpen_batch_options options = options_of(1);
  options.struct_size = 0;
  EXPECT_THAT(create(kRoom, options), StartsWith("1: options: expected struct_size "));
  options = options_of(1);
  options.seed_count = 1;
  EXPECT_EQ(create(kRoom, options), "1: seeds: expected a pointer, found null");
  const char* const names[] = {"a", nullptr};
  options = options_of(1);
  options.robots = names;
  EXPECT_EQ(create(kRoom, options), "1: robots: expected their number, found 0");
  options.robot_count = 2;
  EXPECT_EQ(create(kRoom, options), "1: robots: expected a pointer, found null");
  EXPECT_THAT(outcome(playpen_batch_create("no\xff\xfe.json", nullptr, &batch)),
              StartsWith("2: no??.json: expected a world file"));
}

TEST(BatchInC, WrongArguments) {
  const Handle batch = made(options_of(2));
  std::vector<double> numbers(13);
  playpen_batch_observations out{};
  EXPECT_THAT(outcome(playpen_batch_observe(batch.get(), &out)),
              StartsWith("1: observations: expected struct_size "));
  out.struct_size = sizeof out;
  EXPECT_EQ(outcome(playpen_batch_observe(batch.get(), &out)), "0: ");
  out.poses = {numbers.data(), 13, 0, 0};
  EXPECT_THAT(outcome(playpen_batch_observe(batch.get(), &out)),
              StartsWith("1: poses: expected 12 elements"));
  out.poses = {reinterpret_cast<char*>(numbers.data()) + 1, 12, 0, 0};
  EXPECT_EQ(outcome(playpen_batch_observe(batch.get(), &out)),
            "1: poses: expected an address that is a multiple of 8");
  out.poses = {numbers.data(), std::numeric_limits<std::size_t>::max(), 0, 0};
  EXPECT_THAT(outcome(playpen_batch_observe(batch.get(), &out)),
              HasSubstr("found 18446744073709551615"));
  out.poses = {nullptr, 12, 0, 0};
  EXPECT_EQ(outcome(playpen_batch_observe(batch.get(), &out)),
            "1: poses: expected a pointer, found null");
  out.poses = {numbers.data(), 0, 0, 0};
  EXPECT_EQ(outcome(playpen_batch_observe(batch.get(), &out)),
            "1: poses: expected elements, found 0");
  numbers[1] = NAN;
  const playpen_batch_array actions = {numbers.data(), 8, 0, 0};
  EXPECT_THAT(outcome(playpen_batch_step(batch.get(), &actions, 1, nullptr)),
              StartsWith("1: actions: expected finite numbers, found NaN"));
  playpen_batch_scan scan;
  EXPECT_THAT(outcome(playpen_batch_describe_scan(batch.get(), 2, &scan)), StartsWith("1: robot"));
  EXPECT_EQ(outcome(playpen_batch_describe_scan(batch.get(), 0, &scan)), "0: ");
  EXPECT_EQ(scan.beams, 40);
  EXPECT_EQ(playpen_batch_robot_name(batch.get(), -1), nullptr);
  EXPECT_THAT(outcome(playpen_batch_state_hash(batch.get(), 2, nullptr)),
              StartsWith("1: hash: expected a pointer"));
}

TEST(BatchInC, CallsAtOnce_RefusedOrExecuted) {
  const Handle batch = made(options_of(4));
  std::atomic<bool> go_on{true};
  std::thread other([&] {
    while (go_on) playpen_batch_step(batch.get(), nullptr, 20, nullptr);
  });
  std::string own;
  for (int i = 0; i < 100'000 && own.empty(); ++i) {
    if (playpen_batch_observe(batch.get(), nullptr) != PLAYPEN_BATCH_OK) {
      own = playpen_batch_last_error();
    }
  }
  go_on = false;
  other.join();
  EXPECT_THAT(own, HasSubstr("expected one call at a time"));
  EXPECT_EQ(playpen_batch_observe(batch.get(), nullptr), PLAYPEN_BATCH_OK);
}

TEST(BatchInC, ChildProcess_MayNotUseBatchOfParent) {
  const Handle batch = made(options_of(2));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const std::string text = outcome(playpen_batch_step(batch.get(), nullptr, 1, nullptr));
    playpen_batch_destroy(batch.get());  // does not wait for threads that do not exist
    _exit(text.starts_with("1: batch: expected one of this process") ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(playpen_batch_step(batch.get(), nullptr, 1, nullptr), PLAYPEN_BATCH_OK);
}

TEST(BatchInC, NullHandle) {
  EXPECT_EQ(outcome(playpen_batch_observe(nullptr, nullptr)),
            "1: batch: expected a pointer, found null");
  EXPECT_EQ(playpen_batch_simulations(nullptr), 0);
  EXPECT_EQ(playpen_batch_beams(nullptr), 0);
  EXPECT_EQ(playpen_batch_robot_name(nullptr, 0), nullptr);
  playpen_batch_destroy(nullptr);
}

}  // namespace
}  // namespace sim
