// An onlooker of the programs that interpreters run: it counts lines, or stops at one. It changes nothing.
#pragma once

#include <cstdint>

namespace understudy {

/// Lines are counted from 0 within their part: an area, a macro, or the only one.
class ProgramWatch {
 public:
  virtual ~ProgramWatch() = default;
  /// What follows concerns the present program of the device. Another program has another mark.
  virtual void look(std::uint64_t mark) = 0;
  /// The instruction begins. It begins once, however long it waits. `times` is more than 1 only for scans of
  /// a PLC that are crossed in bulk.
  virtual void runs(int part, int line, std::int64_t times) = 0;
  /// The instruction has decided: a jump is taken, a condition or contact holds, a wait is over at once.
  virtual void decides(int part, int line, bool outcome, std::int64_t times) = 0;
};

/// What a watch can look at. The watch is not state, and null if nobody looks on.
class Watched {
 public:
  ProgramWatch* watch() const { return watch_; }
  void set_watch(ProgramWatch* watch) { watch_ = watch; }

 private:
  ProgramWatch* watch_ = nullptr;
};

}  // namespace understudy
