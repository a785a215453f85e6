// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/engines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

namespace playpen::batch {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(Parts, AllUnitsOnce) {
  for (const std::size_t units : {1U, 7U, 100U}) {
    for (const std::size_t parts : {1U, 2U, 7U, 30U}) {
      std::size_t next = 0;
      for (std::size_t part = 1; part <= parts; ++part) {
        const auto [begin, end] = units_of_part(units, part, parts);
        EXPECT_EQ(begin, next);
        EXPECT_LE(end - begin, units / parts + 1);
        next = end;
      }
      EXPECT_EQ(next, units);
    }
  }
  EXPECT_THAT(units_of_part(10, 2, 3), Pair(3, 6));
}

TEST(Parts, Usual_WithinTheArraysOfSlurm) {
  EXPECT_EQ(usual_parts(1), 1U);
  EXPECT_EQ(usual_parts(500), 20U);
  EXPECT_EQ(usual_parts(1'000'000), 1000U);
}

TEST(Parts, NumberSet_AsSlurmWritesIt) {
  EXPECT_EQ(number_set({4}), "4");
  EXPECT_EQ(number_set({1, 2, 3, 5, 8, 9}), "1-3,5,8-9");
}

TEST(EngineCommands, Names_AreQuotedForTheShell) {
  EngineCall call{"/opt/play pen/playpen", "/data/it's", 20, {1, 2, 7}, {"--partition=lab"}, true};
  EXPECT_THAT(slurm_command(call, "/data/it's/slurm/part.sh"),
              ElementsAre("sbatch", "--job-name=playpen", "--array=1-2,7", "--requeue",
                          "--open-mode=append", "--output=/data/it's/slurm/part-%a.log", "--wait",
                          "--partition=lab", "/data/it's/slurm/part.sh"));
  EXPECT_THAT(slurm_script(call),
              HasSubstr("exec '/opt/play pen/playpen' batch --out '/data/it'\\''s' --part "
                        "\"$SLURM_ARRAY_TASK_ID/20\""));
  EXPECT_THAT(parallel_command(call),
              ElementsAre("parallel", "--will-cite", "--retries", "3", "--joblog",
                          "/data/it's/parallel.log", "--partition=lab",
                          "'/opt/play pen/playpen' batch --out '/data/it'\\''s' --part {}/20 "
                          "--jobs 1",
                          ":::", "1", "2", "7"));
}

}  // namespace
}  // namespace playpen::batch
