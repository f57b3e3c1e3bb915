// Declares the commands of `understudy`, independently of flag parsing. Each command returns the exit code.
// Commands that need models receive a list of them.
#pragma once

#include <climits>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

enum ExitCode : int {
  kExitWell = 0,
  kExitFailed = 1,      // a scenario or replay failed; a poll was refused or got no answer
  kExitBadInput = 2,    // mistakes in usage, files or configuration
  kExitNoResource = 3,  // a port, socket or capture could not be opened
  kExitInternal = 4,
};

/// Reports bad usage in one line with the flag or value and the expected input.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

int list_models(ModelList models);

struct DescribeArguments {
  std::string model;
  std::string what;
  std::string format = "table";
  std::vector<std::string> evidence;  // files with measurements, written by `calibrate`
};
int describe_model(ModelList models, const DescribeArguments& arguments);

struct ServeArguments {
  std::string bench;  // a file; if empty, `model` and its settings are used
  std::string model;
  std::optional<int> station;
  std::optional<int> modules;
  std::string firmware;
  std::optional<int> baud;
  std::string link;
  std::string links;  // the folder for links in the bench that have a relative path or no path
  std::string group;
  std::string timing;
  bool strict_framing = false;
  bool ignore_baud = false;
  std::string baud_tolerance;
  std::string byte_timeout;
  std::string speed = "real";
  std::string control;
  std::string nv;  // the folder for memories of devices without their own file
  std::string capture;
  std::string record;
  std::string trace;  // a file: .csv or .vcd
  std::vector<std::string> trace_also;
  std::string coverage;         // a file: .info, .xml or .html
  std::string device_coverage;  // a file: .json or .html
  bool lint = false;
  std::vector<std::string> listen;  // TCP addresses of lines
  bool no_pty = false;              // these lines have no pseudo-terminal
  std::optional<int> page;          // the port of the bench's live page; 0: any
  std::string version;              // the version of this program
};
int serve(ModelList models, const ServeArguments& arguments);

/// The command of `exec`: a host program.
struct HostArguments {
  std::vector<std::string> command;  // the words after --: the command and its arguments
  std::vector<std::pair<std::string, std::string>> environment{};  // in addition to our own
  bool tty_shim = false;
  bool host_time = false;  // the command runs in simulated time
};
/// A stage with real controllers.
struct OnArguments {
  std::vector<std::string> on;  // LINE=PORT; empty: the controllers are simulated
  bool allow_writes = false;
  bool allow_memory = false;
  bool allow_outputs = false;
  bool allow_motion = false;
  std::string envelope;  // a file with limits
  std::string rig;       // a command
  bool ask = false;
  bool plan = false;
  std::string timeout = "300ms";  // the longest wait for a reply
};

struct RunArguments {
  std::vector<std::string> scenarios;  // files
  bool real_time = false;
  std::string junit;
  std::string report;
  std::string record;  // folders, each of which receives a file for each scenario
  std::string trace;
  std::vector<std::string> trace_also;
  std::string capture;
  std::string save_below;  // the folder in which scenarios may save; empty: their own folders
  bool lint = false;
  bool hash = false;
  std::optional<int> jobs;  // empty: one for each core
  std::string shard;        // "1/4"
  std::optional<std::uint64_t> seed;
  std::string filter;                // a pattern for names, or the identity of a case
  std::vector<std::string> results;  // files with a row for each case
  bool resume = false;
  std::string failures;                // the folder for recordings of failures; empty: below /tmp
  std::string coverage;                // a file
  std::optional<double> coverage_min;  // per cent of the lines
  std::string device_coverage;         // a file
  HostArguments host{};                // a command that runs beside each scenario, if it has words
  OnArguments on{};
  bool dialogue = false;  // accepts further steps from standard input
  std::string timeout;    // a duration: the time limit for the command
  std::string version;    // the version of this program
};
int run_scenarios(ModelList models, const RunArguments& arguments);

struct ProbeArguments {
  std::string port;
  std::string model;
  std::string output;    // the evidence
  std::string box;       // the controller's name in the evidence
  std::string proofs;    // a folder; empty: the folder installed with the program
  std::string firmware;  // empty: the newest version
  std::optional<int> station{};
  int modules = 1;   // of a chain
  OnArguments on{};  // its `on` is not used
};
/// Plays the proofs of choices on a real controller.
int probe_box(ModelList models, const ProbeArguments& arguments);

