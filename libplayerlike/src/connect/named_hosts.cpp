// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "connect/named_hosts.h"

#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

namespace playerlike {
namespace {

constexpr std::string_view kTestPrefix = "test:";

struct NamedHosts {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<Host>> by_name;
  std::weak_ptr<Host> local;
  int last = 0;

  // Never destroyed, because hosts at namespace scope may be named late.
  static NamedHosts& instance() {
    static auto* const hosts = new NamedHosts;
    return *hosts;
  }
};

}  // namespace

std::string name_host(const std::shared_ptr<Host>& host) {
  NamedHosts& hosts = NamedHosts::instance();
  const std::lock_guard lock(hosts.mutex);
  std::erase_if(hosts.by_name, [](const auto& named) { return named.second.expired(); });
  std::string name = std::string(kTestPrefix) + std::to_string(++hosts.last);
  hosts.by_name.emplace(name, host);
  return name;
}

void forget_host(const std::string& name) {
  NamedHosts& hosts = NamedHosts::instance();
  const std::lock_guard lock(hosts.mutex);
  hosts.by_name.erase(name);
}

bool name_host_localhost(const std::shared_ptr<Host>& host) {
  if (std::getenv("PLAYPEN_GRADE") != nullptr) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "this program is run by 'playpen grade': \"localhost\" is the task's world");
  }
  NamedHosts& hosts = NamedHosts::instance();
  const std::lock_guard lock(hosts.mutex);
  const std::shared_ptr<Host> now = hosts.local.lock();
  if (now && host && now != host) return false;
  hosts.local = host;
  return true;
}

std::shared_ptr<Host> named_host(const std::string& name) {
  NamedHosts& hosts = NamedHosts::instance();
  const std::lock_guard lock(hosts.mutex);
  if (name == "localhost" || name == "127.0.0.1") return hosts.local.lock();
  if (!name.starts_with(kTestPrefix)) return nullptr;
  const auto found = hosts.by_name.find(name);
  std::shared_ptr<Host> host = found == hosts.by_name.end() ? nullptr : found->second.lock();
  if (host) return host;
  throw SessionError(
      SessionError::Code::kBadArgument,
      "there is no run of a test with the name \"" + name +
          "\"; a run's name ends with the run, see playpen::testing::TestRun::host()");
}

}  // namespace playerlike
