// What is here: the folder that long work keeps its journal and results in. What is not: what the journal says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/lock.h"

namespace perfora::optimize {

/// Takes `folder` for work that writes `own_files` into it (journal.jsonl among them; a name that ends in * stands for
/// all that begin so): makes it where it is missing, holds the lock of its journal, then removes the files with
/// `force`, keeps them with `resume`, otherwise refuses a folder that holds such work or a file of such a name. `what`
/// names the work as its journal's first event does ("study"). A folder that another process uses or with the journal
/// of other work is refused in any case, and folders among `own_files` are removed only beside a journal. Temporaries
/// of processes that were killed go. Throws io::InputError, and io::SurroundingsError where the disk fails.
[[nodiscard]] io::OutputLock claim_work_folder(const std::filesystem::path& folder,
                                               const std::vector<std::string>& own_files, const std::string& what,
                                               bool force, bool resume);

}  // namespace perfora::optimize
