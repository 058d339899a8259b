// Writing a file whole or not at all, for every output of the project.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace penumbra {

/// Opens a temporary beside `path`, calls `write` with it, flushes and renames it to `path`; an existing file
/// keeps its permissions, and a link goes on naming it. On any failure the temporary is removed and
/// SystemError says what could not be written and why; what `write` itself throws passes through. The path
/// "-" writes to standard output. An existing special file (/dev/null, a pipe) is written to directly.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace penumbra
