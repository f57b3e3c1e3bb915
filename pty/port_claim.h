// Says of a port's link, for as long as we serve it, that it is served: so that another run does not take it
// for a stale one. An abstract Unix socket carries its name; the kernel takes it away with the process, and
// no file is left anywhere.
#pragma once

#include <string>

#include "pty/descriptor.h"

namespace understudy::pty {

/// Claims the link of that path until the descriptor closes. An empty one: another run serves it.
/// Throws std::system_error if that cannot be told.
Descriptor claim_link(const std::string& canonical_path);

}  // namespace understudy::pty
