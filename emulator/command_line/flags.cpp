// Only this file and app_words.cpp are compiled with CLI11, because that is slow. Building all flags takes
// longer than running most commands, so the parser omits commands whose names are not on the command line.
// For errors and help, it is built again with all commands.
#include "emulator/command_line/flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/app_words.h"
#include "emulator/command_line/box_flags.h"
#include "emulator/command_line/choose_daemon.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/completion.h"
#include "emulator/command_line/ctl_words.h"
#include "emulator/command_line/import_flags.h"
#include "emulator/command_line/looking_flags.h"
#include "emulator/command_line/model_flags.h"
#include "emulator/command_line/page_flags.h"
#include "emulator/command_line/poll_flags.h"
#include "emulator/command_line/replay_flags.h"
#include "emulator/command_line/run_flags.h"
#include "emulator/command_line/serving_flags.h"
#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

namespace {

struct CommandLine {
  ModelList models;
  CLI::App app{"Firmware-faithful emulator of industrial motion controllers.", "understudy"};
  DescribeArguments describe;
  ServeArguments serve;
  ExecArguments exec;
  RunArguments run;
  HuntArguments hunt;
  CoverageArguments coverage;
  ReplayArguments replay;
  ControlArguments control;
  WatchArguments watched;
  FramesArguments frames;
  PageArguments page;
  DapArguments dap;
  PollArguments poll;
  PhotographArguments photograph;
  ProbeArguments probe;
  CompareArguments compare;
  CalibrateArguments calibrate;
  CertificateArguments certificate;
  TapArguments tap;
  PlotArguments plot;
  ProgramTextArguments program;
  CheckArguments check;
  InitArguments init;
  ImportArguments import;
  SchemaArguments schema;
  std::string shell;
  std::function<int()> chosen;

  using Words = std::span<char* const>;
  /// Omits all commands that are not in `among`, if it is given.
  CommandLine(ModelList known, std::optional<Words> among) : models(known), among_(among) {
    app.require_subcommand(1);
    app.set_version_flag("--version", UNDERSTUDY_VERSION);
    add_commands(app, kCommands);
  }

 private:
  struct Command {
    const char* name;
    const char* help;
    void (CommandLine::*fill)(CLI::App& command);
  };
  static const std::vector<Command> kCommands;
  static const std::array<Command, 3> kCommandsOfControl;  // the commands that are not single messages
  std::optional<Words> among_;

  bool may_be_meant(std::string_view name) const {
    return !among_ || std::find(among_->begin(), among_->end(), name) != among_->end();
  }

  void add_commands(CLI::App& to, std::span<const Command> commands) {
    for (const Command& row : commands) {
      if (may_be_meant(row.name)) (this->*row.fill)(*to.add_subcommand(row.name, row.help));
    }
  }

  void add_models(CLI::App& command) {
    command.callback([this] { chosen = [this] { return list_models(models); }; });
  }

  void add_describe(CLI::App& command) {
    add_describe_flags(command, describe);
    command.callback([this] { chosen = [this] { return describe_model(models, describe); }; });
  }

  void add_serve(CLI::App& command) {
    add_serving_flags(command, serve);
    command
        .add_option("--page", serve.page, "Also show the bench in a browser, on this port [any free port]")
        ->expected(0, 1)
        ->default_str("0");
    command.callback(
        [this] { chosen = [this] { return understudy::emulator::command_line::serve(models, serve); }; });
  }

  void add_exec(CLI::App& command) {
    add_serving_flags(command, exec.serve);
    command.add_option("COMMAND", exec.stray_words, "A command and its arguments, after --");
    add_exec_flags(command, exec);
    command.callback([this, &command] {
      exec.has_speed = command.count("--speed") > 0;
      chosen = [this] { return execute(models, exec); };
    });
  }

  void add_tty_shim(CLI::App& command) {
    command.callback([this] { chosen = print_tty_shim; });
  }

  void add_replay(CLI::App& command) {
    add_replay_flags(command, replay);
    command.callback([this] {
      replay.version = UNDERSTUDY_VERSION;
      chosen = [this] { return replay_recording(models, replay); };
    });
  }

