#pragma once

namespace cnem::app {

/// `git describe` of the source that was built.
const char* version();

} // namespace cnem::app
