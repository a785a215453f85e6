// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <thread>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/playerclient.h"
#include "playerlike/connect/open_session.h"
#include "proxies/link.h"
#include "virtual_time/virtual_time.h"

namespace PlayerCc {

using playerlike::ClientCore;
using playerlike::SessionError;
using playerlike::translated;
using playerlike::translated_all;

namespace {

// How long the background thread waits for data before it checks whether to stop.
constexpr std::chrono::milliseconds kPollPeriod(10);
// How long StopThread() waits for the thread. It takes longer only in a lockstep simulation that
// waits for the caller of StopThread(). In that case the thread ends later by itself and touches
// nothing.
constexpr std::chrono::milliseconds kPatience(1000);

// State that the reading thread shares with the client that started it.
struct Reader {
  std::atomic<bool> stop{false};
  std::mutex mutex;
  std::condition_variable changed;
  bool joined = false;  // has joined the lockstep, if it must join before the caller goes on
  bool ended = false;
};

// In virtual time the program's own thread is in the lockstep too. It must not go on before the
// reading thread has joined, otherwise the time of the first round would depend on scheduling.
void join_lockstep(ClientCore& core, Reader& reader) {
  try {
    core.session().request(playerlike::JoinRequest{});
  } catch (const SessionError&) {
    // The client is being destroyed; the first peek() will report that.
  }
  const std::lock_guard lock(reader.mutex);
  reader.joined = true;
  reader.changed.notify_all();
}

void read_until_stopped(ClientCore& core, const std::atomic<bool>& stop,
                        std::chrono::milliseconds look) {
  while (!stop) {
    if (core.peek(look) && !stop) core.read(&stop);
  }
}

void read_in_background(const std::shared_ptr<ClientCore>& core,
                        const std::shared_ptr<Reader>& reader) {
  bool over = false;
  try {
    read_until_stopped(*core, reader->stop, kPollPeriod);
  } catch (const SessionError& e) {
    over = e.code() == SessionError::Code::kFinished;
  } catch (const PlayerError& e) {
    // From a subscriber of a read signal. Its other errors end the program, as in any thread.
    over = e.GetErrorCode() == PlayerError::kRunIsOver;
    if (!over && e.GetErrorCode() != PlayerError::kDisconnected) throw;
  }
  const std::lock_guard lock(reader->mutex);
  if (over && !reader->stop) core->set_run_is_over(true);
  reader->ended = true;
  reader->changed.notify_all();
}

}  // namespace

struct PlayerClient::Impl {
  std::string hostname;
  uint32_t port = 0;
  int retry_limit = 0;
  double retry_time_s = 10.0;
  std::vector<playerc_device_info_t> devices;  // guarded by the client's mutex

  std::atomic<int> copies{1};  // of the client, including the first

  std::atomic<bool> stop_run{false};

