// Any input to a controller with four tables, above all requests of the eight functions. It has coils,
// inputs, pairs, reals, holes and a window with a FIFO behind it (tests/emulator/workbench). Whatever it
// receives, its replies are well-formed and report its values, and a request that gets an exception has
// changed nothing.
//
// An input is one byte of options, then lumps. A lump is a byte of gap (in units of 100 us), a byte of
// length, and its bytes. If the length's top bit is set, the bytes are a PDU: station 1 is put before it, and
// a correct checksum after it. If the options give the controller both its ports, a gap's top bit means the
// second one.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"
#include "tests/emulator/workbench/workbench.h"
#include "tests/fuzz/fuzzing.h"

namespace {

using namespace understudy;
using fuzzing::require;
using namespace std::chrono_literals;
namespace world = emulator::world;
namespace workbench = emulator::workbench;

constexpr std::size_t kMaxLumps = 32;   // so that a run ends
constexpr SimTime kAfterwards = 500ms;  // at most, for data that is still on the wire
constexpr std::size_t kSettings = 8;    // what the options byte can request
constexpr std::size_t kPorts = 2;

struct Lump {
  SimTime gap{0};
  std::vector<std::uint8_t> bytes;
  bool is_pdu = false;
  std::size_t line = 0;
};

bool has_both_ports(std::uint8_t options) { return (options & 4) != 0; }

std::vector<Lump> read_lumps(std::span<const std::uint8_t> data, bool has_two_lines) {
  std::vector<Lump> lumps;
  while (data.size() >= 2 && lumps.size() < kMaxLumps) {
    Lump& lump = lumps.emplace_back();
    lump.line = has_two_lines && (data[0] & 0x80) != 0 ? 1 : 0;
    lump.gap = (has_two_lines ? data[0] & 0x7F : data[0]) * 100us;
    lump.is_pdu = (data[1] & 0x80) != 0;
    const std::size_t length = std::min<std::size_t>(data[1] & 0x7F, data.size() - 2);
    if (lump.is_pdu) lump.bytes.push_back(1);
    lump.bytes.insert(lump.bytes.end(), data.begin() + 2,
                      data.begin() + 2 + static_cast<std::ptrdiff_t>(length));
    if (lump.is_pdu) pty::append_rtu_crc(lump.bytes);
    data = data.subspan(2 + length);
  }
  return lumps;
}

/// One controller in its own world, with its output.
class Listener {
 public:
  Listener(std::uint8_t options, bool in_bulk)
      : world_(bench_for(options), {.strict_framing = (options & 2) != 0, .enforce_settings = false}, {}),
        make_anew_(world::read_state(world_, save(world_))) {
    world_.set_bulk_ticks(in_bulk);
  }

  void play(std::span<const Lump> lumps) {
    make_anew_();
    take();
    sent_ = {};
    for (const Lump& lump : lumps) {
      world_.advance_to(world_.now() + lump.gap);
      world_.receive(lump.line, lump.bytes);
      world_.advance_to(world_.now());
      take();
    }
    const SimTime end = world_.now() + kAfterwards;
    const auto is_due = [&] {
      for (std::size_t i = 0; i < lines(); ++i) {
        if (line(i).due()) return true;
      }
      return false;
    };
    while (is_due() && world_.now() < end) {
      world_.advance_to(world_.now() + 25ms);
      take();
    }
  }

  std::size_t lines() const { return world_.line_count(); }
  const pty::Line& line(std::size_t number) const { return world_.line(number).line; }
  workbench::Workbench& device() { return static_cast<workbench::Workbench&>(world_.device(0)); }
  const world::StationCounters& counters(std::size_t line) {
    return world_.line(line).stations[0]->counters();
  }
  SimTime now() const { return world_.now(); }
  /// On each line.
  const std::array<std::vector<std::uint8_t>, kPorts>& sent() const { return sent_; }

 private:
  void take() {
    for (std::size_t i = 0; i < lines(); ++i) {
      const auto output = line(i).output();
      sent_[i].insert(sent_[i].end(), output.begin(), output.end());
      world_.take_output(i, output.size());
    }
  }
  static world::Bench bench_for(std::uint8_t options) {
    world::Bench bench;
    world::DeviceSetup device{.model = &workbench::model(), .settings = {}};
    device.settings.name = "it";
    device.settings.bauds = {115200, 38400};
    bench.devices.push_back(device);
    for (std::size_t port = 0; port < (has_both_ports(options) ? kPorts : 1); ++port) {
      world::LineSetup line;
      line.name = port == 0 ? "line" : "other";
      line.baud = device.settings.bauds[port];
      line.timing = (options & 1) != 0 ? pty::Timing::instant : pty::Timing::wire;
      line.stations = {{0, port}};
      bench.lines.push_back(line);
    }
    return bench;
  }

