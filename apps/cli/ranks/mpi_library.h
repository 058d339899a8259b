// What the program needs of MPI, as functions of a library of its own (mpi_library.cpp) that is opened where mpirun has started
// the program: MPI's libraries cost every other start of it memory and time.
#pragma once

#include <cstddef>

namespace penumbra::apps {

struct MpiLibrary {
  /// Whether MPI lets several threads call, one at a time.
  bool (*start)(int* rank, int* size);
  void (*send)(int to, int tag, const char* bytes, std::size_t size);
  /// Whether a message has come.
  bool (*probe)(int* from, int* tag, std::size_t* size);
  void (*receive)(int from, int tag, char* bytes, std::size_t size);
  /// Waits for all others.
  void (*finish)();
  /// Ends all processes with exit code 1.
  void (*abort)();
};

/// The library's one function.
extern "C" const MpiLibrary* penumbra_mpi_library();
inline constexpr const char* kMpiLibraryFunction = "penumbra_mpi_library";

}  // namespace penumbra::apps
