// What is here: a file without a checksum read in a process of its own, where HDF5 may crash or never end.
// What is not: files that prove themselves (checksum_trailer.cpp), what is read from them (hdf5_reader.cpp).
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include "io/error.h"
#include "io/hdf5_common.h"

namespace perfora::io {
namespace {

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t*, void*) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return -1;
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose), space(H5Aget_space(attribute.get()), H5Sclose);
  if (!type.valid() || !space.valid()) return -1;
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  constexpr hsize_t most = hsize_t{1} << 26;  // bytes
  const hsize_t size = H5Aget_storage_size(attribute.get());
  if (count < 0 || size > most) return -1;
  std::vector<char> data(static_cast<std::size_t>(count) * H5Tget_size(type.get()));
  if (!data.empty() && H5Aread(attribute.get(), type.get(), data.data()) < 0) return -1;
  if (H5Tdetect_class(type.get(), H5T_VLEN) > 0 || H5Tis_variable_str(type.get()) > 0)
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, data.data());
  return 0;
}

bool read_dataset(hid_t dataset, std::uint64_t file_size) {
  if (!refused_dataset(dataset, file_size).empty()) return true;  // the reader refuses it as well
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  if (!type.valid() || !space.valid()) return false;
  std::vector<char> data(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())) * H5Tget_size(type.get()));
  if (data.empty()) return true;
  if (H5Dread(dataset, type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0) return false;
  if (H5Tis_variable_str(type.get()) > 0) H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, data.data());
  return true;
}

herr_t read_object(hid_t file, const char* name, const H5O_info_t* info, void* size) {
  const Hdf5Handle object(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  if (!object.valid() || H5Aiterate2(object.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, read_attribute, nullptr) < 0)
    return -1;
  return info->type != H5O_TYPE_DATASET || read_dataset(object.get(), *static_cast<std::uint64_t*>(size)) ? 0 : -1;
}

bool can_read(const std::filesystem::path& path, std::uint64_t size) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access().get()), H5Fclose);
  haddr_t end = 0;
  // What follows the end that the head names is the rest of a damaged checksum or of another file.
  if (!file.valid() || H5Fget_eoa(file.get(), &end) < 0 || end != size) return false;
  return H5Ovisit(file.get(), H5_INDEX_NAME, H5_ITER_NATIVE, read_object, &size) >= 0;
}

/// In the child: says nothing, leaves no core, ends by itself when HDF5 does not.
[[noreturn]] void try_and_end(const std::filesystem::path& path, std::uint64_t size) {
  for (const int signal : {SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL, SIGTERM, SIGINT, SIGHUP})
    ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
  constexpr std::uint64_t bytes_a_second = 20000000;  // slower than any disk that is used
  ::alarm(static_cast<unsigned>(5 + size / bytes_a_second));
  bool good = false;
  try {
    good = can_read(path, size);
  } catch (...) {  // bad_alloc, length_error: sizes that nothing could hold
  }
  ::_exit(good ? 0 : 1);
}

}  // namespace

bool survives_reading(const std::filesystem::path& path, std::uint64_t size) {
  const auto fail = [&](const std::string& why) {
    throw SurroundingsError(path.string() + ": whether the file can be read was not found out (" + why +
                            "); run the command again");
  };
  const pid_t child = ::fork();
  if (child == 0) try_and_end(path, size);
  if (child < 0) fail(std::generic_category().message(errno));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail(std::generic_category().message(errno));
  // These come from outside. What the file itself leads to is a crash, an error or SIGALRM.
  for (const int signal : {SIGKILL, SIGTERM, SIGINT, SIGHUP})
    if (WIFSIGNALED(status) && WTERMSIG(status) == signal)
      fail(std::string("the process that tried was ended by ") + ::strsignal(signal));
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace perfora::io
