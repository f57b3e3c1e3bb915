#include "emulator/serve/control/reply_text.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/serve/control/message_fields.h"

namespace understudy::emulator::serve {

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void ReplyText::separate() {
  const char last = text_.back();
  if (last != '{' && last != '[') text_ += ',';
}

void ReplyText::begin_member(std::string_view key) {
  separate();
  text_ += text_of(Json(key));
  text_ += ':';
}

void ReplyText::member(std::string_view key, const Json& value) {
  begin_member(key);
  text_ += text_of(value);
}

void ReplyText::members(const Json& object) {
  for (const auto& [key, value] : object.items()) member(key, value);
}

void ReplyText::element(const Json& value) {
  separate();
  text_ += text_of(value);
}

void ReplyText::element(std::int64_t value) {
  separate();
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text_.append(digits.data(), end.ptr);
}

void ReplyText::open(std::string_view key, char bracket) {
  begin_member(key);
  text_ += bracket;
}

void ReplyText::open_object() {
  separate();
  text_ += '{';
}

void ReplyText::open_list() {
  separate();
  text_ += '[';
}

std::string ReplyText::take() {
  text_ += '}';
  return std::move(text_);
}

}  // namespace understudy::emulator::serve
