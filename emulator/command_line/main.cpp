// Starts `understudy` with all built-in models and the reader of model files.
#include "emulator/command_line/program.h"
#include "emulator/model_file/model_files.h"
#include "emulator/models/models.h"

int main(int argc, char** argv) {
  using namespace understudy::emulator;
  model_file::DescribedModels described(models::all_models());
  return command_line::run_program(argc, argv, {models::all_models(), &described});
}
