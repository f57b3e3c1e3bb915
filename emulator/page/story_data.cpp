#include "emulator/page/story_data.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::page {

namespace {

constexpr std::uint64_t kMaxDots = 4'000;      // the limit in docs/control.md
constexpr std::uint64_t kMaxPoints = 200'000;  // in one reply
constexpr std::size_t kMaxCourses = 400;       // in a file
constexpr std::size_t kMaxListed = 4'000;      // frames, and as many events
constexpr std::size_t kListedAtOnce = 200;     // how many a daemon lists from before a moment
constexpr std::int64_t kTick_ns = 1'000'000;
constexpr std::int64_t kOverlap_ns = 50'000'000;    // a frame is listed only after its last character
constexpr std::int64_t kBefore_ns = 3'000'000'000;  // the part before the current moment
constexpr std::int64_t kAfter_ns = 1'000'000'000;

// The values that the axes panel shows of each axis, the most important first.
constexpr std::array<std::string_view, 15> kOfAxes{
    "position", "speed", "pulses", "target", "servo",       "lost",      "encoder",    "ready",
    "alarm",    "pwm",   "home",   "mark",   "lower_limit", "near_home", "upper_limit"};

std::string text_of(const Json& object, const char* key) { return object.at(key).get<std::string>(); }

/// Returns the names whose courses a file contains: the most important value of every axis first, then the
/// next.
std::vector<std::string> names_of(const Json& devices) {
  std::vector<std::string> names;
  for (const std::string_view what : kOfAxes) {
    for (const auto& [device, reported] : devices.items())
      for (const Json& axis : reported.at("axes"))
        names.push_back(device + "." + text_of(axis, "name") + "." + std::string(what));
  }
  for (const auto& [device, reported] : devices.items())
    for (const Json& terminal : reported.at("terminals"))
      names.push_back(device + "." + text_of(terminal, "name"));
  return names;
}

/// Returns the current values of the names, and what drives each terminal.
Json values_of(const Asker& ask, const std::vector<std::string>& names) {
  Json values = Json::object();
  constexpr std::size_t kAtOnce = 1'000;
  for (std::size_t first = 0; first < names.size(); first += kAtOnce) {
    Json wanted = Json::array();
    for (std::size_t i = first; i < std::min(first + kAtOnce, names.size()); ++i) {
      wanted.push_back(names[i]);
      wanted.push_back(names[i] + "@by");
    }
    const Json reply = require_reply(ask, {{"do", "look"}, {"names", wanted}});
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (!reply.at("values")[i].is_null()) values[wanted[i].get<std::string>()] = reply.at("values")[i];
  }
  return values;
}

/// Returns a curve as a list of runs: the first dot, its minimum and its maximum.
Json runs_of(const Json& curve) {
  Json runs = Json::array();
  const Json& min = curve.at("least");
  const Json& max = curve.at("greatest");
  for (std::size_t i = 0; i < min.size(); ++i) {
    if (i > 0 && min[i] == min[i - 1] && max[i] == max[i - 1]) continue;
    runs.push_back(i);
    runs.push_back(min[i]);
    runs.push_back(max[i]);
  }
  return runs;
}

Json json_of(const Asker& ask, const std::vector<std::string>& names, const Course& course) {
  Json curves = Json::object();
  const std::vector<Json> all = curves_of(ask, names, course);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!all[i].is_null()) curves[names[i]] = runs_of(all[i]);
  return Json{{"from_ns", course.from_ns},
              {"to_ns", course.to_ns},
              {"dots", course.dots},
              {"curves", std::move(curves)},
              {"spans", spans_of(ask, course)}};
}

/// Collects the last frames or events of the recording, moment by moment.
class Listed {
 public:
  Listed(const char* word, const Json& message) : word_(word), message_(message) {}

  /// Takes the entries that the daemon lists now. Returns the time from which the list is complete.
  std::int64_t take(const Asker& ask) {
    const Json reply = require_reply(ask, message_);
    const Json& some = reply.at(word_);
    bool has_new = false;
    std::int64_t first = INT64_MAX;
    for (Json one : some) {
      one.erase("number");
      const std::int64_t time = one.at("time_ns").get<std::int64_t>();
      first = std::min(first, time);
      if (!known_.insert(one.dump()).second) continue;
      has_new = true;
      all_.push_back(std::move(one));
    }
    const bool is_all = some.size() < kListedAtOnce || !has_new || all_.size() >= kMaxListed;
    return is_all ? 0 : first;
  }

  /// Returns all entries, in order.
  Json finish() {
    std::stable_sort(all_.begin(), all_.end(), [](const Json& one, const Json& other) {
      return one.at("time_ns").get<std::int64_t>() < other.at("time_ns").get<std::int64_t>();
    });
    Json list = Json::array();
    for (Json& one : all_) {
      Json numbered{{"number", list.size() + 1}};
      numbered.update(one);
      list.push_back(std::move(numbered));
    }
    return list;
  }

