// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The playpen command's documentation of itself: help, hints, manual page, shell completion.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"
#include "terminal.h"

namespace {

using test_support::playpen;
using test_support::ProcessResult;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

const std::vector<std::string> kCommands = {
    "run",    "grade", "serve", "new",    "list",  "check", "render", "plot",       "diff",
    "expect", "fuzz",  "why",   "replay", "token", "doc",   "doctor", "completion", "help"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// `doctor` reports a variable that is not listed as misspelt.
TEST(PlaypenHelp, ManualPage_ListsVariablesOfStartHere) {
  const std::string page = test_support::read_bytes(PLAYPEN_SOURCE_DIR "/docs/start_here.md");
  const std::string manual = playpen({"help", "--man"}).out;
  const std::regex variable("`(PLAYPEN_[A-Z_]+)`");
  int count = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), variable), end; it != end; ++it, ++count) {
    EXPECT_THAT(manual, HasSubstr(it->str(1)));
  }
  EXPECT_GT(count, 15);
}

TEST(PlaypenHelp, HelpCommand_SameAsOption) {
  EXPECT_EQ(playpen({"help"}).out, playpen({"--help"}).out);
  for (const std::string& command : kCommands) {
    const ProcessResult result = playpen({"help", command});
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_EQ(result.out, playpen({command, "--help"}).out) << command;
    EXPECT_THAT(playpen({"--help"}).out, HasSubstr("\n  " + command + ' '));
    for (const std::string& line : lines_of(result.out)) EXPECT_LE(line.size(), 80U) << line;
  }
  EXPECT_THAT(playpen({"help", "run"}).out, HasSubstr("-- PROGRAM [ARGUMENT...]"));
}

TEST(PlaypenHelp, Version_HasShortOption) {
  EXPECT_EQ(playpen({"-V"}).status, 0);
  EXPECT_EQ(playpen({"-V"}).out, playpen({"--version"}).out);
}

TEST(PlaypenHelp, UnknownWord_SuggestsNearest) {
  struct Case {
    std::vector<std::string> call;
    const char* unknown;
    const char* near;
  };
  const std::vector<Case> cases = {
      {{"rn"}, "command 'rn'", "'run'"},
      {{"help", "grad"}, "command 'grad'", "'grade'"},
      {{"--vrsion"}, "option '--vrsion'", "'--version'"},
      {{"run", "cave", "--durtion", "5", "--", "/bin/true"}, "option '--durtion'", "'--duration'"},
      {{"run", "--durtion=5", "cave", "--", "/bin/true"}, "option '--durtion'", "'--duration'"},
      // The misspelling is also the reason why --out is missing.
      {{"render", "cave", "--oout", "a.png"}, "option '--oout'", "'--out'"},
      {{"serve", "cave", "--prot", "4000"}, "option '--prot'", "'--port'"},
      {{"new", "introo", "x"}, "template 'introo'", "'intro'"},
  };
  for (const Case& c : cases) {
    const ProcessResult result = playpen(c.call);
    EXPECT_EQ(result.status, 2) << c.unknown;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr(c.unknown), HasSubstr(std::string("did you mean ") + c.near)));
    EXPECT_THAT(result.out, IsEmpty());
  }
  EXPECT_THAT(playpen({"xyzzy"}).err, Not(HasSubstr("did you mean")));
}

TEST(PlaypenHelp, ProgramWithoutDashes_Explained) {
  const ProcessResult result = playpen({"run", "cave", "./wander"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("-- ./wander"));
}

TEST(PlaypenManPage, DocumentsEachCommandAndOption) {
  const ProcessResult man = playpen({"help", "--man"});
  ASSERT_EQ(man.status, 0) << man.err;
  EXPECT_THAT(man.out, AllOf(HasSubstr(".TH PLAYPEN 1"), HasSubstr(".SH SYNOPSIS"),
                             HasSubstr(".SH EXIT STATUS"), HasSubstr(".SH ENVIRONMENT"),
                             HasSubstr("PLAYPEN_WORLD")));
  const std::regex option("--[a-z][a-z-]+");
  for (const std::string& command : kCommands) {
    EXPECT_THAT(man.out, HasSubstr(".SS \\fBplaypen " + command + "\\fR")) << command;
    const std::string help = playpen({"help", command}).out;
    for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it) {
      const std::string roff = std::regex_replace(it->str(), std::regex("-"), "\\-");
      EXPECT_THAT(man.out, HasSubstr(roff)) << command;
    }
  }
  EXPECT_THAT(man.out, Not(HasSubstr("probe")));  // a hidden option
}

