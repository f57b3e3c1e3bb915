#include "emulator/play/lint/lint.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/lint/finding.h"
#include "emulator/play/lint/host_lint.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

// Small EEPROMs are specified for this many writes per cell.
constexpr std::int64_t kEndurance = 100'000;
// A register is reported if it changed more often than this, at a rate that would wear out its cells before
// the minimum lifetime.
constexpr std::uint64_t kChangesAllowed = 10;
constexpr SimTime kMinLife = std::chrono::hours(24 * 365);

/// Returns "3 requests".
std::string counted(std::uint64_t count, const char* one, const char* several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

/// Returns an approximate time: "1.4 hours".
std::string rough(SimTime time) {
  struct Scale {
    SimTime unit;
    const char* name;
  };
  const auto tenths = [&](SimTime unit) { return time / (unit / 10); };
  Scale scale{std::chrono::minutes(1), "minutes"};
  for (const Scale larger : {Scale{std::chrono::hours(1), "hours"}, Scale{std::chrono::hours(24), "days"}}) {
    if (time >= larger.unit) scale = larger;
  }
  return std::to_string(tenths(scale.unit) / 10) + "." + std::to_string(tenths(scale.unit) % 10) + " " +
         scale.name;
}

/// Returns how long a cell lasts at the rate of its changes. Returns nothing if there are only a few changes,
/// or if the cell lasts long enough.
std::optional<SimTime> life_of(const Finding& changes) {
  if (changes.count <= kChangesAllowed) return std::nullopt;
  const auto intervals = static_cast<std::int64_t>(changes.count - 1);
  const SimTime interval = (changes.last - changes.first) / intervals;
  if (interval > kMinLife / kEndurance) return std::nullopt;
  return interval * kEndurance;
}

/// Returns the text of a finding without the line and the time, or an empty text if the finding need not be
/// reported.
std::string text_of(const HostLint& line, LintRule rule, const std::string& subject, const Finding& finding) {
  const std::uint64_t count = finding.count;
  switch (rule) {
    case LintRule::too_soon: {
      const bool overlaps = finding.extreme < SimTime{0};
      return counted(count, "request", "requests") + " began before the line had been silent for " +
             format_duration(line.silence()) + " (" +
             (overlaps ? "while a station was sending" : "after " + format_duration(finding.extreme)) +
             " at worst)";
    }
    case LintRule::not_waited:
      return counted(count, "request", "requests") + " began before the reply to the previous request";
    case LintRule::gap:
      return counted(count, "request", "requests") + " had gaps of more than " +
             format_duration(line.longest_gap()) + " between two bytes (" + format_duration(finding.extreme) +
             " at worst)";
    case LintRule::absent:
      return counted(count, "request", "requests") + " to station " + subject + ", which does not exist";
    case LintRule::read_only:
      return counted(count, "write", "writes") + " to " + subject + ", which is read-only";
    case LintRule::eeprom_wear: {
      const auto life = life_of(finding);
      if (!life) return "";
      return std::to_string(count) + " changes of " + subject +
             ", which is stored in EEPROM: at this rate its " + std::to_string(kEndurance) +
             " writes last for " + rough(*life);
    }
  }
  return "";
}

}  // namespace

Lint::Lint(world::World& world) : world_(world) {
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    lines_.push_back(std::make_unique<HostLint>(world, i));
  }
}

void Lint::world_restored(std::size_t) {
  for (const auto& line : lines_) line->restart();
}

std::vector<std::string> Lint::findings() const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    for (const auto& [about, finding] : lines_[i]->findings()) {
      const std::string text = text_of(*lines_[i], about.first, about.second, finding);
      if (text.empty()) continue;
      texts.push_back(world_.line(i).line.name() + ": " + text + "; first at " +
                      format_duration(finding.first) +
                      (finding.command.empty() ? "" : " (" + finding.command + ")"));
    }
  }
  return texts;
}

}  // namespace understudy::emulator::play