 private:
  std::string word_;
  Json message_;
  std::set<std::string> known_;
  std::vector<Json> all_;
};

}  // namespace

Json require_reply(const Asker& ask, const Json& message) {
  Json reply = Json::parse(ask(message.dump()));
  if (!reply.value("ok", false)) throw RefusedError(reply.value("error", "no answer"));
  return reply;
}

Json timeline_of(const Asker& ask) {
  Json timeline;
  for (Json message{{"do", "timeline"}};;) {
    Json reply = require_reply(ask, message);
    if (timeline.is_null()) {
      timeline = std::move(reply.at("timeline"));
    } else {
      for (Json& mark : reply.at("timeline").at("marks")) timeline.at("marks").push_back(std::move(mark));
    }
    if (!reply.contains("next")) return timeline;
    message["from"] = reply.at("next");
  }
}

std::vector<Json> curves_of(const Asker& ask, const std::vector<std::string>& names, const Course& course) {
  std::vector<Json> curves;
  const std::size_t at_once = std::min<std::size_t>(256, kMaxPoints / course.dots);
  for (std::size_t first = 0; first < names.size(); first += at_once) {
    const std::size_t end = std::min(first + at_once, names.size());
    const Json wanted(std::vector<std::string>(names.begin() + static_cast<std::ptrdiff_t>(first),
                                               names.begin() + static_cast<std::ptrdiff_t>(end)));
    const Json reply = require_reply(ask, {{"do", "curves"},
                                           {"names", wanted},
                                           {"from_ns", course.from_ns},
                                           {"to_ns", course.to_ns},
                                           {"dots", course.dots}});
    for (const Json& curve : reply.at("curves")) curves.push_back(curve);
  }
  return curves;
}

Json spans_of(const Asker& ask, const Course& course) {
  Json spans = Json::array();
  Json message{{"do", "spans"}, {"from_ns", course.from_ns}, {"to_ns", course.to_ns}, {"dots", course.dots}};
  for (;;) {
    Json reply = require_reply(ask, message);
    for (Json& span : reply.at("spans")) spans.push_back(std::move(span));
    if (!reply.contains("next")) return spans;
    message["from"] = reply.at("next");
  }
}

Json story_data(const Asker& ask, const std::string& name, const std::string& version) {
  Json timeline = timeline_of(ask);
  const auto time = [&](const char* key) { return timeline.at(key).get<std::int64_t>(); };
  const std::int64_t begin = time("begin_ns");
  const std::int64_t end = std::max(time("end_ns"), begin + kTick_ns);
  const std::int64_t at = time("at_ns");
  Json bench = require_reply(ask, {{"do", "bench"}}).at("bench");
  bench["path"] = name;
  Json devices = Json::object();
  for (const Json& device : bench.at("devices"))
    devices[text_of(device, "name")] =
        require_reply(ask, {{"do", "bench"}, {"device", device.at("name")}}).at("device");
  Json values = values_of(ask, names_of(devices));
  std::vector<std::string> names;
  for (const std::string& one : names_of(devices))
    if (values.contains(one) && names.size() < kMaxCourses) names.push_back(one);
  Json status = require_reply(ask, {{"do", "status"}}).at("status");
  Json courses = Json::array();
  const auto dots_of = [](std::int64_t length) {
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(length / kTick_ns), 1, kMaxDots);
  };
  courses.push_back(json_of(ask, names, {.from_ns = begin, .to_ns = end, .dots = dots_of(end - begin)}));
  if (end - begin > kTick_ns * static_cast<std::int64_t>(kMaxDots)) {
    const std::int64_t from = std::max(begin, at / kTick_ns * kTick_ns - kBefore_ns);
    const std::int64_t to = std::min(end, from + kBefore_ns + kAfter_ns);
    courses.push_back(json_of(ask, names, {.from_ns = from, .to_ns = to, .dots = dots_of(to - from)}));
  }
  Listed frames("frames", {{"do", "frames"}, {"last", kListedAtOnce}, {"raw", true}});
  Listed events("events", {{"do", "events"}, {"last", kListedAtOnce}});
  for (std::int64_t to = end; to > begin;) {
    require_reply(ask, {{"do", "seek"}, {"to_ns", to}});
    const std::int64_t known_from = std::max(frames.take(ask), events.take(ask));
    to = known_from == 0 ? 0 : std::min(to - kTick_ns, known_from + kOverlap_ns);
  }
  return Json{{"name", name},
              {"version", version},
              {"timeline", std::move(timeline)},
              {"bench", std::move(bench)},
              {"devices", std::move(devices)},
              {"values", std::move(values)},
              {"status", std::move(status)},
              {"courses", std::move(courses)},
              {"frames", frames.finish()},
              {"events", events.finish()}};
}

}  // namespace understudy::emulator::page
