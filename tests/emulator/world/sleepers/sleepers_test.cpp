// Everything that matters to a sleeping device wakes it: a world that advances in long steps equals one that
// must run every tick, for whatever reason. Random courses of everything, for each controller; all readable
// values are compared at each stop. UNDERSTUDY_SEED and UNDERSTUDY_COURSES override.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>

#include "emulator/device/axes.h"
#include "emulator/device/named_values.h"
#include "emulator/device/register_map/access.h"
#include "emulator/models/models.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/outcome_hash.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/world/same_world.h"
#include "tests/emulator/world/sleepers/course.h"
#include "tests/emulator/world/sleepers/life.h"

#include "tests/emulator/world/stepping.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world::sleepers {
namespace sleepers_test {

using namespace std::chrono_literals;

std::uint64_t number_from(const char* name, std::uint64_t usual) {
  const char* const given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : usual;
}

/// How the other world is kept awake.
enum class Waker : std::uint8_t { single_ticks, waiting_fault, observer, odd_steps, what_is_due };
constexpr const char* kWakers[] = {"by single ticks", "beside a fault that waits", "before an observer",
                                   "by odd steps", "by what is due"};

testing::AssertionResult same_terminals(const World& plain, const World& awake, std::size_t d) {
  const Terminals* const one = plain.device(d).terminals();
  const Terminals* const other = awake.device(d).terminals();
  const auto rows = plain.device(d).model().terminals;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    const bool is_same =
        plain.device(d).input(i) == awake.device(d).input(i) && one->output(i) == other->output(i) &&
        one->analog_level(i) == other->analog_level(i) && one->output_pulses(i) == other->output_pulses(i);
    if (!is_same) return testing::AssertionFailure() << rows[static_cast<std::size_t>(i)].name << " differs";
  }
  return testing::AssertionSuccess();
}