/// bash's completions of the last of these words.
std::vector<std::string> completed(const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  folder.write("world.json", "{}");
  folder.write("notes.txt", "");
  const std::string script = folder.write("completion.bash", playpen({"completion", "bash"}).out);
  std::string command = "source " + script + "; COMP_WORDS=(" PLAYPEN_COMMAND;
  for (const std::string& word : words) command += " '" + word + "'";
  command += "); COMP_CWORD=" + std::to_string(words.size()) + "; _playpen " PLAYPEN_COMMAND " '" +
             words.back() + "' '" + (words.size() > 1 ? words[words.size() - 2] : "playpen") +
             "'; printf '%s\\n' \"${COMPREPLY[@]}\"";
  test_support::ProcessOptions options;
  options.folder = folder / ".";
  const ProcessResult result = run_process({"bash", "-c", command}, options);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, IsEmpty());
  std::vector<std::string> lines = lines_of(result.out);
  if (lines.size() == 1 && lines.front().empty()) lines.clear();  // printf prints one line
  return lines;
}

TEST(PlaypenCompletion, Bash_CompletesCommandsOptionsValuesAndNames) {
  EXPECT_THAT(completed({"ru"}), ElementsAre("run"));
  EXPECT_THAT(completed({"co"}), ElementsAre("completion"));
  EXPECT_THAT(completed({"--v"}), ElementsAre("--version"));
  EXPECT_THAT(completed({"run", "--dur"}), ElementsAre("--duration"));
  EXPECT_THAT(completed({"run", "cave", "--snap"}), ElementsAre("--snapshot-every"));
  EXPECT_THAT(completed({"run", "cave", "--view-mode", "f"}), ElementsAre("full-screen"));
  EXPECT_THAT(completed({"run", "cave", "--view-mode", "=", "m"}), ElementsAre("mini-map"));
  EXPECT_THAT(completed({"grade", "par_intro", "--realism", "i"}), ElementsAre("ideal"));
  EXPECT_THAT(completed({"run", "cave", "--duration", "1"}), IsEmpty());
  EXPECT_THAT(completed({"run", "off"}), ElementsAre("office"));
  EXPECT_THAT(completed({"run", "--duration", "5", "off"}), ElementsAre("office"));
  EXPECT_THAT(completed({"run", "wo"}), ElementsAre("world.json"));
  EXPECT_THAT(completed({"grade", "par_p"}), ElementsAre("par_planning"));
  EXPECT_THAT(completed({"grade", "par_intro", "cav"}), ElementsAre("cave"));
  EXPECT_THAT(completed({"check", "pioneer2"}), ElementsAre("pioneer2dx"));
  EXPECT_THAT(completed({"new", ""}), UnorderedElementsAre("intro", "planning", "exploration",
                                                           "traps", "exploration_changing", "chase",
                                                           "localization", "client", "test"));
  EXPECT_THAT(completed({"help", "gr"}), ElementsAre("grade"));
  EXPECT_THAT(completed({"doc", "devices/las"}), ElementsAre("devices/laser"));
  EXPECT_THAT(completed({"run", "cave", "--", "./n"}), ElementsAre("./notes.txt"));
  EXPECT_THAT(completed({"run", "cave", "--", "./x", "no"}), ElementsAre("notes.txt"));
}

TEST(PlaypenCompletion, ZshAndFish_CompleteCommandsAndOptions) {
  for (const char* shell : {"zsh", "fish"}) {
    const ProcessResult script = playpen({"completion", shell});
    ASSERT_EQ(script.status, 0) << shell;
    const std::regex option("--([a-z][a-z-]+)");
    for (const std::string& command : kCommands) {
      EXPECT_THAT(script.out, HasSubstr(command));
      const std::string help = playpen({"help", command}).out;
      std::istringstream lines(help.substr(help.find("Options:")));
      for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        if (!line.starts_with("  -") || !std::regex_search(line, found, option)) continue;
        const std::string name = found[1];
        EXPECT_THAT(script.out,
                    HasSubstr(shell == std::string("zsh") ? "--" + name : "-l " + name));
      }
    }
  }
  const ProcessResult other = playpen({"completion", "csh"});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("bash, zsh or fish"));
}

/// A pseudo-terminal that controls no process.
class PseudoTerminal {
 public:
  explicit PseudoTerminal(unsigned short columns) : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    grantpt(master_);
    unlockpt(master_);
    terminal_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
    winsize size{};
    size.ws_row = 25;
    size.ws_col = columns;
    ioctl(terminal_, TIOCSWINSZ, &size);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;
  ~PseudoTerminal() {
    close(terminal_);
    close(master_);
  }
  [[nodiscard]] int descriptor() const { return terminal_; }

 private:
  int master_;
  int terminal_ = -1;
};

TEST(PlaypenDoc, List_HasEachPageWithTitle) {
  const std::string list = playpen({"doc"}).out;
  EXPECT_THAT(list, HasSubstr("start_here  "));
  const std::regex line("devices/laser +\\S");
  EXPECT_TRUE(std::regex_search(list, line)) << list;
  std::set<std::string> pages;
  const std::filesystem::path root(PLAYPEN_SOURCE_DIR "/docs");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".md") continue;
    pages.insert(entry.path().lexically_relative(root).replace_extension().string());
  }
  const std::vector<std::string> names = lines_of(playpen({"doc", "--names"}).out);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), pages);
  EXPECT_EQ(names.size(), pages.size());
}

