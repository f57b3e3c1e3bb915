// Reads steps that act on the bench from outside: inputs, faults, power, programs, memories.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_error.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/step_schemas.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/disturbance_fields.h"
#include "emulator/world/faults/fault.h"

namespace understudy::emulator::play {

namespace {

std::vector<std::pair<std::string, world::YamlFields>> require_entries(const world::YamlFields& value,
                                                                       const std::string& example) {
  value.require_map();
  auto entries = value.entries();
  if (entries.empty()) value.fail("is empty; expected entries such as `{ " + example + " }`");
  return entries;
}

/// Returns the text that the message of a refusal must contain. For `true`, any message is accepted.
std::string refusal_text(const world::YamlFields& field) {
  const std::string text = field.text();
  if (text == "false" || text.empty()) {
    field.fail("expected true, or part of the message about the first mistake");
  }
  return text == "true" ? "" : text;
}

}  // namespace

void read_inputs(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  InputStep inputs;
  std::string text = "input";
  const auto read = [&](const std::string& name, const world::YamlFields& field) {
    const world::InputSetup input = world::read_input(field, name, reader.trial().known());
    for (const world::InputSetup& other : inputs.inputs) {
      if (other.device == input.device && other.terminal == input.terminal) {
        field.fail("is an input that is already in this step; expected each input only once");
      }
    }
    text += (inputs.inputs.empty() ? " " : ", ") + name + "=" + field.text();
    inputs.inputs.push_back(input);
  };
  for (const auto& [name, field] : require_entries(value, "feeder.DIN_10: on"))
    reader.attempt([&, &its_name = name, &its_field = field] { read(its_name, its_field); });
  reader.add(step, text, std::move(inputs));
}

void read_turn(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  TurnStep turn;
  std::string text = "turn";
  const auto entries = require_entries(value, "mill.MPG: 400, in: 2s");
  const auto in = value.find("in");
  for (const auto& [name, field] : entries) {
    if (name == "in") continue;
    reader.attempt([&, &its_name = name, &its_field = field] {
      text += (turn.turns.empty() ? " " : ", ") + its_name + " by " + its_field.text();
      turn.turns.push_back(reader.trial().turn(its_field, in ? &*in : nullptr, its_name));
    });
  }
  if (entries.size() == (in ? 1U : 0U))
    value.fail("turns nothing; expected counts such as `{ mill.MPG: 400, in: 2s }`");
  if (in) text += " in " + in->text();
  reader.add(step, text, std::move(turn));
}

void read_inject(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  InjectStep inject;
  std::string fault;
  const bool is_read = reader.attempt([&] {
    inject.fault = reader.trial().fault(value, "name");
    fault = world::to_text(reader.trial().known(), inject.fault);
  });
  inject.name = fault;
  auto& in_force = reader.story().faults;
  if (value.is_map() && value.has("name")) {
    inject.name = value.at("name").text();
    if (inject.name.empty() || inject.name == "all") {
      value.at("name").fail(understudy::quoted(inject.name) +
                            " cannot be the name of a fault; expected another name");
    }
    if (std::find(in_force.begin(), in_force.end(), inject.name) != in_force.end()) {
      value.at("name").fail(understudy::quoted(inject.name) +
                            " is already in force; expected another name, or a `clear` first");
    }
  }
  if (!is_read) return;
  in_force.push_back(inject.name);
  const std::string text = "inject " + fault + (inject.name == fault ? "" : " as " + inject.name);
  reader.add(step, text, std::move(inject));
}

void read_clear(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  const std::string name = value.text();
  auto& in_force = reader.story().faults;
  if (name == "all") {
    in_force.clear();
    reader.add(step, "clear all", ClearStep{});
    return;
  }
  if (std::find(in_force.begin(), in_force.end(), name) == in_force.end()) {
    value.fail("no fault in force here is called " + understudy::quoted(name) + suggestion(name, in_force));
  }
  std::erase(in_force, name);
  reader.add(step, "clear " + name, ClearStep{name});
}

void read_power(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  PowerStep power;
  std::string text = "power";
  const auto read = [&](const std::string& name, const world::YamlFields& field) {
    const std::size_t device = reader.trial().device(field, name);
    const std::string word = field.text();
    const auto it = std::find(kPowerWords.begin(), kPowerWords.end(), word);
    if (it == kPowerWords.end())
      field.fail(understudy::quoted(word) + " is unknown; expected on, off or cycle");
    text += (power.devices.empty() ? " " : ", ") + name + " " + word;
    power.devices.emplace_back(device, word == "on"    ? PowerStep::To::on
                                       : word == "off" ? PowerStep::To::off
                                                       : PowerStep::To::cycle);
  };
  for (const auto& [name, field] : require_entries(value, "feeder: off"))
    reader.attempt([&, &its_name = name, &its_field = field] { read(its_name, its_field); });
  reader.add(step, text, std::move(power));
}

namespace {

void read_one_program(StepsReader& reader, const world::YamlFields& step, const std::string& name,
                      const world::YamlFields& field) {
  ProgramStep program;
  reader.attempt([&] {
    if (const auto refused = step.find("refused")) program.refused = refusal_text(*refused);
  });
  program.device = reader.trial().device(field, name);
  // The field contains the path of a listing, or, if it has several lines, the listing itself.
  std::string text = "program " + name;
  if (field.text().find('\n') != std::string::npos) {
    program.text = field.text();
    program.inside = field.inline_text();
  } else {
    program.file = field.path();
    const auto listing = read_text_file(program.file);
    if (!listing) field.fail(program.file + " " + listing.why + "; expected a listing");
    if (const std::string why = is_another_kind(*listing, ContentKind::program); !why.empty()) {
      field.fail(program.file + " " + why);
    }
    program.text = *listing;
    reader.add_file(program.file, "a program that a step loads");
    text += " " + field.text();
  }
  if (step.has("refused")) {
    text += " (refused)";
  } else {
    reader.trial().require_program(field, program);
  }
  reader.add(step, text, std::move(program));
}

void read_compared_memory(StepsReader& reader, const world::YamlFields& step, const std::string& name,
                          const world::YamlFields& field) {
  MemoryStep memory{
      .what = MemoryStep::What::expect, .device = reader.trial().device(field, name), .file = field.path()};
  if (!reader.story().saved.contains(memory.file)) {
    std::optional<NvImage> image;
    try {
      image = read_nv_file(memory.file);
    } catch (const FileError& error) {
      field.fail(error.what());
    }
    if (!image) field.fail(memory.file + " " + why_not_readable(memory.file) + "; expected an NV image");
    reader.trial().require_memory(field, memory.device, *image);
    reader.add_file(memory.file, "a memory that a step compares with");
  }
  reader.add(step, "memory " + name + " " + field.text(), std::move(memory));
}

void read_saved_memory(StepsReader& reader, const world::YamlFields& step, const std::string& name,
                       const world::YamlFields& field) {
  MemoryStep memory{
      .what = MemoryStep::What::save, .device = reader.trial().device(field, name), .file = field.path()};
  const std::string folder = std::filesystem::path(memory.file).parent_path().string();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    field.fail(folder + " is not a folder; expected a folder for the file");
  }
  reader.story().saved.insert(memory.file);
  reader.add_saved(memory.file, field);
  reader.add(step, "save " + name + " " + field.text(), std::move(memory));
}

/// Reads a map with an entry for each device.
template <typename ReadOne>
void read_each(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value,
               const std::string& example, ReadOne read_one) {
  for (const auto& [name, field] : require_entries(value, example)) {
    reader.attempt(
        [&, &its_name = name, &its_field = field] { read_one(reader, step, its_name, its_field); });
  }
}

}  // namespace

void read_program(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  read_each(reader, step, value, "feeder: indexing.lst", read_one_program);
}

void read_memory(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  read_each(reader, step, value, "feeder: after.json", read_compared_memory);
}

void read_save(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  read_each(reader, step, value, "feeder: after.json", read_saved_memory);
}

}  // namespace understudy::emulator::play
