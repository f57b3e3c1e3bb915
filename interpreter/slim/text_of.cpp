#include "interpreter/slim/text_of.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/slots.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

std::string element(std::string_view array, const Operand& operand) {
  return std::string(array) + (operand.index_is_variable ? "(N" : "(") + std::to_string(operand.index) + ")";
}

std::string joined(std::span<const Operand> operands) {
  std::string text;
  for (const Operand& operand : operands) {
    if (!text.empty()) text += ',';
    text += text_of(operand);
  }
  return text;
}

std::string text_of_assignment(const CommandRow& row, const Command& command) {
  if (row.verb == Verb::set_parameter) return command.name + "=" + text_of(command.operands[0]);
  const bool has_name = row.verb != Verb::set_variable || command.row == row_of("AIN=N#");
  if (has_name) return std::string(row.command) + "=" + text_of(command.operands[0]);
  return text_of(command.operands[0]) + "=" + text_of(command.operands[1]);
}

}  // namespace

std::string text_of(double number) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return std::string(digits.data(), end);
}

std::string text_of(const Operand& operand) {
  switch (operand.kind) {
    case Kind::integer: return std::to_string(static_cast<std::int64_t>(operand.number));
    case Kind::real: {
      // A whole number needs a point; otherwise, it would be an integer where both are allowed.
      const std::string text = text_of(operand.number);
      return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
    }
    case Kind::integer_variable: return "N" + std::to_string(operand.index);
    case Kind::real_variable: return "R" + std::to_string(operand.index);
    case Kind::integer_array: return element("NS", operand);
    case Kind::real_array: return element("RS", operand);
    case Kind::port: return "P" + std::to_string(operand.index);
    case Kind::label: return "$" + operand.text;
    case Kind::text: {
      // A text that contains a quote was sent with full-width quotes.
      const bool is_plain = operand.text.find('"') == std::string::npos;
      return is_plain ? "\"" + operand.text + "\"" : "\xE2\x80\x9C" + operand.text + "\xE2\x80\x9D";
    }
    case Kind::analog: return "AIN";
    case Kind::clock: return "TM";
    case Kind::get_integer: return "GETI";
    case Kind::get_real: return "GETR";
    case Kind::quantity: return operand.text;
    case Kind::event: return "EV" + std::to_string(operand.index);
    case Kind::condition: return std::string(condition_word(static_cast<Condition>(operand.index)));
  }
  return {};
}

std::string text_of(const Command& command) {
  const CommandRow& row = kCommands[static_cast<std::size_t>(command.row)];
  const std::string prefix = command.module < 0 ? "" : "T" + std::to_string(command.module);
  const std::span<const Operand> operands = command.operands;
  if (row.is_query()) {
    std::string text = "?" + prefix + command.name;
    if (operands.empty()) return text;
    if (!command.name.empty()) text += ' ';
    return text + joined(operands);
  }
  if (row.is_assignment()) return prefix + text_of_assignment(row, command);

  std::string text = prefix + std::string(row.takes_module() ? row.command.substr(2) : row.command);
  if (row.verb == Verb::set_event) {
    return text + std::to_string(operands[0].index) + " " + joined(operands.subspan(1));
  }
  if (row.verb == Verb::on_event) {
    return text + std::to_string(operands[0].index) + "," + joined(operands.subspan(1));
  }
  return operands.empty() ? text : text + " " + joined(operands);
}

std::string text_of(const ParsedLine& line) {
  const std::string label = line.label.empty() ? "" : "$" + line.label;
  if (!line.command) return label;
  return (label.empty() ? "" : label + " ") + text_of(*line.command);
}

}  // namespace understudy::interpreter::slim
