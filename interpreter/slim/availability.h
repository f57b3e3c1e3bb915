// Decides which commands are allowed where: stored in a program, typed while no program runs, or from outside
// while one runs. The manual prints three columns without an explanation, and only for its second list.
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
