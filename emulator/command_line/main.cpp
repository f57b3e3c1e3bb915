// The flags of `understudy`. The only file that includes CLI11: it is slow to compile.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <system_error>

#include "emulator/bench/bench_file.h"
#include "emulator/command_line/commands.h"
#include "emulator/control/server.h"
#include "emulator/model.h"
#include "emulator/one_line.h"
#include "pty/capture_file.h"
#include "pty/pseudo_terminal.h"

namespace {

using namespace understudy::emulator;

/// `--link "$UNSET"` is a slip, not a wish for the default.
const CLI::Validator kNotEmpty(
    [](const std::string& value) { return value.empty() ? std::string("is empty; expected a value") : ""; },
    "");

struct CommandLine {
  CLI::App app{"Firmware-faithful emulator of industrial motion controllers.", "understudy"};
  DescribeArguments describe;
  ServeArguments serve;
  ControlArguments control;
  PollArguments poll;
  std::string program;
  std::vector<std::string> files;
  std::function<int()> chosen;

  CommandLine() {
    app.require_subcommand(1);
    app.set_version_flag("--version", UNDERSTUDY_VERSION);
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
      return "understudy: " + one_line(error.what()) + " (--help tells what is expected)\n";
    });
    add_models();
    add_describe();
    add_serve();
    add_control();
    add_poll();
    add_program_text();
    add_check();
  }

 private:
  void add_models() {
    app.add_subcommand("models", "List the models")->callback([this] { chosen = list_models; });
  }

  void add_describe() {
    CLI::App* command = app.add_subcommand("describe", "Print a model's tables");
    command->add_option("MODEL", describe.model, "A name from `understudy models`")->required();
    command->add_option("WHAT", describe.what, "registers, parameters, instructions, commands or choices")
        ->required();
    command->add_option("--format", describe.format, "table, csv, json or markdown")->capture_default_str();
    command->callback([this] { chosen = [this] { return describe_model(describe); }; });
  }

  void add_serve() {
    CLI::App* command = app.add_subcommand("serve", "Stand in for the devices of a bench, in the foreground");
    command->add_option("BENCH", serve.bench, "A bench file; or else --model");
    command->add_option("--model", serve.model, "One device of this model on one line")->check(kNotEmpty);
    command->add_option("--station", serve.station, "Its station number (with --model) [1]");
    command->add_option("--firmware", serve.firmware, "Its firmware version (with --model) [newest]")
        ->check(kNotEmpty);
    command->add_option("--baud", serve.baud, "Its line speed (with --model) [the factory's]");
    command->add_option("--link", serve.link, "Path of the link to its port (with --model) [a private one]")
        ->check(kNotEmpty);
    command->add_option("--links", serve.links, "Folder for links that are relative, or that nobody named")
        ->check(kNotEmpty);
    command->add_option("--group", serve.group, "Group that may open the ports, such as dialout [none]")
        ->check(kNotEmpty);
    command
        ->add_option("--timing", serve.timing,
                     "wire: bytes take their time; instant: none [wire, or the bench's]")
        ->check(kNotEmpty);
    command->add_flag("--strict-framing", serve.strict_framing,
                      "Only silence ends a frame, as on a real line");
    command->add_flag("--ignore-baud", serve.ignore_baud,
                      "Hear hosts that set another speed or other stop bits");
    command->add_option("--speed", serve.speed, "real, free, manual, or a factor such as 10x")
        ->capture_default_str();
    command->add_option("--control", serve.control, "Path of the control socket [a private one]")
        ->check(kNotEmpty);
    command
        ->add_option("--nv", serve.nv,
                     "Folder for the devices' non-volatile memories [they last as long as the run]")
        ->check(kNotEmpty);
    command
        ->add_option(
            "--capture", serve.capture,
            "Write what goes over the lines to this file: FILE.pcapng for Wireshark, else a text log")
        ->check(kNotEmpty);
    command->callback([this] { chosen = [this] { return understudy::emulator::serve(serve); }; });
  }

  void add_control() {
    CLI::App* command = app.add_subcommand("ctl", "Look into a running `serve`, and act on it");
    command
        ->add_option("--control", control.socket,
                     "Path of its control socket [UNDERSTUDY_CONTROL, or the private one]")
        ->check(kNotEmpty);
    command->add_flag("--json", control.json, "Print the reply as it came: one JSON object");
    command->require_subcommand(1);
    const auto add = [&](const char* verb, const char* help, const char* operand, const char* operand_help) {
      CLI::App* sub = command->add_subcommand(verb, help);
      if (operand != nullptr) sub->add_option(operand, control.operands, operand_help);
      sub->fallthrough();
      sub->callback([this, verb] {
        control.verb = verb;
        chosen = [this] { return understudy::emulator::control(control); };
      });
    };
    add("status", "Time, lateness, lines, stations, machines", nullptr, nullptr);
    add("get", "Read registers", "NAME", "Such as feeder.Cord_A or feeder.STATUS.4");
    add("set", "Write registers, as the wire would", "NAME=VALUE", "Such as feeder.Aaxis_Speed=200");
    add("input", "Hold inputs on or let them go; set analog inputs and DIP switches", "NAME=LEVEL",
        "Such as feeder.DIN_10=1, feeder.AIN_A=2.5V, feeder.DIP1=on");
    add("power", "Switch a device off or on, or off and on again", "WHAT", "DEVICE, and on, off or cycle");
    add("program", "Load a program, or print the one there is", "WHAT", "DEVICE, and a listing to load");
    add("inject", "Break something", "FAULT",
        "stall AXIS, lost_steps AXIS one_in=N, slip AXIS pulses=N, alarm AXIS, or stuck INPUT level=N");
    add("clear", "Mend it", "NUMBER", "Of the fault, or all");
    add("list", "The faults in force", nullptr, nullptr);
    add("advance", "Move simulated time on, where the clock stands", "DURATION", "Such as 250ms");
    add("pause", "Stop simulated time", nullptr, nullptr);
    add("resume", "Let it run again", nullptr, nullptr);
  }

  void add_poll() {
    CLI::App* command = app.add_subcommand("poll", "A small Modbus master, for looking around");
    command->add_option("PORT", poll.port, "A serial port or a link to one")->required();
    command->add_option("ITEM", poll.items,
                        "NAME, ADDRESS or ADDRESS:COUNT to read; NAME=VALUE or ADDRESS=VALUE to write");
    command->add_option("--station", poll.station, "Whom to ask")->capture_default_str();
    command->add_option("--model", poll.model, "Whose names to use")->check(kNotEmpty);
    command->add_option("--baud", poll.baud, "Line speed")->capture_default_str();
    command->add_option("--parity", poll.parity, "even, odd or none")->capture_default_str();
    command->add_option("--stop-bits", poll.stop_bits, "1 or 2")->capture_default_str();
    command->add_option("--function", poll.function, "Function code to read with: 3 or 4")
        ->capture_default_str();
    command->add_option("--type", poll.type, "u16, s16, u32 or s32 of addresses without a model's name")
        ->capture_default_str();
    command->add_option("--timeout", poll.timeout, "How long to wait for a reply")->capture_default_str();
    command->add_option("--every", poll.every, "Time between two rounds")->check(kNotEmpty);
    command->add_option("--times", poll.times, "How many rounds; 0: without end")->capture_default_str();
    command->callback([this] { chosen = [this] { return poll_port(poll); }; });
  }

  void add_program_text() {
    CLI::App* command = app.add_subcommand("asm", "Turn a Simple2-R3 listing into the cells of its lines");
    command->add_option("FILE", program, "A listing")->required();
    command->callback([this] { chosen = [this] { return assemble_program(program); }; });
    command = app.add_subcommand("disasm", "Turn the cells of a Simple2-R3 program into a listing");
    command->add_option("FILE", program, "Lines of CMD DATA1 DATA2 JMP, as asm prints them")->required();
    command->callback([this] { chosen = [this] { return disassemble_program(program); }; });
  }

  void add_check() {
    CLI::App* command = app.add_subcommand("check", "Validate bench files without running them");
    command->add_option("FILE", files, "Bench files")->required();
    command->callback([this] { chosen = [this] { return check_files(files); }; });
  }
};