TEST(PlaypenDoc, Page_FoundByEachName) {
  const std::string laser = test_support::read_bytes(PLAYPEN_SOURCE_DIR "/docs/devices/laser.md");
  for (const char* name : {"devices/laser", "laser", "laser.md", "docs/devices/laser.md"}) {
    const ProcessResult result = playpen({"doc", name});
    EXPECT_EQ(result.status, 0) << name << ": " << result.err;
    EXPECT_EQ(result.out, laser) << name;
  }
  // A decision has the same name; pages outside of folders come first.
  EXPECT_EQ(playpen({"doc", "arena_controller"}).out,
            test_support::read_bytes(PLAYPEN_SOURCE_DIR "/docs/arena_controller.md"));
}

TEST(PlaypenDoc, UnknownPage_SuggestsNearest) {
  const ProcessResult result = playpen({"doc", "strat_here"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("no page 'strat_here'"), HasSubstr("did you mean 'start_here'?"),
                    HasSubstr("'playpen doc' lists")));
  for (const char* name : {"../README", "/etc/passwd", "docs/", ".md", "xyzzyxyzzy"}) {
    const ProcessResult other = playpen({"doc", name});
    EXPECT_EQ(other.status, 2) << name;
    EXPECT_THAT(other.err, HasSubstr(std::string("no page '") + name + '\'')) << name;
  }
  EXPECT_EQ(playpen({"doc", "laser", "--names"}).status, 2);
}

TEST(PlaypenDoc, Installation_ReadsItsOwnPages) {
  const TemporaryFolder prefix;
  const std::string command = prefix.write("bin/playpen", "");
  std::filesystem::copy_file(PLAYPEN_COMMAND, command,
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::permissions(command, std::filesystem::perms::owner_all);
  const ProcessResult missing = run_process({command, "doc"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("share/playpen/docs"), HasSubstr("install Playpen")));
  prefix.write("share/playpen/docs/index.md", "# All pages\n");
  prefix.write("share/playpen/docs/devices/laser.md", "# A laser\n");
  EXPECT_EQ(run_process({command, "doc"}).out,
            "index          All pages\ndevices/laser  A laser\n");
  EXPECT_EQ(run_process({command, "doc", "laser"}).out, "# A laser\n");
}

TEST(Terminal, Columns_AreThoseOfTerminalOr80) {
  EXPECT_EQ(playpen::terminal_columns(PseudoTerminal(132).descriptor()), 132U);
  EXPECT_EQ(playpen::terminal_columns(PseudoTerminal(0).descriptor()), 80U);
  const int file = open("/dev/null", O_WRONLY);
  EXPECT_EQ(playpen::terminal_columns(file), 80U);
  EXPECT_FALSE(playpen::shows_colour(file));
  close(file);
}

TEST(PlaypenDoc, Terminal_ShowsPageInPager) {
  const TemporaryFolder folder;
  const PseudoTerminal terminal(80);
  const std::string shell = std::string("'" PLAYPEN_COMMAND "' doc start_here >/dev/fd/") +
                            std::to_string(terminal.descriptor());
  test_support::ProcessOptions options;
  options.environment["PAGER"] = "cp -t " + (folder / ".");
  ASSERT_EQ(run_process({"sh", "-c", shell}, options).status, 0);
  EXPECT_EQ(test_support::read_bytes(folder / "start_here.md"),
            test_support::read_bytes(PLAYPEN_SOURCE_DIR "/docs/start_here.md"));
}

TEST(Terminal, Colour_ShownUnlessDisabled) {
  const PseudoTerminal terminal(80);
  setenv("TERM", "xterm", 1);
  unsetenv("NO_COLOR");
  EXPECT_TRUE(playpen::shows_colour(terminal.descriptor()));
  setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(playpen::shows_colour(terminal.descriptor()));
  setenv("NO_COLOR", "", 1);  // an empty value counts as not set
  EXPECT_TRUE(playpen::shows_colour(terminal.descriptor()));
  setenv("TERM", "dumb", 1);
  EXPECT_FALSE(playpen::shows_colour(terminal.descriptor()));
  unsetenv("NO_COLOR");
}

TEST(Wrapped, BreaksAtBlanksAndIndentsFollowingLines) {
  // 26 columns minus an indent of 3: 23 characters per line.
  EXPECT_EQ(playpen::wrapped("one two three four five six", 26, 3),
            "one two three four five\n   six");
  EXPECT_EQ(playpen::wrapped("", 80, 3), "");
  const std::string word(40, 'x');
  EXPECT_EQ(playpen::wrapped("a " + word + " b", 30, 2), "a\n  " + word + "\n  b");
}

}  // namespace
