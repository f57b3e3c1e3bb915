// The messages that browsers may send.
#include "emulator/page/page_verbs.h"

#include <gtest/gtest.h>

#include <string>

namespace understudy::emulator::page {
namespace page_verbs_test {

std::string error_of(const std::string& text) {
  try {
    parse_browser_message(text, 2, false);
  } catch (const BrowserError& error) {
    return error.what();
  }
  return {};
}

TEST(BrowserMessages, ThatAreNoneAreRefused) {
  EXPECT_NE(error_of(""), "");
  EXPECT_NE(error_of("nonsense"), "");
  EXPECT_NE(error_of("[]"), "");
  EXPECT_NE(error_of("{}"), "");
  EXPECT_NE(error_of(R"({"do":"watch","bench":0)"), "");
  EXPECT_NE(error_of(R"({"do":7})"), "");
  EXPECT_NE(error_of(R"({"do":"look"})"), "");
  EXPECT_NE(error_of(R"({"do":"watch","bench":2})"), "");
  EXPECT_NE(error_of(R"({"do":"watch","bench":-1})"), "");
  EXPECT_NE(error_of(R"({"do":"watch","bench":18446744073709551615})"), "");
  EXPECT_NE(error_of(R"({"do":"watch","names":7})"), "");
  EXPECT_NE(error_of(R"({"do":"watch","names":[7]})"), "");
  EXPECT_NE(error_of(R"({"do":"watch","names":[")" + std::string(201, 'x') + R"("]})"), "");
  EXPECT_NE(error_of(R"({"do":"ask","message":{"do":"bench"}})"), "");
  EXPECT_NE(error_of(R"({"do":"ask","id":"7","message":{"do":"bench"}})"), "");
  EXPECT_NE(error_of(R"({"do":"ask","id":7})"), "");
  EXPECT_NE(
      error_of(R"({"do":"ask","id":7,"message":)" + std::string(100, '[') + std::string(100, ']') + "}"), "");
  std::string many = R"({"do":"watch","names":["a")";
  for (int i = 0; i < 2'000; ++i) many += R"(,"a")";
  EXPECT_NE(error_of(many + "]}"), "");
}

TEST(BrowserMessages, SayWhatIsWatchedAndAsked) {
  const BrowserMessage watch = parse_browser_message(
      R"({"do":"watch","bench":1,"names":["a","b"],"frames":true,"status":1})", 2, false);
  EXPECT_EQ(watch.bench, 1U);
  EXPECT_EQ(watch.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(watch.watches && watch.frames && !watch.events && !watch.status);
  EXPECT_FALSE(parse_browser_message(R"({"do":"watch"})", 1, false).watches);
  const BrowserMessage ask =
      parse_browser_message(R"({"do":"ask","id":-3,"message":{"do":"list"}})", 1, false);
  EXPECT_EQ(ask.id, "-3");
  EXPECT_EQ(ask.message, R"({"do":"list","as":"page"})");
  // Whatever they send, they count as a page.
  EXPECT_EQ(parse_browser_message(R"({"do":"ask","id":1,"message":{"do":"list","as":"control"}})", 1, false)
                .message,
            R"({"do":"list","as":"page"})");
}

std::string refusal_of(const char* message, bool is_read_only) {
  return why_not_sent(Json::parse(message), is_read_only);
}

TEST(BrowserMessages, NameNoFilesAndNothingUnknown) {
  for (const char* message :
       {R"({"do":"snapshot","file":"/etc/passwd"})", R"({"do":"restore","file":"/tmp/x"})",
        R"({"do":"bench","file":""})", R"({"do":"look"})", R"({"do":"format"})", R"({"do":7})", R"({})",
        R"([])", R"("bench")"}) {
    EXPECT_NE(refusal_of(message, false), "") << message;
  }
}

TEST(ReadOnlyPages, PassOnWhatLooksAndNothingThatChanges) {
  for (const char* message :
       {R"({"do":"status"})", R"({"do":"bench"})", R"({"do":"registers"})", R"({"do":"get","names":["a"]})",
        R"({"do":"eval"})", R"({"do":"list"})", R"({"do":"frames"})", R"({"do":"events"})",
        R"({"do":"where"})", R"({"do":"scope"})", R"({"do":"program","device":"a"})", R"({"do":"faults"})",
        R"({"do":"choices"})", R"({"do":"snapshots"})", R"({"do":"timeline","from":500})",
        R"({"do":"curves","names":["a"]})", R"({"do":"spans"})", R"({"do":"break"})",
        R"({"do":"coverage","device":"a"})"}) {
    EXPECT_EQ(refusal_of(message, true), "") << message;
    EXPECT_EQ(refusal_of(message, false), "") << message;
  }
  for (const char* message : {R"({"do":"set","values":{}})",
                              R"({"do":"input"})",
                              R"({"do":"turn"})",
                              R"({"do":"power"})",
                              R"({"do":"inject"})",
                              R"({"do":"clear"})",
                              R"({"do":"send"})",
                              R"({"do":"snapshot","name":"a"})",
                              R"({"do":"restore","name":"a"})",
                              R"({"do":"advance"})",
                              R"({"do":"run-until"})",
                              R"({"do":"step"})",
                              R"({"do":"pause"})",
                              R"({"do":"resume"})",
                              R"({"do":"speed"})",
                              R"({"do":"program","text":""})",
                              R"({"do":"scope","names":["a"]})",
                              R"({"do":"scope","off":true})",
                              R"({"do":"snapshots","drop":"a"})",
                              R"({"do":"seek","to_ns":5})",
                              R"({"do":"what-if"})",
                              R"({"do":"break","device":"a","line":5})",
                              R"({"do":"break","when":"time > 5s"})",
                              R"({"do":"break","on":"exception"})",
                              R"({"do":"break","write":"a.b"})",
                              R"({"do":"break","instruction":0})",
                              R"({"do":"break","delete":"all"})",
                              R"({"do":"coverage","again":true})",
                              R"({"do":"what-if","off":true})",
                              R"({"do":"command","device":"a","text":"MOVE"})"}) {
    EXPECT_NE(refusal_of(message, true), "") << message;
    EXPECT_EQ(refusal_of(message, false), "") << message;
  }
}

}  // namespace page_verbs_test
}  // namespace understudy::emulator::page
