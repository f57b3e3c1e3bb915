// The memory behind a register image: an EEPROM, and beside it what is kept at once. What is written to a
// kept register waits its turn and takes its time; after that it survives power-off. What a battery or an
// FRAM holds survives from the write on. A value: it can be copied and compared.
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
  /// What the factory put there, and for each slot whether it is kept at all.
  /// `at_once`: those of them that a battery or an FRAM keeps, without time; by default none.
  Eeprom(std::span<const std::uint32_t> factory, std::span<const bool> is_kept,
         std::span<const bool> at_once = {});

  /// A register was written after tick `now`; `bits` is what it holds. A value that is kept already is not
  /// written again, and one that waits keeps its place. `even_if_same`: also write what is there already.
  void write(std::size_t slot, std::uint32_t bits, Tick takes, Tick now, bool even_if_same = false);
  /// Writes everything at once, as it is in the image now, in place of all that waits, as an erasure does.
  void rewrite(std::span<const std::uint32_t> image, Tick takes, Tick now);
  /// At the end of `tick`: keeps what is done, single registers with the values that the image has then.
  void step(Tick tick, std::span<const std::uint32_t> image);
  /// Keeps everything at once.
  void settle(std::span<const std::uint32_t> image);
  /// The power fails: what waits is lost, and what was being written keeps its old value.
  void lose_power();
  /// From outside.
  void put(std::size_t slot, std::uint32_t bits);

  bool writing() const { return done_at_ != kNever; }
  /// The tick at whose end step() has something to do; kNever if nothing waits.
  Tick next_active_tick() const { return done_at_; }
  std::span<const std::uint32_t> kept() const { return kept_; }
  /// Grows with everything that is kept.
  std::uint64_t revision() const { return revision_; }

  bool operator==(const Eeprom&) const = default;

  // --- its state as bytes (eeprom_fields.h) ------------------------------------------------
  enum class Slot : std::uint8_t { not_kept, rests, waits, at_once };
  /// Throws StateError unless it can be a later state of `earlier`: of the same registers, with jobs that can
  /// be done.
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

  void begin(Tick at);
  void forget_jobs();
  void keep(std::size_t slot, std::uint32_t bits);
  /// `even_at_once`: also what needs no time.
  void keep_all(std::span<const std::uint32_t> image, bool even_at_once);

  Tick done_at_ = kNever;  // first: each tick looks at it
  std::uint64_t revision_ = 0;
  std::vector<std::uint32_t> kept_;  // by slot
  std::vector<Slot> slots_;
  std::vector<Job> jobs_;                 // the first is being done
  std::vector<std::uint32_t> rewriting_;  // by slot, while everything is; else empty
};

}  // namespace understudy::emulator
