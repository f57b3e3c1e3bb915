#include "emulator/serve/host_time/host_greetings.h"

#include <utility>

#include "pty/host_time/protocol.h"

namespace understudy::emulator::serve {

void HostGreetings::on_message(const host_time::Message& message) {
  using host_time::MessageKind;
  const int process = message.process;
  switch (message.what) {
    case MessageKind::hello:
      if (first_process_ < 0) {
        first_process_ = process;
        ++owed_[process];  // this program was not announced
      }
      if (message.value != 0) --owed_[process];
      return;
    case MessageKind::child:
      if (message.value != 0) ++owed_[process];
      return;
    case MessageKind::leaves: ++owed_[process]; return;
    case MessageKind::stays: --owed_[process]; return;
    case MessageKind::wait: has_waited_ = true; return;
    case MessageKind::cancel:
    case MessageKind::outside:
    case MessageKind::inside:
    case MessageKind::timer:
    case MessageKind::watch:
    case MessageKind::go:
    case MessageKind::cancelled: return;
  }
}

bool HostGreetings::is_silent(int process) const {
  const auto owed = owed_.find(process);
  return owed != owed_.end() && owed->second > 0;
}

bool HostGreetings::silent_one_ended(int process) {
  owed_[process] = 0;
  if (process != first_process_) return !std::exchange(has_silence_, true);
  is_first_silent_ = true;
  return false;
}

}  // namespace understudy::emulator::serve
