// The commands of `understudy`, free of any parsing of flags. Each returns the exit code.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace understudy::emulator {

enum ExitCode : int {
  kExitWell = 0,
  kExitFailed = 1,      // a scenario or replay failed; a poll was refused or not answered
  kExitBadInput = 2,    // usage, file or configuration
  kExitNoResource = 3,  // a port, socket or capture could not be had
  kExitInternal = 4,
};

/// Bad usage: one line that names the flag or value and what was expected.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

int list_models();

struct DescribeArguments {
  std::string model;
  std::string what;
  std::string format = "table";
};
int describe_model(const DescribeArguments& arguments);

struct ServeArguments {
  std::string bench;  // a file; or else `model` and what belongs to it
  std::string model;
  std::optional<int> station;
  std::string firmware;
  std::optional<int> baud;
  std::string link;
  std::string links;  // the folder for links that the bench leaves relative, or out
  std::string group;
  std::string timing;
  bool strict_framing = false;
  bool ignore_baud = false;
  std::string speed = "real";
  std::string control;
  std::string nv;  // the folder for memories of devices that have no file of their own
  std::string capture;
};
int serve(const ServeArguments& arguments);

struct ControlArguments {
  std::string socket;
  bool json = false;
  std::string verb;
  std::vector<std::string> operands;
};
int control(const ControlArguments& arguments);

struct PollArguments {
  std::string port;
  int station = 1;
  int baud = 19200;
  std::string parity = "even";
  int stop_bits = 1;
  std::string model;
  int function = 3;
  std::string type = "u16";
  std::string timeout = "1s";
  std::string every;
  int times = 1;
  std::vector<std::string> items;
};
int poll_port(const PollArguments& arguments);

/// A Simple2-R3 program: from its listing to cells, and back (interpreter/simple2/listing.h).
int assemble_program(const std::string& file);
int disassemble_program(const std::string& file);

int check_files(const std::vector<std::string>& files);

}  // namespace understudy::emulator
