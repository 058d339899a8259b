// Writing a file whole or not at all, for every output of the project.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace penumbra {

/// Opens a temporary file in the folder of `path`, calls `write` with it, flushes it and renames it to
/// `path`. A file that is there keeps its permissions; a link goes on naming its target, which is written
/// whether it is there or not. The path "-" is standard output. A special file that is there (/dev/null, a
/// pipe) is written to directly. Where something fails the temporary file is removed. Throws SystemError,
/// which says what could not be written and why, and whatever `write` throws.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// The path that write_file replaces: `path`, or what it names where it is a link.
std::filesystem::path written_path(const std::filesystem::path& path);

/// Removes the temporary files of writes under way. For handlers of signals that end the program: calls
/// nothing that such a handler must not call.
void remove_unfinished_files() noexcept;

}  // namespace penumbra
