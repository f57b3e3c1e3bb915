// The registers from 8000 on: a code and its parameters, as a value, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::interpreter::rs_m8194h {

/// Input 100.
enum class State : std::uint8_t { ready, mp_download, isr_download };

/// Of 32-bit parameters; holding 14.
enum class WordOrder : std::uint8_t { high_first, low_first };

struct Decoded {
  Command command = {};  // its code at least
  Fault fault = Fault::none;
  std::optional<std::size_t> parameter = {};  // the one that is refused
};

/// A message that begins at 8000, in the order of checks of [1.3]: an undefined code, a class that the state
/// refuses, the count of registers, parameters. A macro line may then still be refused by its download.
Decoded decode(std::span<const std::uint16_t> registers, State state, WordOrder order = WordOrder::high_first,
               const CommandOptions& options = {});

/// The steps of decode(), for other orders of checks.
Fault why_not_now(std::uint16_t code, State state);
Fault read_registers(std::span<const std::uint16_t> registers, WordOrder order, Command& command,
                     const CommandOptions& options = {});

/// As decode() takes it, with the same options.
std::vector<std::uint16_t> encode(const Command& command, WordOrder order = WordOrder::high_first,
                                  const CommandOptions& options = {});

}  // namespace understudy::interpreter::rs_m8194h
