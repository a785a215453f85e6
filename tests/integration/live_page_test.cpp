// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `--page` as a user starts it; the unit tests of the page's server cover its answers to clients.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "page_client.h"
#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::PageClient;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessResult;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What a run says about its page.
struct Links {
  int port = 0;
  std::string page;   ///< the link for watching
  std::string token;  ///< for commands

  explicit Links(const std::string& output) {
    const auto rest_of_line = [&output](const std::string& label) {
      const std::size_t begin = output.find(label);
      if (begin == std::string::npos) throw std::runtime_error("no link in: " + output);
      return output.substr(begin + label.size(), output.find('\n', begin) - begin - label.size());
    };
    page = rest_of_line("page: ");
    const std::string commands = rest_of_line("commands: ");
    port = std::stoi(commands.substr(commands.rfind(':') + 1));
    token = commands.substr(commands.rfind('=') + 1);
  }
};

/// The JSON head of a whole or a part.
json head_of(const std::string& message) {
  std::uint32_t length = 0;
  std::memcpy(&length, message.data(), sizeof length);
  return json::parse(message.substr(sizeof length, length));
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class LivePage : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> serve_call(const std::vector<std::string>& options) const {
    std::vector<std::string> call = {"serve", world,        "--out", folder / "out", "--clients",
                                     "0",     "--tcp-port", "0",     "--page"};
    call.insert(call.end(), options.begin(), options.end());
    return call;
  }
  /// Starts a server with a page on any free port.
  Links start(std::vector<std::string> options = {}) {
    options.insert(options.end(), {"--page-port", "0"});
    std::vector<std::string> call = serve_call(options);
    call.insert(call.begin(), PLAYPEN_COMMAND);
    server.emplace(call);
    if (!server->read_until("#token=") || !server->read_until("\n")) {
      throw std::runtime_error(server->finish().err);
    }
    return Links(server->output());
  }
  ProcessResult stop() {
    server->send_signal(SIGINT);
    return server->finish();
  }
  [[nodiscard]] pid_t page_process() const {
    const std::string id = std::to_string(server->process());
    return std::stoi(content_of("/proc/" + id + "/task/" + id + "/children"));
  }
  static PageClient joined(const Links& links, const std::string& token) {
    PageClient client(links.port);
    EXPECT_THAT(client.upgrade("Host: 127.0.0.1:" + std::to_string(links.port)),
                testing::StartsWith("HTTP/1.1 101"));
    client.text(token.empty() ? "{}" : json{{"token", token}}.dump());
    return client;
  }

  TemporaryFolder folder;
  std::string world = folder.write("room.json", test_support::room_world());
  std::optional<Process> server;
};

TEST_F(LivePage, Served_WatchesCommandsAndEnds) {
  const Links links = start();
  EXPECT_EQ(links.page, "http://127.0.0.1:" + std::to_string(links.port) + "/");
  PageClient page(links.port);
  page.request("GET /", "Host: localhost");
  EXPECT_THAT(page.rest(), AllOf(testing::StartsWith("HTTP/1.1 200 OK"),
                                 HasSubstr("<title>Playpen: room</title>")));
  PageClient client = joined(links, links.token);
  EXPECT_EQ(client.message().contents, R"({"rights": {"command": true}})");
  const PageClient::Message whole = client.message();
  EXPECT_EQ(whole.kind, 2);
  EXPECT_FALSE(head_of(whole.contents).contains("part"));
  client.text(R"({"pause": true})");
  while (!head_of(client.message().contents)["live"]["paused"].get<bool>()) {
  }
  client.text(R"({"dance": true})");
  std::string answer;
  while (answer.empty()) {
    const PageClient::Message message = client.message();
    if (message.kind == 1) answer = message.contents;
  }
  EXPECT_THAT(answer, HasSubstr("there is no command"));
  server->send_signal(SIGINT);
  PageClient::Message last;
  do {
    last = client.message();
  } while (last.kind == 2);
  EXPECT_EQ(last.contents, R"({"over": true})");
  EXPECT_EQ(client.message().close_code(), 1001);
  client.leave();
  const ProcessResult result = server->finish();
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(LivePage, Tokens_InNoArgumentsAndNoEnvironment) {
  const Links links = start();
  const std::string process = "/proc/" + std::to_string(page_process());
  EXPECT_THAT(content_of(process + "/cmdline"), HasSubstr("playpen-page"));
  EXPECT_THAT(content_of(process + "/cmdline") + content_of(process + "/environ"),
              Not(HasSubstr(links.token)));
  EXPECT_EQ(stop().status, 0);
  const ProcessResult run = playpen(
      {"run", world, "--page", "--page-port", "0", "--out", folder / "out", "--", "/usr/bin/env"});
  const Links of_run(run.out);
  EXPECT_THAT(run.out, HasSubstr("PLAYPEN_PAGE="));
  EXPECT_EQ(run.out.find(of_run.token), run.out.rfind(of_run.token));
}

TEST_F(LivePage, TokenFile_ItsTokensCount) {
  const std::string file = folder.write("tokens.json", R"({"command": "cccccccccccccccc",
                                                           "watch": "wwwwwwwwwwwwwwww"})");
  const Links links = start({"--page-token-file", file, "--page-bind", "0.0.0.0"});
  EXPECT_EQ(links.token, "cccccccccccccccc");
  EXPECT_THAT(links.page, testing::EndsWith("/#token=wwwwwwwwwwwwwwww"));
  EXPECT_EQ(joined(links, "cccccccccccccccc").message().contents,
            R"({"rights": {"command": true}})");
  EXPECT_EQ(joined(links, "wwwwwwwwwwwwwwww").message().contents,
            R"({"rights": {"command": false}})");
  EXPECT_EQ(stop().status, 0);
}

