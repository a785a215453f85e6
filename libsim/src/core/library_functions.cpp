// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "core/library_functions.h"

#include "core/loaded_files.h"

#ifdef PLAYPEN_LOADED_FILES

#include <dlfcn.h>
#include <link.h>

#include <atomic>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

namespace sim {
namespace {

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
    if (!own.contains(file.name)) continue;
    file.redirect([](std::string_view name) -> std::optional<Address> {
      const auto function = program().hidden.find(name);
      if (function == program().hidden.end()) return std::nullopt;
      return function->second.address;
    });
  }
}

std::atomic<int> hiding = 0;  // number of objects that hide the names

}  // namespace

HiddenProgramNames::HiddenProgramNames() {
  if (hiding++ > 0) return;
  for (const auto& [name, function] : program().hidden) {
    program().file.store(&function.in_program->st_shndx, Elf64_Section{SHN_UNDEF});
  }
}

HiddenProgramNames::~HiddenProgramNames() {
  if (--hiding > 0) return;
  for (const auto& [name, function] : program().hidden) {
    program().file.store(&function.in_program->st_shndx, function.section);
  }
}

}  // namespace sim

#else

sim::HiddenProgramNames::HiddenProgramNames() = default;
sim::HiddenProgramNames::~HiddenProgramNames() = default;

#endif
