// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <string>
#include <vector>

#include "commands.h"
#include "expect/expectation.h"
#include "plot_data.h"

namespace playpen {
std::size_t print_unmet(const std::vector<expect::Expectation>& expectations,
                        const std::string& folder) {
  const playerlike::Report report = read_run(folder).report;
  std::size_t count = 0;
  for (const expect::Expectation& expectation : expectations) {
    for (const std::string& fault : expectation.faults_of(report)) {
      ++count;
      std::cerr << "playpen: expected " << expectation.text() << ", but " << fault << '\n';
    }
  }
  return count;
}

int check_expectations(const ExpectRequest& request) {
  if (request.folder.empty()) {
    for (const expect::Expectation& one : request.expectations) std::cout << one.text() << '\n';
    return kOk;
  }
  return print_unmet(request.expectations, request.folder) == 0 ? kOk : kProgramFailed;
}

}  // namespace playpen
