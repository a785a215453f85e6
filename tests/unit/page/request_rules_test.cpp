// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "request_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "live_page.h"
#include "replay/viewer_files.h"

namespace playpen::page {
namespace {

RequestParts page_request(std::string_view host = "127.0.0.1:8080") {
  RequestParts parts;
  parts.method = "GET";
  parts.target = "/";
  parts.hosts = {host};
  return parts;
}

RequestParts live_request(std::string_view origin) {
  RequestParts parts = page_request("lab:8080");
  parts.target = "/live";
  parts.is_upgrade = true;
  if (!origin.empty()) parts.origins = {origin};
  return parts;
}

TEST(OwnHost, AddressesLocalhostAndNames_Own) {
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:8080", "192.0.2.7:1", "[::1]", "[2001:db8::7]:80", "localhost",
        "LocalHost:9000", "lab", "LAB:8080", "robots.lab"}) {
    EXPECT_TRUE(is_own_host(host, {"lab", "robots.lab"})) << host;
  }
}

TEST(OwnHost, OtherNamesAndGarbage_NotOwn) {
  for (const std::string_view host : {"",
                                      ":80",
                                      "evil.com",
                                      "lab.evil.com",
                                      "127.0.0.1.evil.com",
                                      "localhost.",
                                      "localhost:",
                                      "localhost:80:80",
                                      "localhost:123456",
                                      "localhost:x",
                                      "[::1",
                                      "[::1]x",
                                      "[]",
                                      "[lab]",
                                      "::1",
                                      "127.1",
                                      "2130706433",
                                      "0x7f.1",
                                      "user@localhost",
                                      "localhost/"}) {
    EXPECT_FALSE(is_own_host(host, {"lab"})) << host;
  }
  EXPECT_FALSE(is_own_host(std::string_view("127.0.0.1\0.evil.com", 18), {}));
}

TEST(Judge, PageAndSocket_Allowed) {
  EXPECT_EQ(judge(page_request(), {}).status, 200);
  RequestParts head = page_request();
  head.method = "HEAD";
  EXPECT_EQ(judge(head, {}).status, 200);
  EXPECT_EQ(judge(live_request(""), {"lab"}).status, 101);
  EXPECT_EQ(judge(live_request("http://lab:8080"), {"lab"}).status, 101);
  EXPECT_EQ(judge(live_request("https://LAB:8080"), {"lab"}).status, 101);
}

TEST(Judge, OtherHost_Misdirected) { EXPECT_EQ(judge(page_request("evil.com"), {}).status, 421); }

TEST(Judge, OtherOrigin_Forbidden) {
  for (const char* origin : {"http://evil.com", "http://lab", "http://lab:8081", "null", "lab:8080",
                             "http://lab:8080.evil.com", "ftp://lab:8080", "http://lab:8080/"}) {
    EXPECT_EQ(judge(live_request(origin), {"lab"}).status, 403) << origin;
  }
  RequestParts page = page_request();
  page.origins = {"http://evil.com"};
  EXPECT_EQ(judge(page, {}).status, 403);
}

TEST(Judge, NoHostOrTwoFields_BadRequest) {
  RequestParts parts = page_request();
  parts.hosts.clear();
  EXPECT_EQ(judge(parts, {}).status, 400);
  parts.hosts = {"localhost", "localhost"};
  EXPECT_EQ(judge(parts, {}).status, 400);
  parts = live_request("http://lab:8080");
  parts.origins.push_back("http://lab:8080");
  EXPECT_EQ(judge(parts, {"lab"}).status, 400);
}

TEST(Judge, OtherTargetMethodOrBody_Refused) {
  for (const char* target : {"/index.html", "/../etc/passwd", "/?x", "*", "", "//", "/live/"}) {
    RequestParts parts = page_request();
    parts.target = target;
    EXPECT_EQ(judge(parts, {}).status, 404) << target;
  }
  RequestParts parts = page_request();
  parts.method = "POST";
  EXPECT_EQ(judge(parts, {}).status, 405);
  parts = page_request();
  parts.has_body = true;
  EXPECT_EQ(judge(parts, {}).status, 413);
  parts = live_request("");
  parts.method = "HEAD";
  EXPECT_EQ(judge(parts, {"lab"}).status, 405);
  parts = live_request("");
  parts.is_upgrade = false;
  EXPECT_EQ(judge(parts, {"lab"}).status, 426);
}

TEST(LivePage, PolicyAllowsOwnScriptAndConnectionOnly) {
  const std::string policy = live_policy("[::1]:8080");
  EXPECT_THAT(policy, testing::HasSubstr("default-src 'none'; script-src 'sha256-" +
                                         std::string(replay::kViewerScriptSha256) + "'"));
  EXPECT_THAT(policy, testing::HasSubstr("connect-src 'self' ws://[::1]:8080 wss://[::1]:8080"));
}

TEST(LivePage, HasTitleAndNoData) {
  const std::string page = live_page("a &lt; b", "localhost");
  EXPECT_THAT(page, testing::HasSubstr("<title>a &lt; b</title>"));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("id=\"replay-data\"")));
  EXPECT_THAT(page, testing::EndsWith("</script>\n</body>\n</html>\n"));
}

}  // namespace
}  // namespace playpen::page
