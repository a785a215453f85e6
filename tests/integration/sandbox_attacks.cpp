// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Programs that try to break out of the sandbox of `playpen grade --isolated`, one for each name.
// What they get hold of they print after "BROKEN OUT". They end with status 0 wherever they can, so
// that nothing but the sandbox makes them fail.
#include <dirent.h>
#include <fcntl.h>
#include <libplayerc++/playerc++.h>
#include <linux/keyctl.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

namespace fs = std::filesystem;

void broken_out(const std::string& what) { std::cout << "BROKEN OUT: " << what << std::endl; }

/// Prints a file's content, if it has any.
void read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!text.empty()) broken_out(file.string() + " is " + text.substr(0, 1000));
}

void write_file(const fs::path& file) {
  std::ofstream stream(file, std::ios::binary | std::ios::app);
  stream << "{}" << std::flush;
  if (stream) broken_out("wrote " + file.string());
}

/// Reads everything below a folder.
void read_folder(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file(error)) read_file(entry->path());
  }
}

void refused(const char* call, long result) {
  if (result >= 0) broken_out(call);
}

/// A socket that is connected to the simulation; -1 on failure.
int connect_to_simulation() {
  const int peer = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const char* world = std::getenv("PLAYPEN_WORLD");
  const std::string path = world == nullptr ? "" : std::string(world).substr(sizeof "unix:" - 1);
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  if (connect(peer, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return peer;
  close(peer);
  return -1;
}

/// Sends this text to the simulation and prints what it answers within a second.
std::string say(const std::string& text) {
  const int peer = connect_to_simulation();
  static_cast<void>(send(peer, text.data(), text.size(), MSG_NOSIGNAL));
  const timeval limit{1, 0};
  setsockopt(peer, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  std::string answer(4096, '\0');
  const ssize_t size = recv(peer, answer.data(), answer.size(), 0);
  answer.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  close(peer);
  std::cout << answer << '\n';
  return answer;
}

/// Drives as the task wants it.
void drive() {
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy motors(&client);
  for (;;) {
    client.Read();
    motors.SetSpeed(0.2, 0.0);
  }
}

/// Stays at the simulation until its end, so that the run is a complete one.
void stay() {
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy motors(&client);
  for (;;) client.Read();
}

/// Uses a proxy of the world; prints what it is good for, and the reason if it is refused.
template <typename Use>
void use(const char* what, const Use& act) {
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy motors(&client);
  client.Read();
  try {
    act(client);
    broken_out(what);
  } catch (const PlayerCc::PlayerError& error) {
    std::cout << error.GetErrorStr() << std::endl;
  }
  for (;;) client.Read();
}

void true_pose() {
  use("the true pose", [](PlayerCc::PlayerClient& client) {
    PlayerCc::SimulationProxy simulation(&client);
    char name[] = "r1";
    double x = 0.0;
    double y = 0.0;
    double a = 0.0;
    simulation.GetPose2d(name, x, y, a);
    if (x == 0.0) throw PlayerCc::PlayerError("use", "there is no pose");
  });
}
void move_robot() {
  use("the robot was moved", [](PlayerCc::PlayerClient& client) {
    PlayerCc::SimulationProxy simulation(&client);
    char name[] = "r1";
    simulation.SetPose2d(name, 1.5, 1.5, 0.0);
    throw PlayerCc::PlayerError("use", "the report says whether the robot was moved");
  });
}
void ask_for_map() {
  use("the map", [](PlayerCc::PlayerClient& client) {
    PlayerCc::MapProxy map(&client);
    map.RequestMap();
    if (map.GetWidth() == 0) throw PlayerCc::PlayerError("use", "the map is empty");
  });
}

// --- Files

void read_named(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    read_folder(path);
  } else {
    read_file(path);
  }
  stay();
}
void write_named(const std::string& path) {
  write_file(path);
  stay();
}
void write_through_link(const std::string& path) {
  const fs::path link = fs::path(std::getenv("HOME")) / "link";
  fs::create_symlink(path, link);
  write_file(link);
  stay();
}
void change_own_program() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  std::error_code error;
  write_file(program.parent_path() / "libplayerc++.so.3");
  fs::permissions(program, fs::perms::all, error);
  if (!error) broken_out("changed the rights of the program");
  fs::rename(program, program.string() + ".old", error);
  if (!error) broken_out("renamed the program");
  stay();
}
void forge_report() {
  const std::string report = R"({"robots": [{"name": "r1", "distance": 99.0, "collisions": 0}]})";
  const char* out = std::getenv("PLAYPEN_OUT");
  for (const fs::path& folder : {fs::path(out == nullptr ? "." : out), fs::path("out")}) {
    std::ofstream(folder / "report.json") << report;
  }
  std::cout << report << "\n\"passed\": true" << std::endl;
}
void fill_disks() {
  const std::string block(1 << 20, 'x');
  std::size_t total = 0;
  for (const char* folder : {"/tmp", "/dev/shm", "/dev", "/", "/run", "."}) {
    for (int number = 0; number < 20; ++number) {
      std::signal(SIGXFSZ, SIG_IGN);
      std::ofstream file(std::string(folder) + "/full" + std::to_string(number));
      while (file.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) {
        total += block.size();
        constexpr std::size_t kMuch = 200'000'000;
        if (total > kMuch) return broken_out("wrote 200 MB of files");
      }
    }
  }
}
void open_devices() {
  for (const char* device :
       {"/dev/mem", "/dev/kmsg", "/dev/vda", "/dev/sda", "/dev/fuse", "/dev/kvm",
        "/proc/sysrq-trigger", "/proc/kcore", "/proc/sys/kernel/core_pattern"}) {
    if (open(device, O_WRONLY | O_CLOEXEC) >= 0) broken_out(device);
  }
  stay();
}

// --- Processes

void find_descriptors() {
  for (int number = STDERR_FILENO + 1; number < 1000; ++number) {
    if (fcntl(number, F_GETFD) >= 0) broken_out("descriptor " + std::to_string(number));
  }
  stay();
}
void read_environments() {
  for (const char* name : {"PLAYPEN_GRADE", "PLAYPEN_OUT", "PLAYPEN_STATE", "PLAYPEN_DESK",
                           "PLAYPEN_TASK", "ATTACK_SECRET"}) {
    if (std::getenv(name) != nullptr) broken_out(name);
  }
  for (int process = 1; process < 40'000; ++process) {
    std::ifstream stream("/proc/" + std::to_string(process) + "/environ");
    const std::string text{std::istreambuf_iterator<char>(stream),
                           std::istreambuf_iterator<char>()};
    if (text.find("PLAYPEN_GRADE") != std::string::npos) broken_out("the grader's number");
  }
  stay();
}
/// Does something to all processes that are not this one or its descendants.
void look_at_processes() {
  for (int process = 1; process < 40'000; ++process) {
    std::ifstream stream("/proc/" + std::to_string(process) + "/comm");
    std::string name;
    if (!(stream >> name) || process == getpid()) continue;
    if (name.starts_with("playpen") || name.starts_with("isolation")) broken_out("sees " + name);
    char word[8] = {};
    const iovec here{word, sizeof word};
    const iovec there{reinterpret_cast<void*>(0x400000), sizeof word};
    if (process_vm_readv(process, &here, 1, &there, 1, 0) > 0 && name != "bwrap") {
      broken_out("read the memory of " + name);
    }
  }
  stay();
}
void trace_parent() {
  // The first process of the sandbox is its own, and has nothing that the program has not.
  if (getppid() > 1 && ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr) == 0) {
    broken_out("traces the parent");
  }
  stay();
}
void kill_all() { kill(-1, SIGKILL); }
void stop_parents() {
  kill(getppid(), SIGSTOP);
  kill(1, SIGSTOP);
  kill(0, SIGTERM);
}
void fork_bomb() {
  for (;;) {
    if (fork() < 0) usleep(1000);
  }
}
void thread_bomb() {
  std::vector<std::thread> threads;
  try {
    for (;;) {
      threads.emplace_back([] { pause(); });
      constexpr std::size_t kMany = 2000;
      if (threads.size() > kMany) return broken_out("2000 threads");
    }
  } catch (const std::system_error& error) {
    std::cout << error.what() << std::endl;
    std::_Exit(0);
  }
}
void memory_bomb() {
  std::vector<std::vector<char>> blocks;
  constexpr std::size_t kBlock = 64'000'000;
  constexpr std::size_t kMuch = 100;
  while (blocks.size() < kMuch) blocks.emplace_back(kBlock, 'x');
  broken_out("6.4 GB of memory");
}
void leave_processes(const std::string& marker) {
  for (int i = 0; i < 3; ++i) {
    if (fork() == 0) {
      setsid();
      if (fork() == 0) {
        for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_IGN);
        prctl(PR_SET_NAME, marker.c_str());
        for (;;) pause();
      }
      _exit(0);
    }
  }
  while (wait(nullptr) > 0) {
  }
}
void gain_rights() {
  if (prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) != 1) broken_out("programs may gain rights");
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("CapEff:") && line.find_first_not_of("0\t ", 7) != std::string::npos) {
      broken_out(line);
    }
  }
  stay();
}

