#pragma once

#include <kte/sweep/sweep.hpp>

// The C++ bindings of MPI, which are not used.
#if !defined(OMPI_SKIP_MPICXX)
#  define OMPI_SKIP_MPICXX 1
#endif
#if !defined(MPICH_SKIP_MPICXX)
#  define MPICH_SKIP_MPICXX 1
#endif
#include <exception>
#include <mpi.h>
#include <string>

/// Sweeps on clusters, by MPI (libopenmpi-dev). Programs call MPI_Init and MPI_Finalize, and link MPI.
namespace kte {

namespace detail {

/// A number that all ranks increase, kept by rank 0.
class shared_counter {
 public:
  explicit shared_counter(MPI_Comm all) {
    int rank = 0;
    MPI_Comm_rank(all, &rank);
    MPI_Win_allocate(rank == 0 ? sizeof(std::uint64_t) : 0, sizeof(std::uint64_t), MPI_INFO_NULL, all, &value_,
                     &window_);
    if (rank == 0) {
      MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, window_);
      *value_ = 0;
      MPI_Win_unlock(0, window_);
    }
    MPI_Barrier(all);
  }
  shared_counter(const shared_counter&) = delete;
  shared_counter& operator=(const shared_counter&) = delete;
  ~shared_counter() { MPI_Win_free(&window_); }
  /// The number before it is increased.
  std::uint64_t next() {
    const std::uint64_t one = 1;
    std::uint64_t before = 0;
    MPI_Win_lock(MPI_LOCK_SHARED, 0, 0, window_);
    MPI_Fetch_and_op(&one, &before, MPI_UINT64_T, 0, 0, MPI_SUM, window_);
    MPI_Win_unlock(0, window_);
    return before;
  }

 private:
  std::uint64_t* value_ = nullptr;
  MPI_Win window_{};
};

/// Calls body() in a rank; if it throws in any, all ranks throw: that rank its exception, others `bad_argument`.
template <class Body>
void in_all_ranks(MPI_Comm all, const Body& body) {
  std::exception_ptr failure;
  try {
    body();
  } catch (...) {
    failure = std::current_exception();
  }
  int failed = failure ? 1 : 0, any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, all);
  if (failure) std::rethrow_exception(failure);
  if (any != 0) raise<bad_argument>("kte: the sweep failed in another rank");
}

}  // namespace detail

/// `sweep::to` in all ranks of a communicator, called by each of them. Each rank takes the next missing shard until
/// there are none; rank 0 then merges. The file is that of `sweep::to`, bit for bit. All ranks need the folder of the
/// file (a shared file system). A rank runs one shard at a time: the executor of the sweep is not used, and `progress`
/// is not called. The summary is valid in rank 0; other ranks get an empty one.
inline sweep_summary mpi_sweep(const sweep& s, const std::filesystem::path& file, MPI_Comm all = MPI_COMM_WORLD) {
  int rank = 0;
  MPI_Comm_rank(all, &rank);
  std::vector<std::uint64_t> missing;
  detail::in_all_ranks(all, [&] {
    if (rank == 0) missing = s.missing(file);
  });
  std::uint64_t count = missing.size();
  MPI_Bcast(&count, 1, MPI_UINT64_T, 0, all);
  missing.resize(static_cast<std::size_t>(count));
  MPI_Bcast(missing.data(), static_cast<int>(count), MPI_UINT64_T, 0, all);
  {
    detail::shared_counter counter(all);
    detail::in_all_ranks(all, [&] {
      for (std::uint64_t i; (i = counter.next()) < count;) s.compute(file, missing[static_cast<std::size_t>(i)]);
    });
  }
  sweep_summary summary;
  detail::in_all_ranks(all, [&] {
    if (rank == 0) summary = s.merge(file);
  });
  return summary;
}

}  // namespace kte
