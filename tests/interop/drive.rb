# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Drives a robot with ruby-player; other_languages.sh runs it.
require 'ruby-player'

Player::Client.connect(ARGV[0], port: ARGV[1].to_i, log_level: :warn) do |client|
  position = client.subscribe(:position2d)
  ranger = client.subscribe(:ranger)
  power = client.subscribe(:power)
  gripper = client.subscribe(:gripper)
  position.query_geom
  ranger.query_config
  position.set_speed(vx: 0.3, vy: 0, va: 0.2)
  100.times { client.read! }
  position.stop!
  gripper.close!
  10.times { client.read! }
  puts "position: #{position.state}", "size: #{position.geom}"
  puts "ranger: #{ranger.count} beams, #{ranger[0].range} m, #{ranger.config}"
  puts "power: #{power.state}", "gripper: #{gripper.state}"
end
