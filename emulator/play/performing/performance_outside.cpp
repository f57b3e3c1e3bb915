// Performs steps that act on the bench from outside: inputs, faults, power, programs, memories.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

std::string text_of_value(std::int64_t value) { return std::to_string(value); }
std::string text_of_value(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr};  // the shortest text
}

/// Compares registers or reals. A value that is missing from an image has the factory value.
template <class Values>
void compare_values(const Values& present, const Values& wanted, std::vector<std::string>& lines) {
  using Map = std::map<std::string, typename Values::value_type::second_type>;
  const Map is(present.begin(), present.end());
  const Map should_be(wanted.begin(), wanted.end());
  const auto text = [](const auto& values, const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? std::string("the factory value") : text_of_value(found->second);
  };
  const auto compare = [&](const std::string& name) {
    lines.push_back(name + " is " + text(is, name) + "; expected " + text(should_be, name));
  };
  for (const auto& [name, value] : present) {  // in the order of the model's table
    const auto found = should_be.find(name);
    if (found == should_be.end() || found->second != value) compare(name);
  }
  for (const auto& [name, value] : wanted) {
    if (!is.contains(name)) compare(name);
  }
}

/// Reports the first line that differs.
void compare_lines(const std::string& what, const std::vector<std::string>& present,
                   const std::vector<std::string>& wanted, std::vector<std::string>& lines) {
  const auto text = [](const std::vector<std::string>& all, std::size_t i) {
    return i < all.size() ? quoted(all[i]) : std::string("missing");
  };
  for (std::size_t i = 0; i < std::max(present.size(), wanted.size()); ++i) {
    if (i < present.size() && i < wanted.size() && present[i] == wanted[i]) continue;
    lines.push_back(what + " line " + std::to_string(i + 1) + " is " + text(present, i) + "; expected " +
                    text(wanted, i));
    return;
  }
}

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream rest(text);
  for (std::string line; std::getline(rest, line);) lines.push_back(line);
  if (text.empty() || text.back() == '\n') lines.emplace_back();
  return lines;
}

/// Compares blocks. A block that exists in only one image is reported as a whole.
void compare_blocks(const NamedBlocks& present, const NamedBlocks& wanted, std::vector<std::string>& lines) {
  std::map<std::string, std::pair<const SharedText*, const SharedText*>> both;
  for (const auto& [kind, entries] : present) {
    for (const auto& [name, text] : entries) both[kind + " " + quoted(name)].first = &text;
  }
  for (const auto& [kind, entries] : wanted) {
    for (const auto& [name, text] : entries) both[kind + " " + quoted(name)].second = &text;
  }
  for (const auto& [what, texts] : both) {
    const auto [is, should_be] = texts;
    if (should_be == nullptr) {
      lines.push_back(what + " exists; expected no such text");
    } else if (is == nullptr) {
      lines.push_back(what + " is missing; expected it in the memory");
    } else if (*is != *should_be) {
      compare_lines(what, lines_in(is->text()), lines_in(should_be->text()), lines);
    }
  }
}

/// Returns the differences, one per line.
std::vector<std::string> differences(const NvImage& present, const NvImage& wanted) {
  std::vector<std::string> lines;
  const auto has_other_model = present.model != wanted.model;
  if (has_other_model) lines.push_back("model is " + present.model + "; expected " + wanted.model);
  compare_values(present.registers, wanted.registers, lines);
  compare_values(present.reals, wanted.reals, lines);
  compare_lines("program", present.program, wanted.program, lines);
  compare_blocks(present.blocks, wanted.blocks, lines);
  return lines;
}

}  // namespace

void Performance::perform(const InputStep& step) {
  executor_->with_world([&](world::World& world) {
    for (const world::InputSetup& input : step.inputs) {
      world.set_external_input(input.device, input.terminal, input.level);
    }
  });
}

void Performance::perform(const TurnStep& step) {
  executor_->with_world([&](world::World& world) {
    for (const world::Fault& turn : step.turns) world.inject(turn);
  });
}

void Performance::perform(const InjectStep& step) {
  executor_->with_world(
      [&](world::World& world) { faults_.emplace_back(step.name, world.inject(step.fault)); });
}

void Performance::perform(const ClearStep& step) {
  bool was_there = step.name.empty();
  executor_->with_world([&](world::World& world) {
    if (step.name.empty()) {
      world.clear_faults();
      faults_.clear();
    }
    std::erase_if(faults_, [&](const auto& fault) {
      if (fault.first != step.name) return false;
      world.clear_fault(fault.second);  // also clears a fault that has already ended
      return was_there = true;
    });
  });
  if (!was_there)
    throw StepError("no fault called '" + step.name + "' is in force; expected an active fault");
}

void Performance::perform(const PowerStep& step) {
  executor_->with_world([&](world::World& world) {
    for (const auto& [device, to] : step.devices) {
      if (to != PowerStep::To::on) world.switch_power(device, false);
      if (to != PowerStep::To::off) world.switch_power(device, true);
    }
  });
}

void Performance::perform(const ProgramStep& step) {
  executor_->with_world([&](world::World& world) {
    const Device& device = world.device(step.device);
    if (!device.powered()) throw StepError(device.name() + " has no power; expected it to be on");
    try {
      world.load_program(step.device, step.text);
    } catch (const ProgramError& error) {
      if (!step.asks) return;
      if (!step.refused) throw StepError(in_file(error.first(), step.file));
      const std::string message = in_text(error.first());
      if (message.find(*step.refused) != std::string::npos) return;
      throw StepError(device.name() + " refused the program for a different reason: " + message,
                      "a message with " + quoted(*step.refused), message);
    }
    if (step.refused && step.asks)
      throw StepError(device.name() + " accepted the program; expected a refusal");
  });
}

void Performance::perform(const MemoryStep& step) {
  // The image is created here, not on the world's thread, because a large memory takes time.
  LateImage kept;
  executor_->with_world(
      [&](world::World& world) { kept = world.device(step.device).memory()->content_now(); });
  const NvImage present = kept();
  if (step.what == MemoryStep::What::save) {
    const std::string why = replace_text_file(step.file, to_json(present), ContentKind::nv_image);
    if (!why.empty()) throw StepError(step.file + ": cannot be written: " + why);
    return;
  }
  const std::optional<NvImage> wanted = read_nv_file(step.file);
  if (!wanted) throw StepError(step.file + ": does not exist; expected an NV image");
  const std::vector<std::string> lines = differences(present, *wanted);
  if (lines.empty()) return;
  throw StepError("the memory does not match " + step.file + ": " + lines.front(),
                  "the memory of " + step.file, lines.front(), {lines.begin() + 1, lines.end()});
}

}  // namespace understudy::emulator::play
