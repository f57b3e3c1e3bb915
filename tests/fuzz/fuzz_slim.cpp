// Any lines typed at a SLIM, at any moment, are answered in whole lines. Skipped ticks make no difference, a
// saved state is accepted back, and a host that leaves the current dialogue (ESC, an empty line, EXIT) gets
// replies again.
//
// An input is a byte of options, a byte that mixes all other choices (0: ours), then the typed text. Two
// values are not typed:
//   FE n   time passes (n's upper bits: in which steps)
//   FD n   a terminal of T0 gets a level (lower bits: which one; upper bits: how much)
#include <algorithm>
#include <compare>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/text/parse_real.h"
#include "emulator/models/slim/device.h"
#include "emulator/models/slim/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/fuzz/same_device.h"

namespace {

using namespace understudy;
using fuzzing::require;
using namespace std::chrono_literals;

constexpr std::size_t kLongestInput = 4096;
#ifdef UNDERSTUDY_REPLAYS_CORPUS
constexpr Tick kMaxTicks = 20'000;  // so that a run ends
#else
constexpr Tick kMaxTicks = 200;
#endif
constexpr SimTime kUntilQuiet = 1s;  // longer than any piece of a long text takes
constexpr int kMaxRounds = 600;      // a chain has no more output than its line can carry
constexpr std::uint8_t kTime = 0xFE;
constexpr std::uint8_t kLevel = 0xFD;

/// Choices with an option bit of their own, or that would change the properties checked here: how a line
/// ends, that EXIT is accepted and nothing starts after it, and that output is sent at all.
constexpr std::string_view kNotMixed[] = {
    "echo",         "prompt",          "query_reply",        "acknowledgement",
    "error_reply",  "failed_line",     "immediate_column",   "output_end",
    "flow_control", "get_number_exit", "while_program_runs", "events_without_program"};

struct Options {
  bool echo = false;
  bool prompt = false;
  bool names_values = false;
  bool acknowledges = false;
  bool keeps_errors_to_itself = false;
  bool lenient = false;  // columns that are not printed, and programs that continue after an error
  int modules = 1;
  std::uint8_t mix = 0;
};

Options options_of(std::uint8_t bits, std::uint8_t mix) {
  return {.echo = (bits & 1) != 0,
          .prompt = (bits & 2) != 0,
          .names_values = (bits & 4) != 0,
          .acknowledges = (bits & 8) != 0,
          .keeps_errors_to_itself = (bits & 16) != 0,
          .lenient = (bits & 32) != 0,
          .modules = 1 + (bits >> 6),
          .mix = mix};
}

/// One option of each choice, usually ours.
void mix_choices(std::uint8_t mix, std::map<std::string, std::string>& choices) {
  if (mix == 0) return;
  std::uint32_t number = mix;
  for (const ChoiceRow& row : emulator::models::slim::model().choices) {
    number = number * 1'664'525 + 1'013'904'223;
    if (std::ranges::find(kNotMixed, row.id) != std::end(kNotMixed)) continue;
    const auto options = options_of(row);
    const std::size_t which = (number >> 16) % (2 * options.size());
    if (which < options.size()) choices[std::string(row.id)] = options[which];
  }
}

emulator::world::Bench bench_for(const Options& options) {
  emulator::world::Bench bench;
  emulator::world::DeviceSetup device{.model = &emulator::models::slim::model(), .settings = {}};
  device.settings.name = "device";
  device.settings.bauds = {115200};  // a long listing takes its time
  device.settings.modules = options.modules;
  auto& choices = device.settings.choices;
  if (options.echo) choices["echo"] = "on";
  if (options.prompt) choices["prompt"] = "greater_than";
  if (options.names_values) choices["query_reply"] = "name_and_value";
  if (options.acknowledges) choices["acknowledgement"] = "ok";
  if (options.keeps_errors_to_itself) choices["error_reply"] = "nothing";
  if (options.lenient) choices["immediate_column"] = "taken";
  if (options.lenient) choices["failed_line"] = "is_passed_over";
  mix_choices(options.mix, choices);
  bench.devices.push_back(device);
  bench.lines.push_back(
      {.name = "line", .link = {}, .baud = 115200, .timing = pty::Timing::instant, .stations = {0}});
  return bench;
}

/// One chain in its own world, with its output.
class Listener {
 public:
  explicit Listener(const Options& options, bool in_bulk = true)
      : world_(bench_for(options), emulator::world::WorldOptions{}, {}),
        make_anew_(emulator::world::read_state(world_, save(world_))) {
    world_.set_bulk_ticks(in_bulk);
  }

  emulator::world::World& world() { return world_; }

  /// Everything is as it was at the start.
  void restart() {
    make_anew_();
    world_.take_output(0, line().output().size());
    sent_.clear();
  }

