// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "imr-h/imr_config.h"

namespace course {

// Types of a program: one has both stream operators, the other can only be read.
struct Point {
  double x = 0.0;
  double y = 0.0;
};
std::istream& operator>>(std::istream& in, Point& point) {
  char comma = '\0';
  if (in >> point.x >> comma >> point.y && comma != ',') {
    in.setstate(std::ios::failbit);
  }
  return in;
}
std::ostream& operator<<(std::ostream& out, const Point& point) {
  return out << point.x << "," << point.y;
}

struct ReadOnly {
  int value = 0;
};
std::istream& operator>>(std::istream& in, ReadOnly& read_only) { return in >> read_only.value; }

}  // namespace course

namespace {

using imr::CConfig;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// what() of the imr::exception that the function throws; a failure if it throws none.
template <typename Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const imr::exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "no imr::exception";
  return {};
}

bool parse(CConfig& config, std::vector<std::string> arguments,
           CConfig::UnknownArguments unknown = CConfig::UnknownArguments::kError,
           CConfig::MissingOptions missing = CConfig::MissingOptions::kError) {
  std::vector<char*> argv;
  std::string program = "/usr/bin/robot";
  argv.push_back(&program[0]);
  for (std::string& argument : arguments) {
    argv.push_back(&argument[0]);
  }
  argv.push_back(nullptr);
  return config.parse_command_line(static_cast<int>(argv.size()) - 1, argv.data(), unknown,
                                   missing);
}

