// The reasons why motion refuses a request, and the only error that planning throws.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace understudy::motion {

enum class Refusal : std::uint8_t {
  not_finite,    // NaN or infinity
  not_positive,  // 0 or less, but the quantity must be above 0
  negative,      // below 0, but the quantity must be 0 or more
  out_of_range,  // outside the range of the quantity, or unreachable with the law
  no_such_arc,   // the points, centre or radius do not lie on one circle
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

/// These check a value of a law. `law` and `quantity` appear in the message.
void require_finite(double value, std::string_view law, std::string_view quantity);
void require_positive(double value, std::string_view law, std::string_view quantity);      // finite and > 0
void require_not_negative(double value, std::string_view law, std::string_view quantity);  // finite and >= 0

}  // namespace understudy::motion
