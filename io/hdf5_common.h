// What is here: what reader and writer of HDF5 share inside io: handles that close themselves, one lock, number types,
// the trial of doubtful files.
// What is not: anything a caller of io sees; only the hdf5_*.cpp files include hdf5.h.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

namespace perfora::io {

/// An HDF5 identifier with the function that closes it; negative: invalid.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Debian's serial HDF5 is not thread-safe: every call into it holds this lock. Taking it also silences HDF5's own
/// error printing.
std::unique_lock<std::recursive_mutex> hdf5_lock();

template <class T>
hid_t native_type();
template <>
inline hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t native_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t native_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
inline hid_t native_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t native_type<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
inline hid_t native_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

/// A UTF-8 string type of variable length (h5py gives these back as str).
Hdf5Handle string_type();
/// Properties for opening files: everything inside is closed with the file, and HDF5's own locks are off: they fail on
/// network file systems, and files are never changed in place.
Hdf5Handle file_access();
/// The same for a file that is made in memory.
Hdf5Handle memory_access();

/// Why this dataset is not read, or "": it lies in other files, needs a filter from elsewhere, or claims more than the
/// file can hold. `size` is that of the file in bytes.
std::string refused_dataset(hid_t dataset, std::uint64_t size);

/// Tries a file without a checksum in a process of its own: reads every object of it there. HDF5 may crash or never
/// end on a damaged one; then this is false. `size` is that of the file in bytes. Throws SurroundingsError where there
/// is no such process, or where it was ended from outside.
bool survives_reading(const std::filesystem::path& path, std::uint64_t size);

}  // namespace perfora::io
