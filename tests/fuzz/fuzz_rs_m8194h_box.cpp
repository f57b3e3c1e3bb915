// Any input to a whole RS-M8194H while time passes, axes move, macros run, inputs change and the power is
// switched. Replies are whole frames; a request that gets an exception has changed nothing; many ticks in one
// step equal single ticks, and a saved state continues in the same way.
//
// An input is a byte of options (which macros), then acts: a byte and its data. The byte's lower bits:
//   0 a lump as it is    1 a PDU (station and checksum are put round it); a byte of length, bytes
//   2 time: the upper bits, in ticks, once more times the next byte
//   3 an input: the next byte says which, its top bit that it is on
//   4 a command, bit 7: its macro line: a byte says which, six more make its parameters
//   5 a register: a byte says which, four bytes its value
//   6 the power is switched off and on; bit 3: without the module, or with it again
//   7 edges at EXP+ or EXP-: bits 3 and 4 say whose, bit 5 which, the others how many
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/rs_m8194h/model.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/world.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/operators.h"
#include "interpreter/rs_m8194h/window.h"
#include "pty/rtu_crc.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/fuzz/twice.h"

namespace {

using namespace understudy;
using fuzzing::require;
namespace world = emulator::world;
namespace rsm = emulator::models::rs_m8194h;
namespace lang = interpreter::rs_m8194h;

constexpr std::uint8_t kStation = 1;
constexpr std::uint16_t kWindow = 8000;
constexpr std::uint16_t kWordOrder = 14;
constexpr std::uint16_t kRsmState = 100;  // an input register
#ifdef UNDERSTUDY_REPLAYS_CORPUS
constexpr Tick kMaxTicks = 20'000;  // so that a run ends
constexpr int kMaxCycles = 100;     // of the power
#else
constexpr Tick kMaxTicks = 60;
constexpr int kMaxCycles = 1;  // each costs as much as a run without one
#endif

constexpr std::string_view kPrograms[] = {
    "",
    "MP 1\nRSM_MACRO_SET_V XYZU 8000\nRSM_MACRO_FIXED_MOVE XY 300\nRSM_MACRO_STOP_WAIT X\n"
    "RSM_MACRO_VAR_CALCULATE VAR1 + 1 VAR1\nRSM_MACRO_MP_CALL 2\nEND\n"
    "MP 2\nRSM_MACRO_FOR 3\nRSM_MACRO_TIMER 2\nRSM_MACRO_FRNET_OUT 0 VAR1\nRSM_MACRO_NEXT\nEND\n"
    "ISR 1\nRSM_MACRO_VAR_CALCULATE VAR2 + 1 VAR2\nRSM_MACRO_FIXED_MOVE U 10\nEND\n"
    "TRIGGER 8.0 off_to_on MP1\nTRIGGER 8.1 on hold X\nTRIGGER 8.2 change clear_stop\n",
    "MP 1\nRSM_MACRO_LABEL 0\nRSM_MACRO_GOTO 0\nEND\n"
    "MP 41\nRSM_MACRO_SYNC_ACTION X Y 0x11 3 1 0 1 1 1 1 1 1\nRSM_MACRO_ENABLE_INT\n"
    "RSM_MACRO_SET_COMPARE X 0 0 40\nRSM_MACRO_FIXED_MOVE X 100\nRSM_MACRO_FRNET_WAIT 9 VAR0 1 20\n"
    "RSM_MACRO_GET_LATCH Y\nRSM_MACRO_SET_RVAR VAR3\nEND\n"
    "ISR 1\nRSM_MACRO_IF VAR1 < 5\nRSM_MACRO_SET_V Y 100\nRSM_MACRO_FRNET_WAIT 8 0 1 "
    "5\nRSM_MACRO_END_IF\nEND\n"
    "TRIGGER 8.0 on pause\nTRIGGER 8.1 off abort_command\nTRIGGER 8.2 off_to_on abort_macro\n",
    "MP 91\nRSM_MACRO_LINE_2D_INITIAL X Z 500 8000 100000\nRSM_MACRO_FOR 5\n"
    "RSM_MACRO_LINE_2D_CONTINUE 0 20 10\nRSM_MACRO_LINE_2D_CONTINUE 0 3 -4\nRSM_MACRO_NEXT\n"
    "RSM_MACRO_LINE_2D_CONTINUE 1 9 9\nRSM_MACRO_RECTANGLE X Y 1 3 1 90 60 10 500 4000 9000 9000\nEND\n"
    "MP 2\nRSM_MACRO_SET_HV X 500\nRSM_MACRO_SET_HOME_MODE X 2 1 1 2 30\nRSM_MACRO_HOME_START X\nEND\n"
    "TRIGGER 8.0 off_to_on MP2\nTRIGGER 8.1 off_to_on MP91\n",
};

struct Act {
  std::uint8_t head = 0;
  std::vector<std::uint8_t> bytes{};  // its data

