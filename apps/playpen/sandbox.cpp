// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sandbox.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "syscall_filter.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHome = "/tmp/home";
constexpr const char* kSystem = "/usr";
constexpr std::uint64_t kMega = 1'000'000;

/// Builds the arguments of bubblewrap.
class Arguments {
 public:
  template <typename... Words>
  void add(const Words&... words) {
    (words_.push_back(words), ...);
  }
  /// Shows a file or folder at its own place, unless the system's folders contain it.
  void show(const fs::path& path) {
    if (is_inside(path, kSystem) || !shown_.insert(path).second) return;
    make_folder(path.parent_path());
    add("--ro-bind", path, path);
  }
  /// Makes a folder that everybody in the sandbox may look into, and those above it.
  void make_folder(const fs::path& path) {
    if (!path.has_relative_path() || !made_.insert(path).second) return;
    make_folder(path.parent_path());
    add("--dir", path);
  }
  /// Hides a file or folder, if it is inside something that is shown.
  void hide(const fs::path& path) {
    const bool visible = std::any_of(shown_.begin(), shown_.end(), [&path](const fs::path& place) {
      return is_inside(path, place);
    });
    std::error_code error;
    if (!visible || !fs::exists(path, error)) return;
    if (fs::is_directory(path, error)) {
      add("--tmpfs", path, "--remount-ro", path);
    } else {
      add("--ro-bind", "/dev/null", path);
    }
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(words_); }

  static bool is_inside(const fs::path& path, const fs::path& folder) {
    const auto [end, ignored] =
        std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end();
  }

 private:
  std::vector<std::string> words_;
  std::set<fs::path> shown_;
  std::set<fs::path> made_;
};

bool is_root() { return geteuid() == 0; }

/// The user of a sandbox that root makes. The kernel does not limit the processes of root, nor of a
/// user of a namespace who is root outside. So each sandbox has a user of its own, of those that
/// systemd keeps free for dynamic users (systemd.exec(5), "DynamicUser=").
unsigned user_of_sandbox() {
  constexpr unsigned kFirst = 61184;
  constexpr unsigned kCount = 65519 - kFirst + 1;
  return kFirst + static_cast<unsigned>(getpid()) % kCount;
}

