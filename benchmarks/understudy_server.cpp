#include "benchmarks/understudy_server.h"

#include <stdlib.h>

#include <filesystem>
#include <sstream>

namespace understudy::benchmarks {

UnderstudyServer::PrivateFolder::PrivateFolder()
    : path(std::filesystem::temp_directory_path() / "understudy-benchmark-XXXXXX") {
  if (mkdtemp(path.data()) == nullptr) throw CannotRun(path + ": cannot be created");
}

UnderstudyServer::PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
}

UnderstudyServer::UnderstudyServer(std::string executable, const std::string& timing, int processor,
                                   const std::string& model)
    : executable_(std::move(executable)),
      process_(Process::of_command({executable_, "serve", "--model", model, "--baud", "19200", "--timing",
                                    timing, "--control", control_socket(), "--link", folder_.path + "/port"},
                                   processor)) {
  std::istringstream ready(process_.read_line());  // ready <line> <pty path> <link path>
  std::string word;
  std::string line;
  if (!(ready >> word >> line >> port_) || word != "ready") throw CannotRun(executable_ + " is not ready");
}

UnderstudyServer::~UnderstudyServer() {
  process_.carry_on();
  process_.terminate();
  process_.wait();
}

void UnderstudyServer::start_long_move() const {
  control("set", "device.Aaxis_SVON=1");
  control("set", "device.Aaxis_Pulse=2000000000");
  control("set", "device.Aaxis_Speed=100");
  control("set", "device.Aaxis_Move_INC=1");
}

void UnderstudyServer::start_endless_move() const { control("command", "RSM_CONTINUE_MOVE Y 1000"); }

void UnderstudyServer::control(const std::string& verb, const std::string& what) const {
  Process ctl = Process::of_command({executable_, "ctl", "--control", control_socket(), verb, what});
  if (ctl.wait() != 0) throw CannotRun("understudy ctl " + verb + " " + what + " failed");
}

}  // namespace understudy::benchmarks
