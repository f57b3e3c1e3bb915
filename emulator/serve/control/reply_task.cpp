#include "emulator/serve/control/reply_task.h"

#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

bool Pause::await_ready() const { return !daemon_.loop().slice_is_over(); }

}  // namespace understudy::emulator::serve
