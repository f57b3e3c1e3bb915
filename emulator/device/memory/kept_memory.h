// The part of a device that survives power-off. A facet: Device::memory() is null if a device keeps nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

class KeptMemory {
 public:
  /// To and from the form in files (from: only without power). Throws NvError for what it cannot hold.
  NvImage nv_image() const { return kept_now()(); }
  void load_nv(const NvImage& image);
  /// What it keeps at this moment. Whoever has that may make the image later, in another thread, and when the
  /// device is gone: taking it copies numbers and shares texts, making the image is what takes time.
  LateImage kept_now() const;

  /// The named texts that it keeps; null for most. They are in its images without more ado.
  virtual TextBlocks* text_blocks() { return nullptr; }
  virtual const TextBlocks* text_blocks() const { return nullptr; }

  /// Changes whenever what would survive a power failure now may have changed.
  virtual std::uint64_t kept_revision() const = 0;
  /// Keeps all that waits to be kept at once, as if its time had passed.
  virtual void settle_memory() = 0;

 protected:
  /// Of the model and the firmware that its images name.
  KeptMemory(std::string_view model_name, Firmware firmware) : model_name_(model_name), firmware_(firmware) {}
  ~KeptMemory() = default;

  /// What puts all that is kept now, but for text_blocks(), into an image that has the model and the firmware
  /// already. It refers to nothing of the device.
  virtual std::function<void(NvImage&)> memory_writer() const = 0;
  /// The reverse, without power: what the image does not name has the factory's value. If it throws (NvError:
  /// it cannot hold that), nothing has changed.
  virtual void read_memory(const NvImage& image) = 0;

 private:
  std::string_view model_name_;
  Firmware firmware_;
};

}  // namespace understudy::emulator
