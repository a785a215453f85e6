// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/loaded_files.h"

#ifdef PLAYPEN_LOADED_FILES

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

namespace sim {
namespace {

#ifdef __x86_64__
constexpr std::array<std::uint32_t, 3> kRelocationTypes{R_X86_64_JUMP_SLOT, R_X86_64_GLOB_DAT,
                                                        R_X86_64_64};
#else
constexpr std::array<std::uint32_t, 3> kRelocationTypes{R_AARCH64_JUMP_SLOT, R_AARCH64_GLOB_DAT,
                                                        R_AARCH64_ABS64};
#endif

Address page_size() {
  static const auto kSize = static_cast<Address>(sysconf(_SC_PAGESIZE));
  return kSize;
}

Address page_of(Address place) { return place / page_size() * page_size(); }

/// Number of symbols according to a table of the kind DT_GNU_HASH: one more than the last symbol of
/// the last bucket's chain.
std::size_t count_symbols(const std::uint32_t* table) {
  const std::uint32_t bucket_count = table[0];
  const std::uint32_t first = table[1];
  const std::uint32_t* const buckets = table + 4 + table[2] * (sizeof(Address) / sizeof *table);
  const std::uint32_t* const chains = buckets + bucket_count;
  std::uint32_t last = bucket_count == 0 ? 0 : *std::max_element(buckets, buckets + bucket_count);
  if (last < first) return first;
  while ((chains[last - first] & 1U) == 0) ++last;
  return last + 1;
}

std::string_view without_folder(std::string_view path) {
  return path.substr(path.rfind('/') + 1);  // npos + 1 is 0
}

LoadedFile read_file(const dl_phdr_info& info) {
  LoadedFile file;
  file.base = info.dlpi_addr;
  const ElfW(Dyn)* entry = nullptr;
  file.parts = {info.dlpi_phdr, info.dlpi_phnum};
  for (const ElfW(Phdr) & part : file.parts) {
    const Address begin = info.dlpi_addr + part.p_vaddr;
    if (part.p_type == PT_LOAD && file.begin == 0) file.begin = begin;
    if (part.p_type == PT_DYNAMIC) entry = reinterpret_cast<const ElfW(Dyn)*>(begin);
  }
  std::array<const Relocation*, 2> begins{};
  std::array<std::size_t, 2> sizes{};
  std::vector<std::size_t> needed;
  std::size_t own_name = 0;
  for (; entry != nullptr && entry->d_tag != DT_NULL; ++entry) {
    const Address value = entry->d_un.d_val;
    // The dynamic linker replaces offsets by addresses, except in its own file and the kernel's.
    const void* const place =
        reinterpret_cast<const void*>(value < file.base ? value + file.base : value);
    switch (entry->d_tag) {
      case DT_SYMTAB:
        file.symbols = static_cast<const Symbol*>(place);
        break;
      case DT_STRTAB:
        file.strings = static_cast<const char*>(place);
        break;
      case DT_GNU_HASH:
        file.symbol_count = count_symbols(static_cast<const std::uint32_t*>(place));
        break;
      case DT_HASH:
        if (file.symbol_count == 0) file.symbol_count = static_cast<const std::uint32_t*>(place)[1];
        break;
      case DT_RELA:
        begins[0] = static_cast<const Relocation*>(place);
        break;
      case DT_RELASZ:
        sizes[0] = value;
        break;
      case DT_JMPREL:
        begins[1] = static_cast<const Relocation*>(place);
        break;
      case DT_PLTRELSZ:
        sizes[1] = value;
        break;
      case DT_NEEDED:
        needed.push_back(value);
        break;
      case DT_SONAME:
        own_name = value;
        break;
      default:
        break;
    }
  }
  if (file.strings == nullptr || file.symbols == nullptr) return {};
  file.name = own_name != 0 ? file.strings + own_name : without_folder(info.dlpi_name);
  for (const std::size_t offset : needed) file.needed.emplace_back(file.strings + offset);
  for (std::size_t i = 0; i < begins.size(); ++i) {
    file.relocations[i] = {begins[i], sizes[i] / sizeof(Relocation)};
  }
  return file;
}

}  // namespace

int LoadedFile::protection_at(Address place) const {
  int protection = 0;
  for (const ElfW(Phdr) & part : parts) {
    if (place < base + part.p_vaddr || place >= base + part.p_vaddr + part.p_memsz) continue;
    if (part.p_type == PT_GNU_RELRO && place < page_of(base + part.p_vaddr + part.p_memsz)) {
      return PROT_READ;  // since it was relocated
    }
    if (part.p_type != PT_LOAD) continue;
    protection = ((part.p_flags & PF_R) != 0 ? PROT_READ : 0) |
                 ((part.p_flags & PF_W) != 0 ? PROT_WRITE : 0) |
                 ((part.p_flags & PF_X) != 0 ? PROT_EXEC : 0);
  }
  return protection;
}

template <typename T>
void LoadedFile::store_at(T* place, T value) const {
  const auto address = reinterpret_cast<Address>(place);
  void* const page = reinterpret_cast<void*>(page_of(address));
  const int protection = protection_at(address);
  const bool is_read_only = (protection & PROT_WRITE) == 0;
  if (is_read_only && mprotect(page, page_size(), protection | PROT_WRITE) != 0) return;
  __atomic_store_n(place, value, __ATOMIC_RELAXED);
  if (is_read_only) mprotect(page, page_size(), protection);
}

void LoadedFile::store(Address* place, Address value) const { store_at(place, value); }
void LoadedFile::store(Elf64_Section* place, Elf64_Section value) const { store_at(place, value); }

void LoadedFile::redirect(
    const std::function<std::optional<Address>(std::string_view)>& address_of) const {
  for (const auto& group : relocations) {
    for (const Relocation& relocation : group) {
      const std::size_t index = ELF64_R_SYM(relocation.r_info);
      const auto type = static_cast<std::uint32_t>(ELF64_R_TYPE(relocation.r_info));
      if (index == 0 || std::find(kRelocationTypes.begin(), kRelocationTypes.end(), type) ==
                            kRelocationTypes.end()) {
        continue;
      }
      const Symbol& symbol = symbols[index];
      if (symbol.st_shndx != SHN_UNDEF || ELF64_ST_TYPE(symbol.st_info) == STT_OBJECT) continue;
      const std::optional<Address> address = address_of(name_of(symbol));
      if (!address) continue;
      store(reinterpret_cast<Address*>(base + relocation.r_offset),
            *address + static_cast<Address>(relocation.r_addend));
    }
  }
}

std::vector<LoadedFile> loaded_files() {
  std::vector<LoadedFile> files;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t /*size*/, void* data) {
        static_cast<std::vector<LoadedFile>*>(data)->push_back(read_file(*info));
        return 0;
      },
      &files);
  return files;
}

}  // namespace sim

#endif
