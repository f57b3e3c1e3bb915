#include "emulator/play/report/picture_words.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/play/report/axis_scale.h"
#include "emulator/play/report/run_log.h"

namespace understudy::emulator::play {

namespace {

using SignalKind = SeenSignal::Kind;

const char* unit_of(SignalKind kind) {
  switch (kind) {
    case SignalKind::position:
    case SignalKind::pulses: return " pulses";
    case SignalKind::speed: return " pulses/s";
    case SignalKind::duty: return " %";
    case SignalKind::voltage: return " V";
    case SignalKind::level:
    case SignalKind::bit: break;
  }
  return "";
}

std::string words_of(const SeenSignal& signal) {
  const SeenSignal::Point& first = signal.points.front();
  const SeenSignal::Point& last = signal.points.back();
  if (signal.kind == SignalKind::bit) {
    const auto level = [](const SeenSignal::Point& point) { return point.value != 0 ? "on" : "off"; };
    return signal.name + " is " + level(first) + " at first and " + level(last) + " at the end";
  }
  return signal.name + " goes from " + plain_number(first.value) + " to " + plain_number(last.value) +
         unit_of(signal.kind) + ", between " + plain_number(signal.min) + " and " + plain_number(signal.max);
}

}  // namespace

std::string words_of(const SeenWait& wait) {
  const std::string longest = wait.text + ", " + format_duration(wait.longest);
  if (wait.count == 1) return format_duration(wait.begin) + " " + longest;
  return format_duration(wait.begin) + " " + std::to_string(wait.count) + " waits, the longest: " + longest;
}

std::string picture_name(const Stretch& stretch, std::string_view of) {
  return std::string(of) + ": motion and signals, from " + format_duration(stretch.begin) + " to " +
         format_duration(stretch.end);
}

std::string picture_words(const Stretch& stretch, std::optional<SimTime> failed_at) {
  std::string words;
  for (const SeenSignal& signal : stretch.signals) {
    if (!signal.varies() || signal.points.empty()) continue;
    words += (words.empty() ? "" : "; ") + words_of(signal);
  }
  if (words.empty()) words = "nothing moved or switched";
  const auto longest = std::ranges::max_element(stretch.waits, {}, &SeenWait::longest);
  if (longest != stretch.waits.end()) words += "; the host's longest wait: " + words_of(*longest);
  if (failed_at) words += "; failed at " + format_duration(*failed_at);
  return words + ".";
}

}  // namespace understudy::emulator::play
