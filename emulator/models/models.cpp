#include "emulator/models/models.h"

#include <array>

#include "emulator/device/model.h"
#include "emulator/models/rs_m8194h/model.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/slim/model.h"

namespace understudy::emulator::models {

ModelList all_models() {
  static const std::array<const Model*, 3> models{&rs_m8194h::model(), &simple2_r3::model(), &slim::model()};
  return models;
}

}  // namespace understudy::emulator::models
