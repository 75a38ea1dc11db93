/// sweep_mpi FILE MICROSECONDS: a sweep by MPI, whose cases take this time.
#include <kte/sweep/mpi.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::chrono::microseconds time(argc > 2 ? std::atoi(argv[2]) : 0);
  const auto cases = kte::random_cases(1000, 7, {kte::uniform("x", 0, 1), kte::normal("y", 0, 1)});
  const kte::sweep sums(cases, {"sum"},
                        [time](const auto& c) {
                          std::this_thread::sleep_for(time);
                          if (c.index() % 300 == 5) throw kte::bad_argument("five");
                          return std::array{c["x"] + c["y"]};
                        },
                        {.shard_size = 25});
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    const auto summary = kte::mpi_sweep(sums, argc > 1 ? argv[1] : "");
    if (rank == 0)
      std::printf("%llu cases, %llu failed\n", static_cast<unsigned long long>(summary.cases),
                  static_cast<unsigned long long>(summary.failed));
  } catch (const kte::error& e) {
    std::printf("rank %d: %s\n", rank, e.what());
  }
  MPI_Finalize();
}