// A file that the destructor removes.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_(testing::TempDir() + "imr_config_" + std::to_string(getpid()) + "_" +
              testing::UnitTest::GetInstance()->current_test_info()->name() + ".cfg") {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// The options of a typical course program.
class Config : public testing::Test {
 protected:
  Config() {
    config_.add<std::string>("host", "server hostname", "localhost");
    config_.add<int>("port", "server port", 4000);
    config_.add<bool>("coords", "set initial coordinates", false);
    config_.add<double>("x", "initial x position", 0.0);
  }

  // The error for a file with this content, without the path and colon at its front.
  std::string file_error(const std::string& content) {
    const TemporaryFile file(content);
    const std::string message = message_of([&] { config_.load_file(file.path()); });
    EXPECT_THAT(message, StartsWith(file.path() + ":"));
    return message.substr(std::min(message.size(), file.path().size() + 1));
  }

  CConfig config_;
};

TEST_F(Config, GivesDefaults) {
  EXPECT_EQ(config_.get<std::string>("host"), "localhost");
  EXPECT_EQ(config_.get<int>("port"), 4000);
  EXPECT_FALSE(config_.get<bool>("coords"));
  EXPECT_EQ(config_.get<double>("x"), 0.0);
}

TEST_F(Config, AddTwice_Refused) {
  EXPECT_EQ(message_of([&] { config_.add<int>("port", "again", 1); }),
            "option 'port' is added twice");
  EXPECT_THROW(config_.add<double>("port", "again"), imr::exception);
  EXPECT_EQ(config_.get<int>("port"), 4000);
}

TEST_F(Config, Add_RefusesInvalidNames) {
  for (const char* name : {"", "-x", "--x", "a b", "a=b", "#a", "help", "h", "a\n", ".a", "_"}) {
    EXPECT_THROW(config_.add<int>(name, "", 0), imr::exception) << name;
    EXPECT_FALSE(config_.has(name)) << name;
  }
  EXPECT_NO_THROW(config_.add<int>("laser-index_2.b", "", 0));
  EXPECT_TRUE(config_.has("laser-index_2.b"));
}

TEST_F(Config, GetOfOtherType_Refused) {
  EXPECT_EQ(message_of([&] { config_.get<double>("port"); }),
            "option 'port' is of type int, but is read as double");
  EXPECT_THROW(config_.get<unsigned>("port"), imr::exception);
  EXPECT_THROW(config_.get<float>("x"), imr::exception);
  EXPECT_THROW(config_.get<std::string>("port"), imr::exception);
}

TEST_F(Config, GetOfUnknownName_SuggestsNearest) {
  EXPECT_EQ(message_of([&] { config_.get<int>("Prt"); }),
            "unknown option 'Prt'; did you mean 'port'?");
  EXPECT_EQ(message_of([&] { config_.get<int>("velocity"); }), "unknown option 'velocity'");
}

TEST_F(Config, RequiredOption_EmptyUntilSet) {
  config_.add<double>("speed", "forward speed");
  EXPECT_EQ(message_of([&] { config_.get<double>("speed"); }), "missing required option '--speed'");
  EXPECT_THROW(config_.check_required(), imr::exception);
  config_.set("speed", 0.5);
  EXPECT_EQ(config_.get<double>("speed"), 0.5);
  EXPECT_NO_THROW(config_.check_required());
}

TEST_F(Config, Set_AcceptsTextAndTypedValues) {
  config_.set("port", "6665");
  EXPECT_EQ(config_.get<int>("port"), 6665);
  config_.set("port", 6666);
  EXPECT_EQ(config_.get<int>("port"), 6666);
  config_.set("port", std::string("-1"));
  EXPECT_EQ(config_.get<int>("port"), -1);
  config_.set<double>("x", 2);
  EXPECT_EQ(config_.get<double>("x"), 2.0);
  config_.set<std::string>("host", "here");
  EXPECT_EQ(config_.get<std::string>("host"), "here");
  config_.set("coords", true);
  EXPECT_TRUE(config_.get<bool>("coords"));
}

TEST_F(Config, Set_RefusesWrongTypesNamesAndTexts) {
  EXPECT_EQ(message_of([&] { config_.set("x", 2); }),
            "option 'x' is of type double, but is set to a value of type int");
  EXPECT_EQ(message_of([&] { config_.set("port", "12abc"); }),
            "option 'port': '12abc' is not a whole number");
  EXPECT_THROW(config_.set("ports", "1"), imr::exception);
  EXPECT_THROW(config_.set("ports", 1), imr::exception);
  const char* none = nullptr;
  EXPECT_THROW(config_.set("host", none), imr::exception);
  EXPECT_EQ(config_.get<int>("port"), 4000);
  EXPECT_EQ(config_.get<std::string>("host"), "localhost");
}

TEST(ConfigTypes, ParseTheirTexts) {
  CConfig config;
  config.add<bool>("bool", "", false);
  config.add<short>("short", "", short{0});
  config.add<int>("int", "", 0);
  config.add<unsigned>("unsigned", "", 0U);
  config.add<long>("long", "", 0L);
  config.add<long long>("long-long", "", 0LL);
  config.add<unsigned long>("unsigned-long", "", 0UL);
  config.add<float>("float", "", 0.0F);
  config.add<double>("double", "", 0.0);
  config.add<std::string>("string", "");
  config.add<char>("char", "", 'a');
  config.add<course::Point>("point", "");
  config.set("bool", "Yes");
  config.set("short", "-32768");
  config.set("int", "+2147483647");
  config.set("unsigned", "4294967295");
  config.set("long", "-12");
  config.set("long-long", "-9223372036854775808");
  config.set("unsigned-long", "12");
  config.set("float", "0.25");
  config.set("double", "-1.5e-3");
  config.set("string", " a = # ");
  config.set("char", "z");
  config.set("point", "1.5,-2");
  EXPECT_TRUE(config.get<bool>("bool"));
  EXPECT_EQ(config.get<short>("short"), -32768);
  EXPECT_EQ(config.get<int>("int"), 2147483647);
  EXPECT_EQ(config.get<unsigned>("unsigned"), 4294967295U);
  EXPECT_EQ(config.get<long>("long"), -12L);
  EXPECT_EQ(config.get<long long>("long-long"), std::numeric_limits<long long>::min());
  EXPECT_EQ(config.get<unsigned long>("unsigned-long"), 12UL);
  EXPECT_EQ(config.get<float>("float"), 0.25F);
  EXPECT_EQ(config.get<double>("double"), -1.5e-3);
  EXPECT_EQ(config.get<std::string>("string"), " a = # ");
  EXPECT_EQ(config.get<char>("char"), 'z');
  EXPECT_EQ(config.get<course::Point>("point").x, 1.5);
  EXPECT_EQ(config.get<course::Point>("point").y, -2.0);
  config.set("double", "inf");
  EXPECT_TRUE(std::isinf(config.get<double>("double")));
}

TEST(ConfigTypes, WrongText_RefusedAndValueKept) {
  CConfig config;
  config.add<bool>("bool", "", true);
  config.add<int>("int", "", 5);
  config.add<unsigned>("unsigned", "", 5U);
  config.add<double>("double", "", 5.0);
  config.add<course::Point>("point", "", course::Point());
  config.add<char>("char", "", 'a');
  for (const char* text : {"", "maybe", "2", "tru", "true "}) {
    EXPECT_THROW(config.set("bool", text), imr::exception) << text;
  }
  for (const char* text : {"", "12abc", "abc", "1.0", "1e3", " 1", "1 ", "0x10", "+", "-", "+-1",
                           "++1", "--1", "2147483648", "-2147483649", "99999999999999999999"}) {
    EXPECT_THROW(config.set("int", text), imr::exception) << text;
  }
  for (const char* text : {"-1", "-0", "4294967296", "1.5", ""}) {
    EXPECT_THROW(config.set("unsigned", text), imr::exception) << text;
  }
  for (const char* text : {"", "1,5", "1.5m", "nan", "-nan", "1e999", ".", "e5", "0x1p3", "1 2"}) {
    EXPECT_THROW(config.set("double", text), imr::exception) << text;
  }
  for (const char* text : {"", "1", "1;2", "1,2,3", "1,2x", "a,b"}) {
    EXPECT_THROW(config.set("point", text), imr::exception) << text;
  }
  for (const char* text : {"", "ab"}) {
    EXPECT_THROW(config.set("char", text), imr::exception) << text;
  }
  EXPECT_TRUE(config.get<bool>("bool"));
  EXPECT_EQ(config.get<int>("int"), 5);
  EXPECT_EQ(config.get<unsigned>("unsigned"), 5U);
  EXPECT_EQ(config.get<double>("double"), 5.0);
  EXPECT_EQ(config.get<course::Point>("point").x, 0.0);
  EXPECT_EQ(config.get<char>("char"), 'a');
}

TEST(ConfigTypes, Messages_SayWhatIsExpected) {
  CConfig config;
  config.add<bool>("b", "", true);
  config.add<int>("i", "", 5);
  config.add<unsigned>("u", "", 5U);
  config.add<double>("d", "", 5.0);
  config.add<course::Point>("p", "", course::Point());
  EXPECT_EQ(message_of([&] { config.set("b", "maybe"); }),
            "option 'b': 'maybe' is not true or false");
  EXPECT_EQ(message_of([&] { config.set("i", "2147483648"); }),
            "option 'i': '2147483648' is out of the range of type int");
  EXPECT_EQ(message_of([&] { config.set("u", "-1"); }),
            "option 'u': '-1' is not a whole number of 0 or more");
  EXPECT_EQ(message_of([&] { config.set("d", "fast"); }), "option 'd': 'fast' is not a number");
  EXPECT_EQ(message_of([&] { config.set("p", "here"); }),
            "option 'p': 'here' is not a value of type course::Point");
}

TEST_F(Config, CommandLine_AcceptsBothFormsOfValues) {
  EXPECT_TRUE(parse(config_, {"--host", "s1", "--port=6665", "--x", "-0.5"}));
  EXPECT_EQ(config_.get<std::string>("host"), "s1");
  EXPECT_EQ(config_.get<int>("port"), 6665);
  EXPECT_EQ(config_.get<double>("x"), -0.5);
}

TEST_F(Config, EmptyCommandLine_KeepsDefaults) {
  EXPECT_TRUE(parse(config_, {}));
  EXPECT_TRUE(config_.parse_command_line(0, nullptr));
  EXPECT_EQ(config_.get<int>("port"), 4000);
}

TEST_F(Config, JoinedValue_TakenUnchanged) {
  EXPECT_TRUE(parse(config_, {"--host=--a=b "}));
  EXPECT_EQ(config_.get<std::string>("host"), "--a=b ");
  EXPECT_TRUE(parse(config_, {"--host="}));
  EXPECT_EQ(config_.get<std::string>("host"), "");
}

TEST_F(Config, RepeatedOption_LastCounts) {
  EXPECT_TRUE(parse(config_, {"--port", "1", "--port=2", "--coords", "--no-coords"}));
  EXPECT_EQ(config_.get<int>("port"), 2);
  EXPECT_FALSE(config_.get<bool>("coords"));
}

TEST_F(Config, BoolOptions_AcceptFlagAndValue) {
  const auto coords_after = [&](const std::vector<std::string>& arguments) {
    EXPECT_TRUE(parse(config_, arguments));
    return config_.get<bool>("coords");
  };
  EXPECT_TRUE(coords_after({"--coords"}));
  EXPECT_FALSE(coords_after({"--no-coords"}));
  EXPECT_TRUE(coords_after({"--coords", "true"}));
  EXPECT_FALSE(coords_after({"--coords", "0"}));
  EXPECT_TRUE(coords_after({"--coords=on"}));
  EXPECT_FALSE(coords_after({"--coords=NO"}));
  EXPECT_TRUE(coords_after({"--coords", "--port", "5"}));
  EXPECT_EQ(config_.get<int>("port"), 5);
}

TEST_F(Config, NegatedBool_TakesNoValue) {
  EXPECT_EQ(message_of([&] { parse(config_, {"--no-coords=true"}); }),
            "command line: option '--no-coords' takes no value");
  EXPECT_THROW(parse(config_, {"--no-coords", "true"}), imr::exception);
  EXPECT_THROW(parse(config_, {"--no-port"}), imr::exception);
}

TEST_F(Config, NameThatBeginsWithNo_NotNegation) {
  config_.add<int>("no-x", "number of x", 1);
  config_.add<bool>("no-map", "drive without a map", false);
  EXPECT_TRUE(parse(config_, {"--no-x", "3", "--no-map"}));
  EXPECT_EQ(config_.get<int>("no-x"), 3);
  EXPECT_TRUE(config_.get<bool>("no-map"));
}

TEST_F(Config, UnknownOption_SuggestsNearest) {
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--prot", "5"});
            }),
            "command line: unknown option '--prot'; did you mean '--port'?");
  EXPECT_EQ(message_of([&] { parse(config_, {"--hosts=a"}); }),
            "command line: unknown option '--hosts'; did you mean '--host'?");
  EXPECT_EQ(message_of([&] {
              parse(config_, {"-port", "5"});
            }),
            "command line: unknown option '-port'; did you mean '--port'?");
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--velocity", "5"});
            }),
            "command line: unknown option '--velocity'");
  EXPECT_THROW(parse(config_, {"--=5"}), imr::exception);
}