  std::mutex thread_mutex;  // guards the members below; never held while waiting for a thread
  std::thread thread;
  std::shared_ptr<Reader> reader;
  std::vector<std::thread> leaving;  // asked to stop, not joined yet
};

PlayerClient::PlayerClient(std::unique_ptr<playerlike::Session> aSession,
                           const std::string& aHostname, uint32_t aPort)
    : mCore(translated_all("PlayerClient::PlayerClient",
                           [&] {
                             playerlike::prepare_for_uncaught_errors();
                             return playerlike::make_core(std::move(aSession));
                           })),
      mMutex(mCore->mutex()),
      mImpl(std::make_shared<Impl>()) {
  mImpl->hostname = aHostname;
  mImpl->port = aPort;
}

PlayerClient::PlayerClient(const std::string aHostname, uint32_t aPort, int transport)
    : PlayerClient(translated_all("PlayerClient::PlayerClient",
                                  [&] {
                                    playerlike::prepare_for_uncaught_errors();
                                    if (transport != PLAYERC_TRANSPORT_TCP &&
                                        transport != PLAYERC_TRANSPORT_UDP) {
                                      throw SessionError(SessionError::Code::kBadArgument,
                                                         "the transport must be "
                                                         "PLAYERC_TRANSPORT_TCP or "
                                                         "PLAYERC_TRANSPORT_UDP");
                                    }
                                    constexpr uint32_t kMaxPort = 65535;
                                    return playerlike::open_session(
                                        aHostname, static_cast<int>(std::min(aPort, kMaxPort)));
                                  }),
                   aHostname, aPort) {}

PlayerClient::PlayerClient(std::unique_ptr<playerlike::Session> aSession)
    : PlayerClient(std::move(aSession), "", 0) {
  mImpl->port = static_cast<uint32_t>(mCore->session().port());
}

PlayerClient::PlayerClient(const PlayerClient& aOther)
    : mCore(aOther.mCore), mMutex(mCore->mutex()), mImpl(aOther.mImpl) {
  ++mImpl->copies;
}

PlayerClient::~PlayerClient() {
  if (--mImpl->copies > 0) return;
  Stop();
  mCore->close();  // wakes the waiting threads
  std::vector<std::thread> threads;
  {
    const std::lock_guard lock(mImpl->thread_mutex);
    threads = std::move(mImpl->leaving);
    if (mImpl->thread.joinable()) threads.push_back(std::move(mImpl->thread));
  }
  const playerlike::virtual_time::Inside inside;  // these threads need no simulated time to end
  for (std::thread& thread : threads) {
    // A subscriber of a read signal destroys the client. Its thread shares ownership of all that it
    // still needs.
    if (thread.get_id() == std::this_thread::get_id()) {
      thread.detach();
    } else {
      thread.join();
    }
  }
}

bool PlayerClient::Connected() { return !mCore->closed() && mCore->session().connected(); }

void PlayerClient::StartThread() {
  const char* fun = "PlayerClient::StartThread";
  const std::lock_guard lock(mImpl->thread_mutex);
  if (mImpl->reader) {
    const std::lock_guard reader_lock(mImpl->reader->mutex);
    if (!mImpl->reader->ended && !mImpl->reader->stop) return;
  }
  if (mImpl->thread.joinable()) mImpl->leaving.push_back(std::move(mImpl->thread));
  translated_all(fun, [&] {
    mCore->session().request(
        playerlike::PreferRealTimeRequest{"a client reads in a thread of its own (StartThread)"});
    auto reader = std::make_shared<Reader>();
    const bool join = playerlike::virtual_time::active();
    const playerlike::virtual_time::Inside inside;  // the thread does not belong to the program
    mImpl->thread = std::thread([core = mCore, reader, join] {
      if (join) join_lockstep(*core, *reader);
      read_in_background(core, reader);
    });
    if (join) {
      std::unique_lock reader_lock(reader->mutex);
      reader->changed.wait(reader_lock, [&] { return reader->joined; });
    }
    mImpl->reader = std::move(reader);
  });
}

void PlayerClient::StopThread() {
  std::unique_lock lock(mImpl->thread_mutex);
  const std::shared_ptr<Reader> reader = std::exchange(mImpl->reader, nullptr);
  std::thread thread = std::move(mImpl->thread);
  lock.unlock();
  if (!reader) return;
  {
    // With the data locked, a round that is being delivered ends first, and no other follows.
    const mutex_t::scoped_lock data(mMutex);
    reader->stop = true;
  }
  const auto has_ended = [&reader] {
    const std::lock_guard reader_lock(reader->mutex);
    return reader->ended;
  };
  bool ended = false;
  if (thread.get_id() != std::this_thread::get_id()) {
    // The thread checks for that when simulated time advances; in virtual time the caller must let
    // it.
    static_cast<void>(
        playerlike::virtual_time::wait_until(mCore->session().simulation(), has_ended));
    const playerlike::virtual_time::Inside inside;
    std::unique_lock reader_lock(reader->mutex);
    ended = reader->changed.wait_for(reader_lock, kPatience, [&] { return reader->ended; });
  }
  mCore->set_run_is_over(false);
  if (ended) {
    const playerlike::virtual_time::Inside inside;
    thread.join();
  } else {
    lock.lock();
    mImpl->leaving.push_back(std::move(thread));
  }
}

void PlayerClient::Run(uint32_t aTimeout) {
  mImpl->stop_run = false;
  translated("PlayerClient::Run", [&] {
    read_until_stopped(*mCore, mImpl->stop_run, std::chrono::milliseconds(std::max(aTimeout, 1U)));
  });
}

void PlayerClient::Stop() {
  mImpl->stop_run = true;
  const std::lock_guard lock(mImpl->thread_mutex);
  if (mImpl->reader) mImpl->reader->stop = true;
}

bool PlayerClient::Peek(uint32_t timeout) {
  return translated("PlayerClient::Peek",
                    [&] { return mCore->peek(std::chrono::milliseconds(timeout)); });
}

void PlayerClient::Read() {
  translated("PlayerClient::Read", [&] { mCore->read(); });
}

void PlayerClient::ReadIfWaiting() {
  if (Peek(0)) Read();
}

void PlayerClient::SetRequestTimeout(uint32_t seconds) {
  mCore->session().request(
      playerlike::AnswerTimeoutRequest{static_cast<double>(std::max(seconds, 1U))});
}

void PlayerClient::SetRetryLimit(int limit) {
  const mutex_t::scoped_lock lock(mMutex);
  mImpl->retry_limit = limit;
  mCore->session().request(playerlike::RetriesRequest{limit, std::max(mImpl->retry_time_s, 0.0)});
}

int PlayerClient::GetRetryLimit() {
  const mutex_t::scoped_lock lock(mMutex);
  return mImpl->retry_limit;
}

void PlayerClient::SetRetryTime(double time) {
  playerlike::require_finite("PlayerClient::SetRetryTime", {{"the time between retries", time}});
  const mutex_t::scoped_lock lock(mMutex);
  mImpl->retry_time_s = time;
  mCore->session().request(playerlike::RetriesRequest{mImpl->retry_limit, std::max(time, 0.0)});
}

double PlayerClient::GetRetryTime() {
  const mutex_t::scoped_lock lock(mMutex);
  return mImpl->retry_time_s;
}

void PlayerClient::SetDataMode(uint32_t aMode) {
  if (aMode == PLAYER_DATAMODE_PULL || aMode == PLAYER_DATAMODE_PUSH) return;
  playerlike::refuse("PlayerClient::SetDataMode",
                     "the mode must be PLAYER_DATAMODE_PULL or PLAYER_DATAMODE_PUSH, but is " +
                         std::to_string(aMode));
}

void PlayerClient::SetFrequency(uint32_t aFreq) { static_cast<void>(aFreq); }

void PlayerClient::SetReplaceRule(bool aReplace, int aType, int aSubtype, int aInterf) {
  static_cast<void>(aSubtype);
  if (aType != -1 && aType != PLAYER_MSGTYPE_DATA) return;
  translated("PlayerClient::SetReplaceRule", [&] {
    const mutex_t::scoped_lock lock(mMutex);
    playerlike::Session& session = mCore->session();
    if (aInterf == -1) {
      mCore->replace_rules().clear();
      session.request(playerlike::ReplaceRequest{std::nullopt, aReplace});
      return;
    }
    const char* name = interface_name(aInterf);
    if (name == nullptr) {
      throw SessionError(SessionError::Code::kBadArgument,
                         "there is no interface with the code " + std::to_string(aInterf));
    }
    mCore->replace_rules()[aInterf] = aReplace;
    for (const auto& address : playerlike::list_interfaces(mCore->robots(), session.port())) {
      if (address.interface != name) continue;
      const auto binding =
          playerlike::find_interface(mCore->robots(), session.port(), name, address.index);
      if (!binding.is_world())
        session.request(playerlike::ReplaceRequest{binding.reading, aReplace});
    }
  });
}

void PlayerClient::RequestDeviceList() {
  translated("PlayerClient::RequestDeviceList", [&] {
    const mutex_t::scoped_lock lock(mMutex);
    const int port = mCore->session().port();
    mImpl->devices.clear();
    for (const auto& address : playerlike::list_interfaces(mCore->robots(), port)) {
      const auto binding =
          playerlike::find_interface(mCore->robots(), port, address.interface, address.index);
      playerc_device_info_t info = {};
      info.addr.robot = static_cast<uint32_t>(port);
      info.addr.interf = static_cast<uint16_t>(interface_code(address.interface).value_or(0));
      info.addr.index = static_cast<uint16_t>(address.index);
      driver_name(*mCore, binding).copy(info.drivername, sizeof info.drivername - 1);
      mImpl->devices.push_back(info);
    }
  });
}

std::list<playerc_device_info_t> PlayerClient::GetDeviceList() {
  const mutex_t::scoped_lock lock(mMutex);
  return {mImpl->devices.begin(), mImpl->devices.end()};
}

std::string PlayerClient::GetHostname() const { return mImpl->hostname; }

uint32_t PlayerClient::GetPort() const { return mImpl->port; }

int PlayerClient::LookupCode(std::string aName) const { return interface_code(aName).value_or(-1); }

std::string PlayerClient::LookupName(int aCode) const {
  const char* name = interface_name(aCode);
  return name == nullptr ? "unknown" : name;
}

uint32_t PlayerClient::GetOverflowCount() {
  return translated("PlayerClient::GetOverflowCount",
                    [&] { return mCore->session().request(playerlike::OverflowRequest{}); });
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::PlayerClient& c) {
  const auto& core = PlayerCc::detail::CoreAccess::get(c);
  const bool open = !core->closed() && core->session().connected();
  os << "#PlayerClient\n#host\tport\tconnected\n"
     << c.GetHostname() << '\t' << c.GetPort() << '\t' << (open ? "yes" : "no") << '\n'
     << "#interface\tindex\trobot\tdevice\n";
  for (const auto& a : playerlike::list_interfaces(core->robots(), core->session().port())) {
    os << a.interface << '\t' << a.index << '\t' << a.robot << '\t' << a.device << '\n';
  }
  return os;
}

}  // namespace std
