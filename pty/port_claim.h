// Says of a pseudo-terminal, for as long as we serve it, that it is served: so that its link is not taken
// for a stale one. An abstract Unix socket carries its name; the kernel takes it away with the process, and
// no file is left anywhere.
#pragma once

#include <string>

#include "pty/descriptor.h"

namespace understudy::pty {

/// Claims `terminal` ("/dev/pts/3") until the descriptor closes. An empty one: it is claimed already.
Descriptor claim_port(const std::string& terminal);

/// Whether somebody serves it now.
bool is_port_claimed(const std::string& terminal);

}  // namespace understudy::pty
