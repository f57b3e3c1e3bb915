// The kinds of steps, one row each: spelling in a file, purpose, schema of the value, and reader. A new kind
// needs a row here, a struct in scenario.h, and its code in a performance.
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
  /// Adds the step that `value` describes. Apart from `value`, the map `step` may have only the keys in
  /// `beside`.
  void (*read)(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
  std::span<const world::Key> beside{};
  /// This matters when a step cannot be read: later steps may need a name that it gives, or the step wants a
  /// name from earlier steps that could not be read.
  enum class Names : std::uint8_t { none, gives, wants } names = Names::none;
};

/// Returns the rows in the order of the documentation.
std::span<const StepRow> step_rows();

inline constexpr std::array kIncludedKeys{world::kVersionKey,
                                          world::Key{"steps", "The steps to include.", &world::kSteps, true}};

}  // namespace understudy::emulator::play
