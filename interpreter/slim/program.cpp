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
#include "interpreter/slim/options.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

/// Returns true if the line would end the transfer of the program with DLP.
bool ends_transfer(std::string_view text) {
  const std::string word = in_capitals(text);
  return word == "END" || word == "EXIT" || text.find('\x1B') != std::string_view::npos;
}

/// Returns the label of a line. `$A NONSENSE` is still a valid jump target.
std::string label_of(std::string_view text) {
  if (!text.starts_with('$')) return {};
  return parse_line(text.substr(0, text.find_first_of(" \t"))).line.label;
}

}  // namespace

/// Stores a line that will fail when it runs, with its error. Its label is still a valid jump target.
Program::Checked Program::failing(Checked checked, std::string_view text) {
  if (checked.error == Error::none) return checked;
  return {.line = {.text = std::string(text), .parsed = {.label = label_of(text)}, .error = checked.error}};
}

/// Checks the line `text` independently of the other lines.
Program::Checked Program::check_alone(std::string_view text, const Options& options) {
  ParseResult result = parse_line(text, options);
  if (result.error != Error::none) return {.error = result.error};
  const std::string_view trimmed = without_blanks(text);
  if (trimmed.empty()) return {.error = Error::syntax};
  const auto& command = result.line.command;
  if (command && !is_allowed(*command, Place::program, options)) return {.error = Error::not_allowed};
  if (command && options.check_command != nullptr) {
    if (const Error error = options.check_command(*command); error != Error::none) return {.error = error};
  }
  return {.line = {.text = std::string(trimmed), .parsed = std::move(result.line)}};
}

Program::Checked Program::check(std::string_view text, int replaced, const Options& options) const {
  Checked checked = check_alone(text, options);
  if (checks_as_run(options)) {
    const std::string_view trimmed = without_blanks(text);
    if (trimmed.empty() || text.size() > longest_line(options) || ends_transfer(trimmed)) return checked;
    return failing(std::move(checked), trimmed);
  }
  const std::string& label = checked.line.parsed.label;
  if (checked.error != Error::none || label.empty() ||
      options.chose(option("same_label", "the_first_counts"))) {
    return checked;
  }
  for (int i = 0; i < size(); ++i) {
    if (i != replaced && line(i).parsed.label == label) return {.error = Error::address};
  }
  return checked;
}

/// If checks_as_run(), the lines themselves, and not the order in which they were entered, decide which lines
/// with this label fail. Thus, a program is the same after it is saved and loaded.
void Program::judge_label(const std::string& label, const Options& options) {
  if (label.empty() || !checks_as_run(options) || options.chose(option("same_label", "the_first_counts"))) {
    return;
  }
  bool is_taken = false;
  for (StoredLine& line : lines_) {
    if (line.parsed.label != label) continue;
    Checked checked = check_alone(line.text, options);
    if (is_taken && checked.error == Error::none) checked = {.error = Error::address};
    line = failing(std::move(checked), line.text).line;
    is_taken = true;
  }
}

Error Program::insert(int number, std::string_view text, const Options& options) {
  if (number < 0 || number > size()) return Error::range;
  if (size() >= options.number(numbers("program_size"))) return Error::buffer_full;
  Checked checked = check(text, -1, options);
  if (checked.error != Error::none) return checked.error;
  const std::string label = checked.line.parsed.label;
  lines_.insert(lines_.begin() + number, std::move(checked.line));
  judge_label(label, options);
  return Error::none;
}

Error Program::replace(int number, std::string_view text, const Options& options) {
  if (number < 0 || number >= size()) return Error::range;
  Checked checked = check(text, number, options);
  if (checked.error != Error::none) return checked.error;
  const std::string label = checked.line.parsed.label;
  const std::string label_before = line(number).parsed.label;
  lines_[static_cast<std::size_t>(number)] = std::move(checked.line);
  judge_label(label, options);
  judge_label(label_before, options);
  return Error::none;
}

Error Program::remove(int number, const Options& options) {
  if (number < 0 || number >= size()) return Error::range;
  const std::string label = line(number).parsed.label;
  lines_.erase(lines_.begin() + number);
  judge_label(label, options);
  return Error::none;
}

std::optional<int> Program::find(const Operand& address, const Options& options) const {
  if (address.kind == Operand::Kind::integer) {
    const double line = address.number - first_number(options);
    if (line < 0 || line >= size()) return std::nullopt;
    return static_cast<int>(line);
  }
  for (int i = 0; i < size(); ++i) {
    if (!line(i).parsed.label.empty() && line(i).parsed.label == address.text) return i;
  }
  return std::nullopt;
}

std::vector<std::string> Program::listing(const Options& options) const {
  if (options.chose(option("listing", "text"))) return texts();
  std::vector<std::string> listed;
  for (int i = 0; i < size(); ++i) {
    listed.push_back(std::to_string(i + first_number(options)) + ": " + line(i).text);
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

bool Program::set_texts(const std::vector<std::string>& texts, const Options& options) {
  Program program;
  for (const std::string& text : texts) {
    if (program.insert(program.size(), text, options) != Error::none) return false;
  }
  *this = std::move(program);
  return true;
}

}  // namespace understudy::interpreter::slim
