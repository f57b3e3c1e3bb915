#include "emulator/world/bench_file/yaml_document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"

namespace understudy::emulator::world {

namespace {

constexpr std::string_view kBlank = " \t";

std::string_view line_at(std::string_view text, int line) {
  std::size_t begin = 0;
  for (; line > 0; --line) {
    begin = text.find('\n', begin);
    if (begin == std::string_view::npos) return {};
    ++begin;
  }
  const std::string_view found = text.substr(begin, text.find('\n', begin) - begin);
  return found.substr(0, found.find_last_not_of('\r') + 1);
}

/// Where in a text the library stopped.
struct Stop {
  YAML::Mark mark;
  std::string_view line;
  std::string_view before;  // the part of the line that the library has read
  std::string_view above;   // the last line before this one that is not blank

  Stop(std::string_view text, const YAML::Mark& where)
      : mark(where),
        line(line_at(text, where.line)),
        before(line.substr(0, static_cast<std::size_t>(std::max(where.column, 0)))) {
    for (int number = where.line - 1; number >= 0 && above.empty(); --number) {
      const std::string_view other = line_at(text, number);
      if (other.find_first_not_of(kBlank) != std::string_view::npos) above = other;
    }
  }
  std::string_view indentation() const {
    return line.substr(0, std::min(line.find_first_not_of(kBlank), line.size()));
  }
  bool has(std::string_view part) const { return line.find(part) != std::string_view::npos; }
  bool has_before(std::string_view part) const { return before.find(part) != std::string_view::npos; }
  /// Returns true if only blanks, and perhaps the first letter, precede the place.
  bool is_at_begin() const { return mark.column <= static_cast<int>(indentation().size()) + 1; }
};

bool is_indented_by_tab(const Stop& stop) { return stop.indentation().find('\t') != std::string_view::npos; }
bool has_bare_parameter(const Stop& stop) { return stop.has("${"); }
bool has_second_colon(const Stop& stop) {
  const std::size_t colon = stop.line.find(": ");
  return colon != std::string_view::npos && static_cast<int>(colon) + 1 < stop.mark.column;
}
/// Returns true if no blank follows the colon of a key: "model:simple2-r3".
bool is_glued(std::string_view line) {
  const auto is_of_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  std::size_t at = std::min(line.find_first_not_of(kBlank), line.size());
  if (line.substr(at, 2) == "- ") at += 2;
  const std::size_t begin = at;
  while (at < line.size() && is_of_name(line[at])) ++at;
  return at > begin && at + 1 < line.size() && line[at] == ':' && kBlank.find(line[at + 1]) == kBlank.npos &&
         line.substr(at, 3) != "://";
}
bool is_below_glued_key(const Stop& stop) { return is_glued(stop.above); }
bool is_glued_key(const Stop& stop) { return is_glued(stop.line); }
/// Returns true if the line continues or closes braces or brackets after the place.
bool continues(const Stop& stop) {
  return stop.line.find_first_of(",}]", stop.before.size()) != std::string_view::npos;
}
bool is_in_line(const Stop& stop) { return !stop.is_at_begin(); }
bool always(const Stop& /*stop*/) { return true; }

/// Replaces a message from the library with plain words. The first matching row is used.
struct PlainWords {
  std::string_view library;  // the beginning of the library's message; empty: any message
  bool (*fits)(const Stop& stop);
  std::string_view words;
};
constexpr std::string_view kOtherIndentation =
    "this line is indented differently from those it belongs to; expected the same number of spaces";
constexpr std::string_view kMissingComma =
    "a ',' is missing before this; expected one between the entries of a '{' or '['";
constexpr std::array kPlainWords{
    PlainWords{"", is_indented_by_tab, "a tab indents this line; expected spaces"},
    PlainWords{
        "end of map flow not found", has_bare_parameter,
        "a '{' inside braces begins a map; expected quotes around a ${...} between braces or brackets"},
    PlainWords{"end of sequence flow not found", has_bare_parameter,
               "a '{' inside brackets begins a map; expected quotes around a ${...} between braces or "
               "brackets"},
    PlainWords{"illegal map value", is_below_glued_key,
               "the previous line has no space after its ':'; expected `key: value` there"},
    PlainWords{"illegal map value", has_second_colon,
               "a second ': ' in one line; expected quotes around a text with ': ', or a separate line"},
    PlainWords{"illegal map value", always,
               "this key does not fit the previous line; expected `key: value` there, and the same number of "
               "spaces before the keys of one map"},
    PlainWords{"end of map not found", is_glued_key,
               "this line has no space after its ':'; expected `key: value`"},
    PlainWords{"illegal map key", always, "a key is not allowed here; expected it on a separate line"},
    PlainWords{"end of map not found", is_in_line,
               "more text follows a complete value; expected quotes around all of the text"},
    PlainWords{"end of map not found", always, kOtherIndentation},
    PlainWords{"end of sequence not found", always, kOtherIndentation},
    PlainWords{"end of map flow not found", continues, kMissingComma},
    PlainWords{"end of sequence flow not found", continues, kMissingComma},
    PlainWords{"end of map flow not found", always,
               "a '{' before this is not closed; expected ',' or '}' here"},
    PlainWords{"end of sequence flow not found", always,
               "a '[' before this is not closed; expected ',' or ']' here"},
    PlainWords{"illegal flow end", always, "there is no matching '[' or '{' before this; expected one"},
    PlainWords{"illegal block entry", always,
               "a list's '- ' is not allowed here; expected it at the beginning of a line"},
    PlainWords{"illegal EOF in scalar", always,
               "a quote is not closed; expected a quote at the end of the text"},
    PlainWords{"unknown token", always, "a text cannot begin with this character; expected quotes around it"},
    PlainWords{"the referenced anchor is not defined", always,
               "no text before this has this anchor; expected `&name` before `*name`, or quotes around a "
               "text with '*'"},
    PlainWords{"unknown escape character", always,
               "this escape sequence does not exist; expected '\\\\' for the character itself, or "
               "single quotes"},
    PlainWords{"unexpected character in block scalar", always,
               "something follows a '|' or '>'; expected the text on the lines below"},
};

FileError not_yaml(const Stop& stop, const std::string& file, const std::string& what,
                   const std::string& message) {
  std::string words = message;
  for (const PlainWords& row : kPlainWords) {
    if (!message.starts_with(row.library) || !row.fits(stop)) continue;
    words = row.words;
    break;
  }
  const bool has_text = stop.line.find_first_not_of(kBlank) != std::string_view::npos;
  const FilePlace place{file, std::max(stop.mark.line, 0) + 1, std::max(stop.mark.column, 0) + 1};
  return {place,
          what + ": is not YAML: " + words + (has_text ? "  (the line is " + quoted(stop.line) + ")" : "")};
}

/// Creates the nodes of a document while the parser reads it, and detects the beginning of a second document.
/// Do not ask the library for another document: at a character that cannot begin a document, it would never
/// stop creating them.
class DocumentBuilder : public YAML::EventHandler {
 public:
  explicit DocumentBuilder(std::string_view text) : text_(text) {}

