// A mistake in a text, with its position.
#pragma once

#include <string>

namespace understudy::interpreter::rs_m8194h {

struct TextError {
  int line = 0;    // from 1
  int column = 0;  // in bytes, from 1
  std::string message;

  bool operator==(const TextError&) const = default;
};

/// Returns "4:9: parameter nMode: '9' does not fit; expected 0 to 5".
std::string to_string(const TextError& error);

}  // namespace understudy::interpreter::rs_m8194h