/// The system's folders: /usr, and links such as /lib that lead into it or are folders themselves.
void add_system(Arguments& arguments) {
  arguments.add("--ro-bind", kSystem, kSystem);
  std::error_code error;
  for (const char* folder : {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32"}) {
    if (fs::is_symlink(folder, error)) {
      arguments.add("--symlink", fs::read_symlink(folder, error).string(), folder);
    } else if (fs::is_directory(folder, error)) {
      arguments.add("--ro-bind", folder, folder);
    }
  }
  for (const char* file : {"/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d",
                           "/etc/alternatives", "/etc/localtime", "/etc/fonts"}) {
    arguments.add("--ro-bind-try", file, file);
  }
}

/// The program's own folder, and the files that its arguments name. A folder that contains more
/// than a program, such as the home folder, stays invisible.
void add_program(Arguments& arguments, const std::vector<std::string>& command,
                 const fs::path& folder) {
  std::error_code error;
  for (const fs::path& program :
       {fs::path(command.front()), fs::canonical(command.front(), error)}) {
    const char* home = std::getenv("HOME");
    const fs::path place = program.parent_path();
    const bool is_wide = !place.has_relative_path() || place == "/tmp" ||
                         (home != nullptr && Arguments::is_inside(home, place));
    if (!program.empty()) arguments.show(is_wide ? program : place);
  }
  for (auto word = command.begin() + 1; word != command.end(); ++word) {
    const fs::path file = (folder / *word).lexically_normal();
    if (fs::is_regular_file(file, error)) arguments.show(file);
  }
}

/// The numbers of a file of /proc/N/status.
struct Status {
  std::size_t threads = 0;
  std::uint64_t own_bytes = 0;
};

Status read_status(const fs::path& file) {
  Status status;
  std::ifstream stream(file);
  constexpr std::uint64_t kUnit = 1024;
  for (std::string line; std::getline(stream, line);) {
    const auto number = [&line](std::string_view name) {
      std::uint64_t value = 0;
      if (!line.starts_with(name)) return value;
      const std::size_t begin = line.find_first_of("0123456789", name.size());
      if (begin != std::string::npos) {
        std::from_chars(line.data() + begin, line.data() + line.size(), value);
      }
      return value;
    };
    status.threads += number("Threads:");
    status.own_bytes += kUnit * (number("RssAnon:") + number("RssShmem:"));
  }
  return status;
}

/// Whether a folder is this process's root: that of a process whose sandbox is not set up yet, or
/// of one that has got its number.
bool is_own_root(const std::string& folder) {
  struct stat own {};
  struct stat other {};
  return stat("/", &own) != 0 || stat(folder.c_str(), &other) != 0 ||
         (own.st_dev == other.st_dev && own.st_ino == other.st_ino);
}

std::string text_of(int descriptor) {
  std::string text(4096, '\0');
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// The descriptors that bubblewrap gets, after its standard streams.
constexpr int kFilter = 3;
constexpr int kInfo = 4;
constexpr int kFirstOther = 5;

/// A file in memory with this content. Its descriptor is none of bubblewrap's.
int memory_file(const std::string& content) {
  const int file = memfd_create("playpen", MFD_CLOEXEC);
  const int moved = file < 0 ? -1 : fcntl(file, F_DUPFD_CLOEXEC, kFirstOther);
  if (file >= 0) close(file);
  if (moved < 0 || write(moved, content.data(), content.size()) < 0 ||
      lseek(moved, 0, SEEK_SET) != 0) {
    throw std::runtime_error(std::string("no file can be made in memory: ") + std::strerror(errno));
  }
  return moved;
}

}  // namespace

std::vector<std::string> sandbox_command(const SandboxSettings& settings, int filter, int info) {
  const std::string size = std::to_string(settings.limits.files_bytes);
  Arguments arguments;
  arguments.add("bwrap", "--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts",
                "--unshare-cgroup-try", "--die-with-parent", "--new-session", "--hostname",
                "playpen", "--seccomp", std::to_string(filter), "--info-fd", std::to_string(info),
                "--cap-drop", "ALL");
  if (is_root()) {
    arguments.add("--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID");
  } else {
    arguments.add("--unshare-user", "--uid", "1000", "--gid", "1000");
  }
  add_system(arguments);
  // Whoever runs this as root owns the files of /proc/sys, in the sandbox too.
  arguments.add("--proc", "/proc", "--ro-bind", "/proc/sys", "/proc/sys", "--dev", "/dev");
  for (const char* folder : {"/dev/shm", "/tmp"}) {
    arguments.add("--perms", "1777");
    if (settings.sized) arguments.add("--size", size);
    arguments.add("--tmpfs", folder);
  }
  arguments.add("--perms", "0777", "--dir", kHome);
  arguments.make_folder(settings.folder);
  for (const std::string& path : settings.readable) arguments.show(path);
  add_program(arguments, settings.command, settings.folder);
  for (const std::string& path : settings.hidden) arguments.hide(path);
  for (const std::string& path : settings.writable) {
    arguments.make_folder(path);
    arguments.add("--bind", path, path);
  }
  if (!settings.socket.empty()) {
    arguments.make_folder(fs::path(kSandboxSocket).parent_path());
    arguments.add("--bind", settings.socket, kSandboxSocket);
  }
  arguments.add("--remount-ro", "/dev", "--remount-ro", "/", "--chdir", settings.folder);
  arguments.add("--clearenv", "--setenv", "HOME", kHome, "--setenv", "PATH",
                "/usr/local/bin:/usr/bin:/bin");
  for (const auto& [name, value] : settings.environment) arguments.add("--setenv", name, value);
  arguments.add("--");
  if (is_root()) {
    const std::string user = std::to_string(user_of_sandbox());
    arguments.add("setpriv", "--reuid", user, "--regid", user, "--clear-groups", "--");
  }
  // Of this user in the sandbox only, so other programs of the user do not count.
  arguments.add("prlimit", "--core=0", "--nproc=" + std::to_string(settings.limits.tasks),
                "--fsize=" + size, "--nofile=1024",
                "--cpu=" + std::to_string(settings.limits.processor_s), "--");
  std::vector<std::string> all = arguments.take();
  all.insert(all.end(), settings.command.begin(), settings.command.end());
  return all;
}

SandboxedProgram::SandboxedProgram(const SandboxSettings& settings, const sigset_t& mask, int error)
    : limits_(settings.limits), sized_(settings.sized) {
  const int filter = memory_file(syscall_filter());
  info_ = memory_file({});
  const std::vector<std::string> command = sandbox_command(settings, kFilter, kInfo);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&attributes, &mask);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (error >= 0) posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, filter, kFilter);
  posix_spawn_file_actions_adddup2(&actions, info_, kInfo);
  posix_spawn_file_actions_addclosefrom_np(&actions, kFirstOther);
  // The first process in the sandbox is bubblewrap's, and the program can read its environment.
  char* const no_environment[] = {nullptr};
  const int failure =
      posix_spawnp(&process_, "bwrap", &actions, &attributes, words.data(), no_environment);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(filter);
  if (failure != 0) {
    close(info_);
    throw std::runtime_error(
        failure == ENOENT ? "bubblewrap (bwrap) is not installed: apt install bubblewrap"
                          : std::string("bwrap cannot be started: ") + std::strerror(failure));
  }
  pidfd_ = static_cast<int>(syscall(SYS_pidfd_open, process_, 0));
}

