// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "host/core.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// The calling thread lives in virtual time: that is to be told when it ends.
void remember_thread();

/// A session with a simulation in this process: calls, not messages.
class InProcessSession final : public Session {
 public:
  InProcessSession(std::shared_ptr<Host> host, std::shared_ptr<Client> client);
  ~InProcessSession() override;

  const std::vector<RobotInfo>& robots() const noexcept override;
  int port() const noexcept override;
  bool connected() const noexcept override;

  void subscribe(DeviceId device) override;
  void unsubscribe(DeviceId device) override;
  void set_replace(std::optional<DeviceId> device, bool replace) override;
  std::uint32_t overflow_count() const override;

  void wait() override;
  int take(ReadingSink& sink) override;
  bool peek(std::chrono::milliseconds timeout) override;
  void send(DeviceId device, const sim::Command& command) override;
  void note_looks(int count, bool has_data) override;
  void join() override;
  std::unique_ptr<Session> open_follower() override;
  const void* simulation() const noexcept override;
  DrawQueue& draw_queue() noexcept override;
  void flush_drawings() override;
  void draw_cells(sim::LayerId layer, const sim::CellRect& rect,
                  std::span<const sim::CellValue> values) override;
  std::optional<sim::CellValue> cell(sim::LayerId layer, int column, int row) override;
  std::vector<sim::CellValue> cells(sim::LayerId layer) override;
  sim::LayerId create_layer(sim::LayerKind kind, sim::LayerStyle style) override;
  void remove_layer(sim::LayerId layer) override;
  void set_layer_style(sim::LayerId layer, sim::LayerStyle style) override;
  std::vector<sim::LayerInfo> layers() override;
  std::vector<std::uint8_t> canvas_image() override;
  void resize_canvas(int width, int height) override;
  CanvasInfo canvas_info() const override;
  std::uint64_t canvas_generation() const noexcept override;
  void save_image(const std::string& name, int scale, std::optional<sim::LayerId> layer) override;
  void save_map(sim::LayerId layer, const std::string& name, sim::io::MapMode mode) override;
  sim::ViewMode view_mode() const override;
  void set_view_mode(sim::ViewMode mode) override;
  sim::OccupancyMap world_map(double cell_size_m) override;
  ObjectPose object_pose(const std::string& name) override;
  void place_object(const std::string& name, const sim::Pose& pose) override;
  PropertyValue object_property(const std::string& name, const std::string& property) override;
  void set_object_property(const std::string& name, const std::string& property,
                           const PropertyValue& value) override;
  LogStatus control_log(const LogControl& changes) override;
  TimeStatistics time() const override;
  void sleep(double seconds) override;
  void prefer_real_time(const std::string& reason) override;
  void close() noexcept override;

 private:
  [[nodiscard]] InsideCore core() const noexcept;
  void note_wait() const;

  std::shared_ptr<Host> host_;
  std::shared_ptr<Client> client_;
};

}  // namespace playerlike