TEST_F(Config, StrayArgument_Refused) {
  EXPECT_EQ(message_of([&] { parse(config_, {"map.png"}); }),
            "command line: unexpected argument 'map.png'");
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--coords", "perhaps"});
            }),
            "command line: unexpected argument 'perhaps'");
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--", "--port"});
            }),
            "command line: unexpected argument '--port'");
  for (const char* stray : {"", "-", "-5", "-="}) {
    EXPECT_THROW(parse(config_, {stray}), imr::exception) << stray;
  }
  EXPECT_NO_THROW(parse(config_, {"--"}));
}

TEST_F(Config, MissingValue_Refused) {
  EXPECT_EQ(message_of([&] { parse(config_, {"--port"}); }),
            "command line: option '--port' needs a value (a whole number)");
  EXPECT_THROW(parse(config_, {"--host", "--port", "5"}), imr::exception);
  EXPECT_THROW(parse(config_, {"--port="}), imr::exception);
}

TEST_F(Config, WrongValue_Refused) {
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--port", "12abc"});
            }),
            "command line: option '--port': '12abc' is not a whole number");
  EXPECT_THROW(parse(config_, {"--x=fast"}), imr::exception);
  EXPECT_THROW(parse(config_, {"--coords=maybe"}), imr::exception);
}

