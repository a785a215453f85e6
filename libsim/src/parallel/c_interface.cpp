// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "playpen_batch.h"
#include "sim/core/error.h"
#include "sim/core/state_archive.h"
#include "sim/core/utf8.h"
#include "sim/parallel/batch.h"

struct playpen_batch {  // NOLINT(readability-identifier-naming): a name of C
  explicit playpen_batch(sim::Batch made) : batch(std::move(made)) {}

  sim::Batch batch;
  const pid_t process = getpid();           // its threads are this process's
  mutable std::atomic<bool> in_use{false};  // a call is running
};

namespace {

using sim::Batch;
using sim::BatchArray;
using sim::BatchError;

// Of the calling thread. A buffer of fixed size, so that an error can be kept without memory.
struct LastError {
  char text[4096] = "";
};
thread_local LastError last_error;

playpen_batch_status failed(playpen_batch_status status, const char* what) {
  std::strncpy(last_error.text, what, sizeof last_error.text - 1);
  // A character of UTF-8 is not cut in two.
  std::size_t end = std::strlen(last_error.text);
  if (end == sizeof last_error.text - 1) {
    while (end > 0 && (static_cast<unsigned char>(last_error.text[end]) & 0xC0U) == 0x80U) --end;
    last_error.text[end] = '\0';
  }
  // Names of files may contain any bytes.
  for (;;) {
    const std::size_t at = sim::find_invalid_utf8(last_error.text);
    if (at == std::string_view::npos) return status;
    last_error.text[at] = '?';
  }
}

// Calls work() and turns what it throws into a status.
template <typename Work>
playpen_batch_status guarded(Work work) noexcept {
  last_error.text[0] = '\0';
  try {
    work();
    return PLAYPEN_BATCH_OK;
  } catch (const BatchError& error) {
    return failed(PLAYPEN_BATCH_ARGUMENT, error.what());
  } catch (const sim::ConfigError& error) {
    return failed(PLAYPEN_BATCH_WORLD, error.what());
  } catch (const sim::SnapshotError& error) {
    return failed(PLAYPEN_BATCH_STATE, error.what());
  } catch (const std::bad_alloc&) {
    return failed(PLAYPEN_BATCH_FAILED, "there is not enough memory");
  } catch (const std::exception& error) {
    return failed(PLAYPEN_BATCH_FAILED, error.what());
  } catch (...) {
    return failed(PLAYPEN_BATCH_FAILED, "unknown failure");
  }
}

void expect_pointer(const char* name, const void* pointer) {
  if (pointer == nullptr) throw BatchError(std::string(name) + ": expected a pointer, found null");
}

// A call of a batch.
class Call {
 public:
  explicit Call(const playpen_batch* batch) : batch_(batch) {
    expect_pointer("batch", batch);
    if (batch->process != getpid()) {
      throw BatchError(
          "batch: expected one of this process, found one of its parent; make it after fork()");
    }
    if (batch->in_use.exchange(true, std::memory_order_acquire)) {
      throw BatchError(
          "batch: expected one call at a time, found one while another thread's is running");
    }
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  ~Call() { batch_->in_use.store(false, std::memory_order_release); }

 private:
  const playpen_batch* batch_;
};

// Structs of other versions of this interface have other sizes.
void expect_struct(const char* name, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  throw BatchError(std::string(name) + ": expected struct_size " + std::to_string(expected) +
                   ", found " + std::to_string(found));
}

// A caller's list; null must come with the count 0.
template <typename T>
std::span<const T> list_of(const char* name, const T* first, std::size_t count) {
  if (first != nullptr && count == 0) {
    throw BatchError(std::string(name) + ": expected their number, found 0");
  }
  if (first == nullptr && count != 0) {
    throw BatchError(std::string(name) + ": expected a pointer, found null");
  }
  return {first, count};
}

template <typename T>
BatchArray<T> array_of(const char* name, const playpen_batch_array& array) {
  if (array.data == nullptr) {
    if (array.size != 0) throw BatchError(std::string(name) + ": expected a pointer, found null");
    return {};
  }
  if (array.size == 0) throw BatchError(std::string(name) + ": expected elements, found 0");
  if (reinterpret_cast<std::uintptr_t>(array.data) % alignof(T) != 0) {
    throw BatchError(std::string(name) + ": expected an address that is a multiple of " +
                     std::to_string(alignof(T)));
  }
  return {{static_cast<T*>(array.data), array.size}, array.simulation_stride, array.robot_stride};
}

sim::BatchObservations observations_of(const playpen_batch_observations* from) {
  if (from == nullptr) return {};
  expect_struct("observations", from->struct_size, sizeof *from);
  return {.poses = array_of<double>("poses", from->poses),
          .twists = array_of<double>("twists", from->twists),
          .scans = array_of<float>("scans", from->scans),
          .clearances = array_of<double>("clearances", from->clearances),
          .collisions = array_of<std::int32_t>("collisions", from->collisions),
          .done = array_of<std::uint8_t>("done", from->done),
          .times = array_of<double>("times", from->times)};
}

sim::BatchOptions options_of(const playpen_batch_options* from) {
  sim::BatchOptions options;
  if (from == nullptr) return options;
  expect_struct("options", from->struct_size, sizeof *from);
  options.simulations = from->simulations;
  options.threads = from->threads;
  options.beams = from->beams;
  options.readings = from->readings != 0;
  const auto seeds = list_of("seeds", from->seeds, from->seed_count);
  options.seeds.assign(seeds.begin(), seeds.end());
  for (const char* name : list_of("robots", from->robots, from->robot_count)) {
    expect_pointer("robots", name);
    options.robots.emplace_back(name);
  }
  return options;
}

// @param load  makes the world of the text or the path.
template <typename Load>
playpen_batch_status create(const char* name, const char* world,
                            const playpen_batch_options* options, playpen_batch** batch,
                            Load load) noexcept {
  if (batch != nullptr) *batch = nullptr;
  return guarded([&] {
    expect_pointer("batch", batch);
    expect_pointer(name, world);
    const sim::BatchOptions own = options_of(options);
    *batch = std::make_unique<playpen_batch>(Batch(load(world), own)).release();
  });
}

}  // namespace

int32_t playpen_batch_version(void) { return PLAYPEN_BATCH_VERSION; }

const char* playpen_batch_last_error(void) { return last_error.text; }

void playpen_batch_options_init(playpen_batch_options* options) {
  if (options == nullptr) return;
  *options = {};
  options->struct_size = sizeof *options;
  options->simulations = 1;
}

playpen_batch_status playpen_batch_create(const char* world_file,
                                          const playpen_batch_options* options,
                                          playpen_batch** batch) {
  return create("world_file", world_file, options, batch,
                [](const char* path) { return sim::load_world(path); });
}

playpen_batch_status playpen_batch_create_from_text(const char* world_text,
                                                    const playpen_batch_options* options,
                                                    playpen_batch** batch) {
  return create("world_text", world_text, options, batch,
                [](const char* text) { return sim::load_world_text(text); });
}

void playpen_batch_destroy(playpen_batch* batch) {
  // In a child process the threads that it would wait for do not exist.
  if (batch == nullptr || batch->process != getpid()) return;
  delete batch;
}

int32_t playpen_batch_simulations(const playpen_batch* batch) {
  return batch == nullptr ? 0 : batch->batch.simulations();
}

int32_t playpen_batch_robots(const playpen_batch* batch) {
  return batch == nullptr ? 0 : batch->batch.robots();
}

int32_t playpen_batch_beams(const playpen_batch* batch) {
  return batch == nullptr ? 0 : batch->batch.beams();
}

int32_t playpen_batch_threads(const playpen_batch* batch) {
  return batch == nullptr ? 0 : batch->batch.threads();
}

const char* playpen_batch_robot_name(const playpen_batch* batch, int32_t robot) {
  if (robot < 0 || robot >= playpen_batch_robots(batch)) return nullptr;
  return batch->batch.robot_name(robot).c_str();
}

playpen_batch_status playpen_batch_describe_scan(const playpen_batch* batch, int32_t robot,
                                                 playpen_batch_scan* scan) {
  return guarded([&] {
    const Call call(batch);
    expect_pointer("scan", scan);
    const auto geometry = batch->batch.scan_geometry(robot);
    *scan = {};
    if (!geometry) return;
    *scan = {geometry->beam_count, geometry->angle_min_rad(), geometry->resolution_rad,
             geometry->range_max_m};
  });
}

playpen_batch_status playpen_batch_step(playpen_batch* batch, const playpen_batch_array* actions,
                                        int32_t steps,
                                        const playpen_batch_observations* observations) {
  return guarded([&] {
    const Call call(batch);
    const auto commands = actions == nullptr ? BatchArray<const double>{}
                                             : array_of<const double>("actions", *actions);
    batch->batch.step(commands, steps, observations_of(observations));
  });
}

playpen_batch_status playpen_batch_observe(playpen_batch* batch,
                                           const playpen_batch_observations* observations) {
  return guarded([&] {
    const Call call(batch);
    batch->batch.observe(observations_of(observations));
  });
}

playpen_batch_status playpen_batch_reset(playpen_batch* batch, const uint8_t* mask,
                                         size_t mask_size, const uint64_t* seeds, size_t seed_count,
                                         const playpen_batch_array* poses) {
  return guarded([&] {
    const Call call(batch);
    batch->batch.reset({.mask = list_of("mask", mask, mask_size),
                        .seeds = list_of("seeds", seeds, seed_count),
                        .poses = poses == nullptr ? BatchArray<const double>{}
                                                  : array_of<const double>("poses", *poses)});
  });
}

playpen_batch_status playpen_batch_save(const playpen_batch* batch, int32_t simulation, void* data,
                                        size_t capacity, size_t* size) {
  return guarded([&] {
    const Call call(batch);
    expect_pointer("size", size);
    const sim::Snapshot state = batch->batch.save(simulation);
    *size = state.size();
    if (data == nullptr) return;
    if (capacity < state.size()) {
      throw BatchError("capacity: expected at least " + std::to_string(state.size()) +
                       " bytes, found " + std::to_string(capacity));
    }
    std::memcpy(data, state.data(), state.size());
  });
}

playpen_batch_status playpen_batch_restore(playpen_batch* batch, const uint8_t* mask,
                                           size_t mask_size, const void* data, size_t size) {
  return guarded([&] {
    const Call call(batch);
    expect_pointer("data", data);
    batch->batch.restore(list_of("mask", mask, mask_size),
                         {static_cast<const std::uint8_t*>(data), size});
  });
}

playpen_batch_status playpen_batch_state_hash(const playpen_batch* batch, int32_t simulation,
                                              uint64_t* hash) {
  return guarded([&] {
    const Call call(batch);
    expect_pointer("hash", hash);
    *hash = batch->batch.simulation(simulation).state_hash();
  });
}
