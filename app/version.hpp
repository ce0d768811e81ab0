#pragma once

namespace cnem::app {

/// Version and commit of the source that was built: "0.2.0 (3bd46cb)"; without a git checkout "0.2.0".
const char* version();

} // namespace cnem::app
