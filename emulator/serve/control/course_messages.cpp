#include "emulator/serve/control/course_messages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/spans.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/events/history.h"
#include "emulator/world/events/story.h"
#include "emulator/world/look/curves.h"
#include "emulator/world/look/program_spans.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/timeline.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxCurves = 256;
constexpr std::size_t kMaxPoints = 200'000;  // the maximum for all names together
/// Up to this amount of work, every tick is sampled. Above it, only a few moments per dot are sampled.
constexpr Tick kMaxCurveWork = 4'000'000;  // ticks times the weight of names and devices
constexpr Tick kMaxProgramWork = 100'000;  // ticks times devices
constexpr std::uint64_t kLooksADot = 8;

/// Returns the interval between samples. If a watcher is notified of every tick anyway, the interval is the
/// whole stretch.
SimTime apart_of(const Stretch& stretch, bool is_exact) {
  const SimTime length = stretch.to - stretch.from;
  if (is_exact) return length;
  return std::max(kTickLength, length / static_cast<std::int64_t>(stretch.dots * kLooksADot));
}

Json points_of(const std::vector<double>& values) {
  Json points = Json::array();
  for (const double value : values) points.push_back(json_of(value));
  return points;
}

void add_exchanges(std::vector<Span>& spans, const world::History& history) {
  for (const world::Exchange& exchange : history.exchanges()) {
    Json entry{{"kind", "frame"}};
    const auto add = [&](const char* key, const std::string& text) {
      if (!text.empty()) entry[key] = text;
    };
    add("text", exchange.request);
    add("reply", exchange.reply);
    add("remark", exchange.remark);
    if (exchange.latency) entry["latency_ns"] = exchange.latency->count();
    spans.push_back({.lane = exchange.line,
                     .begin = exchange.begin,
                     .end = exchange.end,
                     .entry = std::move(entry),
                     .is_bad = exchange.is_refusal || !exchange.remark.empty()});
  }
}

/// Adds a span for each fault, and for each time in which a device has no power.
void add_events(std::vector<Span>& spans, const world::History& history, SimTime end) {
  std::map<std::string, std::size_t> under_way;  // the number of the span, by the key that ends it
  const auto begin = [&](const std::string& key, const world::Event& event, const char* lane,
                         const std::string& text) {
    under_way[key] = spans.size();
    spans.push_back({.lane = lane,
                     .begin = event.time,
                     .end = end,
                     .entry = Json{{"kind", lane}, {"text", text}},
                     .is_bad = true});
  };
  const auto finish = [&](const std::string& key, SimTime at) {
    const auto found = under_way.find(key);
    if (found == under_way.end()) return;
    spans[found->second].end = at;
    under_way.erase(found);
  };
  for (const world::Event& event : history.events()) {
    Json entry{{"kind", "event"}, {"what", event.what}};
    const auto add = [&](const char* key, const std::string& text) {
      if (!text.empty()) entry[key] = text;
    };
    add("by", event.by);
    add("device", event.device);
    add("name", event.name);
    add("value", event.value);
    add("text", event.text);
    const std::string lane = event.by.empty() ? "events" : "events of " + event.by;
    spans.push_back(
        {.lane = lane,
         .begin = event.time,
         .end = event.time,
         .entry = std::move(entry),
         .is_bad = event.what == "exception" || event.what == "ignored" || event.what == "dropped"});
    if (event.what == "power" && event.value == "0") {
      begin("power " + event.device, event, "power", event.device + " has no power");
    } else if (event.what == "power") {
      finish("power " + event.device, event.time);
    } else if (event.what == "fault" && event.text.ends_with(": begins")) {
      begin("fault " + event.value, event, "fault", event.text.substr(0, event.text.rfind(':')));
    } else if (event.what == "fault" || event.what == "clear") {
      finish("fault " + event.value, event.time);
    }
  }
}

/// Adds the waits of the threads of a host in simulated time.
void add_waits(std::vector<Span>& spans, const world::Timeline& timeline) {
  for (const world::RecordedEvent& event : timeline.events()) {
    if (event.what != world::RecordedEvent::What::wait) continue;
    spans.push_back(
        span_of_wait({.thread = event.where, .begin = event.since, .end = event.at, .text = event.text}));
  }
}

