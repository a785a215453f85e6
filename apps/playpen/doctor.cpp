// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "command_line.h"
#include "doctor_checks.h"
#include "terminal.h"

namespace playpen {
namespace {

struct Section {
  const char* heading;
  Findings (*check)();
};

constexpr Section kSections[] = {
    {"Installation", check_installation},
    {"A run", check_run},
    {"Building programs", check_building},
    {"Isolated programs (--isolated)", check_isolation},
    {"Grading a class (playpen class)", check_class},
    {"The live window (--view)", check_display},
    {"Films (--record)", check_films},
    {"Core dumps", check_core_dumps},
    {"Equal results on other machines", check_mathematics},
    {"Variables of the environment", check_variables},
};

std::string label(Health health, bool colour) {
  switch (health) {
    case Health::kGood:
      return tinted("ok    ", Tint::kGood, colour);
    case Health::kNote:
      return "note  ";
    case Health::kWarning:
      return tinted("WARN  ", Tint::kWarning, colour);
    case Health::kBroken:
      return tinted("BROKEN", Tint::kBad, colour);
  }
  return "";
}

void print(const Finding& finding) {
  constexpr std::size_t kIndent = 10;
  const std::size_t columns = terminal_columns(STDOUT_FILENO);
  std::cout << "  " << label(finding.health, shows_colour(STDOUT_FILENO)) << "  "
            << wrapped(finding.text, columns, kIndent) << '\n';
  const std::string arrow = std::string(kIndent, ' ') + "-> ";
  if (!finding.cure.empty()) {
    std::cout << arrow << wrapped(finding.cure, columns, arrow.size()) << '\n';
  }
  if (!finding.command.empty()) std::cout << arrow << finding.command << '\n';
}

int doctor() {
  std::size_t broken = 0;
  std::size_t warnings = 0;
  for (const Section& section : kSections) {
    std::cout << tinted(section.heading, Tint::kStrong, shows_colour(STDOUT_FILENO)) << std::endl;
    for (const Finding& finding : section.check()) {
      print(finding);
      if (finding.health == Health::kBroken) ++broken;
      if (finding.health == Health::kWarning) ++warnings;
    }
  }
  std::cout << '\n';
  if (broken > 0) {
    std::cout << "Runs do not work: see what is BROKEN.\n";
    return kProgramFailed;
  }
  std::cout << "Runs work." << (warnings > 0 ? " WARN lines concern other features." : "") << '\n';
  return kOk;
}

}  // namespace

void add_doctor(CommandLine& line) {
  struct Request {
    std::string probe;
    std::string file;
  };
  const auto request = std::make_shared<Request>();
  CLI::App& command = line.add_command("doctor", "Check installation, packages, display and films");
  // Hidden option, for the processes that the checks start.
  command.add_option("--probe", request->probe)->group("");
  command.add_option("--file", request->file)->group("");
  command.footer(
      "Runs a program, builds one and writes a film in a temporary folder.\n"
      "Exit status: 0 runs work, 1 something that they need is missing.");
  command.callback([request, &line] {
    line.status = request->probe.empty() ? doctor() : probe(request->probe, request->file);
  });
}

}  // namespace playpen
