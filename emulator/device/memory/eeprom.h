// Models the memory behind a register image: an EEPROM, and optionally a battery-backed RAM or an FRAM. A
// write to a persistent register waits its turn and takes time; afterwards the value survives power-off. A
// register in battery-backed RAM or FRAM survives as soon as it is written. The class is a value: it can be
// copied and compared.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/simulated_time.h"

namespace understudy {
template <class T>
struct StateOf;
}  // namespace understudy

namespace understudy::emulator {

class Eeprom {
 public:
  Eeprom() = default;
  /// `factory` has the factory value of each slot; `is_persistent` says which slots are persistent. `at_once`
  /// says which of those are stored without delay, in battery-backed RAM or FRAM; by default none.
  Eeprom(std::span<const std::uint32_t> factory, std::span<const bool> is_persistent,
         std::span<const bool> at_once = {});

  /// Queues a register that was written after tick `now`; `bits` is its content. A value that is already
  /// stored is not written again (unless `even_if_same`), and a register that is already waiting keeps its
  /// place in the queue. Battery-backed RAM or FRAM stores the value at once.
  void write(std::size_t slot, std::uint32_t bits, Tick takes, Tick now, bool even_if_same = false);
  /// Starts writing the whole image as it is now, in place of all waiting writes, as an erasure does.
  void rewrite(std::span<const std::uint32_t> image, Tick takes, Tick now);
  /// Called at the end of `tick`: stores the writes that are finished. A single register is stored with its
  /// value in the image when its write began: a later value is written after it.
  void step(Tick tick, std::span<const std::uint32_t> image);
  /// Stores everything at once.
  void settle(std::span<const std::uint32_t> image);
  /// Handles a power failure: waiting writes are lost, and the register being written keeps its old value.
  void lose_power();
  /// Sets a stored value from outside.
  void put(std::size_t slot, std::uint32_t bits);

  bool writing() const { return done_at_ != kNever; }
  /// Returns the tick at whose end step() has something to do, or kNever if nothing is waiting.
  Tick next_active_tick() const { return done_at_; }
  std::span<const std::uint32_t> content() const { return content_; }
  /// Grows with every stored change.
  std::uint64_t revision() const { return revision_; }

  bool operator==(const Eeprom&) const = default;

  // --- its state as bytes (eeprom_fields.h) ------------------------------------------------
  enum class Slot : std::uint8_t { not_persistent, rests, waits, at_once };
  /// Throws StateError unless it can be a later state of `earlier`: it has the same registers, and its jobs
  /// are possible.
  void check_restored(const Eeprom& earlier) const;

 private:
  template <class T>
  friend struct understudy::StateOf;

  struct Job {
    std::uint32_t slot = 0;
    Tick takes = 0;
    bool operator==(const Job&) const = default;
  };
  static constexpr std::uint32_t kEverything = UINT32_MAX;

  /// Begins the first job, which writes `bits` if it is that of one register.
  void begin(Tick at, std::uint32_t bits);
  void forget_jobs();
  void keep(std::size_t slot, std::uint32_t bits);
  /// With `even_at_once`, also stores the registers that need no time.
  void keep_all(std::span<const std::uint32_t> image, bool even_at_once);

  Tick done_at_ = kNever;  // the first member, because each tick reads it
  std::uint64_t revision_ = 0;
  std::vector<std::uint32_t> content_;  // the stored values, by slot
  std::vector<Slot> slots_;
  std::vector<Job> jobs_;                 // the first is in progress
  std::vector<std::uint32_t> rewriting_;  // the new values by slot, during an erasure; otherwise empty
  std::uint32_t writing_ = 0;             // the value that the first job stores, if it stores one register
};

}  // namespace understudy::emulator
