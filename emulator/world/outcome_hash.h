// Hashes everything that a world outputs: every byte on every line with its time, in both directions, and, in
// every tick, the pulses of every axis and all outputs. Two runs with equal hashes behaved identically.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/world/world.h"

namespace understudy::emulator::world {

class OutcomeHash final : public TickWatcher {
 public:
  /// Starts hashing now. The world must outlive this object.
  explicit OutcomeHash(World& world);
  ~OutcomeHash() override;
  OutcomeHash(const OutcomeHash&) = delete;
  OutcomeHash& operator=(const OutcomeHash&) = delete;

  void on_tick(Tick tick) override;
  std::uint64_t value() const { return hash_; }
  /// Continues from the value of an earlier hash.
  void restore(std::uint64_t value) { hash_ = value; }

 private:
  class LineHasher;
  /// Adjacent outputs of one kind in a model's table.
  struct Outputs {
    TerminalRow::Kind kind = TerminalRow::Kind::digital_out;
    int first = 0;
    int count = 1;
  };
  static std::vector<Outputs> outputs_of(const Model& model);
  void add(std::uint64_t number);
  void add_outputs(const Device& device, const std::vector<Outputs>& outputs);

  World& world_;
  std::vector<std::unique_ptr<LineHasher>> line_hashers_;  // one per line
  std::vector<std::vector<Outputs>> outputs_;              // by device
  std::uint64_t hash_;
};

}  // namespace understudy::emulator::world
