#include "apps/cli/ranks/ranks.h"

#include <dlfcn.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <utility>

#include "apps/cli/ranks/mpi_library.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

/// Set by Open MPI, and by what follows PMI (MPICH, Slurm). 1 where neither is there.
int started_processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size);
  return 1;
}

/// Beside the program's folder, in lib/. Null where Penumbra was built without MPI. It stays open.
const MpiLibrary* open_library() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path file = program.parent_path().parent_path() / "lib" / "penumbra-mpi.so";
  // Open MPI's own parts look for its symbols among all.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* function = library ? dlsym(library, kMpiLibraryFunction) : nullptr;
  return function ? reinterpret_cast<decltype(&penumbra_mpi_library)>(function)() : nullptr;
}

}  // namespace

std::unique_ptr<Ranks> Ranks::of_this_run() {
  if (started_processes() < 2) return nullptr;
  const MpiLibrary* library = open_library();
  if (!library)
    throw UsageError(
        "this penumbra was built without MPI, and cannot share its work with others; run it alone");
  int rank = 0, size = 1;
  if (!library->start(&rank, &size)) throw UsageError("this MPI allows one thread only");
  return std::unique_ptr<Ranks>(new Ranks(*library, rank, size));
}

Ranks::~Ranks() {
  // MPI cannot be ended without those that are gone. All files are written and closed.
  if (abandoned_) {
    std::cout.flush();
    std::_Exit(std::uncaught_exceptions() > 0 || !std::cout ? 1 : 0);
  }
  library_.finish();
}

void Ranks::abort() {
  library_.abort();
  std::abort();
}

void Ranks::send(int to, int tag, const std::string& bytes) {
  const std::lock_guard lock(mutex_);
  library_.send(to, tag, bytes.data(), bytes.size());
}

bool Ranks::receive(Receiving& next, int from) {
  std::size_t size = 0;
  if (!next.receipt) {
    if (!library_.probe(from, &next.message.tag, &size)) return false;
    next.message.from = from;
    next.message.bytes.resize(size);
    next.receipt = library_.receive(from, next.message.tag, next.message.bytes.data(), size);
  }
  if (!library_.received(next.receipt)) return false;
  next.receipt = nullptr;
  return true;
}

std::optional<RankMessage> Ranks::poll() {
  const std::lock_guard lock(mutex_);
  for (int from = 0; from < size_; ++from) {
    Receiving& next = receiving_[static_cast<std::size_t>(from)];
    if (receive(next, from)) return std::exchange(next.message, {});
  }
  return std::nullopt;
}

}  // namespace penumbra::apps
