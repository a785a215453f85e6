// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The allowed includes: checks the arrows of docs/architecture.md on the text of the sources.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A source file: its path from the root of the repository, and its text.
struct Source {
  std::string path;
  std::string text;
};

/// The text with blanks instead of comments and string literals. Line breaks and the names of
/// included files are kept.
std::string without_comments(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  std::string line;
  bool in_block = false;
  static const std::regex kInclude(R"(^\s*#\s*include\b)");
  while (std::getline(lines, line)) {
    const bool is_include =
        !in_block && line.find('#') != line.npos && std::regex_search(line, kInclude);
    bool in_string = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string_view pair = std::string_view(line).substr(i, 2);
      if (in_block) {
        if (pair == "*/") {
          in_block = false;
          ++i;
        }
      } else if (in_string) {
        if (line[i] == '\\') {
          ++i;
        } else if (line[i] == '"') {
          in_string = false;
          out += '"';
        }
      } else if (pair == "//") {
        break;
      } else if (pair == "/*") {
        in_block = true;
        ++i;
      } else {
        in_string = line[i] == '"' && !is_include;
        out += line[i];
      }
    }
    out += '\n';
  }
  return out;
}

/// The includes of a text, in order, as written between the quotes or angle brackets.
std::vector<std::string> includes_of(const std::string& text) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  std::istringstream lines(without_comments(text));
  std::string line;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (line.find('#') == line.npos) continue;  // saves the regular expression
    if (std::regex_search(line, match, kInclude)) found.push_back(match[1]);
  }
  return found;
}

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](std::string_view prefix) { return text.starts_with(prefix); });
}

/// The folder of libsim that a source belongs to or that an include names ("sim/core/pose.h" and
/// "core/x.h" both give "core"); empty if it is not libsim's.
std::string sim_folder(std::string_view path) {
  for (const std::string_view prefix : {"libsim/include/sim/", "libsim/src/", "sim/"}) {
    if (path.starts_with(prefix)) {
      path.remove_prefix(prefix.size());
      break;
    }
  }
  const auto slash = path.find('/');
  return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash));
}

/// Folder of libsim -> the other folders that it may include.
const std::map<std::string, std::set<std::string>>& sim_arrows() {
  static const std::map<std::string, std::set<std::string>> kArrows = {
      {"core", {}},
      {"world", {"core"}},
      {"canvas", {"core", "world"}},
      {"io", {"core", "world", "canvas"}},
      {"scan", {"core"}},
      {"navigation", {"core", "world"}},
      {"physics", {"core", "world", "scan"}},
      {"devices", {"core", "world", "io", "canvas", "scan", "navigation", "physics"}},
      {"simulation", {"core", "world", "io", "canvas", "scan", "navigation", "physics", "devices"}},
      {"render", {"core", "world", "canvas", "navigation", "simulation"}},
  };
  return kArrows;
}

/// The folder of libplayerlike or of apps that a source belongs to or that an include names.
/// "playerlike/host/host.h", "host/core.h" and "libplayerlike/src/host/core.h" all give "host";
/// "apps/playpen/grade/x.cpp" gives "playpen/grade". The places of headers in old versions of
/// Player are one folder, "player-". Empty if it belongs to neither.
std::string playerlike_folder(std::string_view path) {
  const bool in_apps = path.starts_with("apps/");
  for (const std::string_view prefix :
       {"libplayerlike/include/playerlike/", "libplayerlike/include/", "libplayerlike/src/",
        "playerlike/", "apps/"}) {
    if (path.starts_with(prefix)) {
      path.remove_prefix(prefix.size());
      break;
    }
  }
  if (path.starts_with("player-")) return "player-";
  for (const std::string_view part : {"playpen/grade/", "playpen/view/"}) {
    if (in_apps && path.starts_with(part)) return std::string(part.substr(0, part.size() - 1));
  }
  if (path.starts_with("grade/")) return "playpen/grade";
  const auto slash = path.find('/');
  return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash));
}

