// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Devices that no world has: their structs can be made, and all that is asked of them is refused.
#include <string>

#include "playerc/device.h"

namespace {

// Never made: what is missing cannot be subscribed to.
class NoProxy final : public PlayerCc::ClientProxy {
 public:
  NoProxy(PlayerCc::PlayerClient* client, uint32_t index) : ClientProxy(client, index) {}
};

template <typename CStruct>
class Missing final : public playerlike::clib::Backed<CStruct, NoProxy> {
  void attach(PlayerCc::PlayerClient& player) override {
    const player_devaddr_t& addr = this->info.addr;
    // Says what there is instead.
    playerlike::clib::refuse("the C library cannot use a device of the kind \"" +
                             playerlike::clib::driver_at(player, addr.interf, addr.index) + '"');
  }
};

int refused(const char* fun) {
  playerlike::clib::set_error(fun, "no world has such a device");
  return -1;
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(actarray, Missing<playerc_actarray_t>, PLAYER_ACTARRAY_CODE)
player_actarray_actuator_t playerc_actarray_get_actuator_data(playerc_actarray_t* /*device*/,
                                                              uint32_t /*index*/) {
  refused(__func__);
  return {};
}
player_actarray_actuatorgeom_t playerc_actarray_get_actuator_geom(playerc_actarray_t* /*device*/,
                                                                  uint32_t /*index*/) {
  refused(__func__);
  return {};
}
int playerc_actarray_get_geom(playerc_actarray_t* /*device*/) { return refused(__func__); }
int playerc_actarray_position_cmd(playerc_actarray_t* /*device*/, int /*joint*/,
                                  float /*position*/) {
  return refused(__func__);
}
int playerc_actarray_multi_position_cmd(playerc_actarray_t* /*device*/, float* /*positions*/,
                                        int /*positions_count*/) {
  return refused(__func__);
}
int playerc_actarray_speed_cmd(playerc_actarray_t* /*device*/, int /*joint*/, float /*speed*/) {
  return refused(__func__);
}
int playerc_actarray_multi_speed_cmd(playerc_actarray_t* /*device*/, float* /*speeds*/,
                                     int /*speeds_count*/) {
  return refused(__func__);
}
int playerc_actarray_home_cmd(playerc_actarray_t* /*device*/, int /*joint*/) {
  return refused(__func__);
}
int playerc_actarray_current_cmd(playerc_actarray_t* /*device*/, int /*joint*/, float /*current*/) {
  return refused(__func__);
}
int playerc_actarray_multi_current_cmd(playerc_actarray_t* /*device*/, float* /*currents*/,
                                       int /*currents_count*/) {
  return refused(__func__);
}
int playerc_actarray_power(playerc_actarray_t* /*device*/, uint8_t /*enable*/) {
  return refused(__func__);
}
int playerc_actarray_brakes(playerc_actarray_t* /*device*/, uint8_t /*enable*/) {
  return refused(__func__);
}
int playerc_actarray_speed_config(playerc_actarray_t* /*device*/, int /*joint*/, float /*speed*/) {
  return refused(__func__);
}
int playerc_actarray_accel_config(playerc_actarray_t* /*device*/, int /*joint*/, float /*accel*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(audio, Missing<playerc_audio_t>, PLAYER_AUDIO_CODE)
int playerc_audio_wav_play_cmd(playerc_audio_t* /*device*/, uint32_t /*data_count*/,
                               uint8_t /*data*/[], uint32_t /*format*/) {
  return refused(__func__);
}
int playerc_audio_wav_stream_rec_cmd(playerc_audio_t* /*device*/, uint8_t /*state*/) {
  return refused(__func__);
}
int playerc_audio_sample_play_cmd(playerc_audio_t* /*device*/, int /*index*/) {
  return refused(__func__);
}
int playerc_audio_seq_play_cmd(playerc_audio_t* /*device*/, player_audio_seq_t* /*tones*/) {
  return refused(__func__);
}
int playerc_audio_mixer_multchannels_cmd(playerc_audio_t* /*device*/,
                                         player_audio_mixer_channel_list_t* /*levels*/) {
  return refused(__func__);
}
int playerc_audio_mixer_channel_cmd(playerc_audio_t* /*device*/, uint32_t /*index*/,
                                    float /*amplitude*/, uint8_t /*active*/) {
  return refused(__func__);
}
int playerc_audio_wav_rec(playerc_audio_t* /*device*/) { return refused(__func__); }
int playerc_audio_sample_load(playerc_audio_t* /*device*/, int /*index*/, uint32_t /*data_count*/,
                              uint8_t /*data*/[], uint32_t /*format*/) {
  return refused(__func__);
}
int playerc_audio_sample_retrieve(playerc_audio_t* /*device*/, int /*index*/) {
  return refused(__func__);
}
int playerc_audio_sample_rec(playerc_audio_t* /*device*/, int /*index*/, uint32_t /*length*/) {
  return refused(__func__);
}
int playerc_audio_get_mixer_levels(playerc_audio_t* /*device*/) { return refused(__func__); }
int playerc_audio_get_mixer_details(playerc_audio_t* /*device*/) { return refused(__func__); }

PLAYERLIKE_CLIB_FRAME(blackboard, Missing<playerc_blackboard_t>, PLAYER_BLACKBOARD_CODE)
int playerc_blackboard_subscribe_to_key(playerc_blackboard_t* /*device*/, const char* /*key*/,
                                        const char* /*group*/,
                                        player_blackboard_entry_t** /*entry*/) {
  return refused(__func__);
}
int playerc_blackboard_get_entry(playerc_blackboard_t* /*device*/, const char* /*key*/,
                                 const char* /*group*/, player_blackboard_entry_t** /*entry*/) {
  return refused(__func__);
}
int playerc_blackboard_unsubscribe_from_key(playerc_blackboard_t* /*device*/, const char* /*key*/,
                                            const char* /*group*/) {
  return refused(__func__);
}
int playerc_blackboard_subscribe_to_group(playerc_blackboard_t* /*device*/, const char* /*group*/) {
  return refused(__func__);
}
int playerc_blackboard_unsubscribe_from_group(playerc_blackboard_t* /*device*/,
                                              const char* /*group*/) {
  return refused(__func__);
}
int playerc_blackboard_set_entry(playerc_blackboard_t* /*device*/,
                                 player_blackboard_entry_t* /*entry*/) {
  return refused(__func__);
}
int playerc_blackboard_set_string(playerc_blackboard_t* /*device*/, const char* /*key*/,
                                  const char* /*group*/, const char* /*value*/) {
  return refused(__func__);
}
int playerc_blackboard_set_int(playerc_blackboard_t* /*device*/, const char* /*key*/,
                               const char* /*group*/, const int /*value*/) {
  return refused(__func__);
}
int playerc_blackboard_set_double(playerc_blackboard_t* /*device*/, const char* /*key*/,
                                  const char* /*group*/, const double /*value*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(coopobject, Missing<playerc_coopobject_t>, PLAYER_COOPOBJECT_CODE)
int playerc_coopobject_send_position(playerc_coopobject_t* /*device*/, uint16_t /*node_id*/,
                                     uint16_t /*source_id*/, player_pose2d_t /*pos*/,
                                     uint8_t /*status*/) {
  return refused(__func__);
}
int playerc_coopobject_send_data(playerc_coopobject_t* /*device*/, int /*node_id*/,
                                 int /*source_id*/, int /*data_type*/, int /*data_size*/,
                                 unsigned char* /*extradata*/) {
  return refused(__func__);
}
int playerc_coopobject_send_cmd(playerc_coopobject_t* /*device*/, int /*node_id*/,
                                int /*source_id*/, int /*cmd*/, int /*parameters_size*/,
                                unsigned char* /*parameters*/) {
  return refused(__func__);
}
int playerc_coopobject_send_req(playerc_coopobject_t* /*device*/, int /*node_id*/,
                                int /*source_id*/, int /*req*/, int /*parameters_size*/,
                                unsigned char* /*parameters*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(graphics3d, Missing<playerc_graphics3d_t>, PLAYER_GRAPHICS3D_CODE)
int playerc_graphics3d_setcolor(playerc_graphics3d_t* /*device*/, player_color_t /*col*/) {
  return refused(__func__);
}
int playerc_graphics3d_draw(playerc_graphics3d_t* /*device*/,
                            player_graphics3d_draw_mode_t /*mode*/, player_point_3d_t /*pts*/[],
                            int /*count*/) {
  return refused(__func__);
}
int playerc_graphics3d_clear(playerc_graphics3d_t* /*device*/) { return refused(__func__); }
int playerc_graphics3d_translate(playerc_graphics3d_t* /*device*/, double /*x*/, double /*y*/,
                                 double /*z*/) {
  return refused(__func__);
}
int playerc_graphics3d_rotate(playerc_graphics3d_t* /*device*/, double /*a*/, double /*x*/,
                              double /*y*/, double /*z*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(health, Missing<playerc_health_t>, PLAYER_HEALTH_CODE)

PLAYERLIKE_CLIB_FRAME(joystick, Missing<playerc_joystick_t>, PLAYER_JOYSTICK_CODE)

PLAYERLIKE_CLIB_FRAME(limb, Missing<playerc_limb_t>, PLAYER_LIMB_CODE)
int playerc_limb_get_geom(playerc_limb_t* /*device*/) { return refused(__func__); }
int playerc_limb_home_cmd(playerc_limb_t* /*device*/) { return refused(__func__); }
int playerc_limb_stop_cmd(playerc_limb_t* /*device*/) { return refused(__func__); }
int playerc_limb_setpose_cmd(playerc_limb_t* /*device*/, float /*pX*/, float /*pY*/, float /*pZ*/,
                             float /*aX*/, float /*aY*/, float /*aZ*/, float /*oX*/, float /*oY*/,
                             float /*oZ*/) {
  return refused(__func__);
}
int playerc_limb_setposition_cmd(playerc_limb_t* /*device*/, float /*pX*/, float /*pY*/,
                                 float /*pZ*/) {
  return refused(__func__);
}
int playerc_limb_vecmove_cmd(playerc_limb_t* /*device*/, float /*x*/, float /*y*/, float /*z*/,
                             float /*length*/) {
  return refused(__func__);
}
int playerc_limb_power(playerc_limb_t* /*device*/, uint32_t /*enable*/) {
  return refused(__func__);
}
int playerc_limb_brakes(playerc_limb_t* /*device*/, uint32_t /*enable*/) {
  return refused(__func__);
}
int playerc_limb_speed_config(playerc_limb_t* /*device*/, float /*speed*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(vectormap, Missing<playerc_vectormap_t>, PLAYER_VECTORMAP_CODE)
int playerc_vectormap_get_map_info(playerc_vectormap_t* /*device*/) { return refused(__func__); }
int playerc_vectormap_get_layer_data(playerc_vectormap_t* /*device*/, unsigned /*layer_index*/) {
  return refused(__func__);
}
int playerc_vectormap_write_layer(playerc_vectormap_t* /*device*/,
                                  const player_vectormap_layer_data_t* /*data*/) {
  return refused(__func__);
}
void playerc_vectormap_cleanup(playerc_vectormap_t* /*device*/) { refused(__func__); }
uint8_t* playerc_vectormap_get_feature_data(playerc_vectormap_t* /*device*/,
                                            unsigned /*layer_index*/, unsigned /*feature_index*/) {
  refused(__func__);
  return {};
}
size_t playerc_vectormap_get_feature_data_count(playerc_vectormap_t* /*device*/,
                                                unsigned /*layer_index*/,
                                                unsigned /*feature_index*/) {
  refused(__func__);
  return {};
}

PLAYERLIKE_CLIB_FRAME(planner, Missing<playerc_planner_t>, PLAYER_PLANNER_CODE)
int playerc_planner_set_cmd_pose(playerc_planner_t* /*device*/, double /*gx*/, double /*gy*/,
                                 double /*ga*/) {
  return refused(__func__);
}
int playerc_planner_set_cmd_start(playerc_planner_t* /*device*/, double /*sx*/, double /*sy*/,
                                  double /*sa*/) {
  return refused(__func__);
}
int playerc_planner_get_waypoints(playerc_planner_t* /*device*/) { return refused(__func__); }
int playerc_planner_enable(playerc_planner_t* /*device*/, int /*state*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(position1d, Missing<playerc_position1d_t>, PLAYER_POSITION1D_CODE)
int playerc_position1d_enable(playerc_position1d_t* /*device*/, int /*enable*/) {
  return refused(__func__);
}
int playerc_position1d_get_geom(playerc_position1d_t* /*device*/) { return refused(__func__); }
int playerc_position1d_set_cmd_vel(playerc_position1d_t* /*device*/, double /*vel*/,
                                   int /*state*/) {
  return refused(__func__);
}
int playerc_position1d_set_cmd_pos(playerc_position1d_t* /*device*/, double /*pos*/,
                                   int /*state*/) {
  return refused(__func__);
}
int playerc_position1d_set_cmd_pos_with_vel(playerc_position1d_t* /*device*/, double /*pos*/,
                                            double /*vel*/, int /*state*/) {
  return refused(__func__);
}
int playerc_position1d_set_odom(playerc_position1d_t* /*device*/, double /*odom*/) {
  return refused(__func__);
}

PLAYERLIKE_CLIB_FRAME(position3d, Missing<playerc_position3d_t>, PLAYER_POSITION3D_CODE)
int playerc_position3d_enable(playerc_position3d_t* /*device*/, int /*enable*/) {
  return refused(__func__);
}
int playerc_position3d_get_geom(playerc_position3d_t* /*device*/) { return refused(__func__); }
int playerc_position3d_set_velocity(playerc_position3d_t* /*device*/, double /*vx*/, double /*vy*/,
                                    double /*vz*/, double /*vr*/, double /*vp*/, double /*vt*/,
                                    int /*state*/) {
  return refused(__func__);
}
int playerc_position3d_set_speed(playerc_position3d_t* /*device*/, double /*vx*/, double /*vy*/,
                                 double /*vz*/, int /*state*/) {
  return refused(__func__);
}
int playerc_position3d_set_pose(playerc_position3d_t* /*device*/, double /*gx*/, double /*gy*/,
                                double /*gz*/, double /*gr*/, double /*gp*/, double /*gt*/) {
  return refused(__func__);
}
int playerc_position3d_set_pose_with_vel(playerc_position3d_t* /*device*/, player_pose3d_t /*pos*/,
                                         player_pose3d_t /*vel*/) {
  return refused(__func__);
}
int playerc_position3d_set_cmd_pose(playerc_position3d_t* /*device*/, double /*gx*/, double /*gy*/,
                                    double /*gz*/) {
  return refused(__func__);
}
int playerc_position3d_set_vel_mode(playerc_position3d_t* /*device*/, int /*mode*/) {
  return refused(__func__);
}
int playerc_position3d_set_odom(playerc_position3d_t* /*device*/, double /*ox*/, double /*oy*/,
                                double /*oz*/, double /*oroll*/, double /*opitch*/,
                                double /*oyaw*/) {
  return refused(__func__);
}
int playerc_position3d_reset_odom(playerc_position3d_t* /*device*/) { return refused(__func__); }

PLAYERLIKE_CLIB_FRAME(speechrecognition, Missing<playerc_speechrecognition_t>,
                      PLAYER_SPEECH_RECOGNITION_CODE)

PLAYERLIKE_CLIB_FRAME(rfid, Missing<playerc_rfid_t>, PLAYER_RFID_CODE)

PLAYERLIKE_CLIB_FRAME(pointcloud3d, Missing<playerc_pointcloud3d_t>, PLAYER_POINTCLOUD3D_CODE)

PLAYERLIKE_CLIB_FRAME(stereo, Missing<playerc_stereo_t>, PLAYER_STEREO_CODE)

PLAYERLIKE_CLIB_FRAME(wsn, Missing<playerc_wsn_t>, PLAYER_WSN_CODE)
int playerc_wsn_set_devstate(playerc_wsn_t* /*device*/, int /*node_id*/, int /*group_id*/,
                             int /*devnr*/, int /*state*/) {
  return refused(__func__);
}
int playerc_wsn_power(playerc_wsn_t* /*device*/, int /*node_id*/, int /*group_id*/, int /*value*/) {
  return refused(__func__);
}
int playerc_wsn_datatype(playerc_wsn_t* /*device*/, int /*value*/) { return refused(__func__); }
int playerc_wsn_datafreq(playerc_wsn_t* /*device*/, int /*node_id*/, int /*group_id*/,
                         double /*frequency*/) {
  return refused(__func__);
}
