#include "interpreter/rs_m8194h/text_error.h"

#include <string>

namespace understudy::interpreter::rs_m8194h {

std::string to_string(const TextError& error) {
  return std::to_string(error.line) + ":" + std::to_string(error.column) + ": " + error.message;
}

}  // namespace understudy::interpreter::rs_m8194h