SandboxedProgram::~SandboxedProgram() {
  kill_all();
  if (!ended_) waitpid(process_, nullptr, 0);
  close(pidfd_);
  close(info_);
}

std::optional<int> SandboxedProgram::poll() {
  int status = 0;
  if (waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
  ended_ = true;
  return WIFSIGNALED(status) ? kSignalStatus + WTERMSIG(status) : WEXITSTATUS(status);
}

void SandboxedProgram::kill_all() noexcept {
  // The descriptor stays that of this process, also when its number belongs to another one.
  if (!killed_.exchange(true)) syscall(SYS_pidfd_send_signal, pidfd_, SIGKILL, nullptr, 0);
}

std::string SandboxedProgram::folder_of_sandbox() {
  if (!root_.empty()) return root_;
  const std::string info = text_of(info_);
  const std::size_t begin = info.find_first_of("0123456789", info.find("child-pid"));
  if (info.empty() || info.back() != '}' || begin == std::string::npos) return {};
  const std::size_t end = info.find_first_not_of("0123456789", begin);
  root_ = "/proc/" + info.substr(begin, end - begin) + "/root";
  return root_;
}

std::string SandboxedProgram::excess() {
  const std::string root = folder_of_sandbox();
  if (root.empty() || is_own_root(root)) return {};
  Status all;
  std::error_code error;
  for (fs::directory_iterator entry(root + "/proc", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const Status one = read_status(entry->path() / "status");
    all.threads += one.threads;
    all.own_bytes += one.own_bytes;
  }
  if (all.threads >= limits_.tasks) {
    return "at least " + std::to_string(limits_.tasks) + " processes and threads";
  }
  if (all.own_bytes > limits_.memory_bytes) {
    return "more than " + std::to_string(limits_.memory_bytes / kMega) + " MB of memory";
  }
  for (const char* place : {"/tmp", "/dev/shm"}) {
    struct statvfs files {};
    if (sized_ || statvfs((root + place).c_str(), &files) != 0) continue;
    if ((files.f_blocks - files.f_bfree) * files.f_frsize > limits_.files_bytes) {
      return "more than " + std::to_string(limits_.files_bytes / kMega) + " MB in " + place;
    }
  }
  return {};
}

IsolationAbility try_isolation() {
  SandboxSettings settings;
  settings.command = {"/usr/bin/true"};
  settings.folder = "/tmp";
  sigset_t mask;
  pthread_sigmask(SIG_SETMASK, nullptr, &mask);
  try {
    std::string said;
    for (const bool sized : {true, false}) {
      settings.sized = sized;
      const int error = memory_file({});
      SandboxedProgram program(settings, mask, error);
      pollfd end{program.descriptor(), POLLIN, 0};
      while (::poll(&end, 1, -1) < 0 && errno == EINTR) {
      }
      const std::optional<int> status = program.poll();
      const std::string text = text_of(error);
      close(error);
      if (status == 0) return {{}, sized};
      said = text.empty() ? "status " + std::to_string(status.value_or(-1)) : text;
      if (said.find("--size") == std::string::npos)
        break;  // an older bubblewrap has no such option
    }
    return {"bubblewrap cannot make a sandbox here (" + said +
            "); it needs user namespaces, which the machine or the container may forbid"};
  } catch (const std::exception& e) {
    return {e.what()};
  }
}

}  // namespace playpen
