#include "interpreter/rs_m8194h/download.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

bool is_label(const Command& command, std::uint32_t number) {
  return command.verb() == Verb::label && command.values[0] == number;
}

/// The fault of a line in each kind of block. The innermost block decides.
struct BlockRule {
  Verb verb;
  Fault outside;
  Fault in_if;
  Fault in_for;
};
constexpr auto kBlockRules = std::to_array<BlockRule>({
    {Verb::else_, Fault::else_outside, Fault::none, Fault::else_outside},
    {Verb::end_if, Fault::end_if_outside, Fault::none, Fault::end_if_outside},
    {Verb::next, Fault::next_outside, Fault::next_outside, Fault::none},
    {Verb::label, Fault::none, Fault::label_in_if, Fault::label_in_for},
});
/// The fault of a line if the number of open blocks of its kind, innermost or not, is out of range.
struct DepthRule {
  Verb verb;
  Verb opener;
  int min;
  int max;
  Fault fault;
};
constexpr auto kDepthRules = std::to_array<DepthRule>({
    {Verb::if_, Verb::if_, 0, kDeepest - 1, Fault::if_too_deep},
    {Verb::for_, Verb::for_, 0, kDeepest - 1, Fault::for_too_deep},
    {Verb::exit_for, Verb::for_, 1, kDeepest, Fault::exit_for_outside},
});

Fault block_fault(const std::vector<Command>& lines, const Command& command, const Options& options) {
  const Verb verb = command.verb();
  for (const BlockRule& rule : kBlockRules) {
    if (rule.verb != verb) continue;
    const Blocks blocks = blocks_behind(lines);
    if (blocks.empty()) return rule.outside;
    if (verb == Verb::else_ && blocks.back().has_else) return rule.outside;
    return blocks.back().opener == Verb::if_ ? rule.in_if : rule.in_for;
  }
  if (verb == Verb::goto_ && options.chose(option("goto_out_of_blocks", "is_refused_as_without_its_label")) &&
      !blocks_behind(lines).empty()) {
    return Fault::goto_without_label;  // labels are outside all blocks
  }
  for (const DepthRule& rule : kDepthRules) {
    if (rule.verb != verb) continue;
    const Blocks blocks = blocks_behind(lines);
    const bool opens = verb == rule.opener;
    const int open = opens && options.chose(option("block_levels", "of_both_together"))
                         ? static_cast<int>(blocks.size())
                         : count_open(blocks, rule.opener);
    return open >= rule.min && open <= rule.max ? Fault::none : rule.fault;
  }
  return Fault::none;
}

constexpr std::size_t kOperator = 1;  // the parameter of VAR_CALCULATE

Fault line_fault(const Download& download, const Command& command, const Options& options) {
  if (command.row().macro_lines() > room_of(download, options)) return Fault::macro_memory;
  if (const Fault fault = operand_fault(command); fault != Fault::none) {
    const bool is_operator = command.verb() == Verb::var_calculate && bad_operand(command) == kOperator;
    return is_operator && options.chose(option("wrong_arithmetic", "06_as_of_an_operator"))
               ? Fault::comparison
               : fault;
  }
  const bool is_twice =
      command.verb() == Verb::label && std::ranges::any_of(download.lines, [&command](const Command& other) {
        return is_label(other, command.values[0]);
      });
  if (is_twice) return Fault::label_twice;
  return block_fault(download.lines, command, options);
}

void fail(Download& download, Fault fault, std::uint16_t code, std::size_t line, const Options& options) {
  if (download.fault != Fault::none && !options.chose(option("kept_error", "the_last"))) return;
  download.fault = fault;
  download.code = code;
  download.line = static_cast<std::uint16_t>(line);
}

/// Returns a GOTO whose label is missing, or null.
const Command* lost_jump(const std::vector<Command>& lines) {
  const auto lost = std::ranges::find_if(lines, [&lines](const Command& jump) {
    return jump.verb() == Verb::goto_ && std::ranges::none_of(lines, [&jump](const Command& command) {
             return is_label(command, jump.values[0]);
           });
  });
  return lost == lines.end() ? nullptr : &*lost;
}

}  // namespace

int room_of(const Download& download, const Options& options) {
  return capacity_of(download.name) - (options.chose(option("close_line", "one_line")) ? 1 : 0) -
         lines_used(download.lines);
}

Fault add(Download& download, const Command& command, const Options& options) {
  const Fault fault = line_fault(download, command, options);
  if (fault == Fault::none) {
    download.lines.push_back(command);
  } else {
    fail(download, fault, command.code, download.lines.size(), options);
  }
  return options.chose(option("structure_faults", "at_close")) ? Fault::none : fault;
}

void refuse(Download& download, std::uint16_t code, Fault fault, const Options& options) {
  if (is_download_error(fault)) {
    fail(download, fault, code, download.lines.size(), options);
  } else if (options.chose(option("refused_lines", "spoil_the_download"))) {
    download.is_spoilt = true;
  }
}

Closed close(Download& download, const Options& options) {
  if (options.chose(option("structure_faults", "at_close")) && download.fault != Fault::none)
    return {.fault = download.fault};
  const std::vector<Command>& lines = download.lines;
  if (const Blocks blocks = blocks_behind(lines); !blocks.empty()) {
    const Block& open = blocks.front();
    const Fault fault = open.opener == Verb::if_ ? Fault::if_open : Fault::for_open;
    fail(download, fault, lines[open.line].code, open.line, options);
    return {.fault = fault};
  }
  if (const Command* jump = lost_jump(lines)) {
    const auto line = static_cast<std::size_t>(jump - lines.data());
    fail(download, Fault::goto_without_label, jump->code, line, options);
    return {.fault = Fault::goto_without_label};
  }
  if (download.fault != Fault::none || download.is_spoilt) return {};
  return {.macro = linked(lines)};
}

DownloadStatus status_of(const Download& closed, const DownloadStatus& before, const Options& options) {
  DownloadStatus status = before;
  (closed.name.is_isr ? status.isr : status.mp) = static_cast<std::uint16_t>(closed.name.number);
  const auto shown = [&options](std::uint16_t code) {
    const bool is_real_time = options.chose(option("download_command", "as_0a_code"));
    return is_real_time ? real_time_code(verb_of(code)) : code;
  };
  if (closed.fault != Fault::none) {
    status.command = shown(closed.code);
    status.line = closed.line;
  } else if (options.chose(option("status_of_good_download", "of_its_close"))) {
    status.command = shown(macro_code(closed.name.is_isr ? Verb::isr_close : Verb::mp_close));
    status.line = static_cast<std::uint16_t>(closed.lines.size());
  } else if (options.chose(option("status_of_good_download", "0"))) {
    status.command = status.line = 0;
  }
  status.error = row_of(closed.fault).download_error;
  return status;
}

}  // namespace understudy::interpreter::rs_m8194h
