// Converts the registers from 8000 on to a command (a code and its parameters), and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/options.h"

namespace understudy::interpreter::rs_m8194h {

/// The state that input 100 shows.
enum class State : std::uint8_t { ready, mp_download, isr_download };

/// The word order of 32-bit parameters, which holding register 14 selects.
enum class WordOrder : std::uint8_t { high_first, low_first };

struct Decoded {
  Command command = {};  // at least its code is set
  Fault fault = Fault::none;
  std::optional<std::size_t> parameter = {};  // the refused parameter
};

/// Decodes a message that begins at 8000. The checks have the order of [1.3]: undefined code, class refused
/// in this state, number of registers, parameters. Afterwards, the download may still refuse a macro line.
Decoded decode(std::span<const std::uint16_t> registers, State state, WordOrder order = WordOrder::high_first,
               const Options& options = {});

/// The steps of decode(), for other orders of the checks.
Fault why_not_now(std::uint16_t code, State state);
Fault read_registers(std::span<const std::uint16_t> registers, WordOrder order, Command& command,
                     const Options& options = {});

/// Encodes a command in the form that decode() accepts with the same options.
std::vector<std::uint16_t> encode(const Command& command, WordOrder order = WordOrder::high_first,
                                  const Options& options = {});

}  // namespace understudy::interpreter::rs_m8194h
