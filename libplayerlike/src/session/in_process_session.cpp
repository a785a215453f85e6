// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/in_process_session.h"

#include <algorithm>
#include <utility>

#include "session/checks.h"

namespace playerlike {
namespace {

// Tells the hosts that a thread has waited on when that thread ends, so that nobody waits for it.
class Farewell {
 public:
  Farewell() = default;
  Farewell(const Farewell&) = delete;
  Farewell& operator=(const Farewell&) = delete;
  ~Farewell() {
    for (const Known& known : hosts_) {
      if (const std::shared_ptr<Host> host = known.host.lock()) {
        host->thinker_ended(this_thinker());
      }
    }
  }

  void remember(const std::shared_ptr<Host>& host) {
    for (const Known& known : hosts_) {
      if (known.address == host.get() && !known.host.expired()) return;
    }
    std::erase_if(hosts_, [](const Known& known) { return known.host.expired(); });
    hosts_.push_back({host.get(), host});
  }

 private:
  struct Known {
    const Host* address;
    std::weak_ptr<Host> host;
  };
  std::vector<Known> hosts_;
};

thread_local Farewell farewell;

}  // namespace

InProcessSession::InProcessSession(std::shared_ptr<Host> host, std::shared_ptr<Client> client)
    : host_(std::move(host)), client_(std::move(client)) {}

InProcessSession::~InProcessSession() { close(); }

const std::vector<RobotInfo>& InProcessSession::robots() const noexcept {
  return host_->core_->robots();
}
int InProcessSession::port() const noexcept { return client_->port; }
bool InProcessSession::connected() const noexcept { return !client_->closed; }

void InProcessSession::subscribe(DeviceId device) {
  const DeviceInfo& info = require_device(robots(), device);
  if (!host_->core_->is_sensor(device)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "device " + info.name + " is no sensor: it has no readings");
  }
  host_->core_->subscribe(*client_, device);
}

void InProcessSession::unsubscribe(DeviceId device) { host_->core_->unsubscribe(*client_, device); }

void InProcessSession::set_replace(std::optional<DeviceId> device, bool replace) {
  host_->core_->set_replace(*client_, device, replace);
}

std::uint32_t InProcessSession::overflow_count() const { return host_->core_->overflow(*client_); }

void InProcessSession::wait() {
  farewell.remember(host_);
  host_->core_->wait(*client_);
}

int InProcessSession::take(ReadingSink& sink) { return host_->core_->take(*client_, sink); }

bool InProcessSession::peek(std::chrono::milliseconds timeout) {
  farewell.remember(host_);
  return host_->core_->peek(*client_, std::max(timeout, std::chrono::milliseconds(0)));
}

void InProcessSession::send(DeviceId device, const sim::Command& command) {
  require_device(robots(), device);
  require_finite(command);
  host_->core_->send(*client_, device, command);
}

void InProcessSession::join() {
  farewell.remember(host_);
  host_->core_->join(*client_, this_thinker());
}

std::unique_ptr<Session> InProcessSession::open_follower() {
  return std::make_unique<InProcessSession>(
      host_, host_->core_->add_client(client_->port, /*follower=*/true));
}

const void* InProcessSession::simulation() const noexcept { return host_.get(); }

DrawQueue& InProcessSession::draw_queue() noexcept { return client_->drawings; }

void InProcessSession::flush_drawings() { host_->core_->flush_drawings(*client_); }

void InProcessSession::draw_cells(sim::LayerId layer, const sim::CellRect& rect,
                                  std::span<const sim::CellValue> values) {
  require_cells(rect, values.size());
  host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    book.require(client_->number, layer);
    layers.set_cells(layer, rect, values);
  });
}

std::optional<sim::CellValue> InProcessSession::cell(sim::LayerId layer, int column, int row) {
  return host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    book.require(client_->number, layer);
    return layers.cell(layer, column, row);
  });
}

std::vector<sim::CellValue> InProcessSession::cells(sim::LayerId layer) {
  return host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    book.require(client_->number, layer);
    return layers.cells(layer);
  });
}

sim::LayerId InProcessSession::create_layer(sim::LayerKind kind, sim::LayerStyle style) {
  return host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, LayerBook& book) {
    return book.create(layers, client_->number, client_->port, kind, std::move(style));
  });
}

void InProcessSession::remove_layer(sim::LayerId layer) {
  host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, LayerBook& book) {
    book.remove(layers, client_->number, layer);
  });
}

void InProcessSession::set_layer_style(sim::LayerId layer, sim::LayerStyle style) {
  host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, LayerBook& book) {
    book.set_style(layers, client_->number, layer, std::move(style));
  });
}

std::vector<sim::LayerInfo> InProcessSession::layers() {
  return host_->core_->with_layers(*client_, [&](sim::LayerStack& layers, const LayerBook& book) {
    return book.list(layers, client_->number);
  });
}

std::vector<std::uint8_t> InProcessSession::canvas_image() {
  return host_->core_->with_layers(
      *client_, [](sim::LayerStack& layers, const LayerBook&) { return layers.composed(); });
}

void InProcessSession::resize_canvas(int width, int height) {
  host_->core_->resize_canvas(*client_, width, height);
}

CanvasInfo InProcessSession::canvas_info() const { return host_->core_->canvas_info(); }

std::uint64_t InProcessSession::canvas_generation() const noexcept {
  return host_->core_->canvas_generation();
}

void InProcessSession::save_image(const std::string& name, int scale) {
  host_->core_->save_image(*client_, name, scale);
}

sim::ViewMode InProcessSession::view_mode() const { return host_->core_->view_mode(); }

void InProcessSession::set_view_mode(sim::ViewMode mode) {
  host_->core_->set_view_mode(*client_, mode);
}

sim::OccupancyMap InProcessSession::world_map(double cell_size_m) {
  return host_->core_->world_map(cell_size_m);
}

ObjectPose InProcessSession::object_pose(const std::string& name) {
  return host_->core_->object_pose(*client_, name);
}

void InProcessSession::place_object(const std::string& name, const sim::Pose& pose) {
  host_->core_->place_object(*client_, name, pose);
}

PropertyValue InProcessSession::object_property(const std::string& name,
                                                const std::string& property) {
  return host_->core_->object_property(*client_, name, property);
}

void InProcessSession::set_object_property(const std::string& name, const std::string& property,
                                           const PropertyValue& value) {
  host_->core_->set_object_property(*client_, name, property, value);
}

LogStatus InProcessSession::control_log(const LogControl& changes) {
  return host_->core_->control_log(*client_, changes);
}

TimeStatistics InProcessSession::time() const { return host_->core_->time(); }

void InProcessSession::sleep(double seconds) {
  farewell.remember(host_);
  host_->core_->sleep(*client_, seconds);
}

void InProcessSession::prefer_real_time(const std::string& reason) {
  host_->core_->prefer_real_time(reason);
}

void InProcessSession::close() noexcept { host_->core_->remove_client(*client_); }

}  // namespace playerlike
