// Programs are replaced while they run: by their own lines, by hosts, by the panel, by the power, by a
// restored state. Random, seeded (UNDERSTUDY_SEED). Each course runs again with freed memory filled with
// something else, and must be the same. Under a sanitizer, nothing may read freed memory.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/user_program.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/names/names.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "tests/emulator/world/debug/stopping_debugger.h"
#include "tests/emulator/world/stepping.h"
#include "tests/sanitized.h"

namespace understudy::emulator::world {
namespace replaced_programs_test {

using Texts = std::vector<std::string_view>;

/// A part of a program: its beginning, and lines that it may contain.
struct Part {
  const char* head;
  Texts lines;
};

/// The parts of programs in a language, and what hosts do to a device that runs them. `{3-9}` is one of these
/// numbers.
struct Language {
  const char* model;
  const char* settings;     // of the device, on the bench
  std::vector<Part> parts;  // some of them are omitted
  const char* tail;         // of each
  Texts writes;             // "D9001=1"
  Texts sent;               // commands, or lines of text
  Texts inputs;
};

/// Returns every instruction that stores to a place that may hold a program, a file or its state.
const Texts kStores{"MOV K{0-5} D9001",    "MOV K{0-5} D8002",    "INC D9001",
                    "DEC D9001",           "ADD D9001 K1 D9001",  "SUB K{1-4} K1 D9001",
                    "MUL K1 K{0-3} D9001", "DIV K{1-5} K2 D9001", "FMV K{0-4} D9000 K3",
                    "ZRST D9000 D9002",    "MOV K{0-3} D9002",    "MOV K{99-111} D8020",
                    "MOV K{0-9} D8000",    "MOV K{0-9} D8100",    "SET M8008",
                    "SET M{8000-8009}",    "RST M8{0-4}00",       "SET M8{1-4}02",
                    "RST M8{1-4}02",       "SET M{8508-8509}",    "STR * * * *",
                    "STP * * * *",         "STR K{0-1} K1 * K1",  "STP * K{0-1} * K{0-1}",
                    "INC D{0-3}",          "PSET K{0-9} * * *",   "MOV K{0-900} D9041",
                    "DRV K{0-900} * * *",  "HOM * * K1 *",        "NOP"};

Texts operator+(Texts some, const Texts& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

const Texts kOfSteps =
    kStores + Texts{"TMR K{1-4}", "VDRV * K{0-60} * *", "LD M{0-9}\nIF\nINC D9001\nELSE\nINC D5\nENDI"};
const Texts kOfC = kOfSteps + Texts{"LIN K{0-900} K{0-90} * *", "F K{100-9000}"};

const Texts kOfMacros{"RSM_MACRO_SET_VAR VAR{0-9} {0-99}",
                      "RSM_MACRO_VAR_CALCULATE VAR{0-9} + {0-9} VAR{0-9}", "RSM_MACRO_FRNET_OUT {0-1} {0-99}",
                      "RSM_MACRO_EXIT_MACRO"};
const Texts kOfMps = kOfMacros + Texts{"RSM_MACRO_MP_CALL {1-3}",
                                       "RSM_MACRO_TIMER {0-4}",
                                       "RSM_MACRO_FOR {1-3}\nRSM_MACRO_SET_VAR VAR1 {0-9}\nRSM_MACRO_NEXT",
                                       "RSM_MACRO_FIXED_MOVE X {1-90}",
                                       "RSM_MACRO_STOP_WAIT XYZU",
                                       "RSM_MACRO_STOP_SLOWLY X",
                                       "RSM_MACRO_MP_TERMINATE"};

const Language kLanguages[] = {
    {.model = "super-40nc",
     .settings = "set: { D9003: 4, D9391: 20 }",
     .parts = {{"AREA PLC\nLDP M{0-9}", kStores + Texts{"LDP M{0-9}"}},
               {"AREA C", kOfC},
               {"AREA X", kOfSteps},
               {"AREA Y", kOfSteps},
               {"AREA Z", kOfSteps},
               {"AREA U", kOfSteps},
               {"FILE 0", kOfC},
               {"FILE 1", kOfC},
               {"FILE {2-4}", kOfC}},
     .tail = "END",
     .writes = {"M8000={0-1}", "M8{1-4}00={0-1}", "M8{1-4}02={0-1}", "M8002=0", "M8006=1", "M8006=0",
                "M8508={0-1}", "M8509={0-1}", "M8595={0-1}", "M858{0-7}={0-1}", "M8008={0-1}", "D9001={0-5}",
                "D8000={0-9}", "D8100={0-9}", "D8020={98-111}", "D9045={1-1500}", "M{0-9}={0-1}",
                "M8501={0-1}", "M8507={0-1}"},
     .sent = {},
     .inputs = {"PLC_RUN", "CEMG", "X0", "X1"}},
    {.model = "simple2-r3",
     .settings = "set: { AutoStart_MainProg: 1 }",
     .parts = {{"again:",
                {"Out DOUT_{0-3} ON", "Out_ALL OFF", "Delay_mSec {0-9}", "Wait_IO DIN_{3-5} OFF",
                 "Jump again", "Loop again {1-5}", "VAR_Direct VAR{32-40} {0-99}", "VAR_Inc VAR{32-40}",
                 "VAR_Dec CalcREG", "SVON_A", "SVOFF_A", "MOVE_INC_A_Wait VAR{32-40}", "STOP_A",
                 "VAR_Copy VAR{32-40} Cord_A", "Counter_Increase 1", "NOP"}}},
     .tail = "END",
     .writes = {"PROG_MAIN_RunTime_START={0-9}", "PROG_MAIN_RunTime_END=1", "MAIN_LINE{0-9}_CMD={0-60}",
                "MAIN_LINE{0-9}_DATA1={0-60}", "MAIN_LINE{0-9}_JMP={0-3}", "PROG_MAIN_Erase_ALL=1",
                "Factory_Reset=1", "Aaxis_SVON={0-1}", "Aaxis_STOP=1", "PWD_Input={0-2}", "NEW_PWD={0-2}"},
     .sent = {},
     .inputs = {"DIN_3", "DIN_4"}},
    {.model = "rs-m8194h",
     .settings = "address: 1",
     .parts = {{"TRIGGER 8.0 on MP157\nTRIGGER 8.1 change abort_macro\nMP 157", kOfMps},
               {"MP 41", kOfMps},
               {"MP 156", kOfMps},
               {"ISR 19", kOfMacros},
               {"ISR {16-18}", kOfMacros}},
     .tail = "END",
     .writes = {"CALL_MPn={155-157}", "CALL_MPn=41", "FRnet Event={0-1}"},
     .sent = {"RSM_MP_CALL {156-157}", "RSM_MP_CALL 41", "RSM_MP_ISR_CALL {16-19}", "RSM_MP_TERMINATE",
              "RSM_RESET_CARD", "RSM_EMERGENCY_STOP {0-1}", "RSM_CLEAR_EMERGENCY_STOP", "RSM_MP_CREATE 156",
              "RSM_MP_CREATE 41", "RSM_MP_ISR_CREATE {16-19}", "RSM_MACRO_SET_VAR VAR{0-9} 7",
              "RSM_MACRO_TIMER 3", "RSM_MACRO_MP_CLOSE", "RSM_MACRO_MP_ISR_CLOSE", "RSM_FIXED_MOVE X {1-90}"},
     .inputs = {"DI_8_0", "DI_8_1", "EMG"}},
    {.model = "slim",
     .settings = "modules: 2",
     .parts = {{"$A N0=0", {"N{0-9}={0-99}", "R{0-9}={0-9}.5", "MR {0-90}",    "MA {0-90}",  "DN",
                            "WT {0-5}",      "JP $A",          "JZ N{0-3},$A", "CALL {0-9}", "RET",
                            "HON",           "HOFF",           "JGF",          "JG0",        "OUT N{0-9}",
                            "SET P{1-4}",    "CLR P{1-4}",     "ON EV1,{0-5}", "TASTOP",     "PZ",
                            "REDO",          "GETI",           "N1=GETI",      "RESET",      "CLR BUF"}}},
     .tail = "RET",
     .writes = {},
     .sent = {"G",     "G {0-5}", "EXIT",   "PG",     "PA",     "PE {0-5}", "PI {0-5}", "PD {0-5}", "DLP",
              "END",   "",        "\x1B",   "N2=N1",  "WT 2",   "MR 5",     "$A N0=1",  "JP $A",    "{0-99}",
              "RESET", "RESET H", "SAVE P", "SAVE D", "TASTOP", "DF",       "REDO",     "PZ",       "?N1"},
     .inputs = {"IN1", "IN2"}}};

class Course {
 public:
  /// Who observes its programs, and how its ticks run.
  enum class Looks { nobody, at_ticks_in_bulk, at_single_ticks, with_breakpoints };

  Course(const Language& language, std::uint64_t seed, Looks looks = Looks::nobody)
      : language_(language), random_(seed), world_(bench(), {}, {}) {
    if (looks != Looks::nobody) coverage_.emplace(world_);
    if (looks == Looks::with_breakpoints) debugging_.emplace(world_);
    world_.set_bulk_ticks(looks != Looks::at_single_ticks);
  }

  /// Its result.
  std::string run(int acts) {
    load();
    for (int i = 0; i < acts; ++i) {
      act();
      log_ += std::to_string(hash(world_)) + " ";
    }
    return log_;
  }
  int loaded() const { return loaded_; }
  int stops() const { return stops_; }
  CoverageReport coverage() const { return coverage_->report(); }

 private:
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  std::string any(const Texts& texts) {
    return filled(texts[static_cast<std::size_t>(below(static_cast<int>(texts.size())))]);
  }

  std::string filled(std::string_view text) {
    std::string made;
    for (std::size_t open = text.find('{'); open != std::string_view::npos; open = text.find('{')) {
      const std::size_t close = text.find('}', open);
      const std::string_view asked = text.substr(open + 1, close - open - 1);
      made += text.substr(0, open);
      made += answer(asked);
      text = text.substr(close + 1);
    }
    return made + std::string(text);
  }
  /// "3-9"
  std::string answer(std::string_view asked) {
    const std::size_t dash = asked.find('-');
    const int min = std::stoi(std::string(asked.substr(0, dash)));
    const int max = std::stoi(std::string(asked.substr(dash + 1)));
    return std::to_string(min + below(max - min + 1));
  }

  /// One in four is not the default.
  std::string choices(const Model& model) {
    std::string text;
    for (const ChoiceRow& row : model.choices) {
      const auto options = options_of(row);
      if (below(4) != 0 || options.size() < 2) continue;
      const auto option = options[static_cast<std::size_t>(below(static_cast<int>(options.size())))];
      text += (text.empty() ? "" : ", ") + std::string(row.id) + ": \"" + std::string(option) + "\"";
    }
    return "choices: { " + text + " }";
  }

  Bench bench() {
    const std::string text = "understudy: 1\nlines: { a: { timing: instant, stations: [ { name: m, model: " +
                             std::string(language_.model) + ", " + std::string(language_.settings) + ", " +
                             choices(*find_model(models::all_models(), language_.model)) + " } ] } }\n";
    return parse_bench(models::all_models(), text, "replaced.yaml", ".");
  }

  std::string program() {
    std::string text;
    for (const Part& part : language_.parts) {
      if (language_.parts.size() > 1 && below(3) == 0) continue;
      text += filled(part.head) + "\n";
      for (int i = 1 + below(8); i > 0; --i) text += any(part.lines) + "\n";
      text += std::string(language_.tail) + "\n";
    }
    return text;
  }

  void load() {
    const std::string text = program();
    try {
      world_.load_program(0, text);
      ++loaded_;
      if (debugging_) debugging_->set_some();
    } catch (const ProgramError& error) {
      log_ += "refused: " + in_text(error.first()) + "\n";
    }
  }

  void write() {
    const std::string text = any(language_.writes);
    const std::size_t equals = text.find('=');
    const NamedPlace place = find_register(world_.known(), text.substr(0, equals)).place;
    PreparedWrite prepared;
    Device& device = world_.device(0);
    if (prepare_value(*device.register_bank(), place, std::stoi(text.substr(equals + 1)), prepared) ==
        Refusal::none) {
      log_ += world_.write(0, prepared) == Refusal::none ? "" : "not written ";
    }
  }

  void say() {
    const std::string text = any(language_.sent);
    Device& device = world_.device(0);
    if (device.text_protocol() != nullptr && below(2) == 0) {
      const std::string line = text + "\r";
      world_.receive(0, std::vector<std::uint8_t>(line.begin(), line.end()));
    } else if (text.size() > 1) {
      log_ += world_.command(0, text).refusal == Refusal::none ? "" : "not taken ";
    }
  }

  void act() {
    switch (below(12)) {
      case 0: load(); break;
      case 1:
        world_.switch_power(0, false);
        if (below(2) == 0) wait();
        world_.switch_power(0, true);
        break;
      case 2: kept_ = save(world_); break;
      case 3:
        if (!kept_ || below(2) != 0) break;
        restore(world_, *kept_);
        if (debugging_) debugging_->debugger.restart();
        break;
      case 4: {
        const std::string terminal = any(language_.inputs);
        world_.set_external_input(0, find_terminal(world_.device(0).model(), terminal), below(2));
        break;
      }
      case 5: wait(); break;
      case 6: log_ += world_.device(0).user_program()->program_text(); break;
      case 7: log_ += std::to_string(world_.device(0).user_program()->program_locations().size()); break;
      default:
        if (!language_.writes.empty() && (language_.sent.empty() || below(2) == 0))
          write();
        else
          say();
        wait();
    }
    if (below(3) == 0) wait();
  }

  void wait() {
    const SimTime end = world_.now() + kTickLength * below(25);
    world_.advance_to(end);
    while (world_.now() < end) {
      EXPECT_TRUE(debugging_ && debugging_->debugger.take_stop()) << "an advance ends early only at stops";
      ++stops_;
      debugging_->step(stops_);
      world_.advance_to(end);
    }
  }

  const Language& language_;
  std::mt19937_64 random_;
  World world_;
  std::optional<ProgramCoverage> coverage_;
  std::optional<StoppingDebugger> debugging_;
  int stops_ = 0;
  std::optional<WorldState> kept_;
  std::string log_;
  int loaded_ = 0;
};

class ReplacedPrograms : public testing::TestWithParam<int> {};

TEST_P(ReplacedPrograms, AreTheSameWhateverFreedMemoryHolds) {
  const Language& language = kLanguages[GetParam()];
  const std::uint64_t first = seed_or(4711);
  const std::uint64_t courses = is_sanitized() ? 15 : 40;
  int loaded = 0;
  for (std::uint64_t seed = first; seed < first + courses; ++seed) {
    std::string usual;
    for (const int fill : {0, 90, 165}) {
      mallopt(M_PERTURB, fill);
      Course course(language, seed);
      const std::string reported = course.run(60);
      loaded += course.loaded();
      if (fill == 0) usual = reported;
      mallopt(M_PERTURB, 0);
      ASSERT_EQ(reported, usual) << language.model << ", UNDERSTUDY_SEED=" << seed << ", fill " << fill;
    }
  }
  EXPECT_GT(loaded, static_cast<int>(courses) * 9) << "hardly any program is accepted";
}

/// Nothing depends on an observer, and skipped ticks count as much as others.
TEST_P(ReplacedPrograms, AreCountedTheSameByAnyTicks) {
  const Language& language = kLanguages[GetParam()];
  const std::uint64_t first = seed_or(815);
  const std::uint64_t courses = is_sanitized() ? 10 : 60;
  CoverageReport all;
  for (std::uint64_t seed = first; seed < first + courses; ++seed) {
    const std::string unseen = Course(language, seed).run(60);
    Course bulk(language, seed, Course::Looks::at_ticks_in_bulk);
    ASSERT_EQ(bulk.run(60), unseen) << language.model << ", UNDERSTUDY_SEED=" << seed;
    Course single(language, seed, Course::Looks::at_single_ticks);
    ASSERT_EQ(single.run(60), unseen) << language.model << ", UNDERSTUDY_SEED=" << seed;
    ASSERT_EQ(bulk.coverage(), single.coverage())
        << language.model << ", UNDERSTUDY_SEED=" << seed << "\n"
        << lcov_text(bulk.coverage()) << lcov_text(single.coverage());
    all.add(bulk.coverage());
  }
  // Few programs of a SLIM are started, because hosts write them line by line.
  EXPECT_GT(all.files.size(), courses / 2);
  EXPECT_GT(all.totals().lines_run, static_cast<std::int64_t>(courses) / 2);
  EXPECT_LT(all.totals().lines_run, all.totals().lines);
}

/// A debugger only observes, wherever it stops.
TEST_P(ReplacedPrograms, AreTheSameWithBreakpointsAndSteps) {
  const Language& language = kLanguages[GetParam()];
  const std::uint64_t first = seed_or(2026);
  const std::uint64_t courses = is_sanitized() ? 10 : 200;
  int stops = 0;
  for (std::uint64_t seed = first; seed < first + courses; ++seed) {
    // A debugger needs single ticks. Another test proves that ticks in bulk have the same result.
    const std::string unseen = Course(language, seed, Course::Looks::at_single_ticks).run(20);
    Course course(language, seed, Course::Looks::with_breakpoints);
    ASSERT_EQ(course.run(20), unseen) << language.model << ", UNDERSTUDY_SEED=" << seed;
    stops += course.stops();
  }
  EXPECT_GT(stops, static_cast<int>(courses) * 5);
}

INSTANTIATE_TEST_SUITE_P(Of, ReplacedPrograms, testing::Range(0, 4), [](const auto& test) {
  std::string name = kLanguages[test.param].model;
  std::erase(name, '-');
  return name;
});

}  // namespace replaced_programs_test
}  // namespace understudy::emulator::world
