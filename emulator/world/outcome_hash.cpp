#include "emulator/world/outcome_hash.h"
#include "emulator/device/terminals.h"

#include <array>

#include "base/state/state_bytes.h"

namespace understudy::emulator::world {

/// What is said on one line.
class OutcomeHash::Ear final : public pty::LineObserver {
 public:
  Ear(OutcomeHash& hash, std::size_t line) : hash_(hash), line_(line) {
    hash_.world_.add_observer(line_, *this);
  }
  ~Ear() override { hash_.world_.remove_observer(line_, *this); }
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;

  void on_start_bit(SimTime) override {}
  void on_character(const pty::TimedByte& character, bool is_heard) override {
    begin(character.end);
    hash_.add(static_cast<std::uint64_t>(character.value) << 1 | (is_heard ? 1 : 0));
  }
  void on_nothing_more() override {}
  void on_speech(const pty::Speech& speech) override {
    begin(speech.start);
    hash_.add(speech.bytes.size() << 2 | (speech.has_collided ? 2 : 0) | (speech.is_for_host ? 1 : 0));
    for (const std::uint8_t byte : speech.bytes) hash_.add(byte);
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
    ears_.push_back(std::make_unique<Ear>(*this, i));
  }
  world.add_watcher(*this);
}

OutcomeHash::~OutcomeHash() { world_.remove_watcher(*this); }

void OutcomeHash::add(std::uint64_t number) {
  std::array<std::byte, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(number >> (8 * i));
  hash_ = hash_of(bytes, hash_);
}

void OutcomeHash::on_tick(Tick tick) {
  add(static_cast<std::uint64_t>(tick));
  for (std::size_t d = 0; d < world_.device_count(); ++d) {
    const Device& device = world_.device(d);
    for (std::size_t a = 0; a < device.model().axes.size(); ++a) {
      add(static_cast<std::uint64_t>(world_.sent_pulses(d, static_cast<int>(a))));
    }
    std::uint64_t outputs = 0;
    const auto terminals = device.model().terminals;
    for (std::size_t i = 0; i < terminals.size(); ++i) {
      if (!is_input(terminals[i].kind))
        outputs = outputs << 1 | (device.terminals()->output(static_cast<int>(i)) ? 1 : 0);
    }
    add(outputs);
  }
}

}  // namespace understudy::emulator::world
