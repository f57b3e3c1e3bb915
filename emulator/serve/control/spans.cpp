#include "emulator/serve/control/spans.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/daemon/kept_waits.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::uint64_t kMaxDots = 4'000;
constexpr std::size_t kMaxSpans = 2'000;  // the most spans in a reply

Json json_of_span(const Span& span) {
  Json entry{{"lane", span.lane}, {"begin_ns", span.begin.count()}, {"end_ns", span.end.count()}};
  entry.update(span.entry);
  if (span.is_bad) entry["bad"] = true;
  if (span.count > 1) entry["count"] = span.count;
  return entry;
}

/// Returns the spans in the stretch, ordered by their beginning. Merges spans of a lane that lie within one
/// dot.
std::vector<Span> thinned(std::vector<Span> spans, const Stretch& stretch) {
  std::erase_if(spans, [&](const Span& span) { return span.end < stretch.from || span.begin > stretch.to; });
  std::stable_sort(spans.begin(), spans.end(),
                   [](const Span& one, const Span& other) { return one.begin < other.begin; });
  const SimTime dot =
      std::max(SimTime{1}, (stretch.to - stretch.from) / static_cast<std::int64_t>(stretch.dots));
  std::map<std::string, std::size_t> last;  // the last span of each lane
  std::vector<Span> some;
  for (Span& span : spans) {
    const auto found = last.find(span.lane);
    if (found != last.end()) {
      Span& before = some[found->second];
      const bool is_one = span.end - before.begin < dot;
      if (is_one) {
        before.end = std::max(before.end, span.end);
        if (span.is_bad && !before.is_bad) before.entry = std::move(span.entry);
        before.is_bad = before.is_bad || span.is_bad;
        before.count += span.count;
        continue;
      }
    }
    last[span.lane] = some.size();
    some.push_back(std::move(span));
  }
  return some;
}

}  // namespace

Stretch stretch_of(const Json& message, SimTime begin, SimTime end) {
  Stretch stretch{.from = begin, .to = end, .dots = 1'000};
  const auto time = [&](const char* key, SimTime otherwise) {
    return message.contains(key) ? SimTime{static_cast<std::int64_t>(require_count(message, key, INT64_MAX))}
                                 : otherwise;
  };
  stretch.from = std::clamp(time("from_ns", stretch.from), begin, end);
  stretch.to = std::clamp(time("to_ns", stretch.to), begin, end);
  // A scenario may fail before any time has passed.
  if (begin == end) stretch.to = stretch.from + kTickLength;
  if (message.contains("dots")) stretch.dots = require_count(message, "dots", kMaxDots);
  if (stretch.dots == 0) throw MessageError("dots: expected 1 to " + std::to_string(kMaxDots));
  if (stretch.to <= stretch.from)
    throw MessageError(
        "to_ns: is not later than from_ns; expected a time span between 0 and the last moment");
  return stretch;
}

Span span_of_wait(const HostWait& wait) {
  return {.lane = wait.thread == 1 ? "host" : "host thread " + std::to_string(wait.thread),
          .begin = wait.begin,
          .end = wait.end,
          .entry = Json{{"kind", "wait"}, {"text", wait.text}},
          .is_bad = wait.text.ends_with("in vain")};
}

Json reply_with(std::vector<Span> spans, const Stretch& stretch, const Json& message) {
  const std::size_t first = message.contains("from") ? require_count(message, "from") : 0;
  const std::vector<Span> some = thinned(std::move(spans), stretch);
  Json entry = Json::array();
  const std::size_t end = std::min(some.size(), first < some.size() ? first + kMaxSpans : first);
  for (std::size_t i = first; i < end; ++i) entry.push_back(json_of_span(some[i]));
  Json reply{{"ok", true}, {"spans", std::move(entry)}, {"of", some.size()}};
  if (end < some.size()) reply["next"] = end;
  return reply;
}

Json present_spans_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do", "from_ns", "to_ns", "dots", "from"});
  daemon.catch_up();
  const Stretch stretch = stretch_of(message, SimTime{0}, daemon.world().now());
  const KeptWaits& waits = daemon.observers().waits;
  std::vector<Span> spans;
  for (const HostWait& wait : waits.ended()) spans.push_back(span_of_wait(wait));
  for (const HostWait& wait : waits.under_way()) spans.push_back(span_of_wait(wait));
  Json reply = reply_with(std::move(spans), stretch, message);
  if (waits.dropped() > 0) reply["left_out"] = waits.dropped();
  return reply;
}

}  // namespace understudy::emulator::serve
