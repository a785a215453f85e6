// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Proxies of sound, sensor networks and other things beside robots. Programs with them compile; no
/// device of Playpen carries their interfaces.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libplayerc++/proxywithoutdevice.h"

namespace PlayerCc {

/// Sound: playing, recording, mixing. (SpeechProxy works.)
class AudioProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  AudioProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_AUDIO_CODE, "AudioProxy::AudioProxy") {}

  /// How many channels the mixer describes.
  uint32_t GetMixerDetailsCount() const { return NoDevice(); }
  /// What the mixer says of a channel.
  player_audio_mixer_channel_detail_t GetMixerDetails(int /*aIndex*/) const { return NoDevice(); }
  /// The channel that sound goes to.
  uint32_t GetDefaultOutputChannel() const { return NoDevice(); }
  /// The channel that sound comes from.
  uint32_t GetDefaultInputChannel() const { return NoDevice(); }
  /// Size of the sound recorded [bytes].
  uint32_t GetWavDataLength() const { return NoDevice(); }
  /// Copies the sound recorded.
  void GetWavData(uint8_t* /*aData*/) const { NoDevice(); }
  /// How many tones the sequence has.
  uint32_t GetSeqCount() const { return NoDevice(); }
  /// A tone of the sequence.
  player_audio_seq_item_t GetSeqItem(int /*aIndex*/) const { return NoDevice(); }
  /// How many channels there are.
  uint32_t GetChannelCount() const { return NoDevice(); }
  /// Level of a channel.
  player_audio_mixer_channel_t GetChannel(int /*aIndex*/) const { return NoDevice(); }
  /// Bits PLAYER_AUDIO_STATE_...
  uint32_t GetState() const { return NoDevice(); }
  /// Plays a sound.
  void PlayWav(uint32_t /*aDataCount*/, uint8_t* /*aData*/, uint32_t /*aFormat*/) { NoDevice(); }
  /// Starts or stops recording.
  void SetWavStremRec(bool /*aState*/) { NoDevice(); }
  /// Plays a sound stored in the device.
  void PlaySample(int /*aIndex*/) { NoDevice(); }
  /// Plays a sequence of tones.
  void PlaySeq(player_audio_seq_t* /*aTones*/) { NoDevice(); }
  /// Sets the levels of several channels.
  void SetMultMixerLevels(player_audio_mixer_channel_list_t* /*aLevels*/) { NoDevice(); }
  /// Sets the level of a channel, 0 to 1, and whether it is on.
  void SetMixerLevel(uint32_t /*index*/, float /*amplitude*/, uint8_t /*active*/) { NoDevice(); }
  /// Records a sound.
  void RecordWav() { NoDevice(); }
  /// Stores a sound in the device.
  void LoadSample(int /*aIndex*/, uint32_t /*aDataCount*/, uint8_t* /*aData*/,
                  uint32_t /*aFormat*/) {
    NoDevice();
  }
  /// Fetches a sound stored in the device.
  void GetSample(int /*aIndex*/) { NoDevice(); }
  /// Records a sound into the device for a time [ms].
  void RecordSample(int /*aIndex*/, uint32_t /*aLength*/) { NoDevice(); }
  /// Asks for the channels' levels.
  void GetMixerLevels() { NoDevice(); }
  /// Asks for what the mixer says of its channels.
  void GetMixerDetails() { NoDevice(); }
};

/// Values by key that programs share.
class BlackBoardProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  BlackBoardProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_BLACKBOARD_CODE,
                           "BlackBoardProxy::BlackBoardProxy") {}

  /// Reads a value and lets its changes be told.
  player_blackboard_entry_t* SubscribeToKey(const char* /*key*/, const char* /*group*/ = "") {
    return NoDevice();
  }
  /// Ends that.
  void UnsubscribeFromKey(const char* /*key*/, const char* /*group*/ = "") { NoDevice(); }
  /// Lets the changes of a group's values be told.
  void SubscribeToGroup(const char* /*key*/) { NoDevice(); }
  /// Ends that.
  void UnsubscribeFromGroup(const char* /*group*/) { NoDevice(); }
  /// Writes a value.
  void SetEntry(const player_blackboard_entry_t& /*entry*/) { NoDevice(); }
  /// Reads a value.
  player_blackboard_entry_t* GetEntry(const char* /*key*/, const char* /*group*/) {
    return NoDevice();
  }
  /// Sets what is called when a value has changed.
  void SetEventHandler(void (* /*aHandler*/)(playerc_blackboard_t*, player_blackboard_entry_t)) {
    NoDevice();
  }
};