/// Folder of libplayerlike or apps -> the other folders of libplayerlike and apps that it may
/// include. They are the layers of docs/architecture.md, each above those that it names.
const std::map<std::string, std::set<std::string>>& playerlike_arrows() {
  static const std::map<std::string, std::set<std::string>> kArrows = {
      {"messages", {"libplayerinterface"}},
      {"view", {}},
      {"process", {"messages"}},
      {"protocol", {"messages", "libplayerinterface"}},
      {"session", {"messages", "libplayerinterface"}},
      {"virtual_time", {"process"}},
      {"host", {"messages", "process", "protocol", "session", "view", "virtual_time"}},
      {"remote", {"messages", "process", "protocol", "session"}},
      {"connect", {"messages", "process", "session", "virtual_time", "host", "remote"}},
      {"server",
       {"messages", "process", "protocol", "session", "virtual_time", "host", "wire", "proxies",
        "libplayerinterface"}},
      // Headers that clients include.
      {"libplayerinterface", {}},
      {"libplayercommon", {}},
      {"libplayererror", {"libplayercommon"}},
      {"libplayercore", {"libplayercommon", "libplayerinterface"}},
      {"libplayerc", {"libplayercommon", "libplayerinterface"}},
      {"libplayerc++", {"libplayercommon", "libplayerinterface", "libplayerc"}},
      {"libCCMorse", {"libplayerc++"}},
      {"libPlayer", {"libCCMorse", "libplayerc++"}},
      {"player-", {"libplayerc", "libplayerc++", "libplayercommon", "libplayerinterface"}},
      {"imr-h", {}},
      {"replace", {}},
      // Their implementation.
      {"devices",
       {"messages", "process", "session", "virtual_time", "connect", "libCCMorse", "libplayerc++"}},
      {"proxies",
       {"messages", "session", "virtual_time", "connect", "libCCMorse", "libplayerc++", "devices"}},
      {"drivers",
       {"messages", "session", "virtual_time", "libCCMorse", "libplayerc++", "devices", "proxies"}},
      {"playerc",
       {"virtual_time", "libplayerinterface", "libplayerc", "libplayerc++", "devices", "proxies"}},
      // Devices in the words of Player's protocol.
      {"wire",
       {"messages", "protocol", "session", "libplayerinterface", "libplayerc++", "proxies"}},
      {"imr", {"virtual_time", "libplayerc++", "imr-h"}},
      // Programs.
      {"client", {"libplayerc++"}},
      {"par_common", {}},
      {"par_intro", {"imr-h", "libCCMorse"}},
      {"par_planning", {"imr-h", "libCCMorse", "par_common"}},
      {"par_exploration", {"imr-h", "libCCMorse", "par_common"}},
      {"par_traps", {"imr-h", "libCCMorse", "par_common"}},
      {"par_exploration_changing", {"imr-h", "libCCMorse", "par_exploration"}},
      {"par_chase", {"imr-h", "libCCMorse", "par_common"}},
      {"par_localization", {"imr-h", "libCCMorse", "par_common"}},
      {"playpen", {"messages", "process", "host", "connect", "server", "playpen/grade"}},
      {"playpen/grade", {"messages", "host"}},
      {"playpen/view", {"view"}},
  };
  return kArrows;
}

using Arrows = std::map<std::string, std::set<std::string>>;

/// A cycle among the arrows, as "a -> b -> a"; empty if there is none.
std::string circle_in(const Arrows& arrows) {
  std::vector<std::string> way;
  std::set<std::string> done;
  const auto follow = [&](const auto& self, const std::string& folder) -> std::string {
    const auto seen = std::find(way.begin(), way.end(), folder);
    if (seen != way.end()) {
      std::string circle;
      for (auto it = seen; it != way.end(); ++it) circle += *it + " -> ";
      return circle + folder;
    }
    if (done.contains(folder)) return "";
    way.push_back(folder);
    if (const auto it = arrows.find(folder); it != arrows.end()) {
      for (const std::string& target : it->second) {
        if (std::string circle = self(self, target); !circle.empty()) return circle;
      }
    }
    way.pop_back();
    done.insert(folder);
    return "";
  };
  for (const auto& [folder, targets] : arrows) {
    if (std::string circle = follow(follow, folder); !circle.empty()) return circle;
  }
  return "";
}

