// Runs `understudy serve` for benchmarks, with one device (by default a Simple2-R3) at 19200 8E1.
#pragma once

#include <string>

#include "benchmarks/process.h"

namespace understudy::benchmarks {

class UnderstudyServer {
 public:
  /// Returns when the server is ready. Throws CannotRun.
  UnderstudyServer(std::string executable, const std::string& timing, int processor = Process::kAnyProcessor,
                   const std::string& model = "simple2-r3");
  ~UnderstudyServer();
  UnderstudyServer(const UnderstudyServer&) = delete;
  UnderstudyServer& operator=(const UnderstudyServer&) = delete;

  const Process& process() const { return process_; }
  const std::string& port() const { return port_; }  // /dev/pts/N
  std::string control_socket() const { return folder_.path + "/control"; }

  /// Starts axis A on a move that lasts for days, so that every tick has something to do.
  void start_long_move() const;
  /// Starts an endless move of axis Y of an RS-M8194H.
  void start_endless_move() const;

 private:
  struct PrivateFolder {
    PrivateFolder();
    ~PrivateFolder();
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;
    std::string path;
  };
  void control(const std::string& verb, const std::string& what) const;

  std::string executable_;
  PrivateFolder folder_;
  Process process_;
  std::string port_;
};

}  // namespace understudy::benchmarks
