#include "mesh/io/write_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <string>
#include <system_error>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using WriteCallback = std::function<void(std::ostream&)>;

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
  throw SystemError(name + ": cannot be written: " + reason +
                    "; check the folder, permissions and free space");
}

std::string last_reason() {
  return errno != 0 ? std::generic_category().message(errno) : std::string("output failed");
}

void write_stream(std::ostream& out, const std::string& name, const WriteCallback& write) {
  errno = 0;
  try {
    write(out);
  } catch (const std::ios_base::failure&) {  // where the callback made the stream throw
    fail(name, last_reason());
  }
  if (!out.flush()) {
    fail(name, last_reason());
  }
}

void write_directly(const fs::path& path, const WriteCallback& write) {
  errno = 0;
  std::ofstream out(path, std::ios::binary);
  if (!out) {
    fail(path.string(), last_reason());
  }
  write_stream(out, path.string(), write);
}

/// A file that is removed unless it was renamed to its final name.
class Temporary {
 public:
  explicit Temporary(const fs::path& final_path) : final_path_(final_path) {
    static std::atomic<unsigned> count = 0;
    std::string name = ".";
    name.append(final_path.filename().string()).append(".").append(std::to_string(::getpid()));
    name.append("-").append(std::to_string(count++)).append(".tmp");
    path_ = final_path.parent_path() / name;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!kept_) {
      std::error_code ignored;
      fs::remove(path_, ignored);
    }
  }

  const fs::path& path() const { return path_; }
  void keep(const std::string& name) {
    std::error_code error;
    fs::rename(path_, final_path_, error);
    if (error) {
      fail(name, error.message());
    }
    kept_ = true;
  }

 private:
  fs::path final_path_, path_;
  bool kept_ = false;
};

void write_and_rename(const fs::path& path, bool exists, const WriteCallback& write) {
  const std::string name = path.string();
  if (exists && ::access(path.c_str(), W_OK) != 0) {  // rename would replace a read-only file
    fail(name, last_reason());
  }
  Temporary temporary(path);
  errno = 0;
  std::ofstream out(temporary.path(), std::ios::binary | std::ios::trunc);
  if (!out) {
    fail(name, last_reason());
  }
  write_stream(out, name, write);
  errno = 0;
  out.close();
  if (!out) {
    fail(name, last_reason());
  }
  if (exists) {
    std::error_code ignored;
    fs::permissions(temporary.path(), fs::status(path, ignored).permissions(), ignored);
  }
  temporary.keep(name);
}

}  // namespace

void write_file(const fs::path& path, const WriteCallback& write) {
  if (path == "-") {
    write_stream(std::cout, "standard output", write);
    return;
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  switch (status.type()) {
    case fs::file_type::directory:
      fail(path.string(), "it is a folder");
    case fs::file_type::not_found:
      if (path.filename().empty()) {
        fail(path.string().empty() ? "output" : path.string(), "no file name given");
      }
      return write_and_rename(path, false, write);
    case fs::file_type::regular: {
      const fs::path target = fs::canonical(path, error);  // replace what a link names, not the link
      return write_and_rename(error ? path : target, true, write);
    }
    case fs::file_type::none:
      fail(path.string(), error.message());
    default:
      return write_directly(path, write);
  }
}

}  // namespace penumbra