/// The violations of one source of libsim, libplayerlike or apps; empty if there are none.
std::vector<std::string> violations(const Source& source) {
  std::vector<std::string> found;
  const std::string_view path = source.path;
  const bool in_sim = path.starts_with("libsim/");
  const bool in_playerlike = path.starts_with("libplayerlike/");
  const bool in_apps = path.starts_with("apps/");
  // playerconfig.h, replace.h and robot_types.h are beside the folders, as in Player.
  const bool is_loose = path.starts_with("libplayerlike/include/") &&
                        path.find('/', sizeof "libplayerlike/include/") == path.npos;
  const bool is_public =
      path.starts_with("libsim/include/") || path.starts_with("libplayerlike/include/");
  const std::string folder = in_sim ? sim_folder(path) : playerlike_folder(path);
  const auto complain = [&](const std::string& what) {
    found.push_back(source.path + ": " + what);
  };

  // A failed assertion prints to standard error before it aborts, because no caller can handle it.
  const bool has_last_words = path == "libsim/src/core/assert.cpp";

  if (in_sim && !sim_arrows().contains(folder)) complain("lies in no known folder of libsim");
  if ((in_playerlike || in_apps) && !is_loose && !playerlike_arrows().contains(folder)) {
    complain("lies in no known folder of libplayerlike or apps");
  }

  for (const std::string& include : includes_of(source.text)) {
    const auto refuse = [&](const std::string& why) {
      complain("includes " + include + ": " + why);
    };
    if (include.starts_with("../")) refuse("name it from the include folder");

    const bool is_box2d = starts_with_any(include, {"box2d/", "Box2D/"});
    const bool is_opencv = starts_with_any(include, {"opencv2/", "opencv4/", "opencv/"});
    const bool is_json = include.starts_with("nlohmann/");
    if (is_box2d && !path.starts_with("libsim/src/physics/")) {
      refuse("Box2D belongs in libsim/src/physics");
    }
    const bool in_window = path.starts_with("apps/playpen/view/");
    if (is_opencv && !in_window &&
        !(path.starts_with("libsim/src/render/modules/") && path.ends_with("_module.cpp"))) {
      refuse("OpenCV belongs in the modules of libsim/src/render/modules");
    }
    if (include == "png.h" && path != "libsim/src/canvas/png_codec.cpp") {
      refuse("libpng belongs in libsim/src/canvas/png_codec.cpp");
    }
    if (include == "jpeglib.h" && path != "libsim/src/canvas/jpeg_codec.cpp") {
      refuse("libjpeg belongs in libsim/src/canvas/jpeg_codec.cpp");
    }
    if (include == "zlib.h" && !starts_with_any(path, {"libplayerlike/src/wire/",
                                                       "libplayerlike/src/remote/", "tests/"})) {
      refuse("zlib belongs in libplayerlike/src/wire and libplayerlike/src/remote");
    }
    if ((include == "opencv2/highgui.hpp" || include.starts_with("X11/")) && !in_window) {
      refuse("windows belong in apps/playpen/view");
    }
    if (is_json && in_sim && !path.starts_with("libsim/src/io/")) {
      refuse("JSON belongs in libsim/src/io");
    }
    const bool is_yaml = include.starts_with("yaml-cpp/");
    if (is_yaml && !path.starts_with("libsim/src/io/")) refuse("YAML belongs in libsim/src/io");
    if (is_public &&
        (is_json || is_yaml || starts_with_any(include, {"spdlog/", "fmt/", "CLI/"}))) {
      refuse("public headers show no third-party types but Eigen's");
    }

    if (in_sim) {
      if (starts_with_any(include,
                          {"playerlike/", "libplayerc", "libplayerinterface/", "player-",
                           "libCCMorse/", "libPlayer/", "imr-h/", "messages/", "protocol/", "host/",
                           "session/", "proxies/", "playerc/", "drivers/", "server/"})) {
        refuse("libsim knows no client");
      }
      static const std::set<std::string> kForbidden = {
          "thread",     "mutex",      "shared_mutex", "condition_variable",
          "future",     "stop_token", "barrier",      "latch",
          "semaphore",  "chrono",     "ctime",        "time.h",
          "sys/time.h", "pthread.h",  "asio.hpp",     "iostream"};
      if ((kForbidden.contains(include) && !(has_last_words && include == "iostream")) ||
          starts_with_any(include, {"asio/", "boost/asio", "sys/socket", "netinet/", "arpa/"})) {
        refuse("libsim has no threads, machine clocks, sockets or terminal");
      }
      const std::string target = sim_folder(include);
      if (sim_arrows().contains(target) && target != folder && sim_arrows().contains(folder) &&
          !sim_arrows().at(folder).contains(target)) {
        refuse("the arrow from " + folder + " to " + target + " does not exist");
      }
      if (folder == "render" && target == "simulation" &&
          include != "sim/simulation/scene_snapshot.h") {
        refuse("pictures are drawn from a snapshot only");
      }
    }
    if (in_playerlike) {
      if (include.starts_with("sim/") &&
          starts_with_any(path,
                          {"libplayerlike/include/libplayer", "libplayerlike/include/libCCMorse/",
                           "libplayerlike/include/libPlayer/", "libplayerlike/include/imr-h/"})) {
        refuse("clients are C++14, libsim's headers are C++20");
      }
      if (folder == "host" && include.starts_with("protocol/") &&
          path != "libplayerlike/src/host/run_log.cpp") {
        refuse("of a host only the log of a run is written in the protocol's words");
      }
      if ((include == "asio.hpp" || include.starts_with("asio/")) &&
          !starts_with_any(path, {"libplayerlike/src/server/", "libplayerlike/src/remote/"})) {
        refuse("sockets belong in libplayerlike/src/server and libplayerlike/src/remote");
      }
    }
    if (in_playerlike || in_apps) {
      const std::string target = playerlike_folder(include);
      const auto& arrows = playerlike_arrows();
      if (arrows.contains(target) && target != folder && arrows.contains(folder) &&
          !arrows.at(folder).contains(target)) {
        refuse("the arrow from " + folder + " to " + target + " does not exist");
      }
    }
  }

  if (in_sim) {
    static const std::regex kMachine(
        R"(\b(steady_clock|system_clock|high_resolution_clock|clock_gettime|gettimeofday|random_device|default_random_engine|srand|std::rand|std::exit|quick_exit|std::cout|std::cerr|f?printf)\b)");
    const std::string code = without_comments(source.text);
    for (std::sregex_iterator it(code.begin(), code.end(), kMachine), end; it != end; ++it) {
      if (has_last_words && it->str(1) == "std::cerr") continue;
      complain("uses " + it->str(1) + ", which a deterministic library without a terminal cannot");
    }
  }
  return found;
}

