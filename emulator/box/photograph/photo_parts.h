// Code shared by the two ways to take a photograph.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/box/photograph/photograph.h"
#include "emulator/box/wire/port_name.h"
#include "emulator/box/wire/wire.h"
#include "emulator/device/model.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

struct PhotoInterrupted : BoxError {
  PhotoInterrupted() : BoxError("interrupted") {}
};

/// The state of a photograph in progress.
struct PhotoWork {
  const Model& model;
  const PortName& port;
  const PhotoSettings& settings;
  const PhotoProgress& progress;
  Wire& wire;
  Photograph photo{};
  int modules = 0;  // of a chain, once it is known

  void note(Asked asked);
  /// Reports the next question. Throws PhotoInterrupted.
  void report(std::string_view next) const {
    if (settings.is_over && settings.is_over()) throw PhotoInterrupted();
    if (progress) progress(photo.exchanges.size(), next);
  }
  /// Adds a value that the controller did not return.
  void refuse(const PhotoRefusal& refusal) { photo.refused.push_back(refusal); }
};

/// Returns the line settings to try, the likeliest first: the user's, or else all that the model's ports can
/// have. If the port has no settings, only the first.
std::vector<pty::LineSettings> settings_to_try(const Model& model, const PortName& port);

/// Returns the message for a controller that does not answer: what was asked, and at which settings.
std::string silence_text(const PortName& port, const std::string& who,
                         const std::vector<pty::LineSettings>& tried, bool is_noisy, bool is_echoing);

void photograph_registers(PhotoWork& work);
void photograph_text(PhotoWork& work);

/// Makes the image from persistent values. Removes, one by one, those that the model refuses.
void settle_image(PhotoWork& work, NvImage image);

}  // namespace understudy::emulator::box
