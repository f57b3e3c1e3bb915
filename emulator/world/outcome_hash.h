// A hash of all that a world says: every byte on every line with its time, in both directions, the pulses of
// every axis and every output in every tick. Two runs with one hash did the same.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/world/world.h"

namespace understudy::emulator::world {

class OutcomeHash final : public TickWatcher {
 public:
  /// Watches from this moment on; the world must outlive it.
  explicit OutcomeHash(World& world);
  ~OutcomeHash() override;
  OutcomeHash(const OutcomeHash&) = delete;
  OutcomeHash& operator=(const OutcomeHash&) = delete;

  void on_tick(Tick tick) override;
  std::uint64_t value() const { return hash_; }
  /// Goes on from a value that was there before.
  void restore(std::uint64_t value) { hash_ = value; }

 private:
  class Ear;
  void add(std::uint64_t number);

  World& world_;
  std::vector<std::unique_ptr<Ear>> ears_;  // one a line
  std::uint64_t hash_;
};

}  // namespace understudy::emulator::world
