#include "emulator/device/memory/kept_memory.h"

#include "base/text/one_line.h"

namespace understudy::emulator {

NvImage KeptMemory::nv_image() const {
  NvImage image{.model = std::string(model_name_), .firmware = version_text(firmware_)};
  write_memory(image);
  return image;
}

void KeptMemory::load_nv(const NvImage& image) {
  if (image.model != model_name_) {
    throw NvError("model: is the memory of a " + quoted(image.model) + "; expected one of " +
                  std::string(model_name_));
  }
  read_memory(image);
}

}  // namespace understudy::emulator
