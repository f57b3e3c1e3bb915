// Any input over the wire. One controller on one line receives lumps of bytes; whatever they are, its output
// is well-formed, and requests for other stations do not change it.
//
// An input is one byte of options, then lumps. A lump is a byte of gap (how long the line was quiet), a byte
// of length, and its bytes. If the length's top bit is set, a correct checksum is added after the bytes, so
// that the search gets past it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "emulator/models/models.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"
#include "pty/rtu_crc.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/fuzz/same_device.h"

namespace {

using namespace understudy;
using fuzzing::require;
using namespace std::chrono_literals;

constexpr std::size_t kMaxLumps = 32;  // so that a run ends
constexpr SimTime kMaxTime = 2s;       // of all gaps together, likewise
constexpr SimTime kAfterwards = 2s;    // at most, for data that is still on the wire
constexpr SimTime kAStep = 25ms;       // the waiting time for it

struct Lump {
  SimTime gap{0};
  std::vector<std::uint8_t> bytes;
};

struct Input {
  pty::Timing timing = pty::Timing::wire;
  bool strict_framing = false;
  int rotary_switch = 1;
  int other_switch = 15;  // of a controller that receives the same
  bool alternative_choices = false;
  std::vector<Lump> lumps;
};

constexpr std::size_t kSettings = 16;  // what the options byte can request

SimTime gap_of(std::uint8_t code) {
  constexpr SimTime kSteps[] = {10us, 150us, 2ms, 20ms};
  return kSteps[code >> 6] * (code & 0x3F);
}

Input read_input(std::span<const std::uint8_t> data) {
  Input input;
  if (data.empty()) return input;
  input.timing = (data[0] & 1) != 0 ? pty::Timing::instant : pty::Timing::wire;
  input.strict_framing = (data[0] & 2) != 0;
  input.rotary_switch = (data[0] & 4) != 0 ? 0 : 1;
  input.alternative_choices = (data[0] & 8) != 0;
  data = data.subspan(1);
  SimTime left = kMaxTime;
  while (data.size() >= 2 && input.lumps.size() < kMaxLumps) {
    Lump& lump = input.lumps.emplace_back();
    lump.gap = std::min(left, gap_of(data[0]));
    left -= lump.gap;
    const bool has_checksum = (data[1] & 0x80) != 0;
    const std::size_t length = std::min<std::size_t>(data[1] & 0x7F, data.size() - 2);
    lump.bytes.assign(data.begin() + 2, data.begin() + 2 + static_cast<std::ptrdiff_t>(length));
    if (has_checksum) pty::append_rtu_crc(lump.bytes);
    data = data.subspan(2 + length);
  }
  return input;
}

/// One controller in its own world, with its output.
class Listener {
 public:
  Listener(const Input& input, int rotary_switch, bool in_bulk = true)
      : world_(bench_for(input, rotary_switch), options_for(input), {}),
        make_anew_(emulator::world::read_state(world_, save(world_))) {
    world_.set_bulk_ticks(in_bulk);
  }

  /// Everything is as it was at the start.
  void restart() {
    make_anew_();
    world_.take_output(0, line().output().size());
    sent_.clear();
  }

  void hear(const Lump& lump) {
    advance(lump.gap);
    world_.receive(0, lump.bytes);
    advance(0ns);
  }
  void advance(SimTime duration) {
    world_.advance_to(world_.now() + duration);
    const auto due = world_.next_due();
    require(!due || *due > world_.now(), "what is due has been done");
    const auto output = line().output();
    sent_.insert(sent_.end(), output.begin(), output.end());
    world_.take_output(0, output.size());
  }

  /// Runs until everything on the wire, or about to be sent, has been sent.
  void finish() {
    const SimTime end = world_.now() + kAfterwards;
    while (line().due() && world_.now() < end) advance(kAStep);
  }

  const pty::Line& line() const { return world_.line(0).line; }
  const emulator::Device& device() { return world_.device(0); }
  const emulator::world::StationCounters& counters() { return world_.line(0).stations[0]->counters(); }
  SimTime now() const { return world_.now(); }
  const std::vector<std::uint8_t>& sent() const { return sent_; }