// The commands of docs/page.md that serve a world, with its token file.
TEST_F(LivePage, CommandsOfItsPage_Work) {
  const std::string text = content_of(PLAYPEN_SOURCE_DIR "/docs/page.md");
  const std::string fence = "```json\n";
  const std::size_t json_begin = text.find(fence) + fence.size();
  folder.write("tokens.json", text.substr(json_begin, text.find("```", json_begin) - json_begin));
  int count = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> call{std::istream_iterator<std::string>(words), {}};
    if (!line.starts_with("    playpen serve ")) continue;
    ++count;
    call.front() = PLAYPEN_COMMAND;
    call.insert(call.end(), {"--tcp-port", "0", "--page-port", "0", "--out", folder / "out"});
    test_support::ProcessOptions options;
    options.folder = folder.path().string();
    Process process(call, options);
    ASSERT_TRUE(process.read_until("commands: http://")) << line << process.finish().err;
    process.send_signal(SIGINT);
    EXPECT_EQ(process.finish().status, 0) << line;
  }
  EXPECT_EQ(count, 2);
}

TEST_F(LivePage, SignalToGroup_EndsInGoodOrder) {
  const Links links = start();
  PageClient client = joined(links, "");
  client.message();
  server->send_signal_to_group(SIGTERM);
  PageClient::Message last;
  do {
    last = client.message();
  } while (last.kind == 2);
  EXPECT_EQ(last.contents, R"({"over": true})");
  client.leave();
  const ProcessResult result = server->finish();
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, Not(HasSubstr("ended before the run")));
}

TEST_F(LivePage, PageOpenAndName_LinkWithoutToken) {
  const Links links = start({"--page-bind", "0.0.0.0", "--page-open", "--page-name", "robots.lab"});
  EXPECT_EQ(links.page, "http://robots.lab:" + std::to_string(links.port) + "/");
  PageClient page(links.port);
  page.request("GET /", "Host: robots.lab");
  EXPECT_THAT(page.rest(), testing::StartsWith("HTTP/1.1 200 OK"));
  EXPECT_EQ(stop().status, 0);
}

TEST_F(LivePage, KilledPageProcess_RunContinues) {
  const Links links = start();
  PageClient client = joined(links, links.token);
  client.message();  // the host knows its page now
  kill(page_process(), SIGKILL);
  while (client.receive()) {
  }
  EXPECT_TRUE(server->read_error_until("the live page is lost"));
  const ProcessResult result = stop();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("playpen-page ended before the run"));
}

TEST_F(LivePage, NoFreePort_ErrorBeforeTheRun) {
  const Links links = start();
  const ProcessResult result = playpen(serve_call({"--page-port", std::to_string(links.port)}));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--page cannot offer the page: --page-port: expected a "
                                          "free TCP port, found " +
                                          std::to_string(links.port)),
                                HasSubstr("[server/port-taken]")));
  EXPECT_THAT(result.out, Not(HasSubstr("listening")));
}

TEST_F(LivePage, BadAddress_Error) {
  const ProcessResult result = playpen(serve_call({"--page-bind", "no such machine"}));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--page-bind"), HasSubstr("\"no such machine\""),
                                HasSubstr("[server/address]")));
}

TEST_F(LivePage, MissingProgram_Error) {
  const std::string command = folder.write("bin/playpen", "");
  fs::copy_file(PLAYPEN_COMMAND, command, fs::copy_options::overwrite_existing);
  fs::permissions(command, fs::perms::owner_all);
  std::vector<std::string> call = serve_call({});
  call.insert(call.begin(), command);
  const ProcessResult result = test_support::run_process(call);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("playpen-page is missing, which belongs beside playpen in " +
                                    (folder / "bin")));
}

TEST_F(LivePage, BadTokenFiles_Errors) {
  const auto error = [this](const std::string& text) {
    const std::string file = folder.write("tokens.json", text);
    const ProcessResult result = playpen(serve_call({"--page-token-file", file}));
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(error(R"({"command": "short"})"),
              AllOf(HasSubstr("/command"), HasSubstr("[access/token]"), Not(HasSubstr("short"))));
  EXPECT_THAT(error(R"({"command": "cccccccccccccccc", "watch": "cccccccccccccccc"})"),
              AllOf(HasSubstr("/watch"), HasSubstr("[access/token]")));
  EXPECT_THAT(error(R"({"server": "cccccccccccccccc"})"), HasSubstr("\"server\""));
  EXPECT_THAT(playpen(serve_call({"--page-token-file", folder / "none.json"})).err,
              HasSubstr("[file/missing]"));
}

TEST_F(LivePage, BadOptions_Errors) {
  const auto error = [this](const std::vector<std::string>& options) {
    std::vector<std::string> call = {"run", world};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", "/bin/true"});
    const ProcessResult result = playpen(call);
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(error({"--page-port", "8080"}), HasSubstr("--page-port requires --page"));
  EXPECT_THAT(error({"--page", "--page-port", "65536"}), HasSubstr("65535"));
  EXPECT_THAT(error({"--page", "--page-name", "http://lab"}),
              HasSubstr("a name of letters, digits, '-' and '.'"));
  EXPECT_THAT(error({"--page", "--isolated", "required"}), HasSubstr("leave out --isolated"));
}

TEST(PagePrograms, StartedByHand_SaysWhoStartsIt) {
  const ProcessResult result = test_support::run_process({PAGE_PROGRAM});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("is started by 'playpen run --page'"));
  EXPECT_THAT(test_support::run_process({PAGE_PROGRAM, "--version"}).out,
              HasSubstr("playpen-page"));
}

}  // namespace
