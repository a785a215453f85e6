// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "command_line.h"
#include "own_folders.h"
#include "sim/core/error.h"
#include "terminal.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".md";

/// One page of the documentation.
struct Page {
  std::string name;  ///< path below the folder of pages, without ending: "devices/laser"
  fs::path file;
};

/// share/playpen/docs of this program's prefix, or docs/ of the source tree that contains the build
/// folder.
std::optional<fs::path> pages_folder() {
  std::error_code error;
  for (const fs::path& folder : own_folders()) {
    for (const char* candidate : {"share/playpen/docs", "docs"}) {
      if (fs::is_regular_file(folder / candidate / "index.md", error)) return folder / candidate;
    }
  }
  return std::nullopt;
}

/// All pages by name, those without a folder first.
std::vector<Page> all_pages() {
  const std::optional<fs::path> root = pages_folder();
  if (!root) {
    throw std::runtime_error(
        "the documentation, share/playpen/docs beside the folder of this program, is missing; "
        "install Playpen again");
  }
  std::vector<Page> pages;
  for (const char* folder : {"", "devices", "decisions"}) {
    const std::size_t first = pages.size();
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(*root / folder, error)) {
      if (entry.path().extension() != kSuffix) continue;
      pages.push_back({(fs::path(folder) / entry.path().stem()).string(), entry.path()});
    }
    std::sort(pages.begin() + static_cast<std::ptrdiff_t>(first), pages.end(),
              [](const Page& a, const Page& b) { return a.name < b.name; });
  }
  return pages;
}

std::string title_of(const Page& page) {
  std::ifstream stream(page.file);
  std::string line;
  std::getline(stream, line);
  return line.starts_with("# ") ? line.substr(2) : line;
}

/// The page that a user means by "devices/laser", "laser", "laser.md" or "docs/devices/laser.md".
const Page& find_page(const std::vector<Page>& pages, const std::string& wanted) {
  std::string name = wanted;
  if (name.starts_with("docs/")) name.erase(0, std::string_view("docs/").size());
  if (name.ends_with(kSuffix)) name.resize(name.size() - kSuffix.size());
  std::vector<std::string> names;
  for (const bool in_folders : {false, true}) {
    for (const Page& page : pages) {
      names.push_back(in_folders ? fs::path(page.name).filename().string() : page.name);
      if (names.back() == name) return page;
    }
  }
  const std::string near = sim::nearest_word(name, names);
  throw std::runtime_error("there is no page '" + wanted + "'" +
                           (near.empty() ? "" : "; did you mean '" + near + "'?") +
                           " 'playpen doc' lists the pages.");
}

void print_list(const std::vector<Page>& pages) {
  const std::size_t columns = terminal_columns(STDOUT_FILENO);
  std::size_t title_at = 0;
  for (const Page& page : pages) title_at = std::max(title_at, page.name.size() + 2);
  for (const Page& page : pages) {
    std::string name = page.name;
    name.resize(title_at, ' ');
    std::cout << name << wrapped(title_of(page), columns, title_at) << '\n';
  }
}

/// Prints a page; on a terminal, by the user's pager.
void show(const Page& page) {
  if (isatty(STDOUT_FILENO) != 0) {
    const char* const chosen = std::getenv("PAGER");
    const std::string pager = chosen == nullptr || *chosen == '\0' ? "less -F" : chosen;
    // Like man(1): the pager may be a command with arguments.
    if (std::system((pager + ' ' + shell_word(page.file.string())).c_str()) == 0) return;
  }
  std::ifstream stream(page.file, std::ios::binary);
  std::cout << stream.rdbuf();
  if (!stream) throw std::runtime_error("the page " + page.file.string() + " cannot be read");
}

}  // namespace

void add_doc(CommandLine& line) {
  struct Request {
    std::string page;
    bool names = false;
  };
  const auto request = std::make_shared<Request>();
  CLI::App& command =
      line.add_command("doc", "Show a page of the documentation, or list the pages");
  CLI::Option* const page =
      command.add_option("page", request->page, "Name of the page [list all pages]");
  line.takes(page->type_name(""), ValueKind::Kind::kPage);
  command.add_flag("--names", request->names, "Only the names, one a line")->excludes(page);
  command.footer(
      "On a terminal, the program that PAGER names shows the page (default: less).\n"
      "For example:\n"
      "  playpen doc start_here");
  command.callback([request] {
    const std::vector<Page> pages = all_pages();
    if (!request->page.empty()) {
      show(find_page(pages, request->page));
    } else if (request->names) {
      for (const Page& one : pages) std::cout << one.name << '\n';
    } else {
      print_list(pages);
    }
  });
}

}  // namespace playpen