/// Nodes of a sensor network that messages come from and go to.
class CoopObjectProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  CoopObjectProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_COOPOBJECT_CODE,
                           "CoopObjectProxy::CoopObjectProxy") {}

  /// Kind of the newest message.
  int MessageType() const { return NoDevice(); }
  /// Where it comes from.
  uint32_t GetOrigin() const { return NoDevice(); }
  /// Its node.
  uint32_t GetID() const { return NoDevice(); }
  /// The node above that.
  uint32_t GetParentID() const { return NoDevice(); }
  /// The proxy's own number.
  uint32_t GetProxyID() const { return NoDevice(); }
  /// Sets the proxy's own number.
  void SetProxyID(uint32_t /*value*/) { NoDevice(); }
  /// How many sensors the message tells of.
  uint32_t GetSensorNumber() const { return NoDevice(); }
  /// Kind of a sensor.
  uint8_t GetSensorType(uint32_t /*index*/) const { return NoDevice(); }
  /// Reading of a sensor.
  uint16_t GetSensorData(uint32_t /*index*/) const { return NoDevice(); }
  /// How many alarms the message tells of.
  uint32_t GetAlarmNumber() const { return NoDevice(); }
  /// Kind of an alarm.
  uint8_t GetAlarmType(uint32_t /*index*/) const { return NoDevice(); }
  /// Value of an alarm.
  uint16_t GetAlarmData(uint32_t /*index*/) const { return NoDevice(); }
  /// Size of the message's own data [bytes].
  uint32_t GetUserDataNumber() const { return NoDevice(); }
  /// The message's own data.
  uint8_t* GetAllUserData() const { return NoDevice(); }
  /// A byte of the message's own data.
  uint8_t GetUserData(uint32_t /*index*/) const { return NoDevice(); }
  /// Node that the strength of a signal was measured for.
  uint16_t GetRSSIsenderId() const { return NoDevice(); }
  /// Strength of that signal.
  uint16_t GetRSSIvalue() const { return NoDevice(); }
  /// Running number of that measurement.
  uint16_t GetRSSIstamp() const { return NoDevice(); }
  /// Time of that measurement on the node [s].
  double GetRSSInodeTime() const { return NoDevice(); }
  /// x of the node [m].
  float GetX() const { return NoDevice(); }
  /// y of the node [m].
  float GetY() const { return NoDevice(); }
  /// z of the node [m].
  float GetZ() const { return NoDevice(); }
  /// State of the node.
  uint8_t GetStatus() const { return NoDevice(); }
  /// The request, if the message is one.
  uint32_t GetRequest() const { return NoDevice(); }
  /// The command, if the message is one.
  uint32_t GetCommand() const { return NoDevice(); }
  /// Size of its parameters [bytes].
  uint32_t GetParametersSize() const { return NoDevice(); }
  /// Its parameters.
  uint8_t* GetAllParameters() const { return NoDevice(); }
  /// A byte of its parameters.
  uint8_t GetParameter(uint32_t /*index*/) const { return NoDevice(); }
  /// Sends a pose [m, rad] and a state.
  void SendData(int /*destID*/, int /*sourceID*/, player_pose2d_t /*pos*/, int /*status*/) {
    NoDevice();
  }
  /// Sends data.
  void SendData(int /*destID*/, int /*sourceID*/, int /*extradata_type*/,
                uint32_t /*extradata_size*/, uint8_t* /*extradata*/) {
    NoDevice();
  }
  /// Sends a command.
  void SendCommand(int /*destID*/, int /*sourceID*/, int /*command*/,
                   uint32_t /*cmd_parameters_size*/ = 0, uint8_t* /*cmd_parameters*/ = nullptr) {
    NoDevice();
  }
  /// Sends a request.
  void SendRequest(int /*destID*/, int /*sourceID*/, int /*request*/,
                   uint32_t /*req_parameters_size*/ = 0, uint8_t* /*req_parameters*/ = nullptr) {
    NoDevice();
  }
};

