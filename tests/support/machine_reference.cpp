// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
//
// Compiled by tests/machine.sh to learn how fast a machine compiles. It includes nothing of ours
// and does not change, because the budgets of processor time refer to it.
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <regex>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

namespace {

template <int kIndex>
std::size_t one() {
  std::map<std::string, std::vector<double>> numbers;
  std::unordered_map<int, std::function<double(double)>> functions;
  std::mt19937_64 random(kIndex);
  for (int i = 0; i < 100; ++i) {
    numbers[std::to_string(i)].push_back(std::normal_distribution<double>()(random));
    functions[i] = [i](double x) { return x * i + kIndex; };
  }
  std::vector<std::variant<int, std::string>> values{kIndex, std::to_string(kIndex)};
  std::sort(values.begin(), values.end());
  std::smatch match;
  const std::string text = numbers.begin()->first;
  return std::regex_match(text, match, std::regex("[0-9]+")) ? match.size() + values.size()
                                                             : functions.size();
}

}  // namespace

int main() { std::cout << one<0>() + one<1>() + one<2>() + one<3>() << '\n'; }
