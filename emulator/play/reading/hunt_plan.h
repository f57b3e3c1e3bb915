// Reads `hunt` in a scenario file: the disturbances that may occur in the scenario, and the conditions that
// must remain true. A course is the scenario with some of these disturbances, each with drawn values at a
// drawn moment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/reading/variation.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

class StepsReader;

/// The step in the file from which a step of the scenario was created. Some steps in a file become several
/// steps of the scenario.
struct WrittenStep {
  world::YamlFields fields;
  bool continues = false;  // created from the same step in the file as the previous step
};

/// A disturbance in a course.
struct Disturbance {
  std::size_t entry = 0;  // an index into the entries of `may`
  std::size_t step = 0;   // it happens before this step of the scenario
  enum class When : std::uint8_t {
    here,  // immediately
    at,    // a fault that waits for a time
    nth,   // a fault that waits for a message
    late,  // a step that waits for a time, while the command runs
  } when = When::here;
  std::int64_t moment = 0;            // the time in nanoseconds, or the number of the message
  std::vector<std::uint64_t> values;  // for each value, its position in its range, in written order

  bool operator==(const Disturbance&) const = default;
};

class HuntPlan {
 public:
  /// An entry of `may`.
  struct Entry {
    world::YamlFields step;         // includes values that have not been drawn yet
    std::vector<Variation> values;  // in the order in which they are written
    std::size_t max = 1;            // how often it may occur
    SimTime within{-1};             // the time within which all of them occur; negative: at any time
    std::size_t first = 0;          // the range of steps before which it may occur
    std::size_t last = 0;
    std::size_t at_step = 0;  // the step before which it is placed if it then waits for a time or a message
    std::vector<Disturbance::When> ways;  // the kinds of moments that it may have
    bool has_end = false;                 // a fault that ends by itself
  };

  /// Reads `hunt`. `head` contains the keys of the file that do not concern steps, and `steps` has an entry
  /// for each step of the scenario. Checks everything with `reader`. Throws FileError.
  HuntPlan(const world::YamlFields& hunt, const world::YamlFields& head, std::vector<WrittenStep> steps,
           StepsReader& reader);

  const std::vector<Entry>& entries() const { return entries_; }
  const world::YamlFields& head() const { return head_; }
  /// Returns the steps as written in the file, with parameters replaced and loops unrolled.
  const std::vector<WrittenStep>& steps() const { return steps_; }
  /// Returns true if a disturbance may occur before that step.
  bool has_room_before(std::size_t step) const { return step < steps_.size() && !steps_[step].continues; }
  /// Returns the steps that check the conditions, which precede all other steps.
  const std::vector<world::YamlFields>& spans() const { return spans_; }
  /// Returns a disturbance as a step, without the wait for its moment.
  world::YamlFields step_of(const Disturbance& disturbance) const;
  /// Returns all steps of a disturbance.
  std::vector<world::YamlFields> steps_of(const Disturbance& disturbance) const;

 private:
  void read_entry(const world::YamlFields& field, StepsReader& reader);
  void read_ways(Entry& entry, StepsReader& reader);
  void read_ways_of_fault(Entry& entry, StepsReader& reader);
  void check_values(const Entry& entry, StepsReader& reader) const;
  void read_spans(const world::YamlFields& hunt, StepsReader& reader);
  std::size_t step_called(const world::YamlFields& field) const;

  world::YamlFields head_;
  std::vector<WrittenStep> steps_;
  std::vector<world::YamlFields> spans_;
  std::vector<Entry> entries_;
  std::size_t first_ = 0;
  std::size_t last_ = 0;
};

}  // namespace understudy::emulator::play
