// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <thread>

#include "temporary_folder.h"

namespace sim {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;

/// The content, or "fault: " and what was found.
std::string read(const std::string& path, const FileLimits& limits = {}) {
  std::string content = "from before";
  const auto error = read_whole_file(path, limits, content);
  if (!error) return content;
  EXPECT_EQ(content, "");
  return std::to_string(static_cast<int>(error->fault)) + ": " + error->found;
}

std::string fault(FileFault kind, const std::string& found) {
  return std::to_string(static_cast<int>(kind)) + ": " + found;
}

TEST(ReadWholeFile, RegularFile_AllBytes) {
  const TemporaryFolder folder;
  const std::string bytes = std::string("a\0b\r\n", 5) + std::string(200'000, 'x');
  EXPECT_EQ(read(folder.write("a", bytes)), bytes);
  EXPECT_EQ(read(folder.write("empty", "")), "");
  EXPECT_EQ(read(folder.write("least", "1234"), {.most_bytes = 4}), "1234");
  fs::create_symlink("a", folder / "link");
  EXPECT_EQ(read(folder / "link"), bytes);
  // A system file that reports a size of 0.
  EXPECT_THAT(read("/proc/self/status"), testing::HasSubstr("Pid:"));
}

TEST(ReadWholeFile, OtherFiles_Named) {
  const TemporaryFolder folder;
  EXPECT_EQ(read(folder / "none"), fault(FileFault::kMissing, "no file of that name"));
  EXPECT_EQ(read(folder.write("a", "") + "/b"), fault(FileFault::kMissing, "no file of that name"));
  EXPECT_EQ(read(folder.path().string()), fault(FileFault::kFolder, "a folder"));
  for (const bool pipes : {false, true}) {
    for (const char* device : {"/dev/zero", "/dev/null", "/dev/urandom"}) {
      EXPECT_EQ(read(device, {.pipes = pipes}), fault(FileFault::kNotRegular, "a device"));
    }
  }
}

TEST(ReadWholeFile, LinkCycle_DistinguishedFromMissingPermission) {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_EQ(read(folder / "a"),
            fault(FileFault::kLinkLoop, "symbolic links that lead round in a circle"));
  if (geteuid() == 0) return;  // root may read everything
  const std::string secret = folder.write("secret", "x");
  fs::permissions(secret, fs::perms::none);
  EXPECT_EQ(read(secret), fault(FileFault::kNoPermission, "no permission to open it"));
}

TEST(ReadWholeFile, StopsAtLimit) {
  const TemporaryFolder folder;
  const std::string large = folder.write("large", std::string(1001, 'x'));
  EXPECT_EQ(read(large, {.most_bytes = 1000}), fault(FileFault::kTooLarge, "more than 1000 bytes"));
  // A huge sparse file, of which nothing is read.
  fs::resize_file(large, std::uintmax_t{1} << 40U);
  EXPECT_EQ(read(large), fault(FileFault::kTooLarge, "more than 16 MiB"));
}

TEST(ReadWholeFile, Pipes_OnlyWhereAllowedWithoutWaiting) {
  const TemporaryFolder folder;
  const std::string fifo = folder / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(read(fifo), fault(FileFault::kNotRegular, "a pipe"));
  // No process will ever write: the answer is the same, however short the time limit.
  EXPECT_EQ(read(fifo, {.pipes = true, .silence_ms = 1}),
            fault(FileFault::kSilent, "a pipe that has given nothing for 0 s"));
}

TEST(ReadWholeFile, Pipe_ReadToEnd) {
  for (const std::size_t most : {std::size_t{1} << 20U, std::size_t{1000}}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    std::string all;
    for (int i = 0; i < 5000; ++i) all += std::to_string(i) + ',';
    std::thread writer([&] {
      // Small pieces; the pipe cannot hold all of them at once.
      for (std::size_t at = 0; at < all.size(); at += 100) {
        const std::string piece = all.substr(at, 100);
        if (write(ends[1], piece.data(), piece.size()) < 0) break;
      }
      close(ends[1]);
    });
    const std::string got =
        read("/dev/fd/" + std::to_string(ends[0]), {.most_bytes = most, .pipes = true});
    EXPECT_EQ(got, most > all.size() ? all : fault(FileFault::kTooLarge, "more than 1000 bytes"));
    // The excess is still in the pipe.
    std::string rest(all.size(), ' ');
    while (::read(ends[0], rest.data(), rest.size()) > 0) {
    }
    writer.join();
    close(ends[0]);
  }
}

}  // namespace
}  // namespace sim
