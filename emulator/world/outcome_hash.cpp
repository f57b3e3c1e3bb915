#include "emulator/world/outcome_hash.h"
#include "base/simulated_time.h"
#include "emulator/device/model.h"
#include "emulator/device/terminals.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/state/state_bytes.h"
#include "pty/line_observer.h"
#include "pty/station.h"

namespace understudy::emulator::world {

/// Hashes what hosts and stations send on one line.
class OutcomeHash::LineHasher final : public pty::LineObserver {
 public:
  LineHasher(OutcomeHash& hash, std::size_t line) : hash_(hash), line_(line) {
    hash_.world_.add_observer(line_, *this);
  }
  ~LineHasher() override { hash_.world_.remove_observer(line_, *this); }
  LineHasher(const LineHasher&) = delete;
  LineHasher& operator=(const LineHasher&) = delete;

  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte& character, bool is_received) override {
    begin(character.end);
    hash_.add(static_cast<std::uint64_t>(character.value) << 1 | (is_received ? 1 : 0));
  }
  void on_nothing_more() override {}
  void on_transmission(const pty::Transmission& transmission) override {
    begin(transmission.start);
    hash_.add(transmission.bytes.size() << 2 | (transmission.has_collided ? 2 : 0) |
              (transmission.is_for_host ? 1 : 0));
    for (const std::uint8_t byte : transmission.bytes) hash_.add(byte);
  }
  std::optional<SimTime> due() const override { return std::nullopt; }
  void run(SimTime) override {}

 private:
  void begin(SimTime time) {
    hash_.add(line_);
    hash_.add(static_cast<std::uint64_t>(time.count()));
  }

  OutcomeHash& hash_;
  std::size_t line_;
};

OutcomeHash::OutcomeHash(World& world) : world_(world), hash_(hash_of({})) {
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    line_hashers_.push_back(std::make_unique<LineHasher>(*this, i));
  }
  for (std::size_t d = 0; d < world.device_count(); ++d) {
    outputs_.push_back(outputs_of(world.device(d).model()));
  }
  world.add_watcher(*this);
}

OutcomeHash::~OutcomeHash() { world_.remove_watcher(*this); }

void OutcomeHash::add(std::uint64_t number) {
  std::array<std::byte, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(number >> (8 * i));
  hash_ = hash_of(bytes, hash_);
}

std::vector<OutcomeHash::Outputs> OutcomeHash::outputs_of(const Model& model) {
  std::vector<Outputs> all;
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    const TerminalRow::Kind kind = model.terminals[i].kind;
    const auto number = static_cast<int>(i);
    if (is_input(kind)) continue;
    const bool continues = !all.empty() && kind == TerminalRow::Kind::digital_out &&
                           all.back().kind == kind && all.back().first + all.back().count == number &&
                           all.back().count < TerminalGroup::kMax;
    if (continues) {
      ++all.back().count;
    } else {
      all.push_back({kind, number, 1});
    }
  }
  return all;
}

/// Adds the two-level outputs in words of 64 bits, with the first output in the highest bit, and then the
/// analog levels and pulse counts.
void OutcomeHash::add_outputs(const Device& device, const std::vector<Outputs>& outputs) {
  constexpr int kHashBits = 64;
  std::uint64_t word = 0;
  int taken = 0;
  for (const Outputs& some : outputs) {
    if (!has_two_levels(some.kind)) continue;
    const std::uint32_t levels = device.terminals()->output_word(some.first, some.count);
    for (int i = 0; i < some.count; ++i) {
      if (taken == kHashBits) {
        add(word);
        word = 0;
        taken = 0;
      }
      word = word << 1 | (levels >> i & 1);
      ++taken;
    }
  }
  add(word);
  for (const Outputs& some : outputs) {
    if (is_analog(some.kind)) add(static_cast<std::uint64_t>(device.terminals()->analog_level(some.first)));
    if (some.kind == TerminalRow::Kind::pulse_out)
      add(static_cast<std::uint64_t>(device.terminals()->output_pulses(some.first)));
  }
}

void OutcomeHash::on_tick(Tick tick) {
  add(static_cast<std::uint64_t>(tick));
  for (std::size_t d = 0; d < world_.device_count(); ++d) {
    const Device& device = world_.device(d);
    for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
      add(static_cast<std::uint64_t>(world_.sent_pulses(d, static_cast<int>(a))));
    }
    add_outputs(device, outputs_[d]);
  }
}

}  // namespace understudy::emulator::world
