// Shared by the two ways to take a photograph.
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

/// What is known while a photograph is taken.
struct PhotoWork {
  const Model& model;
  const PortName& port;
  const PhotoSettings& settings;
  const PhotoProgress& progress;
  Wire& wire;
  Photograph photo{};
  int modules = 0;  // of a chain, once it is known

  void note(Asked asked);
  /// Reports what is asked next.
  void tell(std::string_view next) const {
    if (progress) progress(photo.exchanges.size(), next);
  }
  /// Adds to what the controller did not tell.
  void refuse(const PhotoRefusal& refusal) { photo.refused.push_back(refusal); }
};

/// Returns the settings of the line to try, the likeliest first: what the user set, or else all that the
/// model's ports can be set to. One of its own if the port has no settings.
std::vector<pty::LineSettings> settings_to_try(const Model& model, const PortName& port);

/// Returns the message for a controller that does not answer: what was asked, and at which settings.
std::string silence_text(const PortName& port, const std::string& who,
                         const std::vector<pty::LineSettings>& tried, bool is_noisy, bool is_echoing);

void photograph_registers(PhotoWork& work);
void photograph_text(PhotoWork& work);

/// Makes the image from persistent values: takes out, one by one, what the model refuses.
void settle_image(PhotoWork& work, NvImage image);

}  // namespace understudy::emulator::box