struct HuntArguments {
  std::string scenario;  // a file with `hunt`
  std::string time;      // a duration in real time; empty: one minute, unless `courses` is given
  std::optional<std::uint64_t> courses;
  std::uint64_t seed = 0;
  std::optional<int> jobs;  // empty: one for each core
  std::string shard;        // "1/4"
  bool unguided = false;    // generates every course independently of earlier ones
  bool plan = false;        // prints the disturbances without playing any course
  std::string corpus;       // a file with courses to start from
  std::string coverage;     // a file, as for `run`
  std::string device_coverage;
  std::string found = "found";  // the folder for findings
  HostArguments host;           // the command beside which courses are played; may be empty
  std::string timeout = "10s";  // in real time: the time limit for the command in a course
  std::string version;          // the version of this program
};
/// Searches for disturbances that break a scenario.
int hunt_scenario(ModelList models, const HuntArguments& arguments);

struct ExecArguments {
  ServeArguments serve;
  HostArguments host;
  std::vector<std::string> stray_words;  // the words before --
  std::string with;                      // the file of a scenario that runs beside the command
  std::string save_below;                // the folder in which the scenario may save; empty: its own folder
  bool has_speed = false;                // --speed was given
  std::optional<int> repeat;             // how often the command runs; its recordings are compared
  std::string timeout;                   // a duration
  RunArguments cases;                    // the flags for a scenario whose cases run beside the command
};
/// Returns the command's exit code if there is one.
int execute(ModelList models, const ExecArguments& arguments);
/// Prints the path of the library that `exec --tty-shim` preloads.
int print_tty_shim();

struct CoverageArguments {
  std::vector<std::string> files;  // tracefiles
  std::string output;              // a file: .info, .xml or .html; empty: none
  std::optional<double> min_percent;
  std::string version;  // the version of this program
};
/// Adds the coverage of several runs.
int add_coverage(const CoverageArguments& arguments);

struct ReplayArguments {
  std::string recording;
  std::string until;  // a duration; `control` starts at that moment
  std::string control;
  std::string trace;  // files, like those of `serve` and `run`
  std::vector<std::string> trace_also;
  std::string capture;
  std::string report;
  std::optional<int> page;  // the port of the recording's live page; 0: any
  bool serve = false;       // serves the whole recording, without a page
  std::string story;        // an HTML file for the recording's page
  std::string picture;      // an SVG or PNG file for a panel of that page
  std::string panel;        // the panel; empty: the timeline
  std::string at;           // a duration: the moment that the page or picture first shows
  std::string version;      // the version of this program
};
int replay_recording(ModelList models, const ReplayArguments& arguments);

struct PlotArguments {
  std::string trace;   // a file written by --trace
  std::string output;  // .png or .svg; empty: next to the trace
  std::vector<std::string> also;
};
int plot_trace(const PlotArguments& arguments);

/// Selects one of the running daemons. If all fields are empty, there must be only one daemon.
struct WhichDaemon {
  std::string socket;  // its control socket
  std::string bench;   // the bench file that it serves
  std::string port;    // one of its ports, or a link to a port
};

struct ControlArguments {
  WhichDaemon which;
  bool json = false;
  std::string verb;
  std::vector<std::string> operands;
  std::string within = "1h";  // simulated time, for `run-until`
  std::string trace;          // FILE.csv, for `scope`
  std::string output;         // FILE.info, .xml or .html, for `coverage`
  std::string version;        // the version of this program
};
int control(const ControlArguments& arguments);

struct WatchArguments {
  WhichDaemon which;
  std::vector<std::string> names;  // empty: everything is shown
  std::string every = "200ms";     // wall time
  int times = 0;                   // 0: until Ctrl-C
};
int watch(const WatchArguments& arguments);

struct FramesArguments {
  WhichDaemon which;
  bool json = false;
  int last = 10;  // number of earlier frames that are printed first
  bool once = false;
  std::string every = "100ms";  // wall time
  int times = 0;                // 0: until Ctrl-C
};
/// Prints a line for each frame on the lines.
int follow_frames(const FramesArguments& arguments);

struct PageArguments {
  std::vector<std::string> sockets;  // control sockets; empty: those of all running daemons
  int port = 0;                      // 0: any port
  std::string listen = "127.0.0.1";
  std::vector<std::string> hosts;  // names of this machine in addition to the loopback names
  bool read_only = false;
  std::string folder;  // a folder with files for the page, instead of the built-in files
};
/// Serves the live page until a signal ends it.
int show_page(const PageArguments& arguments);
/// Throws UsageError if the port is not a TCP port. `flag` is the command and its flag, such as "serve:
/// --page".
void require_page_port(const std::string& flag, int port);
/// Serves the page like show_page(), in a separate process that ends with this one.
void start_page_beside(const std::string& control, int port);

struct DapArguments {
  std::string listen;  // "127.0.0.1:4711"; empty: standard input and output
};
/// Serves editors with the Debug Adapter Protocol (docs/debugging.md).
int serve_debug_adapter(const DapArguments& arguments);

