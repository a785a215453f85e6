// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/library_functions.h"

#include <cstdint>

#if defined(__linux__) && defined(__GLIBC__) && (defined(__x86_64__) || defined(__aarch64__))

#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <vector>

namespace sim {
namespace {

using Address = ElfW(Addr);
using Symbol = ElfW(Sym);
using Relocation = ElfW(Rela);

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

/// What the dynamic linker knows about a loaded file: the program or a library.
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
  /// Flags of mprotect().
  [[nodiscard]] int protection_at(Address place) const {
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
};

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

/// All loaded files; the first is the program.
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

bool allocates(std::string_view name) {
  return name.ends_with("alloc") || name.ends_with("memalign") || name == "free" ||
         name == "reallocarray" || name == "malloc_usable_size";
}

bool is_variable(const void* address) {
  Dl_info info{};
  const Symbol* symbol = nullptr;
  return dladdr1(address, &info, reinterpret_cast<void**>(const_cast<Symbol**>(&symbol)),
                 RTLD_DL_SYMENT) != 0 &&
         symbol != nullptr && info.dli_saddr == address &&
         ELF64_ST_TYPE(symbol->st_info) == STT_OBJECT;
}

/// A function of the libraries below Playpen's whose name the program defines, too.
struct HiddenFunction {
  Address address;
  Symbol* in_program;     ///< the program's entry of that name
  Elf64_Section section;  ///< where the entry says the program's definition is
};
using HiddenFunctions = std::map<std::string_view, HiddenFunction>;

HiddenFunctions hidden_functions(const LoadedFile& program) {
  HiddenFunctions hidden;
  Dl_info own{};
  if (dladdr(reinterpret_cast<const void*>(&loaded_files), &own) == 0 ||
      reinterpret_cast<Address>(own.dli_fbase) == program.begin) {
    return hidden;
  }
  void* const library = dlopen(own.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  if (library == nullptr) return hidden;
  for (const Symbol& symbol : std::span(program.symbols, program.symbol_count)) {
    if (symbol.st_shndx == SHN_UNDEF) continue;
    const std::string_view name = program.name_of(symbol);
    if (name.starts_with("__sanitizer_")) {  // its interceptors are meant for all libraries
      hidden.clear();
      break;
    }
    if (name.empty() || name.starts_with('_') || allocates(name)) continue;
    const void* const found = dlsym(library, name.data());
    if (found != nullptr && !is_variable(found)) {
      hidden[name] = {reinterpret_cast<Address>(found), const_cast<Symbol*>(&symbol),
                      symbol.st_shndx};
    }
  }
  dlclose(library);
  return hidden;
}

/// Names of Playpen's libraries and of all that they need.
std::set<std::string_view> names_of_own(const std::vector<LoadedFile>& files) {
  std::set<std::string_view> names;
  const auto add = [&](const LoadedFile& file) {
    names.insert(file.name);
    names.insert(file.needed.begin(), file.needed.end());
  };
  for (const LoadedFile& file : files) {
    if (file.name.starts_with("libplaypen_")) add(file);
  }
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const LoadedFile& file : files) {
      if (names.contains(file.name)) add(file);
    }
  }
  return names;
}

/// Stores a value in a part of a file, which may be read-only.
template <typename T>
void store(const LoadedFile& file, T* place, T value) {
  const auto address = reinterpret_cast<Address>(place);
  void* const page = reinterpret_cast<void*>(page_of(address));
  const int protection = file.protection_at(address);
  const bool is_read_only = (protection & PROT_WRITE) == 0;
  if (is_read_only && mprotect(page, page_size(), protection | PROT_WRITE) != 0) return;
  __atomic_store_n(place, value, __ATOMIC_RELAXED);
  if (is_read_only) mprotect(page, page_size(), protection);
}

void redirect(const LoadedFile& file, const HiddenFunctions& functions) {
  for (const auto& relocations : file.relocations) {
    for (const Relocation& relocation : relocations) {
      const std::size_t index = ELF64_R_SYM(relocation.r_info);
      const auto type = static_cast<std::uint32_t>(ELF64_R_TYPE(relocation.r_info));
      if (index == 0 || std::find(kRelocationTypes.begin(), kRelocationTypes.end(), type) ==
                            kRelocationTypes.end()) {
        continue;
      }
      const Symbol& symbol = file.symbols[index];
      if (symbol.st_shndx != SHN_UNDEF || ELF64_ST_TYPE(symbol.st_info) == STT_OBJECT) continue;
      const auto function = functions.find(file.name_of(symbol));
      if (function == functions.end()) continue;
      store(file, reinterpret_cast<Address*>(file.base + relocation.r_offset),
            function->second.address + static_cast<Address>(relocation.r_addend));
    }
  }
}

struct Program {
  LoadedFile file;
  HiddenFunctions hidden;
};

// Never destroyed: other static objects may load modules in their destructors.
const Program& program() {
  static const auto* const kProgram = [] {
    const std::vector<LoadedFile> files = loaded_files();
    auto* const made = new Program;
    if (!files.empty()) *made = {files.front(), hidden_functions(files.front())};
    return made;
  }();
  return *kProgram;
}

// Before the static objects of Playpen's libraries.
__attribute__((constructor(101))) void keep_library_functions() {
  if (program().hidden.empty()) return;
  const std::vector<LoadedFile> files = loaded_files();
  const std::set<std::string_view> own = names_of_own(files);
  for (const LoadedFile& file : std::span(files).subspan(1)) {
    if (own.contains(file.name)) redirect(file, program().hidden);
  }
}

std::atomic<int> hiding = 0;  // number of objects that hide the names

}  // namespace

HiddenProgramNames::HiddenProgramNames() {
  if (hiding++ > 0) return;
  for (const auto& [name, function] : program().hidden) {
    store(program().file, &function.in_program->st_shndx, Elf64_Section{SHN_UNDEF});
  }
}

HiddenProgramNames::~HiddenProgramNames() {
  if (--hiding > 0) return;
  for (const auto& [name, function] : program().hidden) {
    store(program().file, &function.in_program->st_shndx, function.section);
  }
}

}  // namespace sim

#else

sim::HiddenProgramNames::HiddenProgramNames() = default;
sim::HiddenProgramNames::~HiddenProgramNames() = default;

#endif
