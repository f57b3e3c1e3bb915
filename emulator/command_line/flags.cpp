// This file and app_words.cpp are the only ones that include CLI11: it is slow to compile.
#include "emulator/command_line/flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/command_line/app_words.h"
#include "emulator/command_line/choose_daemon.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/completion.h"
#include "emulator/command_line/ctl_words.h"
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
  ReplayArguments replay;
  ControlArguments control;
  WatchArguments watched;
  FramesArguments frames;
  PageArguments page;
  PollArguments poll;
  PlotArguments plot;
  ProgramTextArguments program;
  CheckArguments check;
  InitArguments init;
  ImportArguments import;
  SchemaArguments schema;
  std::string shell;
  std::function<int()> chosen;

  explicit CommandLine(ModelList known) : models(known) {
    app.require_subcommand(1);
    app.set_version_flag("--version", UNDERSTUDY_VERSION);
    add_models();
    add_describe();
    add_serve();
    add_exec();
    add_run();
    add_replay();
    add_control();
    add_page();
    add_poll();
    add_plot();
    add_program_text();
    add_check();
    add_schema();
    add_init();
    add_import();
    add_tty_shim();
    add_completion();
  }

 private:
  void add_models() {
    app.add_subcommand("models", "List the models")->callback([this] {
      chosen = [this] { return list_models(models); };
    });
  }

  void add_describe() {
    CLI::App* command = app.add_subcommand("describe", "Print a model's tables");
    command->add_option("MODEL", describe.model, "A name from `understudy models`, or a model file")
        ->required();
    command
        ->add_option("WHAT", describe.what,
                     "registers, parameters, instructions, commands, choices, ports or blocks")
        ->required();
    command->add_option("--format", describe.format, "table, csv, json or markdown")->capture_default_str();
    command->callback([this] { chosen = [this] { return describe_model(models, describe); }; });
  }

  void add_serve() {
    CLI::App* command = app.add_subcommand("serve", "Stand in for the devices of a bench, in the foreground");
    add_serving_flags(*command, serve);
    command->add_option("--page", serve.page, "Show the bench in a browser as well, at this port [any]")
        ->expected(0, 1)
        ->default_str("0");
    command->callback(
        [this] { chosen = [this] { return understudy::emulator::command_line::serve(models, serve); }; });
  }

  static void add_save_below(CLI::App& command, std::string& folder) {
    command
        .add_option("--save-below", folder, "Let scenarios `save` below this folder [each one's own folder]")
        ->check(kNotEmpty);
  }

  void add_exec() {
    CLI::App* command =
        app.add_subcommand("exec", "Run a command with a bench to talk to: exec BENCH -- COMMAND");
    add_serving_flags(*command, exec.serve);
    command->add_option("COMMAND", exec.stray_words, "A program and its arguments, after --");
    command->add_option("--with", exec.with, "A scenario to play beside the command [none]")
        ->check(kNotEmpty);
    add_save_below(*command, exec.save_below);
    command->add_flag("--tty-shim", exec.tty_shim,
                      "Preload what lets hosts that insist on parity use a pseudo-terminal");
    command
        ->add_option("--timeout", exec.timeout, "End the command after this time, by the wall clock [never]")
        ->check(kNotEmpty);
    command->callback([this] { chosen = [this] { return execute(models, exec); }; });
  }

  void add_tty_shim() {
    CLI::App* command =
        app.add_subcommand("tty-shim", "Print the path of the library that --tty-shim preloads");
    command->callback([this] { chosen = print_tty_shim; });
  }

  void add_replay() {
    CLI::App* command = app.add_subcommand("replay", "Run a recording again and compare every byte");
    command->add_option("RECORDING", replay.recording, "A file that `serve --record` or `run` has written")
        ->required();
    command->add_option("--until", replay.until, "Stop at this simulated time and serve from there [the end]")
        ->check(kNotEmpty);
    command
        ->add_option("--control", replay.control,
                     "Path of the control socket, with --until or --page [a private one]")
        ->check(kNotEmpty);
    CLI::Option* const trace =
        command->add_option("--trace", replay.trace,
                            "Write what moved and switched to this file: FILE.csv, or FILE.vcd for GTKWave");
    CLI::Option* const trace_also = command->add_option("--trace-also", replay.trace_also, kTraceAlsoHelp);
    CLI::Option* const capture = command->add_option(
        "--capture", replay.capture,
        "Write what went over the lines to this file: FILE.pcapng for Wireshark, else a text log");
    CLI::Option* const report =
        command->add_option("--report", replay.report, "Write a page about it to this file, as HTML");
    for (CLI::Option* const file : {trace, trace_also, capture, report}) file->check(kNotEmpty);
    trace_also->delimiter(',');
    command
        ->add_option(
            "--page", replay.page,
            "Open it in a browser, to go to and fro in it, at this port [any]; with --until, at that time")
        ->expected(0, 1)
        ->default_str("0")
        ->excludes(trace, trace_also, capture, report);
    command->callback([this] {
      replay.version = UNDERSTUDY_VERSION;
      chosen = [this] { return replay_recording(models, replay); };
    });
  }

  void add_run() {
    CLI::App* command = app.add_subcommand("run", "Play scenarios, in simulated time");
    command
        ->add_option("SCENARIO", run.scenarios, "Scenario files; folders, of which all scenarios are played")
        ->required();
    command->add_flag("--real-time", run.real_time,
                      "By the wall clock, over real ports, with libmodbus as the host");
    command
        ->add_option("--junit", run.junit,
                     "Write the results to this file, as JUnit XML; - for standard output")
        ->check(kNotEmpty);
    command->add_option("--report", run.report, "Write a page about all of it to this file, as HTML")
        ->check(kNotEmpty);
    command
        ->add_option("--record", run.record,
                     "Folder for the recordings of all scenarios [those of failures, below /tmp]")
        ->check(kNotEmpty);
    command->add_option("--trace", run.trace, "Folder for a trace of each scenario, as CSV")
        ->check(kNotEmpty);
    command->add_option("--trace-also", run.trace_also, kTraceAlsoHelp)->delimiter(',')->check(kNotEmpty);
    command->add_option("--capture", run.capture, "Folder for a capture of each scenario, for Wireshark")
        ->check(kNotEmpty);
    add_save_below(*command, run.save_below);
    command->add_flag("--lint", run.lint, kLintHelp);
    command->add_flag("--hash", run.hash,
                      "Print a hash of all that each scenario's devices said and did, for comparison");
    command->add_option("--jobs", run.jobs,
                        "How many are played at a time [one for each core; in real time at least 8]");
    command->add_option("--shard", run.shard, "I/N: the I-th of all scenarios, and every N-th after it")
        ->check(kNotEmpty);
    command->add_option("--seed", run.seed, "Instead of the scenarios' own seeds")->check(kSeed);
    command
        ->add_option("--filter", run.filter,
                     "Those whose names match this pattern, such as '*move*'; or one case, by its identity")
        ->check(kNotEmpty);
    command
        ->add_option("--results", run.results,
                     "Write a row for each case to this file: FILE.jsonl or FILE.sqlite; may be given twice")
        ->allow_extra_args(false)
        ->check(kNotEmpty);
    command->add_flag("--resume", run.resume, "Leave out the cases that --results has rows of already");
    command
        ->add_option("--failures", run.failures,
                     "Folder for the recordings of failures, the first of each kind [below /tmp]")
        ->check(kNotEmpty);
    command->callback([this] {
      run.version = UNDERSTUDY_VERSION;
      chosen = [this] { return run_scenarios(models, run); };
    });
  }

  void add_watch(CLI::App& of) {
    CLI::App* command = of.add_subcommand("watch", "Show everything that moves, over and over, until Ctrl-C");
    command->add_option("NAME", watched.names, "What to show, as for get [everything]");
    command->add_option("--every", watched.every, "Time between two looks")->capture_default_str();
    command->add_option("--times", watched.times, "How many looks; 0: no end")->capture_default_str();
    command->fallthrough();
    command->callback([this] {
      watched.which = control.which;
      chosen = [this] { return watch(watched); };
    });
  }

  void add_frames(CLI::App& of) {
    CLI::App* command = of.add_subcommand("frames", "Show what goes over the lines, in words, until Ctrl-C");
    command->add_option("--last", frames.last, "How many earlier ones to show first")->capture_default_str();
    command->add_flag("--once", frames.once, "Show these, and end");
    command->add_option("--every", frames.every, "Time between two looks")->capture_default_str();
    command->add_option("--times", frames.times, "How many looks; 0: no end")->capture_default_str();
    command->fallthrough();
    command->callback([this] {
      frames.which = control.which;
      frames.json = control.json;
      chosen = [this] { return follow_frames(frames); };
    });
  }

  void add_control() {
    CLI::App* command = app.add_subcommand("ctl", "Look into a running `serve`, and act on it");
    CLI::Option* const socket =
        command
            ->add_option("--control", control.which.socket,
                         "Path of its control socket [UNDERSTUDY_CONTROL, or that of the only one]")
            ->check(kNotEmpty);
    command->add_option("--bench", control.which.bench, "The one that serves this bench file")
        ->check(kNotEmpty)
        ->excludes(socket);
    command->add_option("--port", control.which.port, "The one that has this port, or the link to it")
        ->check(kNotEmpty)
        ->excludes(socket);
    command->add_flag("--json", control.json, "Print the reply as it came: one JSON object");
    command->require_subcommand(1);
    add_watch(*command);
    add_frames(*command);
    command->add_subcommand("daemons", "List the running ones: control socket, bench, ports")
        ->fallthrough()
        ->callback([this] { chosen = [this] { return list_daemons(control.json); }; });
    const auto add = [&](const char* verb, const char* help, const char* operand, const char* operand_help) {
      CLI::App* sub = command->add_subcommand(verb, help);
      if (operand != nullptr) sub->add_option(operand, control.operands, operand_help);
      sub->fallthrough();
      sub->callback([this, verb] {
        control.verb = verb;
        chosen = [this] { return understudy::emulator::command_line::control(control); };
      });
      return sub;
    };
    for (const ControlWord& word : kControlWords) {
      CLI::App* const sub = add(word.verb, word.help, word.operand, word.operand_help);
      if (std::string_view(word.verb) == "scope") {
        sub->add_option("--trace", control.trace, "Write what was kept to this file: FILE.csv, for plot")
            ->check(kNotEmpty);
      }
      if (std::string_view(word.verb) != "run-until") continue;
      sub->add_option("--within", control.within, "Simulated time after which to give up")
          ->capture_default_str();
    }
  }

  void add_page() {
    CLI::App* command = app.add_subcommand("page", "Show running benches in a browser");
    command->add_option("--control", page.sockets, "Control sockets, one a bench [all that are running]")
        ->check(kNotEmpty)
        ->allow_extra_args(false);
    command->add_option("--port", page.port, "Its port; 0: any")->capture_default_str();
    command->add_option("--listen", page.listen, "The address to listen on")
        ->capture_default_str()
        ->check(kNotEmpty);
    command
        ->add_option("--host", page.hosts,
                     "A name by which browsers may call this machine, besides localhost")
        ->check(kNotEmpty)
        ->allow_extra_args(false);
    command->add_flag("--read-only", page.read_only, "Browsers look, and change nothing");
    command->add_option("--web", page.folder, "Take the page's files from this folder, to work on them")
        ->check(kNotEmpty);
    command->callback([this] { chosen = [this] { return show_page(page); }; });
  }

  void add_poll() {
    CLI::App* command = app.add_subcommand("poll", "A small Modbus master, for looking around");
    command->add_option("PORT", poll.port, "A serial port or a link to one")->required();
    command->add_option("ITEM", poll.items,
                        "NAME, ADDRESS or ADDRESS:COUNT to read; NAME=VALUE or ADDRESS=VALUE to write");
    command->add_option("--command", poll.commands, "A command by the model's name, sent before the items")
        ->check(kNotEmpty)
        ->allow_extra_args(false);
    command->add_option("--station", poll.station,
                        "Station to ask; without it the model's factory number, or 1");
    command->add_option("--model", poll.model, "Model whose names to use")->check(kNotEmpty);
    command
        ->add_option("--word-order", poll.word_order,
                     "low or high word first; without it as the device has it, or low without --model")
        ->check(kNotEmpty);
    command->add_option("--baud", poll.baud, "Line speed; without it the model's, or 19200");
    command->add_option("--parity", poll.parity, "even, odd or none; without it the model's, or even")
        ->check(kNotEmpty);
    command->add_option("--stop-bits", poll.stop_bits, "1 or 2; without it the model's, or 1");
    command
        ->add_option(
            "--function", poll.function,
            "What to read addresses with: 1 coils, 2 discrete inputs, 3 holding or 4 input registers")
        ->capture_default_str();
    command->add_option("--type", poll.type, "u16, s16, u32, s32 or f32 of addresses without a model's name")
        ->capture_default_str();
    command->add_option("--timeout", poll.timeout, "How long to wait for a reply")->capture_default_str();
    command->add_option("--every", poll.every, "Time between two rounds")->check(kNotEmpty);
    command->add_option("--times", poll.times, "How many rounds; 0: no end")->capture_default_str();
    command->callback([this] { chosen = [this] { return poll_port(models, poll); }; });
  }

  void add_plot() {
    CLI::App* command = app.add_subcommand("plot", "Draw a trace, with gnuplot");
    command->add_option("TRACE", plot.trace, "A file that --trace has written")->required();
    command->add_option("-o,--output", plot.output, "FILE.png or FILE.svg [beside the trace, as PNG]")
        ->check(kNotEmpty);
    command->add_option("--also", plot.also, "Columns to draw in panels of their own, such as feeder.STATUS")
        ->delimiter(',')
        ->check(kNotEmpty);
    command->callback([this] { chosen = [this] { return plot_trace(plot); }; });
  }

  static void add_firmware_and_choices(CLI::App& command, ProgramTextArguments& text) {
    command.add_option("--firmware", text.firmware, "The firmware that runs it [newest]")->check(kNotEmpty);
    command.add_option("--choice", text.choices, "Another option of a choice: ID=OPTION")->check(kNotEmpty);
  }

  void add_program_text() {
    program.model = "simple2-r3";
    CLI::App* command = app.add_subcommand("asm", "Turn a program into the numbers that go over the wire");
    command->add_option("FILE", program.file, "A listing")->required();
    command->add_option("--model", program.model, "Whose program it is")->capture_default_str();
    add_firmware_and_choices(*command, program);
    command->callback([this] { chosen = [this] { return assemble_program(models, program); }; });
    command = app.add_subcommand("disasm", "Turn the numbers of a program into its text");
    command->add_option("FILE", program.file, "Lines of numbers, as asm prints them")->required();
    command->add_option("--model", program.model, "Whose program it is")->capture_default_str();
    add_firmware_and_choices(*command, program);
    command->callback([this] { chosen = [this] { return disassemble_program(models, program); }; });
  }

  void add_check() {
    CLI::App* command =
        app.add_subcommand("check", "Validate benches, scenarios, models and programs without running them");
    command
        ->add_option("FILE", check.files,
                     "Bench, scenario and model files, and folders of them; or with --model programs")
        ->required();
    command->add_option("--model", check.programs.model, "The model whose programs the files are")
        ->check(kNotEmpty);
    add_firmware_and_choices(*command, check.programs);
    add_save_below(*command, check.save_below);
    command->add_option("--format", check.format, "text, json, sarif or github")->capture_default_str();
    command->callback([this] { chosen = [this] { return check_files(models, check); }; });
  }

  void add_schema() {
    CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of a kind of file, for editors");
    command->add_option("WHAT", schema.what, "bench, scenario or model")->required();
    command->add_option("--bench", schema.bench, "List the names of this bench for its scenarios [any name]")
        ->check(kNotEmpty);
    command->callback([this] { chosen = [this] { return print_schema(models, schema); }; });
  }

  void add_init() {
    CLI::App* command =
        app.add_subcommand("init", "Write a bench, a scenario and their schemas, to begin with");
    command->add_option("DIR", init.folder, "The folder that they are written into")
        ->check(kNotEmpty)
        ->capture_default_str();
    command->add_option("--model", init.model, "A name from `understudy models`")
        ->check(kNotEmpty)
        ->capture_default_str();
    command->callback([this] { chosen = [this] { return write_first_files(models, init); }; });
  }

  void add_import() {
    CLI::App* command =
        app.add_subcommand("import", "Make a model of one's own from a list of its registers");
    command->add_option("REGISTERS", import.list, "The list (CSV): address, name, access, width, ...")
        ->required();
    command
        ->add_option("-o,--output", import.output, "The model file to write [beside the list, as NAME.yaml]")
        ->check(kNotEmpty);
    command->add_option("--name", import.name, "What the model is called [as the list]")->check(kNotEmpty);
    command->callback([this] { chosen = [this] { return import_registers(models, import); }; });
  }

  void add_completion() {
    CLI::App* command = app.add_subcommand(
        "completion", "Print a script that makes a shell complete the words of `understudy`");
    command->add_option("SHELL", shell, "bash, zsh or fish")->required();
    command->callback([this] { chosen = [this] { return print_completion(words_of(app), shell, models); }; });
  }
};

}  // namespace

std::function<int()> parse_command_line(int argc, char** argv, ModelList models) {
  const auto line = std::make_shared<CommandLine>(models);
  // The words of `exec`'s command are its own, whatever they look like.
  char** const end = argv + argc;
  char** own_end = end;
  if (argc > 1 && std::string_view(argv[1]) == "exec") {
    own_end = std::find_if(argv, end, [](const char* word) { return std::string_view(word) == "--"; });
    if (own_end != end) line->exec.command.assign(own_end + 1, end);
  }
  argc = static_cast<int>(own_end - argv);
  int code = kExitBadInput;
  try {
    line->app.parse(argc, argv);
    return [line] { return line->chosen(); };
  } catch (const CLI::Success& help) {
    line->app.exit(help);
    code = kExitWell;
  } catch (const CLI::ParseError& error) {
    const std::string complaint = complaint_about(line->app, error, argc, argv);
    std::fprintf(stderr, "understudy: %s\n", one_line(complaint).c_str());
  }
  return [code] { return code; };
}

}  // namespace understudy::emulator::command_line
