// Hashes everything that a world outputs: every byte on every line with its time, in both directions, and
// the pulses of every axis and every output of any kind in every tick. Two runs with the same hash behaved
// the same.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/world/world.h"

namespace understudy::emulator::world {

class OutcomeHash final : public TickWatcher {
 public:
  /// Starts hashing at this moment. The world must outlive it.
  explicit OutcomeHash(World& world);
  ~OutcomeHash() override;
  OutcomeHash(const OutcomeHash&) = delete;
  OutcomeHash& operator=(const OutcomeHash&) = delete;

  void on_tick(Tick tick) override;
  std::uint64_t value() const { return hash_; }
  /// Continues from a value that an earlier hash had.
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
