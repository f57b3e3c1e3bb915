// Hosts that go wrong in how they start a move and wait for its end.
#include <cstdint>
#include <optional>

#include "tests/planted_hosts/feeder.h"
#include "tests/planted_hosts/hosts.h"
#include "tests/planted_hosts/line.h"

namespace understudy::planted {

/// The answer to the command that starts the move may be lost after it was executed. The careless host sends
/// it again; the careful one looks whether the axis has moved or moves.
void double_move(bool is_careful, int pulses) {
  Line line;
  set_up(line);
  const std::int32_t from = position(line);
  line.surely_write(kPulses, words_of(pulses));
  while (!line.write(kMove, 1)) {
    if (is_careful && (is_moving(line) || position(line) != from)) break;
  }
  wait_for_end(line);
}

/// It looks at the last status that it has. The careless host keeps the one from before the move if the next
/// poll is lost; the careful one takes the axis for busy once it has commanded a move.
void stale_busy_bit(bool is_careful, int pulses) {
  Line line;
  set_up(line);
  int status = line.surely_read(kStatus);
  const auto poll = [&] { status = line.read_one(kStatus).value_or(status); };
  for (int part = 0; part < 3; ++part) {
    line.surely_write(kPulses, words_of(pulses));
    line.surely_write(kMove, 1);
    if (is_careful) status |= kMoving;
    do {
      sleep_ms(20);
      poll();
    } while ((status & kMoving) != 0);
  }
}

/// It homes, and then moves from there. The careless host gives the homing two seconds; the careful one waits
/// until the axis has found its home.
void missing_wait(bool is_careful, int pulses) {
  Line line;
  set_up(line);
  line.surely_write(kGoHome, 1);
  if (is_careful) {
    while ((line.surely_read(kStatus) & kIsHome) == 0) sleep_ms(20);
    wait_for_end(line);
  } else {
    sleep_ms(2000);
  }
  line.surely_write(kPulses, words_of(pulses));
  line.surely_write(kMove, 1);
  wait_for_end(line);
}

/// It stops a move that takes longer than four seconds, by a clock of 16 bits. The careless host compares the
/// times; the careful one their difference.
void counter_overflow(bool is_careful, int pause_ms) {
  constexpr int kPulsesOfMove = 16'000;
  constexpr std::uint16_t kLongest_ms = 4000;
  const auto clock = [] { return static_cast<std::uint16_t>(now_ms()); };
  Line line;
  set_up(line);
  sleep_ms(pause_ms);
  line.surely_write(kPulses, words_of(kPulsesOfMove));
  line.surely_write(kMove, 1);
  const auto end = static_cast<std::uint16_t>(clock() + kLongest_ms);
  while (is_moving(line)) {
    const bool is_late = is_careful ? static_cast<std::int16_t>(clock() - end) > 0 : clock() > end;
    if (is_late) line.surely_write(kStop, 1);
    sleep_ms(20);
  }
}

/// A panel is polled on the same line. The operator stops the axis by an input. The careless host asks the
/// panel three times before it looks at the input again; the careful one looks in between.
void starved_stop(bool is_careful, int pulses) {
  constexpr int kPanel = 2;
  Line line;
  set_up(line);
  line.surely_write(kPulses, words_of(pulses));
  line.surely_write(kMove, 1);
  const auto look_at_stop = [&] {
    if (line.read_one(kStopInput).value_or(0) != 0) line.surely_write(kStop, 1);
  };
  while (is_moving(line)) {
    look_at_stop();
    line.station = kPanel;
    for (int attempt = 0; attempt < 3 && !line.read_one(kStatus); ++attempt) {
      line.station = 1;
      if (is_careful) look_at_stop();
      line.station = kPanel;
    }
    line.station = 1;
  }
}

/// A drive's alarm stops the motor while the controller continues. After it the host takes the position from
/// the encoder and moves again. The careless host clears the alarm once and takes it for gone; the careful
/// one clears it until it is.
void early_alarm_clear(bool is_careful, int pulses) {
  Line line;
  set_up(line);
  const auto move = [&] {
    line.surely_write(kPulses, words_of(pulses));
    line.surely_write(kMoveTo, 1);
    sleep_ms(20);
    while (true) {
      const int status = line.surely_read(kStatus);
      if ((status & (kMoving | kAlarm)) != kMoving) return (status & kAlarm) == 0;
      sleep_ms(20);
    }
  };
  bool is_done = move();
  while (!is_done) {
    line.surely_write(kStop, 1);
    wait_for_end(line);
    do {
      line.surely_write(kClearAlarm, 1);
      sleep_ms(50);
      line.surely_write(kClearAlarm, 0);
      sleep_ms(50);
    } while (is_careful && (line.surely_read(kStatus) & kAlarm) != 0);
    line.surely_write(kPosition, line.surely_read(kEncoder, 2));
    is_done = move() || !is_careful;
  }
}

}  // namespace understudy::planted