  void add_run(CLI::App& command) {
    add_run_flags(command, run);
    command.callback([this] {
      run.version = UNDERSTUDY_VERSION;
      chosen = [this] { return run_scenarios(models, run); };
    });
  }

  void add_hunt(CLI::App& command) {
    add_hunt_flags(command, hunt);
    command.callback([this] {
      hunt.version = UNDERSTUDY_VERSION;
      chosen = [this] { return hunt_scenario(models, hunt); };
    });
  }

  void add_watch(CLI::App& command) {
    add_watch_flags(command, watched);
    command.fallthrough();
    command.callback([this] {
      watched.which = control.which;
      chosen = [this] { return watch(watched); };
    });
  }

  void add_frames(CLI::App& command) {
    add_frames_flags(command, frames);
    command.fallthrough();
    command.callback([this] {
      frames.which = control.which;
      frames.json = control.json;
      chosen = [this] { return follow_frames(frames); };
    });
  }

  void add_daemons(CLI::App& command) {
    command.fallthrough();
    command.callback([this] { chosen = [this] { return list_daemons(control.json); }; });
  }

  void add_control(CLI::App& command) {
    CLI::Option* const socket =
        command
            .add_option(
                "--control", control.which.socket,
                "Path of the daemon's control socket [UNDERSTUDY_CONTROL, or that of the only daemon]")
            ->check(kNotEmpty);
    command.add_option("--bench", control.which.bench, "Choose the daemon that serves this bench file")
        ->check(kNotEmpty)
        ->excludes(socket);
    command
        .add_option("--port", control.which.port,
                    "Choose the daemon that serves this port, or the link to it")
        ->check(kNotEmpty)
        ->excludes(socket);
    command.add_flag("--json", control.json, "Print the reply unchanged: one JSON object");
    command.require_subcommand(1);
    add_commands(command, kCommandsOfControl);
    for (const ControlWord& word : kControlWords) {
      if (may_be_meant(word.verb)) add_control_word(*command.add_subcommand(word.verb, word.help), word);
    }
  }

  void add_control_word(CLI::App& command, const ControlWord& word) {
    if (word.operand != nullptr) command.add_option(word.operand, control.operands, word.operand_help);
    command.fallthrough();
    command.callback([this, verb = word.verb] {
      control.verb = verb;
      chosen = [this] { return understudy::emulator::command_line::control(control); };
    });
    if (std::string_view(word.verb) == "scope") {
      command
          .add_option("--trace", control.trace,
                      "Write the recorded values to this file: FILE.csv, for `plot`")
          ->check(kNotEmpty);
    }
    if (std::string_view(word.verb) == "coverage") {
      control.version = UNDERSTUDY_VERSION;
      command.add_option("-o,--output", control.output, kCoverageHelp)->check(kNotEmpty);
    }
    if (std::string_view(word.verb) != "run-until") return;
    command.add_option("--within", control.within, "Give up after this much simulated time")
        ->capture_default_str();
  }

  void add_dap(CLI::App& command) {
    command
        .add_option("--listen", dap.listen,
                    "Serve clients at this address, HOST:PORT, one at a time [standard input and output]")
        ->check(kNotEmpty);
    command.callback([this] { chosen = [this] { return serve_debug_adapter(dap); }; });
  }

  void add_page(CLI::App& command) {
    add_page_flags(command, page);
    command.callback([this] { chosen = [this] { return show_page(page); }; });
  }

  void add_poll(CLI::App& command) {
    add_poll_flags(command, poll);
    command.callback([this] { chosen = [this] { return poll_port(models, poll); }; });
  }

  void add_photograph(CLI::App& command) {
    add_photograph_flags(command, photograph);
    command.callback([this] { chosen = [this] { return take_photograph(models, photograph); }; });
  }

  void add_probe(CLI::App& command) {
    add_probe_flags(command, probe);
    command.callback([this] { chosen = [this] { return probe_box(models, probe); }; });
  }

  void add_compare(CLI::App& command) {
    add_compare_flags(command, compare);
    add_compare_looks(command, compare);
    command.callback([this] {
      compare.version = UNDERSTUDY_VERSION;
      chosen = [this] { return compare_captures(models, compare); };
    });
  }

