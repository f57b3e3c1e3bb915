// The reasons for which motion refuses a request, and the one error that planning throws.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace understudy::motion {

enum class Refusal : std::uint8_t {
  not_finite,    // NaN or an infinity
  not_positive,  // 0 or less, where the quantity must be above 0
  negative,      // below 0, where 0 is allowed
  out_of_range,  // beyond what the quantity can hold or the law can reach
  no_such_arc,   // the points, centre or radius given do not lie on one circle
  no_room,       // a queue or a table of fixed size is full
};

/// Thrown for an impossible motion. what() is one line: "<law>: <quantity> must be ...; it is <value>".
class BadMotion : public std::invalid_argument {
 public:
  BadMotion(Refusal refusal, std::string_view law, std::string_view require)
      : std::invalid_argument(std::string(law) + ": " + std::string(require)), refusal_(refusal) {}

  Refusal refusal() const { return refusal_; }

 private:
  Refusal refusal_;
};

/// Check a value that a law is given. `law` and `quantity` are words of the message.
void require_finite(double value, std::string_view law, std::string_view quantity);
void require_positive(double value, std::string_view law, std::string_view quantity);      // finite and > 0
void require_not_negative(double value, std::string_view law, std::string_view quantity);  // finite and >= 0

}  // namespace understudy::motion