  unsigned kind() const { return head & 7U; }
  unsigned upper() const { return head >> 3U; }
};

std::vector<Act> read_acts(std::span<const std::uint8_t> data) {
  constexpr std::array<std::size_t, 8> kBytes{0, 0, 1, 1, 7, 5, 0, 0};
  std::vector<Act> acts;
  while (!data.empty()) {
    Act& act = acts.emplace_back(Act{.head = data[0]});
    data = data.subspan(1);
    std::size_t count = kBytes[act.kind()];
    if (act.kind() < 2 && !data.empty()) {
      count = data[0];
      data = data.subspan(1);
    }
    count = std::min(count, data.size());
    act.bytes.assign(data.begin(), data.begin() + static_cast<std::ptrdiff_t>(count));
    act.bytes.resize(std::max(act.bytes.size(), kBytes[act.kind()]));
    data = data.subspan(count);
  }
  return acts;
}

/// A parameter from one byte: usually a valid one, at its limits, or just beyond them.
std::uint32_t value_of(const lang::Parameter& parameter, std::uint8_t byte) {
  const std::uint32_t n = byte;
  switch (parameter.kind) {
    case lang::Kind::axes:
    case lang::Kind::setting_axes: return n & 0x1FU;
    case lang::Kind::axis: return 1U << (n & 3U);
    case lang::Kind::axis_or_none: return n % 5 == 0 ? 0 : 1U << (n & 3U);
    case lang::Kind::variable: return static_cast<std::uint32_t>(lang::kVariable0) + n % 8;
    case lang::Kind::byte_variable: return static_cast<std::uint32_t>(lang::kByteVariable0) + n % 8;
    case lang::Kind::memory: return n * 9;
    case lang::Kind::arithmetic:
      return static_cast<std::uint32_t>(lang::kArithmetic[n % std::size(lang::kArithmetic)]);
    case lang::Kind::comparison: return lang::kComparisons[n % std::size(lang::kComparisons)].codes[0];
    case lang::Kind::speed: return n * n * 64;
    case lang::Kind::number:
    case lang::Kind::any_value:
    case lang::Kind::operand:
    case lang::Kind::isr_if_used:
    case lang::Kind::point_if_used: break;
  }
  const std::int64_t span = parameter.max - parameter.min;
  if (span < 1000) return static_cast<std::uint32_t>(parameter.min + byte % (span + 2));
  constexpr std::uint8_t kMax = 0x7F, kMin = 0x80, kVariable = 0x81;
  if (byte == kMax) return static_cast<std::uint32_t>(parameter.max);
  if (byte == kMin) return static_cast<std::uint32_t>(parameter.min);
  if (byte == kVariable) return static_cast<std::uint32_t>(lang::kVariable0) + 1;
  const auto small = static_cast<std::int8_t>(byte);
  return static_cast<std::uint32_t>(small * (small < 0 ? -small : small) / 16);
}

lang::Command command_of(const Act& act) {
  const lang::CommandRow& row = lang::kCommands[act.bytes[0] % lang::kCommands.size()];
  const bool has_line = !row.macro_name.empty();
  const bool has_command = !row.real_time_name.empty();
  const bool is_line = has_line && (!has_command || (act.head & 0x80) != 0);
  lang::Command command{.code = is_line ? lang::macro_code(row.verb) : lang::real_time_code(row.verb)};
  for (std::size_t i = 0; i < row.parameter_count(); ++i) {
    command.values[i] = value_of(row.parameters[i], act.bytes[1 + i % 6]);
  }
  return command;
}

/// Registers that do something, or that macros read, with a valid or invalid number of words.
std::uint16_t register_of(std::uint8_t number) {
  constexpr std::array<std::uint16_t, 8> kWords{0, 8, 9, 14, 20, 24, 81, 128};
  if (number < 64) return kWords[number % kWords.size()];
  if (number < 128) return static_cast<std::uint16_t>(82 + number % 48);
  return static_cast<std::uint16_t>((number < 220 ? 300 : 3000) + number % 32);
}

class Box {
 public:
  Box(std::size_t program, bool in_bulk)
      : world_(bench_of(program), {.enforce_settings = false}, {}),
        make_anew_(world::read_state(world_, world::save(world_))) {
    world_.set_bulk_ticks(in_bulk);
  }

