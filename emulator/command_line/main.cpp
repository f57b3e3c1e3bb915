// `understudy`: the program, with every model there is.
#include "emulator/command_line/program.h"
#include "emulator/models/models.h"

int main(int argc, char** argv) {
  return understudy::emulator::command_line::run_program(argc, argv,
                                                         understudy::emulator::models::all_models());
}
