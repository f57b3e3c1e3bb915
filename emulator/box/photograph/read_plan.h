// Plans the requests, within the model's limits, that read all of a model's registers.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator::box {

/// A register that can be read.
struct ReadCell {
  const RegisterRow* row = nullptr;
  int index = 0;
  std::uint16_t address = 0;
  int size = 1;  // in words, or bits
};

/// Neighbouring registers that one request reads.
struct ReadBlock {
  Table table = Table::holding;
  std::vector<ReadCell> cells;

  std::uint16_t first() const { return cells.front().address; }
  int count() const { return cells.back().address + cells.back().size - first(); }
};

/// Returns blocks in ascending order: coils, discrete inputs, holding and input registers. Registers that
/// cannot be read, and tables without a function in the model, are left out.
std::vector<ReadBlock> read_plan(const Model& model);

/// Returns both halves of a block of several cells.
std::pair<ReadBlock, ReadBlock> halves_of(const ReadBlock& block);

}  // namespace understudy::emulator::box
