// Models the persistent memory for a register image: an EEPROM, and optionally battery-backed RAM or FRAM. A
// write to a persistent register is queued and takes time; afterwards, the value survives power-off. In
// battery-backed RAM or FRAM, a register survives as soon as it is written. The class is a value: it can be
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
  /// `factory` contains the factory value of each slot. `is_persistent` indicates which slots are persistent,
  /// and `at_once` which of those are stored without delay, in battery-backed RAM or FRAM (by default, none).
  Eeprom(std::span<const std::uint32_t> factory, std::span<const bool> is_persistent,
         std::span<const bool> at_once = {});

  /// Queues a register that was written after tick `now`; `bits` is its content. A value that is already
  /// stored is not written again (unless `even_if_same`), and a register that is already waiting keeps its
  /// place in the queue. Battery-backed RAM or FRAM stores the value immediately.
  void write(std::size_t slot, std::uint32_t bits, Tick takes, Tick now, bool even_if_same = false);
  /// Starts writing the whole image as it is now, and drops all waiting writes, as an erasure does.
  void rewrite(std::span<const std::uint32_t> image, Tick takes, Tick now);
  /// Called at the end of `tick`: stores the writes that are finished. A single register is stored with the
  /// value that it had in the image when its write began. If it has changed since, the new value is written
  /// afterwards.
  void step(Tick tick, std::span<const std::uint32_t> image);
  /// Stores everything at once.
  void settle(std::span<const std::uint32_t> image);
  /// Handles a power failure: waiting writes are lost, and the register that is being written keeps its old
  /// value.
  void lose_power();
  /// Sets a stored value from outside.
  void put(std::size_t slot, std::uint32_t bits);

  bool writing() const { return done_at_ != kNever; }
  /// Returns the tick at whose end step() has something to do, or kNever if nothing is waiting.
  Tick next_active_tick() const { return done_at_; }
  std::span<const std::uint32_t> content() const { return content_; }
  /// Increases whenever the stored content changes.
  std::uint64_t revision() const { return revision_; }

  bool operator==(const Eeprom&) const = default;

  // --- its state as bytes (eeprom_fields.h) ------------------------------------------------
  enum class Slot : std::uint8_t { not_persistent, rests, waits, at_once };
  /// Throws StateError unless this can be a later state of `earlier`: it has the same registers, and its jobs
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

  /// Begins the first job. If the job is for one register, it writes `bits`.
  void begin(Tick at, std::uint32_t bits);
  void forget_jobs();
  void keep(std::size_t slot, std::uint32_t bits);
  /// With `even_at_once`, also stores the registers that are stored without delay.
  void keep_all(std::span<const std::uint32_t> image, bool even_at_once);

  Tick done_at_ = kNever;  // first, because each tick reads it
  std::uint64_t revision_ = 0;
  std::vector<std::uint32_t> content_;  // the stored values, by slot
  std::vector<Slot> slots_;
  std::vector<Job> jobs_;                 // the first job is in progress
  std::vector<std::uint32_t> rewriting_;  // the new values by slot during an erasure; otherwise empty
  std::uint32_t writing_ = 0;             // the value that the first job stores if it is for one register
};

}  // namespace understudy::emulator