// --- The kernel

void make_namespaces() {
  refused("unshare", unshare(CLONE_NEWUSER));
  refused("mount", mount("none", "/tmp", "tmpfs", 0, nullptr));
  refused("umount", umount2("/tmp", MNT_DETACH));
  refused("chroot", chroot("/tmp"));
  const long child =
      syscall(SYS_clone, CLONE_NEWUSER | SIGCHLD, nullptr, nullptr, nullptr, nullptr);
  if (child == 0) _exit(0);
  refused("clone", child);
  stay();
}
void use_large_calls() {
  char space[256] = {};
  refused("bpf", syscall(SYS_bpf, 0, space, sizeof space));
  refused("io_uring_setup", syscall(SYS_io_uring_setup, 8, space));
  refused("userfaultfd", syscall(SYS_userfaultfd, 0));
  refused("perf_event_open", syscall(SYS_perf_event_open, space, 0, -1, -1, 0));
  refused("keyctl", syscall(SYS_keyctl, KEYCTL_GET_KEYRING_ID, KEY_SPEC_USER_KEYRING, 0));
  refused("memfd_create", syscall(SYS_memfd_create, "x", 0));
  stay();
}
void type_into_terminal() {
  char letter = 'x';
  for (const int terminal : {0, 1, 2, open("/dev/tty", O_RDWR | O_CLOEXEC)}) {
    if (terminal >= 0 && ioctl(terminal, TIOCSTI, &letter) == 0) broken_out("typed");
  }
  stay();
}
void use_other_machine() {
#if defined(__x86_64__)
  // The same call by its number on 32-bit machines, which a filter may forget: unshare is 310.
  long result = 0;
  __asm__ volatile("int $0x80" : "=a"(result) : "a"(310), "b"(CLONE_NEWUSER) : "memory");
  if (result == 0) broken_out("unshare by the 32-bit number");
#endif
  stay();
}

