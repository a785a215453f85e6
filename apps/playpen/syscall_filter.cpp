// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "syscall_filter.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace playpen {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#else
#error "The filter of system calls needs this machine's AUDIT_ARCH value."
#endif

constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;
constexpr std::uint32_t kNotImplemented = SECCOMP_RET_ERRNO | ENOSYS;
constexpr std::uint32_t kX32 = 0x40000000;  // bit of the calls of the x32 ABI
constexpr std::uint32_t kNewNamespaces = CLONE_NEWCGROUP | CLONE_NEWIPC | CLONE_NEWNET |
                                         CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWUSER | CLONE_NEWUTS;

// What is refused whatever its arguments are.
constexpr long kRefused[] = {
    // namespaces and mounts
    SYS_unshare, SYS_setns, SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_open_tree,
    SYS_move_mount, SYS_fsopen, SYS_fsconfig, SYS_fsmount, SYS_fspick, SYS_mount_setattr,
    SYS_open_by_handle_at,
    // the machine
    SYS_reboot, SYS_swapon, SYS_swapoff, SYS_init_module, SYS_finit_module, SYS_delete_module,
    SYS_kexec_load, SYS_acct, SYS_quotactl, SYS_settimeofday, SYS_clock_settime, SYS_syslog,
    // large parts of the kernel
    SYS_bpf, SYS_perf_event_open, SYS_userfaultfd, SYS_io_uring_setup, SYS_io_uring_enter,
    SYS_io_uring_register, SYS_add_key, SYS_request_key, SYS_keyctl, SYS_fanotify_init,
    // memory that belongs to no process
    SYS_memfd_create, SYS_shmget, SYS_msgget};

/// A filter that is written instruction by instruction. The accumulator holds what was loaded last.
class Filter {
 public:
  void load(std::size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
  }
  /// Skips this many instructions if the accumulator has the value.
  void if_equal_skip(std::uint32_t value, std::uint8_t count) {
    instructions_.push_back({BPF_JMP | BPF_JEQ | BPF_K, count, 0, value});
  }
  /// Skips this many instructions unless the accumulator has the value.
  void unless_equal_skip(std::uint32_t value, std::uint8_t count) {
    instructions_.push_back({BPF_JMP | BPF_JEQ | BPF_K, 0, count, value});
  }
  /// Skips this many instructions unless the accumulator has one of the bits.
  void unless_any_bit_skip(std::uint32_t bits, std::uint8_t count) {
    instructions_.push_back({BPF_JMP | BPF_JSET | BPF_K, 0, count, bits});
  }
  void end(std::uint32_t action) { add(BPF_RET | BPF_K, action); }

  [[nodiscard]] std::string bytes() const {
    return {reinterpret_cast<const char*>(instructions_.data()),
            instructions_.size() * sizeof(sock_filter)};
  }

 private:
  void add(std::uint16_t code, std::uint32_t value) {
    instructions_.push_back({code, 0, 0, value});
  }

  std::vector<sock_filter> instructions_;
};

/// Offset of the lower half of an argument of a call, on a little-endian machine.
constexpr std::size_t argument(std::size_t index) {
  return offsetof(seccomp_data, args) + index * sizeof(std::uint64_t);
}

}  // namespace

std::string syscall_filter() {
  Filter filter;
  filter.load(offsetof(seccomp_data, arch));
  filter.if_equal_skip(kMachine, 1);
  filter.end(kNotImplemented);
  filter.load(offsetof(seccomp_data, nr));
#if defined(__x86_64__)
  filter.unless_any_bit_skip(kX32, 1);
  filter.end(kNotImplemented);
#endif
  for (const long call : kRefused) {
    filter.unless_equal_skip(static_cast<std::uint32_t>(call), 1);
    filter.end(kRefuse);
  }
  filter.unless_equal_skip(SYS_clone3, 1);
  filter.end(kNotImplemented);
  filter.unless_equal_skip(SYS_clone, 4);
  filter.load(argument(0));
  filter.unless_any_bit_skip(kNewNamespaces, 1);
  filter.end(kRefuse);
  filter.end(SECCOMP_RET_ALLOW);
  filter.unless_equal_skip(SYS_ioctl, 5);
  filter.load(argument(1));
  filter.unless_equal_skip(TIOCSTI, 1);
  filter.end(kRefuse);
  filter.unless_equal_skip(TIOCLINUX, 1);
  filter.end(kRefuse);
  filter.end(SECCOMP_RET_ALLOW);
  return filter.bytes();
}

}  // namespace playpen
