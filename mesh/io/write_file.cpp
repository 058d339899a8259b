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

/// Paths of temporary files, as a signal handler may read them: they stay where they are. Of more at one time
/// than there are places the rest is not removed by remove_unfinished_files.
struct Unfinished {
  enum State : int { kFree, kClaimed, kFilled };
  std::atomic<int> state{kFree};
  char path[4096];
};
Unfinished unfinished[16];

Unfinished* remember(const std::string& path) {
  for (Unfinished& place : unfinished) {
    int free = Unfinished::kFree;
    if (path.size() >= sizeof place.path || !place.state.compare_exchange_strong(free, Unfinished::kClaimed))
      continue;
    path.copy(place.path, path.size());
    place.path[path.size()] = '\0';
    place.state = Unfinished::kFilled;
    return &place;
  }
  return nullptr;
}

/// A file that is removed unless it was renamed to its final name. Its own name is short: the final one may
/// be as long as the file system allows.
class Temporary {
 public:
  explicit Temporary(const fs::path& final_path) : final_path_(final_path) {
    static std::atomic<unsigned> count = 0;
    path_ = final_path.parent_path() /
            (".penumbra-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp");
    place_ = remember(path_.string());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!kept_) {
      std::error_code ignored;
      fs::remove(path_, ignored);
    }
    if (place_ != nullptr) place_->state = Unfinished::kFree;
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
  Unfinished* place_ = nullptr;
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

fs::path written_path(const fs::path& path) {
  // As many links in a row as Linux follows.
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i < 40 && fs::is_symlink(fs::symlink_status(target, error)); ++i) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) return path;
    target = target.parent_path() / next;  // an absolute one stands alone
  }
  return target;
}

void remove_unfinished_files() noexcept {
  for (const Unfinished& place : unfinished)
    if (place.state == Unfinished::kFilled) ::unlink(place.path);
}

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
      return write_and_rename(written_path(path), false, write);
    case fs::file_type::regular:
      return write_and_rename(written_path(path), true, write);
    case fs::file_type::none:
      fail(path.string(), error.message());
    default:
      return write_directly(path, write);
  }
}

}  // namespace penumbra