  struct SecondDocument {
    YAML::Mark mark;
  };
  const YAML::Mark& last_text() const { return last_text_; }
  std::shared_ptr<const YamlNode> root() const { return {nodes_, root_}; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (std::exchange(has_begun_, true)) throw SecondDocument{mark};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { make(mark, anchor, Kind::nothing); }
  void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t anchor) override { put(anchors_.at(anchor)); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode& node = make(mark, anchor, Kind::scalar);
    node.scalar = value;
    if (value.find('\n') != std::string::npos) note_block(mark, node);
    last_text_ = mark;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open_.push_back(&make(mark, anchor, Kind::list));
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open_.push_back(&make(mark, anchor, Kind::map));
  }
  void OnMapEnd() override { open_.pop_back(); }

 private:
  using Kind = YamlNode::Kind;

  YamlNode& make(const YAML::Mark& mark, YAML::anchor_t anchor, Kind kind) {
    YamlNode& node = nodes_->emplace_back(YamlNode{.kind = kind, .line = mark.line, .column = mark.column});
    if (anchor != YAML::NullAnchor) anchors_[anchor] = &node;
    put(&node);
    return node;
  }
  /// If the first line of a block scalar determines its indentation, records which lines of the file belong
  /// to it.
  void note_block(const YAML::Mark& mark, YamlNode& node) const {
    const std::string_view rest = text_.substr(std::min(static_cast<std::size_t>(mark.pos), text_.size()));
    const std::size_t end = rest.find('\n');
    if (!rest.starts_with('|') || end == std::string_view::npos) return;
    if (rest.substr(0, end).find_first_of("123456789#") != std::string_view::npos) return;
    const std::size_t first = rest.find_first_not_of(" \r\n", end);
    if (first == std::string_view::npos) return;
    node.text_line = mark.line + 1;
    node.text_column = static_cast<int>(first - rest.rfind('\n', first) - 1);
  }
  void put(const YamlNode* node) {
    if (open_.empty()) {
      root_ = node;
    } else {
      open_.back()->parts.push_back(node);
    }
  }

