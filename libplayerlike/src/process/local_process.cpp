// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "process/local_process.h"

#include <dirent.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

namespace playerlike {
namespace {

/// An end of a connection, as an IPv6 address; IPv4 is mapped.
struct ConnectionEnd {
  std::array<std::uint32_t, 4> address{};  ///< as in memory
  std::uint16_t port = 0;

  [[nodiscard]] bool is_ipv4() const {
    return address[0] == 0 && address[1] == 0 && address[2] == htonl(0xffff);
  }
  /// As in the system's table, e.g. "0100007F:1A09".
  [[nodiscard]] std::string text(bool ipv4) const {
    std::string text;
    std::array<char, 16> word{};
    for (std::size_t i = ipv4 ? 3 : 0; i < 4; ++i) {
      std::snprintf(word.data(), word.size(), "%08X", address[i]);
      text += word.data();
    }
    std::snprintf(word.data(), word.size(), ":%04X", static_cast<unsigned>(port));
    return text + word.data();
  }
};

using NameOf = int (*)(int, sockaddr*, socklen_t*);

std::optional<ConnectionEnd> end_of(int socket, NameOf name_of) {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  if (name_of(socket, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return std::nullopt;
  ConnectionEnd end;
  if (storage.ss_family == AF_INET) {
    sockaddr_in address{};
    std::memcpy(&address, &storage, sizeof address);
    end.address = {0, 0, htonl(0xffff), address.sin_addr.s_addr};
    end.port = ntohs(address.sin_port);
    return end;
  }
  if (storage.ss_family != AF_INET6) return std::nullopt;
  sockaddr_in6 address{};
  std::memcpy(&address, &storage, sizeof address);
  std::memcpy(end.address.data(), &address.sin6_addr, sizeof end.address);
  end.port = ntohs(address.sin6_port);
  return end;
}

/// Finds a connection in a table of the system. @return the inode of its socket; "": not found.
std::string inode_of(const char* table, const std::string& own, const std::string& other) {
  std::ifstream file(table);
  std::string line;
  const std::string ends = own + ' ' + other + ' ';
  while (std::getline(file, line)) {
    if (line.find(ends) == line.npos) continue;
    std::istringstream words(line);
    std::string word;
    constexpr int kInode = 10;  // column
    for (int i = 0; i < kInode && words >> word; ++i) {
    }
    return word == "0" ? "" : word;
  }
  return "";
}

struct CloseFolder {
  void operator()(DIR* folder) const { closedir(folder); }
};
using Folder = std::unique_ptr<DIR, CloseFolder>;

bool has_file(const std::string& process, std::string_view target) {
  const std::string path = "/proc/" + process + "/fd";
  const Folder folder(opendir(path.c_str()));
  if (!folder) return false;
  std::array<char, 64> link{};
  while (const dirent* file = readdir(folder.get())) {
    const ssize_t size = readlinkat(dirfd(folder.get()), file->d_name, link.data(), link.size());
    if (size > 0 && target == std::string_view(link.data(), static_cast<std::size_t>(size))) {
      return true;
    }
  }
  return false;
}

/// The process that holds a TCP connection between two ends. @param own  its end.
std::optional<int> process_of_connection(const ConnectionEnd& own, const ConnectionEnd& other) {
  std::string inode;
  if (own.is_ipv4()) inode = inode_of("/proc/net/tcp", own.text(true), other.text(true));
  if (inode.empty()) inode = inode_of("/proc/net/tcp6", own.text(false), other.text(false));
  if (inode.empty()) return std::nullopt;
  const std::string target = "socket:[" + inode + ']';
  const Folder processes(opendir("/proc"));
  if (!processes) return std::nullopt;
  std::optional<int> found;
  while (const dirent* process = readdir(processes.get())) {
    const std::string name = process->d_name;
    if (name.find_first_not_of("0123456789") != name.npos) continue;
    const int number = std::stoi(name);
    if (found && *found < number) continue;
    if (has_file(name, target)) found = number;
  }
  return found;
}

}  // namespace

std::uint32_t own_ipv4_of(int socket) {
  const std::optional<ConnectionEnd> own = end_of(socket, getsockname);
  return own && own->is_ipv4() ? own->address[3] : 0;
}

std::function<std::optional<int>()> peer_process_search(int socket) {
  ucred peer{};
  socklen_t peer_size = sizeof peer;
  int family = 0;
  socklen_t family_size = sizeof family;
  if (getsockopt(socket, SOL_SOCKET, SO_DOMAIN, &family, &family_size) == 0 && family == AF_UNIX) {
    const bool known = getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &peer_size) == 0;
    const auto process = known && peer.pid > 0 ? std::optional<int>(peer.pid) : std::nullopt;
    return [process] { return process; };
  }
  // The other end's own address is this end's peer.
  const std::optional<ConnectionEnd> own = end_of(socket, getpeername);
  const std::optional<ConnectionEnd> other = end_of(socket, getsockname);
  if (!own || !other) return [] { return std::optional<int>(); };
  return [own = *own, other = *other] { return process_of_connection(own, other); };
}

std::optional<int> peer_process(int socket) { return peer_process_search(socket)(); }

}  // namespace playerlike
