// The choices that a bench's devices have decided by, and where in a capture they last did. If a reply
// differs, the option of one that was asked recently may be the reason.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/world/view/world_view.h"

namespace understudy::emulator::box {

struct AskedChoice {
  std::string choice;               // "feeder.exceptions"
  std::string option;               // which the bench has
  std::string section;              // of the manual
  std::size_t place = 0;            // in the capture, where it was last asked; 0: before the first request
  bool is_since_agreement = false;  // it was asked after the last reply that agreed
};

class AskedChoices {
 public:
  /// Resets what the line's devices count (device/decisions.h), so nobody else may read it.
  explicit AskedChoices(const world::WorldLine& line);

  /// Notes what was asked up to the reply to the request at `place`.
  void note(std::size_t place);
  void agree() { agreed_ = noted_; }
  /// Returns all that were asked, the latest first. Choices with a single option are left out.
  std::vector<AskedChoice> latest_first() const;

 private:
  struct Last {
    std::size_t note = 0;  // its number; 0: never
    std::size_t place = 0;
  };
  const world::WorldLine& line_;
  std::vector<std::vector<Last>> last_;  // by station, then by row
  std::size_t noted_ = 0;
  std::size_t agreed_ = 0;
};

}  // namespace understudy::emulator::box
