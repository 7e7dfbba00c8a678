// What is here: evaluations by the ranks of an MPI job: rank 0 asks, all others evaluate. What is not: the program that
// begins and ends MPI (app/main_mpi.cpp); it is the only one that links this file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/cancellation.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {

/// One process of an MPI job, from MPI_Init to MPI_Finalize. MPI is used from the thread that made it alone.
class MpiJob {
 public:
  /// How rank 0 sees another rank.
  enum class RankState {
    idle,
    busy,
    leaving,  ///< it was told to stop by a signal, and takes nothing any more
    hung,     ///< it does not end an evaluation it was told to end
  };

  MpiJob();
  /// Rank 0: lets the others end. Where one of them hangs, the job is ended as a whole.
  ~MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return static_cast<int>(states_.size()); }
  /// The largest number of ranks that share a host, rank 0 left out of account.
  int workers_a_host() const { return workers_a_host_; }

  /// Ranks other than 0: evaluates what rank 0 asks, one after another, until rank 0 ends. `stop`: of the signals of
  /// this process; what is under way then writes its checkpoint and is given up.
  void serve(const io::Cancellation& stop);

  /// Exit code with which ~MpiJob() ends a job of which a rank hangs.
  void set_exit_code(int exit_code) { exit_code_ = exit_code; }

  // For the executor alone; by rank.
  std::vector<RankState>& states() { return states_; }

 private:
  int rank_ = 0, workers_a_host_ = 1, exit_code_ = 0;
  std::vector<RankState> states_;
};

struct MpiWorkers {
  int workers = 0;          ///< ranks that evaluate; 0: all but rank 0
  int threads = 1;          ///< of all of them together
  double time_limit = 0.0;  ///< s of wall time an evaluation may take; 0: from its estimate
  double memory = 0.0;      ///< bytes a host, for its ranks together; 0: no limit
};

/// Rank 0's executor; `job` must outlive it. A rank that dies ends the whole job (MPI does that), the journal keeps
/// what was finished. Throws io::InputError where there is no other rank.
std::unique_ptr<Executor> make_mpi_executor(MpiJob& job, const MpiWorkers& workers);

}  // namespace perfora::optimize
