// The kinds of steps, one row each: the spelling in a file, the purpose, the schema of the value, and the
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
  /// Adds the step that `value` describes. In addition to the step's own key, the map `step` may contain only
  /// the keys in `beside`.
  void (*read)(StepsReader& reader, const world::YamlFields& step, const world::YamlFields& value);
  std::span<const world::Key> beside{};
  /// This is used when a step cannot be read: either later steps may need a name that this step defines, or
  /// this step needs a name from earlier steps that could not be read.
  enum class Names : std::uint8_t { none, gives, wants } names = Names::none;
};

/// Returns the rows in the order of the documentation.
std::span<const StepRow> step_rows();

inline constexpr std::array kIncludedKeys{world::kVersionKey,
                                          world::Key{"steps", "The steps to include.", &world::kSteps, true}};

}  // namespace understudy::emulator::play
