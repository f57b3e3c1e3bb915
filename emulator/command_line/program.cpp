#include "emulator/command_line/program.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>

#include "base/files/growing_file.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/flags.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/page/web.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/ports/tty_shim.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/recording/recording.h"
#include "pty/capture_file.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

int report(const std::exception& error, int code) {
  std::fprintf(stderr, "understudy: %s\n", one_line(error.what()).c_str());
  return code;
}

/// Opens closed standard descriptors. Otherwise a port could get such a descriptor, and printed text would be
/// sent to the port. Standard output is opened for reading, so that printing still fails.
void open_standard_descriptors() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    if (open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_RDWR) < 0) return;
  }
}

/// Makes a write beyond the file size limit fail with an error, instead of a signal that ends the program. A
/// handler is used because child programs do not inherit it, whereas they would inherit an ignored signal.
void survive_file_size_limits() {
  struct sigaction before = {};
  if (sigaction(SIGXFSZ, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) return;
  struct sigaction action = {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;
  sigaction(SIGXFSZ, &action, nullptr);
}

}  // namespace

int run_program(int argc, char** argv, ModelList models) {
  open_standard_descriptors();
  survive_file_size_limits();
  try {
    const int code = parse_command_line(argc, argv, models)();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    return report(std::runtime_error("standard output cannot be written"), kExitNoResource);
  } catch (const world::BenchError& error) {
    // The message begins with the file's name and line, as editors expect.
    std::fprintf(stderr, "%s\n", error.what());
    return kExitBadInput;
  } catch (const UsageError& error) {
    return report(error, kExitBadInput);
  } catch (const SettingError& error) {
    return report(error, kExitBadInput);
  } catch (const NvError& error) {
    std::fprintf(stderr, "%s\n", one_line(error.what()).c_str());  // the message begins with the file's name
    return kExitBadInput;
  } catch (const serve::NoTtyShim& error) {
    return report(error, kExitNoResource);
  } catch (const understudy::pty::PortError& error) {
    return report(error, kExitNoResource);
  } catch (const serve::ControlError& error) {
    return report(error, kExitNoResource);
  } catch (const page::WebError& error) {
    return report(error, kExitNoResource);
  } catch (const world::RecordingError& error) {
    std::fprintf(stderr, "%s\n", one_line(error.what()).c_str());
    return kExitBadInput;
  } catch (const GrowingFileError& error) {
    return report(error, kExitNoResource);
  } catch (const understudy::pty::CaptureError& error) {
    return report(error, kExitNoResource);
  } catch (const std::system_error& error) {
    return report(error, kExitNoResource);
  } catch (const std::exception& error) {
    return report(error, kExitInternal);
  }
}

}  // namespace understudy::emulator::command_line
