// Implements `understudy plot`: draws a trace with gnuplot.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/play/plot/plot_script.h"
#include "emulator/play/plot/trace_table.h"
#include "emulator/serve/ports/private_folder.h"

namespace understudy::emulator::command_line {

namespace {

/// The working folder of gnuplot. It is removed with its contents.
class WorkFolder {
 public:
  ~WorkFolder() {
    std::error_code ignored;
    for (const std::string& file : {script(), picture(), diagnostics()})
      std::filesystem::remove(file, ignored);
  }
  std::string script() { return folder_.path() + "/script"; }
  std::string picture() { return folder_.path() + "/picture"; }
  std::string diagnostics() { return folder_.path() + "/diagnostics"; }

 private:
  serve::PrivateFolder folder_;
};

[[noreturn]] void throw_error(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

void require_written(const std::string& what, const std::string& why_not) {
  if (!why_not.empty()) throw GrowingFileError(what + " cannot be written: " + why_not);
}

/// Runs gnuplot and returns its exit code. Its output goes to a file.
int run_gnuplot(WorkFolder& folder) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, folder.diagnostics().c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string program = "gnuplot";
  std::string no_defaults = "-d";
  std::string script = folder.script();
  char* const words[] = {program.data(), no_defaults.data(), script.data(), nullptr};
  pid_t child = -1;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw_error(error, "plot: gnuplot cannot be started (the Debian package is gnuplot-nox)");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Returns the most useful line of gnuplot's output: the last line that contains words.
std::string diagnostic_in(const std::string& text) {
  std::string diagnostic = "it printed nothing";
  for (const TextLine line : TextLines(text)) {
    if (line.text.find_first_not_of(" \t^") != std::string_view::npos) diagnostic = line.text;
  }
  return diagnostic;
}

}  // namespace

int plot_trace(const PlotArguments& arguments) {
  std::filesystem::path output = arguments.output;
  if (output.empty()) output = std::filesystem::path(arguments.trace).replace_extension(".png");
  const bool is_svg = output.extension() == ".svg";
  if (!is_svg && output.extension() != ".png") {
    throw UsageError("--output: " + output.string() +
                     ": has an unknown format; expected FILE.png or FILE.svg");
  }
  FileClaims claims;
  claims.add({arguments.trace, "the trace itself"});
  require_output(claims, "--output", output.string());
  const play::TraceTable table = play::read_trace(arguments.trace);
  WorkFolder folder;
  const std::string script =
      play::plot_script(table, arguments.also, is_svg ? play::PlotFormat::svg : play::PlotFormat::png,
                        folder.picture(), arguments.trace);
  require_written("plot: " + folder.script(), replace_text_file(folder.script(), script, ContentKind::other));
  const int code = run_gnuplot(folder);
  const auto picture = read_text_file(folder.picture());
  if (code != 0 || !picture || picture->empty()) {
    const std::string messages = read_text_file(folder.diagnostics()).value_or("");
    std::fprintf(stderr, "understudy: plot: gnuplot did not make a picture: %s\n",
                 one_line(diagnostic_in(messages)).c_str());
    return kExitNoResource;
  }
  require_written("--output: " + output.string(),
                  replace_text_file(output.string(), *picture, ContentKind::picture));
  std::printf("%s\n", output.c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