  world::World& world() { return world_; }

  void restart() {
    make_anew_();
    ticks_ = 0;
    edges_ = {};
    cycles_ = 0;
    is_without_module_ = false;
    has_noise_ = false;
    world_.take_output(0, world_.line(0).line.output().size());
  }

  void execute(const Act& act) {
    switch (act.kind()) {
      case 0: send(act.bytes, std::nullopt); break;
      case 1: ask(act.bytes); break;
      case 2: run(1 + act.upper() * (1 + act.bytes[0] / 8U)); break;
      case 3: switch_input(act.bytes[0]); break;
      case 4: ask(command_pdu(act)); break;
      case 5: ask(register_pdu(act)); break;
      case 6: switch_power(act); break;
      default: turn(act.upper());
    }
  }
  void run(Tick ticks) {
    const Tick room = std::min(ticks, kMaxTicks - ticks_);
    ticks_ += room;
    world_.advance_to(world_.now() + time_of(room));
    take(std::nullopt);
  }

  std::vector<std::uint8_t> command_pdu(const Act& act) {
    const auto order = word(emulator::Table::holding, kWordOrder) == 1 ? lang::WordOrder::low_first
                                                                       : lang::WordOrder::high_first;
    return write_pdu(kWindow, lang::encode(command_of(act), order));
  }
  static std::vector<std::uint8_t> register_pdu(const Act& act) {
    const auto high = static_cast<std::uint16_t>(act.bytes[1] << 8U | act.bytes[2]);
    const auto low = static_cast<std::uint16_t>(act.bytes[3] << 8U | act.bytes[4]);
    const std::uint16_t first = register_of(act.bytes[0]);
    if (first < 82 || first == 128) return write_pdu(first, std::array{low});
    return write_pdu(first, std::array{high, low});
  }
  std::uint16_t word(emulator::Table table, std::uint16_t address) {
    std::uint16_t found = 0;
    emulator::read_words(*world_.device(0).register_bank(), table, address, std::span(&found, 1));
    return found;
  }

 private:
  static std::vector<std::uint8_t> write_pdu(std::uint16_t first, std::span<const std::uint16_t> words) {
    const auto byte = [](std::size_t number) { return static_cast<std::uint8_t>(number & 0xFF); };
    std::vector<std::uint8_t> pdu{0x10, byte(first >> 8U),  byte(first),
                                  0,    byte(words.size()), byte(2 * words.size())};
    for (const std::uint16_t each : words) {
      pdu.push_back(byte(each >> 8U));
      pdu.push_back(byte(each));
    }
    return pdu;
  }
  void switch_input(std::uint8_t byte) {
    const int which = byte & 0x7F;
    const bool on = (byte & 0x80) != 0;
    const int number = which <= rsm::kEmergencyPin ? which : rsm::kFirstDi + which - rsm::kEmergencyPin - 1;
    const int pin = which % rsm::kPinsOfAxis;
    const bool is_counted = which < rsm::kEmergencyPin && (pin == static_cast<int>(rsm::Pin::external_plus) ||
                                                           pin == static_cast<int>(rsm::Pin::external_minus));
    if (!is_counted) world_.set_external_input(0, number, on ? 1 : 0);
  }
  void switch_power(const Act& act) {
    if ((act.upper() & 1) != 0) {
      is_without_module_ = !is_without_module_;
      world_.set_external_input(0, rsm::kNoModuleSwitch, is_without_module_ ? 1 : 0);
      return;
    }
    if (++cycles_ > kMaxCycles) return;
    world_.switch_power(0, false);
    world_.switch_power(0, true);
  }
  void turn(unsigned upper) {
    const std::size_t axis = upper & 3U;
    const bool is_minus = (upper & 4U) != 0;
    const rsm::Pin pin = is_minus ? rsm::Pin::external_minus : rsm::Pin::external_plus;
    std::int32_t& edges = edges_[2 * axis + (is_minus ? 1 : 0)];
    edges += static_cast<std::int32_t>(1 + (upper >> 3U));
    world_.set_external_input(0, rsm::terminal(axis, pin), edges);
  }