/// All sources in a folder of the repository and its subfolders.
std::vector<Source> sources_in(const std::string& folder) {
  std::vector<Source> sources;
  const fs::path root(PLAYPEN_SOURCE_DIR);
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() ||
        (extension != ".h" && extension != ".cpp" && extension != ".cc" && extension != ".c")) {
      continue;
    }
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    sources.push_back({fs::relative(entry.path(), root).generic_string(), text.str()});
  }
  return sources;
}

TEST(Layering, SourcesOfTheSimulatorFollowTheArrows) {
  const std::vector<Source> sources = sources_in("libsim");
  ASSERT_GT(sources.size(), 20U) << "nothing to check below " PLAYPEN_SOURCE_DIR;
  for (const Source& source : sources) EXPECT_THAT(violations(source), IsEmpty());
}

TEST(Layering, SourcesOfTheClientLibraryFollowTheArrows) {
  const std::vector<Source> sources = sources_in("libplayerlike");
  ASSERT_GT(sources.size(), 10U) << "nothing to check below " PLAYPEN_SOURCE_DIR;
  for (const Source& source : sources) EXPECT_THAT(violations(source), IsEmpty());
}

TEST(Layering, TheFloorsHaveNoCircle) {
  EXPECT_EQ(circle_in(sim_arrows()), "");
  EXPECT_EQ(circle_in(playerlike_arrows()), "");
  for (const auto& [folder, targets] : playerlike_arrows()) {
    for (const std::string& target : targets) {
      EXPECT_TRUE(playerlike_arrows().contains(target)) << folder << " names " << target;
    }
  }
}