  world::World world_;
  std::function<void()> make_anew_;
  std::array<std::vector<std::uint8_t>, kPorts> sent_;
};

const world::FunctionRow* function_called(std::uint8_t code) {
  for (const world::FunctionRow& row : world::kModbusFunctions) {
    if (row.code == code) return &row;
  }
  return nullptr;
}

/// Returns the length of the reply that begins here; nothing if it is not a reply.
std::optional<std::size_t> reply_size(std::span<const std::uint8_t> sent) {
  if (sent.size() < 5) return std::nullopt;
  if ((sent[1] & 0x80) != 0) return 5;
  const world::FunctionRow* const row = function_called(sent[1]);
  if (row == nullptr) return std::nullopt;
  return row->kind == world::FunctionRow::Kind::read ? 5U + sent[2] : 8U;
}

/// A request is answered on its own line, and nowhere else.
void check_replies(Listener& listener, std::size_t line) {
  if (listener.line(line).counters().bytes_discarded > 0) return;  // it sent faster than the wire carries
  std::span<const std::uint8_t> sent = listener.sent()[line];
  std::uint64_t replies = 0;
  std::uint64_t exceptions = 0;
  while (!sent.empty()) {
    const auto size = reply_size(sent);
    require(size && *size <= sent.size(), "replies are whole frames");
    require(*size <= 256, "a reply is no longer than 256 bytes");
    require(pty::rtu_crc_ok(sent.first(*size)), "a reply has a right checksum");
    require(sent[0] == 1, "a station gives its own number");
    if ((sent[1] & 0x80) != 0) {
      ++exceptions;
      require((sent[2] >= 1 && sent[2] <= 4) || sent[2] == 6, "there are five exceptions");
    }
    ++replies;
    sent = sent.subspan(*size);
  }
  require(replies == listener.counters(line).replies, "every reply leaves");
  require(exceptions == listener.counters(line).exceptions, "exceptions are counted");
}

/// Without a line: a refused request has changed nothing except what the device records about it, and written
/// values can be read again.
void check_requests(std::span<const Lump> lumps) {
  emulator::DeviceSettings settings;
  settings.name = "it";
  static const auto device = emulator::make_device(workbench::model(), settings);
  static const workbench::WorkbenchState fresh = static_cast<workbench::Workbench&>(*device).state;
  auto& state = static_cast<workbench::Workbench&>(*device).state;
  state = fresh;
  for (const Lump& lump : lumps) {
    if (!lump.is_pdu) continue;
    const auto pdu = std::span(lump.bytes).subspan(1, lump.bytes.size() - 3);
    const workbench::WorkbenchState before = state;
    const world::ModbusReply reply = world::serve(*device, pdu);
    require(reply.size >= 2 && reply.size <= world::kModbusMaxPdu, "a reply has a size");
    const bool is_exception = (reply.pdu[0] & 0x80) != 0;
    require(is_exception == static_cast<bool>(reply.refused.objection), "an exception has a cause");
    if (is_exception) {
      require(state == before, "a refused request changes nothing");
      require(reply.refused.exception == reply.pdu[1], "the device hears what was answered");
      require(pdu.empty() || reply.refused.function == pdu[0], "and to what");
      continue;
    }
    const world::FunctionRow* const row = function_called(pdu[0]);
    require(row != nullptr, "only known functions are served");
    if (row->kind == world::FunctionRow::Kind::read) require(state == before, "reading changes nothing");
    if (row->code != 0x0F && row->code != 0x05) continue;
    // Coils hold what was written to them.
    const std::size_t count = row->code == 0x05 ? 1U : static_cast<std::size_t>(pdu[3] << 8 | pdu[4]);
    const std::array<std::uint8_t, 5> again{0x01, pdu[1], pdu[2], static_cast<std::uint8_t>(count >> 8),
                                            static_cast<std::uint8_t>(count)};
    const world::ModbusReply read = world::serve(*device, again);
    require(read.pdu[0] == 0x01, "what was written can be read");
    for (std::size_t i = 0; i < count; ++i) {
      const bool wanted = row->code == 0x05 ? pdu[3] == 0xFF : (pdu[6 + i / 8] >> i % 8 & 1) != 0;
      require(((read.pdu[2 + i / 8] >> i % 8 & 1) != 0) == wanted, "a coil holds what was written");
    }
  }
}

struct Crowd {
  explicit Crowd(std::uint8_t options) : listener(options, true), stepped(options, false) {}
  Listener listener;
  Listener stepped;  // the same, every tick run one by one
};

/// Made on first use.
Crowd& crowd_for(std::uint8_t options) {
  static std::array<std::unique_ptr<Crowd>, kSettings> crowds;
  auto& crowd = crowds[options % kSettings];
  if (!crowd) crowd = std::make_unique<Crowd>(options % kSettings);
  return *crowd;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::vector<Lump> lumps = read_lumps({data + 1, size - 1}, has_both_ports(data[0] % kSettings));
  check_requests(lumps);
  Crowd& crowd = crowd_for(data[0]);
  crowd.listener.play(lumps);
  for (std::size_t i = 0; i < crowd.listener.lines(); ++i) check_replies(crowd.listener, i);
  require(crowd.listener.device().state.fifo.size() <= workbench::kFifo, "the FIFO holds what it can");
  if (!fuzzing::is_checked_wholly({data, size})) return 0;
  crowd.stepped.play(lumps);
  require(crowd.stepped.sent() == crowd.listener.sent(), "ticks left out are not to be seen on the line");
  require(crowd.stepped.now() == crowd.listener.now(), "nor do they take another time");
  require(crowd.stepped.device().same_state(crowd.listener.device()), "ticks left out leave the same state");
  return 0;
}
