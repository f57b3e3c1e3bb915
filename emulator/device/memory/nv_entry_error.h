// What is wrong with one of the blocks of text in an NV image.
#pragma once

#include <string>
#include <utility>

#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

/// Of a kind of blocks itself, without a name.
struct BlockError : NvError {
  BlockError(std::string kind_of_it, std::string name_of_it, std::string what_is_wrong,
             const std::string& told)
      : NvError(told),
        kind(std::move(kind_of_it)),
        name(std::move(name_of_it)),
        complaint(std::move(what_is_wrong)) {}
  std::string kind;
  std::string name;
  std::string complaint;  // for messages that say already which block it is
};

}  // namespace understudy::emulator
