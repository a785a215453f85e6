// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "server/watch_hub.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "protocol/codec.h"

namespace playerlike::server {
namespace {

constexpr std::size_t kCellBytes = sizeof(sim::CellValue);
// Watchers that are due within this time of each other are served together.
constexpr auto kSlack = std::chrono::milliseconds(2);
// Copying the canvas blocks the simulation; it may take at most 1 / kCopyShare of the time.
constexpr int kCopyShare = 20;

std::size_t tiles_across(int cells) {
  return static_cast<std::size_t>((cells + CanvasCopy::kTileSide - 1) / CanvasCopy::kTileSide);
}

std::size_t offset(int width, int column, int row) {
  return (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(column)) *
         kCellBytes;
}

}  // namespace

// --- CanvasCopy

void CanvasCopy::take(const CanvasInfo& info, std::vector<std::uint8_t>& rgba) {
  rgba_.swap(rgba);
  const bool resized = count_ == 0 || info.width != info_.width || info.height != info_.height;
  info_ = info;
  if (!resized) {
    if (!rgba_.empty()) stamp_changes(rgba);
    return;
  }
  resized_ = ++count_;
  stamps_.assign(tiles_across(info.width) * tiles_across(info.height), count_);
}

void CanvasCopy::stamp_changes(const std::vector<std::uint8_t>& old) {
  const std::size_t columns = tiles_across(info_.width);
  const std::uint64_t next = count_ + 1;
  for (int row = 0; row < info_.height; ++row) {
    const std::size_t begin = offset(info_.width, 0, row);
    const std::size_t size = offset(info_.width, info_.width, 0);
    if (std::memcmp(rgba_.data() + begin, old.data() + begin, size) == 0) continue;
    for (std::size_t tile = 0; tile < columns; ++tile) {
      std::uint64_t& stamp = stamps_[static_cast<std::size_t>(row / kTileSide) * columns + tile];
      if (stamp == next) continue;
      const int column = static_cast<int>(tile) * kTileSide;
      const std::size_t at = offset(info_.width, column, row);
      const std::size_t bytes =
          static_cast<std::size_t>(std::min(kTileSide, info_.width - column)) * kCellBytes;
      if (std::memcmp(rgba_.data() + at, old.data() + at, bytes) == 0) continue;
      stamp = next;
      count_ = next;
    }
  }
}

std::vector<sim::CellRect> CanvasCopy::changed_since(std::uint64_t count) const {
  std::vector<sim::CellRect> done;
  if (rgba_.empty() || count == count_) return done;
  if (resized_since(count)) return {{0, 0, info_.width, info_.height}};
  // Merges changed tiles into runs within a row, and equal runs of adjacent rows into rectangles.
  const std::size_t columns = tiles_across(info_.width);
  std::vector<sim::CellRect> open;
  for (int row = 0; row < info_.height; row += kTileSide) {
    const std::uint64_t* stamps =
        stamps_.data() + static_cast<std::size_t>(row / kTileSide) * columns;
    const int height = std::min(kTileSide, info_.height - row);
    std::vector<sim::CellRect> runs;
    for (std::size_t begin = 0; begin < columns;) {
      if (stamps[begin] <= count) {
        ++begin;
        continue;
      }
      std::size_t end = begin;
      while (end < columns && stamps[end] > count) ++end;
      const int left = static_cast<int>(begin) * kTileSide;
      const int right = std::min(info_.width, static_cast<int>(end) * kTileSide);
      sim::CellRect run{left, row, right - left, height};
      const auto above = std::find_if(open.begin(), open.end(), [&](const sim::CellRect& r) {
        return r.column == run.column && r.width == run.width;
      });
      if (above != open.end()) {
        run.row = above->row;
        run.height += above->height;
        open.erase(above);
      }
      runs.push_back(run);
      begin = end;
    }
    done.insert(done.end(), open.begin(), open.end());
    open = std::move(runs);
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

std::vector<std::uint8_t> CanvasCopy::cells(const sim::CellRect& rect) const {
  const std::size_t line = static_cast<std::size_t>(rect.width) * kCellBytes;
  std::vector<std::uint8_t> cells(line * static_cast<std::size_t>(rect.height));
  for (int row = 0; row < rect.height; ++row) {
    std::memcpy(cells.data() + static_cast<std::size_t>(row) * line,
                rgba_.data() + offset(info_.width, rect.column, rect.row + row), line);
  }
  return cells;
}

// --- WatchHub

WatchHub::WatchHub(Hub& hub)
    : hub_(hub),
      epoch_(Clock::now()),
      timer_due_(Clock::time_point::max()),
      self_(std::make_shared<WatchHub*>(this)) {}

void WatchHub::watch(Peer& peer, protocol::Encoding encoding, double rate_hz, bool canvas) {
  forget(peer);
  const auto now = Clock::now();
  const auto period = std::max(
      Clock::duration(1),
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate_hz)));
  watchers_.push_back({&peer, encoding, period, canvas, now});
  schedule(now);
}

void WatchHub::forget(const Peer& peer) noexcept {
  std::erase_if(watchers_, [&](const Watcher& watcher) { return watcher.peer == &peer; });
}

WatchHub::Clock::time_point WatchHub::next_due(const Watcher& watcher,
                                               Clock::time_point now) const {
  const auto periods = (now + kSlack - epoch_) / watcher.period + 1;
  return epoch_ + periods * watcher.period;
}

void WatchHub::tick(Clock::time_point now) {
  const auto is_due = [&](const Watcher& watcher) { return watcher.due <= now + kSlack; };
  if (std::any_of(watchers_.begin(), watchers_.end(), is_due)) {
    const bool with_canvas =
        std::any_of(watchers_.begin(), watchers_.end(),
                    [&](const Watcher& watcher) { return watcher.canvas && is_due(watcher); });
    const Moment moment = look(with_canvas, now);
    struct Made {
      protocol::Encoding encoding;
      bool canvas;
      std::uint64_t since;
      std::shared_ptr<const std::string> bytes;
    };
    std::vector<Made> made;
    for (Watcher& watcher : watchers_) {
      if (!is_due(watcher)) continue;
      auto it = std::find_if(made.begin(), made.end(), [&](const Made& m) {
        return m.encoding == watcher.encoding && m.canvas == watcher.canvas &&
               m.since == watcher.sent;
      });
      if (it == made.end()) {
        made.push_back({watcher.encoding, watcher.canvas, watcher.sent, record(moment, watcher)});
        it = std::prev(made.end());
      }
      const bool sent = watcher.peer->send_record(it->bytes);
      watcher.sent = watcher.canvas && sent ? canvas_.count() : 0;
      watcher.due = next_due(watcher, now);
    }
  }
  schedule(now);
}

WatchHub::Moment WatchHub::look(bool with_canvas, Clock::time_point now) {
  Moment moment;
  std::uint64_t version = 0;
  hub_.host().with_simulation([&](const sim::Simulation& simulation) {
    moment.t_ns = simulation.now_ns();
    moment.poses.reserve(static_cast<std::size_t>(simulation.robot_count()));
    for (int robot = 0; robot < simulation.robot_count(); ++robot) {
      moment.poses.push_back(simulation.body(robot).X_WB);
    }
    version = simulation.layers().version();
  });
  if (with_canvas && now >= next_copy_) copy_canvas(version);
  moment.finished = hub_.host().finished();
  return moment;
}

// The host copies in pieces, between which others can use the simulation. What changes meanwhile
// has another version, so it is copied again.
void WatchHub::copy_canvas(std::uint64_t version) {
  CanvasImage image{{}, session().request(CanvasInfoRequest{})};
  // The size must be compared too: the version is equal for two sizes if neither was composed.
  const CanvasInfo& known = canvas_.info();
  if (canvas_.count() != 0 && version == stack_version_ && image.canvas.width == known.width &&
      image.canvas.height == known.height) {
    return;
  }
  stack_version_ = version;
  const Clock::time_point begin = Clock::now();
  if (std::int64_t{image.canvas.width} * image.canvas.height <= kMaxCells) {
    image = session().request(CanvasImageRequest{});
  }
  // A canvas whose copying takes long is copied less often.
  const auto end = Clock::now();
  next_copy_ = end + kCopyShare * (end - begin);
  canvas_.take(image.canvas, image.rgba);
}

Session& WatchHub::session() {
  if (client_ == nullptr) {
    client_ = hub_.host().connect_events(kMorsePort, {}, EventRole::kOnlooker);
  }
  return client_->session();
}

std::shared_ptr<const std::string> WatchHub::record(const Moment& moment,
                                                    const Watcher& watcher) const {
  using protocol::json;
  json event = {{"event", "watch"}, {"t", moment.t_ns}, {"finished", moment.finished}};
  json& poses = event["poses"] = json::array();
  for (const sim::Pose& pose : moment.poses) {
    poses.push_back({pose.x_m, pose.y_m, pose.yaw_rad});
  }
  if (watcher.canvas) {
    if (canvas_.resized_since(watcher.sent)) {
      event["canvas_info"] = protocol::encode_canvas(canvas_.info());
    }
    const std::vector<sim::CellRect> rects = canvas_.changed_since(watcher.sent);
    if (!rects.empty()) {
      json& changes = event["canvas"] = json::array();
      for (const sim::CellRect& rect : rects) {
        changes.push_back({{"rect", {rect.column, rect.row, rect.width, rect.height}},
                           {"cells", protocol::bytes(canvas_.cells(rect), watcher.encoding)}});
      }
    }
  }
  return std::make_shared<const std::string>(protocol::encode(event, watcher.encoding));
}

void WatchHub::schedule(Clock::time_point now) {
  auto due = Clock::time_point::max();
  for (const Watcher& watcher : watchers_) due = std::min(due, watcher.due);
  if (due == timer_due_) return;
  if (timer_due_ != Clock::time_point::max()) hub_.cancel(timer_);
  timer_due_ = due;
  if (due == Clock::time_point::max()) return;
  const auto delay =
      std::chrono::ceil<std::chrono::microseconds>(std::max(due - now, Clock::duration(0)));
  timer_ = hub_.after(delay, [weak = std::weak_ptr<WatchHub*>(self_)] {
    const auto self = weak.lock();
    if (!self) return;
    (*self)->timer_due_ = Clock::time_point::max();
    (*self)->tick(Clock::now());
  });
}

}  // namespace playerlike::server
