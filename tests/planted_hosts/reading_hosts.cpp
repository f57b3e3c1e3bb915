// Hosts that go wrong in how they read and write values, and in how they deal with a line that fails.
#include <cstdint>
#include <optional>

#include "tests/planted_hosts/feeder.h"
#include "tests/planted_hosts/hosts.h"
#include "tests/planted_hosts/line.h"

namespace understudy::planted {

/// It stops the axis if it is beyond the end. The careless host reads the two words of the position one after
/// the other, so they may be of two moments; the careful one reads both at once.
void torn_value(bool is_careful, int pause_ms) {
  constexpr int kPulsesOfMove = 70'000;
  constexpr int kEnd = 75'000;
  Line line;
  set_up(line);
  line.surely_write(kPulses, words_of(kPulsesOfMove));
  line.surely_write(kMove, 1);
  sleep_ms(pause_ms);
  while (is_moving(line)) {
    Words words;
    if (is_careful) {
      words = line.surely_read(kPosition, 2);
    } else {
      words.push_back(static_cast<std::uint16_t>(line.surely_read(kPosition)));
      words.push_back(static_cast<std::uint16_t>(line.surely_read(kPosition + 1)));
    }
    if (value_of(words) > kEnd) line.surely_write(kStop, 1);
    sleep_ms(100);
  }
}

/// It watches the status and the inputs by turns; the input 4 stops the axis. If an answer comes after the
/// careless host has given it up, the host takes it for the answer to its next question. The careful one
/// waits until nothing more comes, and drops it.
void timeout_race(bool is_careful, int pulses) {
  constexpr int kInputs = 0x0DF1;
  Line line;
  set_up(line);
  line.surely_write(kPulses, words_of(pulses));
  line.surely_write(kMove, 1);
  line.timeout_ms = 40;
  line.flushes = false;
  const auto ask = [&](int address) {
    const std::optional<int> value = line.read_one(address);
    if (!value && is_careful) {
      sleep_ms(150);
      line.throw_away();
    }
    return value;
  };
  int status = kMoving;
  while ((status & kMoving) != 0) {
    status = ask(kStatus).value_or(status);
    const std::optional<int> inputs = ask(kInputs);
    if (inputs && (*inputs & (1 << 4)) != 0) line.write(kStop, 1);
    sleep_ms(20);
  }
}

/// The port is pulled out and comes back. The careless host continues with the next part; the careful one
/// looks whether the move that it has sent was made.
void lost_command(bool is_careful, int pulses) {
  Line line;
  set_up(line);
  for (int part = 1; part <= 5; ++part) {
    const std::int32_t from = position(line);
    const auto start = [&] {
      line.surely_write(kPulses, words_of(pulses));
      return line.write(kMove, 1);
    };
    while (!start()) {
      if (line.is_lost()) line.reopen();
      if (!is_careful || is_moving(line) || position(line) != from) break;
    }
    wait_for_end(line);
  }
}

/// It counts parts in the controller, in numbers of 32 bits with the low word first, which it chooses. After
/// a loss of power the controller has forgotten that choice. The careful host looks at it before each number.
void word_order(bool is_careful, int count) {
  constexpr int kOrder = 0x000E;
  constexpr int kLowFirst = 1;
  Line line;
  line.surely_write(kOrder, kLowFirst);
  for (int part = 1; part <= count; ++part) {
    sleep_ms(200);
    bool is_kept = false;
    while (!is_kept) {
      if (is_careful && line.surely_read(kOrder) != kLowFirst) line.surely_write(kOrder, kLowFirst);
      line.surely_write(kPartsMade, words_of(part));
      is_kept = !is_careful || line.surely_read(kOrder) == kLowFirst;
    }
  }
}

}  // namespace understudy::planted
