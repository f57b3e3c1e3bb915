#include "emulator/play/reading/parameters.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/parser.h"
#include "emulator/world/expression/term.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::play {

namespace {

struct Quantity {
  world::Number number;
  world::Unit unit = world::Unit::none;
};

class NoValues final : public world::ValueSource {
 public:
  world::Number value(std::int32_t /*handle*/) const override { return {}; }
};

Quantity evaluated_with(std::string_view text, const world::NameResolver& names,
                        const world::ValueSource& values) {
  world::ExpressionParser parser(text, names);
  const world::Term term = parser.expression();
  parser.expect_end();
  return {world::evaluate(parser.take(), values), term.unit};
}

class NoNames final : public world::NameResolver {
 public:
  world::NamedNumber resolve(std::string_view name) const override {
    throw world::NameError(quoted(name) + " is not a number");
  }
};

/// Provides parameters as names in an expression. The handle of a name is its index in the order of the text.
class Numbers final : public world::NameResolver, public world::ValueSource {
 public:
  explicit Numbers(const Parameters& parameters) : parameters_(parameters) {}

  world::NamedNumber resolve(std::string_view name) const override {
    const std::string* const text = parameters_.find(name);
    if (text == nullptr) {
      throw world::NameError("no parameter is called " + quoted(name) +
                             suggestion(name, parameters_.names(), "there are none"));
    }
    try {
      const Quantity quantity = evaluated_with(*text, NoNames(), NoValues());
      numbers_.push_back(quantity.number);
      return {static_cast<std::int32_t>(numbers_.size() - 1), quantity.unit};
    } catch (const world::ExpressionError&) {
      throw world::NameError("parameter " + quoted(name) + " is " + quoted(*text) +
                             ", which expressions cannot use; expected a number, a duration or a voltage");
    }
  }
  world::Number value(std::int32_t handle) const override {
    return numbers_[static_cast<std::size_t>(handle)];
  }

 private:
  const Parameters& parameters_;
  mutable std::vector<world::Number> numbers_;
};

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// Returns true for a single word that does not already have a meaning in expressions.
bool is_name(const std::string& name) {
  try {
    world::Lexer lexer(name);
    const world::Token word = lexer.next();
    return word.kind == world::Token::Kind::name && word.name == name &&
           name.find('.') == std::string::npos && lexer.next().kind == world::Token::Kind::end;
  } catch (const world::ExpressionError&) {
    return false;
  }
}

}  // namespace

void Parameters::define(const std::string& name, const std::string& value) {
  if (!is_name(name)) {
    throw world::NameError(
        quoted(name) + " is not a parameter name; expected letters, digits and _, beginning with a letter");
  }
  if (find(name) != nullptr)
    throw world::NameError(quoted(name) + " is already defined; expected another name");
  values_.emplace(name, value);
}

const std::string* Parameters::find(std::string_view name) const {
  const auto it = values_.find(name);
  if (it == values_.end()) return outer_ != nullptr ? outer_->find(name) : nullptr;
  used_.insert(it->first);
  return &it->second;
}

std::vector<std::string> Parameters::names() const {
  std::vector<std::string> all = outer_ != nullptr ? outer_->names() : std::vector<std::string>();
  for (const auto& [name, value] : values_) all.push_back(name);
  return all;
}

std::set<std::string, std::less<>> Parameters::used_in(const std::string& written) const {
  auto before = std::exchange(used_, {});
  apply(written);
  const auto used = used_;
  used_.merge(before);
  return used;
}

std::string Parameters::evaluated(std::string_view written) const {
  if (const std::string* const value = find(trimmed(written)); value != nullptr) return *value;
  const Numbers numbers(*this);
  const Quantity quantity = evaluated_with(written, numbers, numbers);
  return world::number_text(quantity.number, quantity.unit);
}

std::string Parameters::apply(const std::string& written) const {
  constexpr std::size_t kLongest = 1'000'000;  // bytes; otherwise, short lines could expand without limit
  std::string made;
  std::size_t at = 0;
  for (;;) {
    const std::size_t begin = written.find("${", at);
    if (begin == std::string::npos) return made + written.substr(at);
    if (begin > at && written[begin - 1] == '$') {
      made += written.substr(at, begin - 1 - at) + "${";
      at = begin + 2;
      continue;
    }
    const std::size_t end = written.find('}', begin);
    if (end == std::string::npos) throw world::NameError("'${' is not closed; expected '}' after it");
    made += written.substr(at, begin - at) +
            evaluated(std::string_view(written).substr(begin + 2, end - begin - 2));
    if (made.size() > kLongest) throw world::NameError("becomes too long; expected at most a million bytes");
    at = end + 1;
  }
}

}  // namespace understudy::emulator::play
