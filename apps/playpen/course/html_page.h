// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "course/class_result.h"

/// Parts that the pages of the HTML report have in common. All give HTML.
namespace playpen::course {

/// A whole page. @param script  "": the page may run no scripts.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body,
                                    const std::string& script);

/// A name from outside, which does not change the direction of the text around it.
[[nodiscard]] std::string isolated_name(const std::string& name);

/// The names of the class's tasks.
[[nodiscard]] std::string task_names(const ClassResult& result);

/// A number with its words, as an item of a list.
[[nodiscard]] std::string fact(std::size_t number, const std::string& words);

/// What became of a submission: "compiles", "does not compile", "nothing handed in".
[[nodiscard]] std::string build_state(const SubmissionResult& submission);

/// The state in its colour.
[[nodiscard]] std::string state_mark(const SubmissionResult& submission);

}  // namespace playpen::course
