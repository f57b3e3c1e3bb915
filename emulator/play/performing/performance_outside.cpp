// Steps that act on the bench from outside: inputs, faults, power, programs, memories.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/files/text_file.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

/// What differs, a line each: registers by name; one that an image leaves out has the factory's value.
std::vector<std::string> differences(const NvImage& present, const NvImage& wanted) {
  std::vector<std::string> lines;
  const auto has_other_model = present.model != wanted.model;
  if (has_other_model) lines.push_back("model is " + present.model + "; expected " + wanted.model);
  const std::map<std::string, std::int64_t> is(present.registers.begin(), present.registers.end());
  const std::map<std::string, std::int64_t> should_be(wanted.registers.begin(), wanted.registers.end());
  const auto text = [](const auto& registers, const std::string& name) {
    const auto found = registers.find(name);
    return found == registers.end() ? std::string("the factory's value") : std::to_string(found->second);
  };
  const auto compare = [&](const std::string& name) {
    lines.push_back(name + " is " + text(is, name) + "; expected " + text(should_be, name));
  };
  for (const auto& [name, value] : present.registers) {  // in the order of the model's table
    const auto found = should_be.find(name);
    if (found == should_be.end() || found->second != value) compare(name);
  }
  for (const auto& [name, value] : wanted.registers) {
    if (!is.contains(name)) compare(name);
  }
  return lines;
}

}  // namespace

void Performance::perform(const InputStep& step) {
  stage_->with_world([&](world::World& world) {
    for (const world::InputSetup& input : step.inputs) {
      world.set_external_input(input.device, input.terminal, input.level);
    }
  });
}

void Performance::perform(const TurnStep& step) {
  stage_->with_world([&](world::World& world) {
    for (const world::Fault& turn : step.turns) world.inject(turn);
  });
}

void Performance::perform(const InjectStep& step) {
  stage_->with_world([&](world::World& world) { faults_.emplace_back(step.name, world.inject(step.fault)); });
}

void Performance::perform(const ClearStep& step) {
  bool was_there = step.name.empty();
  stage_->with_world([&](world::World& world) {
    if (step.name.empty()) {
      world.clear_faults();
      faults_.clear();
    }
    std::erase_if(faults_, [&](const auto& fault) {
      if (fault.first != step.name) return false;
      world.clear_fault(fault.second);  // one that was over at once is mended as well
      return was_there = true;
    });
  });
  if (!was_there) throw StepError("no fault called '" + step.name + "' is in force; expected one");
}

void Performance::perform(const PowerStep& step) {
  stage_->with_world([&](world::World& world) {
    for (const auto& [device, to] : step.devices) {
      if (to != PowerStep::To::on) world.switch_power(device, false);
      if (to != PowerStep::To::off) world.switch_power(device, true);
    }
  });
}

void Performance::perform(const ProgramStep& step) {
  stage_->with_world([&](world::World& world) {
    const Device& device = world.device(step.device);
    if (!device.powered()) throw StepError(device.name() + " has no power; expected it switched on");
    try {
      world.load_program(step.device, step.text);
    } catch (const ProgramError& error) {
      const std::string line = error.line == 0 ? "" : ":" + std::to_string(error.line);
      throw StepError(step.file + line + ": " + error.what());
    }
  });
}

void Performance::perform(const MemoryStep& step) {
  NvImage present;
  stage_->with_world([&](world::World& world) { present = world.device(step.device).memory()->nv_image(); });
  if (step.what == MemoryStep::What::save) {
    std::string why = why_not_replaceable_by_image(step.file);
    if (why.empty()) why = replace_text_file(step.file, to_json(present));
    if (!why.empty()) throw StepError(step.file + ": cannot be written: " + why);
    return;
  }
  const std::optional<NvImage> wanted = read_nv_file(step.file);
  if (!wanted) throw StepError(step.file + ": there is no such file; expected the image of a memory");
  const std::vector<std::string> lines = differences(present, *wanted);
  if (lines.empty()) return;
  throw StepError("the memory is not that of " + step.file + ": " + lines.front(),
                  "the memory of " + step.file, lines.front(), {lines.begin() + 1, lines.end()});
}

}  // namespace understudy::emulator::play
