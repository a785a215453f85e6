// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Other inputs and outputs: aio, dio, blinkenlight, speech, opaque.
#include <algorithm>
#include <limits>
#include <vector>

#include "libplayerc++/aioproxy.h"
#include "libplayerc++/blinkenlightproxy.h"
#include "libplayerc++/dioproxy.h"
#include "libplayerc++/opaqueproxy.h"
#include "libplayerc++/speechproxy.h"
#include "playerc/device.h"

namespace {

using playerlike::clib::copied;
using playerlike::clib::ProxyBacked;
using playerlike::clib::refuse;
using playerlike::clib::with_device;

class Aio final : public ProxyBacked<playerc_aio_t, PlayerCc::AioProxy> {
  void refresh() override {
    constexpr uint32_t kMost = std::numeric_limits<decltype(voltages_count)>::max();
    const uint32_t count = std::min(proxy_or_throw().GetCount(), kMost);
    voltages_count = static_cast<uint8_t>(count);
    voltages = copied(voltages_, count, [this](uint32_t i) {
      return static_cast<float>(proxy_or_throw().GetVoltage(i));
    });
  }

  std::vector<float> voltages_;
};

class Dio final : public ProxyBacked<playerc_dio_t, PlayerCc::DioProxy> {
  void refresh() override {
    count = static_cast<uint8_t>(proxy_or_throw().GetCount());
    digin = proxy_or_throw().GetDigin();
  }
};

class Blinkenlight final : public ProxyBacked<playerc_blinkenlight_t, PlayerCc::BlinkenLightProxy> {
  void refresh() override {
    enabled = proxy_or_throw().GetEnable() ? 1 : 0;
    duty_cycle = proxy_or_throw().GetDutyCycle();
    period = proxy_or_throw().GetPeriod();
    red = proxy_or_throw().GetRed();
    green = proxy_or_throw().GetGreen();
    blue = proxy_or_throw().GetBlue();
  }
};

class Speech final : public ProxyBacked<playerc_speech_t, PlayerCc::SpeechProxy> {};

class Opaque final : public ProxyBacked<playerc_opaque_t, PlayerCc::OpaqueProxy> {
  // A reading without a message is not delivered.
  [[nodiscard]] bool has_news() override { return proxy_or_throw().IsFresh(); }
  void refresh() override {
    bytes_.resize(proxy_or_throw().GetCount());
    proxy_or_throw().GetData(bytes_.data());
    proxy_or_throw().NotFresh();
    data_count = static_cast<int>(bytes_.size());
    data = bytes_.empty() ? nullptr : bytes_.data();
  }

  std::vector<uint8_t> bytes_;
};

// Lights of this library have one lamp each.
void require_lamp(uint32_t id) {
  if (id != 0)
    refuse("a light has one lamp, with the number 0; there is no lamp " + std::to_string(id));
}

}  // namespace

PLAYERLIKE_CLIB_FRAME(aio, Aio, PLAYER_AIO_CODE)
PLAYERLIKE_CLIB_FRAME(dio, Dio, PLAYER_DIO_CODE)
PLAYERLIKE_CLIB_FRAME(blinkenlight, Blinkenlight, PLAYER_BLINKENLIGHT_CODE)
PLAYERLIKE_CLIB_FRAME(speech, Speech, PLAYER_SPEECH_CODE)
PLAYERLIKE_CLIB_FRAME(opaque, Opaque, PLAYER_OPAQUE_CODE)

int playerc_aio_set_output(playerc_aio_t* device, uint8_t id, float volt) {
  return with_device<Aio>(__func__, device,
                          [&](Aio& self) { self.proxy_or_throw().SetVoltage(id, volt); });
}

float playerc_aio_get_data(playerc_aio_t* device, uint32_t index) {
  if (device == nullptr || index >= device->voltages_count) return 0.0F;
  return device->voltages[index];
}

int playerc_dio_set_output(playerc_dio_t* device, uint8_t output_count, uint32_t digout) {
  return with_device<Dio>(
      __func__, device, [&](Dio& self) { self.proxy_or_throw().SetOutput(output_count, digout); });
}

int playerc_blinkenlight_enable(playerc_blinkenlight_t* device, uint32_t enable) {
  return with_device<Blinkenlight>(
      __func__, device, [&](Blinkenlight& self) { self.proxy_or_throw().SetEnable(enable != 0); });
}

int playerc_blinkenlight_color(playerc_blinkenlight_t* device, uint32_t id, uint8_t red,
                               uint8_t green, uint8_t blue) {
  return with_device<Blinkenlight>(__func__, device, [&](Blinkenlight& self) {
    require_lamp(id);
    self.proxy_or_throw().SetColor(red, green, blue);
  });
}

int playerc_blinkenlight_blink(playerc_blinkenlight_t* device, uint32_t id, float period,
                               float duty_cycle) {
  return with_device<Blinkenlight>(__func__, device, [&](Blinkenlight& self) {
    require_lamp(id);
    self.proxy_or_throw().SetPeriod(period);
    self.proxy_or_throw().SetDutyCycle(duty_cycle);
  });
}

int playerc_speech_say(playerc_speech_t* device, char* text) {
  return with_device<Speech>(__func__, device, [&](Speech& self) {
    if (text == nullptr) refuse("the text is a null pointer");
    self.proxy_or_throw().Say(text);
  });
}

int playerc_opaque_cmd(playerc_opaque_t* device, player_opaque_data_t* data) {
  return with_device<Opaque>(__func__, device,
                             [&](Opaque& self) { self.proxy_or_throw().SendCmd(data); });
}

int playerc_opaque_req(playerc_opaque_t* device, player_opaque_data_t* /*request*/,
                       player_opaque_data_t** /*reply*/) {
  return with_device<Opaque>(__func__, device, [](Opaque& /*self*/) {
    refuse(
        "opaque requests have no answer: send playerc_opaque_cmd() and read the messages that "
        "arrive");
  });
}
