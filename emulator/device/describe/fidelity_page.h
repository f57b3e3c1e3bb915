// Generates docs/fidelity/MODEL.md, which describes how faithful a model is, from the model's tables.
#pragma once

#include <string>

#include "emulator/device/model.h"

namespace understudy::emulator {

/// Returns the page as Markdown: first the choices, then what is not modelled.
std::string fidelity_page(const Model& model);

}  // namespace understudy::emulator
