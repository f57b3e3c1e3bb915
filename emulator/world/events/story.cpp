#include "emulator/world/events/story.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <deque>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/probe/probe_names.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kMaxTouching = 16;  // events that affect the names
constexpr std::size_t kMaxEvents = 24;    // in total, including events of the same devices

bool is_of_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '.';
}

/// Returns the words in a text that are names in the bench, each name once, in order.
std::vector<std::string> names_in_text(const World& world, std::string_view text) {
  const ProbeNames known(world);
  std::vector<std::string> names;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_of_name(text[end])) ++end;
    std::string word(text.substr(at, end - at));
    at = std::max(end, at + 1);
    while (word.ends_with('.')) word.pop_back();
    if (word.find('.') == std::string::npos || std::find(names.begin(), names.end(), word) != names.end())
      continue;
    try {
      known.resolve(word);
    } catch (const std::runtime_error&) {
      continue;
    }
    names.push_back(std::move(word));
  }
  return names;
}

/// Returns "feeder.A" for "feeder.A.lost", because events contain only the short name.
std::string base_of(const std::string& name) {
  const std::size_t second = name.find('.', name.find('.') + 1);
  return name.substr(0, second);
}

bool has_word(std::string_view text, std::string_view word) {
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !is_of_name(text[at - 1]);
    if (begins && (end == text.size() || text[end] == '.' || !is_of_name(text[end]))) return true;
  }
  return false;
}

std::string moment_text(const Event& event) {
  const std::string by = event.by == "host" ? "host" : "scenario";
  const std::string value = event.value.empty() ? "" : " = " + event.value;
  if (event.what == "write") return by + " writes " + event.name + value;
  if (event.what == "input") return by + " holds " + event.name + value;
  if (event.what == "power") return by + " switches " + event.device + (event.value == "0" ? " off" : " on");
  if (event.what == "inject") return by + " injects " + event.text;
  if (event.what == "clear") return by + " clears " + event.text;
  if (event.what == "command") return by + " commands " + event.device + ": " + event.text;
  if (event.what == "program") return by + " loads a program into " + event.device + ": " + event.text;
  if (event.what == "exception") return event.line + ": " + event.text;
  if (event.what == "ignored") return event.device + ": " + event.text;
  if (event.what == "dropped") return event.line + ": dropped: " + event.text;
  return event.text.empty() ? std::string(event.what) : event.text;
}

}  // namespace

Story story_of(const World& world, const RecordedFailure& failure, const std::deque<Event>& events) {
  Story story{.at = failure.at, .sentence = {}, .names = {}, .moments = {}};
  const std::string place = failure.place.empty() ? "" : " (" + failure.place + ": " + failure.step + ")";
  story.sentence = one_line("failed at " + format_duration(failure.at) + ": " + failure.what + place);
  story.names = names_in_text(world, failure.what + " " + failure.step);
  std::set<std::string> bases;
  std::set<std::string> devices;
  for (const std::string& name : story.names) {
    bases.insert(base_of(name));
    devices.insert(name.substr(0, name.find('.')));
  }
  const auto touches = [&](const Event& event) {
    return std::any_of(bases.begin(), bases.end(), [&](const std::string& base) {
      return event.name == base || has_word(event.text, base);
    });
  };
  const auto is_of_device = [&](const Event& event) {
    return devices.empty() || devices.contains(event.device) ||
           std::any_of(devices.begin(), devices.end(),
                       [&](const std::string& device) { return has_word(event.text, device); }) ||
           event.what == "dropped";
  };
  std::set<std::size_t> taken;
  const auto take_last = [&](const auto& fits, std::size_t max) {
    for (std::size_t i = events.size(); i-- > 0 && taken.size() < max;)
      if (events[i].time <= failure.at && fits(events[i])) taken.insert(i);
  };
  take_last(touches, kMaxTouching);
  take_last(is_of_device, kMaxEvents);
  const Event* before = nullptr;
  for (const std::size_t i : taken) {
    const Event& event = events[i];
    // The registers in one request result in one moment.
    const bool is_more = before != nullptr && event.what == "write" && before->what == "write" &&
                         before->time == event.time && before->by == event.by;
    if (is_more) {
      story.moments.back().text += one_line(", " + event.name + " = " + event.value);
    } else {
      story.moments.push_back({.at = event.time, .text = one_line(moment_text(event))});
    }
    before = &event;
  }
  return story;
}

std::vector<std::string> moment_lines(const Story& story) {
  std::vector<std::string> lines;
  for (const Story::Moment& moment : story.moments)
    lines.push_back(format_duration(moment.at) + "  " + moment.text);
  return lines;
}

}  // namespace understudy::emulator::world
