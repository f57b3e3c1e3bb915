// Hosts that move a machine. Each has a fault that shows only now and then, except if `is_careful` is true.
#pragma once

namespace understudy::planted {

// The numbers are parameters that the host's campaign varies.
void double_move(bool is_careful, int pulses);
void stale_busy_bit(bool is_careful, int pulses);
void torn_value(bool is_careful, int pause_ms);
void timeout_race(bool is_careful, int pulses);
void missing_wait(bool is_careful, int pulses);
void counter_overflow(bool is_careful, int pause_ms);
void lost_command(bool is_careful, int pulses);
void starved_stop(bool is_careful, int pulses);
void word_order(bool is_careful, int count);
void early_alarm_clear(bool is_careful, int pulses);

}  // namespace understudy::planted
