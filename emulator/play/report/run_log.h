// What was observed during the run of a scenario: signals over time, and the frames on its lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::play {

struct SeenSignal {
  std::string name;  // as in probe_names.h: "feeder.A.position"
  enum class Kind : std::uint8_t {
    position,  // the machine's position, in pulses
    pulses,    // the pulses that an axis has sent
    speed,     // the planned speed, in pulses per second
    duty,      // the duty cycle of an axis in PWM mode, in percent
    voltage,   // an analog input or output, in volts
    level,     // an analog input without a unit, a group of terminals, or a count
    bit,       // an input, an output, a switch, power
  } kind = Kind::bit;
  struct Point {
    Tick tick = 0;
    double value = 0;
  };
  std::vector<Point> points{};  // including the first and the last point of the stretch
  double min = 0;
  double max = 0;
  bool varies() const { return min != max; }
};

struct SeenFrame {
  SimTime time{0};  // when its first character began
  std::string line;
  bool is_from_host = true;
  std::string text;        // the decoded text
  std::string bytes;       // "01 03 00 00"
  std::string remark;      // "dropped: bad CRC"; empty if there is no remark
  bool is_struck = false;  // affected by a fault; without bytes: a dropped or an earlier message
};

/// A wait of a host in simulated time, or several waits within one dot of the picture.
struct SeenWait {
  std::size_t thread = 1;
  SimTime begin{0};
  SimTime end{0};
  std::string text;  // the text for the longest wait: "waits for a reply"
  SimTime longest{0};
  std::size_t count = 1;
};

/// A part of the run in which time only goes forward. Each `restore` begins a new stretch.
struct Stretch {
  std::size_t first_step = 0;  // an index into the result's steps
  SimTime begin{0};
  SimTime end{0};
  std::vector<SeenSignal> signals;
  std::vector<SeenWait> waits;    // in chronological order per thread
  std::vector<SeenFrame> frames;  // chronological; if there are many, only the first and last
  std::size_t frames_left_out = 0;
  std::size_t left_out_at = 0;  // the omitted frames precede the frame with this index
};

struct RunLog {
  std::vector<Stretch> stretches;
};

}  // namespace understudy::emulator::play
