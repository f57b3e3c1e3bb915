// The kinds of steps, a row each: how a file spells it, what it is for, what its value looks like and who
// reads it. A new kind is a row here, a struct in scenario.h, and what a performance does for it.
#pragma once

#include <array>
#include <span>

#include "emulator/world/bench_file/bench_form.h"
#include "emulator/world/bench_file/form.h"

namespace understudy::emulator::world {
class YamlFields;
}

namespace understudy::emulator::play {

class StepsReader;

struct StepRow {
  world::KeyRow key;
  /// Adds the step that `value` describes. It stands in the map `step`, which may have no other keys than
  /// those of `beside`.
  void (*read)(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
  std::span<const world::KeyRow> beside{};
  /// If it cannot be read: whether other steps may need a name that it would have given, or it one of theirs.
  enum class Names : std::uint8_t { none, gives, wants } names = Names::none;
};

/// In the order of the documentation.
std::span<const StepRow> step_rows();

inline constexpr std::array kIncludedKeys{
    world::kVersionKey, world::KeyRow{"steps", "The steps to include.", &world::kSteps, true}};

}  // namespace understudy::emulator::play
