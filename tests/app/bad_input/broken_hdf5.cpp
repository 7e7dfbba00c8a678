// What is here: HDF5 files with one fault each, made with the C API because the project's writer refuses to make them.
#include "tests/app/bad_input/broken_hdf5.h"

#include <hdf5.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "io/hdf5.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;

void require(bool success, const std::string& what) {
  if (!success) throw std::runtime_error("make_broken_hdf5: " + what);
}

/// Opens a copy of `good` for changes and closes it again.
template <class Change>
void change_copy(const fs::path& good, const fs::path& target, Change change) {
  fs::copy_file(good, target, fs::copy_options::overwrite_existing);
  const hid_t file = H5Fopen(target.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  require(file >= 0, "cannot open " + target.string());
  change(file);
  require(H5Fclose(file) >= 0, "cannot close " + target.string());
}

void shorten(hid_t file, const char* name) {
  require(H5Ldelete(file, name, H5P_DEFAULT) >= 0, "no such dataset");
  const std::vector<double> values(3, 0.001);
  const hsize_t size = values.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t data = H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  require(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, "cannot write");
  H5Dclose(data);
  H5Sclose(space);
}

void put_nan(hid_t file, const char* name) {
  const hid_t data = H5Dopen2(file, name, H5P_DEFAULT);
  require(data >= 0, "no such dataset");
  const hid_t space = H5Dget_space(data);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  require(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, "cannot read");
  values.at(values.size() / 2) = std::numeric_limits<double>::quiet_NaN();
  require(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, "cannot write");
  H5Sclose(space);
  H5Dclose(data);
}

}  // namespace

void make_broken_hdf5(const fs::path& good, const fs::path& target) {
  const std::string how = target.stem();
  if (how == "truncated") {
    fs::copy_file(good, target, fs::copy_options::overwrite_existing);
    fs::resize_file(target, fs::file_size(good) / 2);
  } else if (how == "nothing_inside") {
    io::Hdf5Writer file(target);
    file.text("/note", "nothing of Perfora's");
    file.commit();
  } else if (how == "run_without_history") {
    io::Hdf5Writer file(target);
    file.attribute("/", "format", "perfora.run/1");
    file.commit();
  } else if (how == "radius_missing") {
    change_copy(good, target,
                [](hid_t file) { require(H5Ldelete(file, "/packing/radius", H5P_DEFAULT) >= 0, "no radius"); });
  } else if (how == "unequal_columns") {
    change_copy(good, target, [](hid_t file) { shorten(file, "/packing/y"); });
  } else if (how == "nan_position") {
    change_copy(good, target, [](hid_t file) { put_nan(file, "/packing/x"); });
  } else {
    throw std::runtime_error("make_broken_hdf5: nothing known of " + how);
  }
}

}  // namespace perfora::test
