#include "emulator/device/memory/persistent_memory.h"

#include <memory>
#include <string>

#include "base/text/one_line.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

LateImage PersistentMemory::content_now() const {
  const TextBlocks* const texts = text_blocks();
  return [model = model_name_, firmware = firmware_, write = memory_writer(),
          blocks = texts != nullptr ? texts->shared() : nullptr] {
    NvImage image{.model = std::string(model), .firmware = version_text(firmware)};
    write(image);
    if (blocks != nullptr) image.blocks = *blocks;
    return image;
  };
}

void PersistentMemory::load_nv(const NvImage& image) {
  if (image.model != model_name_) {
    throw NvError("model: is the memory of a " + quoted(image.model) + "; expected one of " +
                  std::string(model_name_));
  }
  TextBlocks* const blocks = text_blocks();
  if (blocks == nullptr && !image.blocks.empty()) {
    throw NvError("blocks: are not part of the memory of " + image.model + "; expected none");
  }
  if (blocks != nullptr) blocks->check(image.blocks, image.block_lines);
  read_memory(image);
  if (blocks != nullptr) blocks->replace(image.blocks);
}

}  // namespace understudy::emulator
