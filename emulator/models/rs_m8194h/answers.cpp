#include "emulator/models/rs_m8194h/answers.h"

#include <cstdint>

#include "emulator/device/register_map/refusal.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/faults.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

std::uint8_t reason_of(const Part& part, lang::Fault fault) {
  const lang::FaultRow& row = lang::row_of(fault);
  return part.chose(option("illegal_reason_numbers", "of_12_1_12")) ? row.reason_12_1_12 : row.reason_4_16_2;
}

DeviceAnswer answer_of(const Part& part, lang::Fault fault) {
  const lang::FaultRow& row = lang::row_of(fault);
  const bool is_of_state = fault == lang::Fault::mp_in_isr || fault == lang::Fault::isr_in_mp ||
                           fault == lang::Fault::real_time_in_macro || fault == lang::Fault::macro_outside;
  if (is_of_state && part.chose(option("state_exception", "exception_6")))
    return {Refusal::busy, reason_of(part, fault)};
  if (fault == lang::Fault::macro_runs && part.chose(option("calls_while_an_mp_runs", "exception_3"))) {
    return {Refusal::bad_value, reason_of(part, fault)};
  }
  const Refusal refusal = row.exception == 0   ? Refusal::none
                          : row.exception == 2 ? Refusal::no_register
                          : row.exception == 4 ? Refusal::failure
                          : row.exception == 6 ? Refusal::busy
                                               : Refusal::bad_value;
  return {refusal, reason_of(part, fault)};
}

}  // namespace understudy::emulator::models::rs_m8194h
