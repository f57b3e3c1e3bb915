// A hash of all that a world says: every byte on every line with its time, in both directions, the pulses of
// every axis and every output in every tick, whatever its kind. Two runs with one hash did the same.
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
  /// Outputs that are neighbours in a model's table.
  struct Outputs {
    TerminalRow::Kind kind = TerminalRow::Kind::digital_out;
    int first = 0;
    int count = 1;
  };
  static std::vector<Outputs> outputs_of(const Model& model);
  void add(std::uint64_t number);
  void add_outputs(const Device& device, const std::vector<Outputs>& outputs);

  World& world_;
  std::vector<std::unique_ptr<Ear>> ears_;     // one a line
  std::vector<std::vector<Outputs>> outputs_;  // by device
  std::uint64_t hash_;
};

}  // namespace understudy::emulator::world
