// The part of a device that survives power-off. This is a facet: Device::memory() is null if a device has no
// such memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

class PersistentMemory {
 public:
  /// These convert the memory to and from its form in files. load_nv() requires that the power is off, and
  /// throws NvError for an image that the device cannot store.
  NvImage nv_image() const { return content_now()(); }
  void load_nv(const NvImage& image);
  /// Captures the present content of the memory. The returned function can create the image later, in another
  /// thread, even after the device was destroyed. Capturing is fast (it copies numbers and shares texts),
  /// whereas creating the image takes time.
  LateImage content_now() const;

  /// Returns the named texts in the memory, or null for most devices, which have none. Images include them
  /// automatically.
  virtual TextBlocks* text_blocks() { return nullptr; }
  virtual const TextBlocks* text_blocks() const { return nullptr; }

  /// Changes whenever the content that would survive a power failure may have changed.
  virtual std::uint64_t memory_revision() const = 0;
  /// Stores all waiting writes immediately, as if their time had passed.
  virtual void settle_memory() = 0;

 protected:
  /// The images name this model and firmware.
  PersistentMemory(std::string_view model_name, Firmware firmware)
      : model_name_(model_name), firmware_(firmware) {}
  ~PersistentMemory() = default;

  /// Returns a function that writes the present content, except text_blocks(), into an image that already
  /// contains the model and the firmware. The function does not refer to the device.
  virtual std::function<void(NvImage&)> memory_writer() const = 0;
  /// Reads an image while the power is off. Entries that are missing from the image get their factory values.
  /// Throws NvError for an image that the memory cannot store; in that case, nothing changes.
  virtual void read_memory(const NvImage& image) = 0;

 private:
  std::string_view model_name_;
  Firmware firmware_;
};

}  // namespace understudy::emulator
