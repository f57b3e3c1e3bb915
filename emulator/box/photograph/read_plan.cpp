#include "emulator/box/photograph/read_plan.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/stations/server.h"

namespace understudy::emulator::box {

namespace {

/// Returns the largest count of one read, or 0 if the model has no function for the table.
int most_at_once(const RtuRules& rules, Table table) {
  const world::FunctionRow* const row = world::function_for(table, world::FunctionRow::Kind::read);
  if (row == nullptr || std::ranges::find(rules.functions, row->code) == rules.functions.end()) return 0;
  int max = row->max;
  for (const FunctionLimit& limit : rules.limits)
    if (limit.code == row->code) max = std::min(max, limit.max);
  return max;
}

std::vector<ReadCell> cells_of(const Model& model, Table table) {
  std::vector<ReadCell> cells;
  for (const RegisterRow& row : register_rows(model)) {
    if (row.table != table || row.access == Access::write) continue;
    for (int i = 0; i < row.count; ++i) {
      cells.push_back({.row = &row,
                       .index = i,
                       .address = static_cast<std::uint16_t>(row.address + i * row.stride),
                       .size = is_32_bit(row.type) ? 2 : 1});
    }
  }
  std::ranges::sort(cells, {}, &ReadCell::address);
  return cells;
}

}  // namespace

std::vector<ReadBlock> read_plan(const Model& model) {
  std::vector<ReadBlock> blocks;
  if (!model.rtu) return blocks;
  for (const Table table : {Table::coil, Table::discrete, Table::holding, Table::input}) {
    const int max = most_at_once(*model.rtu, table);
    if (max == 0) continue;
    int end = -1;
    for (const ReadCell& cell : cells_of(model, table)) {
      const bool continues = cell.address == end && cell.address + cell.size - blocks.back().first() <= max;
      if (!continues) blocks.push_back({.table = table, .cells = {}});
      blocks.back().cells.push_back(cell);
      end = cell.address + cell.size;
    }
  }
  return blocks;
}

std::pair<ReadBlock, ReadBlock> halves_of(const ReadBlock& block) {
  const auto middle = block.cells.begin() + static_cast<std::ptrdiff_t>(block.cells.size() / 2);
  return {ReadBlock{.table = block.table, .cells = {block.cells.begin(), middle}},
          ReadBlock{.table = block.table, .cells = {middle, block.cells.end()}}};
}

}  // namespace understudy::emulator::box