// This holds independently of the map of arrows.
TEST(Layering, IncludesMakeNoCircle) {
  Arrows sim;
  for (const Source& source : sources_in("libsim")) {
    for (const std::string& include : includes_of(source.text)) {
      const std::string folder = sim_folder(source.path);
      const std::string target = sim_folder(include);
      if (sim_arrows().contains(target) && target != folder) sim[folder].insert(target);
    }
  }
  EXPECT_EQ(circle_in(sim), "");
  Arrows others;
  for (const char* part : {"libplayerlike", "apps"}) {
    for (const Source& source : sources_in(part)) {
      for (const std::string& include : includes_of(source.text)) {
        const std::string folder = playerlike_folder(source.path);
        const std::string target = playerlike_folder(include);
        if (playerlike_arrows().contains(target) && target != folder) others[folder].insert(target);
      }
    }
  }
  EXPECT_EQ(circle_in(others), "");
  EXPECT_GT(others.size(), 15U);
}

// Except for waiting, taking and sending, the seam offers requests (messages/requests.h).
TEST(Layering, TheSeamIsNarrow) {
  for (const Source& source : sources_in("libplayerlike/include/playerlike/session")) {
    if (!source.path.ends_with("/session.h")) continue;
    const std::string code = without_comments(source.text);
    static const std::regex kVirtual(R"(\bvirtual\b)");
    const auto begin = code.begin() + static_cast<std::ptrdiff_t>(code.find("class Session {"));
    EXPECT_LE(std::distance(std::sregex_iterator(begin, code.end(), kVirtual), {}), 14);
    return;
  }
  FAIL() << "there is no session.h";
}

TEST(Layering, AppsUsePublicHeadersOnly) {
  const std::vector<Source> sources = sources_in("apps");
  // Programs of the course are .cc files.
  EXPECT_TRUE(std::any_of(sources.begin(), sources.end(), [](const Source& source) {
    return source.path.ends_with("common/explorer.cc");
  }));
  for (const Source& source : sources) {
    EXPECT_THAT(violations(source), IsEmpty());
    for (const std::string& include : includes_of(source.text)) {
      // Sources of the libraries are included as "folder/file.h"; public headers are not.
      EXPECT_FALSE(sim_arrows().contains(sim_folder(include)) && !include.starts_with("sim/"))
          << source.path << " includes " << include;
      EXPECT_THAT(include, testing::Not(HasSubstr("../"))) << source.path;
      // Only the window's own process loads a windowing toolkit.
      EXPECT_TRUE(source.path.starts_with("apps/playpen/view/") ||
                  !starts_with_any(include, {"opencv2/", "X11/"}))
          << source.path << " includes " << include;
    }
  }
}

/// The parts of a text that write or read numbers in the locale's format.
std::vector<std::string> locale_dependent(const std::string& text) {
  static const std::regex kCall(R"(\b(std::)?(sto[df]|stold|strto[df]|strtold|atof|sscanf)\s*\()");
  static const std::regex kFormat(R"(printf\s*\([^;]*%[-+ #0-9.*]*[aefgAEFG])");
  std::vector<std::string> found;
  for (const std::regex* pattern : {&kCall, &kFormat}) {
    for (std::sregex_iterator it(text.begin(), text.end(), *pattern), end; it != end; ++it) {
      found.push_back(it->str());
    }
  }
  return found;
}

// A student's program may set a locale with a decimal comma.
TEST(Numbers, AreNotWrittenOrReadAsTheLocaleHasIt) {
  for (const char* folder : {"libsim/src", "libplayerlike/src", "apps/playpen"}) {
    for (const Source& source : sources_in(folder)) {
      // Player's functions that print for users follow the locale, as Player's own do.
      if (source.path.starts_with("libplayerlike/src/playerc/")) continue;
      EXPECT_THAT(locale_dependent(source.text), IsEmpty()) << source.path;
    }
  }
  EXPECT_THAT(locale_dependent("x = std::stod(text); y = strtod(t, &e);"), testing::SizeIs(2));
  EXPECT_THAT(locale_dependent("std::snprintf(a, n, \"%s: %6.2f\", b, c);"), testing::SizeIs(1));
  EXPECT_THAT(locale_dependent("std::snprintf(a, n, \"%06d of %s\", b, c);"), IsEmpty());
}

// Tests of the rules themselves: a rule that accepts everything must fail here.
TEST(LayeringRules, FindIncludesButNotThoseInComments) {
  EXPECT_THAT(includes_of("#include <a/b.h>\n// #include <c>\n/* #include <d>\n#include <e>\n*/\n"
                          "  # include \"f.h\"  // why\n"),
              ElementsAre("a/b.h", "f.h"));
}

