// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What the dynamic linker has loaded into this process, and where calls between the files go. Only
// where PLAYPEN_LOADED_FILES is defined: with glibc on x86-64 and AArch64.
#pragma once

#include <cstdint>  // glibc defines __GLIBC__ in each of its headers

#if defined(__linux__) && defined(__GLIBC__) && (defined(__x86_64__) || defined(__aarch64__))
#define PLAYPEN_LOADED_FILES

#include <link.h>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sim {

using Address = ElfW(Addr);
using Symbol = ElfW(Sym);
using Relocation = ElfW(Rela);

/// A loaded file: the program or a library.
struct LoadedFile {
  std::string_view name;  ///< without its folder
  Address base = 0;       ///< what addresses in the file are relative to
  Address begin = 0;      ///< of its first part in memory
  std::span<const ElfW(Phdr)> parts;
  const Symbol* symbols = nullptr;
  std::size_t symbol_count = 0;
  const char* strings = nullptr;
  std::vector<std::string_view> needed;  ///< names of libraries
  std::array<std::span<const Relocation>, 2> relocations;

  [[nodiscard]] std::string_view name_of(const Symbol& symbol) const {
    return strings + symbol.st_name;
  }
  /// Stores a value in a part of the file, which may be read-only.
  void store(Address* place, Address value) const;
  void store(Elf64_Section* place, Elf64_Section value) const;
  /// Sends the file's calls of functions that it does not define to other ones.
  /// @param address_of  the address for a function's name; nullopt: no change.
  void redirect(const std::function<std::optional<Address>(std::string_view)>& address_of) const;

 private:
  /// Flags of mprotect().
  [[nodiscard]] int protection_at(Address place) const;
  template <typename T>
  void store_at(T* place, T value) const;
};

/// All loaded files; the first is the program.
[[nodiscard]] std::vector<LoadedFile> loaded_files();

}  // namespace sim

#endif
