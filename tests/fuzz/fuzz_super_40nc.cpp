// Any input to a SUPER-40NC on both its ports, while time passes, programs run, inputs change and the power
// is switched. Replies are whole frames on the port that asked; a request that gets an exception has changed
// nothing; many ticks in one step equal single ticks, and a saved state continues in the same way.
//
// An input is a byte of options (which programs), then acts: a byte and its data. The byte's lower bits:
//   0 a lump as it is    1 a PDU (station and checksum are put round it)
//     bit 7: RS485; a byte of length, bytes
//   2 time: the upper bits, in ticks, once more times the next byte
//   3 an input: upper bits which one, the next byte its level
//   4 a contact: a byte says which command or relay, the top bit of it OFF; bit 7: by RS485
//   5 a register: a byte says which, four bytes its value
//   6 the power is switched off and on
//   7 the hand wheel is turned, upper bits
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/terminals.h"
#include "emulator/models/super_40nc/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/fuzz/twice.h"

namespace {

using namespace understudy;
using fuzzing::require;
namespace world = emulator::world;
namespace super_40nc = emulator::models::super_40nc;

constexpr std::size_t kPorts = 2;
#ifdef UNDERSTUDY_REPLAYS_CORPUS
constexpr Tick kMaxTicks = 20'000;  // so that a run ends
#else
constexpr Tick kMaxTicks = 60;
#endif

constexpr std::string_view kPrograms[] = {
    "",
    "AREA C\nF K300000\nXYP\nLAB K1\nLIN K500 K200 K-100\nCCW K900 K200 K200\nDRV * * * K300\nTMR "
    "K5\nINCC\nLIN K-50\n"
    "ABSC\nJMP K1\nEND\nFILE 1\nLIN K100\nEND\nAREA U\nVDRV K900\nTMR K20\nVDRV K0\nSTR\nEND\n",
    "AREA X\nHOM K1\nRPM K2000\nDRV D600\nMRK D601\nCHK K0\nDRV K0\nEND\nAREA Y\nMPG K3\nWAT X20\nMPG "
    "K0\nEND\n",
    "AREA PLC\nLD X20\nOR M5\nOUT T0 K30\nLDP T0\nINC D600\nMOV D600 D9002\nLD M6\nPJG K1 K1\nLD X21\nSTP K1 "
    "K1\n"
    "LD M8120\nOUT C16 K3\nLD C16\nSTR * K1\nLD M7\nRPM D602\nDRV D603 * D604\nEND\n"
    "AREA Y\nLAB K7\nDRV K200\nDRV K0\nCAL K3 K2\nJMP K7\nLAB K3\nINC D1\nRET\nEND\n"};

struct Act {
  std::uint8_t head = 0;
  std::vector<std::uint8_t> bytes{};  // its data