TEST(LayeringRules, RefuseArrowsThatPointUp) {
  EXPECT_THAT(violations({"libsim/include/sim/core/x.h", "#include \"sim/world/description.h\"\n"}),
              ElementsAre(HasSubstr("from core to world")));
  EXPECT_THAT(violations({"libsim/src/scan/x.cpp", "#include \"physics/physics_world.h\"\n"}),
              ElementsAre(HasSubstr("from scan to physics")));
  EXPECT_THAT(violations({"libsim/src/simulation/x.cpp", "#include \"sim/render/render.h\"\n"}),
              ElementsAre(HasSubstr("from simulation to render")));
  EXPECT_THAT(violations({"libsim/src/render/x.cpp", "#include \"sim/simulation/simulation.h\"\n"}),
              ElementsAre(HasSubstr("snapshot")));
  EXPECT_THAT(violations({"libsim/src/physics/x.cpp", "#include \"sim/scan/scan_kernel.h\"\n"}),
              IsEmpty());
  EXPECT_THAT(violations({"libsim/src/new/x.cpp", ""}), ElementsAre(HasSubstr("no known folder")));
}

TEST(LayeringRules, RefuseClientsThreadsAndClocksInTheSimulator) {
  EXPECT_THAT(
      violations({"libsim/src/core/x.cpp",
                  "#include <libplayerc++/playerc++.h>\n#include <mutex>\n"
                  "auto t = std::chrono::steady_clock::now();\n"}),
      ElementsAre(HasSubstr("no client"), HasSubstr("no threads"), HasSubstr("steady_clock")));
  EXPECT_THAT(violations({"libsim/src/core/x.cpp", "// std::cout\nauto s = \"printf\";\n"}),
              IsEmpty());
}

