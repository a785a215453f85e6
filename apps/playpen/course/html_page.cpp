// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/html_page.h"

#include "course/html_style.h"
#include "course/html_text.h"

namespace playpen::course {

std::string html_page(const std::string& title, const std::string& body,
                      const std::string& script) {
  // The pages load nothing but pictures. Pages without a script run none, even if a text of a
  // submission could get into them as HTML.
  const std::string policy =
      "default-src 'none'; img-src 'self' file: data:; style-src 'unsafe-inline'" +
      std::string(script.empty() ? "" : "; script-src 'unsafe-inline'");
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
      policy +
      "\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + "</title>\n<style>" + kReportStyle + "</style>\n</head>\n<body>\n" + body;
  if (!script.empty()) html += "<script>" + script + "</script>\n";
  return html + "</body>\n</html>\n";
}

std::string isolated_name(const std::string& name) {
  return "<bdi>" + html_escaped(name) + "</bdi>";
}

std::string task_names(const ClassResult& result) {
  std::string names;
  for (const grade::Task& task : result.tasks) {
    names += (names.empty() ? "" : ", ") + html_escaped(task.name);
  }
  return names;
}

std::string fact(std::size_t number, const std::string& words) {
  return "<li><b>" + std::to_string(number) + "</b> " + words + "</li>";
}

std::string build_state(const SubmissionResult& submission) {
  if (!submission.handed_in) return "nothing handed in";
  return submission.build.built ? "compiles" : "does not compile";
}

std::string state_mark(const SubmissionResult& submission) {
  return std::string("<span class=\"") + (submission.build.built ? "good" : "bad") + "\">" +
         build_state(submission) + "</span>";
}

}  // namespace playpen::course