TEST_F(Config, WrongCommandLine_ChangesNothing) {
  EXPECT_THROW(parse(config_, {"--host", "s1", "--port", "x"}), imr::exception);
  EXPECT_EQ(config_.get<std::string>("host"), "localhost");
}

TEST_F(Config, MissingRequiredOptions_AllNamed) {
  config_.add<std::string>("map", "map file");
  config_.add<double>("speed", "forward speed");
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--port", "5"});
            }),
            "missing required options '--map', '--speed'");
  EXPECT_EQ(config_.get<int>("port"), 4000);
  EXPECT_EQ(message_of([&] {
              parse(config_, {"--speed", "1"});
            }),
            "missing required option '--map'");
  EXPECT_TRUE(parse(config_, {"--speed", "1", "--map", "m.png"}));
  EXPECT_EQ(config_.get<std::string>("map"), "m.png");
}

TEST_F(Config, MissingRequiredOptions_MayBeSetLater) {
  config_.add<std::string>("map", "map file");
  EXPECT_TRUE(parse(config_, {"--port", "5"}, CConfig::UnknownArguments::kError,
                    CConfig::MissingOptions::kAllow));
  EXPECT_EQ(config_.get<int>("port"), 5);
  EXPECT_THROW(config_.check_required(), imr::exception);
}