  void ask(std::span<const std::uint8_t> pdu) {
    if (pdu.empty()) return;
    std::vector<std::uint8_t> frame(1 + pdu.size());
    frame[0] = kStation;
    std::copy(pdu.begin(), pdu.end(), frame.begin() + 1);
    pty::append_rtu_crc(frame);
    send(frame, pdu[0]);
  }
  /// Messages whose end the device recognizes without silence.
  static bool is_whole(std::span<const std::uint8_t> frame) {
    if (frame.size() < 8) return false;
    const bool is_long = frame[1] == 0x0F || frame[1] == 0x10;
    const bool is_known = (frame[1] >= 1 && frame[1] <= 6) || is_long;
    return is_known && pty::rtu_crc_ok(frame) && frame.size() == (is_long ? 9U + frame[6] : 8U);
  }
  /// `function`: of a request.
  void send(std::span<const std::uint8_t> bytes, std::optional<std::uint8_t> function) {
    if (!is_whole(bytes)) has_noise_ = true;  // which may be the beginning of another frame
    world_.receive(0, bytes);
    world_.advance_to(world_.now());
    take(function);
  }
  void take(std::optional<std::uint8_t> function) {
    const auto output = world_.line(0).line.output();
    std::vector<std::uint8_t> sent(output.begin(), output.end());
    world_.take_output(0, sent.size());
    std::span<const std::uint8_t> left = sent;
    while (!left.empty()) {
      require(left.size() >= 5, "a reply is a whole frame");
      std::size_t size = 8;
      if ((left[1] & 0x80) != 0) {
        size = 5;
        require(left[2] >= 1 && left[2] <= 6 && left[2] != 5, "there are five exceptions");
      } else if (left[1] <= 4) {
        size = 5U + left[2];
      }
      require(size <= left.size() && pty::rtu_crc_ok(left.first(size)), "a reply has a right checksum");
      if (function && !has_noise_) {
        require((left[1] & 0x7F) == (*function & 0x7F), "a reply is to what was asked");
      }
      left = left.subspan(size);
    }
  }

  static world::Bench bench_of(std::size_t program) {
    world::Bench bench;
    world::DeviceSetup device{.model = &rsm::model(), .settings = {}};
    device.settings.name = "cell";
    device.settings.address = kStation;
    device.settings.program = std::string(kPrograms[program]);
    device.settings.set = {{"FRNET_EVENT", 1}};
    bench.devices.push_back(device);
    bench.lines.push_back({.name = "com", .link = {}, .timing = pty::Timing::instant, .stations = {0}});
    world::PlantSetup plant;
    plant.home = world::PulseSpan{60, 90};
    plant.near_home = world::SwitchSetup{.on = {40, 100}};
    plant.mark = world::SwitchSetup{.on = {20, 25}};
    plant.upper_limit = 400;
    plant.lower_limit = -300;
    plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 100};
    bench.machines.push_back({.device = 0, .axis = 0, .plant = plant});
    plant = {};
    plant.encoder_counts_per_revolution = 4000;
    plant.pulses_per_revolution = 1000;
    bench.machines.push_back({.device = 0, .axis = 1, .plant = plant});
    return bench;
  }

  world::World world_;
  std::function<void()> make_anew_;
  Tick ticks_ = 0;
  std::array<std::int32_t, 8> edges_{};
  int cycles_ = 0;
  bool is_without_module_ = false;
  bool has_noise_ = false;
};

/// Made on first use.
Box& box_for(std::size_t program, bool in_bulk) {
  static std::array<std::array<std::unique_ptr<Box>, 2>, std::size(kPrograms)> all;
  auto& one = all[program][in_bulk ? 1 : 0];
  if (!one) one = std::make_unique<Box>(program, in_bulk);
  return *one;
}

/// The requests on the line, one after another. In a download a refused line may spoil it.
void check_refusals(Box& box, std::span<const Act> acts) {
  for (const Act& act : acts) {
    std::vector<std::uint8_t> pdu;
    if (act.kind() == 1) pdu = act.bytes;
    if (act.kind() == 4) pdu = box.command_pdu(act);
    if (act.kind() == 5) pdu = Box::register_pdu(act);
    if (pdu.empty() || pdu.size() > world::kModbusMaxPdu) continue;
    const bool is_in_download = box.word(emulator::Table::input, kRsmState) != 0;
    fuzzing::require_refused_changes_nothing(box.world().device(0), pdu, is_in_download);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t program = data[0] % std::size(kPrograms);
  const std::vector<Act> acts = read_acts({data + 1, size - 1});
  Box& box = box_for(program, true);
  fuzzing::play(box, std::span(acts), 20);
  if (!fuzzing::is_checked_wholly({data, size}, 128)) return 0;
  Box& stepped = box_for(program, false);
  fuzzing::require_same_by_single_ticks(stepped, box, std::span(acts), 20);
  check_refusals(stepped, acts);
  return 0;
}
