// Reads steps that control the order of other steps: snapshot, restore, fork, repeat, for, include.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/step_readers.h"
#include "emulator/play/reading/step_schemas.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::play {

namespace {

void define(const world::YamlFields& field, Parameters& parameters, const std::string& name,
            const std::string& value) {
  try {
    parameters.define(name, value);
  } catch (const world::NameError& error) {
    field.fail(error.what());
  }
}

}  // namespace

void read_snapshot(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  const std::string name = value.text();
  if (name.empty()) value.fail("is empty; expected a name");
  // NOLINTNEXTLINE(cppcoreguidelines-slicing): intended; a snapshot keeps only the StoryMoment part
  reader.story().snapshots[name] = reader.story();
  reader.add(step, "snapshot " + name, SnapshotStep{name});
}

void read_restore(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  const std::string name = value.text();
  const auto& snapshots = reader.story().snapshots;
  const auto it = snapshots.find(name);
  if (it == snapshots.end()) {
    std::vector<std::string> names;
    for (const auto& [known, moment] : snapshots) names.push_back(known);
    value.fail("no earlier snapshot is called " + quoted(name) + suggestion(name, names));
  }
  static_cast<StoryMoment&>(reader.story()) = StoryMoment(it->second);
  reader.add(step, "restore " + name, RestoreStep{name});
}

void read_fork(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value) {
  value.require_map();
  ForkStep fork;
  std::string text = "fork";
  for (const auto& [name, steps] : value.entries()) {
    text += (fork.branches.empty() ? " " : ", ") + name;
    fork.branches.push_back({.name = name, .steps = reader.read_branch(steps)});
  }
  if (fork.branches.empty()) value.fail("is empty; expected branches by name");
  reader.add(step, text, std::move(fork));
}

void read_repeat(StepsReader& reader, const world::YamlFields& /*step*/, const world::YamlFields& value) {
  reader.attempt([&] { value.require_keys(kRepeatKeys); });
  std::int64_t times = 1;
  reader.attempt([&] { times = value.at("times").integer(kTimesSchema); });
  const world::YamlFields steps = value.at("steps");
  const auto as = value.find("as");
  for (std::int64_t round = 1; round <= times; ++round) {
    Parameters inner(reader.parameters());
    if (as) define(*as, inner, as->text(), std::to_string(round));
    reader.read_here(steps, inner);
    if (reader.has_diagnostics()) return;
  }
}

void read_for(StepsReader& reader, const world::YamlFields& /*step*/, const world::YamlFields& value) {
  reader.attempt([&] { value.require_keys(kForKeys); });
  const auto rows = value.at("each").elements();
  if (rows.empty()) value.at("each").fail("is empty; expected at least one value");
  const auto as = value.find("as");
  const world::YamlFields steps = value.at("steps");
  for (const world::YamlFields& row : rows) {
    Parameters inner(reader.parameters());
    if (row.is_map()) {
      if (as) as->fail("is not needed, because the rows name their values; expected no `as`");
      row.require_map();
      for (const auto& [name, field] : row.entries()) define(field, inner, name, field.text());
    } else {
      define(as ? *as : value, inner, value.at("as").text(), row.text());
    }
    reader.read_here(steps, inner);
    if (reader.has_diagnostics()) return;
  }
}

void read_include(StepsReader& reader, const world::YamlFields& /*step*/, const world::YamlFields& value) {
  reader.read_included(value);
}

}  // namespace understudy::emulator::play
