#include "interpreter/rs_m8194h/macro.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

/// Updates the open blocks for a line. A line that closes a block that is not open does nothing.
void advance(Blocks& blocks, const Command& command, std::size_t line) {
  const Verb verb = command.verb();
  const bool is_in_if = !blocks.empty() && blocks.back().opener == Verb::if_;
  const bool is_in_for = !blocks.empty() && blocks.back().opener == Verb::for_;
  if (verb == Verb::if_ || verb == Verb::for_) {
    blocks.push_back({.opener = verb, .line = static_cast<std::uint16_t>(line)});
  } else if (verb == Verb::else_ && is_in_if) {
    blocks.back().has_else = true;
  } else if ((verb == Verb::end_if && is_in_if) || (verb == Verb::next && is_in_for)) {
    blocks.pop_back();
  }
}

class Linker {
 public:
  explicit Linker(Macro& macro) : macro_(macro) {}

  void run() {
    macro_.leads_to.resize(macro_.size());
    labels_.fill(0);
    for (std::size_t i = 0; i < macro_.size(); ++i) {
      macro_.leads_to[i] = behind(i);
      note(i);
    }
    for (std::size_t i = 0; i < macro_.size(); ++i) {
      const Command& command = macro_.lines[i];
      if (command.verb() == Verb::goto_) macro_.leads_to[i] = labels_[command.values[0]];
    }
  }

 private:
  struct OpenFor {
    std::size_t line;
    std::vector<std::size_t> exits = {};  // EXIT_FOR
  };

  static std::uint16_t behind(std::size_t line) { return static_cast<std::uint16_t>(line + 1); }

  void note(std::size_t line) {
    const Verb verb = macro_.lines[line].verb();
    if (verb == Verb::if_) ifs_.push_back(line);
    if (verb == Verb::else_ || verb == Verb::end_if) {
      macro_.leads_to[ifs_.back()] = behind(line);
      ifs_.back() = line;
    }
    if (verb == Verb::end_if) ifs_.pop_back();
    if (verb == Verb::for_) fors_.push_back({line});
    if (verb == Verb::exit_for) fors_.back().exits.push_back(line);
    if (verb == Verb::next) {
      macro_.leads_to[line] = behind(fors_.back().line);
      macro_.leads_to[fors_.back().line] = behind(line);
      for (const std::size_t exit : fors_.back().exits) macro_.leads_to[exit] = behind(line);
      fors_.pop_back();
    }
    if (verb == Verb::label) labels_[macro_.lines[line].values[0]] = static_cast<std::uint16_t>(line);
  }

  Macro& macro_;
  std::vector<std::size_t> ifs_;  // each open IF, or the ELSE after it
  std::vector<OpenFor> fors_;
  std::array<std::uint16_t, kLabelCount> labels_{};
};

}  // namespace

std::string to_string(const MacroName& name) {
  return (name.is_isr ? "ISR" : "MP") + std::to_string(name.number);
}

int lines_used(const std::vector<Command>& lines) {
  int used = 0;
  for (const Command& command : lines) used += command.row().macro_lines();
  return used;
}

Blocks blocks_behind(const std::vector<Command>& lines) {
  Blocks blocks;
  for (std::size_t i = 0; i < lines.size(); ++i) advance(blocks, lines[i], i);
  return blocks;
}

int count_open(const Blocks& blocks, Verb opener) {
  return static_cast<int>(std::ranges::count(blocks, opener, &Block::opener));
}

Macro linked(std::vector<Command> lines) {
  Macro macro{.lines = std::move(lines)};
  Linker(macro).run();
  return macro;
}

}  // namespace understudy::interpreter::rs_m8194h
