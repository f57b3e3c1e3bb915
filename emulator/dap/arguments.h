// Requests and their arguments. Invalid ones are refused with one sentence (RequestError).
#pragma once

#include <cstdint>
#include <string>

#include "emulator/dap/bench_link.h"

namespace understudy::emulator::dap {

/// Returns null for text that is not JSON or is nested too deeply.
Json parsed_message(const std::string& text);

const Json& require(const Json& arguments, const char* key);
std::string require_text(const Json& arguments, const char* key);
std::int64_t require_whole(const Json& arguments, const char* key);
const Json& require_list(const Json& arguments, const char* key);

/// These return `otherwise` if the key is missing, or null.
std::string text_or(const Json& arguments, const char* key, const std::string& otherwise = {});
std::int64_t whole_or(const Json& arguments, const char* key, std::int64_t otherwise);
bool flag_or(const Json& arguments, const char* key, bool otherwise);

/// Adds the fields that every kind of breakpoint may have: condition, hitCondition, logMessage.
void add_common_fields(const Json& wanted, Json& message);

}  // namespace understudy::emulator::dap
