// The kinds of steps, a row each: its spelling in a file, its purpose, the schema of its value, and its
// reader. A new kind needs a row here, a struct in scenario.h, and its code in a performance.
#pragma once

#include <array>
#include <span>

#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::world {
class YamlFields;
}

namespace understudy::emulator::play {

class StepsReader;

struct StepRow {
  world::Key key;
  /// Adds the step that `value` describes. Besides it, the map `step` may only have the keys of `beside`.
  void (*read)(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
  std::span<const world::Key> beside{};
  /// This matters when a step cannot be read: later steps may need a name that it gives, or it wants a name
  /// of earlier steps that could not be read.
  enum class Names : std::uint8_t { none, gives, wants } names = Names::none;
};

/// Returns the rows in the order of the documentation.
std::span<const StepRow> step_rows();

inline constexpr std::array kIncludedKeys{world::kVersionKey,
                                          world::Key{"steps", "The steps to include.", &world::kSteps, true}};

}  // namespace understudy::emulator::play