  void add_calibrate(CLI::App& command) {
    add_calibrate_flags(command, calibrate);
    command.callback([this] { chosen = [this] { return calibrate_bench(models, calibrate); }; });
  }

  void add_certificate(CLI::App& command) {
    add_certificate_flags(command, certificate);
    command.callback([this] {
      certificate.version = UNDERSTUDY_VERSION;
      chosen = [this] { return certify_evidence(models, certificate); };
    });
  }

  void add_tap(CLI::App& command) {
    add_tap_flags(command, tap);
    command.callback([this] { chosen = [this] { return tap_line(tap); }; });
  }

  void add_coverage_sum(CLI::App& command) {
    command.add_option("FILE", coverage.files, "Files that --coverage has written: FILE.info")->required();
    command.add_option("-o,--output", coverage.output, kCoverageHelp)->check(kNotEmpty);
    command.add_option("--coverage-min", coverage.min_percent,
                       "Fail if less than this percentage of the programs' lines has run");
    command.callback([this] {
      coverage.version = UNDERSTUDY_VERSION;
      chosen = [this] { return add_coverage(coverage); };
    });
  }

  void add_plot(CLI::App& command) {
    add_plot_flags(command, plot);
    command.callback([this] { chosen = [this] { return plot_trace(plot); }; });
  }

  void add_program_text(CLI::App& command, const char* file_help) {
    program.model = "simple2-r3";
    command.add_option("FILE", program.file, file_help)->required();
    command.add_option("--model", program.model, "Model that runs the program")->capture_default_str();
    add_firmware_and_choices(command, program);
  }

  void add_asm(CLI::App& command) {
    add_program_text(command, "A program listing");
    command.callback([this] { chosen = [this] { return assemble_program(models, program); }; });
  }

  void add_disasm(CLI::App& command) {
    add_program_text(command, "Lines of numbers, as `asm` prints them");
    command.callback([this] { chosen = [this] { return disassemble_program(models, program); }; });
  }

  void add_check(CLI::App& command) {
    add_check_flags(command, check);
    command.callback([this] { chosen = [this] { return check_files(models, check); }; });
  }

  void add_schema(CLI::App& command) {
    command.add_option("WHAT", schema.what, "bench, scenario or model")->required();
    command.add_option("--bench", schema.bench, "Allow only the names of this bench in scenarios [any name]")
        ->check(kNotEmpty);
    command.callback([this] { chosen = [this] { return print_schema(models, schema); }; });
  }

  void add_init(CLI::App& command) {
    command.add_option("DIR", init.folder, "Folder to write the files to")
        ->check(kNotEmpty)
        ->capture_default_str();
    command.add_option("--model", init.model, "A name from `understudy models`")
        ->check(kNotEmpty)
        ->capture_default_str();
    command.callback([this] { chosen = [this] { return write_first_files(models, init); }; });
  }

  void add_import(CLI::App& command) {
    add_import_flags(command, import);
    command.callback([this] { chosen = [this] { return import_registers(models, import); }; });
  }