TEST_F(Config, UnknownArguments_KeptIfAllowed) {
  EXPECT_TRUE(parse(config_, {"a", "--port", "5", "--other=1", "-v", "--", "--x", "b"},
                    CConfig::UnknownArguments::kKeep));
  EXPECT_EQ(config_.get<int>("port"), 5);
  EXPECT_EQ(config_.get<double>("x"), 0.0);
  EXPECT_THAT(config_.positional(), ElementsAre("a", "--other=1", "-v", "--x", "b"));
  EXPECT_TRUE(parse(config_, {}));
  EXPECT_THAT(config_.positional(), IsEmpty());
}

TEST_F(Config, Help_PrintedAndExits) {
  config_.add<double>("speed", "forward speed");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"-h"}, {"--unknown", "-h"}, {"--port", "-h"}}) {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(parse(config_, arguments));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), config_.help("robot"));
  }
  EXPECT_TRUE(parse(config_, {"--speed", "1", "--", "-h"}, CConfig::UnknownArguments::kKeep));
}

TEST_F(Config, Help_TableInOrderOfDeclaration) {
  config_.add<double>("speed", "forward speed");
  config_.add<std::string>("log", "log file\nno log if empty", "");
  EXPECT_EQ(config_.help("robot"),
            "Usage: robot [options]\n"
            "\n"
            "  option         type    default     description\n"
            "  --host         string  localhost   server hostname\n"
            "  --port         int     4000        server port\n"
            "  --[no-]coords  bool    false       set initial coordinates\n"
            "  --x            double  0           initial x position\n"
            "  --speed        double  (required)  forward speed\n"
            "  --log          string  \"\"          log file\n"
            "                                     no log if empty\n"
            "  -h, --help                         show this help and exit\n");
}

TEST_F(Config, Help_WrapsLongDescriptions) {
  std::string description = "start";
  for (int i = 0; i < 60; ++i) {
    description += " word";
  }
  config_.add<int>("long", description, 0);
  std::istringstream lines(config_.help());
  std::string line;
  int words = 0;
  while (std::getline(lines, line)) {
    EXPECT_LE(line.size(), 100U) << line;
    for (std::size_t at = line.find(" word"); at != std::string::npos;
         at = line.find(" word", at + 1)) {
      ++words;
    }
  }
  EXPECT_EQ(words, 60);
}