/// Load of the machine that a server runs on.
class HealthProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  HealthProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_HEALTH_CODE, "HealthProxy::HealthProxy") {}

  /// Processor idle [%].
  float GetIdleCPU() { return NoDevice(); }
  /// Processor used by the system [%].
  float GetSystemCPU() { return NoDevice(); }
  /// Processor used by programs [%].
  float GetUserCPU() { return NoDevice(); }
  /// Memory [kB].
  int64_t GetMemTotal() { return NoDevice(); }
  /// Memory used [kB].
  int64_t GetMemUsed() { return NoDevice(); }
  /// Memory free [kB].
  int64_t GetMemFree() { return NoDevice(); }
  /// Swap space [kB].
  int64_t GetSwapTotal() { return NoDevice(); }
  /// Swap space used [kB].
  int64_t GetSwapUsed() { return NoDevice(); }
  /// Swap space free [kB].
  int64_t GetSwapFree() { return NoDevice(); }
  /// Memory used [%].
  float GetPercMemUsed() { return NoDevice(); }
  /// Swap space used [%].
  float GetPercSwapUsed() { return NoDevice(); }
  /// Memory and swap space used [%].
  float GetPercTotalUsed() { return NoDevice(); }
};

/// A joystick at the server.
class LinuxjoystickProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  LinuxjoystickProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_JOYSTICK_CODE,
                           "LinuxjoystickProxy::LinuxjoystickProxy") {}

  /// Which buttons are pressed: a bit each.
  uint32_t GetButtons() const { return NoDevice(); }
  /// Where an axis is, -1 to 1.
  double GetAxes(uint32_t /*aIndex*/) const { return NoDevice(); }
  /// The same as GetAxes().
  double operator[](uint32_t /*aIndex*/) const { return NoDevice(); }
  /// How many axes there are.
  uint32_t GetAxesCount() const { return NoDevice(); }
};

/// A reader of radio tags.
class RFIDProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  RFIDProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_RFID_CODE, "RFIDProxy::RFIDProxy") {}

  /// How many tags are in reach.
  uint32_t GetTagsCount() const { return NoDevice(); }
  /// A tag.
  playerc_rfidtag_t GetRFIDTag(uint32_t /*aIndex*/) const { return NoDevice(); }
  /// The same as GetRFIDTag().
  playerc_rfidtag_t operator[](uint32_t /*aIndex*/) const { return NoDevice(); }
};

/// Words that somebody said.
class SpeechRecognitionProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  SpeechRecognitionProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_SPEECH_RECOGNITION_CODE,
                           "SpeechRecognitionProxy::SpeechRecognitionProxy") {}

  /// A word.
  std::string GetWord(uint32_t /*aWord*/) const { return NoDevice(); }
  /// How many words there are.
  uint32_t GetCount() const { return NoDevice(); }
  /// The same as GetWord().
  std::string operator[](uint32_t /*aWord*/) { return NoDevice(); }
};

/// A node of a wireless sensor network.
class WSNProxy : public ProxyWithoutDevice {
 public:
  /// @throws PlayerError kNoSuchDevice, always; see ProxyWithoutDevice.
  WSNProxy(PlayerClient* aPc, uint32_t aIndex = 0)
      : ProxyWithoutDevice(aPc, aIndex, PLAYER_WSN_CODE, "WSNProxy::WSNProxy") {}

  /// Kind of the node.
  uint32_t GetNodeType() const { return NoDevice(); }
  /// Its number.
  uint32_t GetNodeID() const { return NoDevice(); }
  /// Number of the node above it.
  uint32_t GetNodeParentID() const { return NoDevice(); }
  /// Its readings.
  player_wsn_node_data_t GetNodeDataPacket() const { return NoDevice(); }
  /// Switches a device of nodes.
  void SetDevState(int /*nodeID*/, int /*groupID*/, int /*devNr*/, int /*value*/) { NoDevice(); }
  /// Switches nodes on or off.
  void Power(int /*nodeID*/, int /*groupID*/, int /*value*/) { NoDevice(); }
  /// Selects whether readings are raw or in SI units.
  void DataType(int /*value*/) { NoDevice(); }
  /// Sets how often nodes tell of their readings [Hz].
  void DataFreq(int /*nodeID*/, int /*groupID*/, float /*frequency*/) { NoDevice(); }
};

}  // namespace PlayerCc
