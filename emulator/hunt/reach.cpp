#include "emulator/hunt/reach.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/program_watch.h"
#include "base/simulated_time.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/results/result.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/outside.h"
#include "emulator/world/world.h"
#include "pty/line_observer.h"

namespace understudy::emulator::hunt {

namespace {

constexpr std::size_t kMaxRegisters = 64;  // of a device whose values are sampled
constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;

/// Mixes a number into a hash.
constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t number) {
  std::uint64_t x = hash ^ (number + kGolden + (hash << 6) + (hash >> 2));
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Returns a class of values by sign and number of binary digits: 0, 1, 2 to 3, 4 to 7, and so on.
std::uint64_t class_of(std::int64_t value) {
  const auto magnitude = static_cast<std::uint64_t>(value < 0 ? -value : value);
  return static_cast<std::uint64_t>(std::bit_width(magnitude)) * 2 + (value < 0 ? 1 : 0);
}

class Reach;

/// Notes the lines of one device's program.
class Lines final : public ProgramWatch {
 public:
  Lines(Reach& reach, std::size_t device, UserProgram& program)
      : reach_(reach), device_(device), program_(program) {
    program_.add_watch(*this);
  }
  ~Lines() override { program_.remove_watch(*this); }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  void program_loaded(std::uint64_t mark) override {
    if (mark == mark_) return;
    mark_ = mark;
    seen_.clear();
  }
  void runs(int part, int line, std::int64_t) override { see(part, line, 1); }
  void decides(int part, int line, bool outcome, std::int64_t) override { see(part, line, outcome ? 2 : 4); }

 private:
  void see(int part, int line, std::uint8_t what);

  Reach& reach_;
  std::size_t device_;
  UserProgram& program_;
  std::uint64_t mark_ = 0;
  std::vector<std::vector<std::uint8_t>> seen_;  // by part and line
};

/// The values of one device that are sampled.
struct Sights {
  std::vector<Place> words;    // registers with named bits
  std::vector<Place> numbers;  // other registers that the device shows
  std::vector<TerminalView> terminals;
};

bool is_shown(const RegisterRow& row) {
  if (row.reader != nullptr) return true;
  for (const BitField& field : row.fields) {
    if (field.reader != nullptr) return true;
  }
  return false;
}

Sights sights_of(const Device& device) {
  Sights sights;
  if (const RegisterBank* const bank = device.register_bank()) {
    for (const RegisterRow& row : bank->map().rows()) {
      const bool is_bit = row.table == Table::coil || row.table == Table::discrete;
      if (is_bit || row.access == Access::write || !bank->has_row(row) || !is_shown(row)) continue;
      Place place = bank->at(row.table, row.address);
      place.part = RegisterPart::whole;
      auto& list = row.fields.empty() ? sights.numbers : sights.words;
      if (place && list.size() < kMaxRegisters) list.push_back(place);
    }
  }
  if (device.terminals() == nullptr) return sights;
  for (TerminalView& view : terminal_views(device)) {
    if (view.what != TerminalView::What::pulses && !is_in_millivolts(view.kind) &&
        view.kind != TerminalRow::Kind::counted_in)
      sights.terminals.push_back(std::move(view));
  }
  return sights;
}

class Reach final : public play::Observer, private pty::LineObserver, private world::OutsideListener {
 public:
  Reach(world::World& world, Reached& reached) : world_(world), reached_(reached), last_(reached.last) {
    if (!std::exchange(reached.goes_on, false)) last_ = {};
    for (std::size_t d = 0; d < world_.device_count(); ++d) {
      sights_.push_back(sights_of(world_.device(d)));
      if (UserProgram* const program = world_.device(d).user_program())
        lines_.push_back(std::make_unique<Lines>(*this, d, *program));
    }
    for (std::size_t l = 0; l < world_.line_count(); ++l) world_.add_observer(l, *this);
    world_.add_listener(*this);
  }
  ~Reach() override {
    world_.remove_listener(*this);
    for (std::size_t l = 0; l < world_.line_count(); ++l) world_.remove_observer(l, *this);
  }
  Reach(const Reach&) = delete;
  Reach& operator=(const Reach&) = delete;

  void world_restored(std::size_t) override { look(); }
  void step_over() override { look(); }
  void finish(play::ScenarioResult&) override { look(); }

  void note(Sort sort, std::uint64_t what) {
    reached_.when.try_emplace((what & ~std::uint64_t{3}) | static_cast<std::uint64_t>(sort), world_.now());
  }

 private:
  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte&, bool) override {}
  void on_nothing_more() override {}
  void on_receive(std::span<const std::uint8_t> bytes, bool) override {
    // These bytes of a frame contain the station, the function and the address, but not the values.
    constexpr std::size_t kTelling = 4;
    std::uint64_t request = bytes.size() < kTelling ? bytes.size() : kTelling;
    for (const std::uint8_t byte : bytes.first(static_cast<std::size_t>(request)))
      request = mixed(request, byte);
    note(Sort::order,
         mixed(mixed(std::exchange(last_.request, request), std::exchange(last_.reply, 0)), request));
  }
  void on_transmission(const pty::Transmission& protocol) override {
    last_.reply = 1 + (protocol.bytes.size() > 1 ? protocol.bytes[1] >> 7 : 0);  // an exception has this bit
    look();
  }
  void on_strike(const pty::StruckMessage& message) override {
    for (const pty::Strike& strike : message.strikes) last_.event = mixed(last_.event, strike.fault);
    look();
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

  void on_input(std::size_t, int, std::int32_t) override { look(); }
  void on_power(std::size_t, bool) override { look(); }
  void on_inject(const world::Fault&) override {}
  void on_clear_fault(std::size_t) override { look(); }
  void on_write(std::size_t, const PreparedWrite&) override { look(); }
  void on_assign(std::size_t, std::string_view, double) override { look(); }
  void on_program(std::size_t, std::string_view, bool) override { look(); }
  void on_command(std::size_t, std::string_view) override { look(); }
  void on_fault(std::size_t, bool) override { look(); }

  void look() {
    std::uint64_t state = 0;
    for (std::size_t d = 0; d < world_.device_count(); ++d) state = mixed(state, state_of(d));
    if (state == last_.state && last_.event == 0) return;
    note(Sort::state, state);
    note(Sort::order, mixed(mixed(last_.state, state), std::exchange(last_.event, 0)));
    last_.state = state;
  }

  std::uint64_t state_of(std::size_t d) {
    const Device& device = world_.device(d);
    std::uint64_t state = device.powered() ? 1 : 0;
    const Axes* const axes = device.axes();
    for (std::size_t i = 0; axes != nullptr && i < device.model().axes.size(); ++i) {
      const int axis = static_cast<int>(i);
      if (axes->has_axis(axis)) state = mixed(state, state_of_axis(d, *axes, axis));
    }
    if (!device.powered()) return state;
    for (const TerminalView& view : sights_[d].terminals)
      state = mixed(state, static_cast<std::uint64_t>(value_of(device, view)));
    const RegisterBank* const bank = device.register_bank();
    for (const Place& place : sights_[d].words)
      state = mixed(state, static_cast<std::uint64_t>(read_value(*bank, place)));
    for (std::size_t i = 0; i < sights_[d].numbers.size(); ++i) {
      const std::uint64_t size = class_of(read_value(*bank, sights_[d].numbers[i]));
      note(Sort::value, mixed(mixed(d, i), size));
    }
    return state;
  }

  std::uint64_t state_of_axis(std::size_t d, const Axes& axes, int axis) const {
    const double speed = axes.speed_pps(axis);
    const world::PlantAxis& machine = world_.plant(d, axis);
    std::uint64_t state = speed > 0 ? 1 : speed < 0 ? 2 : 0;
    for (const bool bit : {axes.servo_on(axis).value_or(false), machine.at_home(), machine.at_upper_limit(),
                           machine.at_lower_limit(), machine.lost_pulses() != 0}) {
      state = state * 2 + (bit ? 1 : 0);
    }
    return state;
  }

  world::World& world_;
  Reached& reached_;
  std::vector<Sights> sights_;  // by device
  std::vector<std::unique_ptr<Lines>> lines_;
  Reached::Last& last_;
};

void Lines::see(int part, int line, std::uint8_t what) {
  if (part < 0 || line < 0) return;
  const auto p = static_cast<std::size_t>(part);
  const auto l = static_cast<std::size_t>(line);
  if (p >= seen_.size()) seen_.resize(p + 1);
  if (l >= seen_[p].size()) seen_[p].resize(l + 1);
  std::uint8_t& seen = seen_[p][l];
  if ((seen & what) != 0) return;
  seen = static_cast<std::uint8_t>(seen | what);
  reach_.note(Sort::program, mixed(mixed(mixed(device_, mark_), (p << 32) | l), what));
}

}  // namespace

play::ObserverMaker reach_observer(Reached& reached) {
  return [&reached](world::World& world) { return std::make_unique<Reach>(world, reached); };
}

}  // namespace understudy::emulator::hunt
