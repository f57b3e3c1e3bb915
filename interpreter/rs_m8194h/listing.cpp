#include "interpreter/rs_m8194h/listing.h"
#include "base/text/lines.h"
#include "base/text/tokens.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/most_mistakes.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/text_error.h"
#include "interpreter/rs_m8194h/triggers.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

constexpr std::string_view kAxes = "XYZU";

std::optional<int> number_in(std::string_view text, int min, int max) {
  const std::optional<std::int64_t> number = parse_integer(text);
  if (!number || *number < min || *number > max) return std::nullopt;
  return static_cast<int>(*number);
}

/// Parses "8.0" to "15.15".
std::optional<int> channel_of(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::optional<int> group =
      number_in(text.substr(0, dot), kFirstTriggerGroup, kFirstTriggerGroup + kTriggerGroups - 1);
  const std::optional<int> channel = number_in(text.substr(dot + 1), 0, kChannelsPerGroup - 1);
  if (!group || !channel) return std::nullopt;
  return (*group - kFirstTriggerGroup) * kChannelsPerGroup + *channel;
}

class ListingReader {
 public:
  explicit ListingReader(const Options& options) : options_(options) {
    options_.choose(
        option("structure_faults", "at_their_line"));  // each error is reported at its place in the text
  }

  ParsedListing run(std::string_view text) {
    for (const TextLine line : TextLines(without_byte_order_mark(text))) {
      const std::vector<Token> tokens = tokens_of(line.text, line.number);
      if (!tokens.empty()) read(tokens);
      if (errors_.size() >= kMaxMistakes) break;
    }
    if (errors_.size() < kMaxMistakes) end_macro();
    ParsedListing parsed;
    leave_first(errors_);
    if (errors_.empty()) parsed.listing = std::move(listing_);
    parsed.text_lines = std::move(text_lines_);
    parsed.errors = std::move(errors_);
    parsed.first_trigger = first_trigger_;
    return parsed;
  }

 private:
  void fail(const Token& token, std::string message) {
    errors_.push_back({token.line, token.column, std::move(message)});
  }

  void read(const std::vector<Token>& tokens) {
    const Token& word = tokens.front();
    if (is_word(word.text, "MP") || is_word(word.text, "ISR")) return begin_macro(tokens);
    if (is_word(word.text, "TRIGGER")) {
      if (!first_trigger_) first_trigger_ = word;
      return read_trigger(tokens);
    }
    if (is_word(word.text, "END")) {
      if (tokens.size() > 1) fail(tokens[1], quoted(tokens[1].text) + " follows END; expected nothing");
      if (!download_) fail(word, "END without a macro; expected MP or ISR before it");
      return end_macro();
    }
    if (!download_) {
      return fail(word, quoted(word.text) + " is not in a macro; expected MP, ISR or TRIGGER");
    }
    read_line(tokens);
  }

  // --- macros ----------------------------------------------------------------------------------

  void begin_macro(const std::vector<Token>& tokens) {
    end_macro();
    const bool is_isr = is_word(tokens[0].text, "ISR");
    const std::optional<int> number =
        tokens.size() == 2 ? number_in(tokens[1].text, 1, count_of(is_isr)) : std::nullopt;
    if (!number) {
      fail(tokens.back(), "expected the number of " + std::string(is_isr ? "an ISR" : "an MP") + ", 1 to " +
                              std::to_string(count_of(is_isr)));
    }
    const MacroName name{is_isr, number.value_or(1)};
    const bool is_twice =
        number && std::ranges::any_of(begun_, [&name](const MacroName& begun) { return begun == name; });
    if (is_twice) fail(tokens[1], to_string(name) + " appears twice");
    if (number) begun_.push_back(name);
    is_sound_ = number && !is_twice;
    download_ = Download{.name = name};
    places_.clear();
  }

  void read_line(const std::vector<Token>& tokens) {
    const ParsedCommand parsed = parse_command(tokens, options_);
    if (!parsed.command) {
      errors_.push_back(*parsed.error);
      is_sound_ = false;
      return;
    }
    const std::uint16_t code = parsed.command->code;
    const State state = download_->name.is_isr ? State::isr_download : State::mp_download;
    if (const Fault fault = why_not_now(code, state); fault != Fault::none) {
      const std::string_view twin = parsed.command->row().macro_name;
      const bool has_twin = fault == Fault::real_time_in_macro && !twin.empty();
      fail(tokens[0], std::string(name_of(code)) + ": " + std::string(row_of(fault).meaning) +
                          (has_twin ? "; expected " + std::string(twin) : ""));
      is_sound_ = false;
      return;
    }
    if (is_one_of(verb_of(code), kDownloadVerbs)) {
      fail(tokens[0], std::string(name_of(code)) + " is not a line of a macro; expected END");
      is_sound_ = false;
      return;
    }
    const Fault fault = add(*download_, *parsed.command, options_);
    if (fault == Fault::none) {
      places_.push_back(tokens[0]);
    } else {
      fail_structure(tokens[0], *download_);
    }
  }

  /// Reports only the first error of a macro, because it may cause the later ones.
  void fail_structure(const Token& place, const Download& download) {
    if (is_sound_) {
      fail(place, std::string(name_of(download.code)) + ": " + std::string(row_of(download.fault).meaning));
    }
    is_sound_ = false;
  }

