// The selected options for commands and macros. The interpreter looks them up through this header.
#pragma once

#include <string_view>

#include "base/choices.h"
#include "interpreter/rs_m8194h/choices.h"

namespace understudy::interpreter::rs_m8194h {

using Options = OptionsOf<kChoices>;

consteval Options::Named option(std::string_view id, std::string_view name) {
  return Options::named(id, name);
}

}  // namespace understudy::interpreter::rs_m8194h