// --- Others on this machine

void connect_to_port(const std::string& port) {
  const int peer = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(peer, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    broken_out("connected to a port");
  }
  stay();
}
void connect_to_socket(const std::string& name) {
  const int peer = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const bool abstract = name.front() == '@';
  std::memcpy(address.sun_path, name.data(), name.size());
  if (abstract) address.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  if (connect(peer, reinterpret_cast<const sockaddr*>(&address), size) == 0) {
    broken_out("connected to " + name);
  }
  stay();
}
void find_shared_memory(const std::string& key) {
  refused("shmget", shmget(std::stoi(key), 0, 0));
  stay();
}

// --- The simulation

void other_world() {
  setenv("PLAYPEN_WORLD", "", 1);
  setenv("PLAYPEN_DURATION", "5", 1);
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy motors(&client);
  for (;;) {
    client.Read();
    motors.SetSpeed(0.2, 0.0);
  }
}
void other_environment() {
  char* const words[] = {const_cast<char*>("/proc/self/exe"), const_cast<char*>("other_world"),
                         nullptr};
  setenv("LD_PRELOAD", "/tmp/none.so", 1);
  execv(words[0], words);
}
void never_connect() {}
void connect_only() { PlayerCc::PlayerClient client("localhost"); }
void quit_simulation() {
  say("id1 simulation quit\n");
  stay();
}
void ask_as_morse() {
  const std::string pose = say("id1 r1.pose get_local_data\n");
  if (pose.find("SUCCESS") != std::string::npos) broken_out("the pose by MORSE's protocol");
  const std::string moved =
      say("id1 simulation set_object_pose [\"r1\", [1, 1, 0], [1, 0, 0, 0]]\n");
  if (moved.find("SUCCESS") != std::string::npos) broken_out("moved by MORSE's protocol");
  stay();
}
void send_noise() {
  std::string noise;
  for (unsigned state = 1; noise.size() < 100'000;) {
    state = state * 1103515245U + 12345U;
    noise += static_cast<char>(state >> 16U);
  }
  for (std::size_t begin = 0; begin < noise.size(); begin += 5'000) {
    const int peer = connect_to_simulation();
    static_cast<void>(send(peer, noise.data() + begin, 5'000, MSG_NOSIGNAL));
    close(peer);
  }
  stay();
}
void send_without_end() {
  const int peer = connect_to_simulation();
  const std::string block(1 << 20, 'x');
  for (int i = 0; i < 100; ++i) {
    if (send(peer, block.data(), block.size(), MSG_NOSIGNAL) < 0) break;
  }
  stay();
}
void hold_connections() {
  for (int i = 0; i < 900; ++i) static_cast<void>(connect_to_simulation());
  stay();
}
void change_clock() {
  const timespec time{0, 0};
  refused("clock_settime", syscall(SYS_clock_settime, CLOCK_REALTIME, &time));
  stay();
}
void sleep_beside_the_library() {
  PlayerCc::PlayerClient client("localhost");
  PlayerCc::Position2dProxy motors(&client);
  motors.SetSpeed(0.2, 0.0);
  const timespec time{0, 200'000'000};
  for (int i = 0; i < 3; ++i) syscall(SYS_nanosleep, &time, nullptr);
}
void crash() {
  PlayerCc::PlayerClient client("localhost");
  client.Read();
  std::abort();
}
void print_escapes() {
  std::cout << "\033[2J\033]0;passed\007\r\033[Kpass" << std::endl;
  stay();
}

// --- Programs without an end

void hang() {
  PlayerCc::PlayerClient client("localhost");
  for (;;) pause();
}
void compute() {
  volatile bool goes_on = true;
  while (goes_on) {
  }
}
void print_for_ever() {
  const std::string line(1000, 'x');
  for (;;) std::cout << line << '\n';
}
void ignore_signals() {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_IGN);
  for (;;) pause();
}

using Attack = std::function<void(const std::string&)>;

Attack without_argument(void (*attack)()) {
  return [attack](const std::string&) { attack(); };
}

const std::map<std::string, Attack>& attacks() {
  static const auto* const all = new std::map<std::string, Attack>{
      {"ask_as_morse", without_argument(ask_as_morse)},
      {"ask_for_map", without_argument(ask_for_map)},
      {"change_clock", without_argument(change_clock)},
      {"change_own_program", without_argument(change_own_program)},
      {"compute", without_argument(compute)},
      {"connect_only", without_argument(connect_only)},
      {"connect_to_port", connect_to_port},
      {"connect_to_socket", connect_to_socket},
      {"crash", without_argument(crash)},
      {"drive", without_argument(drive)},
      {"fill_disks", without_argument(fill_disks)},
      {"find_descriptors", without_argument(find_descriptors)},
      {"find_shared_memory", find_shared_memory},
      {"forge_report", without_argument(forge_report)},
      {"fork_bomb", without_argument(fork_bomb)},
      {"gain_rights", without_argument(gain_rights)},
      {"hang", without_argument(hang)},
      {"hold_connections", without_argument(hold_connections)},
      {"ignore_signals", without_argument(ignore_signals)},
      {"kill_all", without_argument(kill_all)},
      {"leave_processes", leave_processes},
      {"look_at_processes", without_argument(look_at_processes)},
      {"make_namespaces", without_argument(make_namespaces)},
      {"memory_bomb", without_argument(memory_bomb)},
      {"move_robot", without_argument(move_robot)},
      {"never_connect", without_argument(never_connect)},
      {"open_devices", without_argument(open_devices)},
      {"other_environment", without_argument(other_environment)},
      {"other_world", without_argument(other_world)},
      {"print_escapes", without_argument(print_escapes)},
      {"print_for_ever", without_argument(print_for_ever)},
      {"quit_simulation", without_argument(quit_simulation)},
      {"read", read_named},
      {"read_environments", without_argument(read_environments)},
      {"send_noise", without_argument(send_noise)},
      {"send_without_end", without_argument(send_without_end)},
      {"sleep_beside_the_library", without_argument(sleep_beside_the_library)},
      {"stop_parents", without_argument(stop_parents)},
      {"thread_bomb", without_argument(thread_bomb)},
      {"trace_parent", without_argument(trace_parent)},
      {"true_pose", without_argument(true_pose)},
      {"type_into_terminal", without_argument(type_into_terminal)},
      {"use_large_calls", without_argument(use_large_calls)},
      {"use_other_machine", without_argument(use_other_machine)},
      {"write", write_named},
      {"write_through_link", write_through_link},
  };
  return *all;
}

}  // namespace

/// ATTACK [on=ARGUMENT]
int main(int argc, char** argv) {
  const auto attack = attacks().find(argc > 1 ? argv[1] : "");
  if (attack == attacks().end()) return 2;
  const std::string on = argc > 2 ? std::string(argv[2]).substr(sizeof "on=" - 1) : "";
  try {
    attack->second(on);
  } catch (const PlayerCc::PlayerError& error) {
    std::cout << error.GetErrorStr() << std::endl;
  }
  return 0;
}