TEST(LayeringRules, FindCircles) {
  EXPECT_EQ(circle_in({{"a", {"b"}}, {"b", {"c"}}, {"d", {"a", "c"}}}), "");
  EXPECT_EQ(circle_in({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), "b -> c -> b");
  EXPECT_EQ(circle_in({{"a", {"a"}}}), "a -> a");
}

TEST(LayeringRules, LetDriversUseProxiesAndNotTheOtherWayRound) {
  EXPECT_THAT(violations({"libplayerlike/src/drivers/x.cpp",
                          "#include \"drivers/x.h\"\n#include \"proxies/link.h\"\n"}),
              IsEmpty());
  EXPECT_THAT(violations({"libplayerlike/src/proxies/x.cpp", "#include \"playerc/device.h\"\n"}),
              ElementsAre(HasSubstr("from proxies to playerc")));
  EXPECT_THAT(violations({"libplayerlike/src/playerc/x.cpp", "#include \"playerc/device.h\"\n"}),
              IsEmpty());
  EXPECT_THAT(
      violations({"libplayerlike/src/proxies/x.cpp", "#include \"drivers/goal_thread.h\"\n"}),
      ElementsAre(HasSubstr("from proxies to drivers")));
}

TEST(LayeringRules, KeepTheProtocolBelowServersAndSockets) {
  EXPECT_THAT(
      violations({"libplayerlike/src/protocol/x.cpp",
                  "#include <nlohmann/json.hpp>\n#include <vector>\n#include \"protocol/codec.h\"\n"
                  "#include \"playerlike/messages/messages.h\"\n#include \"sim/core/pose.h\"\n"}),
      IsEmpty());
  EXPECT_THAT(
      violations({"libplayerlike/src/protocol/x.cpp",
                  "#include \"playerlike/host/host.h\"\n#include \"server/peer.h\"\n"}),
      ElementsAre(HasSubstr("from protocol to host"), HasSubstr("from protocol to server")));
  EXPECT_THAT(violations({"libplayerlike/src/host/x.cpp",
                          "#include \"protocol/codec.h\"\n#include \"playerlike/server/server.h\"\n"
                          "#include <asio/ip/tcp.hpp>\n"}),
              ElementsAre(HasSubstr("log of a run"), HasSubstr("from host to server"),
                          HasSubstr("sockets belong")));
  EXPECT_THAT(violations({"libplayerlike/src/server/x.cpp",
                          "#include <asio.hpp>\n#include \"protocol/codec.h\"\n"
                          "#include \"playerlike/host/host.h\"\n#include \"server/peer.h\"\n"}),
              IsEmpty());
  EXPECT_THAT(violations({"libplayerlike/src/remote/x.cpp",
                          "#include <asio.hpp>\n#include \"protocol/codec.h\"\n"}),
              IsEmpty());
  EXPECT_THAT(violations({"libplayerlike/include/playerlike/server/x.h", "#include <asio.hpp>\n"}),
              ElementsAre(HasSubstr("sockets belong")));
}

TEST(LayeringRules, KeepTheFloorsOfTheClientLibrary) {
  const auto refused = [](const std::string& from, const std::string& include) {
    return violations({"libplayerlike/src/" + from + "/x.cpp", "#include \"" + include + "\"\n"});
  };
  EXPECT_THAT(refused("session", "host/core.h"), ElementsAre(HasSubstr("from session to host")));
  EXPECT_THAT(refused("virtual_time", "playerlike/host/host.h"),
              ElementsAre(HasSubstr("from virtual_time to host")));
  EXPECT_THAT(refused("host", "remote/socket_session.h"),
              ElementsAre(HasSubstr("from host to remote")));
  EXPECT_THAT(refused("remote", "host/core.h"), ElementsAre(HasSubstr("from remote to host")));
  EXPECT_THAT(refused("connect", "remote/socket_session.h"), IsEmpty());
  EXPECT_THAT(refused("proxies", "playerlike/host/host.h"),
              ElementsAre(HasSubstr("from proxies to host")));
  EXPECT_THAT(refused("new", "host/core.h"), ElementsAre(HasSubstr("no known folder")));
  EXPECT_THAT(violations({"apps/par_common/src/x.cpp", "#include \"libCCMorse/CCMorse.h\"\n"}),
              ElementsAre(HasSubstr("from par_common to libCCMorse")));
  EXPECT_THAT(violations({"apps/par_intro/template/x.cc", "#include \"libCCMorse/CCMorse.h\"\n"}),
              IsEmpty());
}

TEST(LayeringRules, KeepThirdPartyLibrariesInTheirPlaces) {
  EXPECT_THAT(
      violations({"libsim/src/devices/x.cpp",
                  "#include <box2d/box2d.h>\n#include <opencv2/core.hpp>\n"
                  "#include <nlohmann/json.hpp>\n#include <yaml-cpp/yaml.h>\n"}),
      ElementsAre(HasSubstr("Box2D"), HasSubstr("OpenCV"), HasSubstr("JSON"), HasSubstr("YAML")));
  EXPECT_THAT(violations({"libsim/src/physics/x.cpp", "#include <box2d/box2d.h>\n"}), IsEmpty());
  EXPECT_THAT(
      violations({"libsim/src/render/modules/x_module.cpp", "#include <opencv2/highgui.hpp>\n"}),
      ElementsAre(HasSubstr("apps/playpen/view")));
  EXPECT_THAT(violations({"libsim/src/render/x.cpp", "#include <opencv2/core.hpp>\n"}),
              ElementsAre(HasSubstr("OpenCV belongs in the modules")));
  EXPECT_THAT(
      violations({"libsim/src/render/modules/x_module.cpp", "#include <opencv2/core.hpp>\n"}),
      IsEmpty());
  EXPECT_THAT(violations({"libsim/src/render/png.cpp", "#include <png.h>\n"}),
              ElementsAre(HasSubstr("png_codec.cpp")));
  EXPECT_THAT(violations({"libsim/src/io/x.cpp", "#include <jpeglib.h>\n"}),
              ElementsAre(HasSubstr("jpeg_codec.cpp")));
  EXPECT_THAT(
      violations({"libplayerlike/include/playerlike/host/x.h", "#include <nlohmann/json.hpp>\n"}),
      ElementsAre(HasSubstr("public headers")));
  EXPECT_THAT(violations({"libplayerlike/src/server/x.cpp", "#include <nlohmann/json.hpp>\n"}),
              IsEmpty());
  EXPECT_THAT(violations({"libplayerlike/include/libCCMorse/x.h", "#include <sim/core/pose.h>\n"}),
              ElementsAre(HasSubstr("C++14")));
}

}  // namespace
