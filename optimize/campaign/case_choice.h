// What is here: some cases of a sweep chosen by their labels (--only). What is not: the cases (sweep.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perfora::optimize {

/// Does `label` have one of `texts` in it? All labels are chosen where `texts` is empty.
bool is_chosen(const std::string& label, const std::vector<std::string>& texts);

/// Throws io::InputError: none of `labels` of the cases in `file` is chosen.
[[noreturn]] void refuse_choice(const std::filesystem::path& file, const std::vector<std::string>& texts,
                                const std::vector<std::string>& labels);

}  // namespace perfora::optimize
