// The names of the parameters through which a program accesses registers: MEM0 to MEM31, VAR32 to VAR63,
// DAT64 to DAT143, and for 144 to 182 the names of their registers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy::interpreter::simple2 {

/// A parameter that has its own register.
struct RegisterName {
  std::uint8_t number;
  std::string_view name;
  std::string_view other_spelling = {};  // in another table of the manual, or for a misprinted axis
};

/// The names as in the register table. The device creates its parameter table from these.
inline constexpr RegisterName kRegisterNames[] = {
    {144, "Aaxis_Home_Speed", "Axis_Home_Speed"},
    {145, "Baxis_Home_Speed"},
    {146, "Aaxis_Resoultion", "Axis_Resoultion"},
    {147, "Baxis_Resoultion"},
    {148, "Aaxis_Home_AccTime", "Axis_Home_AccTime"},
    {149, "Baxis_Home_AccTime"},
    {150, "Axis_VelMode_ACC", "Aaxis_VelMode_ACC"},
    {151, "Baxis_VelMode_ACC"},
    {152, "ENCA"},
    {153, "ENCB"},
    {154, "Cord_A"},
    {155, "Cord_B"},
    {156, "Analog_A"},
    {157, "Analog_B"},
    {158, "CalcREG"},
    {167, "ENCA_Resoultion"},
    {168, "ENCB_Resoultion"},
    {169, "ENCA_RPM"},
    {170, "ENCB_RPM"},
    {171, "Counter1_Value"},
    {172, "Counter2_Value"},
    {173, "Timer1_Value"},
    {174, "Timer2_Value"},
    {175, "Axis_EncSync_NUM", "Aaxis_EncSync_NUM"},
    {176, "Axis_EncSync_DEN", "Aaxis_EncSync_DEN"},
    {177, "Baxis_EncSync_NUM"},
    {178, "Baxis_EncSync_DEN"},
    {179, "Axis_SyncSlope", "Aaxis_SyncSlope"},
    {180, "Baxis_SyncSlope"},
    {181, "Axis_SyncRPM", "Aaxis_SyncRPM"},
    {182, "Baxis_SyncRPM"},  // the manual prints Axis_SyncRPM a second time
};

/// Returns true for parameters that show a measured value and cannot be written.
constexpr bool is_read_only(std::uint8_t number) {
  return number == 156 || number == 157 || number == 169 ||
         number == 170;  // Analog_A, _B, ENCA_RPM, ENCB_RPM
}

/// Returns the name for a listing, or nothing for a number that the manual does not define.
std::optional<std::string> parameter_name(std::uint8_t number);

/// Finds a parameter by any of its names, in upper or lower case: the names above, DAT144 to DAT182, or the
/// other spelling of its register.
std::optional<std::uint8_t> parameter_number(std::string_view name);

}  // namespace understudy::interpreter::simple2
