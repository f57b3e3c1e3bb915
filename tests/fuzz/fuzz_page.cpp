// Any messages from browsers on the WebSocket of the live page, and the addresses in their requests. Each
// message is refused or understood. A message that is passed on is one line of JSON, names no file and says
// that it comes from a page; a read-only page passes on nothing that changes anything.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

#include "emulator/page/access.h"
#include "emulator/page/page_verbs.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using namespace understudy::emulator::page;
using fuzzing::require;

constexpr std::size_t kLongest = 4096;

void look_at_address(std::string_view text) {
  const auto host = parse_host(text);
  const WebAccess access = access_of({.address = "127.0.0.1", .port = 8080}, {});
  if (access.admits_host(text)) {
    require(host && host->port == 8080, "an admitted host has our port");
    require(host->name == "localhost" || host->name == "127.0.0.1" || host->name == "::1",
            "and is the loopback");
  }
  if (access.admits_origin(text)) require(text.starts_with("http://"), "an admitted origin is of http");
}

void look_at_message(std::string_view text, bool is_read_only) {
  static const std::set<std::string> kLooks{
      "status", "identify", "bench", "registers", "choices",   "faults",  "get",      "eval",  "list",
      "frames", "events",   "where", "scope",     "snapshots", "program", "timeline", "stack", "variables"};
  BrowserMessage message;
  try {
    message = parse_browser_message(text, 2, is_read_only);
  } catch (const BrowserError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error is one line");
    return;
  }
  require(message.bench < 2, "a bench that there is");
  if (message.what == BrowserMessage::What::watch)
    return require(message.names.size() <= 2'000, "not too many names");
  require(message.message.empty() != message.refusal.empty(), "passed on or refused");
  if (message.message.empty()) return;
  require(message.message.find('\n') == std::string::npos, "one line");
  const Json passed = Json::parse(message.message);
  require(passed["as"] == "page", "said by a page");
  require(!passed.contains("file"), "names no file");
  if (is_read_only) require(kLooks.contains(passed["do"].get<std::string>()), "only looks");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  const std::string_view text = fuzzing::text_of(data, size);
  look_at_address(text);
  look_at_message(text, false);
  look_at_message(text, true);
  const std::string token = token_of(text);
  require(token.size() <= text.size(), "a token is said");
  return 0;
}
