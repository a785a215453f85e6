// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/in_process_session.h"

#include <algorithm>
#include <utility>

#include "session/checks.h"
#include "session/farewell.h"

namespace playerlike {
namespace {

// Nobody is to wait for a thread that has ended.
thread_local Farewell<Host> farewell_to_host([](Host& host) {
  host.thinker_ended(this_thinker());
});

// Virtual time, too, is to know when a thread that lives in it ends.
struct VirtualLife {
  VirtualLife() = default;
  VirtualLife(const VirtualLife&) = delete;
  VirtualLife& operator=(const VirtualLife&) = delete;
  ~VirtualLife() {
    if (lived) virtual_time::note_thread_ends();
  }
  bool lived = false;
};
thread_local VirtualLife virtual_life;

}  // namespace

void remember_thread() { virtual_life.lived = true; }

InProcessSession::InProcessSession(std::shared_ptr<Host> host, std::shared_ptr<Client> client)
    : host_(std::move(host)), client_(std::move(client)) {}

InProcessSession::~InProcessSession() { close(); }

InsideCore InProcessSession::core() const noexcept { return InsideCore(*host_->core_); }

void InProcessSession::note_wait() const {
  farewell_to_host.remember(host_);
  // Drivers are Playpen's own.
  if (client_->follower || !virtual_time::active()) return;
  remember_thread();
  virtual_time::note_wait();
}

const std::vector<RobotInfo>& InProcessSession::robots() const noexcept { return core()->robots(); }
int InProcessSession::port() const noexcept { return client_->port; }
bool InProcessSession::connected() const noexcept { return !client_->closed; }

void InProcessSession::subscribe(DeviceId device) {
  const DeviceInfo& info = require_device(robots(), device);
  if (!core()->is_sensor(device)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "device " + info.name + " is no sensor: it has no readings");
  }
  core()->subscribe(*client_, device);
}

void InProcessSession::unsubscribe(DeviceId device) { core()->unsubscribe(*client_, device); }

void InProcessSession::set_replace(std::optional<DeviceId> device, bool replace) {
  core()->set_replace(*client_, device, replace);
}

std::uint32_t InProcessSession::overflow_count() const { return core()->overflow(*client_); }

void InProcessSession::wait() {
  note_wait();
  core()->wait(*client_);
}

int InProcessSession::take(ReadingSink& sink) { return core()->take(*client_, sink); }

bool InProcessSession::peek(std::chrono::milliseconds timeout) {
  note_wait();
  return core()->peek(*client_, std::max(timeout, std::chrono::milliseconds(0)));
}

void InProcessSession::send(DeviceId device, const sim::Command& command) {
  require_device(robots(), device);
  require_finite(command);
  core()->send(*client_, device, command);
}

void InProcessSession::note_looks(int count, bool has_data) {
  core()->note_looks(*client_, count, has_data);
}

void InProcessSession::join() {
  note_wait();
  core()->join(*client_, this_thinker());
}

std::unique_ptr<Session> InProcessSession::open_follower() {
  return std::make_unique<InProcessSession>(host_,
                                            core()->add_client(client_->port, /*follower=*/true));
}

const void* InProcessSession::simulation() const noexcept { return host_.get(); }

DrawQueue& InProcessSession::draw_queue() noexcept { return client_->drawings; }

void InProcessSession::flush_drawings() { core()->flush_drawings(*client_); }

void InProcessSession::draw_cells(sim::LayerId layer, const sim::CellRect& rect,
                                  std::span<const sim::CellValue> values) {
  require_cells(rect, values.size());
  core()->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    book.require(client_->number, layer);
    layers.set_cells(layer, rect, values);
  });
}

std::optional<sim::CellValue> InProcessSession::cell(sim::LayerId layer, int column, int row) {
  return core()->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    book.require(client_->number, layer);
    return layers.cell(layer, column, row);
  });
}

std::vector<sim::CellValue> InProcessSession::cells(sim::LayerId layer) {
  return core()->cells(*client_, layer);
}

sim::LayerId InProcessSession::create_layer(sim::LayerKind kind, sim::LayerStyle style) {
  return core()->with_layers(*client_, [&](sim::LayerStack& layers, LayerBook& book) {
    return book.create(layers, client_->number, client_->port, kind, std::move(style));
  });
}

void InProcessSession::remove_layer(sim::LayerId layer) {
  core()->with_layers(*client_, [&](sim::LayerStack& layers, LayerBook& book) {
    book.remove(layers, client_->number, layer);
  });
}

void InProcessSession::set_layer_style(sim::LayerId layer, sim::LayerStyle style) {
  core()->with_layers(*client_, [&](sim::LayerStack& layers, LayerBook& book) {
    book.set_style(layers, client_->number, layer, std::move(style));
  });
}

std::vector<sim::LayerInfo> InProcessSession::layers() {
  return core()->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    return book.list(layers, client_->number);
  });
}

std::vector<std::uint8_t> InProcessSession::canvas_image() {
  sim::CanvasDescription canvas;
  return core()->picture(*client_, std::nullopt, canvas);
}

void InProcessSession::resize_canvas(int width, int height) {
  core()->resize_canvas(*client_, width, height);
}

CanvasInfo InProcessSession::canvas_info() const { return core()->canvas_info(); }

std::uint64_t InProcessSession::canvas_generation() const noexcept {
  return core()->canvas_generation();
}

void InProcessSession::save_image(const std::string& name, int scale,
                                  std::optional<sim::LayerId> layer) {
  core()->save_image(*client_, name, scale, layer);
}

void InProcessSession::save_map(sim::LayerId layer, const std::string& name,
                                sim::io::MapMode mode) {
  core()->save_map(*client_, layer, name, mode);
}

sim::ViewMode InProcessSession::view_mode() const { return core()->view_mode(); }

void InProcessSession::set_view_mode(sim::ViewMode mode) { core()->set_view_mode(*client_, mode); }

sim::OccupancyMap InProcessSession::world_map(double cell_size_m) {
  return core()->world_map(*client_, cell_size_m);
}

ObjectPose InProcessSession::object_pose(const std::string& name) {
  return core()->object_pose(*client_, name);
}

void InProcessSession::place_object(const std::string& name, const sim::Pose& pose) {
  core()->place_object(*client_, name, pose);
}

PropertyValue InProcessSession::object_property(const std::string& name,
                                                const std::string& property) {
  return core()->object_property(*client_, name, property);
}

void InProcessSession::set_object_property(const std::string& name, const std::string& property,
                                           const PropertyValue& value) {
  core()->set_object_property(*client_, name, property, value);
}

LogStatus InProcessSession::control_log(const LogControl& changes) {
  return core()->control_log(*client_, changes);
}

TimeStatistics InProcessSession::time() const { return core()->time(); }

void InProcessSession::sleep(double seconds) {
  note_wait();
  core()->sleep(*client_, seconds);
}

void InProcessSession::prefer_real_time(const std::string& reason) {
  note_wait();
  core()->prefer_real_time(reason);
}

void InProcessSession::close() noexcept { core()->remove_client(*client_); }

}  // namespace playerlike