  std::string_view text_;
  std::shared_ptr<std::deque<YamlNode>> nodes_ = std::make_shared<std::deque<YamlNode>>(1);
  const YamlNode* root_ = &nodes_->front();  // empty if the text is empty
  std::vector<YamlNode*> open_;
  std::map<YAML::anchor_t, const YamlNode*> anchors_;
  bool has_begun_ = false;
  YAML::Mark last_text_ = YAML::Mark::null_mark();
};

/// Replaces the comment lines at the beginning of the text with blanks, because the library reads comments
/// character by character, and many files begin with a page of comments.
std::string without_first_remarks(const std::string& text) {
  std::string lines;
  std::size_t at = 0;
  while (at < text.size() && (text[at] == '#' || text[at] == '\n')) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) return lines;
    lines += '\n';
    at = end + 1;
  }
  return lines + text.substr(at);
}

/// Returns true if the quote at the beginning of `text` is closed. In double quotes, a backslash escapes any
/// character; in single quotes, two quotes represent one.
bool is_closed(std::string_view text) {
  const char quote = text.front();
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (text[at] == quote) {
      if (quote == '"' || at + 1 == text.size() || text[at + 1] != quote) return true;
      ++at;
    }
  }
  return false;
}

/// Reports a quoted text that is not closed, because the library accepts the end of the file as the closing
/// quote.
void require_closed_quote(const std::string& text, const YAML::Mark& mark, const std::string& file,
                          const std::string& what) {
  if (mark.is_null()) return;
  const Stop stop(text, mark);
  const std::string_view line = stop.line.substr(std::min(stop.before.size(), stop.line.size()));
  if (line.empty() || (line.front() != '"' && line.front() != '\'')) return;
  const auto at = static_cast<std::size_t>(line.data() - text.data());
  if (!is_closed(std::string_view(text).substr(at)))
    throw not_yaml(stop, file, what, "illegal EOF in scalar");
}

}  // namespace

std::shared_ptr<const YamlNode> parse_yaml(const std::string& text, const std::string& file,
                                           const std::string& what) {
  try {
    const std::string read = without_first_remarks(text);
    std::istringstream input(read);
    YAML::Parser parser(input);
    DocumentBuilder builder(read);
    while (parser.HandleNextDocument(builder)) {
    }
    require_closed_quote(text, builder.last_text(), file, what);
    return builder.root();
  } catch (const DocumentBuilder::SecondDocument& second) {
    const Stop stop(text, second.mark);
    if (stop.line.starts_with("---") || std::string_view(text).find("\n...") != std::string_view::npos) {
      throw FileError({file, second.mark.line + 1, second.mark.column + 1},
                      what + ": a second document begins here; expected only one");
    }
    throw not_yaml(stop, file, what,
                   "this does not belong to the map before it; expected one map, `key: value`");
  } catch (const YAML::Exception& error) {
    throw not_yaml(Stop(text, error.mark), file, what, error.msg);
  }
}

}  // namespace understudy::emulator::world
