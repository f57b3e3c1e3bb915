#include "emulator/command_line/ctl_scope.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/serve/control/server.h"

namespace understudy::emulator::command_line {

namespace {

using Json = nlohmann::ordered_json;

std::string time_at(const Json& scope, const char* key) {
  return format_duration(SimTime{scope.at(key).get<std::int64_t>()});
}

std::string names_of(const Json& scope) {
  std::string names;
  for (const Json& name : scope.at("names")) names += (names.empty() ? "" : ", ") + name.get<std::string>();
  return names;
}

/// Requests the samples starting at number `from`. Throws UsageError if there are no samples.
Json samples_from(const std::string& socket, std::uint64_t from) {
  const Json message{{"do", "scope"}, {"from", from}};
  Json reply = Json::parse(serve::ask_control(socket, message.dump()));
  if (!reply.at("ok").get<bool>()) throw UsageError("ctl scope: " + reply.at("error").get<std::string>());
  if (reply.at("scope").is_null() || reply.at("scope").at("count") == 0) {
    throw UsageError(
        "ctl scope: --trace: nothing was recorded; expected a scope that was armed and has run: ctl scope "
        "NAME...");
  }
  return reply;
}

}  // namespace

void print_scope(const Json& scope) {
  if (scope.is_null()) {
    std::printf("no scope is armed; ctl scope NAME... when=CONDITION arms one\n");
    return;
  }
  std::string text = scope.at("state").get<std::string>() + ": " + names_of(scope);
  const std::string condition = scope.at("condition").get<std::string>();
  const bool waits = scope.at("state") == "armed";
  if (waits && !condition.empty()) text += "; waits for " + condition;
  text += "; " + scope.at("count").dump() + " ticks recorded";
  if (scope.at("count") != 0) text += ", from " + time_at(scope, "from_ns") + " on";
  if (scope.contains("trigger_ns")) text += "; triggered at " + time_at(scope, "trigger_ns");
  if (scope.contains("error")) text += "; " + scope.at("error").get<std::string>();
  std::printf("%s\n", one_line(text).c_str());
}

void write_scope(const std::string& socket, const std::string& path) {
  if (!path.ends_with(".csv"))
    throw UsageError("--trace: " + path + ": has an unknown format; expected FILE.csv");
  Json reply = samples_from(socket, 0);
  const Json scope = reply.at("scope");
  std::string text = "time_ms";
  for (const Json& name : scope.at("names")) text += "," + name.get<std::string>();
  text += "\n";
  const std::int64_t step = scope.at("step_ns").get<std::int64_t>();
  std::int64_t time = scope.at("from_ns").get<std::int64_t>();
  std::uint64_t rows = 0;
  while (true) {
    const Json& samples = reply.at("samples");
    for (std::size_t i = 0; i < samples.at(0).size(); ++i, time += step, ++rows) {
      text += std::to_string(time / 1'000'000);
      for (const Json& of_name : samples) text += "," + of_name.at(i).dump();
      text += "\n";
    }
    if (!reply.contains("next")) break;
    reply = samples_from(socket, reply.at("next").get<std::uint64_t>());
    // A new shot has started, which does not belong in this trace.
    if (reply.at("scope").at("names") != scope.at("names")) break;
  }
  if (const std::string why = replace_text_file(path, text, ContentKind::trace); !why.empty())
    throw GrowingFileError("--trace: " + path + " cannot be written: " + why);
  std::printf("%s: %llu ticks\n", path.c_str(), static_cast<unsigned long long>(rows));
}

}  // namespace understudy::emulator::command_line