  void end_macro() {
    if (!download_) return;
    Closed closed = close(*download_);
    // After an earlier error, the reported line may not be the CLOSE, or may be a line that was refused.
    if (closed.fault != Fault::none && is_sound_) fail_structure(places_[download_->line], *download_);
    if (closed.macro) {
      listing_.macros.push_back({download_->name, std::move(*closed.macro)});
      std::vector<int>& lines = text_lines_.emplace_back();
      for (const Token& place : places_) lines.push_back(place.line);
    }
    download_.reset();
  }

  // --- triggers --------------------------------------------------------------------------------

  void read_trigger(const std::vector<Token>& tokens) {
    end_macro();
    const auto missing = [&](std::size_t i, const std::string& expected) {
      if (i < tokens.size()) {
        fail(tokens[i], quoted(tokens[i].text) + " does not fit; expected " + expected);
      } else {
        fail(tokens.back(), "ends too early; expected " + expected);
      }
    };
    const std::optional<int> channel = tokens.size() > 1 ? channel_of(tokens[1].text) : std::nullopt;
    if (!channel) return missing(1, "an input, 8.0 to 15.15");
    const auto is_same = [&](const ListedTrigger& listed) { return listed.channel == *channel; };
    if (std::ranges::any_of(listing_.triggers, is_same)) {
      return fail(tokens[1], "TRIGGER " + text_of_channel(*channel) + " appears twice");
    }
    const auto* const condition = std::ranges::find_if(kTriggerConditions, [&](const ConditionRow& row) {
      return tokens.size() > 2 && is_word(tokens[2].text, row.text);
    });
    if (condition == kTriggerConditions.end()) {
      return missing(2, "none, on, off, off_to_on, on_to_off or change");
    }
    Trigger trigger{.condition = condition->condition};
    if (trigger.condition == TriggerCondition::none) {
      if (tokens.size() > 3) return missing(3, "nothing");
      listing_.triggers.push_back({*channel, trigger});
      return;
    }
    if (tokens.size() < 4 || !read_event(tokens[3].text, trigger)) {
      return missing(3, "MP1 to MP157, hold, abort_command, abort_macro, pause or clear_stop");
    }
    std::size_t count = 4;
    if (trigger.event == TriggerEvent::hold) {
      const std::size_t axis = tokens.size() > 4 && tokens[4].text.size() == 1
                                   ? kAxes.find(upper_case(tokens[4].text))
                                   : std::string_view::npos;
      if (axis == std::string_view::npos) return missing(4, "an axis, X, Y, Z or U");
      trigger.argument = static_cast<std::uint8_t>(1U << axis);
      ++count;
    }
    if (tokens.size() > count) return missing(count, "nothing");
    listing_.triggers.push_back({*channel, trigger});
  }

  static bool read_event(std::string_view text, Trigger& trigger) {
    for (const EventRow& row : kTriggerEvents) {
      if (row.event != TriggerEvent::call_mp && is_word(text, row.text)) trigger.event = row.event;
    }
    if (text.size() > 2 && is_word(text.substr(0, 2), "MP")) {
      const std::optional<int> number = number_in(text.substr(2), 1, kMpCount);
      if (!number) return false;
      trigger.event = TriggerEvent::call_mp;
      trigger.argument = static_cast<std::uint8_t>(*number);
    }
    return trigger.event != TriggerEvent::none;
  }

  Options options_;
  Listing listing_;
  std::vector<std::vector<int>> text_lines_;
  std::vector<TextError> errors_;
  std::optional<Token> first_trigger_;
  std::optional<Download> download_;
  std::vector<Token> places_;  // of the macro's lines
  bool is_sound_ = true;
  std::vector<MacroName> begun_;
};

}  // namespace

ParsedListing parse_listing(std::string_view text, const Options& options) {
  return ListingReader(options).run(text);
}

std::string text_of(const MacroName& name, const Macro& macro) {
  std::string text = std::string(name.is_isr ? "ISR " : "MP ") + std::to_string(name.number) + "\n";
  std::size_t depth = 1;
  for (const Command& command : macro.lines) {
    const Verb verb = command.verb();
    const bool closes = verb == Verb::end_if || verb == Verb::next;
    if (closes) --depth;
    text += std::string(2 * (verb == Verb::else_ ? depth - 1 : depth), ' ') + text_of(command) + "\n";
    if (verb == Verb::if_ || verb == Verb::for_) ++depth;
  }
  return text + "END\n";
}

std::string text_of_channel(int channel) {
  return std::to_string(kFirstTriggerGroup + channel / kChannelsPerGroup) + "." +
         std::to_string(channel % kChannelsPerGroup);
}

std::string text_of(int channel, const Trigger& trigger) {
  std::string text = "TRIGGER " + text_of_channel(channel);
  for (const ConditionRow& row : kTriggerConditions) {
    if (row.condition == trigger.condition) text += " " + std::string(row.text);
  }
  for (const EventRow& row : kTriggerEvents) {
    if (row.event == trigger.event) text += " " + std::string(row.text);
  }
  if (trigger.event == TriggerEvent::call_mp) text += std::to_string(trigger.argument);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const bool is_held = trigger.event == TriggerEvent::hold && trigger.argument == 1U << axis;
    if (is_held) text += std::string(" ") + kAxes[axis];
  }
  return text;
}

std::string text_of(const Listing& listing) {
  std::string text;
  for (const ListedMacro& listed : listing.macros) text += text_of(listed.name, listed.macro) + "\n";
  for (const ListedTrigger& listed : listing.triggers) {
    text += text_of(listed.channel, listed.trigger) + "\n";
  }
  if (listing.triggers.empty() && !text.empty()) text.pop_back();
  return text;
}

}  // namespace understudy::interpreter::rs_m8194h
