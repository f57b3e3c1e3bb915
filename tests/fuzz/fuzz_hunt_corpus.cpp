// Any text as a corpus of a hunt is refused line by line, or a line is a course that reads the same when it
// is written again. A course that fits the scenario can be played; how it ends does not matter.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "emulator/hunt/corpus.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/models/models.h"
#include "emulator/play/reading/scenario_file.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy::emulator;
using understudy::fuzzing::require;

constexpr std::size_t kLongest = 4096;
constexpr const char* kScenario = R"(understudy: 1
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
steps:
  - write: { feeder.Aaxis_SVON: 1 }
  - advance: 20ms
  - expect: { feeder.Aaxis_SVON: 1 }
hunt:
  may:
    - inject: { drop: feeder, of: { one_of: [ reply, request ] } }
    - inject: { stuck: feeder.DIN_2, level: on, for: { between: [ 1ms, 20ms ] } }
      times: 4
      within: 30ms
    - inject: { power_cut: feeder }
    - input: { feeder.DIN_3: { one_of: [ on, off ] } }
    - advance: { between: [ 1ms, 50ms ] }
)";

hunt::CoursePlayer& course_player() {
  static hunt::CoursePlayer one(
      std::make_shared<const play::Scenario>(
          play::parse_scenarios(models::all_models(), kScenario, "scenario.yaml").at(0)),
      models::all_models(), {});
  return one;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > kLongest) return 0;
  std::istringstream lines{std::string(understudy::fuzzing::text_of(data, size))};
  int played = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto parsed = hunt::parse_corpus_line(line);
    if (!parsed || !parsed->course) continue;
    hunt::Course course = *parsed->course;
    const auto again = hunt::parse_corpus_line(hunt::json_text(course));
    require(again && again->course == course, "a course reads as it was written");
    const bool fits =
        std::all_of(course.disturbances.begin(), course.disturbances.end(), [](const auto& one) {
          return hunt::is_possible(
              one, {.plan = course_player().plan(), .undisturbed = course_player().undisturbed()});
        });
    if (!fits || ++played > 4) continue;
    hunt::arrange(course.disturbances);
    course_player().play(course);
  }
  return 0;
}
