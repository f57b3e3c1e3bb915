// An observer of the programs that interpreters run, which counts lines or stops at one. It never affects the
// programs.
#pragma once

#include <cstdint>
#include <vector>

namespace understudy {

/// Lines are counted from 0 within their part: an area, a macro, or the whole program.
class ProgramWatch {
 public:
  virtual ~ProgramWatch() = default;
  /// The following calls are about the device's present program. `mark` identifies the program.
  virtual void program_loaded(std::uint64_t mark) = 0;
  /// The instruction begins. This is reported once, however long the instruction waits. `times` is more than
  /// 1 only for scans of a PLC that are skipped in bulk.
  virtual void runs(int part, int line, std::int64_t times) = 0;
  /// The instruction has decided: a jump is taken, a condition or contact holds, a wait is over at once.
  virtual void decides(int part, int line, bool outcome, std::int64_t times) = 0;
};

/// Base class of everything that a watch can observe. The watch is not part of the state. It is null if there
/// is no observer.
class Watched {
 public:
  ProgramWatch* watch() const { return watch_; }
  void set_watch(ProgramWatch* watch) { watch_ = watch; }

 private:
  ProgramWatch* watch_ = nullptr;
};

/// Several observers of one program. Each is notified, in the order in which they were added.
class ProgramWatches final : public ProgramWatch {
 public:
  void add(ProgramWatch& watch) { watches_.push_back(&watch); }
  void remove(const ProgramWatch& watch) { std::erase(watches_, &watch); }
  /// Returns the watch to notify: null if there is no observer, and the observer itself if it is the only
  /// one.
  ProgramWatch* watch() {
    if (watches_.size() > 1) return this;
    return watches_.empty() ? nullptr : watches_.front();
  }

  void program_loaded(std::uint64_t mark) override {
    for (ProgramWatch* const watch : watches_) watch->program_loaded(mark);
  }
  void runs(int part, int line, std::int64_t times) override {
    for (ProgramWatch* const watch : watches_) watch->runs(part, line, times);
  }
  void decides(int part, int line, bool outcome, std::int64_t times) override {
    for (ProgramWatch* const watch : watches_) watch->decides(part, line, outcome, times);
  }

 private:
  std::vector<ProgramWatch*> watches_;
};

}  // namespace understudy
