#include "base/state/shared_text.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/state/state_bytes.h"

namespace understudy {

SharedText::SharedText() {
  static const auto empty = std::make_shared<const Held>(Held{.text = {}, .digest = hash_of({})});
  held_ = empty;
}

SharedText::SharedText(std::string text) {
  const std::uint64_t digest = hash_of(std::as_bytes(std::span(text)));
  held_ = std::make_shared<const Held>(Held{.text = std::move(text), .digest = digest});
}

}  // namespace understudy
