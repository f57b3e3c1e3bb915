// Simple2-R3: parameter numbers, by which the program reaches registers. 159 to 166 and 183 on are not
// defined.
#pragma once

#include "emulator/model.h"

namespace understudy::emulator::simple2_r3 {

// clang-format off
inline constexpr ParameterRow kParameters[] = {
    {0, 32, "PROG_MEM{}"},
    {32, 32, "PROG_VAR{}"},
    {64, 16, "Parms_Pulse{}"},
    {80, 16, "Parms_Speed{}"},
    {96, 16, "Parms_AccTime{}"},
    {112, 16, "Parms_DecTime{}"},
    {128, 16, "Parms_mRPM{}"},
    {144, 1, "Aaxis_Home_Speed"},
    {145, 1, "Baxis_Home_Speed"},
    {146, 1, "Aaxis_Resoultion"},
    {147, 1, "Baxis_Resoultion"},
    {148, 1, "Aaxis_Home_AccTime"},
    {149, 1, "Baxis_Home_AccTime"},
    {150, 1, "Axis_VelMode_ACC"},
    {151, 1, "Baxis_VelMode_ACC"},
    {152, 1, "ENCA"},
    {153, 1, "ENCB"},
    {154, 1, "Cord_A"},
    {155, 1, "Cord_B"},
    {156, 1, "Analog_A"},
    {157, 1, "Analog_B"},
    {158, 1, "CalcREG"},
    {167, 1, "ENCA_Resoultion"},
    {168, 1, "ENCB_Resoultion"},
    {169, 1, "ENCA_RPM"},
    {170, 1, "ENCB_RPM"},
    {171, 1, "Counter1_Value"},
    {172, 1, "Counter2_Value"},
    {173, 1, "Timer1_Value"},
    {174, 1, "Timer2_Value"},
    {175, 1, "Axis_EncSync_NUM"},
    {176, 1, "Axis_EncSync_DEN"},
    {177, 1, "Baxis_EncSync_NUM"},
    {178, 1, "Baxis_EncSync_DEN"},
    {179, 1, "Axis_SyncSlope"},
    {180, 1, "Baxis_SyncSlope"},
    {181, 1, "Axis_SyncRPM"},
    {182, 1, "Baxis_SyncRPM"},
};
// clang-format on

}  // namespace understudy::emulator::simple2_r3
