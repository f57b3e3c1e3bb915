#include "interpreter/slim/program.h"

#include <utility>

#include "interpreter/slim/availability.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

struct Checked {
  Error error = Error::none;
  StoredLine line = {};
};

Checked check(std::string_view text, const Dialect& dialect) {
  ParseResult result = parse_line(text, dialect);
  if (result.error != Error::none) return {.error = result.error};
  const std::string_view trimmed = without_blanks(text);
  if (trimmed.empty()) return {.error = Error::syntax};
  const auto& command = result.line.command;
  if (command && !is_allowed(*command, Place::program)) return {.error = Error::not_allowed};
  return {.line = {.text = std::string(trimmed), .parsed = std::move(result.line)}};
}

}  // namespace

Error Program::insert(int number, std::string_view text, const Dialect& dialect) {
  if (number < 0 || number > size()) return Error::range;
  if (size() >= kProgramCapacity) return Error::buffer_full;
  Checked checked = check(text, dialect);
  if (checked.error != Error::none) return checked.error;
  lines_.insert(lines_.begin() + number, std::move(checked.line));
  return Error::none;
}

Error Program::replace(int number, std::string_view text, const Dialect& dialect) {
  if (number < 0 || number >= size()) return Error::range;
  Checked checked = check(text, dialect);
  if (checked.error != Error::none) return checked.error;
  lines_[static_cast<std::size_t>(number)] = std::move(checked.line);
  return Error::none;
}

Error Program::remove(int number) {
  if (number < 0 || number >= size()) return Error::range;
  lines_.erase(lines_.begin() + number);
  return Error::none;
}

std::optional<int> Program::find(const Operand& address) const {
  if (address.kind == Operand::Kind::integer) {
    if (address.number < 0 || address.number >= size()) return std::nullopt;
    return static_cast<int>(address.number);
  }
  for (int i = 0; i < size(); ++i) {
    if (!line(i).parsed.label.empty() && line(i).parsed.label == address.text) return i;
  }
  return std::nullopt;
}

std::vector<std::string> Program::listing() const {
  std::vector<std::string> listed;
  for (int i = 0; i < size(); ++i) listed.push_back(std::to_string(i) + ": " + line(i).text);
  return listed;
}

std::vector<std::string> Program::upload() const {
  std::vector<std::string> sent = texts();
  sent.emplace_back("END");
  return sent;
}

std::vector<std::string> Program::texts() const {
  std::vector<std::string> texts;
  for (const StoredLine& line : lines_) texts.push_back(line.text);
  return texts;
}

bool Program::set_texts(const std::vector<std::string>& texts, const Dialect& dialect) {
  Program program;
  for (const std::string& text : texts) {
    if (program.insert(program.size(), text, dialect) != Error::none) return false;
  }
  *this = std::move(program);
  return true;
}

}  // namespace understudy::interpreter::slim