  void type(std::string_view bytes) {
    world_.receive(0, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    advance(0ns);
  }
  void advance(SimTime duration) {
    world_.advance_to(world_.now() + duration);
    const auto due = world_.next_due();
    require(!due || *due > world_.now(), "what is due has been done");
    const auto output = line().output();
    sent_.append(output.begin(), output.end());
    world_.take_output(0, output.size());
  }
  void set_terminal(std::size_t number, int level) {
    const auto terminals = emulator::models::slim::model().terminals;
    number %= emulator::models::slim::kFirstOutput;
    world_.set_external_input(0, static_cast<int>(number),
                              std::clamp(level, terminals[number].lowest, terminals[number].highest));
    advance(0ns);
  }

  /// Nothing more is sent without a request.
  bool comes_to_rest() {
    for (int round = 0; round < kMaxRounds; ++round) {
      const std::size_t before = sent_.size();
      advance(kUntilQuiet);
      if (sent_.size() == before) return true;
    }
    return false;
  }

  const emulator::Device& device() { return world_.device(0); }
  const pty::Line& line() const { return world_.line(0).line; }
  const std::string& sent() const { return sent_; }

 private:
  emulator::world::World world_;
  std::function<void()> make_anew_;
  std::string sent_;
};

Tick ticks_of(std::uint8_t code) {
  constexpr Tick kSteps[] = {1, 4, 25, 100};
  return kSteps[code >> 6] * (code & 0x3F);
}

/// Types everything, with the time that passes in between, `left` ticks at most.
void play(Listener& listener, std::string_view input, Tick left) {
  while (!input.empty()) {
    const std::size_t typed = std::min(input.size(), input.find_first_of("\xFE\xFD"));
    if (typed > 0) {
      listener.type(input.substr(0, typed));
      input.remove_prefix(typed);
      continue;
    }
    if (input.size() < 2) return;
    const auto what = static_cast<std::uint8_t>(input[0]);
    const auto code = static_cast<std::uint8_t>(input[1]);
    if (what == kTime) {
      const Tick ticks = std::min(left, ticks_of(code));
      left -= ticks;
      listener.advance(time_of(ticks));
    } else if (what == kLevel) {
      listener.set_terminal(code & 0x1F, (code >> 5) * 150);  // AIN has a thousand levels, the others two
    }
    input.remove_prefix(2);
  }
}

/// To be called at rest: a long text is sent in pieces. While time passes nothing reads here, so a program
/// that prints without end fills what the line can hold, and loses the rest.
void check_whole_lines(const Listener& listener, const Options& options) {
  const std::string& sent = listener.sent();
  const bool has_lost = listener.line().counters().bytes_discarded > 0;
  if (options.echo || options.prompt || sent.empty() || has_lost) return;
  if (sent.ends_with("\r\n")) return;
  std::fprintf(stderr, "...%s\n", sent.substr(sent.size() - std::min<std::size_t>(sent.size(), 80)).c_str());
  require(false, "what is said are whole lines");
}

/// A host that leaves the current dialogue gets replies again.
void check_answers_again(Listener& listener, const Options& options) {
  listener.type("\x1B\r");
  listener.type("EXIT\r");
  require(listener.comes_to_rest(), "it comes to rest");
  check_whole_lines(listener, options);
  const std::size_t before = listener.sent().size();
  listener.type("?PE\r");
  std::string answer = listener.sent().substr(before);
  const auto take_away = [&](std::string_view beginning, bool is_present) {
    if (!is_present) return;
    require(answer.starts_with(beginning), "an answer has what was chosen");
    answer.erase(0, beginning.size());
  };
  take_away("?PE\r\n", options.echo);
  take_away("PE=", options.names_values);
  const std::size_t end = answer.find("\r\n");
  require(end != std::string::npos, "?PE is answered with a line");
  require(answer.substr(end + 2) == (options.prompt ? ">" : ""), "and with nothing more");
  require(parse_real(answer.substr(0, end)).has_value(), "and the line is a number");
}

/// What the first two bytes of an input request.
struct Settings {
  std::uint8_t bits = 0;
  std::uint8_t mix = 0;
  auto operator<=>(const Settings&) const = default;
};

/// A search has few chains, which fit into the processor's cache: other bytes mean one of these. (To replay a
/// finding with such bytes, replace them by the pair that they mean.)
[[maybe_unused]] constexpr Settings kSearched[] = {
    {0x00, 0}, {0x40, 0}, {0x80, 0}, {0xC0, 0}, {0x03, 0}, {0x0C, 0}, {0x10, 0}, {0x20, 0},
    {0x60, 0}, {0x4F, 0}, {0x00, 1}, {0x40, 1}, {0x80, 2}, {0xC0, 2}, {0x20, 3}, {0x60, 3}};

Settings settings_of(std::uint8_t bits, std::uint8_t mix) {
  const Settings asked{bits, mix};
#ifdef UNDERSTUDY_REPLAYS_CORPUS
  return asked;
#else
  if (std::ranges::find(kSearched, asked) != std::end(kSearched)) return asked;
  return kSearched[(bits + mix) % std::size(kSearched)];
#endif
}

/// Two chains for one set of options; the second runs every tick. They are made on first use.
class Chains {
 public:
  Listener& listener(Settings settings) { return in(settings, listeners_, true); }
  Listener& stepped(Settings settings) { return in(settings, stepped_, false); }

 private:
  using All = std::map<Settings, std::unique_ptr<Listener>>;
  static Listener& in(Settings settings, All& all, bool in_bulk) {
    auto& made = all[settings];
    if (!made) made = std::make_unique<Listener>(options_of(settings.bits, settings.mix), in_bulk);
    return *made;
  }
  All listeners_;
  All stepped_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2 || size > kLongestInput) return 0;
  static Chains chains;
  const Settings settings = settings_of(data[0], data[1]);
  const Options options = options_of(settings.bits, settings.mix);
  const std::string_view input(reinterpret_cast<const char*>(data) + 2, size - 2);
  Listener& listener = chains.listener(settings);
  listener.restart();
  play(listener, input, kMaxTicks);
  if (!fuzzing::is_checked_wholly({data, size}, 32)) return 0;

  Listener& stepped = chains.stepped(settings);
  stepped.restart();
  play(stepped, input, kMaxTicks);
  require(stepped.sent() == listener.sent(), "ticks left out are not to be seen on the line");
  fuzzing::require_same_state(stepped.device(), listener.device(), "ticks left out leave the same state");

  stepped.restart();
  emulator::world::restore(stepped.world(), emulator::world::save(listener.world()));
  fuzzing::require_same_state(stepped.device(), listener.device(), "what is saved is taken back");

  check_answers_again(listener, options);
  return 0;
}