 private:
  static emulator::world::Bench bench_for(const Input& input, int rotary_switch) {
    emulator::world::Bench bench;
    emulator::world::DeviceSetup device{
        .model = emulator::find_model(emulator::models::all_models(), "simple2-r3"), .settings = {}};
    device.settings.name = "device";
    device.settings.address = rotary_switch;
    device.settings.bauds = {115200};
    if (input.alternative_choices) {
      device.settings.choices = {{"station_0_request", "ignored"}, {"switch_0_broadcast", "silent"}};
    }
    bench.devices.push_back(device);
    bench.lines.push_back(
        {.name = "line", .link = {}, .baud = 115200, .timing = input.timing, .stations = {0}});
    return bench;
  }
  static emulator::world::WorldOptions options_for(const Input& input) {
    return {.strict_framing = input.strict_framing, .enforce_settings = false};
  }

  emulator::world::World world_;
  std::function<void()> make_anew_;
  std::vector<std::uint8_t> sent_;
};

/// Returns the length of the reply that begins here; nothing if it is not a reply.
std::optional<std::size_t> reply_size(std::span<const std::uint8_t> sent) {
  if (sent.size() < 5) return std::nullopt;
  if ((sent[1] & 0x80) != 0) return 5;
  switch (sent[1]) {
    case 0x03:
    case 0x04: return 5U + sent[2];
    case 0x06:
    case 0x10: return 8;
    default: return std::nullopt;
  }
}

void check_replies(Listener& listener, int rotary_switch) {
  if (listener.line().counters().bytes_discarded > 0) return;  // it sent faster than the wire carries
  std::span<const std::uint8_t> sent = listener.sent();
  std::uint64_t replies = 0;
  std::uint64_t exceptions = 0;
  while (!sent.empty()) {
    const auto size = reply_size(sent);
    require(size && *size <= sent.size(), "replies are whole frames");
    require(*size <= 256, "a reply is no longer than 256 bytes");
    require(pty::rtu_crc_ok(sent.first(*size)), "a reply has a right checksum");
    require(rotary_switch == 0 || sent[0] == rotary_switch, "a station gives its own number");
    if ((sent[1] & 0x80) != 0) {
      ++exceptions;
      require(sent[2] >= 1 && sent[2] <= 3, "there are three exceptions");
    }
    ++replies;
    sent = sent.subspan(*size);
  }
  require(replies == listener.counters().replies, "every reply leaves");
  require(exceptions == listener.counters().exceptions, "exceptions are counted");
  require(replies <= listener.counters().requests, "nothing is said without a request");
}

/// The listeners for one set of options.
struct Crowd {
  explicit Crowd(const Input& input)
      : listener(input, input.rotary_switch),
        stepped(input, input.rotary_switch, false),
        other(input, input.other_switch),
        untouched(input, input.other_switch) {}

  Listener listener;
  Listener stepped;  // the same, every tick run one by one
  Listener other;    // receives the same, but few requests are for it
  Listener untouched;
};

void play(Listener& listener, const Input& input) {
  listener.restart();
  for (const Lump& lump : input.lumps) listener.hear(lump);
  listener.finish();
}

/// Made on first use.
Crowd& crowd_for(const Input& input, std::uint8_t options) {
  static std::array<std::unique_ptr<Crowd>, kSettings> crowds;
  auto& crowd = crowds[options % kSettings];
  if (!crowd) crowd = std::make_unique<Crowd>(input);
  return *crowd;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Input input = read_input({data, size});
  Crowd& crowd = crowd_for(input, data[0]);
  Listener& listener = crowd.listener;
  play(listener, input);
  check_replies(listener, input.rotary_switch);
  if (!fuzzing::is_checked_wholly({data, size})) return 0;

  Listener& stepped = crowd.stepped;
  play(stepped, input);
  require(stepped.sent() == listener.sent(), "ticks left out are not to be seen on the line");
  require(stepped.now() == listener.now(), "nor do they take another time");
  fuzzing::require_same_state(stepped.device(), listener.device(), "ticks left out leave the same state");

  Listener& other = crowd.other;
  play(other, input);
  check_replies(other, input.other_switch);
  if (other.counters().requests == 0) {
    Listener& untouched = crowd.untouched;
    untouched.restart();
    untouched.advance(other.now());
    fuzzing::require_same_state(other.device(), untouched.device(), "frames for others change nothing");
    require(other.sent().empty(), "frames for others are not answered");
  }
  return 0;
}
