#include "apps/cli/ranks/mpi_library.h"

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <memory>

namespace penumbra::apps {
namespace {

bool start(int* rank, int* size) {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, size);
  return provided >= MPI_THREAD_SERIALIZED;
}

void send(int to, int tag, const char* bytes, std::size_t size) {
  MPI_Send(bytes, static_cast<int>(size), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

bool probe(int from, int* tag, std::size_t* size) {
  int come = 0, count = 0;
  MPI_Status status;
  MPI_Iprobe(from, MPI_ANY_TAG, MPI_COMM_WORLD, &come, &status);
  if (!come) return false;
  MPI_Get_count(&status, MPI_BYTE, &count);
  *tag = status.MPI_TAG;
  *size = static_cast<std::size_t>(count);
  return true;
}

void* receive(int from, int tag, char* bytes, std::size_t size) {
  auto receipt = std::make_unique<MPI_Request>();
  MPI_Irecv(bytes, static_cast<int>(size), MPI_BYTE, from, tag, MPI_COMM_WORLD, receipt.get());
  return receipt.release();
}

bool received(void* receipt) {
  int done = 0;
  MPI_Test(static_cast<MPI_Request*>(receipt), &done, MPI_STATUS_IGNORE);
  if (done) delete static_cast<MPI_Request*>(receipt);
  return done;
}

void finish() {
  MPI_Finalize();
}

void abort() {
  MPI_Abort(MPI_COMM_WORLD, 1);
}

}  // namespace

const MpiLibrary* penumbra_mpi_library() {
  static constexpr MpiLibrary kLibrary{start, send, probe, receive, received, finish, abort};
  return &kLibrary;
}

}  // namespace penumbra::apps
