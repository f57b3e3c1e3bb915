// Decides where a command is allowed: stored in a program, typed while no program runs, or from outside while
// a program runs. The manual has three columns for this, without an explanation and only in its second list.
#pragma once

#include <cstdint>

#include "interpreter/slim/command.h"
#include "interpreter/slim/options.h"

namespace understudy::interpreter::slim {

enum class Place : std::uint8_t {
  program,    // 程式
  immediate,  // 立即: typed while no program runs
  external,   // 外部: typed while a program runs
};

bool is_allowed(const Command& command, Place place, const Options& options = {});

}  // namespace understudy::interpreter::slim
