// What the program needs of MPI, as functions of a library of its own (mpi_library.cpp) that is opened where
// mpirun has started the program: MPI's libraries cost every other start of it memory and time.
#pragma once

#include <cstddef>

namespace penumbra::apps {

struct MpiLibrary {
  /// Whether MPI lets several threads call, one at a time.
  bool (*start)(int* rank, int* size);
  void (*send)(int to, int tag, const char* bytes, std::size_t size);
  /// Whether a message of this rank has come.
  bool (*probe)(int from, int* tag, std::size_t* size);
  /// Begins to take it. A rank that is killed while it sends a long one leaves the receipt open for ever.
  void* (*receive)(int from, int tag, char* bytes, std::size_t size);
  /// Whether the bytes are there; the receipt is gone then.
  bool (*received)(void* receipt);
  /// Waits for all others.
  void (*finish)();
  /// Ends all processes with exit code 1.
  void (*abort)();
};

/// The library's one function.
extern "C" const MpiLibrary* penumbra_mpi_library();
inline constexpr const char* kMpiLibraryFunction = "penumbra_mpi_library";

}  // namespace penumbra::apps
