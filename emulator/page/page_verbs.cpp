#include "emulator/page/page_verbs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/text/one_line.h"

namespace understudy::emulator::page {

namespace {

/// A verb that the page passes on. With `only_with`, it changes the bench only if it has one of these keys.
/// Otherwise it always or never changes the bench.
struct PassedVerb {
  std::string_view name;
  bool changes = false;
  std::array<std::string_view, 6> only_with{};
};
constexpr std::array<PassedVerb, 42> kPassedVerbs{
    {{"status"},
     {"identify"},
     {"bench"},
     {"registers"},
     {"choices"},
     {"faults"},
     {"get"},
     {"eval"},
     {"list"},
     {"frames"},
     {"events"},
     {"where"},
     {"coverage", true, {"again"}},
     {"stack"},
     {"source"},
     {"variables"},
     {"break", true, {"line", "instruction", "when", "write", "on", "delete"}},
     {"continue", true},
     {"snapshots", true, {"drop"}},
     {"scope", true, {"names", "off"}},
     {"program", true, {"text"}},
     {"set", true},
     {"input", true},
     {"turn", true},
     {"command", true},
     {"power", true},
     {"inject", true},
     {"clear", true},
     {"send", true},
     {"snapshot", true},
     {"restore", true},
     {"advance", true},
     {"run-until", true},
     {"step", true},
     {"pause", true},
     {"resume", true},
     {"speed", true},
     {"timeline"},
     {"seek", true},
     {"curves"},
     {"spans"},
     {"what-if", true}}};

constexpr int kDeepest = 8;
constexpr std::size_t kMaxNames = 2'000;
constexpr std::size_t kLongestName = 200;

/// Returns null for text that is not JSON or is nested too deeply.
Json parse_json(std::string_view text) {
  bool is_too_deep = false;
  Json parsed = Json::parse(
      text,
      [&](int depth, Json::parse_event_t, Json&) {
        is_too_deep = is_too_deep || depth > kDeepest;
        return !is_too_deep;
      },
      false);
  if (is_too_deep || parsed.is_discarded()) return {};
  return parsed;
}

std::size_t require_bench(const Json& message, std::size_t count) {
  std::uint64_t bench = 0;
  if (message.contains("bench")) {
    if (!message["bench"].is_number_unsigned()) throw BrowserError("bench: expected the number of a bench");
    bench = message["bench"].get<std::uint64_t>();
  }
  if (bench >= count) throw BrowserError("bench: expected the number of a bench");
  return bench;
}

bool flag_of(const Json& message, const char* key) {
  return message.contains(key) && message[key].is_boolean() && message[key].get<bool>();
}

void take_watch(const Json& message, BrowserMessage& taken) {
  taken.frames = flag_of(message, "frames");
  taken.events = flag_of(message, "events");
  taken.status = flag_of(message, "status");
  taken.watches = taken.frames || taken.events || taken.status || message.contains("names");
  if (!message.contains("names")) return;
  const Json& names = message["names"];
  if (!names.is_array() || names.size() > kMaxNames) {
    throw BrowserError("names: expected a list of at most " + std::to_string(kMaxNames));
  }
  for (const Json& name : names) {
    if (!name.is_string() || name.get_ref<const std::string&>().size() > kLongestName) {
      throw BrowserError("names: expected strings of at most " + std::to_string(kLongestName) + " bytes");
    }
    taken.names.push_back(name.get<std::string>());
  }
}

void take_ask(Json& message, bool is_read_only, BrowserMessage& taken) {
  if (!message.contains("id") || !message["id"].is_number_integer()) {
    throw BrowserError("id: expected a whole number");
  }
  if (!message.contains("message")) throw BrowserError("message: expected the message to send");
  taken.id = message["id"].dump();
  Json& asked = message["message"];
  taken.refusal = why_not_sent(asked, is_read_only);
  if (!taken.refusal.empty()) return;
  asked["as"] = "page";
  taken.message = asked.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string token_of(std::string_view text) {
  const Json message = parse_json(text);
  const bool has_one = message.is_object() && message.contains("token") && message["token"].is_string();
  return has_one ? message["token"].get<std::string>() : std::string();
}

BrowserMessage parse_browser_message(std::string_view text, std::size_t benches, bool is_read_only) {
  Json message = parse_json(text);
  if (!message.is_object() || !message.contains("do")) {
    throw BrowserError("expected a JSON object with \"do\": watch or ask");
  }
  BrowserMessage taken;
  taken.bench = require_bench(message, benches);
  if (message["do"] == "watch") {
    take_watch(message, taken);
  } else if (message["do"] == "ask") {
    taken.what = BrowserMessage::What::ask;
    take_ask(message, is_read_only, taken);
  } else {
    throw BrowserError("do: expected watch or ask");
  }
  return taken;
}

std::string why_not_sent(const Json& message, bool is_read_only) {
  if (!message.is_object() || !message.contains("do") || !message["do"].is_string()) {
    return "expected an object with a word under \"do\"";
  }
  if (message.contains("file")) return "file: a page cannot access files; expected a name";
  const std::string word = message["do"].get<std::string>();
  const auto* const found = std::find_if(kPassedVerbs.begin(), kPassedVerbs.end(),
                                         [&](const PassedVerb& verb) { return verb.name == word; });
  if (found == kPassedVerbs.end()) return understudy::quoted(word) + " is not a message that a page can send";
  const auto& keys = found->only_with;
  const bool has_such_key = std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
    return !key.empty() && message.contains(std::string(key));
  });
  const bool changes = found->changes && (keys[0].empty() || has_such_key);
  if (changes && is_read_only) return word + ": this page is read-only (--read-only)";
  return {};
}

}  // namespace understudy::emulator::page