void add_programs(std::vector<Span>& spans, const Stretch& stretch, const world::Timeline& timeline,
                  world::World& other) {
  Tick programs = 0;
  for (std::size_t i = 0; i < other.device_count(); ++i)
    programs += other.device(i).user_program() != nullptr ? 1 : 0;
  if (programs == 0) return;
  const bool is_exact = (stretch.to - stretch.from) / kTickLength * programs <= kMaxProgramWork;
  world::ProgramSpans found(other);
  const auto look = [&] {
    found.look();
    if (is_exact) found.watch();
  };
  timeline.play_again(other, stretch.from, stretch.to, apart_of(stretch, is_exact), look);
  for (world::ProgramSpans::Span& span : found.finish()) {
    Json entry{{"kind", "program"}, {"line", span.line}, {"text", span.text}};
    if (!span.waits_for.empty()) entry["waits_for"] = span.waits_for;
    spans.push_back({.lane = span.program.empty() ? span.device : span.device + " " + span.program,
                     .begin = span.begin,
                     .end = span.end,
                     .entry = std::move(entry),
                     .is_bad = span.has_failed});
  }
}

}  // namespace

Json curves_message(const Json& message, const world::Timeline& timeline, world::World& other) {
  require_keys(message, {"do", "names", "from_ns", "to_ns", "dots"});
  const Stretch stretch = stretch_of(message, timeline.begin(), timeline.end());
  const Json& given = require(message, "names");
  if (!given.is_array() || given.empty() || given.size() > kMaxCurves)
    throw is_not("names", given, "a list of 1 to " + std::to_string(kMaxCurves) + " names");
  std::vector<std::string> names;
  for (const Json& name : given) {
    if (!name.is_string()) throw is_not("names", given, "a list of names");
    names.push_back(name.get<std::string>());
  }
  if (names.size() * stretch.dots > kMaxPoints)
    throw MessageError("dots: too many for this many names; expected at most " +
                       std::to_string(kMaxPoints / names.size()));
  world::Curves curves(other, names, stretch.from, stretch.to, stretch.dots);
  const Tick ticks = (stretch.to - stretch.from) / kTickLength;
  const auto weight = static_cast<Tick>(names.size() + 4 * other.device_count());
  const bool is_exact = ticks * weight <= kMaxCurveWork;
  const SimTime apart = apart_of(stretch, is_exact);
  timeline.play_again(other, stretch.from, stretch.to, apart, [&] {
    curves.look();
    if (is_exact) curves.watch();
  });
  curves.finish();
  Json entry = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i)
    entry.push_back(Json{{"least", points_of(curves.min(i))}, {"greatest", points_of(curves.max(i))}});
  return Json{{"ok", true},
              {"from_ns", stretch.from.count()},
              {"to_ns", stretch.to.count()},
              {"step_ns", is_exact ? kTickLength.count() : apart.count()},
              {"curves", std::move(entry)}};
}

Json spans_message(const Json& message, const world::Timeline& timeline, world::World& other,
                   const world::History& history, const world::Story* story) {
  require_keys(message, {"do", "from_ns", "to_ns", "dots", "from"});
  const Stretch stretch = stretch_of(message, timeline.begin(), timeline.end());
  std::vector<Span> spans;
  add_exchanges(spans, history);
  add_events(spans, history, timeline.end());
  add_waits(spans, timeline);
  if (story != nullptr) {
    spans.push_back({.lane = "events",
                     .begin = story->at,
                     .end = story->at,
                     .entry = Json{{"kind", "failed"}, {"text", story->sentence}},
                     .is_bad = true});
  }
  add_programs(spans, stretch, timeline, other);
  Json reply = reply_with(std::move(spans), stretch, message);
  if (history.dropped() > 0) reply["left_out"] = history.dropped();
  return reply;
}

Json json_of(const world::Story& story) {
  Json moments = Json::array();
  for (const world::Story::Moment& moment : story.moments)
    moments.push_back(Json{{"time_ns", moment.at.count()}, {"text", moment.text}});
  return Json{{"time_ns", story.at.count()},
              {"text", story.sentence},
              {"names", story.names},
              {"moments", std::move(moments)}};
}

}  // namespace understudy::emulator::serve