TEST_F(Config, Help_ShowsDefaultNotValue) {
  config_.set("port", 5);
  EXPECT_THAT(config_.help(), HasSubstr("4000"));
}

TEST_F(Config, Help_ShowsDefaultsOfCustomTypes) {
  config_.add<course::Point>("goal", "", course::Point{1.5, 2.0});
  config_.add<course::ReadOnly>("secret", "", course::ReadOnly{5});
  const std::string help = config_.help();
  EXPECT_THAT(help, HasSubstr("course::Point     1.5,2"));
  EXPECT_THAT(help, HasSubstr("course::ReadOnly  (set)"));
}

TEST_F(Config, File_FillsOptions) {
  const TemporaryFile file(
      "\xEF\xBB\xBF# settings of the robot\r\n"
      "\r\n"
      "  host = syrotek.example # the server\r\n"
      "port=6665\n"
      "coords = yes\n"
      "\t x\t=\t-1.5 ");
  config_.load_file(file.path());
  EXPECT_EQ(config_.get<std::string>("host"), "syrotek.example");
  EXPECT_EQ(config_.get<int>("port"), 6665);
  EXPECT_TRUE(config_.get<bool>("coords"));
  EXPECT_EQ(config_.get<double>("x"), -1.5);
}

TEST_F(Config, EmptyFile_ChangesNothing) {
  const TemporaryFile file("");
  config_.load_file(file.path());
  EXPECT_EQ(config_.get<int>("port"), 4000);
}

