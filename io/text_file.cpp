// What is here: reading a whole text file, and saying what a file is that is not text.
// What is not: files of other kinds (files.cpp, hdf5_reader.cpp), what a text means (toml.cpp, csv.cpp).
#include "io/text_file.h"

#include <array>

#include "io/error.h"
#include "io/files.h"

namespace perfora::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n"sv, binary = "not UTF-8 text";

struct Beginning {
  std::string_view bytes, kind;
};

constexpr std::array beginnings{
    Beginning{hdf5_signature, "an HDF5 file"},
    Beginning{"\x89PNG\r\n\x1a\n"sv, "a PNG picture"},
    Beginning{"%PDF-"sv, "a PDF file"},
    Beginning{"\x1f\x8b"sv, "a gzip archive"},
    Beginning{"PK\x03\x04"sv, "a ZIP archive or a spreadsheet"},
};

/// What a file is that begins so; empty for text.
std::string_view kind_of(std::string_view beginning) {
  for (const Beginning& one : beginnings)
    if (beginning.starts_with(one.bytes)) return one.kind;
  return beginning.find('\0') != std::string_view::npos ? binary : "";
}

}  // namespace

bool is_hdf5(std::string_view beginning) {
  return beginning.starts_with(hdf5_signature);
}

std::string read_text_file(const std::filesystem::path& path, std::size_t largest, const std::string& wanted) {
  // The beginning first: a result of gigabytes is no table that is too long.
  constexpr std::size_t enough = 512;
  const std::string beginning = read_beginning(path, enough);
  const std::string kind(kind_of(beginning));
  if (kind.empty()) return read_file(path, largest);
  std::string remedy = "name another file";
  if (is_hdf5(beginning)) remedy = "perfora show tells what it holds";
  if (kind == binary) remedy = "save it as UTF-8 text, or name another file";
  throw InputError({path.string(), 0, ""}, "is " + kind, wanted + " is wanted", remedy);
}

}  // namespace perfora::io
