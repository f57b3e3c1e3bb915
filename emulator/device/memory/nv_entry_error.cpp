#include "emulator/device/memory/nv_entry_error.h"

#include <string>
#include <utility>
#include <vector>

#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

NvEntryError refused_value(NvEntryError::List list, const std::string& name, const std::string& why) {
  const bool is_real = list == NvEntryError::List::reals;
  return {list, {}, name, why, (is_real ? "reals: " : "registers: ") + why};
}

bool take_away(const NvEntryError& refused, NvImage& image) {
  const auto is_it = [&](const auto& entry) { return entry.first == refused.name; };
  switch (refused.list) {
    case NvEntryError::List::firmware: return !std::exchange(image.firmware, "").empty();
    case NvEntryError::List::registers: return std::erase_if(image.registers, is_it) > 0;
    case NvEntryError::List::reals: return std::erase_if(image.reals, is_it) > 0;
    case NvEntryError::List::blocks: break;
  }
  if (refused.name.empty()) return image.blocks.erase(refused.kind) > 0;
  const auto of_kind = image.blocks.find(refused.kind);
  return of_kind != image.blocks.end() && of_kind->second.erase(refused.name) > 0;
}

}  // namespace understudy::emulator
