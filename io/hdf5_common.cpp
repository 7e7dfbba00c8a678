// What is here: the lock, the types and the properties that reader and writer of HDF5 share, and which datasets are
// not read. What is not: reading and writing.
#include "io/hdf5_common.h"

#include <algorithm>

#include "io/hdf5.h"

namespace perfora::io {

std::unique_lock<std::recursive_mutex> hdf5_lock() {
  static std::recursive_mutex mutex;
  std::unique_lock<std::recursive_mutex> lock(mutex);
  thread_local const bool silenced =  // HDF5 keeps this setting a thread
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  (void)silenced;
  return lock;
}

void end_without_hdf5() {
  H5dont_atexit();
  // Without lists of free blocks: HDF5 clears them when memory runs out, which corrupts the heap in 1.10.8.
  H5set_free_list_limits(0, 0, 0, 0, 0, 0);
}

Hdf5Handle string_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  H5Pset_file_locking(access.get(), false, true);
  return access;
}

Hdf5Handle memory_access() {
  constexpr std::size_t growth = std::size_t{1} << 20;  // bytes
  Hdf5Handle access = file_access();
  H5Pset_fapl_core(access.get(), growth, false);
  return access;
}

std::string refused_dataset(hid_t dataset, std::uint64_t size) {
  const Hdf5Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  if (!creation.valid() || !type.valid() || !space.valid()) return "cannot be read: the file is damaged";
  if (H5Pget_layout(creation.get()) == H5D_VIRTUAL || H5Pget_external_count(creation.get()) != 0)
    return "lies in other files, which are not read";
  const int filters = H5Pget_nfilters(creation.get());
  for (int k = 0; k < filters; ++k) {
    unsigned flags = 0;
    std::size_t values = 0;
    if (H5Pget_filter2(creation.get(), static_cast<unsigned>(k), &flags, &values, nullptr, 0, nullptr, nullptr) >=
        H5Z_FILTER_RESERVED)
      return "needs a filter that HDF5 would load from elsewhere";
  }
  constexpr double most_deflated = 1100.0;  // deflate reaches 1032 to 1
  const auto count = static_cast<double>(H5Sget_simple_extent_npoints(space.get()));
  const auto stored = static_cast<double>(std::min<hsize_t>(H5Dget_storage_size(dataset), size));
  const double most = stored * (filters > 0 ? most_deflated : 1.0);
  if (count < 0.0 || count * static_cast<double>(H5Tget_size(type.get())) > most)
    return "claims more than the file can hold: the file is damaged";
  return {};
}

}  // namespace perfora::io
