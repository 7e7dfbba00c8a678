// What is here: how the threads of the OpenMP library wait. What is not: how many there are (common.h).
#pragma once

namespace perfora::app {

/// Lets waiting threads go to sleep after a short spin, unless the user chose a policy (OMP_WAIT_POLICY,
/// GOMP_SPINCOUNT). The library reads its settings when it is loaded, so the program sets them and starts itself once
/// more; when that fails it simply goes on. A step has a few barriers: with the library's long spin a second program on
/// the same cores makes it a hundred times slower.
void let_waiting_threads_sleep(char** argv);

}  // namespace perfora::app
