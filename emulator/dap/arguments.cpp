#include "emulator/dap/arguments.h"

#include <cstdint>
#include <string>

#include "base/text/one_line.h"
#include "emulator/dap/bench_link.h"

namespace understudy::emulator::dap {

namespace {

constexpr int kDeepest = 64;
constexpr std::int64_t kGreatest = std::int64_t{1} << 53U;  // JavaScript's numbers are exact up to this

RequestError is_not(const char* key, const char* expected) {
  return RequestError(std::string(key) + ": expected " + expected);
}

bool is_given(const Json& arguments, const char* key) {
  return arguments.is_object() && arguments.contains(key) && !arguments[key].is_null();
}

}  // namespace

Json parsed_message(const std::string& text) {
  bool is_too_deep = false;
  Json message = Json::parse(
      text,
      [&](int depth, Json::parse_event_t, Json&) {
        is_too_deep = is_too_deep || depth > kDeepest;
        return !is_too_deep;
      },
      false);
  return is_too_deep || message.is_discarded() ? Json() : message;
}

const Json& require(const Json& arguments, const char* key) {
  if (!is_given(arguments, key)) throw RequestError(quoted(key) + " is missing");
  return arguments[key];
}

std::string require_text(const Json& arguments, const char* key) {
  const Json& value = require(arguments, key);
  if (!value.is_string()) throw is_not(key, "a text");
  return value.get<std::string>();
}

std::int64_t require_whole(const Json& arguments, const char* key) {
  const Json& value = require(arguments, key);
  const bool is_too_great =
      value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(kGreatest);
  if (!value.is_number_integer() || is_too_great || value.get<std::int64_t>() < -kGreatest)
    throw is_not(key, "a whole number");
  return value.get<std::int64_t>();
}

const Json& require_list(const Json& arguments, const char* key) {
  const Json& value = require(arguments, key);
  if (!value.is_array()) throw is_not(key, "a list");
  return value;
}

std::string text_or(const Json& arguments, const char* key, const std::string& otherwise) {
  return is_given(arguments, key) ? require_text(arguments, key) : otherwise;
}

std::int64_t whole_or(const Json& arguments, const char* key, std::int64_t otherwise) {
  return is_given(arguments, key) ? require_whole(arguments, key) : otherwise;
}

bool flag_or(const Json& arguments, const char* key, bool otherwise) {
  if (!is_given(arguments, key)) return otherwise;
  if (!arguments[key].is_boolean()) throw is_not(key, "true or false");
  return arguments[key].get<bool>();
}

}  // namespace understudy::emulator::dap
