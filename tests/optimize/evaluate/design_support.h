// What is here: a folder that goes away, and a design small enough to be evaluated in a second. What is not: tests.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/error.h"
#include "optimize/evaluate/design.h"

namespace perfora::optimize {

class DesignFolder {
 public:
  DesignFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "perfora-design-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~DesignFolder() { std::filesystem::remove_all(path_); }
  DesignFolder(const DesignFolder&) = delete;
  DesignFolder& operator=(const DesignFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// One hole of 6 mm in 12 x 12 mm, some 380 discs, pressed fast and not far.
inline const char* small_design =
    "[cell]\nwidth = \"12 mm\"\nheight = \"12 mm\"\n"
    "[layout]\nfamily = \"square\"\nrows = 1\ncolumns = 1\ndiameter = \"6 mm\"\n"
    "[packing]\nsolid_fraction = 0.719\n"
    "[loading]\nuntil = 0.01\nrate = 40\n"
    "[measures]\nplateau_start = 0.002\nplateau_end = 0.008\n";

/// The sentence of the InputError that `action` throws; "" when it throws none.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const io::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace perfora::optimize