TEST_F(Config, FileValues_MayBeQuoted) {
  const auto host_of = [&](const std::string& value) {
    const TemporaryFile file("host = " + value + "\n");
    config_.load_file(file.path());
    return config_.get<std::string>("host");
  };
  EXPECT_EQ(host_of("a#b = c"), "a#b = c");
  EXPECT_EQ(host_of("\"#ff8800\""), "#ff8800");
  EXPECT_EQ(host_of("\"  a # b \" # comment"), "  a # b ");
  EXPECT_EQ(host_of("\"\""), "");
  EXPECT_EQ(host_of(R"("say \"hi\" \\ \n")"), R"(say "hi" \ \n)");
  EXPECT_EQ(host_of("it's \"fine\""), "it's \"fine\"");
}

TEST_F(Config, FileErrors_NameFileLineAndCause) {
  EXPECT_EQ(file_error("host = a\n\n# b\nport = 12abc\n"),
            "4: option 'port': '12abc' is not a whole number");
  EXPECT_EQ(file_error("prot = 5\n"), "1: unknown option 'prot'; did you mean 'port'?");
  EXPECT_EQ(file_error("port 5\n"), "1: expected 'name = value', found 'port 5'");
  EXPECT_EQ(file_error(" = 5\n"), "1: no name before '='");
  EXPECT_EQ(file_error("port = 1\nhost = a\nport = 2\n"),
            "3: option 'port' is given twice, first in line 1");
  EXPECT_THAT(file_error("port =\n"), StartsWith("1: no value after '='"));
  EXPECT_THAT(file_error("host = #ff8800\n"), StartsWith("1: no value after '='"));
  EXPECT_EQ(file_error("host = \"abc\n"), "1: the closing '\"' is missing");
  EXPECT_EQ(file_error("host = \"abc\\\"\n"), "1: the closing '\"' is missing");
  EXPECT_EQ(file_error("host = \"abc\" d\n"), "1: unexpected 'd' after the quoted value");
  EXPECT_EQ(file_error("--port = 5\n"), "1: unknown option '--port'; did you mean 'port'?");
  EXPECT_THAT(file_error(std::string("port = 1\0\n", 10)), StartsWith("1: option 'port'"));
}

TEST_F(Config, WrongFile_ChangesNothing) {
  file_error("host = other\nport = x\n");
  EXPECT_EQ(config_.get<std::string>("host"), "localhost");
}

TEST_F(Config, UnreadableFile_Refused) {
  const std::string missing = testing::TempDir() + "no_such_folder/robot.cfg";
  const std::string message = message_of([&] { config_.load_file(missing); });
  EXPECT_THAT(message, HasSubstr(missing));
  EXPECT_THAT(message, HasSubstr("no file of that name"));
  EXPECT_THAT(message_of([&] { config_.load_file(testing::TempDir()); }), HasSubstr("can't read"));
  EXPECT_THROW(config_.load_file(""), imr::exception);
}

TEST_F(Config, CommandLine_OverridesFileInEitherOrder) {
  const TemporaryFile file("port = 1\nhost = filehost\n");
  config_.load_file(file.path());
  parse(config_, {"--port", "2"});
  EXPECT_EQ(config_.get<int>("port"), 2);
  config_.load_file(file.path());
  EXPECT_EQ(config_.get<int>("port"), 2);
  EXPECT_EQ(config_.get<std::string>("host"), "filehost");
}

TEST_F(Config, SetValue_OverridesUntilLaterFile) {
  const TemporaryFile file("port = 1\n");
  parse(config_, {"--port", "2"});
  config_.set("port", 3);
  EXPECT_EQ(config_.get<int>("port"), 3);
  config_.load_file(file.path());
  EXPECT_EQ(config_.get<int>("port"), 1);
}

TEST_F(Config, File_SuppliesRequiredOptions) {
  config_.add<double>("speed", "forward speed");
  const TemporaryFile file("speed = 0.3\n");
  config_.load_file(file.path());
  EXPECT_TRUE(parse(config_, {}));
  EXPECT_EQ(config_.get<double>("speed"), 0.3);
}

TEST_F(Config, ManyThreads_MayUseIt) {
  constexpr int kRounds = 200;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([this, i] {
      config_.add<int>("own" + std::to_string(i), "", i);
      for (int round = 0; round < kRounds; ++round) {
        config_.set("host", std::string(40, static_cast<char>('a' + i)));
        const std::string host = config_.get<std::string>("host");
        // The text of either thread or the default, but never a mixture.
        EXPECT_TRUE(host == "localhost" || host == std::string(40, host[0])) << host;
        parse(config_, {"--port", std::to_string(i)});
        EXPECT_THAT(config_.help(), Not(IsEmpty()));
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_LT(config_.get<int>("port"), 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(config_.get<int>("own" + std::to_string(i)), i);
  }
}

TEST_F(Config, Options_DescribeThemselves) {
  CConfig config;
  config.add<std::string>("host", "where", "localhost");
  config.add<std::string>("title", "of the window", "");
  config.add<int>("port", "of the server");
  config.add<double>("speed", "in m/s", 0.1);
  config.add<bool>("loud", "much output", false);
  config.add<course::Point>("goal", "in m", course::Point{1.5, 2.0});
  config.add<course::ReadOnly>("mode", "of work", course::ReadOnly());
  const std::vector<CConfig::OptionInfo> options = config.options();
  ASSERT_EQ(options.size(), 7U);
  EXPECT_EQ(options[0].name, "host");
  EXPECT_EQ(options[0].description, "where");
  EXPECT_EQ(options[0].type, "string");
  const auto default_of = [&](std::size_t i) {
    return options[i].has_default ? "=" + options[i].default_text : std::string("none");
  };
  EXPECT_EQ(default_of(0), "=localhost");
  EXPECT_EQ(default_of(1), "=");
  EXPECT_EQ(default_of(2), "none");
  EXPECT_EQ(default_of(3), "=0.1");
  EXPECT_EQ(default_of(4), "=false");
  EXPECT_EQ(default_of(5), "=1.5,2");
  EXPECT_EQ(default_of(6), "none") << "it can't be written, so not be read again";

  std::ostringstream out;
  config.set("speed", "0.25");
  config.print(out);
  EXPECT_THAT(out.str(), HasSubstr("host=localhost\ntitle=\nport=\nspeed=0.25\nloud=false\n"));
}

}  // namespace
