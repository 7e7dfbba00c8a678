// What is here: the folder that long work keeps its journal and results in. What is not: what the journal says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perfora::optimize {

/// Makes `folder` ready for work that writes `own_files` into it (journal.jsonl among them; a name that ends in *
/// stands for all that begin so): removes them with `force`, keeps them with `resume`, otherwise refuses a folder that
/// holds such work or a file of such a name. `what` names the work as its journal's first event does ("study"). A
/// folder with the journal of other work is refused in any case, and folders among `own_files` are removed only beside
/// a journal. Throws io::InputError.
void prepare_work_folder(const std::filesystem::path& folder, const std::vector<std::string>& own_files,
                         const std::string& what, bool force, bool resume);

}  // namespace perfora::optimize
