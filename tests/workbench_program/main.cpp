// `understudy` with the test controller in addition to its own, for tests that only this controller allows.
#include <vector>

#include "emulator/command_line/program.h"
#include "emulator/models/models.h"
#include "tests/emulator/workbench/workbench.h"

int main(int argc, char** argv) {
  using namespace understudy::emulator;
  std::vector<ListedModel> models(models::all_models().begin(), models::all_models().end());
  models.push_back(&workbench::model());
  return command_line::run_program(argc, argv, models);
}
