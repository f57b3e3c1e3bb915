#include "emulator/bench/bench.h"

namespace understudy::emulator {

int find_terminal(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.terminals.size(); ++i) {
    if (model.terminals[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

int find_axis(const Model& model, std::string_view name) {
  for (std::size_t i = 0; i < model.axes.size(); ++i) {
    if (model.axes[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace understudy::emulator
