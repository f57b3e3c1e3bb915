// Who may send requests to the page.
#include "emulator/page/access.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace understudy::emulator::page {
namespace access_test {

struct HostCase {
  const char* text;
  const char* name;  // null: the header is absent
  int port;
};

TEST(PageHost, IsParsedAndNotComparedByItsBeginning) {
  const HostCase cases[] = {
      {"localhost", "localhost", 80},
      {"localhost:8080", "localhost", 8080},
      {"LocalHost:8080", "localhost", 8080},
      {"127.0.0.1:1", "127.0.0.1", 1},
      {"[::1]:8080", "::1", 8080},
      {"[::1]", "::1", 80},
      {"127.0.0.1.evil.example:80", "127.0.0.1.evil.example", 80},
      {"", nullptr, 0},
      {":80", nullptr, 0},
      {"localhost:", nullptr, 0},
      {"localhost:80:80", nullptr, 0},
      {"localhost:65536", nullptr, 0},
      {"localhost:-1", nullptr, 0},
      {"localhost:8x", nullptr, 0},
      {"user@localhost:80", nullptr, 0},
      {"local host:80", nullptr, 0},
      {"localhost/x", nullptr, 0},
      {"[::1", nullptr, 0},
      {"[::1]x", nullptr, 0},
      {"[evil.example]:80", nullptr, 0},
      {"::1", nullptr, 0},
      {"local\nhost", nullptr, 0},
  };
  for (const HostCase& one : cases) {
    SCOPED_TRACE(one.text);
    const auto host = parse_host(one.text);
    ASSERT_EQ(host.has_value(), one.name != nullptr);
    if (!host) continue;
    EXPECT_EQ(host->name, one.name);
    EXPECT_EQ(host->port, one.port);
  }
  EXPECT_FALSE(parse_host(std::string(300, 'a')));
}

TEST(PageAccess, IsForTheLoopbackAtItsOwnPortAndNamedHosts) {
  const WebAccess access = access_of({.address = "127.0.0.1", .port = 8080}, {"bench.lab", "fe80::1"});
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "LOCALHOST:8080", "[::1]:8080",
                           "bench.lab:8080", "[fe80::1]:8080"}) {
    EXPECT_TRUE(access.admits_host(host)) << host;
    EXPECT_TRUE(access.admits_origin(std::string("http://") + host)) << host;
  }
  for (const char* host : {"127.0.0.1", "127.0.0.1:8081", "127.0.0.2:8080", "127.0.0.1.evil.example:8080",
                           "evil.example:8080", "localhost.evil.example:8080", ""}) {
    EXPECT_FALSE(access.admits_host(host)) << host;
    EXPECT_FALSE(access.admits_origin(std::string("http://") + host)) << host;
  }
  for (const char* origin : {"null", "", "https://localhost:8080", "http://localhost:8080/",
                             "http://localhost:8080.evil.example", "localhost:8080", "file://"}) {
    EXPECT_FALSE(access.admits_origin(origin)) << origin;
  }
}

TEST(PageToken, IsNewEachTimeAndMustBeWhole) {
  std::set<std::string> all;
  for (int i = 0; i < 100; ++i) all.insert(make_token());
  EXPECT_EQ(all.size(), 100U);
  const std::string& token = *all.begin();
  EXPECT_EQ(token.size(), 32U);
  EXPECT_TRUE(is_token(token, token));
  EXPECT_FALSE(is_token("", token));
  EXPECT_FALSE(is_token(token.substr(1), token));
  EXPECT_FALSE(is_token(token + "0", token));
  for (std::size_t i = 0; i < token.size(); ++i) {
    std::string wrong = token;
    wrong[i] = wrong[i] == '0' ? '1' : '0';
    EXPECT_FALSE(is_token(wrong, token)) << i;
  }
}

}  // namespace access_test
}  // namespace understudy::emulator::page