  void add_completion(CLI::App& command) {
    command.add_option("SHELL", shell, "bash, zsh or fish")->required();
    command.callback([this] {
      chosen = [this] {
        return print_completion(words_of(CommandLine(models, std::nullopt).app), shell, models);
      };
    });
  }
};

// `--help` lists the commands in this order.
const std::vector<CommandLine::Command> CommandLine::kCommands{
    {"models", "List the models", &CommandLine::add_models},
    {"describe", "Print a model's tables", &CommandLine::add_describe},
    {"serve", "Emulate the devices of a bench, in the foreground", &CommandLine::add_serve},
    {"exec", "Run a command against a bench, or in each case of a scenario: exec FILE -- COMMAND",
     &CommandLine::add_exec},
    {"run", "Run scenarios in simulated time", &CommandLine::add_run},
    {"hunt",
     "Search for disturbances that break a scenario, or a command that runs with it (hunt FILE -- COMMAND), "
     "and reduce each finding to the fewest disturbances",
     &CommandLine::add_hunt},
    {"coverage", "Add the coverage of several runs", &CommandLine::add_coverage_sum},
    {"replay", "Replay a recording and compare every byte", &CommandLine::add_replay},
    {"ctl", "Inspect and control a running `serve`", &CommandLine::add_control},
    {"page", "Show running benches in a browser", &CommandLine::add_page},
    {"dap", "Debug controllers' programs from an editor (Debug Adapter Protocol)", &CommandLine::add_dap},
    {"poll", "Read and write registers: a small Modbus master", &CommandLine::add_poll},
    {"photograph", "Read everything that a real controller reports, and write an NV image",
     &CommandLine::add_photograph},
    {"probe", "Play the proofs of choices on a real controller, to find out which options it follows",
     &CommandLine::add_probe},
    {"compare", "Compare the replies of a real controller with those of a bench", &CommandLine::add_compare},
    {"calibrate", "Find the choices with which a bench replies like a real controller",
     &CommandLine::add_calibrate},
    {"certificate", "Make a certificate of measurements on a real controller, or verify one",
     &CommandLine::add_certificate},
    {"tap", "Listen on a line with one or two adapters, and write a capture", &CommandLine::add_tap},
    {"plot", "Draw a trace with gnuplot", &CommandLine::add_plot},
    {"asm", "Convert a program listing to the numbers that are sent over the wire", &CommandLine::add_asm},
    {"disasm", "Convert a program's numbers back to a listing", &CommandLine::add_disasm},
    {"check", "Validate benches, scenarios, models and programs without running them",
     &CommandLine::add_check},
    {"schema", "Print the JSON Schema of a file format, for editors", &CommandLine::add_schema},
    {"init", "Write a first bench and scenario, with their schemas", &CommandLine::add_init},
    {"import", "Make a model file from a list of registers", &CommandLine::add_import},
    {"tty-shim", "Print the path of the library that --tty-shim preloads", &CommandLine::add_tty_shim},
    {"completion", "Print a completion script for a shell", &CommandLine::add_completion},
};
const std::array<CommandLine::Command, 3> CommandLine::kCommandsOfControl{{
    {"watch", "Show a live table of everything that moves, until Ctrl-C", &CommandLine::add_watch},
    {"frames", "Show the traffic on the lines in words, until Ctrl-C", &CommandLine::add_frames},
    {"daemons", "List the running daemons: control socket, bench, ports", &CommandLine::add_daemons},
}};

}  // namespace

std::function<int()> parse_command_line(int argc, char** argv, ModelList models) {
  // The words of a command that `exec` runs are never parsed as flags of this program.
  char** const end = argv + argc;
  char** own_end = end;
  std::vector<std::string> of_others;
  const std::string_view verb = argc > 1 ? argv[1] : "";
  if (verb == "exec" || verb == "hunt") {
    own_end = std::find_if(argv, end, [](const char* word) { return std::string_view(word) == "--"; });
    if (own_end != end) of_others.assign(own_end + 1, end);
  }
  argc = static_cast<int>(own_end - argv);
  const auto make_line = [&](std::optional<CommandLine::Words> among) {
    auto line = std::make_shared<CommandLine>(models, among);
    line->exec.host.command = of_others;
    line->hunt.host = {.command = of_others, .host_time = true};
    return line;
  };
  const auto parsed = [&](const std::shared_ptr<CommandLine>& line) -> std::function<int()> {
    line->app.parse(argc, argv);
    return [line] { return line->chosen(); };
  };
  const auto few = make_line(CommandLine::Words(argv, own_end));
  try {
    return parsed(few);
  } catch (const CLI::CallForVersion& version) {
    few->app.exit(version);
    return [] { return int{kExitWell}; };
  } catch (const CLI::ParseError&) {
    // The complete parser below reports the error.
  }
  const auto whole = make_line(std::nullopt);
  int code = kExitBadInput;
  try {
    return parsed(whole);
  } catch (const CLI::Success& help) {
    whole->app.exit(help);
    code = kExitWell;
  } catch (const CLI::ParseError& error) {
    const std::string diagnostic = diagnostic_about(whole->app, error, argc, argv);
    std::fprintf(stderr, "understudy: %s\n", one_line(diagnostic).c_str());
  }
  return [code] { return code; };
}

}  // namespace understudy::emulator::command_line
