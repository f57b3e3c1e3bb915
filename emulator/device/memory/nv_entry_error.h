// Reports a wrong entry of an NV image. To find all wrong entries, remove the reported one and check again.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

struct NvEntryError : NvError {
  enum class List { firmware, registers, reals, blocks };

  NvEntryError(List list_of_it, std::string kind_of_it, std::string name_of_it, std::string what_is_wrong,
               const std::string& message, std::size_t line_of_it = 0)
      : NvError(message, line_of_it),
        list(list_of_it),
        kind(std::move(kind_of_it)),
        name(std::move(name_of_it)),
        diagnostic(std::move(what_is_wrong)) {}
  List list;
  std::string kind;        // if the entry is a block, its kind
  std::string name;        // the name of the entry; for blocks, an empty name means all blocks of this kind
  std::string diagnostic;  // for messages that already contain the entry's name
};

/// Creates the error for a refused value. Its text is "registers: " or "reals: ", followed by the reason.
NvEntryError refused_value(NvEntryError::List list, const std::string& name, const std::string& why);

/// Removes the refused entry. Returns true if the image contained it.
bool take_away(const NvEntryError& refused, NvImage& image);

}  // namespace understudy::emulator
