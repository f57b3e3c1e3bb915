#include "interpreter/slim/program.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/slim/availability.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

/// As a line of a program, it would cut the program off when that is sent back with DLP.
bool ends_transfer(std::string_view text) {
  const std::string word = in_capitals(text);
  return word == "END" || word == "EXIT" || text.find('\x1B') != std::string_view::npos;
}

/// `$A NONSENSE` is a place to jump to all the same.
std::string label_of(std::string_view text) {
  if (!text.starts_with('$')) return {};
  return parse_line(text.substr(0, text.find_first_of(" \t"))).line.label;
}

}  // namespace

Program::Checked Program::check(std::string_view text, int replaced, const ProgramOptions& options) const {
  ParseResult result = parse_line(text, options.dialect);
  if (result.error != Error::none) return {.error = result.error};
  const std::string_view trimmed = without_blanks(text);
  if (trimmed.empty()) return {.error = Error::syntax};
  const auto& command = result.line.command;
  if (command && !is_allowed(*command, Place::program, options.columns)) return {.error = Error::not_allowed};
  if (command && options.check_command != nullptr) {
    if (const Error error = options.check_command(*command); error != Error::none) return {.error = error};
  }
  const std::string& label = result.line.label;
  if (!label.empty() && options.same_label == ProgramOptions::SameLabel::refused) {
    for (int i = 0; i < size(); ++i) {
      if (i != replaced && line(i).parsed.label == label) return {.error = Error::address};
    }
  }
  return {.line = {.text = std::string(trimmed), .parsed = std::move(result.line)}};
}

Program::Checked Program::check_as_chosen(std::string_view text, int replaced,
                                          const ProgramOptions& options) const {
  Checked checked = check(text, replaced, options);
  if (checked.error == Error::none || options.check == ProgramOptions::Check::as_entered) return checked;
  const std::string_view trimmed = without_blanks(text);
  if (trimmed.empty() || text.size() > options.dialect.longest_line || ends_transfer(trimmed)) return checked;
  return {
      .line = {.text = std::string(trimmed), .parsed = {.label = label_of(trimmed)}, .error = checked.error}};
}

Error Program::insert(int number, std::string_view text, const ProgramOptions& options) {
  if (number < 0 || number > size()) return Error::range;
  if (size() >= options.capacity) return Error::buffer_full;
  Checked checked = check_as_chosen(text, -1, options);
  if (checked.error != Error::none) return checked.error;
  lines_.insert(lines_.begin() + number, std::move(checked.line));
  return Error::none;
}

Error Program::replace(int number, std::string_view text, const ProgramOptions& options) {
  if (number < 0 || number >= size()) return Error::range;
  Checked checked = check_as_chosen(text, number, options);
  if (checked.error != Error::none) return checked.error;
  lines_[static_cast<std::size_t>(number)] = std::move(checked.line);
  return Error::none;
}

Error Program::remove(int number) {
  if (number < 0 || number >= size()) return Error::range;
  lines_.erase(lines_.begin() + number);
  return Error::none;
}

std::optional<int> Program::find(const Operand& address, const ProgramOptions& options) const {
  if (address.kind == Operand::Kind::integer) {
    const double line = address.number - options.first_number;
    if (line < 0 || line >= size()) return std::nullopt;
    return static_cast<int>(line);
  }
  for (int i = 0; i < size(); ++i) {
    if (!line(i).parsed.label.empty() && line(i).parsed.label == address.text) return i;
  }
  return std::nullopt;
}

std::vector<std::string> Program::listing(const ProgramOptions& options) const {
  if (options.listing == ProgramOptions::Listing::bare) return texts();
  std::vector<std::string> listed;
  for (int i = 0; i < size(); ++i) {
    listed.push_back(std::to_string(i + options.first_number) + ": " + line(i).text);
  }
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

bool Program::set_texts(const std::vector<std::string>& texts, const ProgramOptions& options) {
  Program program;
  for (const std::string& text : texts) {
    if (program.insert(program.size(), text, options) != Error::none) return false;
  }
  *this = std::move(program);
  return true;
}

}  // namespace understudy::interpreter::slim