/// Registers that show something; stored ones are in the state.
testing::AssertionResult same_views(const Device& one, const Device& other) {
  const RegisterBank* const bank = one.register_bank();
  for (const RegisterRow& row : register_rows(one.model())) {
    if (!row.is_view && row.reader == nullptr && row.fields.empty()) continue;
    for (int i = 0; i < row.count; ++i) {
      const auto address = static_cast<std::uint16_t>(row.address + i * row.stride);
      Place place = bank->at(row.table, address);
      if (!place) continue;  // not in this firmware
      place.part = Place::Part::whole;
      const Value plain = read_value(*bank, place);
      const Value awake = read_value(*other.register_bank(), place);
      if (plain != awake) {
        return testing::AssertionFailure()
               << RegisterMap::name_of(row, i) << ": " << plain << " against " << awake;
      }
    }
  }
  if (one.named_values() == nullptr) return testing::AssertionSuccess();
  for (const std::string& name : one.named_values()->names()) {
    if (one.named_values()->value_named(name) != other.named_values()->value_named(name))
      return testing::AssertionFailure() << name << " differs";
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult same_worlds(World& plain, World& awake) {
  for (std::size_t d = 0; d < plain.device_count(); ++d) {
    const Device& one = plain.device(d);
    const Device& other = awake.device(d);
    if (one.powered() != other.powered())
      return testing::AssertionFailure() << one.name() << ": the power differs";
    if (const auto same = same_state(one, other); !same) return same;
    if (const auto same = same_views(one, other); !same) return same;
    if (const auto same = same_terminals(plain, awake, d); !same) return same;
    for (int axis = 0; axis < static_cast<int>(one.model().axes.size()); ++axis) {
      if (const auto same = same_state(plain.plant(d, axis), awake.plant(d, axis)); !same) return same;
      if (plain.sent_pulses(d, axis) != awake.sent_pulses(d, axis))
        return testing::AssertionFailure() << "pulses of axis " << axis << " differ";
    }
  }
  for (std::size_t i = 0; i < plain.line_count(); ++i) {
    const auto sent = plain.line(i).line.output();
    const auto also_said = awake.line(i).line.output();
    if (!std::equal(sent.begin(), sent.end(), also_said.begin(), also_said.end()))
      return testing::AssertionFailure() << "the output of a line differs";
    const std::size_t size = sent.size();
    plain.take_output(i, size);
    awake.take_output(i, size);
  }
  return testing::AssertionSuccess();
}

/// Checks the promises of rows and outputs by single ticks, for a few registers in each tick that could be
/// skipped or fast-forwarded.
class Promises {
 public:
  Promises(const World& world, std::uint64_t seed) : draw_(seed) {
    const Device& device = world.device(0);
    for (const RegisterRow& row : register_rows(device.model())) {
      const bool shows = row.reader != nullptr || row.is_view || !row.fields.empty();
      if (!shows || row.moves() || row.varies == Varies::with_time) continue;
      for (int i = 0; i < row.count; ++i) {
        Place place =
            device.register_bank()->at(row.table, static_cast<std::uint16_t>(row.address + i * row.stride));
        place.part = Place::Part::whole;
        if (place) places_.push_back(place);
      }
    }
    const auto terminals = device.model().terminals;
    for (int i = 0; i < static_cast<int>(terminals.size()); ++i) {
      if (!is_input(terminals[static_cast<std::size_t>(i)].kind)) outputs_.push_back(i);
    }
  }

  void run_tick(World& world) {
    const SimTime next = time_of(tick_at(world.now()) + 1);
    const auto due = world.next_due();
    const bool may_be_left_out = !due || *due > next;
    const Device& device = world.device(0);
    std::vector<std::pair<Place, Value>> shown;
    std::vector<std::pair<int, bool>> outputs;
    for (int i = 0; i < 3 && may_be_left_out; ++i) {
      if (!places_.empty()) {
        const Place& place = draw_.one_of(places_);
        shown.emplace_back(place, read_value(*device.register_bank(), place));
      }
      const int output = outputs_.empty() ? -1 : draw_.one_of(outputs_);
      if (output >= 0 && !device.terminals()->output_moves(output))
        outputs.emplace_back(output, device.terminals()->output(output));
    }
    world.advance_to(next);
    for (const auto& [place, value] : shown) {
      EXPECT_EQ(read_value(*device.register_bank(), place), value)
          << RegisterMap::name_of(*place.row, place.index)
          << " is reported as changing in ticks that are run";
    }
    for (const auto& [output, level] : outputs) {
      EXPECT_EQ(device.terminals()->output(output), level)
          << device.model().terminals[static_cast<std::size_t>(output)].name
          << " is reported as changing in ticks that are run";
    }
  }

 private:
  Draw draw_;
  std::vector<Place> places_;
  std::vector<int> outputs_;
};

/// Two worlds of one course.
class Pair {
 public:
  Pair(const Course& course, std::uint64_t seed)
      : waker_(static_cast<Waker>(seed % 5)), plain_(course.bench, {}, {}), awake_(course.bench, {}, {}) {
    if (waker_ == Waker::waiting_fault) {
      awake_.inject(find_fault(awake_.known(), {"drop", "b", {{"when", "time < 0s"}}}));
    } else if (waker_ == Waker::observer) {
      observer_.emplace(awake_);
      awake_.add_watcher(*observer_);
    } else if (waker_ == Waker::odd_steps) {
      step_ = by_odd_steps(seed);
    } else if (waker_ == Waker::what_is_due) {
      step_ = by_what_is_due;
    } else {
      awake_.set_bulk_ticks(false);
      step_ = [promises = Promises(awake_, seed)](World& world, SimTime to) mutable {
        while (time_of(tick_at(world.now()) + 1) <= to) promises.run_tick(world);
        world.advance_to(to);
      };
    }
  }
  ~Pair() {
    if (observer_) awake_.remove_watcher(*observer_);
  }

  const char* waker() const { return kWakers[static_cast<std::size_t>(waker_)]; }
  std::uint64_t skipped() const { return plain_.ticks_skipped(); }
  std::uint64_t run() const { return plain_.ticks_run(); }
  void carry_out(const Act& act) {
    act.carry_out(plain_);
    act.carry_out(awake_);
  }
  testing::AssertionResult advance(SimTime time) {
    const SimTime to = plain_.now() + time;
    plain_.advance_to(to);
    step_(awake_, to);
    return same_worlds(plain_, awake_);
  }

 private:
  Waker waker_;
  World plain_;
  World awake_;
  std::optional<OutcomeHash> observer_;
  Stepping step_ = [](World& world, SimTime to) { world.advance_to(to); };
};

constexpr std::uint64_t kCourses = 100;  // of each model; 10,000 have been tried

class Sleepers : public testing::TestWithParam<const char*> {};

TEST_P(Sleepers, AreWokenByAllThatMattersToThem) {
  const std::uint64_t first = number_from("UNDERSTUDY_SEED", 3'200'000);
  const std::uint64_t courses =
      number_from("UNDERSTUDY_COURSES", fewer_if_sanitized<std::uint64_t>(kCourses, 6));
  std::uint64_t skipped = 0;
  std::uint64_t run = 0;
  int differ = 0;
  for (std::uint64_t seed = first; seed < first + courses; ++seed) {
    const Course course = course_of(GetParam(), seed);
    Pair pair(course, seed);
    std::string reported;
    bool is_same = true;
    for (const Act& act : course.acts) {
      testing::AssertionResult same = pair.advance(act.before);
      reported += std::to_string(act.before.count()) + "ns later: " + act.words + "\n";
      if (same) {
        pair.carry_out(act);
        same = pair.advance(0ns);
      }
      if (!same) {
        ADD_FAILURE() << "UNDERSTUDY_SEED=" << seed << " UNDERSTUDY_COURSES=1, " << pair.waker() << ": "
                      << same.message() << "\n"
                      << (courses == 1 ? course.bench_text + reported : "");
        is_same = false;
        break;
      }
    }
    if (is_same && !pair.advance(5s)) {
      ADD_FAILURE() << "UNDERSTUDY_SEED=" << seed << " UNDERSTUDY_COURSES=1, " << pair.waker()
                    << " at the end";
      is_same = false;
    }
    differ += is_same ? 0 : 1;
    ASSERT_LT(differ, 12) << "in " << seed - first + 1 << " courses";
    skipped += pair.skipped();
    run += pair.run();
  }
  std::cout << GetParam() << ": " << courses << " courses, " << skipped << " ticks crossed, " << run
            << " run\n";
  EXPECT_GT(skipped, 500 * courses) << "meaningful only if many are";
  EXPECT_GT(run, 100 * courses);
}

INSTANTIATE_TEST_SUITE_P(Of, Sleepers,
                         testing::Values("simple2-r3", "super-40nc", "rs-m8194h", "slim", "imported"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(SleepersTable, HasALifeForEveryModel) {
  for (const Model* model : models::all_models()) EXPECT_NE(life_of(model->name), nullptr) << model->name;
}

}  // namespace sleepers_test
}  // namespace understudy::emulator::world::sleepers
