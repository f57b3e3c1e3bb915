// docs/fidelity/MODEL.md: how faithful a model is, made from its tables.
#pragma once

#include <string>

#include "emulator/device/model.h"

namespace understudy::emulator {

/// The page as Markdown: choices, then what is not modelled.
std::string fidelity_page(const Model& model);

}  // namespace understudy::emulator
