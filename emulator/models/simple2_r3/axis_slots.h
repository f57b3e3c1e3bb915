// The registers of each axis, in a form that allows the same code to be used for both axes.
#pragma once

#include <array>
#include <cstddef>

#include "emulator/models/simple2_r3/registers.h"

namespace understudy::emulator::models::simple2_r3 {

/// The registers that assign functions to pins are consecutive and begin with DOUT 0 to 3.
inline constexpr std::size_t kFirstAssignment = slot("DOUT0_Aaxis_SVON");
inline constexpr int kAssignmentCount = 14;

struct AxisSlots {
  std::size_t pulse, speed, acc_time, dec_time;
  std::size_t resolution, direction_polarity, servo_polarity, alarm_polarity, encoder_polarity;
  std::size_t alarm_assigned, ready_assigned, upper_assigned, lower_assigned;
  std::size_t home_assigned, servo_output_assigned, alarm_clear_output_assigned;
  std::size_t home_speed, home_acc_time, home_direction;
  std::size_t velocity, velocity_acceleration, pwm;
  std::size_t sync_numerator, sync_denominator, sync_slope, sync_speed, encoder_resolution;
  int alarm_input, ready_input, upper_input, lower_input, home_input;
  int servo_output, alarm_clear_output;
};

inline constexpr std::array<AxisSlots, 2> kAxisSlots{{
    {
        .pulse = slot("Aaxis_Pulse"),
        .speed = slot("Aaxis_Speed"),
        .acc_time = slot("Aaxis_AccTime"),
        .dec_time = slot("Aaxis_DecTime"),
        .resolution = slot("Aaxis_Resoultion"),
        .direction_polarity = slot("Aaxis_DIR_Polarity"),
        .servo_polarity = slot("Aaxis_SVON_Polarity"),
        .alarm_polarity = slot("Aaxis_ALM_Polarity"),
        .encoder_polarity = slot("Axis_ENC_Polarity"),
        .alarm_assigned = slot("DIN0_Aaxis_Alarm"),
        .ready_assigned = slot("DIN1_Aaxis_Ready"),
        .upper_assigned = slot("DIN2_Aaxis_UP_Limit"),
        .lower_assigned = slot("DIN3_Aaxis_DN_Limit"),
        .home_assigned = slot("DIN4_Aaxis_Home"),
        .servo_output_assigned = slot("DOUT0_Aaxis_SVON"),
        .alarm_clear_output_assigned = slot("DOUT1_Aaxis_ACLR"),
        .home_speed = slot("Aaxis_Home_Speed"),
        .home_acc_time = slot("Aaxis_Home_AccTime"),
        .home_direction = slot("Axis_GoHome_DIR"),
        .velocity = slot("Aaxis_DirectmRPM"),
        .velocity_acceleration = slot("Axis_VelMode_ACC"),
        .pwm = slot("Aaxis_DirectPWM"),
        .sync_numerator = slot("Axis_EncSync_NUM"),
        .sync_denominator = slot("Axis_EncSync_DEN"),
        .sync_slope = slot("Axis_SyncSlope"),
        .sync_speed = slot("Axis_SyncRPM"),
        .encoder_resolution = slot("ENCA_Resoultion"),
        .alarm_input = 0,
        .ready_input = 1,
        .upper_input = 2,
        .lower_input = 3,
        .home_input = 4,
        .servo_output = 0,
        .alarm_clear_output = 1,
    },
    {
        .pulse = slot("Baxis_Pulse"),
        .speed = slot("Baxis_Speed"),
        .acc_time = slot("Baxis_AccTime"),
        .dec_time = slot("Baxis_DecTime"),
        .resolution = slot("Baxis_Resoultion"),
        .direction_polarity = slot("Baxis_DIR_Polarity"),
        .servo_polarity = slot("Baxis_SVON_Polarity"),
        .alarm_polarity = slot("Baxis_ALM_Polarity"),
        .encoder_polarity = slot("Baxis_ENC_Polarity"),
        .alarm_assigned = slot("DIN5_Baxis_Alarm"),
        .ready_assigned = slot("DIN6_Baxis_Ready"),
        .upper_assigned = slot("DIN7_Baxis_UP_Limit"),
        .lower_assigned = slot("DIN8_Baxis_DN_Limit"),
        .home_assigned = slot("DIN9_Baxis_Home"),
        .servo_output_assigned = slot("DOUT2_Baxis_SVON"),
        .alarm_clear_output_assigned = slot("DOUT3_Baxis_ACLR"),
        .home_speed = slot("Baxis_Home_Speed"),
        .home_acc_time = slot("Baxis_Home_AccTime"),
        .home_direction = slot("Baxis_GoHome_DIR"),
        .velocity = slot("Baxis_DirectmRPM"),
        .velocity_acceleration = slot("Baxis_VelMode_ACC"),
        .pwm = slot("Baxis_DirectPWM"),
        .sync_numerator = slot("Baxis_EncSync_NUM"),
        .sync_denominator = slot("Baxis_EncSync_DEN"),
        .sync_slope = slot("Baxis_SyncSlope"),
        .sync_speed = slot("Baxis_SyncRPM"),
        .encoder_resolution = slot("ENCB_Resoultion"),
        .alarm_input = 5,
        .ready_input = 6,
        .upper_input = 7,
        .lower_input = 8,
        .home_input = 9,
        .servo_output = 2,
        .alarm_clear_output = 3,
    },
}};

}  // namespace understudy::emulator::models::simple2_r3