/// CLI11 takes an unknown command for a stray word and complains that one is missing. Says which word or
/// flag it was, and what is like it; empty if that is not the trouble.
std::string unknown_command(const CLI::App& app, int argc, char** argv, int first) {
  for (int i = first; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-")) {
      const CLI::Option* const flag = app.get_option_no_throw(word.substr(0, word.find('=')));
      if (flag == nullptr) return "'" + word + "' is no flag here";
      if (flag->get_items_expected_max() > 0 && word.find('=') == std::string::npos) ++i;  // its value
      continue;
    }
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
      names.push_back(command->get_name());
      if (word != command->get_name()) continue;
      return command->get_subcommands(nullptr).empty() ? "" : unknown_command(*command, argc, argv, i + 1);
    }
    return "'" + word + "' is no command; the nearest is '" + nearest_word(word, names) + "'";
  }
  return "";
}

int complain(const std::exception& error, int code) {
  std::fprintf(stderr, "understudy: %s\n", one_line(error.what()).c_str());
  return code;
}

/// With a standard descriptor closed, a port would get its number, and what is printed would go out on it.
void open_standard_descriptors() {
  int descriptor = 0;
  while ((descriptor = open("/dev/null", O_RDWR)) >= 0 && descriptor <= STDERR_FILENO) {
  }
  if (descriptor > STDERR_FILENO) close(descriptor);
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_descriptors();
  CommandLine line;
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    const std::string unknown = unknown_command(line.app, argc, argv, 1);
    if (!unknown.empty()) return complain(UsageError(unknown + " (--help lists them)"), kExitBadInput);
    line.app.exit(error);
    return kExitBadInput;
  } catch (const CLI::ParseError& error) {
    return line.app.exit(error) == 0 ? kExitWell : kExitBadInput;
  }
  try {
    const int code = line.chosen();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return complain(std::runtime_error("standard output cannot be written"), kExitNoResource);
  } catch (const BenchError& error) {
    // It begins with the file's name and line, where editors look for it.
    std::fprintf(stderr, "%s\n", error.what());
    return kExitBadInput;
  } catch (const UsageError& error) {
    return complain(error, kExitBadInput);
  } catch (const SettingError& error) {
    return complain(error, kExitBadInput);
  } catch (const NvError& error) {
    std::fprintf(stderr, "%s\n", one_line(error.what()).c_str());  // it begins with the file's name
    return kExitBadInput;
  } catch (const understudy::pty::PortError& error) {
    return complain(error, kExitNoResource);
  } catch (const ControlError& error) {
    return complain(error, kExitNoResource);
  } catch (const understudy::pty::CaptureError& error) {
    return complain(error, kExitNoResource);
  } catch (const std::system_error& error) {
    return complain(error, kExitNoResource);
  } catch (const std::exception& error) {
    return complain(error, kExitInternal);
  }
}
