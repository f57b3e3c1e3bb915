// An observer of the programs that interpreters run. It counts lines or stops at a line, and never affects
// the programs.
#pragma once

#include <cstdint>
#include <vector>

namespace understudy {

/// Lines are counted from 0 within their part: an area, a macro, or the whole program.
class ProgramWatch {
 public:
  virtual ~ProgramWatch() = default;
  /// The following calls refer to the device's current program, which `mark` identifies.
  virtual void program_loaded(std::uint64_t mark) = 0;
  /// The instruction begins. This is reported once, even if the instruction waits. `times` is more than 1
  /// only for PLC scans that are skipped in bulk.
  virtual void runs(int part, int line, std::int64_t times) = 0;
  /// The instruction has made a decision: a jump is taken, a condition or contact holds, or a wait ends
  /// immediately.
  virtual void decides(int part, int line, bool outcome, std::int64_t times) = 0;
};

/// Base class of everything that a watch can observe. The watch is not part of the state, and is null if
/// there is no observer.
class Watched {
 public:
  ProgramWatch* watch() const { return watch_; }
  void set_watch(ProgramWatch* watch) { watch_ = watch; }

 private:
  ProgramWatch* watch_ = nullptr;
};

/// Several observers of one program. They are notified in the order in which they were added.
class ProgramWatches final : public ProgramWatch {
 public:
  void add(ProgramWatch& watch) { watches_.push_back(&watch); }
  void remove(const ProgramWatch& watch) { std::erase(watches_, &watch); }
  /// Returns the watch to notify: null if there is no observer, the observer itself if there is only one.
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
