// The names of parameters, by which a program reaches registers: MEM0 to MEM31, VAR32 to VAR63, DAT64 to
// DAT143, and for 144 to 182 those of their registers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy::interpreter::simple2 {

/// The name in a listing. Nothing for a number that the manual does not define.
std::optional<std::string> parameter_name(std::uint8_t number);

/// By any of its names, in upper or lower case: as above, DAT144 to DAT182, or the other spelling of its
/// register.
std::optional<std::uint8_t> parameter_number(std::string_view name);

}  // namespace understudy::interpreter::simple2