struct PollArguments {
  std::string port;
  // Unset or empty settings have the model's factory values; without a model, station 1 at 19200 8E1.
  static constexpr int kUnsaid = INT_MIN;
  int station = kUnsaid;
  int baud = kUnsaid;
  std::string parity;
  int stop_bits = kUnsaid;
  std::string model;
  int function = 3;
  std::string type = "u16";
  std::string word_order;  // "low" or "high" first; empty: the order of the model, or of the device
  std::string timeout = "1s";
  std::string every;
  int times = 1;
  std::vector<std::string> commands;  // names of commands to send before the items
  std::vector<std::string> items;
};
int poll_port(ModelList models, const PollArguments& arguments);

struct PhotographArguments {
  std::string port;  // "/dev/ttyUSB0,19200,8E1", "rtu://HOST:PORT"
  std::string model;
  std::string firmware;  // empty: the newest
  std::optional<int> station;
  std::optional<int> modules;
  std::string output;  // BOX.nv.json; the photograph itself is written to BOX.photo.json
  std::string timeout = "300ms";
  bool arrays = false;
};
/// Reads all readable data of a real controller into an NV image and a photograph.
int take_photograph(ModelList models, const PhotographArguments& arguments);

struct CompareArguments {
  std::vector<std::string> captures;  // files
  std::string bench;
  std::string line;  // the line in the bench and the captures; empty: the only line
  std::string from;  // an NV image with the controller's memory at the beginning of the captures
  std::string tolerance = "1ms";
  bool power_up = false;        // the captures begin at power-up
  std::string pattern;          // the format of a log's lines; empty: a built-in format
  std::string every;            // the time between requests in a log without times
  std::string inputs;           // a file with the levels of the inputs
  double sample_rate = 0;       // samples per second, for a log that counts samples; 0: not given
  std::string format = "text";  // text, json, sarif or github
  std::string report;           // the file for the page; empty: no page
  bool follow = false;          // follows a capture that is still being written
  std::string version;          // the version of this program
};
/// Plays captures of a real controller against a bench, and judges each reply.
int compare_captures(ModelList models, const CompareArguments& arguments);

struct CalibrateArguments {
  CompareArguments compare;
  std::string output;    // a file; empty: none
  std::string box;       // the controller's name in the evidence
  bool choices = false;  // prints the choices in the format of a bench file
};
/// Finds the options of choices with which a bench replies as in the captures.
int calibrate_bench(ModelList models, const CalibrateArguments& arguments);

struct CertificateArguments {
  std::vector<std::string> evidence;  // files; with `verify`: one certificate
  std::string output;                 // FILE.json; the page is FILE.html next to it
  std::string box;                    // the controller's name, if the evidence does not contain it
  bool verify = false;
  std::string signers;  // a file of trusted keys, in the format of ssh-keygen
  std::string version;  // the version of this program
};
/// Creates a certificate for evidence, or verifies a certificate.
int certify_evidence(ModelList models, const CertificateArguments& arguments);

struct TapArguments {
  std::vector<std::string> ports;  // one or two
  std::string output;              // a capture
  std::string line = "line";       // the name of the line in the capture
};
/// Listens on a line until Ctrl-C. Never sends anything.
int tap_line(const TapArguments& arguments);

/// A file with a program, and the settings for reading it.
struct ProgramTextArguments {
  std::string model;
  std::string firmware;              // empty: the newest version
  std::vector<std::string> choices;  // choices such as "ID=OPTION"
  std::string file;
};
/// Convert a program to the numbers that are transmitted, and back (emulator/device/program_cells.h).
int assemble_program(ModelList models, const ProgramTextArguments& arguments);
int disassemble_program(ModelList models, const ProgramTextArguments& arguments);

struct CheckArguments {
  std::vector<std::string> files;  // files and folders
  std::string save_below;          // the folder in which scenarios may save; empty: their own folders
  ProgramTextArguments programs;   // if this contains a model, the files are programs for that model
  std::string format = "text";     // text, json, sarif or github
};
/// Checks benches, scenarios, included step files, models, and programs.
int check_files(ModelList models, const CheckArguments& arguments);
struct InitArguments {
  std::string model = "simple2-r3";
  std::string folder = ".";
};
/// Writes a bench and a scenario for the chosen model, with their schemas.
int write_first_files(ModelList models, const InitArguments& arguments);
struct ImportArguments {
  std::string list;    // a file
  std::string output;  // the model file; empty: next to the list
  std::string name;    // the model's name; empty: derived from the list's name
  // Settings for reading the list; empty: detected automatically.
  std::string columns;
  std::string addresses;
  std::string table;
  std::string encoding;
};
/// Writes a model file and a bench for a list of registers.
int import_registers(ModelList models, const ImportArguments& arguments);
struct SchemaArguments {
  std::string what;   // "bench", "scenario" or "model"
  std::string bench;  // the bench whose names are allowed in scenarios; empty: all names are allowed
};
/// Prints the JSON Schema of a kind of file.
int print_schema(ModelList models, const SchemaArguments& arguments);

}  // namespace understudy::emulator::command_line
