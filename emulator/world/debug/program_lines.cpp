#include "emulator/world/debug/program_lines.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/lines.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/program_parts.h"
#include "emulator/device/user_program.h"
#include "emulator/world/debug/breakpoint.h"

namespace understudy::emulator::world {

namespace {

/// If several parts have the same number, only the first one runs, because stored files are also parts.
std::vector<ProgramPart> running_parts(const Device& device, const std::string& text) {
  std::vector<ProgramPart> parts;
  for (ProgramPart& part : device.model().language->parts(text, device.settings())) {
    const auto has_its_number = [&](const ProgramPart& other) { return other.number == part.number; };
    if (std::none_of(parts.begin(), parts.end(), has_its_number)) parts.push_back(std::move(part));
  }
  return parts;
}

/// The parts may have a different order in the file than in the listing.
bool is_same_program(const std::vector<ProgramPart>& a, const std::vector<ProgramPart>& b) {
  const auto is_in_b = [&](const ProgramPart& one) {
    return std::any_of(b.begin(), b.end(), [&](const ProgramPart& other) {
      return one.number == other.number && one.lines == other.lines;
    });
  };
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), is_in_b);
}

}  // namespace

ProgramLines::ProgramLines(const Device& device)
    : listing_(running_parts(device, device.user_program()->program_text())) {
  const DeviceSettings& settings = device.settings();
  if (!settings.program.empty()) parts_ = running_parts(device, settings.program);
  if (!settings.program.empty() && is_same_program(parts_, listing_)) {
    source_ = settings.program_name;
    take_texts(settings.program);
  } else {
    parts_ = listing_;
    take_texts(device.user_program()->program_text());
  }
}

void ProgramLines::take_texts(std::string text) {
  text_ = std::move(text);
  constexpr std::string_view kBlanks = " \t\r";
  for (const TextLine line : TextLines(text_)) {
    const std::size_t first = line.text.find_first_not_of(kBlanks);
    const bool is_empty = first == std::string_view::npos;
    texts_.emplace_back(is_empty ? ""
                                 : line.text.substr(first, line.text.find_last_not_of(kBlanks) + 1 - first));
  }
}

int ProgramLines::line_from(int line) const {
  int found = 0;
  for (const ProgramPart& part : parts_) {
    for (const ProgramLine& one : part.lines) {
      if (one.text_line >= line && one.text_line > 0 && (found == 0 || one.text_line < found))
        found = one.text_line;
    }
  }
  return found;
}

std::vector<int> ProgramLines::lines() const {
  std::set<int> all;
  for (const ProgramPart& part : parts_) {
    for (const ProgramLine& one : part.lines) {
      if (one.text_line > 0) all.insert(one.text_line);
    }
  }
  return {all.begin(), all.end()};
}

int ProgramLines::last_line() const {
  int last = 0;
  for (const ProgramPart& part : parts_) {
    for (const ProgramLine& one : part.lines) last = std::max(last, one.text_line);
  }
  return last;
}

std::vector<ProgramLines::Instruction> ProgramLines::at(int line) const {
  std::vector<Instruction> all;
  for (const ProgramPart& part : parts_) {
    const auto is_present = [&](const ProgramLine& one) { return one.text_line == line; };
    const auto found = std::find_if(part.lines.begin(), part.lines.end(), is_present);
    if (found != part.lines.end()) all.push_back({part.number, static_cast<int>(found - part.lines.begin())});
  }
  return all;
}

const ProgramPart* ProgramLines::find_part(const std::string& name) const {
  if (name.empty()) return parts_.size() == 1 ? &parts_.front() : nullptr;
  const auto is_named = [&](const ProgramPart& part) { return part.name == name; };
  const auto found = std::find_if(parts_.begin(), parts_.end(), is_named);
  return found == parts_.end() ? nullptr : &*found;
}

std::vector<std::string> ProgramLines::part_names() const {
  std::vector<std::string> names;
  for (const ProgramPart& part : parts_) names.push_back(part.name);
  return names;
}

std::optional<InstructionPlace> ProgramLines::place(Instruction instruction) const {
  for (const ProgramPart& part : parts_) {
    if (part.number != instruction.part) continue;
    if (instruction.number < 0 || instruction.number >= static_cast<int>(part.lines.size()))
      return std::nullopt;
    const ProgramLine& line = part.lines[static_cast<std::size_t>(instruction.number)];
    const auto row = static_cast<std::size_t>(line.text_line);
    const bool has_text = row > 0 && row <= texts_.size();
    return InstructionPlace{part.name, instruction.number, line.text_line,
                            has_text ? texts_[row - 1] : line.code};
  }
  return std::nullopt;
}

int ProgramLines::source_line(int listing_line) const {
  for (const ProgramPart& part : listing_) {
    for (std::size_t i = 0; i < part.lines.size(); ++i) {
      if (part.lines[i].text_line != listing_line) continue;
      const auto found = place({part.number, static_cast<int>(i)});
      return found ? found->line : 0;
    }
  }
  return 0;
}

}  // namespace understudy::emulator::world
