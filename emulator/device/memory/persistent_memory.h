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
  /// Convert the memory to and from the form in files. load_nv() requires that the power is off, and throws
  /// NvError for an image that the device cannot hold.
  NvImage nv_image() const { return content_now()(); }
  void load_nv(const NvImage& image);
  /// Captures the memory's content at this moment. The result can make the image later, in another thread,
  /// even after the device has been destroyed. Capturing is quick (it copies numbers and shares texts);
  /// making the image takes time.
  LateImage content_now() const;

  /// Returns the named texts in the memory; null for most devices, which have none. Images include them
  /// automatically.
  virtual TextBlocks* text_blocks() { return nullptr; }
  virtual const TextBlocks* text_blocks() const { return nullptr; }

  /// Changes whenever the content that would survive a power failure may have changed.
  virtual std::uint64_t memory_revision() const = 0;
  /// Stores all waiting writes at once, as if their time had passed.
  virtual void settle_memory() = 0;

 protected:
  /// The images name this model and firmware.
  PersistentMemory(std::string_view model_name, Firmware firmware)
      : model_name_(model_name), firmware_(firmware) {}
  ~PersistentMemory() = default;

  /// Returns a function that writes the present content, except text_blocks(), into an image that already has
  /// model and firmware. The function refers to nothing in the device.
  virtual std::function<void(NvImage&)> memory_writer() const = 0;
  /// Reads an image while the power is off. Entries that the image does not name get the factory value.
  /// Throws NvError for an image that the memory cannot hold; then nothing has changed.
  virtual void read_memory(const NvImage& image) = 0;

 private:
  std::string_view model_name_;
  Firmware firmware_;
};

}  // namespace understudy::emulator
