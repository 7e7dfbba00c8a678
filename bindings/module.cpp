// What is here: the module perfora._core, its errors and versions. What is not: its types and functions.
#include <exception>

#include "bindings/bind.h"

namespace perfora::python {

/// Raised with every change that a program which uses the module may notice.
constexpr int interface_version = 1;

}  // namespace perfora::python

PYBIND11_MODULE(_core, module) {
  using namespace perfora::python;
  module.doc() = "What the package perfora is made of.";
  py::register_exception<perfora::Error>(module, "InputError", PyExc_ValueError).attr("__doc__") =
      "Something that was given is wrong: a key, a value, a file. One sentence: what is wrong, what to do.";
  py::register_exception<perfora::SurroundingsError>(module, "SurroundingsError", PyExc_OSError).attr("__doc__") =
      "The surroundings failed (a full disk, a lost worker), not what was given; the same call may succeed later.";
  module.attr("interface_version") = interface_version;
  module.attr("__version__") = PERFORA_VERSION;
  add_designs(module);
  add_results(module);
  add_files(module);
  add_work(module);
  add_studies(module);
}
