// Reports the waits of a host's threads and their durations for recordings, such as "waits for a reply, 512
// ms". Consecutive waits, as for each byte of a reply, are reported as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/serve/daemon/kept_waits.h"
#include "emulator/serve/host_time/host_waits.h"

namespace understudy::emulator::serve {

class HostWaitLog {
 public:
  /// The byte counts of a line.
  struct LineCount {
    std::string name{};
    std::uint64_t bytes_in = 0;
    std::uint64_t bytes_out = 0;
  };
  using Lines = std::vector<LineCount>;

  /// `line_of` returns the line for the number of a terminal or a door, or a number beyond the lines.
  HostWaitLog(std::function<std::size_t(int)> line_of, std::function<void(const HostWait&)> report)
      : line_of_(std::move(line_of)), report_(std::move(report)) {}

  /// Call this when all threads wait and time is about to advance.
  void begin(const HostWaits& waits, const Lines& lines, SimTime now);
  /// Call this when time has advanced, before the host continues.
  void end(const Lines& lines, SimTime now);
  /// Reports the waits that are still open.
  void finish(const Lines& lines);
  /// Returns the waits that are not reported yet, up to the present time.
  std::vector<HostWait> under_way(const HostWaits& waits, const Lines& lines) const;

 private:
  enum class Kind : std::uint8_t { reply, data, drain, thread, sleep, other };
  struct Open {
    Kind kind = Kind::other;
    std::vector<std::size_t> lines{};
    std::uint64_t asked = 0;     // the number of bytes that the host had written to these lines
    std::uint64_t answered = 0;  // the number of bytes that the host had received from them
    std::int64_t until_ns = 0;
    std::uint32_t sequence = 0;
    bool is_check = false;
    SimTime begin{0};
    SimTime end{0};
  };
  /// The byte counts at the last answer of a line.
  struct Answer {
    std::uint64_t bytes_out = 0;
    std::uint64_t bytes_in = 0;
  };

  Open open_for(const HostWaits::Thread& thread, const Lines& lines, SimTime now) const;
  HostWait wait_of(std::size_t thread, const Open& open, const Lines& lines, bool has_ended) const;
  void report(std::size_t thread, const Open& open, const Lines& lines);

  std::function<std::size_t(int)> line_of_;
  std::function<void(const HostWait&)> report_;
  // The keys of both maps are the threads' numbers in order, because a new connection may reuse the
  // descriptor of a closed one.
  std::map<std::size_t, Open> open_;
  std::map<std::size_t, std::size_t> numbers_;
  std::size_t next_number_ = 1;
  std::vector<Answer> answers_;
};

}  // namespace understudy::emulator::serve