  unsigned kind() const { return head & 7U; }
  unsigned upper() const { return head >> 3U; }
  std::size_t port() const { return head >> 7U; }
};

std::vector<Act> read_acts(std::span<const std::uint8_t> data) {
  constexpr std::array<std::size_t, 8> kBytes{0, 0, 1, 1, 1, 5, 0, 0};
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

/// Coils that do something: commands of the axes and programs, keys, relays.
std::uint16_t coil_of(std::uint8_t number) {
  const unsigned n = number & 0x7FU;
  if (n < 55) return static_cast<std::uint16_t>(2000 + n / 11 * 100 + n % 11);
  if (n < 100) return static_cast<std::uint16_t>(2508 + n);  // M8563 on
  return static_cast<std::uint16_t>(1000 + n - 100);
}
/// Positions, parameters of X, files, and registers that programs read.
std::uint16_t register_of(std::uint8_t number) {
  if (number < 100) return static_cast<std::uint16_t>(9200 + 2 * number);
  if (number < 150) return static_cast<std::uint16_t>(9000 + 2 * (number - 100));
  if (number < 230) return static_cast<std::uint16_t>(7000 + 2 * (number - 150) * 3);
  return static_cast<std::uint16_t>(1200 + 2 * (number - 230));
}

class Listener {
 public:
  Listener(std::size_t program, bool in_bulk)
      : world_(bench_of(program), {.enforce_settings = false}, {}),
        make_anew_(world::read_state(world_, world::save(world_))) {
    world_.set_bulk_ticks(in_bulk);
  }

  world::World& world() { return world_; }

  void restart() {
    make_anew_();
    ticks_ = 0;
    wheel_ = 0;
    has_noise_ = false;
    for (std::size_t port = 0; port < kPorts; ++port) {
      world_.take_output(port, world_.line(port).line.output().size());
    }
  }

  void execute(const Act& act) {
    switch (act.kind()) {
      case 0: send(act.port(), act.bytes, std::nullopt); break;
      case 1: ask(act.port(), act.bytes); break;
      case 2: run(1 + act.upper() * (1 + act.bytes[0] / 8U)); break;
      case 3: world_.set_external_input(0, static_cast<int>(act.upper()), act.bytes[0] & 1); break;
      case 4: {
        const std::uint16_t coil = coil_of(act.bytes[0]);
        const bool on = (act.bytes[0] & 0x80) == 0;
        ask(act.port(), {{0x05, static_cast<std::uint8_t>(coil >> 8), static_cast<std::uint8_t>(coil & 0xFF),
                          static_cast<std::uint8_t>(on ? 0xFF : 0), 0}});
        break;
      }
      case 5: {
        const std::uint16_t address = register_of(act.bytes[0]);
        ask(act.port(),
            {{0x10, static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address & 0xFF), 0, 2,
              4, act.bytes[1], act.bytes[2], act.bytes[3], act.bytes[4]}});
        break;
      }
      case 6:
        world_.switch_power(0, false);
        world_.switch_power(0, true);
        break;
      default:
        wheel_ += static_cast<std::int32_t>(act.upper());
        world_.set_external_input(0, emulator::find_terminal(super_40nc::model(), "MPG"), wheel_);
    }
  }
  void run(Tick ticks) {
    const Tick room = std::min(ticks, kMaxTicks - ticks_);
    ticks_ += room;
    world_.advance_to(world_.now() + time_of(room));
    for (std::size_t port = 0; port < kPorts; ++port) take(port, std::nullopt);
  }

 private:
  void ask(std::size_t port, std::span<const std::uint8_t> pdu) {
    if (pdu.empty()) return;
    std::vector<std::uint8_t> frame(1 + pdu.size());  // to station 0, the factory's number
    std::copy(pdu.begin(), pdu.end(), frame.begin() + 1);
    pty::append_rtu_crc(frame);
    send(port, frame, pdu[0]);
  }
  /// Messages whose end the device recognizes without silence.
  static bool is_whole(std::span<const std::uint8_t> frame) {
    if (frame.size() < 8 || frame[1] == 4) return false;
    const bool is_long = frame[1] == 0x0F || frame[1] == 0x10;
    const bool is_known = (frame[1] >= 1 && frame[1] <= 6) || is_long;
    return is_known && pty::rtu_crc_ok(frame) && frame.size() == (is_long ? 9U + frame[6] : 8U);
  }
  /// `function`: of a request.
  void send(std::size_t port, std::span<const std::uint8_t> bytes, std::optional<std::uint8_t> function) {
    if (!is_whole(bytes)) has_noise_ = true;  // which may be the beginning of another frame
    const std::size_t other = 1 - port;
    const std::size_t waits_there = world_.line(other).line.output().size();
    world_.receive(port, bytes);
    world_.advance_to(world_.now());
    require(world_.line(other).line.output().size() == waits_there,
            "the port that did not ask hears nothing");
    take(port, function);
  }
  void take(std::size_t port, std::optional<std::uint8_t> function) {
    const auto output = world_.line(port).line.output();
    std::vector<std::uint8_t> sent(output.begin(), output.end());
    world_.take_output(port, sent.size());
    std::span<const std::uint8_t> left = sent;
    while (!left.empty()) {
      require(left.size() >= 5, "a reply is a whole frame");
      std::size_t size = 8;
      if ((left[1] & 0x80) != 0) {
        size = 5;
        require(left[2] >= 1 && left[2] <= 3, "there are three exceptions");
      } else if (left[1] <= 3) {
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
    world::DeviceSetup device{.model = &super_40nc::model(), .settings = {}};
    device.settings.name = "mill";
    device.settings.set = {{"D9003", program == 1 ? 3 : 0}, {"D9390", 50}};
    device.settings.program = std::string(kPrograms[program]);
    bench.devices.push_back(device);
    for (std::size_t port = 0; port < kPorts; ++port) {
      world::LineSetup line;
      line.name = port == 0 ? "rs232" : "rs485";
      line.timing = pty::Timing::instant;
      line.stations = {{0, port}};
      bench.lines.push_back(line);
    }
    world::PlantSetup plant;
    plant.home = world::PulseSpan{300, 500};
    plant.upper_limit = 2000;
    plant.lower_limit = -1500;
    plant.encoder_counts_per_revolution = 1000;
    plant.pulses_per_revolution = 4000;
    plant.index = world::IndexSetup{.at = 0, .width = 1, .period = 400};
    bench.machines.push_back({.device = 0, .axis = 0, .plant = plant});
    return bench;
  }

  world::World world_;
  std::function<void()> make_anew_;
  Tick ticks_ = 0;
  std::int32_t wheel_ = 0;
  bool has_noise_ = false;
};

/// Made on first use.
Listener& listener_for(std::size_t program, bool in_bulk) {
  static std::array<std::array<std::unique_ptr<Listener>, 2>, std::size(kPrograms)> all;
  auto& one = all[program][in_bulk ? 1 : 0];
  if (!one) one = std::make_unique<Listener>(program, in_bulk);
  return *one;
}

/// The requests that the lines carry.
void check_refusals(Listener& listener, std::span<const Act> acts) {
  for (const Act& act : acts) {
    if (act.kind() != 1 || act.bytes.empty() || act.bytes.size() > world::kModbusMaxPdu) continue;
    fuzzing::require_refused_changes_nothing(listener.world().device(0), act.bytes);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t program = data[0] % std::size(kPrograms);
  const std::vector<Act> acts = read_acts({data + 1, size - 1});
  Listener& listener = listener_for(program, true);
  fuzzing::play(listener, std::span(acts), 20);
  if (!fuzzing::is_checked_wholly({data, size}, 64)) return 0;
  Listener& stepped = listener_for(program, false);
  fuzzing::require_same_by_single_ticks(stepped, listener, std::span(acts), 20);
  check_refusals(stepped, acts);
  return 0;
}
